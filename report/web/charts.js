// Draws the charts of a page without a machine.
import { Clock } from "./clock.js";
import { drawCharts } from "./plots.js";

const data = JSON.parse(document.getElementById("data")?.textContent ?? '{"plots":[]}');
const ends = data.plots.map((plot) => plot.x.at(-1) ?? 0);

document.documentElement.classList.add("live");
const clock = new Clock(Math.max(0, ...ends));
drawCharts(document, data, clock);
// Nothing moves here; a click marks an instant.
clock.onChange(() => document.body.classList.toggle("marked", clock.t > 0));

// A link to a folded part unfolds it.
function unfold() {
  const target = location.hash ? document.getElementById(decodeURIComponent(location.hash.slice(1))) : null;
  if (target instanceof HTMLDetailsElement) target.open = true;
}
window.addEventListener("hashchange", unfold);
unfold();
