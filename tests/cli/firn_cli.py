"""What the tests of the command line share: running firn, small scenes, and reading what a run leaves behind.

usage of every *_test.py here: NAME_test.py FIRN CACHE_ROWS [CLASS...], the two programs as paths
"""

import csv
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCENES = os.path.join(SOURCE, "scenes")

# One small elastic block that drifts: a frame takes milliseconds.
BLOCK = """
[simulation]
cell_size = 0.1
duration = 0.2
frame_rate = 20
[materials.rubber]
model = "neo_hookean"
density = 1000
youngs_modulus = 1e4
poissons_ratio = 0.3
[[bodies]]
name = "block"
material = "rubber"
shape = { type = "box", min = [0, 0, 0], max = [0.4, 0.4, 0.4] }
velocity = [1, 0, 0]
"""

# Snow that meets the ground at once, so that the return map, hardening and contact all work from frame 2 on.
SNOW = """
[simulation]
cell_size = 0.05
duration = 0.05
frame_rate = 40
[gravity]
acceleration = [0, -9.81, 0]
[materials.snow]
model = "snow_stomakhin_2013"
[[bodies]]
name = "ball"
material = "snow"
shape = { type = "sphere", center = [0, 0.26, 0], radius = 0.25 }
velocity = [1, -6, 0]
[[colliders]]
name = "ground"
shape = { type = "plane", point = [0, 0, 0], normal = [0, 1, 0] }
contact = "sticky"
[output]
attributes = ["F_E", "Jp", "material"]
"""

# What keeps a run busy until it is stopped.
ENDLESS = ["--set", "simulation.duration=1e5"]

programs = {}


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    programs["firn"], programs["cache_rows"] = map(os.path.abspath, sys.argv[1:3])
    # ctest knows a skipped test by the word SKIPPED:, which the reason of a skip starts with.
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)


def start(*arguments, **options):
    """A running firn with its output in pipes."""
    return subprocess.Popen([programs["firn"], *map(str, arguments)], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, **options)


class FirnTest(unittest.TestCase):
    """A test with a folder of its own."""

    maxDiff = None

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="firn_test_")
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as out:
            out.write(text)
        return self.path(name)

    def firn(self, *arguments, code=0, **options):
        """Runs firn to its end and demands an exit code."""
        done = subprocess.run([programs["firn"], *map(str, arguments)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False,
                              **{"cwd": self.folder, "input": "", **options})
        self.assertEqual(done.returncode, code, f"firn {' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
        return done

    def plan(self, scene, *options):
        return json.loads(self.firn("plan", scene, "--json", *options).stdout)

    def assert_only_whole_frames(self, folder, numbers):
        """The folder holds exactly these frames, nothing unfinished, and another program opens each of them."""
        names = sorted(name for name in os.listdir(folder) if "particles" in name)
        self.assertEqual(names, [frame_name(number) for number in numbers])
        self.assertEqual([name for name in os.listdir(folder) if name.endswith(".partial")], [])
        counts = {len(exported_points(os.path.join(folder, name))) for name in names}
        self.assertLessEqual(len(counts), 1, "frames of one run hold different numbers of particles")
        self.assertNotIn(0, counts)


def frame_name(number):
    return f"particles.{number:04d}.vdb"


def run_record(folder):
    with open(os.path.join(folder, "run.json"), encoding="utf-8") as text:
        return json.load(text)


def hashes(folder):
    return [(frame["frame"], frame["content_xxh3"]) for frame in run_record(folder)["frames"]]


def diagnostics(folder):
    """The header, and a dictionary of numbers for each row."""
    with open(os.path.join(folder, "diagnostics.csv"), encoding="utf-8", newline="") as text:
        reader = csv.DictReader(text)
        rows = [{name: float(value) for name, value in row.items()} for row in reader]
        return reader.fieldnames, rows


def frame_bytes(file):
    """A frame less the random identifier that OpenVDB gives every file it writes."""
    with open(file, "rb") as data:
        content = data.read()
    # Magic, versions and a flag, then 36 characters.
    identifier = slice(21, 57)
    if not re.fullmatch(rb"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}", content[identifier]):
        raise ValueError(f"{file}: no OpenVDB header")
    return content[:identifier.start] + content[identifier.stop:]


def exported_points(file):
    """The positions of a frame as OpenVDB's vdb_tool exports them to PLY, in its order."""
    with tempfile.TemporaryDirectory() as folder:
        ply = os.path.join(folder, "points.ply")
        # A file cut short can keep it busy for very long.
        done = subprocess.run(["vdb_tool", "-read", file, "-vdb2points", "-write", ply], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False, timeout=30)
        if done.returncode != 0 or not os.path.exists(ply):
            raise AssertionError(f"vdb_tool does not read {file}:\n{done.stdout}")
        with open(ply, "rb") as data:
            header, body = data.read().split(b"end_header\n", 1)
    lines = header.decode().splitlines()
    if "format binary_little_endian 1.0" not in lines:
        raise AssertionError("the points are in a form this test does not read:\n" + header.decode())
    count = next(int(line.split()[2]) for line in lines if line.startswith("element vertex"))
    columns = [line for line in lines if line.startswith("property float")]
    if columns[:3] != [f"property float {axis}" for axis in "xyz"]:
        raise AssertionError("the points have no x, y, z in front:\n" + header.decode())
    stride = len(columns)
    numbers = struct.unpack_from(f"<{count * stride}f", body)
    return [numbers[stride * k:stride * k + 3] for k in range(count)]


def cache_rows(file):
    """The particles of a frame as OpenVDB's own reader sees them: dictionaries in the order of the file.

    The scene must have asked for F_E, Jp and material.
    """
    done = subprocess.run([programs["cache_rows"], file], stdout=subprocess.PIPE, text=True, check=True)
    header, *lines = done.stdout.splitlines()
    names = header.split(",")
    return [dict(zip(names, map(float, line.split(",")))) for line in lines]
