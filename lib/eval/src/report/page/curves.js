// Tone-maps radiance for the screen, like lib/io/src/output/display.cpp. bdpt view and the report of bdpt bench
// share it.

const SRGB_STEPS = 65535;
/** sRGB codes [IEC 61966-2-1] of evenly spaced linear values in [0, 1]. */
const SRGB = Uint8Array.from({ length: SRGB_STEPS + 1 }, (_, i) => {
  const x = i / SRGB_STEPS;
  return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055) + 0.5;
});

/** Far above the white point of every curve; keeps squares finite. */
const BRIGHTEST = 1e6;

function clampRadiance(x) {
  return x > 0 ? Math.min(x, BRIGHTEST) : 0;
}

// A curve maps scene-linear red, green and blue to display-linear values in [0, 1] in `out`.

/** Applies the filmic curve [Narkowicz 2016] to the largest component: hues stay, and bright ones fade to white. */
function filmic(red, green, blue, out) {
  const r = clampRadiance(red);
  const g = clampRadiance(green);
  const b = clampRadiance(blue);
  const peak = Math.max(r, g, b);
  if (peak <= 0) {
    out[0] = out[1] = out[2] = 0;
    return;
  }
  const excess = 0.15 * Math.max(peak - 1, 0);
  const white = excess / (1 + excess);
  const shown = Math.min((peak * (2.51 * peak + 0.03)) / (peak * (2.43 * peak + 0.59) + 0.14), 1);
  const k = shown * (1 - white) / peak;
  out[0] = r * k + white * shown;
  out[1] = g * k + white * shown;
  out[2] = b * k + white * shown;
}

/** Applies the Khronos PBR Neutral Tone Mapper [Khronos 2024]. */
function pbrNeutral(red, green, blue, out) {
  const fresnel = 0.04;
  const start = 0.8 - fresnel;
  const room = 1 - start;
  let r = clampRadiance(red);
  let g = clampRadiance(green);
  let b = clampRadiance(blue);
  const least = Math.min(r, g, b);
  const taken = least < 2 * fresnel ? least - least * least / (4 * fresnel) : fresnel;
  r -= taken;
  g -= taken;
  b -= taken;
  const peak = Math.max(r, g, b);
  if (peak >= start) {
    const compressed = 1 - room * room / (peak + room - start);
    const white = 1 - 1 / (0.15 * (peak - compressed) + 1);
    const k = compressed / peak * (1 - white);
    r = r * k + compressed * white;
    g = g * k + compressed * white;
    b = b * k + compressed * white;
  }
  out[0] = r;
  out[1] = g;
  out[2] = b;
}

const FLOAT = new Float32Array(1);
const FLOAT_BITS = new Uint32Array(FLOAT.buffer);
/** First and last float of AGX_CONTRAST, without the lower 13 bits: 2^-13 and 2^5. */
const AGX_RANGE = [114 << 10, 132 << 10];
/** Tabulates the contrast curve of AgX [Wrensch 2023] with 1024 values per octave. */
const AGX_CONTRAST = Float64Array.from({ length: AGX_RANGE[1] - AGX_RANGE[0] + 1 }, (_, i) => {
  FLOAT_BITS[0] = (AGX_RANGE[0] + i) * 8192;
  const place = unit((Math.log2(FLOAT[0]) + 12.47393) / (4.026069 + 12.47393));
  return [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232].reduce((sum, coefficient) => sum * place + coefficient, 0);
});

function agxContrast(x) {
  FLOAT[0] = x;
  const i = FLOAT_BITS[0] + 4096 >>> 13;
  return AGX_CONTRAST[Math.min(Math.max(i, AGX_RANGE[0]), AGX_RANGE[1]) - AGX_RANGE[0]];
}

const AGX_STEPS = 4096;
/** Tabulates x^2.2 for evenly spaced x in [0, 1.5]. */
const AGX_POWERS = Float64Array.from({ length: 1.5 * AGX_STEPS + 2 }, (_, i) => (i / AGX_STEPS) ** 2.2);

function agxPower(x) {
  const place = AGX_STEPS * Math.min(Math.max(x, 0), 1.5);
  const i = place | 0;
  return AGX_POWERS[i] + (AGX_POWERS[i + 1] - AGX_POWERS[i]) * (place - i);
}

function unit(x) {
  return Math.min(Math.max(x, 0), 1);
}

/** Applies AgX [Sobotka 2022] with Rec. 2020 primaries. */
function agx(red, green, blue, out) {
  const r = clampRadiance(red);
  const g = clampRadiance(green);
  const b = clampRadiance(blue);
  const wideR = 0.6274 * r + 0.3293 * g + 0.0433 * b;
  const wideG = 0.0691 * r + 0.9195 * g + 0.0113 * b;
  const wideB = 0.0164 * r + 0.0880 * g + 0.8956 * b;
  const x = agxContrast(0.856627153 * wideR + 0.0951212405 * wideG + 0.0482516061 * wideB);
  const y = agxContrast(0.137318973 * wideR + 0.761241991 * wideG + 0.101439036 * wideB);
  const z = agxContrast(0.111898213 * wideR + 0.0767994186 * wideG + 0.811302368 * wideB);
  const p = agxPower(1.12710058 * x - 0.110606643 * y - 0.0164939387 * z);
  const q = agxPower(-0.141329763 * x + 1.15782370 * y - 0.0164939387 * z);
  const s = agxPower(-0.141329763 * x - 0.110606643 * y + 1.25193641 * z);
  out[0] = unit(1.6605 * p - 0.5876 * q - 0.0728 * s);
  out[1] = unit(-0.1246 * p + 1.1329 * q - 0.0083 * s);
  out[2] = unit(-0.0182 * p - 0.1006 * q + 1.1187 * s);
}

function clamped(red, green, blue, out) {
  out[0] = Math.min(clampRadiance(red), 1);
  out[1] = Math.min(clampRadiance(green), 1);
  out[2] = Math.min(clampRadiance(blue), 1);
}

/** Curves of --tone-map. */
const CURVES = {
  filmic: { name: "Filmic", map: filmic },
  "pbr-neutral": { name: "PBR Neutral", map: pbrNeutral },
  agx: { name: "AgX", map: agx },
  none: { name: "None (clamps)", map: clamped },
};

/** Tone-maps radiance into `target` (RGBA bytes). `gamma` is an exponent for the brightness of the result. */
function toneMap(rgb, target, { gain, curve, gamma = 1 }) {
  const { map } = CURVES[curve];
  const out = new Float64Array(3);
  for (let i = 0, o = 0; i < rgb.length; i += 3, o += 4) {
    map(rgb[i] * gain, rgb[i + 1] * gain, rgb[i + 2] * gain, out);
    let scale = SRGB_STEPS;
    if (gamma !== 1) {
      const most = Math.max(out[0], out[1], out[2]);
      scale *= most > 0 ? most ** (gamma - 1) : 0;
    }
    target[o] = SRGB[out[0] * scale + 0.5 | 0];
    target[o + 1] = SRGB[out[1] * scale + 0.5 | 0];
    target[o + 2] = SRGB[out[2] * scale + 0.5 | 0];
    target[o + 3] = 255;
  }
}
