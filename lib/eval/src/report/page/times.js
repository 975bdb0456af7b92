// Shows where the time of samples goes: by phase, and by pixel.

const PHASES = [["walk", "walks: rays, and sampling of directions"], ["shade", "surfaces: materials and textures"],
  ["connect", "joins: light samples, BSDFs and shadow rays"], ["weigh", "weights of strategies"], ["splat", "adding to the film"]];

/** Formats a time like "3.2 µs". */
function formatTime(value) {
  const [factor, unit] = value < 1e-6 ? [1e9, "ns"] : value < 1e-3 ? [1e6, "µs"] : value < 1 ? [1e3, "ms"] : [1, "s"];
  return `${Number((value * factor).toPrecision(2))} ${unit}`;
}

function splitBars(scene) {
  const rows = scene.integrators.filter((one) => one.time_split).map(({ integrator, time_split: split }) => ({
    name: integrator,
    parts: PHASES.map(([phase]) => split.shares[phase] * split.sample_seconds),
    title: (k) => `${integrator}: ${percent(split.shares[PHASES[k][0]])} ${PHASES[k][1]}`,
    inside: (k) => `${Math.round(100 * split.shares[PHASES[k][0]])} %`,
  }));
  return stackedBars(scene, rows, { caption: "Time of a sample of a pixel", series: "phase", kinds: PHASES, format: formatTime });
}

/** Decodes the seconds from a byte of a time map. */
function decodeTime(byte) {
  return byte === 0 ? 0 : 2 ** ((byte - 1) / 12 - 28);
}

/** Returns the range of bytes between the first and the last percentile of all maps. */
function timeRange(maps) {
  const counts = new Array(256).fill(0);
  maps.forEach((map) => map.forEach((byte) => { counts[byte] += byte > 0 ? 1 : 0; }));
  const all = counts.reduce((a, b) => a + b, 0);
  const at = (share) => {
    let sum = 0;
    return counts.findIndex((count) => (sum += count) > share * all);
  };
  const [least, most] = all ? [at(0.01), at(0.99)] : [1, 2];
  return [least, Math.max(most, least + 12)];
}

/** Draws times in false colours; the start of the range is black. */
function timeMap(map, target, heat, [least, most]) {
  for (let i = 0; i < map.length; ++i) {
    setHeat(target, 4 * i, heat, (map[i] - least) / (most - least));
  }
}

function timeTicks([least, most]) {
  return [0, 0.25, 0.5, 0.75, 1].map((place) => [place, formatTime(decodeTime(least + place * (most - least)))]);
}
