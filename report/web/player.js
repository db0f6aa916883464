import { powerOfTen } from "./ticks.js";

const speeds = [0.05, 0.1, 0.25, 0.5, 1, 2, 4, 10];

function element(tag, attributes, text = "") {
  const out = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) out.setAttribute(name, value);
  out.textContent = text;
  return out;
}

function labelled(text, control) {
  const label = element("label", {}, `${text} `);
  label.append(control);
  return label;
}

function choice(name, options, chosen, onChange) {
  const select = element("select", { "data-role": name });
  for (const [value, text] of options) select.append(element("option", { value }, text));
  select.value = String(chosen);
  select.addEventListener("change", () => onChange(Number(select.value)));
  return select;
}

// A long motion starts at a speed at which it takes some ten seconds.
function startSpeed(duration) {
  return duration > 20 ? Math.ceil(duration / 10) : duration < 1 ? 0.1 : 1;
}

function transport(clock) {
  const bar = element("div", { class: "transport" });
  const button = element("button", { type: "button", class: "play", "data-role": "play" }, "▶ Play");
  const step = clock.duration / 1000;
  const slider = element("input", { type: "range", min: 0, max: clock.duration, step, "aria-label": "Time", "data-role": "time" });
  const shown = element("output", { "data-role": "now" });
  button.addEventListener("click", () => (clock.playing ? clock.pause() : clock.play()));
  slider.addEventListener("input", () => {
    const t = Number(slider.value); // read before clock.pause(), which moves the slider back
    clock.pause();
    clock.set(t);
  });
  clock.onChange(() => {
    const label = clock.playing ? "❚❚ Pause" : "▶ Play";
    if (button.textContent !== label) button.textContent = label;
    slider.value = clock.t;
    shown.textContent = `${clock.t.toFixed(clock.duration < 10 ? 3 : 2)} s`;
    slider.setAttribute("aria-valuetext", shown.textContent);
  });
  bar.append(button, slider, shown);
  return bar;
}

function jumps(events, clock) {
  const bar = element("div", { class: "jumps" }, events.length ? "Go to: " : "");
  for (const event of events) {
    const button = element("button", { type: "button" }, `${event.what} (${Number(event.t.toPrecision(4))} s)`);
    button.addEventListener("click", () => {
      clock.pause();
      clock.set(event.t);
    });
    bar.append(button);
  }
  return bar;
}

function switches(stage) {
  const bar = element("fieldset", { class: "switches" });
  bar.append(element("legend", {}, "Show"));
  for (const [key, text, on] of stage.layers) {
    const box = element("input", { type: "checkbox", "data-layer": key });
    box.checked = on;
    box.addEventListener("change", () => stage.show(key, box.checked));
    const label = element("label", {});
    label.append(box, ` ${text}`);
    bar.append(label);
  }
  const reset = element("button", { type: "button", "data-role": "reset" }, "Reset view");
  reset.addEventListener("click", () => stage.resetView());
  bar.append(reset);
  return bar;
}

function magnification(stage) {
  const options = stage.factors.map((factor) => [factor, `${factor < 1000 ? factor : powerOfTen(Math.log10(factor))} ×`]);
  return labelled("Errors enlarged", choice("factor", options, stage.factor, (factor) => stage.magnify(factor)));
}

/** Controls for playing, scrubbing and speed; below the machine, or below the header without one. */
export function addPlayer(document, events, clock, stage) {
  clock.speed = startSpeed(clock.duration);
  const host = element("div", { class: "player", role: "group", "aria-label": "Motion" });
  const options = [...new Set([...speeds, clock.speed])].sort((a, b) => a - b).map((speed) => [speed, `${speed} ×`]);
  const settings = element("div", { class: "settings" });
  settings.append(labelled("Speed", choice("speed", options, clock.speed, (speed) => (clock.speed = speed))));
  if (stage?.factors.length) settings.append(magnification(stage));
  host.append(transport(clock), settings);
  if (stage?.layers.length) host.append(switches(stage));
  host.append(jumps(events, clock));
  const place = document.getElementById("stage");
  if (place) place.append(host);
  else document.querySelector("header .sources").append(host);
}
