#!/usr/bin/python3
"""`firn element PATH` against closed forms of lab tests. Stresses on driven faces are solved for to 1e-8 of the P-wave
modulus at the worst, in practice to round-off, 1e-14 of it."""

import csv
import math
import os
import subprocess
import xml.etree.ElementTree

from element_path import CLAY, CLAY_P_WAVE, METAL, METAL_P_WAVE, SAND, SAND_P_WAVE, PathTest, kirchhoff
from firn_cli import SOURCE, main

E = METAL["youngs_modulus"]
YIELD = METAL["sigma_y"]


def cone(degrees):
    """q/p of Drucker and Prager's cone through the compressive corners of Mohr and Coulomb's: |dev tau| = 3 a p, and
    a = sqrt(2/3) 2 sin phi / (3 - sin phi)."""
    sine = math.sin(math.radians(degrees))
    return math.sqrt(27 / 2) * math.sqrt(2 / 3) * 2 * sine / (3 - sine)


class Metals(PathTest):
    def test_perfect_plasticity_is_flat_at_the_yield_stress(self):
        rows = self.lead(METAL, {"test": "uniaxial", "strain": 0.02, "steps": 40})
        self.assertEqual(len(rows), 41)
        flowing = [row for row in rows if row["strain_axial"] > YIELD / E]
        self.assert_all_near(map(kirchhoff, flowing), YIELD, 1e-12 * METAL_P_WAVE)
        for face in ("stress_xx", "stress_zz"):
            self.assert_all_near((row[face] for row in rows), 0, 1e-12 * METAL_P_WAVE)
        # Plastic strain keeps the volume, elastic strain is that of the yield stress.
        self.assert_near(rows[-1]["strain_volumetric"], 0.4 * YIELD / E, 1e-6)
        self.assert_near(rows[-1]["state_alpha"], 0.02 - YIELD / E, 1e-9)

    def test_linear_hardening_has_the_slope_of_both_in_series_and_unloading_that_of_youngs_modulus(self):
        hardening = 2e10
        rows = self.lead({**METAL, "H": hardening}, {"test": "uniaxial", "strain": 0.02, "steps": 50},
                         {"test": "uniaxial", "strain": -0.001, "steps": 10})
        slope = lambda a, b: (kirchhoff(b) - kirchhoff(a)) / (b["strain_axial"] - a["strain_axial"])
        # Exact in logarithmic strain and Kirchhoff stress.
        self.assert_near(slope(rows[0], rows[2]), E, 1e-9)
        self.assert_near(slope(rows[10], rows[50]), E * hardening / (E + hardening), 1e-9)
        self.assert_near(slope(rows[50], rows[60]), E, 1e-9)
        self.assertEqual(rows[60]["state_alpha"], rows[50]["state_alpha"])

    def test_a_cycle_of_perfect_plasticity_closes(self):
        amplitude, quarter = 0.01, 50
        rows = self.lead(METAL, {"test": "uniaxial", "strain": amplitude, "steps": quarter, "cycles": 3})
        cycle = 4 * quarter
        self.assertEqual(len(rows), 1 + 3 * cycle)
        strains = [row["strain_axial"] for row in rows]
        self.assertAlmostEqual(max(strains), amplitude)
        self.assertAlmostEqual(min(strains), -amplitude)
        self.assertEqual(rows[-1]["time"], 12)
        second, third = rows[1 + cycle:1 + 2 * cycle], rows[1 + 2 * cycle:]
        for a, b in zip(second, third):
            # A last place of strain is 1e-18 of E here, and they add up over 400 steps.
            self.assertAlmostEqual(a["strain_axial"], b["strain_axial"], delta=1e-14)
            self.assertAlmostEqual(a["stress_yy"], b["stress_yy"], delta=1e-12 * METAL_P_WAVE)
        # The first cycle begins without a set, and ends as the others do.
        self.assertGreater(abs(rows[1]["stress_yy"] - second[0]["stress_yy"]), 0.5 * YIELD)
        self.assert_near(rows[cycle]["stress_yy"], rows[2 * cycle]["stress_yy"], 1e-9)
        # What a loop encloses is dissipated: the height times the width less the elastic part. A step's return map by
        # x takes away sigma_y x + 3 mu x^2 / 2; the turning points are whole steps.
        area, x, mu = 4 * YIELD * (amplitude - YIELD / E), amplitude / quarter, E / 2.6
        lost = rows[3 * cycle]["dissipated"] - rows[2 * cycle]["dissipated"]
        self.assert_near(lost, area * (1 + 1.5 * mu * x / YIELD), 1e-6)

    def test_time_counts_for_a_model_with_a_rate(self):
        viscous = {**METAL, "model": "von_mises_perzyna", "eta": 1e8}
        for time in (0.1, 10):
            rows = self.lead(viscous, {"test": "uniaxial", "strain": 0.1, "time": time, "steps": 1000})
            self.assertAlmostEqual(rows[-1]["time"], time)
            # In steady flow all of the strain is plastic; the start has died away as exp(-E time / eta).
            self.assert_near(kirchhoff(rows[-1]), YIELD + 1e8 * 0.1 / time, 1e-6)

    def test_a_leg_ends_where_its_stress_is_reached(self):
        rows = self.lead(METAL, {"test": "uniaxial", "strain": 0.01, "steps": 7},
                         {"test": "uniaxial", "strain": -0.01, "steps": 7, "until_stress": 0},
                         {"test": "uniaxial", "strain": 0.001, "steps": 5, "until_stress": 1e8})
        ends = [[row for row in rows if row["leg"] == leg][-1] for leg in (0, 1, 2)]
        self.assert_near(ends[0]["strain_axial"], 0.01, 1e-9)
        self.assert_near(ends[1]["strain_axial"], 0.01 - YIELD / E, 1e-9)
        self.assertAlmostEqual(ends[1]["stress_yy"], 0, delta=1e-8 * METAL_P_WAVE)
        self.assertAlmostEqual(ends[2]["stress_yy"], 1e8, delta=1e-8 * METAL_P_WAVE)
        # The last step of the second leg is cut, and its time with it.
        self.assert_near(ends[1]["time"] - ends[0]["time"], 0.1, 1e-6)


