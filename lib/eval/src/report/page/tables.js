// Shows measurements as tables.

/** Tints green for faster than pt, orange for slower; the strength grows with the distance of the factor from 1. */
function tint(speedUp) {
  if (!speedUp) {
    return "";
  }
  const strength = Math.min(Math.abs(Math.log10(speedUp.factor)) / 2, 1);
  return `--tint:var(--${speedUp.factor >= 1 ? "faster" : "slower"});--strength:${(8 + 52 * strength).toFixed(0)}%`;
}

function overviewTable(data) {
  const names = [...new Set(data.scenes.flatMap((scene) => scene.integrators.map((one) => one.integrator)))];
  const rows = data.scenes.map((scene) => [html("a", { href: `#scene-${scene.name}` }, scene.name), ...names.map((name) => {
    const one = scene.integrators.find((candidate) => candidate.integrator === name);
    const missing = one && one.relmse_floor !== null;
    return html("span", { class: "factor", style: missing ? "" : tint(one && one.speed_up) }, times(one && one.speed_up),
      missing ? html("abbr", { title: "cannot find all light" }, " †") : null);
  })]);
  return table("Speed-up over pt at equal error, by scene", ["Scene", ...names.map((name) => html("span", { class: `series-${name}` }, name))],
    rows, { class: "overview" });
}

function range(spread) {
  return html("span", { title: `${scientific(spread.least, 2)} to ${scientific(spread.greatest, 2)} over seeds` },
    scientific(spread.median), html("span", { class: "sub" }, ` ${scientific(spread.least)} … ${scientific(spread.greatest)}`));
}

function sceneTable(scene) {
  const rows = scene.integrators.map((one) => [
    html("span", { class: `series-${one.integrator}` }, html("span", { class: "dot" }), one.integrator),
    thousands(one.equal_time.samples), range(one.equal_time.relmse), one.flip ? range(one.flip) : "–",
    one.flip_denoised ? range(one.flip_denoised) : "–", range(one.equal_samples.relmse),
    seconds(one.equal_samples.cpu_seconds), digits(one.efficiency), html("span", null, times(one.speed_up), one.relmse_floor === null ? "" : " †"), digits(one.samples_per_second),
    thousands(one.rays_per_second.camera), thousands(one.rays_per_second.light), thousands(one.rays_per_second.shadow),
    bytes(one.peak_memory_bytes)]);
  const spp = scene.integrators.length ? thousands(scene.integrators[0].equal_samples.samples) : "–";
  return table(`What was measured in ${scene.name}: medians over ${scene.integrators.length ? scene.integrators[0].seeds : 0} seeds`,
    ["Integrator", "Samples at equal time", "relMSE at equal time", "FLIP at equal time", "FLIP, denoised", `relMSE at ${spp} samples`, `CPU time of ${spp} samples`,
      "Efficiency [1/s]", "Speed-up", "Samples/s", "Camera rays/s", "Light rays/s", "Shadow rays/s", "Memory"], rows);
}

/** Lists reservations that a reader should know before trusting the figures. */
function cautions(scene) {
  const noisy = scene.integrators.filter((one) => one.equal_time.near_reference_noise || one.equal_samples.near_reference_noise);
  const broken = scene.integrators.filter((one) => one.invalid_samples > 0);
  const lines = [];
  if (!scene.complete) {
    lines.push("Not all runs of this scene have been made.");
  }
  if (noisy.length) {
    lines.push(`The reference is not much better than ${noisy.map((one) => one.integrator).join(", ")}: errors there are not sure.`);
  }
  for (const one of scene.integrators.filter((candidate) => candidate.relmse_floor !== null)) {
    lines.push(`† ${one.integrator} cannot find all light here: ${scientific(one.relmse_floor)} of its relMSE stays however long it runs.`);
  }
  if (broken.length) {
    lines.push(`Samples that were NaN, infinite or negative were dropped: ${broken.map((one) => one.integrator).join(", ")}.`);
  }
  return lines.length ? html("p", { class: "caution", role: "note" }, lines.join(" ")) : null;
}
