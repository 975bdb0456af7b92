// Shows the pyramid of strategies and the map of path lengths.

/** Draws radiance into a new canvas. */
async function thumbnail(text, strategies, scale, exposure, label) {
  const rgb = await unpackImage(text, scale);
  const canvas = html("canvas", { width: strategies.width, height: strategies.height, role: "img", "aria-label": label });
  const context = canvas.getContext("2d");
  const image = context.createImageData(strategies.width, strategies.height);
  toneMap(rgb, image.data, { gain: 2 ** exposure, curve: "filmic", gamma: 1 });
  context.putImageData(image, 0, 0);
  return canvas;
}

function meter(share, what) {
  return html("span", { class: `meter ${what}`, style: `--share:${(100 * Math.min(share, 1)).toFixed(1)}%`,
    title: `${percent(share)} of ${what}` }, percent(share));
}

async function pyramid(scene, kind, title) {
  const strategies = scene.strategies;
  const list = strategies.strategies;
  const energy = strategies.light;
  const variance = list.reduce((sum, one) => sum + one[kind].variance, 0);
  const rows = [];
  for (let length = 1; length <= strategies.depth; ++length) {
    const row = list.filter((one) => one.s + one.t - 1 === length).sort((a, b) => a.s - b.s);
    const cells = await Promise.all(row.map(async (one) => {
      const part = one[kind];
      const energyShare = energy > 0 ? part.energy / energy : 0;
      const varianceShare = variance > 0 ? part.variance / variance : 0;
      // Brightens by one stop for each edge, because long paths carry little light.
      const canvas = await thumbnail(part.picture, strategies, scene.pictures.scale,
        scene.pictures.exposure + length - 1, `s=${one.s}, t=${one.t}: ${percent(energyShare)} of energy, ${percent(varianceShare)} of variance`);
      return html("li", null, canvas, html("span", { class: "name" }, `s${one.s} t${one.t}`),
        meter(energyShare, "energy"), meter(varianceShare, "variance"));
    }));
    rows.push(html("div", { class: "row" }, html("span", { class: "length" }, `${length}`), html("ol", null, cells)));
  }
  return html("figure", { class: `pyramid ${kind}` }, html("figcaption", null, title), html("div", { class: "rows" }, rows));
}

/** Draws the mean length of the paths that contribute to each pixel. */
async function lengthMap(scene, heat) {
  if (!scene.strategies) {
    return null;
  }
  const map = await unpackBytes(scene.strategies.lengths);
  const canvas = html("canvas", { width: scene.width, height: scene.height, class: "map", role: "img",
    "aria-label": "Mean length of the paths that bring each pixel its light" });
  const context = canvas.getContext("2d");
  const image = context.createImageData(scene.width, scene.height);
  const depth = scene.strategies.depth;
  for (let i = 0; i < map.length; ++i) {
    setHeat(image.data, 4 * i, heat, map[i] ? (map[i] / 32 - 1) / Math.max(depth - 1, 1) : 0);
  }
  context.putImageData(image, 0, 0);
  const ticks = Array.from({ length: depth }, (_, k) => [depth > 1 ? k / (depth - 1) : 0, String(k + 1)]);
  return html("figure", { class: "lengths" }, html("figcaption", null, "Mean length of paths [edges]"), canvas,
    colorBar(heat, "weighted by their light", ticks));
}

async function strategySection(scene, heat) {
  const strategies = scene.strategies;
  if (!strategies || strategies.strategies.length === 0) {
    return null;
  }
  return html("section", { class: "strategies" }, html("h3", null, "Strategies of bdpt"),
    html("p", { class: "note" }, `Rows: length of paths in edges, up to ${strategies.depth}; columns: s, vertices from the light, growing to the right. ` +
      "Each row is shown one stop brighter than the one above. ",
    html("span", { class: "key energy" }, "share of the image's energy"), " ",
    html("span", { class: "key variance" }, "share of the variance of all")),
    html("div", { class: "pyramids" }, await pyramid(scene, "weighted", "Weighted: their part of the image"),
      await pyramid(scene, "unweighted", "Unweighted: what each finds by itself")));
}
