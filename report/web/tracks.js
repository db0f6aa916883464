import { Quaternion, Vector3 } from "three";

/** The place of `t` among the instants: the index of the previous one, and the share of the way to the next. */
export function placeAt(instants, t) {
  let low = 0;
  let high = instants.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (instants[middle] <= t) low = middle;
    else high = middle;
  }
  const width = instants[high] - instants[low];
  return { index: low, share: width > 0 ? Math.min(Math.max((t - instants[low]) / width, 0), 1) : 0 };
}

/** Interpolates item `item`, of `size` numbers, in rows of `row` numbers. A track with one row is constant. */
export function numbersAt(track, { index, share }, size, row = size, item = 0) {
  const still = track.length <= row;
  const from = (still ? 0 : index * row) + item * size;
  const to = still || share === 0 ? from : from + row;
  return Array.from({ length: size }, (_, k) => {
    const [a, b] = [track[from + k], track[to + k]];
    return a == null || b == null ? NaN : (1 - share) * a + share * b;
  });
}

export const vectorAt = (track, place, row = 3, item = 0) => new Vector3(...numbersAt(track, place, 3, row, item));

/** A rotation from [w, x, y, z], whose signs are continuous. */
export function quaternionAt(track, place) {
  const [w, x, y, z] = numbersAt(track, place, 4);
  return new Quaternion(x, y, z, w).normalize();
}

/** Returns the machine with tracks in place of their numbers. */
export function resolved(machine) {
  const track = (index) => machine.tracks[index];
  const legs = machine.legs.map((leg) => ({
    kind: leg.kind,
    links: leg.links.map(({ from, to }) => ({ from: track(from), to: track(to) })),
    rails: leg.rails.map(({ from, to }) => ({ from: track(from), to: track(to) })),
    joints: leg.joints.map((joint) => ({ ...joint, at: track(joint.at), axes: joint.axes.map(track) })),
  }));
  return { ...machine, legs };
}

/** The quaternion of a rotation vector. */
export function rotation(vector) {
  const angle = vector.length();
  return angle > 0 ? new Quaternion().setFromAxisAngle(vector.clone().divideScalar(angle), angle) : new Quaternion();
}

/** The largest length of the three-vectors in a track. */
export function largestVector(track, row, item = 0) {
  let largest = 0;
  for (let k = item * 3; k + 2 < track.length; k += row) {
    const size = Math.hypot(track[k], track[k + 1], track[k + 2]);
    if (size > largest) largest = size;
  }
  return largest;
}
