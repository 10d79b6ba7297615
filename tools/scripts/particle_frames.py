"""Frames of a particle cache for scripts, read through `firn info`; a mistake ends the script with exit code 3."""

import array
import json
import math
import os
import subprocess

import run_files

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FIRN = os.path.join(ROOT, "build", "release", "firn")


def add_option(parser):
    parser.add_argument("--firn", metavar="PROGRAM", default=FIRN,
                        help="what reads the frames; what tools/firn built if left out")


def ask(firn, *words):
    try:
        done = subprocess.run([firn, "info", *words], capture_output=True, text=True, check=False)
    except OSError:
        run_files.fail(f"{firn} is no program; tools/firn builds one")
    if done.returncode != 0:
        run_files.fail(done.stderr.strip())
    return done.stdout


class Frame:
    """Time, size of the simulation's cells, and the columns x, y, radius (m) and, if it was asked for, value; nearest to
    the viewer last, who looks along -z."""

    def __init__(self, firn, file, attribute=None):
        about = json.loads(ask(firn, file, "--json"))
        self.time, self.cell = about["time"], about["voxel_size"]
        self.names = [each["name"] for each in about["attributes"]]
        flat = about["min"] is not None and about["min"][2] == about["max"][2] == 0
        # The radius is that of a disk of the particle's area, of a ball of its volume: now, or at rest.
        size = "volume" if "volume" in self.names else "pscale"
        # One component of an attribute is asked for as stress_01.
        base = attribute if attribute in (None, *self.names) else attribute.rpartition("_")[0] or attribute
        names = [size] if base in (None, size) else [size, base]
        head, *rows = ask(firn, file, "--csv", ",".join(names)).splitlines()
        columns = head.split(",")
        if attribute is not None and attribute not in columns:
            parts = [name for name in columns[4:] if name != size]
            run_files.fail(f"{file}: '{attribute}' is not one number a particle; choose one of {', '.join(parts)}")
        wanted = [columns.index(name) for name in ("x", "y", "z", size, attribute) if name is not None]
        cells = [row.split(",") for row in rows]
        self.x, self.y, z, sizes, *values = [array.array("d", (float(row[k]) for row in cells)) for k in wanted]
        if size == "volume":
            sizes = array.array("d", (math.sqrt(v / math.pi) if flat else math.pow(0.75 * v / math.pi, 1 / 3)
                                      for v in sizes))
        self.radius, self.value = sizes, values[0] if values else None
        if not flat:
            order = sorted(range(len(z)), key=z.__getitem__)
            self.x, self.y, self.radius, self.value = (
                column and array.array("d", (column[k] for k in order))
                for column in (self.x, self.y, self.radius, self.value))


def in_folder(folder):
    """The files of a run's frames in order."""
    try:
        names = [name for name in os.listdir(folder) if name.startswith("particles.") and name.endswith(".vdb")]
    except OSError as problem:
        run_files.fail(f"{folder}: {problem.strerror}")
    if not names:
        run_files.fail(f"{folder} holds no frames of a run")
    return [os.path.join(folder, name) for name in sorted(names, key=lambda name: (len(name), name))]
