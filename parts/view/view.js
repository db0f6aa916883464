// The page of `ursula view`: sliders move the machine, and tables follow. main.js of the report draws it.
const page = JSON.parse(document.getElementById("data").textContent);
const { machine, sliders, path } = page.view;
const is_mechanism = Boolean(machine.bodies);
const byId = (id) => document.getElementById(id);

function element(tag, attributes, text = "") {
  const out = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) out.setAttribute(name, value);
  out.textContent = text;
  return out;
}

/** Numbers of a table by the rows' names, with units by row and column; each cell keeps every digit. */
function table(id, columns, names, units = []) {
  const host = byId(id);
  const head = element("tr", {});
  for (const name of ["", ...columns]) head.append(element("th", { scope: "col", ...(name ? { class: "number" } : {}) }, name));
  const body = element("tbody", {});
  const cells = names.map((name) => {
    const row = element("tr", {});
    row.append(element("th", { scope: "row" }, name));
    const of_row = columns.map(() => element("td", { class: "number" }));
    row.append(...of_row);
    body.append(row);
    return of_row;
  });
  host.append(head, body);
  return (values) =>
    cells.forEach((row, i) =>
      row.forEach((cell, j) => {
        const value = values?.[i]?.[j];
        cell.textContent = value == null ? "–" : inPrint(value) + (units[i] ? `\u00a0${units[i][j]}` : "");
        cell.dataset.value = value ?? "";
      }),
    );
}

/** Six digits, with a minus sign; what is nothing beside them is 0. */
const inPrint = (value) => (Math.abs(value) < 1e-9 ? "0" : value.toPrecision(6).replace("-", "−"));

/** As many digits as a field shows. */
const short = (value) => Number(Number(value).toPrecision(7));

/** The values of all sliders; `set` moves them. */
function controls(host, onChange) {
  const inputs = sliders.map(({ name, unit, from, to, value }, k) => {
    const line = element("label", { class: "slider" });
    const range = element("input", { type: "range", min: from, max: to, step: "any", "aria-label": name, "data-slider": k });
    const exact = element("input", { type: "number", step: "any", "aria-label": `${name}, ${unit}`, "data-exact": k });
    line.append(element("span", {}, name), range, exact, element("span", {}, unit));
    host.append(line);
    range.value = exact.value = short(value);
    range.addEventListener("input", () => ((exact.value = short(range.value)), onChange()));
    exact.addEventListener("change", () => {
      range.value = exact.value; // within its ends
      if (Number(range.value) !== Number(exact.value)) exact.value = range.value;
      onChange();
    });
    return { range, exact };
  });
  return {
    values: () => inputs.map(({ exact }) => Number(exact.value)),
    set: (values) => inputs.forEach(({ range, exact }, k) => (range.value = exact.value = short(values[k]))),
  };
}

/** The names of the legs' coordinates; of legs of several kinds each has its own. */
const symbols = { phi: "φ, rad", psi: "ψ, rad", theta: "θ, rad", d: "d, m" };
const coordinateNames = () => [0, 1, 2].map((k) => [...new Set(machine.legs.map(({ kind }) => symbols[kinds[kind].coordinates[k]]))].join(" or "));

const replace = (track, numbers) => track.splice(0, numbers.length, ...numbers);

/** A hexapod: the pose is six numbers. `drawing` is what main.js draws; its tracks hold this one pose. */
function hexapod() {
  const tracks = [];
  const track = (size) => tracks.push(new Array(size).fill(0)) - 1;
  const drawn = machine.legs.map((leg) => {
    const links = [0, 1].map(() => ({ from: track(3), to: track(3) }));
    const points = { base: track(3), knee: leg.kind === "UPS" ? null : track(3), tip: links[1].to };
    const driven = (...joints) => machine.motors.some((motor) => machine.legs[motor.leg] === leg && joints.includes(motor.joint));
    const joints = [{ at: points.base, axes: leg.kind === "URS" || leg.kind === "UPS" ? [track(3), track(3)] : [track(3)], driven: driven(0) }];
    if (points.knee !== null) joints.push({ at: points.knee, axes: [track(3)], driven: driven(leg.kind === "URS" ? 2 : 1) });
    joints.push({ at: points.tip, axes: [], driven: false });
    return { kind: leg.kind, links, joints, rails: [] };
  });
  const flat = (list) => list.flat();
  const first = path.poses[0];
  const drawing = {
    t: [0], tracks, legs: drawn, p: [...first.p], q: [...first.q], path: flat(path.poses.map(({ p }) => p)), hold: flat(machine.legs.map(({ point }) => point)),
    error: [], efforts: [], onPlatform: [], onBase: [], wrong: [], weak: { yielding: new Array(6).fill(0), lost: [0, 0, 1], leg: [-1] },
  };
  const place = (shown, pose, now) => {
    replace(drawing.p, pose.p);
    replace(drawing.q, quaternionOf(pose.Q));
    if (shown.weakest) replace(drawing.weak.yielding, shown.weakest);
    shown.legs.forEach(({ links }, k) => {
      const leg = drawn[k];
      const put = (at, point) => replace(tracks[at], point);
      const [first, second] = links ?? [0, 1].map(() => ({ from: machine.legs[k].base, to: machine.legs[k].base, frame: machine.legs[k].frame }));
      [first, second].forEach(({ from, to }, i) => (put(leg.links[i].from, from), put(leg.links[i].to, to)));
      put(leg.joints[0].at, first.from);
      leg.joints[0].axes.forEach((axis, i) => put(axis, i === 0 ? transposed(machine.legs[k].frame)[1] : transposed(first.frame)[0]));
      if (leg.joints.length > 2) {
        put(leg.joints[1].at, second.from);
        put(leg.joints[1].axes[0], machine.legs[k].kind === "RUS" ? transposed(machine.legs[k].frame)[1] : transposed(second.frame)[0]);
      }
    });
    now();
  };
  const poseOf = (values) => ({ p: values.slice(0, 3), Q: turnOf(times(Math.PI / 180, values.slice(3))) });
  return {
    drawing,
    ofPath: (k) => [...path.poses[k].p, ...times(180 / Math.PI, anglesOf(matrixOf(path.poses[k].q)))],
    at: (values) => {
      const pose = poseOf(values);
      const shown = hexapodAt(machine, pose);
      const motors = machine.motors.map(({ leg, joint }, k) => [shown.legs[leg].coordinates?.[joint], shown.efforts?.[k]]);
      return { ...shown, motors, legs_shown: shown.legs.map(({ coordinates, margin }) => [...(coordinates ?? [null, null, null]), margin]), draw: (now) => place(shown, pose, now) };
    },
  };
}

