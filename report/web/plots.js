import uPlot from "uplot";
import { addTools } from "./plot_tools.js";
import { drawLegend } from "./legend.js";
import { color, watchTheme } from "./theme.js";
import { colorOf, dashOf, widthOf } from "./line_style.js";
import { linearTicks, logMarks, logTicks, shortNumber } from "./ticks.js";

// Zero has no place on a logarithmic axis and becomes a gap. So do values below 1e-32, at which uPlot throws.
const least_on_log = 1e-30;
const screen_height = 250;

function seriesOptions(line, plot, few) {
  const scattered = line.stroke === "points";
  const said = !line.unit || plot.yLabel.endsWith(`(${line.unit})`); // the axis already has the unit
  return {
    label: said ? line.label : `${line.label} (${line.unit})`,
    stroke: () => colorOf(line),
    width: widthOf(line),
    dash: dashOf(line),
    spanGaps: few,
    ...(scattered && { paths: () => null }),
    points: { show: few || scattered || undefined, size: scattered ? 4 : 7, stroke: () => colorOf(line), fill: () => colorOf(line) },
    value: (_, value) => shortNumber(value),
  };
}

const onlyMarks = (_, splits) => logMarks(splits);

function axisOptions(label, log, size) {
  return {
    label: label || undefined,
    labelSize: 20,
    labelFont: "12px system-ui, sans-serif",
    font: "12px system-ui, sans-serif",
    size,
    stroke: () => color("quiet"),
    grid: { stroke: () => color("rule"), width: 1, ...(log && { filter: onlyMarks }) },
    ticks: { stroke: () => color("rule"), width: 1, size: 5, ...(log && { filter: onlyMarks }) },
    values: (_, splits, __, ___, increment) => (log ? logTicks(splits) : linearTicks(splits, increment)),
  };
}

const drawable = (values, log) => (log ? values.map((value) => (value > least_on_log ? value : null)) : values);

// Charts over time are zoomed together.
class Together {
  charts = new Set();
  #busy = false;

  zoomed(chart) {
    if (this.#busy) return;
    this.#busy = true;
    const { min, max } = chart.scales.x;
    this.range = { min, max };
    for (const other of this.charts) if (other !== chart) other.setScale("x", this.range);
    this.#busy = false;
  }
}

function drawEvents(chart, events) {
  const { ctx, bbox } = chart;
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = color("quiet");
  ctx.lineWidth = uPlot.pxRatio; // not that of the last line
  ctx.setLineDash([2, 4]);
  for (const { t } of events) {
    if (t < chart.scales.x.min || t > chart.scales.x.max) continue;
    const x = Math.round(chart.valToPos(t, "x", true));
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.beginPath();
    ctx.moveTo(x - 5, bbox.top);
    ctx.lineTo(x + 5, bbox.top);
    ctx.lineTo(x, bbox.top + 8);
    ctx.fill();
  }
  ctx.restore();
}

// The event beside the pointer, in words.
function nameEvent(chart, events) {
  const { left } = chart.cursor;
  const near = left < 0 ? null : events.find(({ t }) => Math.abs(chart.valToPos(t, "x") - left) < 6);
  chart.over.title = near ? `${near.what}, t = ${Number(near.t.toPrecision(4))} s` : "";
}

function timeHooks(plot, events, together) {
  if (!plot.overTime) return {};
  return {
    draw: [(chart) => drawEvents(chart, events)],
    setCursor: [(chart) => nameEvent(chart, events)],
    setScale: [(chart, key) => key === "x" && chart.status === 1 && together.zoomed(chart)],
  };
}

function options(plot, width, events, together) {
  const few = !plot.overTime && plot.x.length <= 60;
  const [x0, x1] = [plot.x[0], plot.x.at(-1)];
  return {
    width,
    height: screen_height,
    scales: {
      x: { time: false, distr: plot.logX ? 3 : 1, ...(plot.overTime && together.range) },
      y: { distr: plot.logY ? 3 : 1 },
    },
    axes: [axisOptions(plot.xLabel, plot.logX, 30), axisOptions(plot.yLabel, plot.logY, plot.logY ? 60 : 84)],
    series: [
      { label: plot.xLabel, value: (_, value) => shortNumber(value) },
      ...plot.lines.map((line) => seriesOptions(line, plot, few)),
    ],
    bands: plot.tube ? [{ series: [1, 2], fill: () => `${color("limit")}1a` }] : [],
    cursor: { drag: { x: x1 > x0, y: false }, ...(plot.overTime && { sync: { key: "time", setSeries: false } }) },
    hooks: timeHooks(plot, events, together),
  };
}

/** Updates the legends of charts on the screen once a frame, because each update changes the page's layout. */
class Legends {
  #shown = new Set();
  #asked = false;
  #watcher = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) {
      if (isIntersecting) this.#shown.add(target);
      else this.#shown.delete(target);
    }
    this.ask();
  });
  #fill = new Map();

  add(host, fill) {
    this.#fill.set(host, fill);
    this.#watcher.observe(host);
  }

  ask() {
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => {
      this.#asked = false;
      for (const host of this.#shown) this.#fill.get(host)();
    });
  }
}

