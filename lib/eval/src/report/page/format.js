// Formats numbers for people.

const SUPERSCRIPTS = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

function superscript(number) {
  return String(number).split("").map((digit) => SUPERSCRIPTS[digit]).join("");
}

/** Formats three significant digits, without trailing zeros: "0.0123", "12.3", "1230". */
function digits(value, count = 3) {
  if (!Number.isFinite(value)) {
    return "–";
  }
  const text = Number(value.toPrecision(count));
  return Math.abs(text) >= 1e6 || (text !== 0 && Math.abs(text) < 1e-3) ? scientific(value, count - 1)
    : String(text);
}

/** Formats "1.2·10⁻³", but "0.12" for values that are easy to read. */
function scientific(value, decimals = 1) {
  if (Math.abs(value) >= 0.1 && Math.abs(value) < 1000) {
    return String(Number(value.toPrecision(decimals + 1)));
  }
  if (!Number.isFinite(value) || value === 0) {
    return value === 0 ? "0" : "–";
  }
  let exponent = Math.floor(Math.log10(Math.abs(value)));
  let mantissa = (value / 10 ** exponent).toFixed(decimals);
  if (Math.abs(Number(mantissa)) >= 10) {
    exponent += 1;
    mantissa = (value / 10 ** exponent).toFixed(decimals);
  }
  return `${mantissa}·10${superscript(exponent)}`;
}

/** Formats 1234567 as "1.23 M". */
function thousands(value) {
  const units = ["", " k", " M", " G", " T"];
  let unit = 0;
  let rest = value;
  while (rest >= 1000 && unit < units.length - 1) {
    rest /= 1000;
    unit += 1;
  }
  return `${Number(rest.toPrecision(3))}${units[unit]}`;
}

function seconds(value) {
  return value < 0.1 ? `${digits(value * 1000)} ms` : `${digits(value)} s`;
}

function bytes(value) {
  return value === null ? "–" : `${digits(value / 2 ** 20)} MiB`;
}

function percent(share) {
  return share === 0 ? "0" : share < 0.001 ? "<0.1 %" : `${Number((100 * share).toPrecision(share < 0.1 ? 2 : 3))} %`;
}

/** Formats a speed-up: "12.3×", or "≈ 12.3×" if it is extrapolated. */
function times(speedUp) {
  if (!speedUp) {
    return "–";
  }
  const value = speedUp.factor >= 100 ? Math.round(speedUp.factor) : Number(speedUp.factor.toPrecision(2));
  return `${speedUp.extrapolated ? "≈ " : ""}${value}×`;
}
