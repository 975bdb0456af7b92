// Assembles the page.

const data = JSON.parse(byId("bench-data").textContent);
const heat = readHeat(data.heat);
const viewers = [];

function refresh() {
  viewers.forEach((viewer) => viewer.invalidate());
}

/** Shows image `i` on all stages. */
function show(i) {
  const most = Math.max(...viewers.map((viewer) => viewer.names.length));
  if (i < 0 || i >= most) {
    return;
  }
  display.shown = i;
  viewers.forEach((viewer) => viewer.requestDraw());
  announce(viewers.length ? viewers[0].names[viewers[0].shown] : "");
}

function setMode(mode) {
  display.mode = mode;
  for (const button of byId("modes").querySelectorAll("button")) {
    button.setAttribute("aria-pressed", String(button.value === mode));
  }
  announce(MODES[mode]);
  refresh();
}

function fillSelect(id, entries, key) {
  const select = byId(id);
  select.append(...Object.entries(entries).map(([value, { name }]) => html("option", { value }, name)));
  select.addEventListener("change", () => {
    display[key] = select.value;
    refresh();
  });
}

function bindSlider(id, key, text) {
  const slider = byId(id);
  const update = () => {
    display[key] = Number(slider.value);
    byId(`${id}-out`).textContent = text(display[key]);
    refresh();
  };
  slider.addEventListener("input", update);
  return (value) => {
    slider.value = value;
    update();
  };
}

function bindToolbar() {
  byId("modes").append(...Object.entries(MODES).map(([mode, text]) =>
    html("button", { type: "button", value: mode, "aria-pressed": String(mode === display.mode), onclick: () => setMode(mode) }, text)));
  fillSelect("curve", CURVES, "curve");
  fillSelect("metric", METRICS, "metric");
  const setExposure = bindSlider("exposure", "exposure", (value) => `${value > 0 ? "+" : ""}${value} EV`);
  const setGamma = bindSlider("gamma", "gamma", (value) => value.toFixed(2));
  byId("reset").addEventListener("click", () => {
    setExposure(0);
    setGamma(1);
    viewers.forEach((viewer) => viewer.view.reset());
    setMode("picture");
  });
  const keys = { p: () => setMode("picture"), e: () => setMode("error"), v: () => setMode("variance"),
    ",": () => setExposure(display.exposure - 0.5), ".": () => setExposure(display.exposure + 0.5) };
  document.addEventListener("keydown", (event) => {
    const typing = event.target instanceof Element && event.target.closest("select, input[type=text]");
    if (typing || event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    if (/^[1-9]$/.test(event.key)) {
      show(Number(event.key) - 1);
    } else if (keys[event.key.toLowerCase()]) {
      keys[event.key.toLowerCase()]();
    }
  });
}

function fillHeader() {
  const { options, machine } = data;
  byId("lead").textContent = `${options.integrators.length} integrators in ${data.scenes.length} ` +
    `${data.scenes.length === 1 ? "scene" : "scenes"}, ${options.seeds} seeds each, ${seconds(options.cpu_seconds)} of CPU time a run.`;
  const facts = { Version: `bdpt ${data.version}`, Started: data.started, Processor: `${machine.cpu} (${machine.processors} threads)`,
    System: machine.system, Libraries: machine.libraries, Compiler: machine.compiler,
    "Longest path": `${options.max_depth} edges`, Sampler: options.sampler };
  byId("facts").append(...Object.entries(facts).map(([name, value]) =>
    html("div", null, html("dt", null, name), html("dd", null, value || "–"))));
  byId("footer").append(
    html("h2", null, "How it was measured"),
    html("p", null, "relMSE is the mean of (x − r)² / (r² + e), with e a hundredth of the squared mean of the reference r. The reference's own ",
      "noise is subtracted. Times are CPU time of all threads. Runs took turns (A B C A B C), so that a busy machine was busy for all. ",
      "Bands and ranges reach from the least to the greatest of all seeds; images are those of the first seed at equal time."),
    html("p", null, "Made by ", html("code", null, data.command)));
}

async function sceneSection(scene) {
  const viewer = new Viewer(scene, heat);
  await viewer.load();
  viewers.push(viewer);
  const section = html("section", { class: "wrap scene", id: `scene-${scene.name}`, "aria-labelledby": `title-${scene.name}` },
    html("h2", { id: `title-${scene.name}` }, scene.name),
    html("p", { class: "note" }, `${scene.width} × ${scene.height} pixels, camera “${scene.camera}”` +
      (scene.environment && scene.environment !== "none" ? `, environment ${scene.environment}` : "") +
      `. Reference: ${scene.reference.origin}; its own relMSE is ${scientific(scene.reference.noise_relmse)}.`),
    cautions(scene), viewer.element(speedUpBars(scene)),
    scene.integrators.length ? html("div", { class: "plots" },
      convergencePlot(scene, "Error over CPU time", "CPU time [s]", (point) => point.cpu_seconds, `clip-time-${scene.name}`),
      convergencePlot(scene, "Error over samples", "samples per pixel", (point) => point.samples, `clip-samples-${scene.name}`)) : null,
    html("p", { class: "note" }, "Median of the seeds; the band reaches from the least to the greatest. Dashed: error falls with the inverse."),
    scene.integrators.length ? curveTable(scene) : null,
    sceneTable(scene), await strategySection(scene, heat),
    html("div", { class: "figures" }, await lengthMap(scene, heat), html("div", { class: "bar-stack" }, rayBars(scene))));
  byId("scenes").append(section);
}

async function main() {
  fillHeader();
  bindToolbar();
  bindTheme();
  byId("overview").append(overviewTable(data));
  for (const scene of data.scenes) {
    await sceneSection(scene);
  }
  document.documentElement.dataset.ready = "true";
}

main().catch((error) => {
  document.documentElement.dataset.ready = "failed";
  byId("scenes").append(html("p", { class: "wrap caution", role: "alert" },
    `This browser could not show the images: ${error.message}. Chrome or Edge 80, Firefox 113, Safari 16.4 or newer can.`));
  console.error(error);
});
