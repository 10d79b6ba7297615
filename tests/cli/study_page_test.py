#!/usr/bin/python3
"""tools/study/page: the page of a study in a browser, with data made up here. Studies have other tests."""

import json
import math
import os

from selenium.webdriver.common.by import By

from firn_cli import SCENES, main
from page_browser import CANVASES, PIXELS, PageTest
from study_samples import QUANTITIES, pareto, sample_run, sample_runs, sample_study

COLOURS = {"gimp": (0, 158, 115), "quadratic": (0, 114, 178), "cubic": (213, 94, 0)}
GREY = (154, 163, 171)
HOSTILE = ("""</script><script>document.title = "run"</script><img src=x onerror="document.title = 'run'"> """
           "<!-- <script> 'a'")


class Page(PageTest):
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
