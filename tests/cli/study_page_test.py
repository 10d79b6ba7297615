#!/usr/bin/python3
"""tools/study/page: the page of a study in a browser, with data made up here. Studies have other tests."""

import glob
import itertools
import json
import math
import os
import random
import re
import shutil
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from firn_cli import SCENES, SOURCE, FirnTest, main

PAGE = os.path.join(SOURCE, "tools", "study", "page")
CHART = "/usr/share/javascript/chart.js/chart.min.js"
CANVASES = {"seconds": "error-seconds", "dt": "error-dt", "cell_size": "error-size"}
QUANTITIES = {"displacement": 1.0, "velocity": 2.1, "stress": 5.3}  # with the size of their errors
UNCERTAINTY = 1.6e-4  # of the truth, of an error of size 1
COLOURS = {"gimp": (0, 158, 115), "quadratic": (0, 114, 178), "cubic": (213, 94, 0)}
GREY = (154, 163, 171)
HOSTILE = ("""</script><script>document.title = "run"</script><img src=x onerror="document.title = 'run'"> """
           "<!-- <script> 'a'")


def read(name):
    with open(name, encoding="utf-8") as text:
        return text.read()


def assembled(study):
    """The page as firn writes it: every marker once, so that data which spells a marker stays data."""
    parts = {
        "STYLE": read(os.path.join(PAGE, "page.css")),
        "CHART": read(CHART),
        "DATA": json.dumps(study).replace("<", "\\u003c"),
        "SCRIPT": "".join(read(name) for name in sorted(glob.glob(os.path.join(PAGE, "*.js")))),
    }
    page = read(os.path.join(PAGE, "page.html"))
    return re.sub("@(STYLE|CHART|DATA|SCRIPT)@", lambda match: parts[match[1]], page)


def sample_run(number, kernel, transfer, cell_size, cfl, noise):
    """Errors fall with the second order until the time step's share is left; seconds rise as the work."""
    steps = round(60 / (cell_size * cfl))
    particles = round(4 * 0.39 / cell_size**2)
    seconds = 2.5e-7 * steps * particles * {"gimp": 0.8, "quadratic": 1, "cubic": 1.9}[kernel] * noise()
    error = ({"gimp": 4, "quadratic": 2.4, "cubic": 1.5}[kernel] * cell_size**2 + 4e-3 * cfl * cell_size
             + (0.02 * cell_size if transfer == "apic" else 0)) * noise()
    return {
        "id": f"{number:04d}",
        "settings": {"cell_size": cell_size, "kernel": kernel, "transfer": transfer, "stress_order": "usl",
                     "cfl": cfl, "materials.rubber.youngs_modulus": 1000},
        "arguments": f"--set simulation.cell_size={cell_size} --set simulation.kernel={kernel} "
                     f"--set simulation.transfer={transfer} --set simulation.cfl={cfl}",
        "state": "finished", "reason": "", "particles": particles, "steps": steps, "dt": 3 / steps,
        "seconds": {"median": seconds, "min": 0.97 * seconds, "q1": 0.98 * seconds, "q3": 1.04 * seconds,
                    "cpu": seconds, "projected": seconds * noise()},
        "passes": {"sort": 0.05 * seconds, "p2g": 0.4 * seconds, "grid": 0.1 * seconds, "g2p": 0.35 * seconds,
                   "material": 0.1 * seconds},
        "work": 9.0 * steps * particles,
        "peak_bytes": 20_000_000 + 400 * particles, "cache_bytes": 90 * particles,
        "error": {name: {"l2": size * error, "max": 3.1 * size * error * noise()**4}
                  for name, size in QUANTITIES.items()},
        "drift": {"energy": 1e-3 * cfl * noise(), "momentum": 3e-16, "angular": 2e-9 * noise()},
        "greyed": list(QUANTITIES) if error < 10 * UNCERTAINTY else [],
    }


