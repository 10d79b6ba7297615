"""What the tests of `firn element PATH` share: paths from dictionaries, and the rows that come out."""

import csv
import io
import json

from firn_cli import FirnTest

METAL = {"model": "von_mises", "youngs_modulus": 2e11, "poissons_ratio": 0.3, "sigma_y": 2e8}
METAL_P_WAVE = 2e11 * 0.7 / (1.3 * 0.4)
# Of one friction angle, 30 degrees.
SAND = {"model": "sand_klar_2016", "youngs_modulus": 5e7, "poissons_ratio": 0.3, "h0": 30, "h1": 0, "h3": 0}
SAND_P_WAVE = 5e7 * 0.7 / (1.3 * 0.4)

# Its strength fades as it is torn.
CLAY = {"model": "nacc_wolper_2019", "youngs_modulus": 1e7, "poissons_ratio": 0.3, "M": 1.2, "beta": 0.3, "xi": 3}
CLAY_P_WAVE = 1e7 * 0.7 / (1.3 * 0.4)


def toml(material, *legs):
    """A path file; line 1 is [material], with a key a line."""
    tables = [("[material]", material)] + [("[[legs]]", leg) for leg in legs]
    return "".join(head + "\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())
                   for head, keys in tables)


class PathTest(FirnTest):
    def lead(self, material, *legs, arguments=()):
        """The rows, as numbers but for the branch."""
        self.firn("element", self.write("path.toml", toml(material, *legs)), "--out", "path.csv", *arguments)
        with open(self.path("path.csv"), encoding="utf-8") as text:
            return self.rows(text.read())

    def rows(self, text):
        rows = [{key: value if key == "branch" else float(value) for key, value in row.items()}
                for row in csv.DictReader(io.StringIO(text))]
        for row in rows:
            row["J"] = row["F_xx"] * row["F_yy"] * row["F_zz"]
        return rows

    def assert_near(self, value, expected, relative):
        self.assertLessEqual(abs(value - expected), relative * abs(expected), f"{value} is not {expected}")

    def assert_all_near(self, values, expected, slack):
        values = list(values)
        self.assertTrue(values)
        self.assertLessEqual(max(abs(value - expected) for value in values), slack, f"{values[-5:]}, not {expected}")


def kirchhoff(row):
    """Axial; it is what the laws in logarithmic strain are written in."""
    return row["stress_yy"] * row["J"]
