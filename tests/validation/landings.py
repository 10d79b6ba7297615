"""A bed of sand in a smooth box is dropped onto its floor again and again."""

import math

GRAVITY = 9.81
WIDTH, DEPTH = 0.2, 0.1
# m, and s for a landing and all that goes with it.
THROW = 0.02
CYCLE = 0.5


def scene(landings, correction, cells=10, stiffness=100, frames_per_cycle=1, precision="float"):
    """The floor of the box is lowered by THROW in a hundredth of a second and stops: the bed, left behind, falls onto it.
    Then it is raised again, slowly."""
    keys = [(0, 0)]
    for k in range(landings):
        start = 0.2 + CYCLE * k
        keys += [(start, 0), (start + 0.01, -THROW), (start + 0.2, -THROW), (start + 0.42, 0)]
    end = 0.2 + CYCLE * landings
    keys.append((end + 0.1, 0))
    motion = "".join(f"[[colliders.keyframes]]\ntime = {time:.6g}\nposition = [0, {y:.6g}, 0]\n" for time, y in keys)
    return f"""
[simulation]
dimension = 2
precision = "{precision}"
cell_size = {DEPTH / cells}
duration = {end}
frame_rate = {frames_per_cycle / CYCLE}
[gravity]
acceleration = [0, -{GRAVITY}, 0]
[materials.sand]
model = "sand_klar_2016"
density = 1500
youngs_modulus = {stiffness * 1500 * GRAVITY * DEPTH}
h0 = 35
h1 = 0
h3 = 0
volume_correction = {str(correction).lower()}
[[bodies]]
name = "bed"
material = "sand"
particles_per_cell = 4
shape = {{ type = "box", min = [0, 0, 0], max = [{WIDTH}, {DEPTH}, 0] }}
[domain]
min = [0, -1, 0]
max = [{WIDTH}, 1, 0]
contact = "slip"
[output]
attributes = ["F_E", "Jp", "material"]  # for the program that reads frames
[[colliders]]
name = "floor"
shape = {{ type = "box", min = [-1, -0.5, 0], max = [{2 * WIDTH}, 0, 0] }}
contact = "separating"
{motion}
"""


def spread(points):
    """Height of the middle half of the bed: what stands off the floor, as matter does by a cell, and what was spilled on
    top do not count."""
    heights = sorted(y for _, y, _ in points)
    return heights[3 * len(heights) // 4] - heights[len(heights) // 4]


def volume(rows):
    """Median of det F."""
    volumes = sorted((row["F00"] * row["F11"] - row["F01"] * row["F10"]) * row["Jp"] for row in rows)
    return volumes[len(volumes) // 2]


def opening_under_load(rows):
    """Least and largest J_P, by which points stay open, of those that bear pressure."""
    opening = [row["Jp"] for row in rows if row["F00"] * row["F11"] - row["F01"] * row["F10"] < 1 - 1e-5]
    return min(opening), max(opening)
