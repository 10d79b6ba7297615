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
attributes = ["F_E", "Jp", "material"]  # for the program that reads frames
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
    return types.SimpleNamespace(length=length, mushroom=mushroom, fifth=sum(fifth) / len(fifth),
                                 strain=largest_strain(spacing, before, after))


def largest_strain(spacing, before, after):
    """Largest equivalent strain sqrt(2/3) |dev ln V|, from differences between neighbours on the lattice.

    Where the metal flows one way only that is the history of plastic strain, less what is elastic.
    """
    at = {tuple(int(x // spacing) for x in p): q for p, q in zip(before, after)}
    largest = 0
    for (i, j, k), q in at.items():
        near = [at.get(cell) for cell in ((i + 1, j, k), (i, j + 1, k), (i, j, k + 1))]
        if None in near or j > 40:
            continue
        F = [[(near[b][a] - q[a]) / spacing for b in range(3)] for a in range(3)]
        C = [[sum(F[c][a] * F[c][b] for c in range(3)) for b in range(3)] for a in range(3)]
        logs = [math.log(value) / 2 for value in eigenvalues(C)]
        mean = sum(logs) / 3
        largest = max(largest, math.sqrt(2 / 3 * sum((e - mean)**2 for e in logs)))
    return largest


def eigenvalues(A):
    """Of a symmetric matrix with positive ones, by Jacobi's rotations."""
    A = [row[:] for row in A]
    for _ in range(8):
        for p, q in ((0, 1), (0, 2), (1, 2)):
            if A[p][q] == 0:
                continue
            angle = 0.5 * math.atan2(2 * A[p][q], A[q][q] - A[p][p])
            c, s = math.cos(angle), math.sin(angle)
            for k in range(3):
                A[k][p], A[k][q] = c * A[k][p] - s * A[k][q], s * A[k][p] + c * A[k][q]
            for k in range(3):
                A[p][k], A[q][k] = c * A[p][k] - s * A[q][k], s * A[p][k] + c * A[q][k]
    return [max(A[k][k], 1e-12) for k in range(3)]
