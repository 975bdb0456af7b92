// Assembles the page.

const data = JSON.parse(byId("view-data").textContent);
const heat = readHeat(data.heat);
const stage = new Stage();
const inspector = new Inspector(stage);
let state = null;
/** Display settings of the page: exposure [EV] and tone curve. */
const look = { exposure: 0, automatic: true, curve: "filmic" };
/**
 * Holds the state that tests and benchmarks read: sequence number and generation of A's picture, width of its grid,
 * samples of A and B and whether they are denoised, and the number of updates.
 */
const seen = { sequence: 0, generation: 0, updates: 0, grid: 0, samples: [0, 0], denoised: [false, false] };

const connection = new Connection(location.pathname, {
  state: takeState,
  tile: takeTile,
  found: () => {
    byId("gone").hidden = true;
    document.documentElement.dataset.connection = "open";
  },
  lost: () => {
    byId("gone").textContent = "Connection lost. This is the last picture; the page tries to reconnect.";
    byId("gone").hidden = false;
    document.documentElement.dataset.connection = "lost";
  },
});

/** Sends a request and shows its error message. */
function ask(what) {
  return connection.request(what).catch((error) => {
    showFailure(error);
    throw error;
  });
}

/** Shows why a request failed, unless the connection is lost, which the page shows already. */
function showFailure(error) {
  announce(error.message);
  if (document.documentElement.dataset.connection === "open") {
    byId("message").textContent = error.message;
    byId("message").hidden = false;
  }
}

/** Takes an environment that is dropped on the page. */
function bindDrop() {
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    const file = event.dataTransfer.files[0];
    if (file) {
      giveEnvironment(connection, file).catch(showFailure);
    }
  });
}

const settings = new OneAtATime((values) => ask({ set: values }), (a, b) => ({ ...a, ...b }));

function change(values) {
  settings.add(values);
}

/**
 * Applies exposure and tone curve at once, and tells the server, which needs them for the command, the job and other
 * windows.
 */
function changeLook(values) {
  Object.assign(look, values);
  if (values.exposure !== undefined) {
    look.automatic = false;
  }
  repaint();
  change({ exposure: look.automatic ? "auto" : look.exposure, curve: look.curve });
}

function paintHeat(rgb, target) {
  for (let i = 0; i < target.length / 4; ++i) {
    setHeat(target, 4 * i, heat, rgb[3 * i]);
  }
}

/** Repaints the picture. If `waits`, the shown pixels belong to another layer and stay until new ones arrive. */
function repaint(waits = false) {
  const { exposure, curve } = look;
  const background = linearColor(state && state.background);
  const paintLight = (rgb, target, cover) => {
    if (cover) {
      toneMapOver(rgb, cover, target, { gain: 2 ** exposure, curve, background });
    } else {
      toneMap(rgb, target, { gain: 2 ** exposure, curve });
    }
  };
  stage.setPaint(state && isHeat(state.layer) ? paintHeat : paintLight, waits);
  panel.exposure.set(look.exposure);
  byId("curve").value = look.curve;
  byId("exposure-auto").disabled = look.automatic;
}

function isHeat(layer) {
  return layer === "noise" || layer === "rates";
}

function takeState(next) {
  byId("loading").hidden = Boolean(next.slots);
  if (!next.slots) {
    byId("title").textContent = next.title;
    byId("loading").textContent = next.message || `Loading ${next.file} ...`;
    return;
  }
  const before = state;
  state = next;
  if (!before || before.size[0] !== next.size[0] || before.size[1] !== next.size[1]) {
    stage.setSize(next.size[0], next.size[1]);
  }
  const theirs = { exposure: next.exposure, automatic: next.exposure_is_auto, curve: next.curve };
  const differs = Object.keys(theirs).some((key) => theirs[key] !== look[key]);
  const isOther = Boolean(before) && before.layer !== next.layer;
  if (differs && !settings.busy) {
    Object.assign(look, theirs);
  }
  if ((differs && !settings.busy) || !before || isOther) {
    repaint(isOther);
  }
  const pair = Boolean(next.integrator_b) && next.layer !== "strategy";
  if (pair !== stage.pair) {
    stage.setPair(pair);
  }
  byId("name-a").textContent = pair ? next.slots[0].integrator : "";
  byId("name-b").textContent = pair ? next.slots[1].integrator : "";
  byId("name-b").hidden = !pair;
  byId("legend").replaceChildren(...(next.scale && isHeat(next.layer) ? [colorBar(heat, next.scale.label, next.scale.ticks)] : []));
  stage.canvas.setAttribute("aria-label", `Picture of ${next.title || next.file} by ${next.integrator_a}` +
    (next.integrator_b ? ` and ${next.integrator_b}` : ""));
  panel.show(next);
}

