/** Whether a positive number is a power of ten. */
export function isDecade(value) {
  const exponent = Math.log10(value);
  return value > 0 && Math.abs(exponent - Math.round(exponent)) < 1e-9;
}

const superscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** "10⁻³" */
export function powerOfTen(exponent) {
  const digits = [...String(Math.abs(exponent))].map((digit) => superscripts[digit]).join("");
  return `10${exponent < 0 ? "⁻" : ""}${digits}`;
}

/** Labels of a logarithmic axis: decades, or every second, third, … of many. They are the same at every zoom. */
export function logTicks(splits) {
  const step = Math.ceil(splits.filter(isDecade).length / 8);
  return splits.map((split) => {
    const exponent = Math.round(Math.log10(split));
    return isDecade(split) && exponent % step === 0 ? powerOfTen(exponent) : null;
  });
}

// Decimals that a step of 0.5, 0.25, … needs; the steps are "round" numbers of few digits.
function decimalsOf(increment) {
  let decimals = Math.max(0, -Math.floor(Math.log10(increment) + 1e-9));
  const isWhole = (number) => Math.abs(number - Math.round(number)) < 1e-6;
  while (decimals < 20 && !isWhole(increment * 10 ** decimals)) ++decimals;
  return decimals;
}

/** Labels of a linear axis, all with enough decimals to tell neighbours apart, whatever the browser's language. */
export function linearTicks(splits, increment) {
  const largest = Math.max(...splits.map(Math.abs));
  const decimals = decimalsOf(increment);
  if (largest !== 0 && (largest >= 1e6 || largest < 1e-3)) {
    const digits = Math.max(0, Math.floor(Math.log10(largest)) + decimals);
    return splits.map((split) => (split === 0 ? "0" : split.toExponential(Math.min(digits, 3)).replace("-", "−")));
  }
  return splits.map((split) => (split + 0).toFixed(decimals).replace("-", "−"));
}

/** Formats a value for the legend. */
export function shortNumber(value) {
  return value == null ? "–" : value.toPrecision(4).replace("e+", "e").replaceAll("-", "−");
}
