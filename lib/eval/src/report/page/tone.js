// From light to a screen.

const SRGB_STEPS = 4096;
const SRGB = Uint8ClampedArray.from({ length: SRGB_STEPS + 1 }, (_, i) => {
  const x = i / SRGB_STEPS;
  return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
});

/** Curves on the largest component, from [0, inf) to [0, 1]; `fade`: how fast colours above 1 become white. */
const CURVES = {
  filmic: {
    name: "Filmic",
    map: (x) => Math.min((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 1),
    fade: 0.15,
  },
  reinhard: { name: "Reinhard", map: (x) => x / (1 + x), fade: 0 },
  linear: { name: "Linear", map: (x) => Math.min(x, 1), fade: 0 },
};

/** Draws light into `target` (RGBA bytes). Hues stay but for the fade: all components are scaled alike. */
function toneMap(rgb, target, { gain, curve, gamma }) {
  const { map, fade } = CURVES[curve];
  for (let i = 0, o = 0; i < rgb.length; i += 3, o += 4) {
    const r = rgb[i] * gain;
    const g = rgb[i + 1] * gain;
    const b = rgb[i + 2] * gain;
    const most = Math.max(r, g, b);
    const excess = fade * Math.max(most - 1, 0);
    const white = excess / (1 + excess);
    const shown = most > 0 ? SRGB_STEPS * map(most) ** gamma : 0;
    const k = most > 0 ? shown * (1 - white) / most : 0;
    target[o] = SRGB[r * k + white * shown | 0];
    target[o + 1] = SRGB[g * k + white * shown | 0];
    target[o + 2] = SRGB[b * k + white * shown | 0];
    target[o + 3] = 255;
  }
}

/** Errors of a pixel; `place` is where on the scale of colours it is, in [0, 1]. */
const METRICS = {
  relative: {
    name: "squared, relative",
    label: "(x − r)² / (r² + e)",
    value: (x, r, epsilon) => (x - r) ** 2 / (r * r + epsilon),
    place: (value) => (Math.log10(Math.max(value, 1e-30)) + 4) / 5,
    ticks: [[0, "10⁻⁴"], [0.2, "10⁻³"], [0.4, "10⁻²"], [0.6, "0.1"], [0.8, "1"], [1, "10"]],
  },
  symmetric: {
    name: "absolute, symmetric",
    label: "|x − r| / (|x| + |r| + e)",
    value: (x, r, epsilon) => Math.abs(x - r) / (Math.abs(x) + Math.abs(r) + Math.sqrt(epsilon) / 10),
    place: (value) => value,
    ticks: [[0, "0"], [0.25, "0.25"], [0.5, "0.5"], [0.75, "0.75"], [1, "1"]],
  },
};

/** The error of pixel `i`: mean of the three channels. */
function errorAt(rgb, reference, i, metric, epsilon) {
  let sum = 0;
  for (let c = 3 * i; c < 3 * i + 3; ++c) {
    sum += METRICS[metric].value(rgb[c], reference[c], epsilon);
  }
  return sum / 3;
}

function setHeat(target, offset, heat, place) {
  const index = 3 * Math.round(255 * Math.min(Math.max(place, 0), 1));
  target[offset] = heat[index];
  target[offset + 1] = heat[index + 1];
  target[offset + 2] = heat[index + 2];
  target[offset + 3] = 255;
}

/** Draws errors in false colours. */
function errorMap(rgb, reference, target, metric, epsilon, heat) {
  const place = METRICS[metric].place;
  for (let i = 0; i < rgb.length / 3; ++i) {
    setHeat(target, 4 * i, heat, place(errorAt(rgb, reference, i, metric, epsilon)));
  }
}

/** Variance of bytes of logarithms: 2^-24 and eighths of an octave. */
function varianceOf(byte) {
  return byte === 0 ? 0 : 2 ** ((byte - 1) / 8 - 24);
}

/** Draws variances on the scale of the squared relative error. */
function varianceMap(map, target, heat) {
  const places = Float64Array.from({ length: 256 }, (_, byte) => METRICS.relative.place(varianceOf(byte)));
  for (let i = 0; i < map.length; ++i) {
    setHeat(target, 4 * i, heat, places[map[i]]);
  }
}