function takeTile({ slot, generation, sequence, grid, tile, samples, channels, denoised }, halves) {
  if (slot === 0 && generation !== seen.generation && inspector.sample) {
    inspector.clear();
  }
  stage.put(slot, grid, tile, halves, channels);
  seen.samples[slot] = samples;
  seen.denoised[slot] = denoised;
  byId("denoised").hidden = !(seen.denoised[0] || (stage.pair && seen.denoised[1]));
  seen.updates += 1;
  if (slot === 0) {
    Object.assign(seen, { sequence, generation, grid: grid.width });
    document.documentElement.dataset.ready = "true";
  }
}

async function inspect(pixel, sample = 0) {
  try {
    const answer = await ask({ inspect: pixel, sample });
    inspector.show(answer.inspect);
    byId("other-sample").addEventListener("click", () => inspect(pixel, sample + 1));
    byId("close-inspector").addEventListener("click", () => inspector.clear());
  } catch (error) {
    inspector.clear();
  }
}

/** Downloads a file that the server generates, after the server knows the exposure and tone curve. */
async function download(name, query = {}) {
  await settings.idle();
  const link = html("a", { href: connection.address(name, query), download: "" });
  document.body.append(link);
  link.click();
  link.remove();
}

const save = {
  png: () => download("save.png", { slot: 0 }),
  exr: () => download("save.exr", { slot: 0 }),
  job: () => download("save.json"),
};

/** Copies a command and tells so on the button `id`, whose label returns after a moment. */
async function copyCommand(id, command) {
  const button = byId(id);
  const label = button.dataset.label || button.textContent;
  button.dataset.label = label;
  try {
    await navigator.clipboard.writeText(command);
  } catch (error) {
    const field = byId("command");
    const shown = field.value;
    field.value = command;
    field.select();
    document.execCommand("copy");
    field.value = shown;
  }
  button.textContent = "Copied";
  setTimeout(() => { button.textContent = label; }, 1500);
}

const copyFinal = () => state && copyCommand("copy", state.final_command);
const copySeen = () => state && copyCommand("copy-seen", state.command);

function setExposure(value) {
  changeLook({ exposure: Math.min(Math.max(Math.round(10 * value) / 10, -20), 20) });
}

const moves = new Moves((move) => ask({ move }));
const panel = new Panel(change, changeLook);

function toggleDenoising() {
  if (state && state.denoise !== null) {
    change({ denoise: !state.denoise });
  }
}

function toggleFullscreen() {
  const change = document.fullscreenElement ? document.exitFullscreen() : byId("screen").requestFullscreen();
  change.catch((error) => announce(error.message));
}

function resetView() {
  stage.view.reset();
  stage.requestDraw();
  moves.drop();  // sent after the reset, they would move the camera away again
  ask({ reset: true }).catch(() => {});
}

function automaticExposure() {
  look.automatic = true;
  look.exposure = state ? state.exposure_auto : 0;
  repaint();
  change({ exposure: "auto" });
}

