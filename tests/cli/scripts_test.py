#!/usr/bin/python3
"""tools/scripts/*: the shape of what they print and draw. How fast anything is, no test asks."""

import importlib.machinery
import importlib.util
import os
import struct
import subprocess
import sys
import xml.etree.ElementTree
import zlib

from firn_cli import BLOCK, SOURCE, FirnTest, diagnostics, frame_name, main, programs

SCRIPTS = os.path.join(SOURCE, "tools", "scripts")


class ScriptTest(FirnTest):
    def script(self, name, *arguments, program=None, code=0):
        done = subprocess.run([os.path.join(SCRIPTS, name), program or programs["firn"], *arguments],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def tables(self, markdown):
        """The tables as lists of rows of cells, each with as many cells as its header; and the captions."""
        tables, captions = [], []
        for part in markdown.strip().split("\n\n"):
            if not part.startswith("|"):
                captions.append(part)
                continue
            header, rule, *rows = [line.strip("|").split("|") for line in part.splitlines()]
            self.assertEqual([len(cells) for cells in (rule, *rows)], [len(header)] * (len(rows) + 1))
            tables.append([[cell.strip() for cell in cells] for cells in (header, *rows)])
        return tables, captions

    def assert_times(self, cells):
        for cell in cells:
            self.assertGreater(float(cell.replace(",", "")), 0)

    def assert_says_what_is_wrong(self, name):
        done = self.script(name, "--quick", program=self.path("nothing"), code=3)
        self.assertIn("nothing is no program", done.stderr)
        self.assertEqual(done.stdout, "")
        done = self.script(name, "--rounds", "0", code=2)
        self.assertIn("--rounds", done.stderr)


class Scaling(ScriptTest):
    def setUp(self):
        super().setUp()
        self.svg = self.path("plot.svg")

    def test_every_row_has_its_measurements_and_the_plot_shows_them(self):
        done = self.script("scaling", "--quick", "--svg", self.svg)
        (table,), (caption,) = self.tables(done.stdout)
        header, *rows = table
        threads = sorted({1, len(os.sched_getaffinity(0))})
        self.assertEqual(header[:3] + header[-1:], ["body", "particles", "per cell", "bytes"])
        self.assertEqual(len(header), 3 + 2 * len(threads) + len(threads[1:]) + 1)
        self.assertEqual([row[0] for row in rows], ["block"] * 6 + ["sheet", "clumps"])
        self.assertEqual(sorted({int(row[2]) for row in rows}), [2, 4, 8, 16, 27])
        for row in rows:
            self.assert_times(row[1:])
        self.assertIn("clumps: cubes", caption)

        drawing = xml.etree.ElementTree.parse(self.svg).getroot()
        words = ["".join(text.itertext()) for text in drawing.iter("{http://www.w3.org/2000/svg}text")]
        for expected in ("ns a particle and step", "particles (8 in a cell)", "1 thread", "sheet", "clumps"):
            self.assertIn(expected, words)
        dots = list(drawing.iter("{http://www.w3.org/2000/svg}circle"))
        self.assertEqual(len(dots), (2 + 5) * len(threads))

    def test_the_table_goes_to_a_file_on_request(self):
        done = self.script("scaling", "--quick", "--svg", self.svg, "--out", "table.md")
        self.assertEqual(done.stdout, "")
        with open(self.path("table.md"), encoding="utf-8") as text:
            self.assertEqual(len(self.tables(text.read())[0]), 1)

    def test_what_does_not_fit_into_memory_is_skipped_with_a_note(self):
        scaling = load("scaling")
        scaling.memory_available = lambda: 1e6
        given = scaling.common.options("", 1, 2).parse_args([programs["firn"], "--quick"])
        row = scaling.Row("block", 1000)
        row.write(self.folder)
        scaling.measure([row], given)
        self.assertEqual(row.best, {})
        self.assertRegex(scaling.table_row(row)[0], r"block \(skipped: needs 0\.5 GB, 0\.0 GB are free\)")

    def test_mistakes_are_told(self):
        self.assert_says_what_is_wrong("scaling")


class Prices(ScriptTest):
    def test_effects_arrive_one_by_one_and_columns_with_the_plasticity(self):
        done = self.script("prices", "--quick")
        (prices, absences), captions = self.tables(done.stdout)
        self.assertEqual(len(captions), 2)
        rows = {row[0].split(" (")[0]: row for row in prices[1:]}
        elastic, snow = rows["elastic"], rows["+ plasticity and hardening"]
        for row in rows.values():
            self.assert_times([row[1], row[3], row[4]])
            self.assertEqual(row[2] == "", row is elastic)
        absent = {name: row[5].split(", ") for name, row in rows.items()}
        self.assertEqual(absent["elastic"],
                         ["colliders", "decomposition", "friction", "gravity", "hardening", "plasticity"])
        self.assertEqual(absent["+ decomposition"], ["colliders", "friction", "gravity", "hardening", "plasticity"])
        self.assertEqual(absent["+ plasticity and hardening"], ["colliders", "friction", "gravity"])
        self.assertEqual(absent["snow + gravity"], ["colliders", "friction"])
        self.assertEqual(absent["+ a sticky collider below"], ["friction"])
        self.assertEqual(absent["+ friction"], ["none"])
        # F_P, nine floats; half of that where half of the particles have it.
        halves = rows["snow, half of it `neo_hookean` instead"]
        self.assertEqual(int(snow[4]) - int(elastic[4]), 36)
        self.assertEqual(int(snow[4]) - int(halves[4]), 18)

        self.assertEqual(len(absences), 4)
        for row in absences[1:]:
            self.assert_times([row[1], row[2], row[4], row[5]])
        self.assertEqual(absences[2][4], absences[2][5], "a collider takes no memory of particles")

    def test_mistakes_are_told(self):
        self.assert_says_what_is_wrong("prices")


class WithoutEffects(ScriptTest):
    def test_it_still_finds_what_it_cuts_out(self):
        module = load("without-effects")
        with open(os.path.join(SOURCE, module.STEP), encoding="utf-8") as file:
            text = file.read()
        for effect in module.EFFECTS:
            self.assertNotIn(effect, module.cut(text))
        with self.assertRaises(SystemExit):
            module.cut(text.replace("clock.lap(1 + e)", "clock.lap(e)"))


class Plots(ScriptTest):
    def plot(self, name, *arguments, code=0):
        done = subprocess.run([os.path.join(SCRIPTS, name), *arguments], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_energies_of_runs_stand_side_by_side(self):
        self.firn("run", self.write("scene.toml", BLOCK), "--out", self.path("run"))
        done = self.plot("energy_plot", "one=run", "two <2>=run")
        drawing = xml.etree.ElementTree.fromstring(done.stdout)
        words = ["".join(text.itertext()) for text in drawing.iter("{http://www.w3.org/2000/svg}text")]
        for expected in ("energy (J)", "time (s)", "kinetic", "elastic", "total", "one", "two <2>", "0.2"):
            self.assertIn(expected, words)
        curves = [line.get("points").split() for line in drawing.iter("{http://www.w3.org/2000/svg}polyline")]
        frames = len(diagnostics(self.path("run"))[1])
        self.assertEqual([len(curve) for curve in curves], [frames] * 6)
        # A block that drifts: what moves is all the energy, and the first curve lies on the third.
        self.assertEqual(curves[0], curves[2])
        heights = [float(point.split(",")[1]) for point in curves[0] + curves[1]]
        self.assertLess(max(heights[:frames]), min(heights[frames:]))

    def test_stress_is_what_energy_grows_by_over_strain(self):
        module = load("stress_strain")
        setup = module.Setup({
            "simulation": {"dimension": 2},
            "bodies": [{"shape": {"type": "image", "size": [0.2, 0.5, 0]}}],
            "colliders": [{}, {"keyframes": [{"time": 1, "position": [0, 3, 0]}, {"time": 3, "position": [0, 2.75, 0]},
                                             {"time": 4, "position": [0, 2.5, 0]}]}]})
        for time, strain in ((0, 0), (1, 0), (2, 0.25), (3, 0.5), (3.5, 0.75), (5, 1)):
            self.assertAlmostEqual(setup.strain(time), strain)
        # A spring of 7 Pa: 7 e^2 / 2 joules a square metre, of which there is a tenth. A quarter is in motion.
        energies = [(t / 50, 0.1 * 7 / 2 * setup.strain(t / 50)**2) for t in range(201)]
        rows = [{"time": t, "elastic": 0.75 * energy, "kinetic": 0.25 * energy} for t, energy in energies]
        curve = module.curve(rows, setup)
        self.assertGreater(len(curve), 100)
        for strain, stress in curve:
            # Differences of a parabola are exact in the middle.
            self.assertAlmostEqual(stress, 7 * strain)

    def test_dots_are_drawn_where_the_particles_are(self):
        flat = (BLOCK.replace("cell_size", "dimension = 2\ncell_size").replace("0.4, 0.4, 0.4", "0.4, 0.4, 0")
                + 'sampling = "lattice"\nparticles_per_cell = 4\n')
        self.firn("run", self.write("scene.toml", flat), "--out", self.path("run"))
        first, last = (f"run/{frame_name(number)}" for number in (1, len(diagnostics(self.path("run"))[1])))
        self.plot("dots", first, last, "--out", "dots.png", "--width", "240")
        with open(self.path("dots.png"), "rb") as file:
            picture = file.read()
        # 0.4 m of body that drifts 0.2 m, and a cell of 0.1 m around all: 240 pixels are 0.65 to 0.66 m wide, for its
        # outermost particles stand 25 mm inside.
        width, height = struct.unpack(">II", picture[16:24])
        self.assertEqual(width, 240 + 12 + 240)
        self.assertAlmostEqual(height, 240 * 0.45 / 0.65, delta=2)
        at = picture.index(b"IDAT")
        size, = struct.unpack(">I", picture[at - 4:at])
        rows = zlib.decompress(picture[at + 4:at + 4 + size])
        rows = [rows[k * (width + 1) + 1:(k + 1) * (width + 1)] for k in range(height)]
        # Eight by eight dots in each panel; the left one's body is left in it, the right one's right.
        dark = [max(column) > 0 for column in zip(*rows)]
        for panel, dots in ((dark[:240], range(0, 168)), (dark[252:], range(72, 240))):
            self.assertEqual(sum(a < b for a, b in zip(panel, panel[1:])), 8)
            self.assertTrue(all(k in dots for k, drawn in enumerate(panel) if drawn))

    def test_mistakes_are_told(self):
        self.assertIn("does not exist", self.plot("dots", "nothing.vdb", "--out", "a.png", code=3).stderr)
        self.assertIn("NAME=FOLDER", self.plot("energy_plot", "run", code=2).stderr)
        self.assertIn("no diagnostics.csv", self.plot("energy_plot", "a=nothing", code=3).stderr)
        self.assertIn("no run.json", self.plot("stress_strain", "nothing", code=3).stderr)
        self.firn("run", self.write("scene.toml", BLOCK), "--out", self.path("run"))
        self.assertIn("one body from a picture", self.plot("stress_strain", "run", code=3).stderr)


def load(name):
    """The script as a module."""
    sys.path.insert(0, SCRIPTS)
    loader = importlib.machinery.SourceFileLoader(name, os.path.join(SCRIPTS, name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


if __name__ == "__main__":
    main()
