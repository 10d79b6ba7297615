"use strict";
// What the study found, and how numbers are put in words. Nothing here touches the page but the data in it.

const study = JSON.parse(document.getElementById("study").textContent);
const finished = study.runs.filter(run => run.state === "finished");
const runOf = new Map(study.runs.map(run => [run.id, run]));

// What is shown at the moment. `hidden` holds the names of kernels and transfers.
const view = {quantity: study.quantities[0], norm: "l2", hidden: new Set(), picked: null};

// Settings that act on the result only through the time step.
const STEP_SETTINGS = ["cfl", "max_dt"];

const NONE = "–";

const errorOf = (run, norm = view.norm) => run.error?.[view.quantity]?.[norm] ?? null;
// The truth itself is not known much better than such a run.
const isGrey = run => run.greyed.includes(view.quantity);
const secondsOf = run => run.seconds?.median ?? null;
const kernelOf = run => String(run.settings.kernel ?? NONE);
const transferOf = run => String(run.settings.transfer ?? NONE);
const isHidden = run =>
  view.hidden.has("kernel " + kernelOf(run)) || view.hidden.has("transfer " + transferOf(run));

// An axis of powers of ten has no place for zero.
const onLogAxis = value => value !== null && value > 0;

function commandOf(run) {
  const plain = /^[\w@%+=:,./-]+$/.test(study.scene);
  const scene = plain ? study.scene : `'${study.scene.replaceAll("'", "'\\''")}'`;
  return `firn run ${scene} ${run.arguments}`.trim();
}

/** The study knows the front of the l2 norm only; that of the other is found here by the same rule. */
function frontRuns() {
  if (view.norm === "l2") return (study.front[view.quantity] ?? []).map(id => runOf.get(id)).filter(Boolean);
  const known = finished.filter(run => errorOf(run) !== null && secondsOf(run) !== null);
  known.sort((a, b) => secondsOf(a) - secondsOf(b) || errorOf(a) - errorOf(b));
  let best = Infinity;
  return known.filter(run => errorOf(run) < best && ((best = errorOf(run)), true));
}

function reachRows() {
  return (study.reach[view.quantity] ?? []).map(({error, run}) => ({
    error,
    run: view.norm === "l2" ? runOf.get(run) : frontRuns().find(candidate => errorOf(candidate) <= error),
  }));
}

/** Finished runs that differ in nothing but `settings`, in the order of `x`; one run alone is a line too. */
function linesOver(settings, x) {
  const lines = new Map();
  for (const run of finished) {
    if (!onLogAxis(x(run)) || !onLogAxis(errorOf(run))) continue;
    const rest = Object.entries(run.settings).filter(([name]) => !settings.includes(name)).sort();
    const key = JSON.stringify(rest);
    if (!lines.has(key)) lines.set(key, []);
    lines.get(key).push(run);
  }
  return [...lines.values()].map(runs => runs.sort((a, b) => x(a) - x(b)));
}

const linesOverStep = () => linesOver(STEP_SETTINGS, run => run.dt ?? null);
const linesOverSize = () => linesOver(["cell_size"], run => run.settings.cell_size ?? null);

/** The exponent p of error = C x^p by least squares of the logarithms; null where there is only one x. */
function fittedOrder(runs) {
  const points = runs.map(run => [Math.log(run.settings.cell_size), Math.log(errorOf(run))]);
  const mean = k => points.reduce((sum, point) => sum + point[k], 0) / points.length;
  const [x, y] = [mean(0), mean(1)];
  const spread = points.reduce((sum, point) => sum + (point[0] - x) ** 2, 0);
  return spread > 0 ? points.reduce((sum, point) => sum + (point[0] - x) * (point[1] - y), 0) / spread : null;
}

// In words.

function three(value) {
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size < 1e-3 || size >= 1e6) return value.toExponential(2).replace("+", "");
  return size >= 100 ? Math.round(value).toLocaleString("en") : value.toPrecision(3);
}

/** Without the zeros at the end, for values somebody chose and for ticks. */
const short = value => Number(value.toPrecision(3)).toString().replace("e+", "e");

const whole = value => value === null ? NONE : Math.round(value).toLocaleString("en");
const number = (value, digits = three) => value === null ? NONE : digits(value);

function errorText(value, digits = three) {
  if (value === null) return NONE;
  return value === 0 || value >= 0.99995e-4 ? digits(100 * value) + "\u00a0%" : digits(value);
}

/** In the largest unit of which there is at least `least`. */
function unitText(value, units, least, digits) {
  if (value === null) return NONE;
  const [name, unit] = units.find(([, size]) => value >= least * size * 0.99999) ?? units[units.length - 1];
  return digits(value / unit) + "\u00a0" + name;
}

const SECONDS = [["s", 1], ["ms", 1e-3], ["µs", 1e-6], ["ns", 1e-9]];
const BYTES = [["GB", 1e9], ["MB", 1e6], ["kB", 1e3], ["B", 1]];
const secondsText = (value, digits = three) => unitText(value, SECONDS, 0.1, digits);
const bytesText = value => unitText(value, BYTES, 1, three);

function quartilesText(run) {
  const {q1 = null, q3 = null} = run.seconds ?? {};
  return q1 === null || q3 === null ? NONE : `${secondsText(q1)} – ${secondsText(q3)}`;
}

const settingText = value => typeof value === "number" ? String(value) : String(value ?? NONE);

/** The last part of the path is enough where no other axis ends in it. */
function settingName(axis) {
  const last = path => path.split(".").pop();
  const unique = study.axes.filter(other => last(other) === last(axis)).length < 2;
  return (unique ? last(axis) : axis).replaceAll("_", " ");
}

const listed = [...new Set([...study.axes, "kernel"])];

/** "cell size 0.05, quadratic, flip, cfl 0.4": words speak for themselves, numbers need a name. */
function settingsText(run, axes = listed) {
  const known = axes.filter(axis => run.settings[axis] !== undefined);
  return known.map(axis => {
    const value = run.settings[axis];
    return typeof value === "string" ? value : `${settingName(axis)} ${settingText(value)}`;
  }).join(", ");
}
