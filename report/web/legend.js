import { colorOf, dashOf, widthOf } from "./line_style.js";

const sample = (line) =>
  line.stroke === "points"
    ? `<svg width="10" height="8" aria-hidden="true"><circle cx="5" cy="4" r="3" fill="${colorOf(line)}"/></svg>`
    : `<svg width="26" height="8" aria-hidden="true"><path d="M0 4H26" fill="none" stroke="${colorOf(line)}"
    stroke-width="${widthOf(line)}" stroke-dasharray="${dashOf(line).join(" ")}"/></svg>`;

// A sample of the line shows its dashes, unlike uPlot's own square markers. A button hides the line, so that the
// keyboard can.
function makeButton(label, chart, index) {
  const button = document.createElement("button");
  button.type = "button";
  button.title = "Hide or show this line";
  button.textContent = label.textContent;
  button.addEventListener("click", (event) => {
    event.stopPropagation();
    chart.setSeries(index, { show: !chart.series[index].show });
    button.setAttribute("aria-pressed", String(chart.series[index].show));
  });
  button.setAttribute("aria-pressed", "true");
  label.replaceChildren(button);
  return button;
}

/** Draws the samples of all lines, in the colours of the theme. */
export function drawLegend(chart, plot) {
  const labels = chart.root.querySelectorAll(".u-series th");
  plot.lines.forEach((line, i) => {
    const label = labels[i + 1];
    const button = label.querySelector("button") ?? makeButton(label, chart, i + 1);
    button.querySelector("svg")?.remove();
    button.insertAdjacentHTML("afterbegin", sample(line));
  });
}