def stopped(run, state, reason, seconds=None):
    """The run as one that did not end."""
    unknown = ("error", "drift", "passes", "steps", "dt", "work", "peak_bytes", "cache_bytes")
    return {**run, **dict.fromkeys(unknown), "state": state, "reason": reason, "greyed": [],
            "seconds": None if seconds is None else
            {"median": seconds, "min": seconds, "q1": None, "q3": None, "cpu": None, "projected": 0.4}}


def sample_runs():
    generator = random.Random(7)

    def noise():
        return math.exp(generator.gauss(0, 0.08))

    methods = [("gimp", "flip"), *itertools.product(("quadratic", "cubic"), ("flip", "apic"))]
    settings = itertools.product(methods, (0.1, 0.05, 0.025), (0.4, 0.2))
    runs = [sample_run(k + 1, *method, *others, noise) for k, (method, *others) in enumerate(settings)]
    runs[8] = stopped(runs[8], "failed", "t = 1.2 s: a velocity is not finite", 0.31)
    runs[20] = stopped(runs[20], "failed", "out of memory")
    refused = sample_run(len(runs) + 1, "gimp", "apic", 0.1, 0.4, noise)
    return [*runs, stopped(refused, "refused", "gimp goes with flip and pic only")]


def pareto(runs, quantity, norm="l2"):
    best, front = math.inf, []
    for run in sorted(runs, key=lambda run: run["seconds"]["median"]):
        if run["error"][quantity][norm] < best:
            best = run["error"][quantity][norm]
            front.append(run)
    return front


def sample_study(runs, **others):
    finished = [run for run in runs if run["state"] == "finished"]
    fronts = {quantity: pareto(finished, quantity) for quantity in QUANTITIES}

    def cheapest(quantity, error):
        return next((run["id"] for run in fronts[quantity] if run["error"][quantity]["l2"] <= error), None)

    return {
        "format": "firn study 1", "title": "Two elastic cylinders bounce off each other",
        "description": "What the cell size, the kernel, the transfer and the time step do to accuracy, and "
                       "what they cost.\nThe cylinders meet after 0.4 s and part again.",
        "study": "two_cylinders.toml", "scene": "../scenes/two_cylinders.toml",
        "made": {"firn": "0.1.0", "compiler": "12.2.0", "machine": "AMD EPYC 7B13", "cores": 2,
                 "date": "2026-11-23", "repeats": 3},
        "time": 3.0,
        "truth": {"type": "finest", "text": "the finest runs of this scene",
                  "order": {"displacement": 1.97, "velocity": None, "stress": 1.5}, "levels": [0.0125, 0.00625, 0.003125],
                  "uncertainty": {name: UNCERTAINTY * size for name, size in QUANTITIES.items()}},
        "axes": ["cell_size", "kernel", "transfer", "cfl"], "quantities": list(QUANTITIES), "runs": runs,
        "front": {quantity: [run["id"] for run in front] for quantity, front in fronts.items()},
        "reach": {quantity: [{"error": error, "run": cheapest(quantity, error)}
                             for error in (0.1, 0.05, 0.01, 0.001)] for quantity in QUANTITIES},
        **others,
    }


def start_browser():
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--window-size=1280,900", "--force-device-scale-factor=1"):
        options.add_argument(argument)
    options.binary_location = "/usr/bin/chromium"
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = Service(executable_path="/usr/bin/chromedriver", log_path=os.devnull)
    return webdriver.Chrome(service=service, options=options)


# What charts show, as plain values. A mark's place is in CSS pixels of its canvas.
MARKS = """
const chart = firnStudy.charts[arguments[0]];
return chart.data.datasets.flatMap((dataset, k) => chart.getDatasetMeta(k).data.map((mark, i) => {
  const {x, y, run} = dataset.data[i];
  return {role: dataset.role, run: run.id, value: [x, y], at: [mark.x, mark.y], hidden: mark.skip};
}));
"""