/** A mechanism: its motors are followed from where they are. */
function mechanism() {
  let states = path.states[0].map(({ p, q }) => ({ p, R: matrixOf(q) }));
  let moving = 0;
  for (const body of machine.bodies) body.index = body.fixed ? -1 : moving++;
  machine.moving = moving;
  const settle = () => machine.joints.forEach((joint) => (joint.value = jointAt(machine, joint, states).value));
  settle();
  return {
    drawing: page.machine,
    ofPath: (k) => {
      states = path.states[k].map(({ p, q }) => ({ p, R: matrixOf(q) }));
      settle();
      return path.motors[k].map((x, m) => (sliders[m].unit === "°" ? (x * 180) / Math.PI : x));
    },
    at: (values) => {
      const wanted = values.map((x, m) => (sliders[m].unit === "°" ? (x * Math.PI) / 180 : x));
      const found = followed(machine, states, wanted);
      if (found.far.length) return { far: found.far, motors: wanted.map((x) => [x, null]), draw: () => {} };
      states = found.states;
      const shown = mechanismAt(machine, states);
      const draw = (now) => {
        states.forEach(({ R, p }, b) => (replace(page.machine.bodies[b].p, p), replace(page.machine.bodies[b].q, quaternionOf(R))));
        const { output } = machine;
        replace(page.machine.p, add(onto(states[output].R, machine.output_point), states[output].p));
        now();
      };
      return { ...shown, far: [], motors: wanted.map((x, k) => [x, shown.efforts[k]]), draw };
    },
  };
}

const model = is_mechanism ? mechanism() : hexapod();
const legTable = is_mechanism ? () => {} : table("legs", [...coordinateNames(), "margin"], machine.legs.map(({ kind }, k) => `leg ${k + 1}, ${kind}`));
const motorTable = table("motors", ["coordinate", "effort at rest"], machine.motor_names, machine.motor_units);
let render = () => {};

function update() {
  const shown = model.at(handles.values());
  const say = byId("reach");
  say.className = shown.far.length ? "fail" : "pass";
  say.textContent = shown.far.length ? `Out of reach: ${shown.far.join("; ")}.` : "In reach.";
  byId("condition").textContent = shown.condition === undefined ? "–" : shown.condition.toPrecision(4);
  byId("condition").dataset.value = shown.condition ?? "";
  motorTable(shown.motors);
  legTable(shown.legs_shown);
  shown.draw(() => render());
}

const handles = controls(byId("sliders"), update);
const instant = byId("instant");
instant.max = path.t.length - 1;
instant.addEventListener("input", () => {
  const k = Number(instant.value);
  byId("now").textContent = `${path.t[k].toPrecision(4)} s`;
  handles.set(model.ofPath(k));
  update();
});
handles.set(model.ofPath(0));
update();
globalThis.ursula_page = { plots: [], events: [], machine: model.drawing };
document.addEventListener("ursula:stage", ({ detail: stage }) => {
  render = () => stage.render();
  for (const [key, text, on] of stage.layers) {
    const box = element("input", { type: "checkbox", "data-layer": key });
    box.checked = on;
    box.addEventListener("change", () => stage.show(key, box.checked));
    const label = element("label", {});
    label.append(box, ` ${text}`);
    byId("layers").append(label, " ");
  }
});
