// Draws convergence plots: log-log, as inline SVG.

const PLOT = { width: 560, height: 340, left: 58, right: 74, top: 14, bottom: 44 };
const MARKERS = ["circle", "square", "diamond", "triangle", "cross"];

/** A logarithmic axis that maps values to pixels, with a margin at both ends. */
class LogAxis {
  constructor(values, from, to) {
    const logs = values.filter((value) => value > 0).map(Math.log10);
    const least = Math.min(...logs);
    const most = Math.max(...logs);
    const room = Math.max(0.06 * (most - least), 0.1);
    [this.least, this.most, this.from, this.to] = [least - room, most + room, from, to];
  }

  at(value) {
    return this.from + (Math.log10(value) - this.least) / (this.most - this.least) * (this.to - this.from);
  }

  /** Returns ticks at powers of ten and at 2 and 5 times those; the latter have labels if there are few powers. */
  ticks() {
    const result = [];
    for (let e = Math.floor(this.least); e <= Math.ceil(this.most); ++e) {
      for (const m of [1, 2, 5]) {
        const log = e + Math.log10(m);
        if (log >= this.least && log <= this.most) {
          result.push({ value: m * 10 ** e, major: m === 1 });
        }
      }
    }
    const majors = result.filter((tick) => tick.major).length;
    return result.map((tick) => ({ ...tick, labelled: tick.major || majors < 2 }));
  }
}

function tickText(value) {
  return value >= 0.01 && value < 10000 ? String(Number(value.toPrecision(1))) : `${scientific(value, 0).replace("1·", "")}`;
}

function marker(kind, x, y, name, text) {
  const size = 3.6;
  const shapes = {
    circle: () => svg("circle", { cx: x, cy: y, r: size }),
    square: () => svg("rect", { x: x - size, y: y - size, width: 2 * size, height: 2 * size }),
    diamond: () => svg("path", { d: `M${x} ${y - 5}L${x + 5} ${y}L${x} ${y + 5}L${x - 5} ${y}Z` }),
    triangle: () => svg("path", { d: `M${x} ${y - 5}L${x + 5} ${y + 4}L${x - 5} ${y + 4}Z` }),
    cross: () => svg("path", { d: `M${x - 4} ${y - 4}L${x + 4} ${y + 4}M${x - 4} ${y + 4}L${x + 4} ${y - 4}`, "stroke-width": 2 }),
  };
  const shape = shapes[kind]();
  shape.setAttribute("class", `marker series-${name}`);
  shape.append(svg("title", null, text));
  return shape;
}

function grid(xAxis, yAxis, xLabel, yLabel) {
  const { width, height, left, right, top, bottom } = PLOT;
  const lines = [];
  for (const tick of xAxis.ticks()) {
    const x = xAxis.at(tick.value);
    lines.push(svg("line", { x1: x, x2: x, y1: top, y2: height - bottom, class: tick.major ? "grid" : "grid minor" }));
    if (tick.labelled) {
      lines.push(svg("text", { x, y: height - bottom + 16, class: "tick", "text-anchor": "middle" }, tickText(tick.value)));
    }
  }
  for (const tick of yAxis.ticks()) {
    const y = yAxis.at(tick.value);
    lines.push(svg("line", { x1: left, x2: width - right, y1: y, y2: y, class: tick.major ? "grid" : "grid minor" }));
    if (tick.labelled) {
      lines.push(svg("text", { x: left - 7, y: y + 4, class: "tick", "text-anchor": "end" }, tickText(tick.value)));
    }
  }
  const middle = (height - bottom + top) / 2;
  lines.push(svg("text", { x: (left + width - right) / 2, y: height - 6, class: "axis", "text-anchor": "middle" }, xLabel),
    svg("text", { x: 13, y: middle, class: "axis", "text-anchor": "middle", transform: `rotate(-90 13 ${middle})` }, yLabel));
  return svg("g", { class: "grid-lines" }, lines);
}

