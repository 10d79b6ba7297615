#!/usr/bin/python3
"""Each scene does what its description calls right. Numbers that may be tuned are read from the scene itself."""

import math
import os
import types

from firn_cli import SCENES, FirnTest, cache_rows, exported_points, main, run_record
from pieces import pieces
from scene_cases import SceneTest, scene, values


class Plans(FirnTest):
    def test_every_scene_plans_without_a_warning_and_says_what_is_right(self):
        names = sorted(name for name in os.listdir(SCENES) if name.endswith(".toml"))
        self.assertGreaterEqual(len(names), 3)
        for name in names:
            with self.subTest(name):
                plan = self.plan(os.path.join(SCENES, name))
                self.assertEqual(plan["warnings"], [])
                self.assertTrue(plan["title"])
                self.assertIn("Right:", values(name.removesuffix(".toml"))["description"])


class Snowball(SceneTest):
    def test_it_breaks_on_the_wall_and_stays_within_the_limits_of_snow(self):
        told = values("snowball")
        h, (snow,) = told["simulation"]["cell_size"], told["materials"].values()
        table = self.run_scene("snowball", "--set", 'output.attributes=["F_E","Jp","material"]')

        first, last = (exported_points(self.frame(number)) for number in (1, len(table)))
        per_cell = told["bodies"][0]["particles_per_cell"]
        self.assertEqual(len(self.pieces(first, h, per_cell)), 1, "it is whole before it hits")
        parts = self.pieces(last, h, per_cell)
        print(f"{len(parts)} pieces: {[len(part) for part in parts]} of {len(last)} particles", flush=True)
        self.assertGreaterEqual(len(parts), 2, "it breaks on the wall")
        for point in last:
            # The ground stops nodes. A particle deeper than the reach of its kernel, 1.5 cells, sees no other; the step
            # that takes it there is shorter than half a cell.
            self.assertGreater(point[1], -2 * h)

        rows = cache_rows(self.frame(len(table)))
        low, high = 1 - snow["theta_c"], 1 + snow["theta_s"]
        # F_E is stored as the product of three float matrices: some units in the last place beyond the limits.
        rounding = 1e-6
        for row in rows:
            self.assertTrue(singular_values_within(row, low - rounding, high + rounding), row)
        yielded = sum(not singular_values_within(row, low + rounding, high - rounding) for row in rows)
        self.assertGreater(yielded, 0.1 * len(rows), "much of it should have yielded")


class ElasticCubes(SceneTest):
    def test_they_part_whole_and_keep_their_momentum(self):
        told = values("elastic_cubes")
        table = self.run_scene("elastic_cubes")
        start = table[0]
        scale = start["mass"] * start["max_speed"]
        for row in table:
            for axis in "xyz":
                # Sums of float momenta over thousands of steps.
                self.assertLess(abs(row["momentum_" + axis] - start["momentum_" + axis]), 1e-5 * scale)
                # The same at an arm of one metre, about the size of the scene.
                self.assertLess(abs(row["angular_" + axis] - start["angular_" + axis]), 1e-5 * scale)
            # What is elastic gives back at most what it took, and transfer only takes; steps of finite size add
            # up to a thousandth.
            self.assertLess(row["total"], start["total"] * 1.001)
        self.assertGreater(max(row["elastic"] for row in table), 0.01 * start["kinetic"], "they do collide")

        parts = pieces(exported_points(self.frame(len(table))), 1.5 * told["simulation"]["cell_size"])
        bodies = self.plan(scene("elastic_cubes"))["bodies"]
        self.assertEqual(sorted(map(len, parts)), sorted(body["particles"] for body in bodies))


