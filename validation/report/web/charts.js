import uPlot from "uplot";
import { isDecade, linearTicks, logTicks, shortNumber } from "./ticks.js";

// Distinct without colour too: every line has its own dashes.
const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [14, 5], [5, 2]];
const themes = {
  light: {
    text: "#1b1f24",
    grid: "#e3e7eb",
    lines: ["#1f6fb4", "#c4540a", "#08805c", "#a83f86", "#7d6200", "#5a5f66"],
  },
  dark: {
    text: "#c5cdd5",
    grid: "#2b333b",
    lines: ["#6cb2f0", "#ff9d5c", "#4ecfa3", "#ea8fcb", "#e2c044", "#b4bbc3"],
  },
};
const print_width = 660;
const darkness = window.matchMedia("(prefers-color-scheme: dark)");
let printing = false;

const theme = () => (darkness.matches && !printing ? themes.dark : themes.light);
const dashOf = (line) => (line.ghost ? [] : dashes[line.color % dashes.length]);
const widthOf = (line) => (line.ghost ? 5 : 1.75);
const colorOf = (line) => {
  const { lines } = theme();
  return lines[line.color % lines.length] + (line.ghost ? "66" : "");
};

function seriesOptions(line, few) {
  return {
    label: line.unit ? `${line.label} (${line.unit})` : line.label,
    stroke: () => colorOf(line),
    width: widthOf(line),
    dash: dashOf(line),
    spanGaps: few,
    points: { show: few || undefined, size: 7, stroke: () => colorOf(line), fill: () => colorOf(line) },
    value: (_, value) => shortNumber(value),
  };
}

// uPlot would rule all of 2, 3, … 9 × 10ⁿ; over many decades that is a grey wall.
const onlyDecades = (_, splits) => splits.map((split) => (isDecade(split) ? split : null));

function axisOptions(label, log, size) {
  return {
    label: label || undefined,
    labelSize: 22,
    size,
    stroke: () => theme().text,
    grid: { stroke: () => theme().grid, width: 1, ...(log && { filter: onlyDecades }) },
    ticks: { stroke: () => theme().grid, width: 1, ...(log && { filter: onlyDecades }) },
    values: (_, splits, __, ___, increment) => (log ? logTicks(splits) : linearTicks(splits, increment)),
  };
}

// Zero has no place on a logarithmic axis; it becomes a gap. So does what is as good as zero: uPlot throws at less than
// 1e-32.
const least_on_log = 1e-30;
const drawable = (values, log) => (log ? values.map((value) => (value > least_on_log ? value : null)) : values);

function options(plot, width) {
  const few = !plot.overTime && plot.x.length <= 60;
  return {
    width,
    height: 300,
    scales: {
      x: { time: false, distr: plot.logX ? 3 : 1 },
      y: { distr: plot.logY ? 3 : 1 },
    },
    axes: [axisOptions(plot.xLabel, plot.logX, 34), axisOptions(plot.yLabel, plot.logY, 64)],
    series: [
      { label: plot.xLabel, value: (_, value) => shortNumber(value) },
      ...plot.lines.map((line) => seriesOptions(line, few)),
    ],
    cursor: plot.overTime ? { sync: { key: "time", setSeries: false } } : {},
  };
}

// uPlot's own markers are squares; a sample of the line shows its dashes.
function drawLegend(chart, plot) {
  const labels = chart.root.querySelectorAll(".u-series th");
  plot.lines.forEach((line, i) => {
    const label = labels[i + 1];
    label.querySelector("svg")?.remove();
    label.insertAdjacentHTML(
      "afterbegin",
      `<svg width="30" height="8" aria-hidden="true"><path d="M0 4H30" fill="none" stroke="${colorOf(line)}"
        stroke-width="${widthOf(line)}" stroke-dasharray="${dashOf(line).join(" ")}"/></svg>`,
    );
  });
}

function drawChart(host, plot) {
  const data = [plot.x, ...plot.lines.map((line) => drawable(line.values, plot.logY))];
  const chart = new uPlot(options(plot, host.clientWidth), data, host);
  chart.ctx.canvas.setAttribute("role", "img");
  chart.ctx.canvas.setAttribute("aria-label", plot.description);
  return { chart, plot, host };
}

function redraw({ chart, plot, host }) {
  drawLegend(chart, plot);
  chart.setSize({ width: printing ? print_width : host.clientWidth, height: chart.height });
  chart.redraw(false);
}

/** Draws `plots[i]` into the element with data-plot = i, and again whenever width, theme or medium change. */
export function drawCharts(document, plots) {
  const charts = [...document.querySelectorAll("[data-plot]")].map((host) => drawChart(host, plots[host.dataset.plot]));
  const redrawAll = () => charts.forEach(redraw);
  const onPrint = (on) => () => {
    printing = on;
    redrawAll();
  };
  redrawAll();
  window.addEventListener("resize", redrawAll);
  darkness.addEventListener("change", redrawAll);
  window.addEventListener("beforeprint", onPrint(true));
  window.addEventListener("afterprint", onPrint(false));
}
