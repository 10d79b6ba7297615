#!/usr/bin/python3
"""tools/scripts/*: the shape of what they print and draw. How fast anything is, no test asks."""

import importlib.machinery
import importlib.util
import json
import math
import os
import subprocess
import sys
import xml.etree.ElementTree

from firn_cli import BLOCK, SOURCE, FirnTest, diagnostics, main, programs

SCRIPTS = os.path.join(SOURCE, "tools", "scripts")
SVG = "{http://www.w3.org/2000/svg}"


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
        words = words_of(drawing)
        for expected in ("ns a particle and step", "particles (8 in a cell)", "1 thread", "sheet", "clumps"):
            self.assertIn(expected, words)
        dots = list(drawing.iter(SVG + "circle"))
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
        (prices, absences, presets), captions = self.tables(done.stdout)
        self.assertEqual(len(captions), 3)
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

        # Each model has its own state and no other's: F_P, alpha, and sand's v_c.
        columns = {row[0].strip("`"): int(row[4]) for row in presets[1:]}
        own = {name: bytes_ - columns["rubber"] for name, bytes_ in columns.items()}
        self.assertEqual(own, {"rubber": 0, "snow_packed": 36, "dry_sand": 44, "copper": 40, "ice": 40, "clay": 40,
                               "foam": 36, "water": 0, "honey": 0})

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

    def test_mistakes_are_told(self):
        self.assertIn("NAME=FOLDER", self.plot("energy_plot", "run", code=2).stderr)
        self.assertIn("no diagnostics.csv", self.plot("energy_plot", "a=nothing", code=3).stderr)
        self.assertIn("no run.json", self.plot("stress_strain", "nothing", code=3).stderr)
        self.firn("run", self.write("scene.toml", BLOCK), "--out", self.path("run"))
        self.assertIn("one body from a picture", self.plot("stress_strain", "run", code=3).stderr)


