// False colours of errors. C++ generates them evenly spaced in CIE L*a*b*.

/** Decodes 256 colours as bytes: red, green, blue, red ... */
function readHeat(text) {
  const result = new Uint8ClampedArray(text.length / 2);
  for (let i = 0; i < result.length; ++i) {
    result[i] = parseInt(text.slice(2 * i, 2 * i + 2), 16);
  }
  return result;
}

/** Writes the colour of `place` in [0, 1] to the four bytes of `target` at `offset`. */
function setHeat(target, offset, heat, place) {
  const index = 3 * Math.round(255 * Math.min(Math.max(place, 0), 1));
  target[offset] = heat[index];
  target[offset + 1] = heat[index + 1];
  target[offset + 2] = heat[index + 2];
  target[offset + 3] = 255;
}

/** Draws the colours from left to right, with tick labels below. */
function colorBar(heat, label, ticks) {
  const count = heat.length / 3;
  const canvas = html("canvas", { width: count, height: 1, class: "colors", "aria-hidden": "true" });
  const context = canvas.getContext("2d");
  const row = context.createImageData(count, 1);
  for (let i = 0; i < count; ++i) {
    row.data.set([heat[3 * i], heat[3 * i + 1], heat[3 * i + 2], 255], 4 * i);
  }
  context.putImageData(row, 0, 0);
  const marks = ticks.map(([place, text]) => html("span", { style: `left:${100 * place}%` }, text));
  return html("div", { class: "colorbar", role: "img",
    "aria-label": `${label}: from ${ticks[0][1]} (dark) to ${ticks[ticks.length - 1][1]} (bright)` },
  html("span", { class: "what" }, label), html("div", { class: "scale" }, canvas,
    html("div", { class: "ticks", "aria-hidden": "true" }, marks)));
}
