// Shows the picture: one image, or two side by side with a wiper between them.

/** The canvas of the page. Slot 0 shows integrator A, slot 1 shows B. */
class Stage extends Pane {
  constructor() {
    super(new View(), 4, 3, "Picture of the scene");
    this.smoothBelow = 2.5;
    this.canvas.tabIndex = 0;
    this.canvas.classList.add("stage");
    this.slots = [new Radiance(), new Radiance()];
    this.wiper = 0.5;
    this.pair = false;
    this.paint = null;
    this.drawn = () => {};
  }

  /** Sets the size of the full image [pixels]; the received grids may be coarser. */
  setSize(width, height) {
    this.size = [width, height];
    this.canvas.style.aspectRatio = `${width}/${height}`;
    byId("stage-box").style.setProperty("--aspect", width / height);
    this.requestDraw();
  }

  /**
   * Sets how radiance is converted to colours: `paint(rgb, target)`. Repaints everything, or, if `waits`, only paints
   * tiles that arrive from now on.
   */
  setPaint(paint, waits = false) {
    this.paint = paint;
    if (!waits) {
      this.slots.forEach((slot) => slot.develop(paint));
      this.requestDraw();
    }
  }

  setPair(pair) {
    this.pair = pair;
    byId("wiper").hidden = !pair;
    if (!pair) {
      this.slots[1].clear();
    }
    this.requestDraw();
  }

  setWiper(place) {
    this.wiper = Math.min(Math.max(place, 0), 1);
    const wiper = byId("wiper");
    byId("stage-box").style.setProperty("--wiper", this.wiper);
    wiper.setAttribute("aria-valuenow", Math.round(100 * this.wiper));
    this.requestDraw();
  }

  /** Stores and paints a tile of a grid that covers the whole image. */
  put(slot, grid, tile, halves, channels) {
    const radiance = this.slots[slot];
    radiance.resize(grid.width, grid.height, channels);
    radiance.put(tile.x, tile.y, tile.width, tile.height, halves);
    radiance.develop(this.paint, tile.x, tile.y, tile.width, tile.height);
    this.requestDraw();
  }

  requestDraw() {
    drawSoon(this, () => this.drawAll());
  }

  drawAll() {
    const [a, b] = this.slots;
    if (a.empty && b.empty) {
      return;
    }
    const context = this.canvas.getContext("2d");
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.draw(a.canvas, null);
    if (this.pair && !b.empty) {
      const left = Math.round(this.wiper * this.canvas.width);
      context.save();
      context.beginPath();
      context.rect(left, 0, this.canvas.width - left, this.canvas.height);
      context.clip();
      context.clearRect(0, 0, this.canvas.width, this.canvas.height);
      this.draw(b.canvas, null);
      context.restore();
    }
    this.drawn();
  }

  /** Converts a position in the image [pixels] to CSS pixels of the box. */
  onScreen([px, py]) {
    const { x, y, zoom } = this.view;
    return [((px / this.size[0] - x) * zoom + 0.5) * this.canvas.clientWidth,
      ((py / this.size[1] - y) * zoom + 0.5) * this.canvas.clientHeight];
  }
}

/** Moves the wiper by pointer and by keys. */
function bindWiper(stage) {
  const wiper = byId("wiper");
  const move = (event) => {
    const box = byId("stage-box").getBoundingClientRect();
    stage.setWiper((event.clientX - box.left) / box.width);
  };
  wiper.addEventListener("pointerdown", (event) => {
    wiper.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  wiper.addEventListener("pointermove", (event) => {
    if (event.buttons) {
      move(event);
    }
  });
  wiper.addEventListener("keydown", (event) => {
    const steps = { ArrowLeft: -0.02, ArrowRight: 0.02, PageDown: -0.1, PageUp: 0.1, Home: -1, End: 1 };
    if (steps[event.key]) {
      stage.setWiper(stage.wiper + steps[event.key]);
      event.preventDefault();
      event.stopPropagation();
    }
  });
  stage.setWiper(0.5);
}
