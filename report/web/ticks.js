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

/** 1.5e-7 as "1.5 × 10⁻⁷" with so many digits after the point. */
function inPowers(value, digits) {
  const [mantissa, exponent] = value.toExponential(digits).split("e");
  return `${mantissa.replace("-", "−")} × ${powerOfTen(Number(exponent))}`;
}

/**
 * Where a logarithmic axis has marks: at decades. uPlot would mark 2, 3, … 9 × 10ⁿ too, which over many decades become
 * a grey wall; where there is no second decade, 2 and 5 help.
 */
export function logMarks(splits) {
  const leads = splits.filter(isDecade).length < 2 ? [1, 2, 5] : [1];
  return splits.map((split) => (leads.some((lead) => isDecade(split / lead)) ? split : null));
}

/** Labels of a logarithmic axis: decades, or every second, third, … of many. They are the same at every zoom. */
export function logTicks(splits) {
  const decades = splits.filter(isDecade).length;
  if (decades < 2) return logMarks(splits).map((mark) => (mark === null ? null : plain(mark)));
  const step = Math.ceil(decades / 8);
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

// A number of one digit and its decade.
const plain = (value) => (value < 1e-3 || value >= 1e5 ? inPowers(value, 0) : String(Number(value.toPrecision(1))));

/** Labels of a linear axis, all with enough decimals to tell neighbours apart, whatever the browser's language. */
export function linearTicks(splits, increment) {
  const largest = Math.max(...splits.map(Math.abs));
  const decimals = decimalsOf(increment);
  if (largest !== 0 && (largest >= 1e6 || largest < 1e-3)) {
    const decade = Math.floor(Math.log10(increment) + 1e-9);
    const digits = Math.floor(Math.log10(largest)) - decade + decimalsOf(increment / 10 ** decade);
    return splits.map((split) => (split === 0 ? "0" : inPowers(split, Math.min(Math.max(digits, 0), 3))));
  }
  return splits.map((split) => (split + 0).toFixed(decimals).replace("-", "−"));
}

/** Formats a value for the legend. */
export function shortNumber(value) {
  if (value == null) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return inPowers(value, 3);
  return (size < 1e4 ? value.toPrecision(4) : value.toFixed(0)).replace("-", "−");
}
