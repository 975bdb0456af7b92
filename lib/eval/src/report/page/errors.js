// Draws errors and variances of images in false colours.

/** Error metrics of a pixel; `place` maps an error to a position in [0, 1] on the colour scale. */
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

/** Returns the error of pixel `i`: the mean over the three channels. */
function errorAt(rgb, reference, i, metric, epsilon) {
  let sum = 0;
  for (let c = 3 * i; c < 3 * i + 3; ++c) {
    sum += METRICS[metric].value(rgb[c], reference[c], epsilon);
  }
  return sum / 3;
}

/** Draws errors in false colours. */
function errorMap(rgb, reference, target, metric, epsilon, heat) {
  const place = METRICS[metric].place;
  for (let i = 0; i < rgb.length / 3; ++i) {
    setHeat(target, 4 * i, heat, place(errorAt(rgb, reference, i, metric, epsilon)));
  }
}

/** Decodes the variance from a byte, which counts eighths of an octave above 2^-24. */
function decodeVariance(byte) {
  return byte === 0 ? 0 : 2 ** ((byte - 1) / 8 - 24);
}

/** Draws variances, on the colour scale of the squared relative error. */
function varianceMap(map, target, heat) {
  const places = Float64Array.from({ length: 256 }, (_, byte) => METRICS.relative.place(decodeVariance(byte)));
  for (let i = 0; i < map.length; ++i) {
    setHeat(target, 4 * i, heat, places[map[i]]);
  }
}
