// Light as it comes from the server: half floats in tiles.

/** The values of all half floats [IEEE 754]. */
const HALF_VALUES = Float32Array.from({ length: 65536 }, (_, bits) => {
  const exponent = bits >>> 10 & 31;
  const fraction = bits & 1023;
  const size = exponent === 0 ? fraction * 2 ** -24
    : exponent === 31 ? (fraction ? NaN : Infinity) : (1024 + fraction) * 2 ** (exponent - 25);
  return bits & 0x8000 ? -size : size;
});

/** An image that grows: linear light of a grid of pixels, coarser than the image at first, and its look on the screen. */
class Radiance {
  constructor() {
    this.width = 0;
    this.height = 0;
    this.rgb = new Float32Array(0);
    this.canvas = html("canvas", { width: 1, height: 1 });
    this.context = this.canvas.getContext("2d", { willReadFrequently: true });
    this.empty = true;
  }

  resize(width, height) {
    if (width === this.width && height === this.height) {
      return;
    }
    this.width = width;
    this.height = height;
    this.rgb = new Float32Array(3 * width * height);
    this.canvas.width = width;
    this.canvas.height = height;
  }

  /** Takes over a tile of half floats: three for each pixel, rows from the top. */
  put(x, y, width, height, halves) {
    for (let row = 0; row < height; ++row) {
      let o = 3 * ((y + row) * this.width + x);
      const begin = 3 * row * width;
      for (let i = begin; i < begin + 3 * width; ++i) {
        this.rgb[o++] = HALF_VALUES[halves[i]];
      }
    }
    this.empty = false;
  }

  clear() {
    this.empty = true;
  }

  /** Paints a part of the canvas; `paint(rgb, target)` makes RGBA bytes of light. */
  develop(paint, x = 0, y = 0, width = this.width, height = this.height) {
    if (this.width === 0 || width === 0 || height === 0) {
      return;
    }
    const image = this.context.createImageData(width, height);
    if (width === this.width && height === this.height) {
      paint(this.rgb, image.data);
    } else {
      const part = new Float32Array(3 * width * height);
      for (let row = 0; row < height; ++row) {
        const begin = 3 * ((y + row) * this.width + x);
        part.set(this.rgb.subarray(begin, begin + 3 * width), 3 * row * width);
      }
      paint(part, image.data);
    }
    this.context.putImageData(image, x, y);
  }

  /** Light of the pixel at a place in [0, 1]. */
  at(place) {
    const x = Math.min(Math.max(Math.floor(place[0] * this.width), 0), this.width - 1);
    const y = Math.min(Math.max(Math.floor(place[1] * this.height), 0), this.height - 1);
    const i = 3 * (y * this.width + x);
    return [this.rgb[i], this.rgb[i + 1], this.rgb[i + 2]];
  }
}
