// The tables. A column is a head, the value it sorts by and the text it shows; both are functions of a row.

const column = (head, value, text = settingText) => ({head, value, text: row => text(value(row))});
const ofRun = (head, value, text) => column(head, row => row.run ? value(row.run) ?? null : null, text);
const settingColumns = axes => axes.map(axis => ofRun(settingName(axis), run => run.settings[axis]));

const idColumn = ofRun("run", run => run.id);
const secondsColumn = ofRun("seconds", secondsOf, secondsText);
const errorColumn = ofRun("error", run => errorOf(run), errorText);
const settingsColumn = {...ofRun("settings", run => settingsText(run)), prose: true};
const argumentsColumn = {...ofRun("arguments", run => run.arguments), code: true};

/** Nothing known comes last, whichever way the rest goes. */
function compare(a, b, sign) {
  if (a === null || b === null) return (a === null) - (b === null);
  return sign * (typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b)));
}

/** Broken between options only. */
function commandLine(options) {
  const line = make("code");
  for (const option of options.split(/ (?=--)/)) line.append(make("span", option), " ");
  return line;
}

/** Fills the table `id` with rows, again and again; it keeps the order that a reader chose. */
function makeTable(id, columns, pick, nothing) {
  const table = element(id);
  let rows = [];
  let order = null;

  const sorted = () => order === null ? rows
    : [...rows].sort((a, b) => compare(order.column.value(a), order.column.value(b), order.sign));

  function headCell(column) {
    const cell = make("th");
    const button = make("button", column.head);
    button.type = "button";
    button.addEventListener("click", () => {
      order = {column, sign: order?.column === column ? -order.sign : 1};
      draw();
    });
    if (order?.column === column) {
      cell.setAttribute("aria-sort", order.sign > 0 ? "ascending" : "descending");
    }
    cell.append(button);
    return cell;
  }

  function bodyRow(row, numeric) {
    const made = make("tr");
    for (const column of columns) {
      const look = numeric.has(column) ? "number" : column.prose ? "prose" : "";
      const cell = make("td", column.code ? "" : column.text(row), look);
      if (column.code) cell.append(commandLine(column.text(row)));
      made.append(cell);
    }
    if (row.run) made.addEventListener("click", () => pick(row.run));
    if (row.run?.state !== "finished") made.className = "dim";
    return made;
  }

  function draw() {
    const isNumeric = column => rows.some(row => typeof column.value(row) === "number");
    const numeric = new Set(columns.filter(isNumeric));
    const head = make("tr");
    head.append(...columns.map(column => headCell(column)));
    columns.forEach((column, k) => head.children[k].classList.toggle("number", numeric.has(column)));
    const body = make("tbody");
    body.append(...sorted().map(row => bodyRow(row, numeric)));
    const top = make("thead");
    top.append(head);
    table.replaceChildren(...(rows.length ? [top, body] : [make("caption", nothing)]));
  }

  return newRows => {
    rows = newRows;
    draw();
  };
}

function allColumns() {
  const passes = [...new Set(study.runs.flatMap(run => Object.keys(run.passes ?? {})))];
  const told = run => run.reason ? `${run.state}: ${run.reason}` : run.state;
  return [
    idColumn,
    ...settingColumns(study.axes),
    {...ofRun("state", told), prose: true},
    ofRun("error l2", run => errorOf(run, "l2"), errorText),
    ofRun("error max", run => errorOf(run, "max"), errorText),
    secondsColumn,
    {...ofRun("quartiles", run => run.seconds?.q1), text: row => quartilesText(row.run)},
    ofRun("least", run => run.seconds?.min, secondsText),
    ofRun("cpu", run => run.seconds?.cpu, secondsText),
    ofRun("steps", run => run.steps, whole),
    ofRun("mean dt", run => run.dt, secondsText),
    ofRun("particles", run => run.particles, whole),
    ofRun("work", run => run.work, number),
    ofRun("peak memory", run => run.peak_bytes, bytesText),
    ofRun("cache", run => run.cache_bytes, bytesText),
    ofRun("drift energy", run => run.drift?.energy, number),
    ofRun("drift momentum", run => run.drift?.momentum, number),
    ofRun("drift angular", run => run.drift?.angular, number),
    ...passes.map(pass => ofRun(`pass ${pass}`, run => run.passes?.[pass], secondsText)),
  ];
}

function orderRows() {
  return linesOverSize().map(runs => {
    const used = runs.filter(run => !isGrey(run));
    return {run: used[0] ?? runs[0], used, order: used.length ? fittedOrder(used) : null};
  }).filter(row => row.order !== null);
}

const ratioOf = run => secondsOf(run) / run.seconds.projected;

function projectedNote(runs) {
  if (runs.length === 0) return "";
  const ratios = runs.map(ratioOf).sort((a, b) => a - b);
  const middle = (ratios.length - 1) / 2;
  const median = (ratios[Math.floor(middle)] + ratios[Math.ceil(middle)]) / 2;
  const [least, most] = [ratios[0], ratios[ratios.length - 1]].map(three);
  return `A run took ${three(median)} times what was projected for it (median; from ${least} to ${most}).`;
}

function makeTables(pick) {
  const others = study.axes.filter(axis => axis !== "cell_size");
  const orders = makeTable("orders", [
    ...settingColumns(others.includes("kernel") ? others : ["kernel", ...others]),
    column("cell sizes, m", row => row.used.map(run => settingText(run.settings.cell_size)).join(", ")),
    column("order", row => row.order, value => value.toFixed(2)),
  ], pick, "No two finished runs differ in the cell size alone.");
  const asked = [settingsColumn, argumentsColumn];
  const front = makeTable("front", [idColumn, secondsColumn, errorColumn, ...asked], pick,
    "No run is on the front.");
  const atMost = column("error at most", row => row.error, value => errorText(value, short));
  const reach = makeTable("reach", [atMost, secondsColumn, errorColumn, idColumn, ...asked], pick,
    "Nothing was asked for.");
  const projected = makeTable("projected", [idColumn, settingsColumn,
    ofRun("projected", run => run.seconds.projected, secondsText), ofRun("actual", secondsOf, secondsText),
    ofRun("actual / projected", ratioOf, three)], pick, "No finished run had a projection.");
  const all = makeTable("runs", allColumns(), pick, "The study has no runs.");

  return () => {
    const asRows = runs => runs.map(run => ({run}));
    const foreseen = finished.filter(run => run.seconds?.projected > 0 && onLogAxis(secondsOf(run)));
    orders(orderRows());
    front(asRows(frontRuns()));
    reach(reachRows());
    projected(asRows(foreseen));
    all(asRows(study.runs));
    element("projected-note").textContent = projectedNote(foreseen);
  };
}