# From a copy that is made for reading: the browser warns of repeated reading from one made for drawing.
PIXELS = """
const chart = firnStudy.charts[arguments[0]];
const scale = chart.currentDevicePixelRatio;
const {width, height} = chart.canvas;
const copy = new OffscreenCanvas(width, height).getContext("2d", {willReadFrequently: true});
copy.drawImage(chart.canvas, 0, 0);
const {data} = copy.getImageData(0, 0, width, height);
return arguments[1].map(([x, y]) => {
  const at = 4 * (Math.round(y * scale) * width + Math.round(x * scale));
  return [...data.slice(at, at + 4)];
});
"""


class Page(FirnTest):
    @classmethod
    def setUpClass(cls):
        # A profile and a cache of its own, gone afterwards.
        cls.home = tempfile.mkdtemp(prefix="firn_page_")
        cls.addClassCleanup(shutil.rmtree, cls.home, ignore_errors=True)
        cls.browser = start_browser()
        cls.addClassCleanup(cls.browser.quit)
        cls.study = sample_study(sample_runs())
        cls.runs = {run["id"]: run for run in cls.study["runs"]}
        cls.finished = [run for run in cls.study["runs"] if run["state"] == "finished"]

    def open(self, study):
        self.browser.get("file://" + self.write("study.html", assembled(study)))

    def tearDown(self):
        said = [entry for entry in self.browser.get_log("browser") if entry["level"] in ("WARNING", "SEVERE")]
        self.assertEqual(said, [], "the browser's console")

    def js(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def marks(self, chart, *roles):
        return [mark for mark in self.js(MARKS, chart) if mark["role"] in roles]

    def text(self, selector):
        return self.js("return document.querySelector(arguments[0]).textContent", selector)

    def cells(self, table):
        """Rows of texts, the head first; the spaces before units are plain ones here."""
        return self.js("return [...document.querySelectorAll(`#${arguments[0]} tr`)].map(row =>"
                       "[...row.children].map(cell => cell.textContent.replaceAll('\u00a0', ' ')))", table)

    def column(self, table, head):
        heads, *rows = self.cells(table)
        return [row[heads.index(head)] for row in rows]

    def move_to(self, chart, at):
        """A real mouse over a place of a chart, brought into sight first. Offsets count from the middle."""
        canvas = self.browser.find_element(By.ID, CANVASES[chart])
        self.js("arguments[0].scrollIntoView({block: 'center'})", canvas)
        middle = (canvas.size["width"] // 2, canvas.size["height"] // 2)
        mouse = ActionChains(self.browser, duration=0)
        mouse.move_to_element_with_offset(canvas, *(round(at[k] - middle[k]) for k in (0, 1)))
        return mouse

    def await_tooltip(self, shown, chart):
        """The chart answers a mouse in the next picture, not at once."""
        box = self.browser.find_element(By.ID, "tooltip")
        WebDriverWait(self.browser, 5, 0.02).until(lambda _: box.is_displayed() == shown, f"{chart}: {shown}")

    def choose(self, key, value):
        self.browser.find_element(By.XPATH, f"//fieldset[@id='{key}']//label[span='{value}']").click()

    def test_the_page_that_firn_writes_holds_its_study_and_draws_it(self):
        study = self.write("study.toml", f"""
title = "</script> & <b>bold</b>"
scene = "{os.path.join(SCENES, 'manufactured_bar.toml')}"
repeats = 1
[truth]
type = "closed_form"
displacement = ["1e-4 * cos(pi * X) * sin(pi * t)", 0, 0]
[[sweeps]]
cell_size = [0.0625, 0.03125]
kernel = ["linear", "quadratic"]
transfer = ["apic", "pic"]
""")
        self.firn("study", study, "--out", self.path("out"))
        with open(self.path("out", "study.json"), encoding="utf-8") as text:
            written = json.load(text)
        self.browser.get("file://" + self.path("out", "study.html"))
        self.assertEqual(self.js("return firnStudy.study"), written)
        self.assertEqual(self.text("h1"), "</script> & <b>bold</b>")
        marks = sorted(self.marks("seconds", "runs"), key=lambda mark: mark["run"])
        self.assertEqual([mark["run"] for mark in marks],
                         [run["id"] for run in written["runs"] if run["state"] == "finished"])
        self.assertEqual(len(marks), 6)
        self.move_to("seconds", marks[-1]["at"]).perform()
        self.await_tooltip(True, "seconds")
        self.assertIn("quadratic", self.browser.find_element(By.ID, "tooltip").text)

    def test_every_finished_run_is_a_mark_in_its_kernels_colour_at_its_seconds_and_error(self):
        self.open(self.study)
        marks = self.marks("seconds", "runs")
        self.assertEqual(sorted(mark["run"] for mark in marks), [run["id"] for run in self.finished])
        for mark in marks:
            run = self.runs[mark["run"]]
            self.assertEqual(mark["value"], [run["seconds"]["median"], run["error"]["displacement"]["l2"]])
        for chart in CANVASES:
            marks = self.marks(chart, "runs", "line")
            self.assertEqual(len(marks), len(self.finished), chart)
            for mark, pixel in zip(marks, self.js(PIXELS, chart, [mark["at"] for mark in marks])):
                run = self.runs[mark["run"]]
                colour = GREY if run["greyed"] else COLOURS[run["settings"]["kernel"]]
                # A neighbour may lie over the mark.
                if all(math.dist(mark["at"], other["at"]) > 12 for other in marks if other is not mark):
                    self.assertEqual(tuple(pixel), (*colour, 255), f"{chart} {mark}")

    def test_marks_lie_within_the_plot_and_failed_runs_on_its_top_edge(self):
        self.open(self.study)
        for chart in CANVASES:
            area = self.js("return firnStudy.charts[arguments[0]].chartArea", chart)
            for mark in self.marks(chart, "runs", "line", "front", "failed"):
                self.assertTrue(area["left"] <= mark["at"][0] <= area["right"], f"{chart} {mark}")
                self.assertTrue(area["top"] - 0.01 <= mark["at"][1] <= area["bottom"], f"{chart} {mark}")
        area = self.js("return firnStudy.charts.seconds.chartArea")
        failed = {mark["run"]: mark for mark in self.marks("seconds", "failed")}
        self.assertEqual(sorted(failed), ["0009", "0021"])
        self.assertAlmostEqual(failed["0009"]["value"][0], 0.31)
        self.assertAlmostEqual(failed["0021"]["at"][0], area["left"], delta=0.01)
        for mark in failed.values():
            self.assertAlmostEqual(mark["at"][1], area["top"], delta=0.01)

    def test_the_front_goes_through_the_given_runs_and_through_those_of_the_other_norm(self):
        self.open(self.study)
        front = self.marks("seconds", "front")
        self.assertEqual([mark["run"] for mark in front], self.study["front"]["displacement"])
        self.assertGreater(len(front), 3)
        places = {mark["run"]: mark["at"] for mark in self.marks("seconds", "runs")}
        for mark in front:
            self.assertEqual(mark["at"], places[mark["run"]])
        # Half way between two of its runs, where no mark is, a column of pixels has a dark one.
        a, b = max(zip(front, front[1:]), key=lambda pair: math.dist(pair[0]["at"], pair[1]["at"]))
        x, y = ((a["at"][k] + b["at"][k]) / 2 for k in (0, 1))
        pixels = self.js(PIXELS, "seconds", [[x, y + k] for k in range(-3, 4)])
        self.assertTrue([pixel for pixel in pixels if sum(pixel[:3]) < 300 and pixel[3] > 150], pixels)

        self.choose("norm", "max")
        front = [mark["run"] for mark in self.marks("seconds", "front")]
        self.assertEqual(front, [run["id"] for run in pareto(self.finished, "displacement", "max")])
        self.assertNotEqual(front, self.study["front"]["displacement"])

    def test_lines_join_runs_that_differ_in_one_setting(self):
        self.open(self.study)
        for chart, setting in (("dt", "cfl"), ("cell_size", "cell_size")):
            lines = self.js("return firnStudy.charts[arguments[0]].data.datasets"
                            ".map(line => line.data.map(point => point.run.id))", chart)
            rest = lambda run: tuple(value for name, value in run["settings"].items() if name != setting)
            for line in lines:
                self.assertEqual(len({rest(self.runs[run]) for run in line}), 1, f"{chart} {line}")
            self.assertEqual(len(lines), len({rest(run) for run in self.finished}), chart)
        self.assertEqual(self.js("return firnStudy.charts.cell_size.triangle.right"), 0.1)

    def test_the_fitted_order_is_the_slope_of_the_errors(self):
        runs = [sample_run(k, "quadratic", "flip", 0.1 / 2**k, 0.4, lambda: 1) for k in (0, 1, 2)]
        for run in runs:
            run["greyed"] = []
            for norms in run["error"].values():
                norms["l2"] = 3 * run["settings"]["cell_size"] ** 1.5
        self.open(sample_study(runs))
        self.assertEqual(self.column("orders", "order"), ["1.50"])
        runs[2]["greyed"] = ["displacement"]
        runs[2]["error"]["displacement"]["l2"] = 0.02
        self.open(sample_study(runs))
        self.assertEqual(self.column("orders", "order"), ["1.50"])

    def test_a_mouse_over_a_mark_reads_its_settings_and_measurements(self):
        self.open(self.study)
        for chart in CANVASES:
            # The first of a dataset is on top of others.
            mark = self.marks(chart, "runs", "line")[0]
            self.move_to(chart, mark["at"]).perform()
            run = self.runs[mark["run"]]
            self.await_tooltip(True, chart)
            self.assertIn(f"Run {run['id']}", self.text("#tooltip"))
            said = self.js("return Object.fromEntries([...document.querySelectorAll('#tooltip dt')]"
                           ".map(name => [name.textContent, name.nextSibling.textContent]))")
            for axis in self.study["axes"]:
                self.assertEqual(said[axis.replace("_", " ")], str(run["settings"][axis]))
            self.assertNotIn("stress order", said)
            self.assertEqual(said["steps"], f"{run['steps']:,}")
            self.assertEqual(said["particles"], f"{run['particles']:,}")
            self.assertEqual(len(said), 4 + 9)
            self.assertNotIn("–", [said[name] for name in said if name != "quartiles"])
            area = self.js("return firnStudy.charts[arguments[0]].chartArea", chart)
            self.move_to(chart, (area["left"] + 20, area["bottom"] - 20)).perform()
            self.await_tooltip(False, chart)

    def test_a_click_on_a_mark_or_a_row_shows_the_command(self):
        self.open(self.study)
        self.assertFalse(self.browser.find_element(By.ID, "picked").is_displayed())
        mark = self.marks("seconds", "runs")[0]
        self.move_to("seconds", mark["at"]).click().perform()
        command = "firn run ../scenes/two_cylinders.toml "
        self.assertEqual(self.browser.find_element(By.ID, "command").text,
                         command + self.runs[mark["run"]]["arguments"])
        self.js("document.querySelector('#runs tbody tr:nth-child(3)').click()")
        self.assertEqual(self.text("#command"), command + self.runs["0003"]["arguments"])
        self.open({**self.study, "scene": "my scene's.toml"})
        self.js("document.querySelector('#runs tbody tr').click()")
        self.assertIn(r"firn run 'my scene'\''s.toml' --set", self.text("#command"))

    def test_plots_and_tables_follow_the_quantity_and_the_norm(self):
        self.open(self.study)
        for quantity, norm in (("stress", "l2"), ("stress", "max"), ("velocity", "max")):
            self.choose("quantity", quantity)
            self.choose("norm", norm)
            for chart in CANVASES:
                errors = {mark["run"]: mark["value"][1] for mark in self.marks(chart, "runs", "line")}
                self.assertEqual(errors, {run["id"]: run["error"][quantity][norm] for run in self.finished})
                title = self.js("return firnStudy.charts[arguments[0]].scales.y.options.title.text", chart)
                self.assertIn(quantity, title)
            front = [mark["run"] for mark in self.marks("seconds", "front")]
            self.assertEqual(self.column("front", "run"), front)

    def test_the_legend_hides_a_kernel_or_a_transfer_and_moves_nothing(self):
        self.open(self.study)
        limits = "const {x, y} = firnStudy.charts.seconds.scales; return [x.min, x.max, y.min, y.max]"
        before = self.js(limits)
        for name in ("cubic", "apic"):
            self.browser.find_element(By.XPATH, f"//nav//button[span='{name}']").click()
            for chart in CANVASES:
                marks = self.marks(chart, "runs", "line", "failed")
                shown = [self.runs[mark["run"]]["settings"] for mark in marks]
                self.assertFalse([settings for settings in shown if name in settings.values()])
                self.assertTrue(shown)
        self.assertEqual(self.js(limits), before)
        for name in ("cubic", "apic"):
            self.browser.find_element(By.XPATH, f"//nav//button[span='{name}']").click()
        self.assertEqual(len(self.marks("seconds", "runs")), len(self.finished))

    def test_the_tables_hold_the_front_what_is_reached_and_every_run_with_its_reason(self):
        self.open(self.study)
        self.assertEqual(self.column("front", "run"), self.study["front"]["displacement"])
        self.assertEqual(self.column("reach", "error at most"), ["10 %", "5 %", "1 %", "0.1 %"])
        reached = [row["run"] or "–" for row in self.study["reach"]["displacement"]]
        self.assertEqual(self.column("reach", "run"), reached)
        self.assertEqual(self.column("projected", "run"), [run["id"] for run in self.finished])
        seconds = self.finished[0]["seconds"]
        self.assertAlmostEqual(float(self.column("projected", "actual / projected")[0]),
                               seconds["median"] / seconds["projected"], delta=0.005)
        self.assertEqual(self.column("runs", "run"), list(self.runs))
        states = self.column("runs", "state")
        self.assertEqual(states[20], "failed: out of memory")
        self.assertEqual(states[-1], "refused: gimp goes with flip and pic only")
        self.assertIn("28 finished, 2 failed, 1 refused", self.text("#facts"))

    def test_a_click_on_a_head_sorts_and_what_is_not_known_comes_last(self):
        self.open(self.study)
        head = "document.evaluate(\"//table[@id='runs']//th[button='seconds']/button\", document, null, 9)" \
               ".singleNodeValue.click()"
        known = [run["id"] for run in self.study["runs"] if run["seconds"]]
        known.sort(key=lambda run: self.runs[run]["seconds"]["median"])
        for expected in (known, known[::-1]):
            self.js(head)
            self.assertEqual(self.column("runs", "run")[:len(known)], expected)

    def test_text_with_markup_is_shown_and_not_run(self):
        runs = sample_runs()
        runs[8]["reason"] = runs[20]["reason"] = HOSTILE
        for run in runs:
            run["settings"]["materials.rubber.youngs_modulus"] = HOSTILE + " @SCRIPT@"
        self.open(sample_study(runs, title=HOSTILE, description=HOSTILE + "\n@DATA@ \u2028", scene=HOSTILE,
                               axes=["cell_size", "materials.rubber.youngs_modulus"]))
        self.assertEqual(self.text("#title"), HOSTILE)
        self.assertEqual(self.text("#description"), HOSTILE + "\n@DATA@ \u2028")
        self.assertEqual(self.column("runs", "state")[8], "failed: " + HOSTILE)
        # The browser folds the white space of a title.
        self.assertEqual(self.browser.title, " ".join(HOSTILE.split()))
        mark = self.marks("seconds", "failed")[0]
        self.move_to("seconds", mark["at"]).click().perform()
        self.await_tooltip(True, "seconds")
        self.assertIn(HOSTILE, self.text("#tooltip"))
        self.assertEqual(self.js("return document.images.length"), 0)

    def test_zero_and_unknown_errors_stay_in_the_tables_and_leave_the_plots_alone(self):
        runs = sample_runs()
        study = sample_study(runs, front={"displacement": ["0001", "0004"]})
        runs[0]["error"]["displacement"] = {"l2": 0, "max": 0}
        runs[1]["error"]["displacement"] = None
        runs[2]["seconds"] = {**runs[2]["seconds"], "median": None}
        self.open(study)
        shown = {mark["run"] for mark in self.marks("seconds", "runs")}
        self.assertEqual(shown, {run["id"] for run in self.finished} - {"0001", "0002", "0003"})
        self.assertEqual([mark["run"] for mark in self.marks("seconds", "front")], ["0004"])
        self.assertEqual(self.column("runs", "error l2")[:2], ["0 %", "–"])
        self.assert_axes_have_ends()

    def assert_axes_have_ends(self):
        for chart in CANVASES:
            ends = self.js("const {x, y} = firnStudy.charts[arguments[0]].options.scales;"
                           "return [x.min, x.max, y.min, y.max]", chart)
            self.assertNotIn(None, ends, chart)
            self.assertTrue(0 < ends[0] < ends[1] < 1e6 and 0 < ends[2] < ends[3] < 1e6, f"{chart} {ends}")

    def test_studies_of_no_one_and_two_runs_have_a_page(self):
        for count in (0, 1, 2):
            self.open(sample_study(sample_runs()[:count]))
            for chart in CANVASES:
                self.assertEqual(len(self.marks(chart, "runs", "line")), count)
                self.assertEqual(self.is_empty(chart), count == 0)
            self.assert_axes_have_ends()
            self.assertEqual(len(self.cells("runs")[1:]), count)
        self.assertEqual(self.js("return firnStudy.charts.cell_size.triangle"), None)

    def test_a_study_in_which_nothing_finished_or_nothing_is_asked_has_a_page(self):
        runs = sample_runs()
        self.open(sample_study([runs[8], runs[20], runs[-1]]))
        self.assertEqual(len(self.marks("seconds", "failed")), 2)
        self.assertEqual(len(self.column("runs", "state")), 3)
        self.open(sample_study(runs, quantities=[], front={}, reach={}))
        self.assertTrue(self.is_empty("dt"))
        self.open(sample_study(runs, front={name: [] for name in QUANTITIES}))
        self.assertEqual(self.marks("seconds", "front"), [])
        self.assertEqual(self.text("#front"), "No run is on the front.")

    def is_empty(self, chart):
        return self.js("return document.getElementById(arguments[0]).parentNode.classList.contains('empty')",
                       CANVASES[chart])

    def test_labels_of_an_axis_do_not_overlap_and_say_their_unit(self):
        self.open(self.study)
        for width in (1280, 800):
            self.browser.set_window_size(width, 900)
            self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), width)
            for chart in CANVASES:
                labels = self.js("""
                    const {x} = firnStudy.charts[arguments[0]].scales;
                    const all = x.ticks.map((tick, k) => [tick.label, x.getPixelForTick(k)]);
                    x.ctx.font = "12px " + Chart.defaults.font.family;
                    return all.filter(([text]) => text)
                      .map(([text, at]) => [text, at, x.ctx.measureText(text).width]);""", chart)
                self.assertGreater(len(labels), 1, chart)
                for (_, a, wide), (_, b, wider) in zip(labels, labels[1:]):
                    self.assertGreater(b - a, (wide + wider) / 2 + 4, f"{chart} {labels}")
            labels = self.js("return firnStudy.charts.seconds.scales.y.ticks.map(tick => tick.label)")
            self.assertTrue({"10\u00a0%", "1\u00a0%", "0.1\u00a0%"} & set(labels), labels)
        self.browser.set_window_size(1280, 900)


if __name__ == "__main__":
    main()
