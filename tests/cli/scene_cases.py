"""What the tests of scenes share: running one, and the numbers that its file says."""

import os
import tomllib

from firn_cli import SCENES, FirnTest, diagnostics, frame_name, run_record
from pieces import pieces


def scene(name):
    return os.path.join(SCENES, name + ".toml")


def values(name):
    with open(scene(name), "rb") as text:
        return tomllib.load(text)


class SceneTest(FirnTest):
    def run_scene(self, name, *options):
        return self.run_file(scene(name), *options)

    def run_text(self, text):
        return self.run_file(self.write("scene.toml", text))

    def run_file(self, file, *options):
        self.out = self.path("out")
        self.firn("run", file, "--out", self.out, "--overwrite", *options)
        self.assertEqual(run_record(self.out)["state"], "finished")
        return diagnostics(self.out)[1]

    def frame(self, number):
        return os.path.join(self.out, frame_name(number))

    def pieces(self, points, cell_size, per_cell):
        """Pieces that count: solid, and not single flakes, which are at most 0.5 % of the particles."""
        # Solid: at least half as dense as at rest. Loose snow sprays everywhere and carries no load.
        solid = pieces(points, cell_size, per_cell / 2)
        return [piece for piece in solid if len(piece) >= 0.005 * len(points)]
