#!/usr/bin/env python3
"""Makes the picture of a foam beside this file, for scenes/foam.toml: bright walls between dark pores. Plain Python,
same bytes on every run.

The pores are the Voronoi cells of points on a staggered lattice, each moved a little at random, so that no wall has a
twin and they do not all buckle at once. The foam ends above and below in a skin, which lies flat against the plates.
"""
import math
import os
import random

HERE = os.path.dirname(os.path.abspath(__file__))
PIXELS = 256  # across and up
ROWS = 7  # of pores
COLUMNS = 6
DISORDER = 0.22  # largest move of a point along each axis, of the distance of columns
SOLID = 0.30  # share of the picture that is bright, skins included
SEED = 4


def pore_centers(dice):
    """In pixels; also beyond the picture, whose outermost pores are cut open at its sides."""
    across, up = PIXELS / COLUMNS, PIXELS / ROWS
    for row in range(-1, ROWS + 1):
        for column in range(-1, COLUMNS + 1):
            shift = 0.25 if row % 2 else 0.75
            x = across * (column + shift + dice.uniform(-DISORDER, DISORDER))
            y = up * (row + 0.5) + across * dice.uniform(-DISORDER, DISORDER)
            yield x, y


def distances_to_walls(centers):
    """For each pixel, row by row from the top, how far it is from the middle of the nearest wall or skin, in pixels."""
    for j in range(PIXELS):
        for i in range(PIXELS):
            x, y = i + 0.5, PIXELS - j - 0.5
            near = sorted(((x - a) ** 2 + (y - b) ** 2, a, b) for a, b in centers)[:4]
            own, others = near[0], near[1:]
            wall = min((other[0] - own[0]) / (2 * math.dist(own[1:], other[1:])) for other in others)
            # The middle of a skin is the picture's edge: only half of it is in.
            yield min(wall, y, PIXELS - y)


def brightness(distance, thickness):
    """Solid where it is at least a half; grey on the edge, so that the edge is known to a part of a pixel."""
    return min(1.0, max(0.0, 0.5 + thickness / 2 - distance))


def wall_thickness(distances):
    """For which the share SOLID of the picture is bright."""
    low, high = 0.0, float(PIXELS)
    for _ in range(40):
        middle = (low + high) / 2
        if sum(brightness(d, middle) for d in distances) < SOLID * len(distances):
            low = middle
        else:
            high = middle
    return low


def main():
    centers = list(pore_centers(random.Random(SEED)))
    distances = list(distances_to_walls(centers))
    thickness = wall_thickness(distances)
    with open(os.path.join(HERE, "foam.pgm"), "wb") as out:
        out.write(b"P5\n# made by make_foam.py\n%d %d\n255\n" % (PIXELS, PIXELS))
        out.write(bytes(round(255 * brightness(d, thickness)) for d in distances))
    print(f"foam.pgm: walls {thickness:.1f} pixels thick")


if __name__ == "__main__":
    main()
