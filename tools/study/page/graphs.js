// The three plots: which runs are where, and what a mouse does over them.

const element = id => document.getElementById(id);

/** An element with text in it, never markup: titles and reasons come from files. */
function make(tag, text = "", className = "") {
  const made = document.createElement(tag);
  made.textContent = text;
  if (className) made.className = className;
  return made;
}

function tooltipRows(run) {
  const failure = run.reason ? [["reason", run.reason]] : [];
  const {energy = null, momentum = null, angular = null} = run.drift ?? {};
  return [
    ...listed.filter(axis => run.settings[axis] !== undefined)
      .map(axis => [settingName(axis), settingText(run.settings[axis])]),
    [`error, ${view.norm}`, errorText(errorOf(run))],
    ["seconds, median", secondsText(secondsOf(run))],
    ["quartiles", quartilesText(run)],
    ["least", secondsText(run.seconds?.min ?? null)],
    ["steps", whole(run.steps ?? null)],
    ["particles", whole(run.particles ?? null)],
    ["energy drift", number(energy)],
    ["momentum drift", number(momentum)],
    ["angular drift", number(angular)],
    ...failure,
  ];
}

/** Of the page instead of the canvas, so that it may be longer than a plot is high. */
function showTooltip({chart, tooltip}) {
  const box = element("tooltip");
  const runs = (tooltip.dataPoints ?? []).map(point => point.raw.run);
  box.hidden = tooltip.opacity === 0 || runs.length === 0;
  if (box.hidden) return;
  const state = runs[0].state === "finished" ? "" : ` ${runs[0].state}`;
  const list = make("dl");
  for (const [name, value] of tooltipRows(runs[0])) list.append(make("dt", name), make("dd", value));
  box.replaceChildren(make("strong", `Run ${runs[0].id}${state}`), list);
  const others = runs.slice(1).map(run => run.id);
  if (others.length) box.append(make("p", `At the same place: ${others.join(", ")}`));
  if (isGrey(runs[0])) box.append(make("p", "Grey: under 10 × the truth's uncertainty"));

  const canvas = chart.canvas.getBoundingClientRect();
  const [x, y] = [canvas.left + tooltip.caretX, canvas.top + tooltip.caretY];
  const fits = x + 18 + box.offsetWidth < document.documentElement.clientWidth;
  box.style.left = Math.max(4, fits ? x + 18 : x - 18 - box.offsetWidth) + "px";
  box.style.top = Math.max(4, Math.min(y - 20, window.innerHeight - box.offsetHeight - 8)) + "px";
}

function makePlot(id, xAxis, plugins, pick) {
  return new Chart(element(id), {
    type: "scatter",
    data: {datasets: []},
    plugins,
    options: {
      maintainAspectRatio: false,
      layout: {padding: {top: 10, right: 14}},
      interaction: {mode: "nearest", intersect: true},
      scales: {x: xAxis, y: logAxis("", errorText)},
      plugins: {legend: {display: false}, tooltip: {enabled: false, external: showTooltip}},
      onClick: (event, hit, chart) => {
        if (hit.length) pick(chart.data.datasets[hit[0].datasetIndex].data[hit[0].index].run);
      },
      onHover: (event, hit) => { event.native.target.style.cursor = hit.length ? "pointer" : ""; },
    },
  });
}

function makePlots(pick) {
  const repeats = study.made.repeats > 1 ? `, median of ${study.made.repeats}` : "";
  const atSizes = (min, max) => sizes.length > 1 ? ticksAt(sizes, min, max) : logTicks(min, max);
  return {
    seconds: makePlot("error-seconds", logAxis(`time to compute${repeats}`, secondsText), [uncertaintyBand],
      pick),
    dt: makePlot("error-dt", logAxis("mean time step", secondsText), [uncertaintyBand], pick),
    cell_size: makePlot("error-size", logAxis("cell size, m", (size, digits) => digits(size), atSizes),
      [uncertaintyBand, slopeTriangles], pick),
  };
}

