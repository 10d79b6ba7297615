"""Taylor's bar: a copper cylinder flies end-on against a rigid, smooth wall, which is y = 0."""

import math
import types

# Of two bars: length, radius (m), speed (m/s), time (s), and the metal.
SMOOTH = types.SimpleNamespace(length=32.4e-3, radius=3.2e-3, speed=227, time=80e-6, material="""
model = "von_mises"
density = 8930
youngs_modulus = 117e9
poissons_ratio = 0.35
sigma_y = 400e6
H = 100e6
""")
JOHNSON_COOK = types.SimpleNamespace(length=25.4e-3, radius=3.81e-3, speed=190, time=80e-6, material="""
model = "johnson_cook_1983"
density = 8960
youngs_modulus = 124e9
poissons_ratio = 0.34
""")
WITHOUT_RATE = types.SimpleNamespace(**{**vars(JOHNSON_COOK), "material": JOHNSON_COOK.material + "C = 0\n"})


def scene(bar, cells=8, precision="float", transfer="apic"):
    """A quarter of the bar, between two of its planes of symmetry; `cells` to its radius."""
    walls = 4 * bar.radius
    return f"""
[simulation]
cell_size = {bar.radius / cells}
duration = {bar.time}
frame_rate = {4 / bar.time}
precision = "{precision}"
transfer = "{transfer}"
[materials.copper]
{bar.material}
[[bodies]]
name = "bar"
material = "copper"
sampling = "lattice"
velocity = [0, {-bar.speed}, 0]
[bodies.shape]
type = "intersection"
[[bodies.shape.of]]
type = "cylinder"
start = [0, {-bar.radius}, 0]
end = [0, {bar.length}, 0]
radius = {bar.radius}
[[bodies.shape.of]]
type = "box"
min = [0, 0, 0]
max = [{walls}, {bar.length}, {walls}]
[domain]
min = [0, {-walls}, 0]
max = [{walls}, {2 * bar.length}, {walls}]
contact = "slip"
[[colliders]]
name = "wall"
shape = {{ type = "plane", point = [0, 0, 0], normal = [0, 1, 0] }}
contact = "separating"
[output]
attributes = ["F_E", "Jp", "material", "alpha"]  # for the program that reads frames
"""


def measure(bar, cells, before, after):
    """Shape, in m, from the points of the first frame and of a later one, in the same order.

    Points stand on a lattice, two to a cell's edge; surfaces lie beyond the outermost points by as much as they did,
    stretched as the matter there is. But for the foot, which is pressed so flat that half a spacing is nothing.
    """
    spacing = bar.radius / cells / 2
    top = max(point[1] for point in before)
    end = [q[1] for p, q in zip(before, after) if p[1] > top - spacing / 2]
    # The bar has bounced by then and may be off the wall.
    length = sum(end) / len(end) + spacing / 2 - min(q[1] for q in after)
    # Points near the surface of the cylinder: height, and radius of the surface.
    skin = []
    for p, q in zip(before, after):
        r = math.hypot(p[0], p[2])
        if r > bar.radius - spacing:
            skin.append((q[1], math.hypot(q[0], q[2]) * bar.radius / r))
    mushroom = max(radius for _, radius in skin)
    fifth = [radius for y, radius in skin if abs(y - 0.2 * bar.length) < bar.length / 50]
    return types.SimpleNamespace(length=length, mushroom=mushroom, fifth=sum(fifth) / len(fifth))
