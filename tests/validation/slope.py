"""A layer of sand on a rough plane that is tilted: gravity is, the plane stays."""

import math

DEPTH = 0.1
GRAVITY = 9.81
TIME = math.sqrt(DEPTH / GRAVITY)


def scene(angle, phi=30, cells=10, length=30, dimension=2, stiffness=1000, precision="float"):
    """Angles in degrees; `cells` in the layer's depth H, `length` in depths. The layer runs for 15 sqrt(H / g), with a
    frame each sqrt(H / g). In 3D it is four cells wide, between smooth walls."""
    width = 4 * DEPTH / cells if dimension == 3 else 0
    reach = length * DEPTH
    tilt = math.radians(angle)
    return f"""
[simulation]
dimension = {dimension}
cell_size = {DEPTH / cells}
duration = {15 * TIME}
frame_rate = {1 / TIME}
precision = "{precision}"
[gravity]
acceleration = [{GRAVITY * math.sin(tilt)}, {-GRAVITY * math.cos(tilt)}, 0]
[materials.sand]
model = "sand_klar_2016"
density = 1500
youngs_modulus = {stiffness * 1500 * GRAVITY * DEPTH}
h0 = {phi}
h1 = 0
h3 = 0
[[bodies]]
name = "layer"
material = "sand"
particles_per_cell = {2**dimension}
sampling = "lattice"
shape = {{ type = "box", min = [0, 0, 0], max = [{reach}, {DEPTH}, {width}] }}
[domain]
min = [0, -1, 0]
max = [{reach}, 1, {width}]
contact = "slip"
[[colliders]]
name = "floor"
shape = {{ type = "plane", point = [0, 0, 0], normal = [0, 1, 0] }}
contact = "sticky"
[output]
attributes = ["F_E", "Jp", "material"]  # for the program that reads frames
"""


def creep(before, after, length=30):
    """Mean and largest way downhill, in depths, of the points that began in the middle fifth, from one frame to another.

    From the fifth of the frames to the last, ten sqrt(H / g) later: the layer has settled under its sudden weight.
    """
    low, high = 0.4 * length * DEPTH, 0.6 * length * DEPTH
    way = [(q[0] - p[0]) / DEPTH for p, q in zip(before, after) if low < p[0] < high]
    return sum(way) / len(way), max(way)
