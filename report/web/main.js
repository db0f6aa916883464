// Draws the charts, lets the machine move, and gives both the same time. Without this script the page has its tables,
// its machine, and the largest value of each chart in words.
import { Clock } from "./clock.js";
import { drawCharts } from "./plots.js";
import { addPlayer } from "./player.js";
import { addStage } from "./stage.js";
import { watchTheme } from "./theme.js";

// A page whose own script moves the machine gives its data, and is told of the stage.
const data = globalThis.ursula_page ?? JSON.parse(document.getElementById("data").textContent);
const over_time = data.plots.filter((plot) => plot.overTime);
const duration = data.machine ? data.machine.t.at(-1) : Math.max(0, ...over_time.map((plot) => plot.x.at(-1) ?? 0));
const clock = new Clock(duration);

document.documentElement.classList.add("live");
drawCharts(document, data, clock);

function addMachine(host) {
  const stage = addStage(host, data.machine, clock);
  if (duration > 0) addPlayer(document, data.events, clock, stage);
  watchTheme(() => stage?.repaint());
  if (stage) document.dispatchEvent(new CustomEvent("ursula:stage", { detail: stage }));
  performance.mark("report:moving");
}

// The machine's drawing is there at once. The moving machine takes longer; it is made once the page has been painted
// and it is near the screen.
const host = document.getElementById("stage");
if (!data.machine) {
  if (duration > 0) addPlayer(document, data.events, clock, null);
} else {
  const watcher = new IntersectionObserver(
    (entries) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      watcher.disconnect();
      requestAnimationFrame(() => setTimeout(() => addMachine(host)));
    },
    { rootMargin: "200px" },
  );
  watcher.observe(host);
}
performance.mark("report:ready");