class Footprint(SceneTest):
    def test_the_print_stays_and_the_snow_beside_it_too(self):
        self.run_scene("footprint")
        count = len(run_record(self.out)["frames"])
        down = values("footprint")["colliders"][0]["keyframes"][2]["time"]
        pressed = cache_rows(self.frame(1 + math.ceil(down * values("footprint")["simulation"]["frame_rate"])))
        first, last = cache_rows(self.frame(1)), cache_rows(self.frame(count))

        def sole(rows):
            return [row for row in rows if abs(row["x"]) < 0.08 and abs(row["z"]) < 0.03]

        def beside(rows):
            return [row for row in rows if abs(row["x"]) > 0.22]

        def top(rows):
            # But for the topmost twentieth: some get a cell or two into the boot, where the grid holds them.
            return sorted(row["y"] for row in rows)[int(0.95 * len(rows))]

        cell = values("footprint")["simulation"]["cell_size"]
        # The boot goes 7 cm down; contact is sharp to a cell.
        self.assertGreater(top(first) - top(sole(pressed)), 0.07 - 1.5 * cell)
        self.assertLess(top(sole(last)) - top(sole(pressed)), 0.01, "it springs back")
        self.assertLess(sum(row["Jp"] for row in sole(last)) / len(sole(last)), 0.8)
        self.assertLess(abs(top(beside(last)) - top(beside(first))), 0.1 * cell)


class RollingSnowball(SceneTest):
    def test_it_rolls_stays_whole_and_wears_the_layer_as_a_coat(self):
        self.run_scene("rolling_snowball")
        radius = values("rolling_snowball")["bodies"][0]["shape"]["radius"]
        start, end = (self.ball(number) for number in (1, len(run_record(self.out)["frames"])))
        self.assertAlmostEqual(start.rolls_on, radius, delta=0.01)
        self.assertEqual(start.coat, 0)
        self.assertGreater(end.rolls_on, 1.15 * radius, "it grows")
        self.assertLess(end.rolls_on, 2 * radius, "it turns")
        self.assertLess(end.size, 1.1 * start.size, "it stays whole")
        # As many grains as a tenth of its own area.
        self.assertGreater(end.coat, 0.1 * start.grains)
        self.assertGreater(end.x - start.x, 10 * radius)

    def ball(self, number):
        rows = cache_rows(self.frame(number))
        own = [row for row in rows if row["material"] == 0]
        x, y, vx, vy = (sum(row[name] for row in own) / len(own) for name in ("x", "y", "vx", "vy"))
        inertia = sum((row["x"] - x)**2 + (row["y"] - y)**2 for row in own)
        spin = sum((row["x"] - x) * (row["vy"] - vy) - (row["y"] - y) * (row["vx"] - vx) for row in own) / inertia
        distances = sorted(math.hypot(row["x"] - x, row["y"] - y) for row in own)
        coat = [row for row in rows if row["material"] == 1 and row["y"] > 0.08
                and math.hypot(row["x"] - x, row["y"] - y) < 0.18]
        return types.SimpleNamespace(x=x, rolls_on=-vx / spin, size=distances[int(0.95 * len(own))], coat=len(coat),
                                     grains=len(own))


class SnowOnWedge(SceneTest):
    def test_a_coarse_slab_splits_on_the_edge_and_stays_above_the_ground(self):
        h = 0.06
        wedge = next(c for c in values("snow_on_wedge")["colliders"] if c["name"] == "wedge")
        edge = wedge["shape"]["translate"][0]
        table = self.run_scene("snow_on_wedge", "--set", f"simulation.cell_size={h}")
        points = exported_points(self.frame(len(table)))
        self.assertEqual(len(points), table[0]["particles"])
        for point in points:
            self.assertTrue(all(map(math.isfinite, point)))
            self.assertGreater(point[1], -h / 2)
        for side in (-1, 1):
            there = sum(side * (point[0] - edge) > h for point in points)
            self.assertGreater(there, 0.2 * len(points), "both halves should have left the edge")
        halves = [piece for piece in pieces(points, 1.5 * h) if len(piece) >= 0.1 * len(points)]
        self.assertEqual(len(halves), 2)


def singular_values_within(row, low, high):
    """Whether low <= s <= high for every singular value s of F_E: F^T F - low^2 and high^2 - F^T F have no negative
    eigenvalue."""
    F = [[row[f"F{i}{j}"] for j in range(3)] for i in range(3)]
    C = [[sum(F[k][i] * F[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    return (positive([[C[i][j] - (i == j) * low * low for j in range(3)] for i in range(3)]) and
            positive([[(i == j) * high * high - C[i][j] for j in range(3)] for i in range(3)]))


def positive(A):
    """Positive definite, by Sylvester's criterion."""
    minor = A[0][0] * A[1][1] - A[0][1] * A[1][0]
    determinant = (A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) -
                   A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
                   A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]))
    return A[0][0] > 0 and minor > 0 and determinant > 0


if __name__ == "__main__":
    main()
