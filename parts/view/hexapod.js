// A platform on legs: coordinates of the legs at a pose in closed form, and the efforts that hold it.

/** A turn by `a` about −y, as (1) of the paper. */
const aboutAxis = (a, [x, y, z]) => [Math.cos(a) * x - Math.sin(a) * z, y, Math.sin(a) * x + Math.cos(a) * z];
const angleOpposite = (opposite, a, b) => Math.acos((a * a + b * b - opposite * opposite) / (2 * a * b));
const frameOf = (x, along) => transposed([x, cross(along, x), along]);
const x_axis = [1, 0, 0];
const y_axis = [0, 1, 0];

/** For each kind: its reach and what it measures, its coordinates, its margin, and links in the leg's fixed frame. */
const kinds = {
  URS: {
    coordinates: ["phi", "psi", "theta"],
    reach: ({ l, s }, k) => [norm(k), Math.abs(l - s), l + s],
    solve: ({ l, s, side }, k) => {
      const q = norm(k);
      const psi = Math.atan2(Math.hypot(k[0], k[2]), k[1]) + side * angleOpposite(s, l, q);
      return [Math.atan2(-k[0], k[2]), psi, side * angleOpposite(q, l, s)];
    },
    margin: ([, , theta]) => Math.abs(Math.sin(theta)),
    links: ({ l }, [phi, psi], k) => {
      const e = aboutAxis(phi, [0, Math.cos(psi), Math.sin(psi)]);
      const [x, R] = [aboutAxis(phi, x_axis), times(l, e)];
      const along = minus(k, R);
      return [{ at: [0, 0, 0], frame: frameOf(x, e), end: R }, { at: R, frame: frameOf(x, times(1 / norm(along), along)), end: k }];
    },
  },
  UPS: {
    coordinates: ["phi", "psi", "d"],
    reach: ({ l, s }, k) => [norm(k), s, l + s],
    solve: (leg, k) => [Math.atan2(-k[0], k[2]), Math.atan2(Math.hypot(k[0], k[2]), k[1]), norm(k)],
    margin: ([, , d], { l, s }) => Math.min(d - s, l + s - d) / l,
    links: ({ l, s }, [phi], k) => {
      const e = times(1 / norm(k), k);
      const [frame, inner] = [frameOf(aboutAxis(phi, x_axis), e), minus(k, times(s, e))];
      return [{ at: [0, 0, 0], frame, end: times(l, e) }, { at: inner, frame, end: k }];
    },
  },
  RUS: {
    coordinates: ["phi", "psi", "theta"],
    reach: ({ l, s }, [x, y, z]) => {
      const c = Math.sqrt((s - y) * (s + y));
      return c >= 0 ? [Math.hypot(x, z), Math.abs(l - c), l + c] : [Math.abs(y), 0, s];
    },
    solve: ({ l, s, side }, [x, y, z]) => {
      const [c, r] = [Math.sqrt((s - y) * (s + y)), Math.hypot(x, z)];
      return [Math.atan2(-x, z) - side * angleOpposite(c, l, r), side * (Math.PI - angleOpposite(r, l, c)), Math.atan2(y, c)];
    },
    margin: ([, psi]) => Math.abs(Math.sin(psi)),
    links: ({ l }, [phi, psi], k) => {
      const e = aboutAxis(phi, [0, 0, 1]);
      const [R, along] = [times(l, e), minus(k, times(l, e))];
      const rod = frameOf(aboutAxis(phi + psi, x_axis), times(1 / norm(along), along));
      return [{ at: [0, 0, 0], frame: frameOf(aboutAxis(phi, x_axis), e), end: R }, { at: R, frame: rod, end: k }];
    },
  },
  PUS: {
    coordinates: ["d", "psi", "theta"],
    reach: ({ s }, [x, , z]) => [Math.hypot(x, z), 0, s],
    solve: ({ s, side }, [x, y, z]) => {
      const r = Math.hypot(x, z);
      const ahead = side * Math.sqrt((s - r) * (s + r));
      return [y - ahead, Math.atan2(-x, z), Math.atan2(r, ahead)];
    },
    margin: ([, , theta]) => Math.abs(Math.cos(theta)),
    links: (leg, [d, psi], k) => {
      const [at, along] = [times(d, y_axis), minus(k, times(d, y_axis))];
      const identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
      const rod = frameOf(aboutAxis(psi, x_axis), times(1 / norm(along), along));
      return [{ at, frame: identity, end: at }, { at, frame: rod, end: k }];
    },
  },
};

