"""A column of sand is let go and collapses onto a rough floor."""

import collections
import math
import types


def angle_for(friction):
    """The friction angle h0 (degrees) with which plane sand slides at the slope `friction`: tau / p = sqrt(2) a."""
    share = friction / (2 * math.sqrt(4 / 3))  # sin phi / (3 - sin phi)
    return math.degrees(math.asin(3 * share / (1 + share)))


def scene(aspect, cells=30, friction=math.tan(math.radians(30)), stiffness=100, times=6, transfer="apic", per_cell=4):
    """Half a column of width d0 = 0.1 m beside a smooth wall, of height aspect d0.

    The weight of the column shortens its foot by 1 / stiffness. It runs for `times` sqrt(height / g).
    """
    d0, gravity, density = 0.1, 9.81, 1500
    height = aspect * d0
    reach = d0 * (2.5 + 3 * max(1.2 * aspect, 1.9 * aspect**(2 / 3)))
    duration = times * math.sqrt(height / gravity)
    return f"""
[simulation]
dimension = 2
cell_size = {d0 / cells}
duration = {duration}
frame_rate = {20 / duration}
transfer = "{transfer}"
[gravity]
acceleration = [0, -{gravity}, 0]
[materials.sand]
model = "sand_klar_2016"
density = {density}
youngs_modulus = {stiffness * density * gravity * height}
h0 = {angle_for(friction)}
h1 = 0
h3 = 0
[[bodies]]
name = "column"
material = "sand"
particles_per_cell = {per_cell}
shape = {{ type = "box", min = [0, 0, 0], max = [{d0}, {height}, 0] }}
[domain]
min = [0, -1, 0]
max = [{reach}, {2 * height}, 0]
contact = "slip"
[[colliders]]
name = "floor"
shape = {{ type = "plane", point = [0, 0, 0], normal = [0, 1, 0] }}
contact = "sticky"
"""


def measure(points, aspect, cells):
    """Run-out and height, over d0, of the deposit.

    In strips two cells wide, from the wall on: the deposit ends where the sand, as dense as it was at the start, would
    be less than half a cell thick, which is one layer of particles. Its height is that below which 99 % of the sand at
    the wall lies.
    """
    d0 = 0.1
    width = 2 * d0 / cells
    area = d0 * d0 * aspect / len(points)
    counts = collections.Counter(int(x // width) for x, _, _ in points)
    strip = 0
    while counts[strip] * area / width > 0.5 * d0 / cells:
        strip += 1
    top = sorted(y for x, y, _ in points if x < 2 * width)
    return types.SimpleNamespace(runout=strip * width / d0 - 1, height=top[int(0.99 * len(top))] / d0)