class StudyPlot(ScriptTest):
    def study(self, runs, **others):
        file = self.path("study.json")
        study = {"format": "firn study 1", "title": "Bars <thin> & long", "study": "bars.toml", "runs": runs,
                 "made": {"machine": "a machine", "repeats": 3}, "quantities": ["displacement", "stress"],
                 "front": {"displacement": ["0001", "0002", "0003"], "stress": ["0002"]}, **others}
        with open(file, "w", encoding="utf-8") as out:
            json.dump(study, out)
        return file

    def sample(self):
        """Three runs of the front, one behind it, one without an error, two that failed, one that was refused."""
        return [study_run(1, 0.002, 0.1, kernel="linear", cell_size=0.1), study_run(2, 0.02, 0.01, cell_size=0.05),
                study_run(3, 0.3, 0.0005, transfer="flip", cell_size=0.025),
                study_run(4, 0.2, 0.02, greyed=True, cell_size=0.05), study_run(5, 0.4, 0, kernel="cubic"),
                study_run(6, 0.01, None, state="failed"), study_run(7, None, None, state="failed", kernel="gimp"),
                study_run(8, None, None, state="refused", kernel="delta")]

    def drawing(self, *arguments):
        done = self.script("study_plot", *arguments, program=self.study(self.sample()))
        return xml.etree.ElementTree.fromstring(done.stdout)

    def group(self, drawing, name):
        return list(drawing.find(f"{SVG}g[@class='{name}']"))

    def test_finished_runs_are_marks_and_failed_ones_crosses(self):
        drawing = self.drawing()
        marks = self.group(drawing, "runs")
        self.assertEqual(sorted(mark.tag for mark in marks), [SVG + "circle"] * 3 + [SVG + "polygon"])
        # The grey one lies below the others; of these, coarse cells below fine ones.
        self.assertEqual([mark.get("fill") for mark in marks], ["#c8cdd2", "#e69f00", "#0072b2", "#0072b2"])
        radii = [float(mark.get("r")) for mark in marks[:3]]
        self.assertEqual(radii[0], radii[2])
        self.assertLess(radii[2], radii[1])
        crosses = self.group(drawing, "failed")
        self.assertEqual([cross.get("stroke") for cross in crosses], ["#0072b2", "#009e73"])

    def test_the_front_goes_through_its_runs(self):
        drawing = self.drawing()
        (front,) = self.group(drawing, "front")
        points = [tuple(map(float, point.split(","))) for point in front.get("points").split()]
        self.assertEqual(len(points), 3)
        disks = {(float(mark.get("cx")), float(mark.get("cy"))) for mark in self.group(drawing, "runs")[1:3]}
        self.assertEqual(set(points[:2]), disks)
        self.assertEqual(points, sorted(points))
        # From 2 ms and 10 % to 20 ms and 1 %: a decade of either axis, of which two and a bit are shown.
        (x0, y0), (x1, y1), (x2, y2) = points
        self.assertAlmostEqual((x2 - x1) / (x1 - x0), math.log10(15), delta=0.01)
        self.assertAlmostEqual((y2 - y1) / (y1 - y0), math.log10(20), delta=0.01)

    def test_words_say_what_is_shown(self):
        words = words_of(self.drawing())
        for expected in ("Bars <thin> & long", "10 ms", "0.1 s", "10 %", "0.1 %", "linear", "flip", "0.025 m", "failed",
                         "relative error of displacement (L2)", "time to compute (median of 3, a machine)",
                         "near the truth's", "linear apic 0.1 m", "quadratic flip 0.025 m"):
            self.assertIn(expected, [word.replace("\u00a0", " ") for word in words])
        for absent in ("cubic", "delta", "pic"):
            self.assertNotIn(absent, words)

    def test_a_quantity_and_a_file_can_be_asked_for(self):
        done = self.script("study_plot", "--quantity", "stress", "--out", "plot.svg", program=self.study(self.sample()))
        self.assertEqual(done.stdout, "")
        drawing = xml.etree.ElementTree.parse(self.path("plot.svg")).getroot()
        self.assertIn("relative error of stress (L2)", words_of(drawing))
        self.assertEqual(len(self.group(drawing, "front")[0].get("points").split()), 1)

    def test_a_single_run_without_a_title_is_drawn(self):
        file = self.study([study_run(1, 0.002, 0.1)], title="")
        drawing = xml.etree.ElementTree.fromstring(self.script("study_plot", program=file).stdout)
        self.assertEqual(len(self.group(drawing, "runs")), 1)
        self.assertIsNone(drawing.find(f"{SVG}g[@class='failed']"))
        self.assertIn("bars.toml", words_of(drawing))

    def test_no_label_covers_another(self):
        places = load("study_labels.py")
        room = places.Room((0, 0, 300, 300), [])
        spots = [room.place((x, y), 4, "quadratic flip") for x in range(0, 300, 15) for y in range(0, 300, 15)]
        found = [spot.box for spot in spots if spot]
        self.assertGreater(len(found), 10)
        self.assertIn(None, spots)
        for k, box in enumerate(found):
            self.assertTrue(places.inside(box, room.frame))
            self.assertFalse(any(places.overlap(box, other) for other in found[:k]))

    def assert_mistake(self, message, *arguments, file):
        done = self.script("study_plot", *arguments, program=file, code=2)
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, rf"\Astudy_plot: .*{message}.*\n\Z")

    def test_mistakes_are_told_in_one_line(self):
        self.assert_mistake("nothing.json: No such file", file=self.path("nothing.json"))
        good = self.study(self.sample())
        self.assert_mistake("--quantity: invalid choice: 'mass'", "--quantity", "mass", file=good)
        self.assert_mistake("no errors of velocity; it has those of displacement, stress", "--quantity", "velocity",
                            file=good)
        self.assert_mistake("none/plot.svg: No such file", "--out", "none/plot.svg", file=good)
        for text, message in (("{", "no JSON: "), ("[]", "no study: "), ('{"format": "other"}', "no study: ")):
            with open(self.path("bad.json"), "w", encoding="utf-8") as out:
                out.write(text)
            self.assert_mistake(message, file=self.path("bad.json"))
        unfinished = [run for run in self.sample() if run["state"] != "finished"]
        self.assert_mistake("no run finished with an error of displacement", file=self.study(unfinished))
        self.assert_mistake("no run was compared", file=self.study(self.sample(), quantities=[]))


def study_run(number, seconds, error, state="finished", greyed=False, **settings):
    """As in study.json, what a plot needs of it."""
    return {"id": f"{number:04d}", "state": state, "greyed": ["displacement", "stress"] if greyed else [],
            "settings": {"kernel": "quadratic", "transfer": "apic", **settings},
            "seconds": None if seconds is None else {"median": seconds},
            "error": None if error is None else {name: {"l2": error, "max": error}
                                                 for name in ("displacement", "stress")}}


def words_of(drawing):
    return ["".join(text.itertext()) for text in drawing.iter(SVG + "text")]


def load(name):
    """The script as a module."""
    sys.path.insert(0, SCRIPTS)
    loader = importlib.machinery.SourceFileLoader(name, os.path.join(SCRIPTS, name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


if __name__ == "__main__":
    main()