class Soils(PathTest):
    def test_the_oedometers_modulus_is_that_of_a_plane_wave(self):
        rows = self.lead({**METAL, "sigma_y": 1e12}, {"test": "oedometer", "strain": -0.1, "steps": 4})
        for row in rows[1:]:
            self.assert_near(kirchhoff(row) / row["strain_axial"], METAL_P_WAVE, 1e-12)
            self.assertEqual((row["F_xx"], row["F_zz"], row["strain_lateral"]), (1, 1, 0))
        # Of any energy, at small strain.
        rubber = {"model": "neo_hookean", "youngs_modulus": 2e11, "poissons_ratio": 0.3}
        last = self.lead(rubber, {"test": "oedometer", "strain": -1e-6, "steps": 1})[-1]
        self.assert_near(last["stress_yy"] / -1e-6, METAL_P_WAVE, 1e-5)

    def test_an_isotropic_leg_reaches_its_pressure_evenly(self):
        rows = self.lead(SAND, {"test": "isotropic", "pressure": 1e5, "steps": 10})
        for k, row in enumerate(rows):
            for face in ("stress_xx", "stress_yy", "stress_zz"):
                self.assertAlmostEqual(row[face], -1e4 * k, delta=1e-12 * SAND_P_WAVE)
        # ln V = -p J / K, K = E / (3 - 6 nu).
        self.assert_near(rows[-1]["strain_volumetric"], -1e5 * rows[-1]["J"] / (5e7 / 1.2), 1e-9)

    def test_a_triaxial_test_of_sand_ends_on_the_cone(self):
        rows = self.lead(SAND, {"test": "isotropic", "pressure": 1e5},
                         {"test": "triaxial", "strain": -0.05, "lateral_pressure": 1e5})
        sheared = [row for row in rows if row["leg"] == 1]
        for face in ("stress_xx", "stress_zz"):
            self.assert_all_near((row[face] for row in sheared), -1e5, 1e-12 * SAND_P_WAVE)
        flowing = [row for row in sheared if row["branch"] == "cone"]
        self.assertGreater(len(flowing), 50)
        self.assert_all_near((row["q"] / row["p"] for row in flowing), cone(30), 1e-9)
        self.assertAlmostEqual(cone(30), 1.2)
        # q/p = 1.2 and p = 1e5 + q/3.
        self.assert_near(rows[-1]["q"], 2e5, 1e-9)

    def test_pressure_from_all_sides_after_a_deviator_is_reached_on_each_face(self):
        rows = self.lead(SAND, {"test": "isotropic", "pressure": 1e5}, {"test": "triaxial", "strain": -0.02},
                         {"test": "isotropic", "pressure": 3e5, "steps": 20})
        self.assertGreater(max(row["q"] for row in rows), 1.5e5)
        for face in ("stress_xx", "stress_yy", "stress_zz"):
            self.assertAlmostEqual(rows[-1][face], -3e5, delta=1e-8 * SAND_P_WAVE)

    def test_a_shear_box_keeps_the_normal_stress_and_slides_at_the_friction_of_plane_strain(self):
        rows = self.lead(SAND, {"test": "isotropic", "pressure": 1e5},
                         {"test": "simple_shear", "strain": 0.3, "steps": 600, "normal_pressure": 1e5})
        sheared = [row for row in rows if row["leg"] == 1]
        self.assert_all_near((row["stress_yy"] for row in sheared), -1e5, 1e-8 * SAND_P_WAVE)
        # In steady shear the deviator has the axes of the shear: tau / sigma = 3 a / sqrt(2) = (q/p) / sqrt(3), but for
        # the elastic strain, 0.3 %.
        self.assert_near(sheared[-1]["stress_xy"], 1e5 * cone(30) / math.sqrt(3), 5e-3)
        self.assertAlmostEqual(sheared[-1]["F_xy"] / sheared[-1]["F_yy"], 0.3)
        # Of a kept height instead: the normal stress goes where it likes.
        held = self.lead(SAND, {"test": "isotropic", "pressure": 1e5}, {"test": "simple_shear", "strain": 0.3})
        self.assertEqual(len({row["strain_axial"] for row in held if row["leg"] == 1}), 1)
        self.assertGreater(abs(held[-1]["stress_yy"] + 1e5), 100)

    def test_sides_that_differ_keep_each_its_own_stress(self):
        rows = self.lead(SAND, {"test": "isotropic", "pressure": 1e5},
                         {"test": "simple_shear", "strain": 0.1, "normal_pressure": 1e5},
                         {"test": "triaxial", "strain": -0.05})
        before = [row for row in rows if row["leg"] == 1][-1]
        self.assertGreater(abs(before["stress_xx"] - before["stress_zz"]), 100)
        for face in ("stress_xx", "stress_zz"):
            self.assert_all_near((row[face] for row in rows if row["leg"] == 2), before[face], 1e-8 * SAND_P_WAVE)

    def test_what_is_torn_keeps_its_width(self):
        rows = self.lead(CLAY, {"test": "uniaxial", "strain": 0.05})
        self.assert_all_near((row["stress_xx"] for row in rows), 0, 1e-8 * CLAY_P_WAVE)
        # Its sides carry nothing either if they are infinitely far away.
        self.assertLess(max(abs(row["strain_lateral"]) for row in rows), 0.05)
        self.assertGreater(max(row["stress_yy"] for row in rows), 1e5)
        self.assertLess(rows[-1]["stress_yy"], 100)

    def test_coarse_steps_across_a_yield_surface_are_solved(self):
        rows = self.lead(CLAY, {"test": "isotropic", "pressure": 1e4, "steps": 1},
                         {"test": "triaxial", "strain": -0.1, "lateral_pressure": 1e4, "steps": 3})
        self.assert_all_near((row["stress_xx"] for row in rows[1:]), -1e4, 1e-8 * CLAY_P_WAVE)

    def test_simple_shear_of_rubber_is_its_closed_form(self):
        rubber = {"model": "neo_hookean", "youngs_modulus": 2.6e6, "poissons_ratio": 0.3}  # mu = 1e6
        rows = self.lead(rubber, {"test": "simple_shear", "strain": 0.5, "steps": 5})
        for row in rows[1:]:
            self.assert_near(row["stress_xy"], 1e6 * row["gamma"], 1e-12)
            self.assert_near(row["stress_xx"], 1e6 * row["gamma"]**2, 1e-12)
            self.assert_near(row["psi"], 0.5e6 * row["gamma"]**2, 1e-12)
        self.assertNotIn("J_P", rows[0])

    def test_free_strains_do_what_the_tests_do(self):
        free = self.lead(SAND, {"test": "free", "strains": [0, -0.02, 0], "steps": 10})
        ring = self.lead(SAND, {"test": "oedometer", "strain": -0.02, "steps": 10})
        self.assertEqual(free, ring)


