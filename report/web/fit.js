/**
 * Where a camera that looks along `forward` sees all of `things` as large as can be. A thing is a point with half of its
 * width and height on the screen. `tangents` are those of half the camera's angles across and up.
 */
export function eyeFor(things, forward, up, tangents) {
  const across = forward.clone().cross(up).normalize();
  const axes = [across, across.clone().cross(forward)];
  // Each edge of the picture is a plane through the eye: along its axis, a thing's offset − tangent · depth is a bound.
  const bounds = axes.map((axis, k) => {
    const most = [-Infinity, -Infinity];
    for (const thing of things) {
      const [offset, depth] = [thing.at.dot(axis), tangents[k] * thing.at.dot(forward)];
      most[0] = Math.max(most[0], offset + thing.half[k] - depth);
      most[1] = Math.max(most[1], thing.half[k] - offset - depth);
    }
    return most;
  });
  const depth = Math.min(...bounds.map(([one, other], k) => -(one + other) / (2 * tangents[k])));
  const eye = forward.clone().multiplyScalar(depth);
  bounds.forEach(([one, other], k) => eye.addScaledVector(axes[k], (one - other) / 2));
  return eye;
}
