// The page around plots and tables: what was studied, what is shown, the legend, the command of a picked run.

function truthText() {
  const {text = "", order = {}, uncertainty = {}} = study.truth;
  const amount = name => `${errorText(uncertainty[name], short)} (${name})`;
  const observed = study.quantities.filter(quantity => order[quantity] != null);
  const known = study.quantities.filter(quantity => (uncertainty?.[quantity] ?? 0) > 0);
  return [
    text,
    observed.length ? `observed order ${observed.map(q => `${order[q].toFixed(2)} (${q})`).join(", ")}` : "",
    known.length ? `uncertain by ${known.map(amount).join(", ")}` : "",
  ].filter(Boolean).join("; ");
}

function variedText() {
  return study.axes.map(axis => {
    const values = [...new Set(study.runs.map(run => settingText(run.settings[axis])))];
    return `${settingName(axis)} ${values.join(", ")}`.trim();
  }).join("; ");
}

function fillHeader() {
  const {made} = study;
  const count = state => study.runs.filter(run => run.state === state).length;
  const ends = ["finished", "failed", "refused"].filter(state => state === "finished" || count(state) > 0);
  const timed = made.repeats === 1 ? "once" : `${made.repeats} times`;
  const facts = [
    ["Scene", `${study.scene}, compared at ${secondsText(study.time, short)}`],
    ["Truth", truthText()],
    ["Varied", variedText()],
    ["Runs", `${ends.map(state => `${count(state)} ${state}`).join(", ")}; each timed ${timed}`],
    ["Machine", `${made.machine}, ${made.cores} ${made.cores === 1 ? "core" : "cores"}`],
    ["Made", `${made.date} from ${study.study} by firn ${made.firn}, compiler ${made.compiler}`],
  ];
  document.title = study.title;
  element("title").textContent = study.title;
  element("description").textContent = study.description;
  for (const [name, value] of facts) element("facts").append(make("dt", name), make("dd", value || NONE));
}

/** One of `values` in view[key]. */
function fillChoice(key, values, show) {
  for (const value of values) {
    const label = make("label");
    const input = make("input");
    Object.assign(input, {type: "radio", name: key, value, checked: view[key] === value});
    input.addEventListener("change", () => {
      view[key] = value;
      show();
    });
    label.append(input, make("span", value));
    element(key).append(label);
  }
}

function fillToggles(kind, looks, picture, show) {
  for (const [value, look] of looks) {
    const button = make("button");
    button.type = "button";
    button.setAttribute("aria-pressed", "true");
    button.append(picture(look), make("span", value));
    button.addEventListener("click", () => {
      const name = `${kind} ${value}`;
      if (!view.hidden.delete(name)) view.hidden.add(name);
      button.setAttribute("aria-pressed", String(!view.hidden.has(name)));
      show();
    });
    element(kind + "s").append(button);
  }
}

function fillSigns() {
  const ink = "#5d6770";
  const add = (...parts) => {
    const sign = make("span", "", "sign");
    sign.append(...parts);
    element("signs").append(sign);
  };
  if (sizes.length > 1)
    for (const size of [sizes[0], sizes[sizes.length - 1]])
      add(markPicture("circle", ink, radiusOf(size)), `cells of ${settingText(size)} m`);
  add(make("i", "", "front"), "Pareto front");
  if (study.runs.some(run => run.state === "failed")) add(markPicture("crossRot", ink, 5), "failed");
  const band = make("i", "", "band");
  band.append(markPicture("circle", GREY, 5.5));
  if (study.runs.some(run => run.greyed.length > 0)) add(band, "under 10 × the truth's uncertainty");
}

function fillControls(show) {
  fillChoice("quantity", study.quantities, show);
  fillChoice("norm", ["l2", "max"], show);
  fillToggles("kernel", colours, colour => markPicture("circle", colour, 6), show);
  fillToggles("transfer", shapes, shape => markPicture(shape, "#39424a", 6), show);
  fillSigns();
}

/** A browser may keep a page from the clipboard: the text is selected too, so that a key press copies it. */
async function copyCommand() {
  getSelection().selectAllChildren(element("command"));
  try {
    await navigator.clipboard.writeText(element("command").textContent);
    element("copy").textContent = "Copied";
  } catch {
    element("copy").textContent = "Selected";
  }
}

function start() {
  const pick = run => {
    view.picked = run;
    element("picked").hidden = false;
    element("command").textContent = commandOf(run);
    element("copy").textContent = "Copy";
    updatePlots(charts);
  };
  const charts = makePlots(pick);
  const fillTables = makeTables(pick);
  const show = () => {
    updatePlots(charts);
    fillTables();
  };
  fillHeader();
  fillControls(show);
  show();
  element("copy").addEventListener("click", copyCommand);
  window.firnStudy = {charts, study};
}

start();