/** Keys and their descriptions in the help. Those without an action are bound elsewhere. */
const KEYS = [
  ["Drag, arrow keys", "orbit around the target"],
  ["Shift + drag, middle button, Shift + arrows", "pan"],
  ["Wheel, Page Up, Page Down", "dolly in and out"],
  ["Double click", "set the target and the focus here"],
  ["Click", "inspect the pixel"],
  ["Shift + click", "focus here without turning the camera"],
  ["Ctrl + wheel", "magnify the pixels"],
  ["Drop a file", "light the scene by this .exr or .hdr"],
  ["I", "inspect the pixel in the middle", ["i"], () => state && inspect(state.size.map((x) => Math.floor(x / 2)))],
  ["F", "focus on the middle", ["f"], () => state && ask({ focus: state.size.map((x) => Math.floor(x / 2)) }).catch(() => {})],
  ["N", "the next sample of the inspected pixel", ["n"], () => byId("other-sample") && byId("other-sample").click()],
  ["Escape", "close the inspected pixel", ["escape"], () => inspector.clear()],
  ["+, −", "exposure", ["+", "="], () => setExposure(look.exposure + 0.5)],
  [null, null, ["-"], () => setExposure(look.exposure - 0.5)],
  ["A", "automatic exposure", ["a"], automaticExposure],
  ["T", "next tone curve", ["t"], () => {
    const names = Object.keys(CURVES);
    changeLook({ curve: names[(names.indexOf(look.curve) + 1) % names.length] });
  }],
  ["D", "denoised preview", ["d"], toggleDenoising],
  ["M", "fullscreen", ["m"], toggleFullscreen],
  ["1 to 4", "layers"],
  ["Space", "pause and continue", [" "], () => state && change({ paused: !state.paused })],
  ["0", "reset the camera", ["0"], resetView],
  ["S, E, J", "save PNG, EXR, job", ["s"], save.png],
  [null, null, ["e"], save.exr],
  [null, null, ["j"], save.job],
  ["C", "copy the command for the final render", ["c"], copyFinal],
  ["V", "copy the command of what is seen now", ["v"], copySeen],
  ["?", "this list", ["?"], () => byId("keys").showModal()],
];

function bindKeys() {
  byId("key-list").append(html("table", null, html("tbody", null, KEYS.filter(([name]) => name).map(([name, text]) =>
    html("tr", null, html("th", { scope: "row" }, html("kbd", null, name)), html("td", null, text))))));
  const actions = new Map(KEYS.flatMap(([, , keys, action]) => (keys || []).map((key) => [key, action])));
  document.addEventListener("keydown", (event) => {
    const target = event.target instanceof Element ? event.target : document.body;
    const typing = target.closest("select, textarea, dialog[open]") || (target.closest("input") && event.key.startsWith("Arrow"));
    const pressing = target.closest("button") && (event.key === " " || event.key === "Enter");
    if (typing || pressing || event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    const layer = /^[1-9]$/.test(event.key) && state ? state.layers[Number(event.key) - 1] : null;
    const action = layer ? () => change({ layer }) : actions.get(event.key.toLowerCase());
    if (action) {
      action();
    } else if (!moveByKey(event, moves)) {
      return;
    }
    event.preventDefault();
  });
}

function bindButtons() {
  byId("pause").addEventListener("click", () => state && change({ paused: !state.paused }));
  byId("reset").addEventListener("click", resetView);
  byId("fullscreen").addEventListener("click", toggleFullscreen);
  byId("denoise").addEventListener("click", toggleDenoising);
  byId("help").addEventListener("click", () => byId("keys").showModal());
  byId("exposure-auto").addEventListener("click", automaticExposure);
  byId("save-png").addEventListener("click", save.png);
  byId("save-exr").addEventListener("click", save.exr);
  byId("save-job").addEventListener("click", save.job);
  byId("copy").addEventListener("click", copyFinal);
  byId("copy-seen").addEventListener("click", copySeen);
}

byId("stage-box").prepend(stage.canvas);
stage.drawn = () => inspector.draw();
bindPointer(stage, moves, {
  click: (pixel) => inspect(pixel),
  sharpen: (pixel) => ask({ focus: pixel, turn: false }).catch(() => {}),
  focus: (pixel) => ask({ focus: pixel }).catch(() => {}),
});
bindWiper(stage);
bindDrop();
bindButtons();
bindKeys();
bindTheme();
new ResizeObserver(() => stage.requestDraw()).observe(stage.canvas);
repaint();
window.bdptView = { seen, stage, look, connection, get state() { return state; } };
