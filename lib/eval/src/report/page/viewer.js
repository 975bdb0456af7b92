// Shows the images of a scene: one large, all as thumbnails, and their values under the pointer.

const REFERENCE = "reference";
const MODES = { picture: "Image", error: "Error", variance: "Variance" };

/** Display settings of all images on the page. */
const display = { mode: "picture", exposure: 0, gamma: 1, curve: "filmic", metric: "relative", shown: 0 };

class Viewer {
  constructor(scene, heat) {
    this.scene = scene;
    this.heat = heat;
    this.names = [...scene.integrators.map((one) => one.integrator).filter((name) => scene.pictures.images[name]),
      REFERENCE];
    this.view = new View();
    this.cursor = null;
    this.visible = false;
    this.stale = true;
    this.stage = new Pane(this.view, scene.width, scene.height, `${scene.name}: the image that is shown`);
    this.stage.canvas.tabIndex = 0;
    this.stage.canvas.classList.add("stage");
    this.tiles = this.names.map((name) => new Pane(this.view, scene.width, scene.height, `${scene.name} by ${name}`));
    this.sources = this.names.map(() => html("canvas", { width: scene.width, height: scene.height }));
  }

  async load() {
    const { images, variance, scale } = this.scene.pictures;
    this.rgb = await Promise.all(this.names.map((name) => unpackImage(images[name], scale)));
    this.variances = await Promise.all(this.names.map((name) => (variance[name] ? unpackBytes(variance[name]) : null)));
  }

  get reference() {
    return this.rgb[this.rgb.length - 1];
  }

  /** Index of the image on the stage. */
  get shown() {
    return Math.min(display.shown, this.names.length - 1);
  }

  /** Creates the elements; `more` is placed beside the large image. */
  element(more) {
    const redraw = (cursor) => {
      this.cursor = cursor;
      this.requestDraw();
    };
    for (const pane of [this.stage, ...this.tiles]) {
      pane.listen(redraw);
    }
    this.stage.canvas.addEventListener("keydown", (event) => this.key(event));
    this.title = html("span", { class: "shown-name" });
    this.hint = html("span", { class: "hint" });
    this.legend = html("div", { class: "legend" });
    const zoomTo = (factor) => () => {
      this.view.zoomAt(factor, this.view.x, this.view.y);
      this.requestDraw();
    };
    const buttons = html("div", { class: "zoom" },
      html("button", { type: "button", title: "Zoom in", "aria-label": "Zoom in", onclick: zoomTo(2) }, "+"),
      html("button", { type: "button", title: "Zoom out", "aria-label": "Zoom out", onclick: zoomTo(0.5) }, "−"),
      html("button", { type: "button", title: "Whole image", onclick: () => { this.view.reset(); this.requestDraw(); } }, "Fit"));
    const root = html("div", { class: "viewer" },
      html("div", { class: "stage-box" }, this.stage.canvas, html("div", { class: "stage-label" }, this.title, this.hint),
        buttons),
      html("div", { class: "side" }, this.readout(), this.legend, more),
      html("div", { class: "strip", style: `--tiles:${this.names.length}` },
        this.names.map((name, i) => this.tile(name, i))));
    new IntersectionObserver((entries) => {
      this.visible = entries[entries.length - 1].isIntersecting;
      this.requestDraw();
    }, { rootMargin: "200px" }).observe(root);
    new ResizeObserver(() => this.requestDraw()).observe(root);
    return root;
  }

  tile(name, i) {
    const summary = this.scene.integrators.find((one) => one.integrator === name);
    const numbers = summary
      ? html("span", { class: "sub" }, `${thousands(summary.equal_time.samples)} spp · relMSE `,
        scientific(summary.equal_time.relmse.median))
      : html("span", { class: "sub" }, "what all converge to");
    const button = html("button", { type: "button", class: `tile-name series-${name}`, onclick: () => show(i) },
      html("kbd", null, String(i + 1)), ` ${name}`);
    return html("figure", { class: "tile" }, this.tiles[i].canvas, html("figcaption", null, button, numbers));
  }

  /** Creates the table of all images' values at the pointer; its buttons choose the large image. */
  readout() {
    this.rows = this.names.map((name, i) => {
      const cells = [0, 1, 2, 3].map(() => html("td", { class: "number" }, "–"));
      const swatch = html("span", { class: "pixel" });
      const button = html("button", { type: "button", class: `pick series-${name}`, "aria-pressed": "false",
        onclick: () => show(i) }, html("kbd", null, String(i + 1)), html("span", { class: "dot" }), name);
      return { button, swatch, cells, row: html("tr", null, html("th", { scope: "row" }, button), html("td", null, swatch), cells) };
    });
    this.where = html("caption", { class: "where" }, "Radiance under the pointer");
    return html("table", { class: "readout" }, this.where,
      html("thead", null, html("tr", null, html("th", { scope: "col" }, "Image"), html("th", null, html("span", { class: "hidden" }, "Colour")),
        ["R", "G", "B", "Error"].map((text) => html("th", { scope: "col", class: "number" }, text)))),
      html("tbody", null, this.rows.map((one) => one.row)));
  }