// Marks the instant that the machine shows by a line over the chart and, while nothing hovers, by the values in the
// legend.
function follow(host, chart, plot, clock, legends) {
  const mark = document.createElement("div");
  mark.className = "now";
  chart.over.append(mark);
  const move = () => {
    const left = chart.valToPos(clock.t, "x");
    const within = left >= 0 && left <= chart.bbox.width / uPlot.pxRatio; // asking the element for its size would cause a layout
    if (mark.hidden === within) mark.hidden = !within;
    mark.style.transform = `translateX(${left}px)`;
    mark.dataset.t = clock.t;
    legends.ask();
  };
  legends.add(host, () => {
    if (chart.cursor.left < 0 && !clock.playing) chart.setLegend({ idx: nearest(plot.x, clock.t) }, false);
  });
  clock.onChange(move);
  let down = 0;
  chart.over.addEventListener("mousedown", (event) => (down = event.clientX));
  chart.over.addEventListener("click", (event) => {
    if (Math.abs(event.clientX - down) > 3) return; // the pointer was dragged, to zoom
    clock.pause();
    clock.set(chart.posToVal(event.offsetX, "x"));
  });
}

function nearest(x, t) {
  let low = 0;
  let high = x.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] < t) low = middle;
    else high = middle;
  }
  return t - x[low] <= x[high] - t ? low : high;
}

const paper = { width: 400, height: 240 }; // px; the style sheet fits it into its column

function drawChart(host, plot, data, clock, together, legends) {
  const lines = [plot.x, ...plot.lines.map((line) => drawable(line.values, plot.logY))];
  const chart = new uPlot(options(plot, host.clientWidth, data.events, together), lines, host);
  chart.ctx.canvas.setAttribute("role", "img");
  chart.ctx.canvas.setAttribute("aria-label", plot.description);
  drawLegend(chart, plot);
  if (plot.overTime) together.charts.add(chart);
  addTools(host, chart, plot, data);
  if (plot.overTime) follow(host, chart, plot, clock, legends);
  return (size = { width: host.clientWidth, height: screen_height }) => {
    drawLegend(chart, plot);
    if (size.width !== chart.width || size.height !== chart.height) chart.setSize(size);
    chart.redraw(false);
  };
}

/**
 * Draws each chart when it comes near the screen, and again when its width or the theme changes. Before the page is
 * printed, all are drawn, in the colours of paper.
 */
export function drawCharts(document, data, clock) {
  const together = new Together();
  const legends = new Legends();
  const redraws = new Map();
  const draw = (host) => {
    watcher.unobserve(host);
    if (!redraws.has(host)) redraws.set(host, drawChart(host, data.plots[host.dataset.plot], data, clock, together, legends));
  };
  const watcher = new IntersectionObserver(
    (entries) => entries.forEach(({ isIntersecting, target }) => isIntersecting && draw(target)),
    { rootMargin: "200px" },
  );
  const hosts = document.querySelectorAll("[data-plot]");
  for (const host of hosts) watcher.observe(host);
  const redrawAll = (size) => {
    for (const redraw of redraws.values()) redraw(size);
    clock.set(clock.t); // moves the marks to the present time
  };
  const setPaper = (printed) => {
    document.documentElement.classList.toggle("paper", printed);
    redrawAll(printed ? paper : undefined);
  };
  window.addEventListener("resize", () => redrawAll());
  window.addEventListener("beforeprint", () => {
    for (const host of hosts) if (host.clientWidth > 0) draw(host); // not in folded parts
    setPaper(true);
  });
  window.addEventListener("afterprint", () => setPaper(false));
  watchTheme(() => redrawAll());
}
