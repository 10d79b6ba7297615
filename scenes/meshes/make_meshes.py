#!/usr/bin/env python3
"""Makes the meshes of the example scenes beside this file. Plain Python, same bytes on every run.

Both are closed, Y-up, in metres and stand for snow that was shaped by hand: a few broad dents, no detail finer than
the cells of the scenes that use them.
"""
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
GOLDEN = (1 + math.sqrt(5)) / 2


def write_obj(name, title, vertices, triangles):
    with open(os.path.join(HERE, name), "w", encoding="ascii", newline="\n") as out:
        out.write(f"# {title}; made by make_meshes.py\no {name[:-4]}\n")
        for x, y, z in vertices:
            # Adding zero turns -0 into 0.
            out.write(f"v {round(x, 5) + 0:.5f} {round(y, 5) + 0:.5f} {round(z, 5) + 0:.5f}\n")
        for a, b, c in triangles:
            out.write(f"f {a + 1} {b + 1} {c + 1}\n")


def normalized(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def icosphere(n):
    """A unit icosahedron with every edge cut into n parts: (vertices, triangles facing out)."""
    corners = []
    for a in (-1, 1):
        for b in (-GOLDEN, GOLDEN):
            corners += [(0, a, b), (a, b, 0), (b, 0, a)]
    near = lambda p, q: abs(sum((s - t) ** 2 for s, t in zip(p, q)) - 4) < 1e-9
    faces = [(i, j, k) for i in range(12) for j in range(i) for k in range(j)
             if near(corners[i], corners[j]) and near(corners[j], corners[k]) and near(corners[k], corners[i])]
    index, vertices, triangles = {}, [], []

    def vertex(weights):
        # Keyed by exact integer weights of the corners, so shared edges share vertices.
        key = tuple(sorted((corner, w) for corner, w in weights if w))
        if key not in index:
            index[key] = len(vertices)
            vertices.append(normalized([sum(w * corners[c][axis] for c, w in key) for axis in range(3)]))
        return index[key]

    for a, b, c in faces:
        at = lambda i, j: vertex([(a, n - i - j), (b, i), (c, j)])
        for i in range(n):
            for j in range(n - i):
                triangles.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j + 1 < n:
                    triangles.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return vertices, [outward(vertices, t) for t in triangles]


def outward(vertices, t):
    a, b, c = (vertices[i] for i in t)
    volume = (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
    return t if volume > 0 else (t[0], t[2], t[1])


class Bumps:
    """A smooth function of direction, about within [-1, 1]: plane waves in fixed random directions."""

    def __init__(self, seed, waves):
        self.state = seed
        self.waves = []
        for frequency, amplitude in waves:
            direction = normalized([self.random() - 0.5 for _ in range(3)])
            self.waves.append(([frequency * c for c in direction], 2 * math.pi * self.random(), amplitude))

    def random(self):
        self.state = (6364136223846793005 * self.state + 1442695040888963407) % 2**64
        return (self.state >> 33) / 2**31

    def __call__(self, v):
        return sum(a * math.sin(sum(k * c for k, c in zip(wave, v)) + phase) for wave, phase, a in self.waves)


def snowball(radius=0.2):
    bumps = Bumps(2013, [(3, 0.30), (3, 0.25), (5, 0.22), (6, 0.20), (8, 0.16), (9, 0.14), (12, 0.10), (14, 0.09), (17, 0.06)])
    vertices, triangles = icosphere(24)
    moved = [tuple(radius * (1 + 0.06 * bumps(v)) * c for c in v) for v in vertices]
    write_obj("snowball.obj", "A hand-pressed snowball, about 0.4 m across", moved, triangles)


def snowman(rows=72, columns=64):
    """Three balls in one another, as a single surface of revolution with dents. Stands on y = 0."""
    balls = [(0.26, 0.24), (0.60, 0.18), (0.86, 0.125)]  # height of the middle, radius
    bottom, top = 0.03, balls[2][0] + balls[2][1]  # pressed flat at the bottom by its weight

    def radius(y):
        return max(math.sqrt(max(r * r - (y - h) ** 2, 0)) for h, r in balls)

    bumps = Bumps(1605, [(6, 0.3), (9, 0.3), (13, 0.2), (17, 0.2), (23, 0.1), (29, 0.1)])
    vertices = [(0, 0, 0)]
    for i in range(rows + 1):
        # Rows close together at both ends, where the surface turns over; the last one keeps off the pole.
        y = bottom + (top - bottom) * 0.5 * (1 - math.cos(math.pi * i / (rows + 0.5)))
        for j in range(columns):
            angle = 2 * math.pi * j / columns
            p = (radius(y) * math.cos(angle), y, radius(y) * math.sin(angle))
            dent = 1 + 0.04 * bumps(p)
            vertices.append((p[0] * dent, p[1] - bottom, p[2] * dent))
    vertices.append((0, top - bottom, 0))
    ring = lambda i, j: 1 + i * columns + j % columns
    triangles = []
    for j in range(columns):
        triangles.append((0, ring(0, j), ring(0, j + 1)))
        triangles.append((len(vertices) - 1, ring(rows, j + 1), ring(rows, j)))
        for i in range(rows):
            triangles.append((ring(i, j), ring(i + 1, j), ring(i + 1, j + 1)))
            triangles.append((ring(i, j), ring(i + 1, j + 1), ring(i, j + 1)))
    write_obj("snowman.obj", "A snowman of three balls, 1 m tall", vertices, triangles)


if __name__ == "__main__":
    snowball()
    snowman()