/** Draws lines along which the error is proportional to 1 / x. */
function slopeGuides(xAxis, yAxis, clip) {
  const lines = [];
  const x1 = 10 ** xAxis.least;
  const x2 = 10 ** xAxis.most;
  const first = Math.floor(yAxis.least + xAxis.least);
  for (let log = first; log <= Math.ceil(yAxis.most + xAxis.most); ++log) {
    lines.push(svg("line", { x1: xAxis.at(x1), y1: yAxis.at(10 ** log / x1), x2: xAxis.at(x2), y2: yAxis.at(10 ** log / x2), class: "slope" }));
  }
  return svg("g", { "clip-path": `url(#${clip})` }, lines);
}

/** Moves labels apart, keeping the order of their preferred positions. */
function spreadLabels(labels, least, most) {
  labels.sort((a, b) => a.y - b.y);
  let floor = least;
  for (const label of labels) {
    label.y = Math.max(label.y, floor);
    floor = label.y + 15;
  }
  let ceiling = most;
  for (const label of [...labels].reverse()) {
    label.y = Math.min(label.y, ceiling);
    ceiling = label.y - 15;
  }
}

function drawSeries(one, order, xOf, xAxis, yAxis) {
  const name = one.integrator;
  const points = one.curve.map((point) => ({ x: xAxis.at(xOf(point)), y: yAxis.at(point.relmse.median),
    low: yAxis.at(point.relmse.least), high: yAxis.at(point.relmse.greatest), point }));
  const band = [...points.map((p) => `${p.x},${p.high}`), ...[...points].reverse().map((p) => `${p.x},${p.low}`)].join(" ");
  const line = points.map((p) => `${p.x},${p.y}`).join(" ");
  const marks = points.map((p) => marker(MARKERS[order % MARKERS.length], p.x, p.y, name,
    `${name}: relMSE ${scientific(p.point.relmse.median, 2)} (${scientific(p.point.relmse.least)} to ` +
    `${scientific(p.point.relmse.greatest)}) after ${thousands(p.point.samples)} samples, ${seconds(p.point.cpu_seconds)} of CPU time`));
  return { group: svg("g", null, svg("polygon", { points: band, class: `band series-${name}` }),
    svg("polyline", { points: line, class: `line series-${name}` }), marks),
  label: { name, y: points[points.length - 1].y + 4, x: points[points.length - 1].x } };
}

/** Plots error over `xOf` for all integrators: the median, and a band from the least to the greatest. */
function convergencePlot(scene, title, xLabel, xOf, id) {
  const { width, height, left, right, top, bottom } = PLOT;
  const points = scene.integrators.flatMap((one) => one.curve);
  const xAxis = new LogAxis(points.map(xOf), left, width - right);
  const yAxis = new LogAxis(points.flatMap((p) => [p.relmse.least, p.relmse.greatest]), height - bottom, top);
  const series = scene.integrators.map((one, i) => drawSeries(one, i, xOf, xAxis, yAxis));
  const labels = series.map((one) => one.label);
  spreadLabels(labels, top + 8, height - bottom);
  const texts = labels.map((label) =>
    svg("text", { x: width - right + 8, y: label.y, class: `label series-${label.name}` }, label.name));
  const image = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot", role: "img",
    "aria-label": `${title} in ${scene.name}: the numbers are in the table below` },
  svg("defs", null, svg("clipPath", { id }, svg("rect", { x: left, y: top, width: width - left - right, height: height - top - bottom }))),
  grid(xAxis, yAxis, xLabel, "relMSE"), slopeGuides(xAxis, yAxis, id), series.map((one) => one.group), texts);
  return html("figure", { class: "plot-box" }, html("figcaption", null, title), image);
}

/** Lists the numbers of the plots in a table. */
function curveTable(scene) {
  const rows = scene.integrators.flatMap((one) => one.curve.map((p) => [one.integrator, thousands(p.samples),
    seconds(p.cpu_seconds), scientific(p.relmse.median, 2), scientific(p.relmse.least, 2), scientific(p.relmse.greatest, 2)]));
  return html("details", null, html("summary", null, "The numbers of both plots"),
    table(`Convergence in ${scene.name}`, ["Integrator", "Samples", "CPU time", "relMSE, median", "Least", "Greatest"], rows));
}