class Shipped(PathTest):
    def shipped(self, name):
        return self.rows(self.firn("element", os.path.join(SOURCE, "tools", "element", name + ".toml")).stdout)

    def test_copper_ends_on_the_hardening_curve_of_its_paper(self):
        rows = self.shipped("copper_uniaxial")
        for row in rows[100], rows[-1]:
            self.assert_near(kirchhoff(row), 90e6 + 292e6 * row["state_alpha"]**0.31, 1e-9)
        self.assert_near(rows[-1]["state_alpha"], 0.145, 0.02)

    def test_sand_is_on_the_cone_of_the_friction_it_has_gained(self):
        rows = self.shipped("sand_triaxial")
        for before, row in zip(rows, rows[1:]):
            if row["branch"] == "cone":
                # A step's return map takes the friction that was gained before it.
                q = before["state_q"]
                self.assert_near(row["q"] / row["p"], cone(35 + (300 * q - 10) * math.exp(-60 * q)), 1e-9)
        self.assertEqual(rows[-1]["branch"], "cone")

    def test_snow_stays_short_and_unloads_steeper_than_it_began(self):
        rows = self.shipped("snow_oedometer")
        first, let_go = rows[1], [row for row in rows if row["leg"] == 1]
        self.assertAlmostEqual(let_go[-1]["stress_yy"], 0, delta=1e-3)
        self.assertLess(let_go[-1]["strain_axial"], -0.15)
        slope = ((let_go[0]["stress_yy"] - let_go[1]["stress_yy"])
                 / (let_go[0]["strain_axial"] - let_go[1]["strain_axial"]))
        self.assertGreater(slope, 5 * first["stress_yy"] / first["strain_axial"])

    def test_the_picture_has_a_curve_of_stress_over_strain_and_one_of_q_over_p(self):
        paths = os.path.join(SOURCE, "tools", "element", "sand_triaxial.toml")
        self.firn("element", paths, "--out", "sand.csv", "--set", "legs.1.steps=30")
        with open(self.path("sand.csv"), encoding="utf-8") as text:
            rows = list(csv.DictReader(text))
        script = os.path.join(SOURCE, "tools", "scripts", "element_plot")
        subprocess.run([script, "sand.csv", "sand.svg"], check=True, cwd=self.folder)
        drawing = xml.etree.ElementTree.parse(self.path("sand.svg"))
        curves = [[tuple(map(float, point.split(","))) for point in line.get("points").split()]
                  for line in drawing.iter("{http://www.w3.org/2000/svg}polyline")]
        self.assertEqual([len(curve) for curve in curves], [len(rows)] * 2)
        words = ["".join(text.itertext()) for text in drawing.iter("{http://www.w3.org/2000/svg}text")]
        for expected in ("axial shortening (logarithmic)", "q (kPa)", "p (kPa)"):
            self.assertIn(expected, words)
        # q, both times; it is linear in p while the sides keep their pressure: q = 3 (p - 100 kPa).
        self.assertEqual([y for _, y in curves[0]], [y for _, y in curves[1]])
        a, b, c = (curves[1][k] for k in (21, 30, -1))
        self.assertAlmostEqual((b[0] - a[0]) * (c[1] - a[1]), (c[0] - a[0]) * (b[1] - a[1]), delta=30)
        done = subprocess.run([script, "sand.svg", "other.svg"], check=False, cwd=self.folder, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 3)

    def test_the_example_runs(self):
        example = self.write("example.toml", self.firn("element", "--example").stdout)
        rows = self.rows(self.firn("element", example).stdout)
        self.assertEqual(len(rows), 251)
        # And so does all that is commented out in it.
        with open(example, encoding="utf-8") as text:
            lines = text.read().replace("#until_stress = -2.5e5", "#").splitlines()
        alive = [line[1:] if line.startswith("#") and not line.startswith("# ") else line for line in lines]
        alive.insert(alive.index("# The other tests:"), '[[legs]]\ntest = "isotropic"\npressure = 0')
        text = "\n".join(alive).replace('test = "simple_shear"', 'test = "isotropic"\npressure = 1e5\n[[legs]]\n'
                                        'test = "simple_shear"')
        text = text.replace('model = "sand_klar_2016"', 'model = "von_mises"\npoissons_ratio = 0.3\nsigma_y = 1e7')
        self.firn("element", self.write("alive.toml", text.replace("h0 = 33", "H = 33")))


if __name__ == "__main__":
    main()
