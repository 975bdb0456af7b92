// Holds radiance as the server sends it: tiles of half floats.

/** Values of all 65536 half floats [IEEE 754]. */
const HALF_VALUES = Float32Array.from({ length: 65536 }, (_, bits) => {
  const exponent = bits >>> 10 & 31;
  const fraction = bits & 1023;
  const size = exponent === 0 ? fraction * 2 ** -24
    : exponent === 31 ? (fraction ? NaN : Infinity) : (1024 + fraction) * 2 ** (exponent - 25);
  return bits & 0x8000 ? -size : size;
});

/** Returns the linear colour of a code like "#ff8000"; null if there is none. */
function linearColor(text) {
  const codes = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(text || "");
  return codes && codes.slice(1).map((code) => {
    const value = parseInt(code, 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  });
}

/**
 * Tone-maps radiance over `background` into `target` (RGBA bytes) as the command does; without a background (null) the
 * pixels are transparent. `cover` holds two shares for each pixel: of its own light, and of the visible background.
 */
function toneMapOver(rgb, cover, target, { gain, curve, background }) {
  const { map } = CURVES[curve];
  const out = new Float64Array(3);
  for (let i = 0, p = 0, o = 0; i < rgb.length; i += 3, p += 2, o += 4) {
    const own = cover[p];
    const open = cover[p + 1];
    const alpha = 1 - open;
    out.fill(0);
    if (own > 0) {
      map(rgb[i] * gain / own, rgb[i + 1] * gain / own, rgb[i + 2] * gain / own, out);
    }
    for (let channel = 0; channel < 3; ++channel) {
      const light = background ? own * out[channel] + open * background[channel] : alpha > 0 ? own / alpha * out[channel] : 0;
      target[o + channel] = SRGB[Math.min(light, 1) * SRGB_STEPS + 0.5 | 0];
    }
    target[o + 3] = background ? 255 : Math.round(255 * alpha);
  }
}

/**
 * A progressive image: the linear radiance of a pixel grid, which is coarser than the image at first, and its
 * tone-mapped canvas.
 */
class Radiance {
  constructor() {
    this.width = 0;
    this.height = 0;
    this.rgb = new Float32Array(0);
    this.cover = null;
    this.canvas = html("canvas", { width: 1, height: 1 });
    this.context = this.canvas.getContext("2d", { willReadFrequently: true });
    this.empty = true;
  }

  /** Allocates the grid; `channels` is 3, or 5 with the two shares of `cover`. */
  resize(width, height, channels) {
    const covers = channels === 5;
    if (width === this.width && height === this.height && covers === (this.cover !== null)) {
      return;
    }
    this.width = width;
    this.height = height;
    this.rgb = new Float32Array(3 * width * height);
    this.cover = covers ? new Float32Array(2 * width * height) : null;
    this.canvas.width = width;
    this.canvas.height = height;
  }

  /** Stores a tile of half floats, rows from the top. */
  put(x, y, width, height, halves) {
    let h = 0;
    for (let row = 0; row < height; ++row) {
      const begin = (y + row) * this.width + x;
      for (let i = begin; i < begin + width; ++i) {
        this.rgb[3 * i] = HALF_VALUES[halves[h++]];
        this.rgb[3 * i + 1] = HALF_VALUES[halves[h++]];
        this.rgb[3 * i + 2] = HALF_VALUES[halves[h++]];
        if (this.cover) {
          this.cover[2 * i] = HALF_VALUES[halves[h++]];
          this.cover[2 * i + 1] = HALF_VALUES[halves[h++]];
        }
      }
    }
    this.empty = false;
  }

  clear() {
    this.empty = true;
  }

  /** Copies a rectangle out of `values`, which has `channels` values for each pixel. */
  part(values, channels, x, y, width, height) {
    if (!values || (width === this.width && height === this.height)) {
      return values;
    }
    const part = new Float32Array(channels * width * height);
    for (let row = 0; row < height; ++row) {
      const begin = channels * ((y + row) * this.width + x);
      part.set(values.subarray(begin, begin + channels * width), channels * row * width);
    }
    return part;
  }

  /** Paints a rectangle of the canvas; `paint(rgb, target, cover)` converts radiance to RGBA bytes. */
  develop(paint, x = 0, y = 0, width = this.width, height = this.height) {
    if (this.width === 0 || width === 0 || height === 0) {
      return;
    }
    const image = this.context.createImageData(width, height);
    paint(this.part(this.rgb, 3, x, y, width, height), image.data, this.part(this.cover, 2, x, y, width, height));
    this.context.putImageData(image, x, y);
  }

  /** Returns the radiance of the pixel at a place in [0, 1]. */
  at(place) {
    const x = Math.min(Math.max(Math.floor(place[0] * this.width), 0), this.width - 1);
    const y = Math.min(Math.max(Math.floor(place[1] * this.height), 0), this.height - 1);
    const i = 3 * (y * this.width + x);
    return [this.rgb[i], this.rgb[i + 1], this.rgb[i + 2]];
  }
}
