// Speed-up at equal error as bars on a logarithmic scale around 1.

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
      svg("text", { x: ahead ? x + 7 : Math.max(one, x) + 7, y: y + 15, class: "value" }, times(row.speed_up)));
  });
  const spoken = rows.map((row) => `${row.integrator} ${times(row.speed_up)}`).join(", ");
  return html("figure", { class: "plot-box" }, html("figcaption", null, "Speed-up at equal error, over pt"),
    svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot bars", role: "img",
      "aria-label": `Speed-up at equal error over pt in ${scene.name}: ${spoken}` }, ticks, bars));
}
