"""A browser for the tests of pages of studies, and what it is asked."""

import glob
import json
import os
import re
import shutil
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from firn_cli import SOURCE, FirnTest
from study_samples import sample_runs, sample_study

PAGE = os.path.join(SOURCE, "tools", "study", "page")
CHART = "/usr/share/javascript/chart.js/chart.min.js"
CANVASES = {"seconds": "error-seconds", "dt": "error-dt", "cell_size": "error-size"}


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


class PageTest(FirnTest):
    """A browser with a page of a study in it, watched for complaints."""

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