  key(event) {
    const step = 0.1 / this.view.zoom;
    const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
    if (event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    if (moves[event.key]) {
      this.view.pan(...moves[event.key]);
    } else if (event.key === "+" || event.key === "=") {
      this.view.zoomAt(1.5, this.view.x, this.view.y);
    } else if (event.key === "-") {
      this.view.zoomAt(1 / 1.5, this.view.x, this.view.y);
    } else if (event.key === "0") {
      this.view.reset();
    } else {
      return;
    }
    event.preventDefault();
    this.requestDraw();
  }

  /** Redraws everything after a change of `display`. */
  invalidate() {
    this.stale = true;
    this.requestDraw();
  }

  requestDraw() {
    if (this.visible) {
      drawSoon(this, () => this.draw());
    }
  }

  draw() {
    if (this.stale) {
      this.names.forEach((_, i) => this.develop(i));
      this.drawLegend();
      this.stale = false;
    }
    this.stage.draw(this.sources[this.shown], this.view.zoom >= 4 ? this.cursor : null);
    this.tiles.forEach((pane, i) => pane.draw(this.sources[i], this.cursor));
    const name = this.names[this.shown];
    this.title.textContent = `${this.shown + 1} ${name}`;
    this.title.className = `shown-name series-${name}`;
    this.hint.textContent = this.view.zoom > 1 ? `${Number(this.view.zoom.toPrecision(2))}×` : "";
    this.stage.canvas.setAttribute("aria-label",
      `${this.scene.name} by ${name}, shown as ${MODES[display.mode].toLowerCase()}`);
    this.drawReadout();
  }

  /** Paints image `i` with the settings in `display`. */
  develop(i) {
    const context = this.sources[i].getContext("2d", { willReadFrequently: true });
    const image = context.createImageData(this.scene.width, this.scene.height);
    const { epsilon, exposure } = this.scene.pictures;
    const isReference = this.names[i] === REFERENCE;
    if (display.mode === "error" && !isReference) {
      errorMap(this.rgb[i], this.reference, image.data, display.metric, epsilon, this.heat);
    } else if (display.mode === "variance" && this.variances[i]) {
      varianceMap(this.variances[i], image.data, this.heat);
    } else {
      toneMap(this.rgb[i], image.data,
        { gain: 2 ** (exposure + display.exposure), curve: display.curve, gamma: display.gamma });
    }
    context.putImageData(image, 0, 0);
  }

  drawLegend() {
    const metric = METRICS[display.metric];
    const content = {
      picture: () => html("p", { class: "note" },
        `Shown at ${digits(this.scene.pictures.exposure + display.exposure)} EV. Drag to pan, double-click or Ctrl + wheel to zoom; keys 1 to ${this.names.length} flip, P, E, V choose what is shown, comma and full stop the exposure.`),
      error: () => colorBar(this.heat, `Error of this image, ${metric.label}`, metric.ticks),
      variance: () => colorBar(this.heat, "Variance between seeds, relative", METRICS.relative.ticks),
    };
    this.legend.replaceChildren(content[display.mode]());
  }

  drawReadout() {
    const { width, pictures } = this.scene;
    this.where.textContent = this.cursor ? `Radiance at pixel ${this.cursor[0]}, ${this.cursor[1]} [nit]`
      : "Radiance under the pointer [nit]";
    this.rows.forEach(({ button, swatch, cells }, i) => {
      button.setAttribute("aria-pressed", String(i === this.shown));
      if (!this.cursor) {
        cells.forEach((cell) => { cell.textContent = "–"; });
        swatch.style.background = "none";
        return;
      }
      const pixel = this.cursor[1] * width + this.cursor[0];
      for (let c = 0; c < 3; ++c) {
        cells[c].textContent = digits(this.rgb[i][3 * pixel + c]);
      }
      cells[3].textContent = this.names[i] === REFERENCE ? "–"
        : digits(errorAt(this.rgb[i], this.reference, pixel, display.metric, pictures.epsilon), 2);
      const color = this.sources[i].getContext("2d").getImageData(...this.cursor, 1, 1).data;
      swatch.style.background = `rgb(${color[0]},${color[1]},${color[2]})`;
    });
  }
}
