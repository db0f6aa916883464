// A machine of any bodies and joints: closes its loops by Newton's method, and gives the efforts that hold it. A body's state is the
// displacement from its reference pose: x ↦ R x + p.

const sideways = (a) => {
  const k = a.map(Math.abs).indexOf(Math.min(...a.map(Math.abs)));
  const b = cross(a, [0, 1, 2].map((i) => (i === k ? 1 : 0)));
  return times(1 / norm(b), b);
};

/** A row of the constraints: its error, and its slopes by [turn; shift] of both bodies. */
const rowOf = (error, parent, child) => ({ error, parent, child });

function jointAt(machine, joint, states) {
  const [A, C] = [states[joint.parent], states[joint.child]];
  const [armA, armC] = [onto(A.R, joint.at), onto(C.R, joint.onChild)];
  const gap = minus(add(armC, C.p), add(armA, A.p));
  const onParent = (v) => onto(A.R, v);
  const onChild = (v) => onto(C.R, onto(transposed(joint.turn), v));
  /** (u of the parent) · (w of the child) = value. */
  const across = (u, w, value = 0) => {
    const [a, c] = [onParent(u), onChild(w)];
    return rowOf(dot(a, c) - value, [...cross(a, c), 0, 0, 0], [...cross(c, a), 0, 0, 0]);
  };
  /** (u of the parent) · gap = 0. */
  const apart = (u) => {
    const a = onParent(u);
    return rowOf(dot(a, gap), [...minus(cross(a, gap), cross(armA, a)), ...times(-1, a)], [...cross(armC, a), ...a]);
  };
  const [a, other] = joint.axes;
  const b = a && sideways(a);
  const c = a && cross(a, b);
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const locked = [[0, 1], [1, 2], [2, 0]].map(([i, j]) => across(axes[i], axes[j]));
  const together = axes.map(apart);
  const rows = {
    fixed: () => [...together, ...locked],
    revolute: () => [...together, across(b, a), across(c, a)],
    prismatic: () => [...locked, apart(b), apart(c)],
    universal: () => [...together, across(a, other, dot(a, other))],
    ball: () => together,
    free: () => [],
  }[joint.kind]();
  if (joint.kind === "revolute") {
    const along = onParent(a);
    const angle = Math.atan2(dot(onParent(c), onChild(b)), dot(onParent(b), onChild(b)));
    const value = joint.position + angle;
    const near = value + 2 * Math.PI * Math.round(((joint.value ?? joint.position) - value) / (2 * Math.PI));
    return { rows, value: near, slope: rowOf(0, [...times(-1, along), 0, 0, 0], [...along, 0, 0, 0]) };
  }
  const slope = joint.kind === "prismatic" ? apart(a) : null;
  return { rows, value: slope ? joint.position + slope.error : 0, slope };
}

/** Every constraint and coordinate of the motors, with a matrix over the moving bodies' [turn; shift]. */
function loopsAt(machine, states) {
  const joints = machine.joints.map((joint) => jointAt(machine, joint, states));
  const spread = (row, { parent, child }) => {
    const out = new Array(6 * machine.moving).fill(0);
    for (const [body, slopes] of [[parent, row.parent], [child, row.child]])
      if (machine.bodies[body].index >= 0) slopes.forEach((x, k) => (out[6 * machine.bodies[body].index + k] += x));
    return out;
  };
  const errors = joints.flatMap(({ rows }) => rows.map(({ error }) => error));
  const matrix = joints.flatMap(({ rows }, k) => rows.map((row) => spread(row, machine.joints[k])));
  for (const k of machine.motors) matrix.push(spread(joints[k].slope, machine.joints[k]));
  return { joints, errors, matrix, spread };
}

/** Follows the motors to `q` in small steps; returns the states, or the joint whose gap stays. */
function followed(machine, states, q) {
  const start = machine.motors.map((k) => machine.joints[k].value);
  const count = Math.max(1, Math.ceil(Math.max(...minus(q, start).map(Math.abs)) / 0.1));
  for (let n = 1; n <= count; ++n) {
    const wanted = add(start, times(n / count, minus(q, start)));
    let left = Infinity;
    for (let k = 0; k < 40; ++k) {
      const { joints, errors, matrix } = loopsAt(machine, states);
      const off = [...errors, ...machine.motors.map((m, i) => joints[m].value - wanted[i])];
      const size = norm(off);
      if (size < 1e-13 * machine.length || (k > 4 && size >= left && size < 1e-9 * machine.length)) {
        left = 0;
        break;
      }
      left = size;
      const by = step(matrix, times(-1, off));
      states = states.map(({ R, p }, b) => {
        const at = 6 * machine.bodies[b].index;
        return at < 0 ? { R, p } : { R: matrixOf(quaternionOf(product(turnBy(by.slice(at, at + 3)), R))), p: add(p, by.slice(at + 3, at + 6)) };
      });
    }
    const { joints } = loopsAt(machine, states);
    if (left > 0) {
      const gaps = joints.map(({ rows }) => norm(rows.map(({ error }) => error)));
      return { far: [`the loops do not close; the largest gap is at ${machine.joints[gaps.indexOf(Math.max(...gaps))].name}`] };
    }
    machine.joints.forEach((joint, k) => (joint.value = joints[k].value));
  }
  return { states, far: [] };
}

/** What the page shows of a pose: the efforts are the multipliers of the motors' coordinates. */
function mechanismAt(machine, states) {
  const { joints, matrix, spread } = loopsAt(machine, states);
  let slope = new Array(6 * machine.moving).fill(0);
  machine.bodies.forEach(({ index, mass, center }, b) => {
    if (index < 0) return;
    const force = times(-mass, machine.gravity);
    [...cross(onto(states[b].R, center), force), ...force].forEach((x, k) => (slope[6 * index + k] += x));
  });
  machine.joints.forEach((joint, k) => {
    if (joint.stiffness) slope = add(slope, times(joint.stiffness * (joints[k].value - joint.rest), spread(joints[k].slope, joint)));
  });
  const parts = singular(matrix);
  const efforts = solvedTransposed(parts, slope).slice(-machine.motors.length);
  const ranked = ofRank(parts);
  return { efforts, joints, condition: ranked[0].size / ranked.at(-1).size };
}