/** One leg at a platform point, in B. */
function legAt(leg, B) {
  const kind = kinds[leg.kind];
  const k = onto(transposed(leg.frame), minus(B, leg.base));
  const [distance, least, most] = kind.reach(leg, k);
  if (!(distance > least && distance < most)) return { why: `${distance.toPrecision(4)} m, and it spans ${least.toPrecision(4)} to ${most.toPrecision(4)} m` };
  const coordinates = kind.solve(leg, k);
  const placed = (v) => add(leg.base, onto(leg.frame, v));
  const links = kind.links(leg, coordinates, k).map(({ at, frame, end }, i) => ({
    from: placed(at), to: placed(end), frame: product(leg.frame, frame), center: placed(add(at, onto(frame, leg.centers[i]))),
  }));
  return { coordinates, links, margin: kind.margin(coordinates, leg) };
}

const legsAt = (machine, { p, Q }) => machine.legs.map((leg) => legAt(leg, add(p, onto(Q, leg.point))));

/** Coordinates of the motors, then the potential energy of gravity. */
function numbersAt6(machine, pose) {
  const legs = legsAt(machine, pose);
  if (legs.some(({ why }) => why)) return null;
  const heights = (center) => dot(machine.gravity, center);
  let energy = -machine.platform.mass * heights(add(pose.p, onto(pose.Q, machine.platform.center)));
  legs.forEach(({ links }, i) => links.forEach(({ center }, j) => (energy -= machine.legs[i].masses[j] * heights(center))));
  return [...machine.motors.map(({ leg, joint }) => legs[leg].coordinates[joint]), energy];
}

/** Derivatives of those numbers by [turn; shift], from six neighbours each; their error is of the sixth order. */
function slopesAt(machine, pose) {
  const columns = [0, 1, 2, 3, 4, 5].map((i) => {
    const unit = [0, 1, 2].map((k) => (k === i % 3 ? 1 : 0));
    const step = i < 3 ? 1e-3 : 1e-3 * machine.length;
    const at = (n) => numbersAt6(machine, i < 3 ? { p: pose.p, Q: product(turnBy(times(n * step, unit)), pose.Q) } : { p: add(pose.p, times(n * step, unit)), Q: pose.Q });
    const pairs = [[45, 1], [-9, 2], [1, 3]].map(([c, n]) => [c / (60 * step), at(n), at(-n)]);
    if (pairs.some(([, above, below]) => !above || !below)) return null;
    const turns = (k, difference) => (machine.motors[k]?.turns ? difference - 2 * Math.PI * Math.round(difference / (2 * Math.PI)) : difference);
    return pairs.reduce((sum, [c, above, below]) => add(sum, minus(above, below).map((x, k) => c * turns(k, x))), new Array(machine.motors.length + 1).fill(0));
  });
  return columns.includes(null) ? null : transposed(columns);
}

/** The load's [moment; force] about P in B. */
function loadAt({ load }, { Q }) {
  if (!load) return [0, 0, 0, 0, 0, 0];
  const [force, moment] = load.on_platform ? [onto(Q, load.force), onto(Q, load.moment)] : [load.force, load.moment];
  return [...add(moment, cross(onto(Q, load.point), force)), ...force];
}

/** What the page shows of a pose. Efforts are null next to the end of a leg's reach. */
function hexapodAt(machine, pose) {
  const legs = legsAt(machine, pose);
  const out = { legs, far: legs.flatMap(({ why }, k) => (why ? [`leg ${k + 1}: ${why}`] : [])), efforts: null };
  if (out.far.length) return out;
  const slopes = slopesAt(machine, pose);
  if (!slopes) return out;
  const J = slopes.slice(0, -1);
  out.efforts = solvedTransposed(singular(J), minus(slopes.at(-1), loadAt(machine, pose)));
  const lever = Math.max(...machine.legs.map(({ point }) => norm(point)));
  const scaled = singular(J.map((row) => row.map((x, k) => (k < 3 ? x / lever : x))).map((row) => times(1 / norm(row), row)));
  out.condition = scaled[0].size / scaled.at(-1).size;
  out.weakest = scaled.at(-1).right;
  return out;
}
