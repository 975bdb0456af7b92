// Controls of the page. Each shows the server's state, except while the user moves it.

class Panel {
  /**
   * `change(settings)` sends settings to the server; `look(settings)` sets the display settings of the page: exposure,
   * tone curve.
   */
  constructor(change, look) {
    this.change = change;
    this.look = look;
    this.bindSelect("curve", (value) => look({ curve: value }));
    byId("curve").append(...Object.entries(CURVES).map(([value, { name }]) => html("option", { value }, name)));
    this.bindSelect("camera", (value) => change({ camera: value }));
    this.bindSelect("variant", (value) => change({ variant: value || null }));
    this.bindSelect("animation", (value) => change({ animation: value || null }));
    this.bindSelect("ground", (value) => change({ ground: value === "shadow" }));
    this.bindSelect("background", (value) => change({ background: value === "color" ? byId("background-color").value : value || null }));
    byId("background-color").addEventListener("input", (event) => change({ background: event.target.value }));
    this.fov = this.bindSlider("fov", (value) => `${digits(value)}°`, (value) => change({ fov: value }));
    this.aperture = this.bindSlider("aperture", (value) => (value ? `f/${digits(toFStop(value), 2)}` : "all sharp"),
      (value) => change({ f_stop: value ? toFStop(value) : null }));
    this.time = this.bindSlider("time", (value) => `${digits(value)} s`, (value) => change({ time: value }));
    this.bindSelect("integrator-a", (value) => change({ integrator_a: value }));
    this.bindSelect("integrator-b", (value) => change({ integrator_b: value || null }));
    this.bindSelect("environment", (value) => change({ environment: value }));
    this.bindSelect("strategy", (value) => change({ strategy: value.split(",").map(Number) }));
    this.exposure = this.bindSlider("exposure", formatExposure, (value) => look({ exposure: value }));
    this.rotation = this.bindSlider("rotation", (value) => `${value}°`, (value) => change({ rotation: value }));
    this.intensity = this.bindSlider("intensity", (value) => `× ${digits(2 ** value)}`, (value) => change({ intensity: 2 ** value }));
  }

  bindSelect(id, changed) {
    byId(id).addEventListener("change", (event) => changed(event.target.value));
  }

  /** Binds a slider to `changed(value)`. The result's `set(value)` moves the slider without calling it. */
  bindSlider(id, text, changed) {
    const slider = byId(id);
    const write = () => {
      byId(`${id}-out`).textContent = text(Number(slider.value));
    };
    slider.addEventListener("input", () => {
      write();
      changed(Number(slider.value));
    });
    return { set: (value) => {
      if (Math.abs(Number(slider.value) - value) > Number(slider.step) / 2) {
        slider.value = value;
      }
      write();
    } };
  }

  show(state) {
    const title = state.title || state.file;
    byId("title").textContent = title;
    document.title = `${title} – bdpt view`;
    byId("camera-line").textContent = formatCamera(state.camera);
    fillOptions("integrator-a", state.integrators.map((name) => [name, name]), state.integrator_a);
    fillOptions("integrator-b", [["", "none"], ...state.integrators.map((name) => [name, name])], state.integrator_b || "");
    fillOptions("environment", state.environments.map((name) => [name, name]), state.environment);
    fillOptions("strategy", (state.strategies || []).map(([s, t]) => [`${s},${t}`, `s = ${s}, t = ${t}`]), String(state.strategy || ""));
    byId("strategy-box").hidden = state.layer !== "strategy";
    this.rotation.set(state.rotation);
    this.intensity.set(Math.log2(state.intensity));
    this.showFile(state);
    this.showCamera(state.camera);
    this.showBackground(state);
    byId("denoise").disabled = state.denoise === null;
    byId("denoise").title = state.denoise === null ? "Needs Open Image Denoise" : "In this page only";
    byId("denoise").setAttribute("aria-pressed", String(Boolean(state.denoise)));
    this.showLayers(state);
    const pause = byId("pause");
    pause.textContent = state.paused ? "Continue" : "Pause";
    pause.setAttribute("aria-pressed", String(state.paused));
    byId("message").hidden = !state.message;
    if (byId("message").textContent !== (state.message || "")) {
      byId("message").textContent = state.message || "";
    }
    this.showNotes(state.warnings || []);
    byId("command").value = state.final_command;
    byId("status").replaceChildren(...state.slots.flatMap((slot) => createStatus(slot, state.slots.length > 1)));
  }

  /** Shows the warnings and notes of the scene: a single one directly, several behind a count. */
  showNotes(notes) {
    const box = byId("notes");
    box.hidden = notes.length === 0;
    if (box.dataset.notes !== notes.join("\n")) {
      box.dataset.notes = notes.join("\n");
      box.replaceChildren(html("summary", null, notes.length === 1 ? "A note about the scene" : `${notes.length} notes about the scene`),
        html("ul", null, notes.map((note) => html("li", null, note))));
    }
  }

