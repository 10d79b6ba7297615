#!/usr/bin/python3
"""What `firn element PATH` answers to mistakes and to tests that cannot be."""

import os
import re

from element_path import METAL, SAND, PathTest, toml
from firn_cli import main

PULL = {"test": "uniaxial", "strain": 0.01}
PRESS = {"test": "isotropic", "pressure": 1e5}


class Mistakes(PathTest):
    def refused(self, text, *arguments, code=2):
        """The lines on standard error, each split into place and message."""
        done = self.firn("element", self.write("bad.toml", text), "--out", "out.csv", *arguments, code=code)
        self.assertEqual(done.stdout, "")
        if code == 2:
            self.assertFalse(os.path.exists(self.path("out.csv")))
        return [line.split(": ", 1) for line in done.stderr.splitlines()]

    def one(self, text, place, *words, arguments=(), code=2):
        (found, message), = self.refused(text, *arguments, code=code)
        self.assertTrue(re.fullmatch(rf".*{re.escape(place)}", found), f"{found}: {message}")
        for word in words:
            self.assertIn(word, message)

    def test_everything_is_told_at_once_with_its_place(self):
        lines = self.refused("titel = 3\n"                                     # 1
                             "[material]\n"                                    # 2
                             'model = "von_mises"\n'                           # 3
                             "youngs_modulus = -1\n"                           # 4
                             "sigmay = 2\n"                                    # 5: and so sigma_y is missing
                             "poissons_ratio = 0.3\n"                          # 6
                             "[[legs]]\n"                                      # 7
                             'test = "uniaxal"\n'                              # 8
                             "[[legs]]\n"                                      # 9: strain is missing
                             'test = "oedometer"\n'                            # 10
                             "lateral_pressure = 1\n"                          # 11
                             "steps = 0\n"                                     # 12
                             "time = \"1\"\n")                                 # 13
        places = [tuple(map(int, place.rsplit(":", 2)[1:])) for place, _ in lines]
        self.assertEqual(places, [(1, 1), (2, 1), (4, 18), (5, 1), (8, 8), (9, 1), (11, 20), (12, 9), (13, 8)])
        for (_, message), words in zip(lines, (
                ("unknown key 'titel'", "did you mean 'title'"),
                ("material.sigma_y", "missing"),
                ("material.youngs_modulus", "found the integer -1", "in (0, 1e+15] (Pa)"),
                ("material.sigmay", "did you mean 'sigma_y'"),
                ("legs[0].test", "'uniaxal'", "did you mean 'uniaxial'", "triaxial"),
                ("legs[1].strain", "missing", "oedometer"),
                ("legs[1].lateral_pressure", "oedometer", "strain, cycles, until_stress"),
                ("legs[1].steps", "found the integer 0", "1 to 1000000"),
                ("legs[1].time", "found the string '1'", "> 0"))):
            for word in words:
                self.assertIn(word, message)

    def test_density_may_be_left_out_or_given_but_not_be_wrong(self):
        self.lead(METAL, PULL)
        self.assertEqual(self.lead({**METAL, "density": 8000}, PULL), self.lead(METAL, PULL))
        self.one(toml({**METAL, "density": -1}, PULL), ":6:11", "material.density", "in (0, 1e+09]")

    def test_models_and_tables_that_are_not_there(self):
        self.one(toml({"model": "von_mses"}, PULL), ":2:9", "did you mean 'von_mises'")
        self.one(toml(METAL), ":1:1", "legs", "missing")
        self.one("legs = 3\n" + toml(SAND), ":1:8", "found the integer 3")
        self.one("[[legs]]\n" + 'test = "uniaxial"\nstrain = 1\n', ":1:1", "material", "missing")
        self.one("[material\n", ":1:10", "not valid TOML")
        self.assertIn("no such file", self.firn("element", "nowhere.toml", code=2).stderr)

    def test_numbers_out_of_range(self):
        for leg, words in (({**PULL, "strain": 6}, ("strain", "in [-5, 5]")),
                           ({**PULL, "time": 0}, ("time", "> 0")),
                           ({**PULL, "cycles": 0}, ("cycles", "1 to 10000")),
                           ({**PULL, "cycles": 10000, "steps": 1000}, ("40000000 steps", "at most 10000000")),
                           ({**PULL, "cycles": 2, "until_stress": 1}, ("until_stress", "beside cycles")),
                           ({"test": "free", "strains": [1, 2]}, ("strains", "three numbers"))):
            (_, message), = self.refused(toml(METAL, leg))
            for word in words:
                self.assertIn(word, message)

    def test_a_pressure_that_is_not_there_cannot_be_kept(self):
        sheared = {"test": "simple_shear", "strain": 0.1, "normal_pressure": 1e5}
        pressed = {"test": "triaxial", "strain": -0.1, "lateral_pressure": 1e5}
        # Line 8 is the first leg's [[legs]].
        self.one(toml(SAND, pressed), ":11:20", "legs[0].lateral_pressure", "100000 Pa", "carries 0 Pa", "isotropic")
        self.one(toml(SAND, PRESS, sheared, pressed), ":18:20", "legs[2].lateral_pressure", "the leg before")
        self.one(toml(SAND, PRESS, {**sheared, "normal_pressure": 2e5}), ":14:19", "carries 100000 Pa")
        self.one(toml(SAND, PRESS, PULL), ":12:8", "legs[1].test", "0 Pa", "carries 100000 Pa")
        # But a ring that was loaded up to it will do for a shear box.
        self.lead(SAND, {"test": "oedometer", "strain": -0.1, "until_stress": -1e5}, sheared)

    def test_settings_of_the_command_line_are_checked_as_the_file_is(self):
        self.one(toml(METAL, PULL), "--set legs.0.stran=1", "did you mean 'strain'",
                 arguments=("--set", "legs.0.stran=1"))
        rows = self.lead(METAL, PULL, arguments=("--set", "legs.0.strain=0.02", "--set", "legs.0.steps=3"))
        self.assertEqual((len(rows), rows[-1]["strain_axial"]), (4, 0.02))
        self.firn("element", "--out", "a.csv", code=2)
        self.firn("element", "--set", "a=1", code=2)


