// Defines canvases that show the images of a scene through a common view.

const MOST_ZOOM = 64;

/** The visible part of an image: its centre in [0, 1] and its magnification. */
class View {
  constructor() {
    this.reset();
  }

  reset() {
    this.x = 0.5;
    this.y = 0.5;
    this.zoom = 1;
  }

  /** Magnifies by `factor`, keeping the position (x, y) of the image in place. */
  zoomAt(factor, x, y) {
    const zoom = Math.min(Math.max(this.zoom * factor, 1), MOST_ZOOM);
    this.x = x + (this.x - x) * this.zoom / zoom;
    this.y = y + (this.y - y) * this.zoom / zoom;
    this.zoom = zoom;
    this.clamp();
  }

  pan(dx, dy) {
    this.x += dx;
    this.y += dy;
    this.clamp();
  }

  clamp() {
    const margin = 0.5 / this.zoom;
    this.x = Math.min(Math.max(this.x, margin), 1 - margin);
    this.y = Math.min(Math.max(this.y, margin), 1 - margin);
  }
}

/** Calls `draw` before the next repaint, once however often `owner` asks. */
function drawSoon(owner, draw) {
  if (!owner.pending) {
    owner.pending = requestAnimationFrame(() => {
      owner.pending = 0;
      draw();
    });
  }
}

/** A canvas that shows an image through a View. */
class Pane {
  constructor(view, width, height, label) {
    this.view = view;
    this.size = [width, height];
    this.smoothBelow = 1;  // pixels are interpolated below this magnification
    this.canvas = html("canvas", { class: "pane", role: "img", "aria-label": label,
      style: `aspect-ratio:${width}/${height}` });
  }

  /** Matches the canvas resolution to the screen; returns [width, height] in pixels. */
  fit() {
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(Math.round(this.canvas.clientWidth * ratio), 1);
    const height = Math.max(Math.round(width * this.size[1] / this.size[0]), 1);
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    return [width, height];
  }

  /** Draws `source`, a canvas of any resolution, and a mark at `cursor`, a position in the image. */
  draw(source, cursor) {
    const [width, height] = this.fit();
    const context = this.canvas.getContext("2d");
    const { x, y, zoom } = this.view;
    const scale = zoom * width / this.size[0];
    context.imageSmoothingEnabled = scale < this.smoothBelow || source.width < this.size[0];
    context.setTransform(scale, 0, 0, zoom * height / this.size[1], width / 2 - x * zoom * width,
      height / 2 - y * zoom * height);
    context.drawImage(source, 0, 0, this.size[0], this.size[1]);
    context.setTransform(1, 0, 0, 1, 0, 0);
    if (cursor) {
      this.mark(context, cursor, width, height, scale);
    }
  }

  mark(context, [px, py], width, height, scale) {
    const { x, y, zoom } = this.view;
    const left = (((px + 0.5) / this.size[0] - x) * zoom + 0.5) * width;
    const top = (((py + 0.5) / this.size[1] - y) * zoom + 0.5) * height;
    const half = Math.max(scale / 2, 3);
    for (const [color, line] of [["#000", 3], ["#fff", 1.2]]) {
      context.strokeStyle = color;
      context.lineWidth = line;
      context.strokeRect(left - half, top - half, 2 * half, 2 * half);
    }
  }

  /** Returns the position in the image, in [0, 1], under the pointer. */
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    const { x, y, zoom } = this.view;
    return [x + ((event.clientX - box.left) / box.width - 0.5) / zoom,
      y + ((event.clientY - box.top) / box.height - 0.5) / zoom];
  }

  /** Returns the image pixel under the pointer, or null outside of the image. */
  pixel(event) {
    const [x, y] = this.place(event);
    return x >= 0 && y >= 0 && x < 1 && y < 1 ? [Math.floor(x * this.size[0]), Math.floor(y * this.size[1])] : null;
  }

  /** Magnifies by a turn of the wheel. */
  zoomByWheel(event) {
    const lines = event.deltaMode === 1 ? 16 : 1;
    this.view.zoomAt(2 ** (-lines * event.deltaY / 240), ...this.place(event));
  }

  /** Handles zoom, pan and pointer moves; calls `changed(cursor)` after each. */
  listen(changed) {
    const canvas = this.canvas;
    let drag = null;
    canvas.addEventListener("pointerdown", (event) => {
      drag = this.place(event);
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (drag && event.buttons) {
        const now = this.place(event);
        this.view.pan(drag[0] - now[0], drag[1] - now[1]);
      }
      changed(this.pixel(event));
    });
    canvas.addEventListener("pointerup", () => { drag = null; });
    canvas.addEventListener("pointerleave", () => changed(null));
    canvas.addEventListener("dblclick", (event) => {
      this.view.zoomAt(event.shiftKey ? 0.5 : 2, ...this.place(event));
      changed(this.pixel(event));
    });
    canvas.addEventListener("wheel", (event) => {
      // Without a modifier key the wheel scrolls the page, unless the image has the focus.
      if (event.ctrlKey || event.metaKey || document.activeElement === canvas) {
        event.preventDefault();
        this.zoomByWheel(event);
        changed(this.pixel(event));
      }
    }, { passive: false });
  }
}
