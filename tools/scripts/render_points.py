"""Particles of a cache as points, for render.py: read through vdb_tool, split into pieces, counted."""

import os
import re
import subprocess
from collections import defaultdict
from pathlib import Path

import numpy as np

SCRATCH = Path(os.environ["RENDER_SCRATCH"])


def fail(message):
    """Leaves at once: Blender would turn sys.exit into success."""
    print(f"render: {message}", flush=True)
    os._exit(1)


def tool(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0 or "error" in done.stderr.lower():
        fail(f"{done.args}\n{done.stdout}{done.stderr}")
    return done.stdout


def read_ply(file):
    """Vertices (n, 3) and polygons, a list of index arrays by number of corners, of a PLY written by vdb_tool."""
    head, _, data = file.read_bytes().partition(b"end_header\n")
    count = {w[1]: int(w[2]) for w in (line.split() for line in head.decode().splitlines()) if w[0] == "element"}
    points = np.frombuffer(data, "<f4", 3 * count["vertex"]).reshape(-1, 3)
    rest = np.frombuffer(data, np.uint8, offset=points.nbytes)
    polygons, start = [], 0
    while start < len(rest):  # vdb_tool writes all triangles, then all quadrilaterals, or the other way round
        corners = int(rest[start])
        step = 1 + 4 * corners
        block = rest[start : start + (len(rest) - start) // step * step].reshape(-1, step)
        same = block[:, 0] == corners
        rows = len(block) if same.all() else int(np.argmin(same))
        polygons.append(np.ascontiguousarray(block[:rows, 1:]).view("<i4"))
        start += rows * step
    return points, polygons


def write_ply(file, points):
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    head += "property float x\nproperty float y\nproperty float z\nend_header\n"
    file.write_bytes(head.encode() + points.astype("<f4").tobytes())


def read_cache(file):
    """The particles' places and the voxel size of their grid, which is the simulation's cell size."""
    if not file.exists():
        fail(f"{file} does not exist")
    tool("vdb_tool", "-read", file, "-vdb2points", "-write", SCRATCH / "points.ply")
    cell = float(re.search(r"voxel size: (\S+)", tool("vdb_print", "-l", file))[1])
    return read_ply(SCRATCH / "points.ply")[0], cell


def pieces(points, reach):
    """Splits points into groups with no pair of points of different groups within reach; the largest comes first."""
    cells = defaultdict(list)
    for i, cell in enumerate(map(tuple, np.floor(points / reach).astype(int))):
        cells[cell].append(i)
    parent = list(range(len(points)))

    def find(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for (x, y, z), inside in cells.items():
        around = [(x + i, y + j, z + k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]
        near = [i for cell in around for i in cells.get(cell, ())]
        gaps = ((points[inside][:, None] - points[near][None]) ** 2).sum(2)
        for a, b in zip(*np.nonzero(gaps < reach * reach)):
            parent[find(near[b])] = find(inside[a])
    roots = np.array([find(i) for i in range(len(points))])
    names, sizes = np.unique(roots, return_counts=True)
    return [points[roots == name] for name in names[np.argsort(-sizes)]]


def neighbours(points, reach):
    """How many points lie in the 3 x 3 x 3 cells of size reach around each point, itself among them."""
    cell = np.floor(points / reach).astype(np.int64) + (1 << 20)

    def key(c):
        return (c[:, 0] << 42) + (c[:, 1] << 21) + c[:, 2]

    names, counts = np.unique(key(cell), return_counts=True)
    total = np.zeros(len(points), np.int64)
    for step in np.ndindex(3, 3, 3):
        k = key(cell + np.array(step) - 1)
        at = np.minimum(np.searchsorted(names, k), len(names) - 1)
        total += np.where(names[at] == k, counts[at], 0)
    return total