class Numerics(PathTest):
    def failed(self, *legs, material):
        done = self.firn("element", self.write("bad.toml", toml(material, *legs)), "--out", "out.csv", code=6)
        with open(self.path("out.csv"), encoding="utf-8") as text:
            return done.stderr, self.rows(text.read())

    def test_dry_sand_cannot_be_pulled(self):
        message, rows = self.failed({**PRESS, "steps": 4}, {"test": "isotropic", "pressure": -1e5, "steps": 4},
                                    material=SAND)
        # From 1e5 by 5e4 a step: the second gets to 0, the third is -5e4, all of which is left, on three faces at most.
        self.assertRegex(message, r"bad\.toml:12:1: legs\[1\]: step 7: the stress on the faces")
        left = float(re.search(r": ([0-9.e+]+) Pa are left", message).group(1))
        self.assertTrue(4.9e4 < left < 5.1e4 * 3**0.5, message)
        self.assertIn("1e-8 of the P-wave modulus", message)
        # What was before is there.
        self.assertEqual([row["step"] for row in rows], list(range(7)))

    def test_a_stress_beyond_the_strength_is_not_reached(self):
        message, rows = self.failed({**PULL, "until_stress": 3e8, "steps": 10}, material=METAL)
        self.assertIn("legs[0]: step 10: the stress ends at 1.9", message)
        self.assertIn("until_stress, 3e+08 Pa", message)
        self.assertEqual(len(rows), 11)

    def test_rows_that_cannot_be_written_are_an_error(self):
        self.firn("element", self.write("path.toml", toml(METAL, PULL)), "--out", "no/folder.csv", code=4)


if __name__ == "__main__":
    main()
