#!/usr/bin/python3
"""A cache read back by programs that share no code with its writer.

vdb_tool knows positions only, so ids and the other attributes come from OpenVDB's reader; both walk the points in the
order of the file, and agree on each position.
"""

import math
import os

from firn_cli import SCENES, SNOW, FirnTest, cache_rows, diagnostics, exported_points, frame_name, main

MESH = os.path.join(SCENES, "meshes", "snowball.obj")
FLOAT = 2.0 ** -23  # twice the rounding of a float, relative
IDENTITY = {f"F{i}{j}": float(i == j) for i in range(3) for j in range(3)}

BALL = """
[simulation]
cell_size = 0.05
duration = 0.025
frame_rate = 40
[materials.snow]
model = "snow_stomakhin_2013"
[[bodies]]
name = "ball"
material = "snow"
shape = { type = "mesh", file = "snowball.obj" }
velocity = [-12, 1, 0]
[[colliders]]
name = "wall"
shape = { type = "plane", point = [-0.2, 0, 0], normal = [1, 0, 0] }
[output]
attributes = ["F_E", "Jp", "material"]
"""


def read_obj(file):
    """Vertices, and triangles of a mesh of polygons."""
    vertices, triangles = [], []
    with open(file, encoding="utf-8") as text:
        for line in text:
            kind, *rest = line.split() or [""]
            if kind == "v":
                vertices.append([float(x) for x in rest[:3]])
            elif kind == "f":
                corners = [int(corner.split("/")[0]) - 1 for corner in rest]
                triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
    return vertices, triangles


def volume(vertices, triangles):
    """By the divergence theorem."""
    total = 0
    for a, b, c in ([vertices[k] for k in triangle] for triangle in triangles):
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]))
    return total / 6


def position(row):
    return [row[axis] for axis in "xyz"]


class Mesh(FirnTest):
    def setUp(self):
        super().setUp()
        with open(MESH, encoding="utf-8") as mesh:
            self.write("snowball.obj", mesh.read())
        self.scene, self.out = self.write("ball.toml", BALL), self.path("out")
        self.firn("run", self.scene, "--out", self.out)
        self.table = diagnostics(self.out)[1]

    def frame(self, number):
        return os.path.join(self.out, frame_name(number))


class Exported(Mesh):
    def test_every_frame_holds_every_particle_where_the_reader_sees_it(self):
        for row in self.table:
            rows, points = cache_rows(self.frame(int(row["frame"]))), exported_points(self.frame(int(row["frame"])))
            self.assertEqual(len(rows), row["particles"])
            self.assertEqual(len(points), row["particles"])
            self.assertEqual(sorted(particle["id"] for particle in rows), list(range(len(rows))))
            by_id = {int(particle["id"]): (position(particle), point) for particle, point in zip(rows, points)}
            for identity, (there, exported) in by_id.items():
                for x, y in zip(there, exported):
                    # The exporter rounds to float in between, at the size of the bodies: 1 m at most.
                    self.assertAlmostEqual(x, y, delta=2 * FLOAT, msg=f"particle {identity}")

    def test_the_first_frame_is_the_seeding(self):
        vertices, triangles = read_obj(MESH)
        low, high = ([side(vertex[axis] for vertex in vertices) for axis in range(3)] for side in (min, max))
        points = exported_points(self.frame(1))
        for point in points:
            for x, a, b in zip(point, low, high):
                # The level set of the mesh interpolates: a tenth of a cell at most.
                self.assertTrue(a - 0.005 <= x <= b + 0.005, point)
        self.assertAlmostEqual(self.table[0]["mass"] / (400 * volume(vertices, triangles)), 1, delta=0.01)
        centre = [sum(point[axis] for point in points) / len(points) for axis in range(3)]
        for x, a, b in zip(centre, low, high):
            # Nearly a ball: its centre of mass is the middle of its bounds to a few percent.
            self.assertAlmostEqual(x, (a + b) / 2, delta=0.1 * (b - a))
        self.assertEqual(len(set(points)), len(points), "two particles in one place")


class Rows(Mesh):
    def test_attributes_start_at_rest_and_fit_the_diagnostics(self):
        first = cache_rows(self.frame(1))
        for row in first:
            self.assertEqual({name: row[name] for name in IDENTITY}, IDENTITY)
            self.assertEqual((row["Jp"], row["material"]), (1, 0))
            self.assertEqual((row["vx"], row["vy"], row["vz"]), (-12, 1, 0))
            self.assertGreater(row["pscale"], 0)

        last, totals = cache_rows(self.frame(len(self.table))), self.table[-1]
        for axis in "xyz":
            # All particles weigh the same here.
            mean = math.fsum(row["v" + axis] for row in last) / len(last)
            # Particles lose no momentum in being written; a float each, of at most max_speed.
            self.assertAlmostEqual(mean, totals["momentum_" + axis] / totals["mass"],
                                   delta=4 * FLOAT * totals["max_speed"])
        fastest = max(math.hypot(row["vx"], row["vy"], row["vz"]) for row in last)
        self.assertAlmostEqual(fastest / totals["max_speed"], 1, delta=2 * FLOAT)
        self.assertNotEqual({row["Jp"] for row in last}, {1.0}, "the wall should have packed some snow")
        self.assertTrue(any(row["F01"] != 0 for row in last))

    def test_an_id_stays_with_its_particle(self):
        before, after = ({row["id"]: row for row in cache_rows(self.frame(number))} for number in (1, 2))
        self.assertEqual(before.keys(), after.keys())
        reach = self.table[1]["time"] * max(row["max_speed"] for row in self.table) * 1.1
        for identity, row in before.items():
            self.assertLess(math.dist(position(row), position(after[identity])), reach)
        # Far from the wall the ball still flies as it was thrown.
        still = [identity for identity, row in after.items() if row["vx"] == -12 and row["vy"] == 1]
        for identity in still:
            moved = [b - a for a, b in zip(position(before[identity]), position(after[identity]))]
            for x, v in zip(moved, (-12, 1, 0)):
                self.assertAlmostEqual(x, v * self.table[1]["time"], delta=1e-5)


class Points(FirnTest):
    def test_points_from_a_file_come_back_in_their_order_as_ids(self):
        wanted = [(0.013 * k % 0.4, 0.4 + 0.017 * k % 0.3, 0.011 * k % 0.2) for k in range(500)]
        self.write("points.csv", "x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in wanted))
        shape = 'shape = { type = "sphere", center = [0, 0.26, 0], radius = 0.25 }'
        self.assertIn(shape, SNOW)
        scene, out = self.write("points.toml", SNOW.replace(shape, 'points = "points.csv"')), self.path("out")
        self.firn("run", scene, "--out", out, "--frames", "1:1")
        frame = os.path.join(out, frame_name(1))
        rows, points = cache_rows(frame), exported_points(frame)
        self.assertEqual(sorted(row["id"] for row in rows), list(range(len(wanted))))
        for row, point in zip(rows, points):
            for x, seen, exported in zip(wanted[int(row["id"])], position(row), point):
                # Held as a float below 1 m, stored to 3e-8 of a voxel.
                self.assertAlmostEqual(x, seen, delta=FLOAT)
                self.assertAlmostEqual(x, exported, delta=2 * FLOAT)


if __name__ == "__main__":
    main()
