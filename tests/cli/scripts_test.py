#!/usr/bin/python3
"""tools/scripts/scaling, prices, without-effects: the shape of what they print. How fast anything is, no test asks."""

import importlib.machinery
import importlib.util
import os
import subprocess
import sys
import xml.etree.ElementTree

from firn_cli import SOURCE, FirnTest, main, programs

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


def load(name):
    """The script as a module."""
    sys.path.insert(0, SCRIPTS)
    loader = importlib.machinery.SourceFileLoader(name, os.path.join(SCRIPTS, name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


if __name__ == "__main__":
    main()
