"""What the experiments share: a run of firn, and its particles as lists."""

import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "cli"))

from firn_cli import cache_rows, diagnostics, exported_points, frame_name, programs  # noqa: E402


def attribute(frame, name):
    """One number of each particle of a frame, in the order of their ids."""
    done = subprocess.run([programs["firn"], "info", frame, "--csv", name], stdout=subprocess.PIPE, text=True, check=True)
    return [float(line.split(",")[-1]) for line in done.stdout.splitlines()[1:]]


class Run:
    """A finished run of a scene, given as text: its table, and its frames."""

    def __init__(self, text, *options):
        self.folder = tempfile.TemporaryDirectory(prefix="firn_experiment_")
        scene, self.out = (os.path.join(self.folder.name, name) for name in ("scene.toml", "out"))
        with open(scene, "w", encoding="utf-8") as file:
            file.write(text)
        done = subprocess.run([programs["firn"], "run", scene, "--out", self.out, *options], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stdout + done.stderr + text)
        self.table = diagnostics(self.out)[1]

    def frame(self, number):
        """The file of a frame, counted from 1; from -1 back from the last."""
        return os.path.join(self.out, frame_name(number % (len(self.table) + 1)))

    def points(self, number):
        return exported_points(self.frame(number))

    def tracked(self, number):
        """The points in the order of their ids. The scene must have asked for F_E, Jp and material."""
        rows = sorted(cache_rows(self.frame(number)), key=lambda row: row["id"])
        return [(row["x"], row["y"], row["z"]) for row in rows]
