// How a plot of errors looks: axes of powers of ten, marks of runs, and what is drawn over and under them.

const FONT = getComputedStyle(document.body).fontFamily;
Object.assign(Chart.defaults.font, {family: FONT, size: 12});
Chart.defaults.color = "#4a5560";
Chart.defaults.animation = false;

// Okabe and Ito's colours, which colour-blind readers tell apart. Known kernels keep theirs in every study.
const COLOURS = ["#e69f00", "#009e73", "#0072b2", "#d55e00", "#cc79a7", "#56b4e9", "#000000"];
const SHAPES = ["circle", "triangle", "rect", "rectRot", "star", "rectRounded", "cross"];
const GREY = "#9aa3ab";

/** The values that runs have, each with a look of its own; `usual` values have the same in every study. */
function looksOf(valueOf, usual, looks) {
  const found = [...new Set(study.runs.map(valueOf))];
  const others = found.filter(value => !usual.includes(value));
  const places = [...usual, ...others];
  return new Map(places.filter(value => found.includes(value))
    .map(value => [value, looks[places.indexOf(value) % looks.length]]));
}

const colours = looksOf(kernelOf, ["linear", "gimp", "quadratic", "cubic"], COLOURS);
const shapes = looksOf(transferOf, ["apic", "flip", "pic", "mls"], SHAPES);

const sizes = [...new Set(study.runs.map(run => run.settings.cell_size).filter(size => size > 0))]
  .sort((a, b) => a - b);

/** In pixels: the coarser the cells, the larger. */
function radiusOf(size) {
  const [finest, coarsest] = [sizes[0], sizes[sizes.length - 1]];
  if (!(finest < coarsest && size > 0)) return 6;
  return 4.5 + 4.5 * Math.log(size / finest) / Math.log(coarsest / finest);
}

/** Triangles look smaller than disks of one radius. */
const markRadius = run =>
  radiusOf(run.settings.cell_size) * (shapes.get(transferOf(run)) === "triangle" ? 1.25 : 1);

/** A dataset of runs: a mark each, its radius times `scale`, and a line through them if `line` says so. */
function dataset(role, runs, point, scale = 1, line = {showLine: false}) {
  const colour = run => isGrey(run) ? GREY : colours.get(kernelOf(run));
  // Star and cross are all border.
  const thin = run => ["star", "cross"].includes(shapes.get(transferOf(run)));
  return {
    role,
    data: runs.map(run => ({...point(run), run})),
    pointStyle: runs.map(run => shapes.get(transferOf(run))),
    pointRadius: runs.map(run => scale * markRadius(run)),
    pointHoverRadius: runs.map(run => scale * markRadius(run) + 2),
    pointBackgroundColor: runs.map(colour),
    pointBorderColor: runs.map(run => run === view.picked ? "#000" : thin(run) ? colour(run) : "#fff"),
    pointBorderWidth: runs.map(run => run === view.picked || thin(run) ? 2 : 1),
    pointHoverBorderColor: "#000",
    pointHoverBorderWidth: 2,
    pointHitRadius: 3,
    clip: false,
    ...line,
  };
}

/** Ends of an axis with `values` well inside. */
function paddedRange(values, below = 0.06, above = 0.06) {
  if (values.length === 0) return [1e-3, 1];
  const [low, high] = [Math.log(Math.min(...values)), Math.log(Math.max(...values))];
  const span = Math.max(high - low, Math.log(10));
  // Values that are closer than a decade stay in the middle of one.
  const spare = (span - (high - low)) / 2;
  return [Math.exp(low - spare - below * span), Math.exp(high + spare + above * span)];
}

/** Labelled at powers of ten, at 2 and 5 as well where there are few; thin lines between. */
function logTicks(min, max) {
  const decades = Math.log10(max / min);
  const labels = decades > 2 ? [1] : [1, 2, 5];
  const every = Math.ceil(decades / 8);
  const ticks = [];
  for (let power = Math.floor(Math.log10(min)); power <= Math.log10(max); ++power)
    for (let digit = 1; digit < 10; ++digit) {
      const value = Number(`${digit}e${power}`);
      const major = labels.includes(digit) && power % every === 0;
      if (value >= min && value <= max && (major || every === 1)) ticks.push({value, major});
    }
  return ticks;
}

/** At the given values themselves; of neighbours too close for two labels the larger has one. */
function ticksAt(values, min, max) {
  let last = Infinity;
  return [...values].reverse().map(value => {
    const major = Math.log(last / value) > 0.09 * Math.log(max / min);
    if (major) last = value;
    return {value, major};
  }).reverse();
}

function logAxis(title, text, ticks = logTicks) {
  return {
    type: "logarithmic",
    title: {display: true, text: title, font: {size: 13}},
    afterBuildTicks: axis => { axis.ticks = ticks(axis.min, axis.max); },
    ticks: {
      autoSkip: false,
      maxRotation: 0,
      callback: (value, index, all) => all[index].major ? text(value, short) : "",
    },
    grid: {
      color: context => context.tick?.major ? "#d5dadf" : "#f0f2f4",
      tickColor: context => context.tick?.major ? "#9aa3ab" : "transparent",
      borderColor: "#9aa3ab",
    },
  };
}

/** Below ten times the truth's uncertainty an error says little. The runs' mark for that is about l2. */
const uncertaintyBand = {
  id: "uncertaintyBand",
  beforeDatasetsDraw({ctx, chartArea, scales: {y}}) {
    const limit = 10 * (study.truth.uncertainty?.[view.quantity] ?? 0);
    if (view.norm !== "l2" || limit <= y.min) return;
    const top = Math.max(y.getPixelForValue(limit), chartArea.top);
    ctx.save();
    ctx.fillStyle = "#39424a14";
    ctx.fillRect(chartArea.left, top, chartArea.width, chartArea.bottom - top);
    ctx.restore();
  },
};

/** Order 1 and 2 from one corner; `chart.triangle` says where. */
const slopeTriangles = {
  id: "slopeTriangles",
  afterDatasetsDraw(chart) {
    if (!chart.triangle) return;
    const {ctx, scales: {x, y}, triangle: {left, right, bottom}} = chart;
    const at = (size, error) => [x.getPixelForValue(size), y.getPixelForValue(error)];
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = "#5d6770";
    ctx.font = "12px " + FONT;
    ctx.textBaseline = "middle";
    for (const order of [1, 2]) {
      const top = at(right, bottom * (right / left) ** order);
      ctx.beginPath();
      ctx.moveTo(...at(left, bottom));
      ctx.lineTo(...at(right, bottom));
      ctx.lineTo(...top);
      ctx.closePath();
      ctx.stroke();
      ctx.fillText(String(order), top[0] + 6, top[1] + 4);
    }
    ctx.restore();
  },
};

/** A mark as in the plots, for the legend. */
function markPicture(shape, colour, radius, size = 20) {
  const canvas = document.createElement("canvas");
  // Sharp on dense screens and on paper.
  canvas.width = canvas.height = 3 * size;
  canvas.style.width = canvas.style.height = size + "px";
  canvas.className = "mark";
  const context = canvas.getContext("2d");
  context.scale(3, 3);
  context.fillStyle = context.strokeStyle = colour;
  const outlined = ["star", "cross", "crossRot"].includes(shape);
  Chart.helpers.drawPoint(context, {pointStyle: shape, radius, rotation: 0, borderWidth: outlined ? 2 : 0},
    size / 2, size / 2);
  return canvas;
}