/** Axes hold hidden runs too, so that nothing moves when a kernel is hidden. */
function update(chart, datasets, [xMin, xMax], [yMin, yMax]) {
  Object.assign(chart.options.scales.x, {min: xMin, max: xMax});
  Object.assign(chart.options.scales.y, {min: yMin, max: yMax});
  const norm = view.norm === "max" ? "largest" : "l2";
  chart.options.scales.y.title.text = `relative error of ${view.quantity ?? "nothing"}, ${norm}`;
  chart.data.datasets = datasets;
  chart.update();
  const shown = datasets.some(({role, data}) => role !== "front" && data.length > 0);
  chart.canvas.parentNode.classList.toggle("empty", !shown);
}

function updateSecondsPlot(chart) {
  const runs = finished.filter(run => onLogAxis(errorOf(run)) && onLogAxis(secondsOf(run)));
  const failed = study.runs.filter(run => run.state === "failed");
  const times = [...runs, ...failed].map(secondsOf).filter(onLogAxis);
  const xRange = paddedRange(times);
  const yRange = paddedRange(runs.map(run => errorOf(run)), 0.06, failed.length ? 0.1 : 0.06);
  const point = run => ({x: secondsOf(run), y: errorOf(run)});
  const edge = run => ({x: onLogAxis(secondsOf(run)) ? secondsOf(run) : xRange[0], y: yRange[1]});
  const crosses = {
    ...dataset("failed", failed.filter(run => !isHidden(run)), edge),
    pointStyle: "crossRot", pointRadius: 6, pointHoverRadius: 8, pointBorderWidth: 2, order: 0,
  };
  crosses.pointBorderColor = crosses.data.map(({run}) => colours.get(kernelOf(run)));
  // Small marks stay in reach over large ones.
  const shown = runs.filter(run => !isHidden(run)).sort((a, b) => markRadius(a) - markRadius(b));
  const front = dataset("front", frontRuns().filter(run => runs.includes(run)), point, 1,
    {showLine: true, borderColor: "#39424a", borderWidth: 1.5, order: 2, pointRadius: 0, pointHitRadius: 0});
  update(chart, [crosses, {...dataset("runs", shown, point), order: 1}, front], xRange, yRange);
}

function lineDatasets(lines, x) {
  return lines.map(runs => runs.filter(run => !isHidden(run))).filter(runs => runs.length)
    .sort((a, b) => markRadius(a[0]) - markRadius(b[0]))
    .map(runs => dataset("line", runs, run => ({x: x(run), y: errorOf(run)}), 0.8,
      {showLine: true, borderWidth: 1.2, borderColor: colours.get(kernelOf(runs[0]))}));
}

function updateStepPlot(chart) {
  const lines = linesOverStep();
  const runs = lines.flat();
  update(chart, lineDatasets(lines, run => run.dt), paddedRange(runs.map(run => run.dt)),
    paddedRange(runs.map(run => errorOf(run))));
}

/** Right and low, where errors of coarse cells leave room; the axis grows downwards if they do not. */
function placeTriangle(runs, yRange) {
  const used = sizes.filter(size => runs.some(run => run.settings.cell_size === size));
  if (used.length < 2) return null;
  const right = used[used.length - 1];
  const left = Math.max(used[0], right / 1.9);
  const from = Math.max(...used.filter(size => size <= left));
  const lowest = Math.min(...runs.filter(run => run.settings.cell_size >= from).map(run => errorOf(run)));
  const margin = (yRange[1] / yRange[0]) ** 0.05;
  const bottom = Math.min(yRange[0] * margin, lowest / margin ** 2 / (right / left) ** 2);
  yRange[0] = Math.min(yRange[0], bottom / margin);
  return {left, right, bottom};
}

function updateSizePlot(chart) {
  const lines = linesOverSize();
  const runs = lines.flat();
  const yRange = paddedRange(runs.map(run => errorOf(run)));
  chart.triangle = placeTriangle(runs, yRange);
  const xRange = runs.length ? sizeRange(runs.map(run => run.settings.cell_size)) : paddedRange([]);
  update(chart, lineDatasets(lines, run => run.settings.cell_size), xRange, yRange);
}

/** Cell sizes rarely span a decade: the axis is theirs alone. */
function sizeRange(used) {
  const [low, high] = [Math.min(...used), Math.max(...used)];
  const pad = low < high ? (high / low) ** 0.12 : 2;
  return [low / pad, high * pad];
}

function updatePlots(charts) {
  updateSecondsPlot(charts.seconds);
  updateStepPlot(charts.dt);
  updateSizePlot(charts.cell_size);
}
