#!/usr/bin/python3
"""Quick slices of the experiments in tests/validation, coarser than those of its table, and each with a wrong law that
must miss; and the scenes that show them."""

import math
import os
import sys

from firn_cli import SOURCE, cache_rows, exported_points, main
from scene_cases import SceneTest, values

sys.path.insert(0, os.path.join(SOURCE, "tests", "validation"))

import column  # noqa: E402
import landings  # noqa: E402
import slope  # noqa: E402
import taylor  # noqa: E402
from experiment import attribute  # noqa: E402


class ExperimentTest(SceneTest):
    def tracked(self, number):
        """The points of a frame in the order of their ids."""
        rows = sorted(cache_rows(self.frame(number)), key=lambda row: row["id"])
        return [(row["x"], row["y"], row["z"]) for row in rows]

    def assert_near(self, value, expected, share):
        print(f"{value:.4g}, expected {expected:.4g}", flush=True)
        self.assertAlmostEqual(value, expected, delta=share * expected)


class Columns(ExperimentTest):
    CELLS = 15

    def deposit(self, aspect, **options):
        table = self.run_text(column.scene(aspect, self.CELLS, **options))
        self.assertLess(table[-1]["kinetic"], 1e-3 * max(row["kinetic"] for row in table), "it has come to rest")
        return column.measure(exported_points(self.frame(len(table))), aspect, self.CELLS)

    def test_low_and_tall_columns_run_out_as_far_as_in_experiments(self):
        low, tall = self.deposit(1), self.deposit(4)
        # The gates of the whole series; two cells, a seventh of d0, are what the front is known to.
        self.assert_near(low.runout, 1.2, 0.2)
        self.assert_near(tall.runout, 1.9 * 4**(2 / 3), 0.25)
        self.assert_near(low.height, 1, 0.2)
        self.assert_near(tall.height, 4**(1 / 3), 0.25)

    def test_control_half_the_friction_runs_out_too_far(self):
        wrong = self.deposit(2, friction=math.tan(math.radians(30)) / 2)
        self.assertGreater(wrong.runout, 1.25 * 1.9 * 2**(2 / 3))
        self.assertLess(wrong.height, 0.8 * 2**(1 / 3))


class Slopes(ExperimentTest):
    # The wall below holds so short a layer up to 1.5 degrees more; the flow is asked for above that.
    LENGTH, CELLS = 40, 6

    def creep(self, angle, phi=30):
        table = self.run_text(slope.scene(angle, phi, self.CELLS, self.LENGTH))
        mean, most = slope.creep(self.tracked(6), self.tracked(len(table)), self.LENGTH)
        print(f"{angle} degrees, phi {phi}: {mean:.1e} and at most {most:.1e} H", flush=True)
        return mean, most

    def test_sand_stays_below_its_angle_and_flows_above(self):
        # tan is sqrt(2) a = 0.4619 in the plane: 24.8 degrees.
        self.assertLess(self.creep(23.8)[1], 1e-3)
        self.assertGreater(self.creep(27.3)[0], 1e-2)

    def test_control_five_degrees_less_friction_flow(self):
        self.assertGreater(self.creep(23.8, phi=25)[0], 1e-2)


class TaylorBars(ExperimentTest):
    def bar(self, bar, cells):
        table = self.run_text(taylor.scene(bar, cells))
        got = taylor.measure(bar, cells, self.tracked(1), self.tracked(len(table)))
        got.strain = max(attribute(self.frame(len(table)), "alpha"))
        print(f"length {1e3 * got.length:.2f}, foot {1e3 * got.mushroom:.2f}, at a fifth {1e3 * got.fifth:.2f} mm, "
              f"strain {got.strain:.2f}", flush=True)
        return got

    def test_the_bar_of_other_programs(self):
        got = self.bar(taylor.SMOOTH, 6)
        # The middle of what other programs find: 21.4 to 21.7 and 7.0 to 7.2 mm, strains of 2.5 to 3.2.
        self.assert_near(got.length, 21.55e-3, 0.03)
        self.assert_near(got.mushroom, 7.1e-3, 0.06)
        self.assert_near(got.strain, 2.85, 0.2)

    def test_johnson_and_cooks_bar_is_as_wide_as_theirs_but_longer_unless_rates_are_left_out(self):
        got = self.bar(taylor.JOHNSON_COOK, 6)
        # 16.2 mm long, 13.5 mm thick at the foot and 10.1 mm at a fifth in the experiment.
        # The length misses its gate of 3 %, and at a fifth the bar is on its gate of 6 %: see
        # tests/validation/README.md. Here the cells are coarser than there.
        self.assert_near(got.length, 16.2e-3, 0.1)
        self.assert_near(2 * got.mushroom, 13.5e-3, 0.08)
        self.assert_near(2 * got.fifth, 10.1e-3, 0.08)
        without_rate = self.bar(taylor.WITHOUT_RATE, 6)
        # A quarter more stress at 1e4 a second, times the shortening.
        self.assertLess(without_rate.length, got.length - 0.7e-3)


class Landings(ExperimentTest):
    def land(self, correction):
        table = self.run_text(landings.scene(5, correction, 16))
        first, last = (landings.spread(exported_points(self.frame(number))) for number in (1, len(table)))
        low, high = landings.opening_under_load(cache_rows(self.frame(len(table))))
        print(f"volume correction {correction}: {last / first:.4f} of the height, J_P under load {low:.5f} to {high:.5f}",
              flush=True)
        return last / first, low, high

    def test_sand_that_lands_again_and_again_swells_only_without_the_correction_of_volume(self):
        swelling, low, high = self.land(True)
        # What bears has closed: J_P is 1 but for the round-off of a product of some ten thousand float matrices.
        self.assertGreater(low, 1 - 1e-4)
        self.assertLess(high, 1 + 1e-4)
        self.assertLess(abs(swelling - 1), 0.01)
        swelling, _, high = self.land(False)
        self.assertGreater(high, 1.5)
        self.assertGreater(swelling, 1.2)


class Scenes(ExperimentTest):
    def test_the_column_leaves_a_heap_of_its_own_size(self):
        table = self.run_scene("sand_column")
        (d0, height, _) = values("sand_column")["bodies"][0]["shape"]["max"]
        cells = round(d0 / values("sand_column")["simulation"]["cell_size"])
        points = exported_points(self.frame(len(table)))
        got = column.measure(points, height / d0, cells)
        self.assert_near(got.runout, 5.2, 0.1)
        self.assert_near(got.height, 1.6, 0.05)
        # At rest since 1.2 s: a thousandth of the fastest.
        rest = [row["kinetic"] for row in table if row["time"] > 1.2]
        self.assertLess(max(rest), 1e-3 * max(row["kinetic"] for row in table))

    def test_the_bar_becomes_a_mushroom(self):
        bar, cells = taylor.SMOOTH, 5
        table = self.run_scene("taylor_bar", "--set", f"simulation.cell_size={bar.radius / cells}")
        got = taylor.measure(bar, cells, self.tracked(1), self.tracked(len(table)))
        self.assert_near(got.length, 21.55e-3, 0.03)
        self.assert_near(got.mushroom, 7.1e-3, 0.06)
        self.assertGreater(table[-1]["momentum_y"], 0, "it bounces off")


if __name__ == "__main__":
    main()