  /** Shows what the file has to choose from. */
  showFile(state) {
    const { cameras, variants, animations } = state;
    fillOptions("camera", [...cameras, ["auto", "whole scene"]], state.camera.choice);
    fillOptions("variant", [["", "as in the meshes"], ...variants], state.variant || "");
    const isSingle = animations.length === 1;
    fillOptions("animation", [["", isSingle ? animations[0][1] : "first"], ...(isSingle ? [] : [...animations, ["all", "all"]])],
      state.animation || "");
    setShown("camera", cameras.length > 0);
    setShown("variant", variants.length > 0);
    setShown("animation", animations.length > 1);
    setShown("time", animations.length > 0);
    byId("file-box").hidden = variants.length + animations.length === 0;
    const chosen = animations.findIndex(([value]) => value === state.animation);
    const end = state.animation === "all" ? Math.max(...state.animation_ends) : state.animation_ends[Math.max(chosen, 0)];
    const slider = byId("time");
    slider.max = end || 10;
    slider.step = 10 ** Math.floor(Math.log10(slider.max / 50));
    this.time.set(state.time || 0);
  }

  showCamera(camera) {
    byId("fov").disabled = camera.fov === null;
    byId("aperture").disabled = camera.fov === null;
    this.fov.set(camera.fov || 0);
    this.aperture.set(camera.f_stop ? Math.min(Math.max(Math.round(fromFStop(camera.f_stop)), 1), 36) : 0);
  }

  showBackground(state) {
    const names = { "": "environment", transparent: "transparent", "#ffffff": "white", "#000000": "black" };
    const value = state.background || "";
    const isColor = value.startsWith("#") && !(value in names);
    if (value && !value.startsWith("#") && !(value in names)) {
      this.photo = value;  // of the command line
    }
    fillOptions("background", [...Object.entries(names), ...(this.photo ? [[this.photo, this.photo]] : []), ["color", "colour"]],
      isColor ? "color" : value);
    byId("background-color").hidden = !isColor;
    if (isColor && document.activeElement !== byId("background-color")) {
      byId("background-color").value = value;
    }
    fillOptions("ground", [["", "none"], ["shadow", "shadow"]], state.ground ? "shadow" : "");
  }

  showLayers(state) {
    const names = state.layers;
    const box = byId("layers");
    const legend = box.querySelector("legend");
    if (box.dataset.names !== names.join()) {
      box.dataset.names = names.join();
      box.replaceChildren(legend, ...names.map((name, i) => html("button", { type: "button", value: name,
        "aria-keyshortcuts": String(i + 1), onclick: () => this.change({ layer: name }) }, LAYERS[name] || name)));
    }
    for (const button of box.querySelectorAll("button")) {
      button.setAttribute("aria-pressed", String(button.value === state.layer));
    }
  }
}

const LAYERS = { picture: "Picture", strategy: "Strategy", noise: "Noise", rates: "Rates" };

/** Converts positions of the slider of the aperture to f-numbers, from f/38 to f/0.09. */
function toFStop(position) {
  return Number((2 ** (5.5 - position / 4)).toPrecision(2));
}

function fromFStop(number) {
  return 4 * (5.5 - Math.log2(number));
}

/** Shows or hides a control with its label. */
function setShown(id, isShown) {
  byId(id).closest("label").hidden = !isShown;
}

function fillOptions(id, options, value) {
  const select = byId(id);
  const key = options.map(([name]) => name).join("\n");
  if (select.dataset.options !== key) {
    select.dataset.options = key;
    select.replaceChildren(...options.map(([name, text]) => html("option", { value: name }, text)));
  }
  if (select.value !== value && document.activeElement !== select) {
    select.value = value;
  }
}

function formatExposure(value) {
  return `${value > 0 ? "+" : ""}${Number(value.toFixed(2))} EV`;
}

function formatCamera(camera) {
  const point = (p) => p.map((x) => digits(x)).join(", ");
  return `${camera.name ? `${camera.name}: ` : ""}from ${point(camera.from)} to ${point(camera.look_at)}` +
    (camera.fov ? `, ${digits(camera.fov)}°` : "");
}

/** Returns the elements of the status line, like "mis 48 of 256 samples, noise 2.1 %, 3.2 s". */
function createStatus(slot, named) {
  const pair = (name, value) => html("div", null, html("dt", null, name), html("dd", null, value));
  return [
    pair(named ? `${slot.integrator}: samples` : "Samples", `${digits(slot.samples, 4)}${slot.target ? ` of ${slot.target}` : ""}`),
    pair("noise", slot.noise === null ? "–" : percent(slot.noise)),
    pair("time", seconds(slot.seconds)),
    slot.done ? html("div", null, html("dd", null, "finished")) : null,
  ].filter((one) => one);
}
