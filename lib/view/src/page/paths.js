// Shows an inspected sample: draws its paths over the picture and lists its vertices and strategies in tables.

class Inspector {
  constructor(stage) {
    this.stage = stage;
    this.sample = null;
    this.chosen = null;
  }

  show(sample) {
    this.sample = sample;
    this.chosen = null;
    const box = byId("inspector");
    box.replaceChildren(this.head(), html("div", { class: "tables" },
      this.strategyTable(), this.vertexTable("Camera path", "key-camera", sample.camera_path),
      sample.light_path.length ? this.vertexTable("Light path", "key-light", sample.light_path) : null));
    box.hidden = false;
    announce(`Pixel ${sample.pixel[0]}, ${sample.pixel[1]}: ${sample.contributions.length} strategies bring light`);
    this.draw();
  }

  clear() {
    this.sample = null;
    byId("inspector").hidden = true;
    byId("inspector").replaceChildren();
    this.draw();
  }

  head() {
    const { pixel, sample, value } = this.sample;
    return html("div", { class: "inspector-head" },
      html("h2", null, `Pixel ${pixel[0]}, ${pixel[1]}, sample ${sample}`),
      html("span", { class: "value" }, `${colorText(value)} nit`),
      html("button", { type: "button", id: "other-sample", title: "The next sample of this pixel", "aria-keyshortcuts": "N" }, "Next sample"),
      html("button", { type: "button", id: "close-inspector", "aria-label": "Close the inspected pixel" }, "Close"));
  }

  vertexTable(title, key, path) {
    const rows = path.map((vertex, i) => [String(i), vertex.on, vertex.position.map((x) => digits(x)).join(", "),
      colorText(vertex.throughput), digits(vertex.pdf), describeScattering(vertex)]);
    const result = table(title, ["", "on", "position [m]", "throughput", "density", "scatters"], rows);
    result.querySelector("caption").classList.add(key);
    return result;
  }

  /**
   * Lists the strategies that contribute, brightest first; the button in a row draws how its strategy connects the
   * subpaths.
   */
  strategyTable() {
    const brings = (one) => one.unweighted.map((x) => x * one.weight);
    const brightness = (one) => brings(one).reduce((sum, x) => sum + x, 0);
    const sorted = [...this.sample.contributions].sort((a, b) => brightness(b) - brightness(a));
    this.buttons = sorted.map((one) => html("button", { type: "button", class: "quiet", "aria-pressed": "false",
      onclick: () => this.choose(one) }, `s${one.s} t${one.t}`));
    this.sorted = sorted;
    const rows = sorted.map((one, i) => [this.buttons[i], colorText(one.unweighted), digits(one.weight), colorText(brings(one))]);
    if (rows.length === 0) {
      return html("p", { class: "note" }, "No strategy brings light to this pixel in this sample.");
    }
    return table("Strategies; choose one to see its connection", ["strategy", "alone [nit]", "weight", "brings [nit]"], rows);
  }

  choose(contribution) {
    this.chosen = this.chosen === contribution ? null : contribution;
    this.buttons.forEach((button, i) => button.setAttribute("aria-pressed", String(this.sorted[i] === this.chosen)));
    this.draw();
  }

  draw() {
    const overlay = byId("overlay");
    overlay.replaceChildren();
    if (!this.sample) {
      return;
    }
    const { camera_path: camera, light_path: light } = this.sample;
    const chosen = this.chosen;
    if (chosen) {
      this.drawPath(overlay, light.slice(0, chosen.s), "light");
      this.drawPath(overlay, camera.slice(0, chosen.t), "camera");
      const ends = [camera[chosen.t - 1], light[chosen.s - 1]];
      if (ends.every((vertex) => vertex && vertex.raster)) {
        overlay.append(...this.segment(ends[0], ends[1], "join"));
      }
    } else {
      this.drawPath(overlay, light, "light");
      this.drawPath(overlay, camera, "camera");
    }
    this.drawPixel(overlay);
  }

  drawPath(overlay, path, kind) {
    for (let i = 1; i < path.length; ++i) {
      if (path[i - 1].raster && path[i].raster) {
        overlay.append(...this.segment(path[i - 1], path[i], kind));
      }
    }
    path.forEach((vertex, i) => {
      if (vertex.raster) {
        const [x, y] = this.stage.onScreen(vertex.raster);
        overlay.append(svg("circle", { cx: x, cy: y, r: 5, class: `path-${kind}` }),
          svg("text", { x: x + 8, y: y - 6 }, `${kind === "camera" ? "c" : "l"}${i}`));
      }
    });
  }

  segment(from, to, kind) {
    const [x1, y1] = this.stage.onScreen(from.raster);
    const [x2, y2] = this.stage.onScreen(to.raster);
    return [svg("line", { x1, y1, x2, y2, class: "under" }), svg("line", { x1, y1, x2, y2, class: `path-${kind}` })];
  }

  drawPixel(overlay) {
    const [x, y] = this.sample.pixel;
    const [left, top] = this.stage.onScreen([x, y]);
    const [right, bottom] = this.stage.onScreen([x + 1, y + 1]);
    const size = Math.max(right - left, bottom - top, 9);
    overlay.append(svg("rect", { x: (left + right - size) / 2, y: (top + bottom - size) / 2, width: size, height: size, class: "pixel-mark" }));
  }
}

function colorText(color) {
  return color.map((x) => digits(x)).join(" ");
}

/** Describes how the walk continued at a vertex, and whether the vertex can be connected. */
function describeScattering(vertex) {
  return vertex.connectible === false ? "delta" : vertex.scattered_delta ? "by a delta lobe" : "";
}
