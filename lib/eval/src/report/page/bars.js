// Draws speed-ups at equal error as bars on a logarithmic scale around 1, and rays by their purpose.

function speedUpBars(scene) {
  const rows = scene.integrators.filter((one) => one.speed_up);
  if (rows.length < 2) {
    return null;
  }
  const width = 560;
  const rowHeight = 30;
  const height = rowHeight * rows.length + 34;
  const axis = new LogAxis([0.5, 2, ...rows.map((one) => one.speed_up.factor)], 60, width - 80);
  const one = axis.at(1);
  const ticks = axis.ticks().filter((tick) => tick.labelled).map((tick) => svg("g", null,
    svg("line", { x1: axis.at(tick.value), x2: axis.at(tick.value), y1: 4, y2: height - 26, class: tick.value === 1 ? "one" : "grid" }),
    svg("text", { x: axis.at(tick.value), y: height - 10, class: "tick", "text-anchor": "middle" }, `${tickText(tick.value)}×`)));
  const bars = rows.map((row, i) => {
    const y = 8 + i * rowHeight;
    const x = axis.at(row.speed_up.factor);
    const ahead = x >= one;
    return svg("g", null,
      svg("text", { x: 52, y: y + 15, class: `label series-${row.integrator}`, "text-anchor": "end" }, row.integrator),
      svg("rect", { x: Math.min(x, one), y, width: Math.max(Math.abs(x - one), 1.5), height: 20, rx: 3,
        class: `bar series-${row.integrator}${row.speed_up.extrapolated ? " guessed" : ""}` }),
      svg("text", { x: ahead ? x + 7 : Math.max(one, x) + 7, y: y + 15, class: "value" },
        `${times(row.speed_up)}${row.relmse_floor === null ? "" : " †"}`));
  });
  const spoken = rows.map((row) => `${row.integrator} ${times(row.speed_up)}`).join(", ");
  return html("figure", { class: "plot-box" }, html("figcaption", null, "Speed-up at equal error, over pt"),
    svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot bars", role: "img",
      "aria-label": `Speed-up at equal error over pt in ${scene.name}: ${spoken}` }, ticks, bars));
}

/**
 * Draws a stacked bar for each row of { name, parts, title(k) }. `parts` follow the order of `kinds`, which
 * are pairs of a class and its description. Returns null if there is nothing to show.
 */
function stackedBars(scene, rows, { caption, series, kinds, format }) {
  const totals = rows.map((row) => row.parts.reduce((a, b) => a + b, 0));
  const most = Math.max(...totals);
  if (!(most > 0)) {
    return null;
  }
  const [width, rowHeight, left] = [620, 30, 60];
  const unit = (width - left - 70) / most;
  const bars = rows.map((row, i) => {
    let x = left;
    const y = 6 + i * rowHeight;
    const parts = row.parts.map((value, k) => {
      const size = value * unit;
      const part = svg("rect", { x, y, width: size, height: 20, class: `part ${series}-${kinds[k][0]}` },
        svg("title", null, row.title(k)));
      x += size;
      return part;
    });
    return svg("g", null, svg("text", { x: left - 8, y: y + 15, class: `label series-${row.name}`, "text-anchor": "end" }, row.name),
      parts, svg("text", { x: x + 7, y: y + 15, class: "value" }, format(totals[i])));
  });
  const spoken = rows.map((row) => row.parts.map((_, k) => row.title(k)).join(", ")).join("; ");
  return html("figure", { class: `plot-box ${series}-bars` }, html("figcaption", null, caption),
    svg("svg", { viewBox: `0 0 ${width} ${rowHeight * rows.length + 8}`, class: "plot", role: "img",
      "aria-label": `${caption} in ${scene.name}: ${spoken}` }, bars),
    html("p", { class: "sub" }, kinds.map(([kind, text]) => html("span", { class: `bar-key ${series}-${kind}` }, text))));
}

const RAY_KINDS = [["camera", "from the camera"], ["light", "from lights"], ["shadow", "between two points"]];

/** Draws the rays per sample, by kind. */
function rayBars(scene) {
  const pixels = scene.width * scene.height;
  const rows = scene.integrators.map((one) => {
    const parts = RAY_KINDS.map(([kind]) => one.rays_per_second[kind] / one.samples_per_second / pixels);
    return { name: one.integrator, parts, title: (k) => `${one.integrator}: ${digits(parts[k])} rays ${RAY_KINDS[k][1]}` };
  });
  return stackedBars(scene, rows, { caption: "Rays for a sample of a pixel", series: "ray", kinds: RAY_KINDS, format: digits });
}
