import { Group, Vector3 } from "three";
import { points } from "./machine.js";
import { aim, arrow, paint } from "./shapes.js";
import { color, lineColor } from "./theme.js";
import { numbersAt, quaternionAt, vectorAt } from "./tracks.js";

/**
 * The weak directions near a singular pose: the platform's motion that the locked motors resist least (velocities of its corners and
 * of P), and the direction at B along which the motor of the leg nearest to its own limit hardly moves it.
 */
export function weakLayer(machine, size) {
  if (!machine.weak) return null;
  const group = new Group();
  const holds = points(machine.hold);
  const reach = Math.max(...holds.map((hold) => hold.length()));
  const yielding = [new Vector3(), ...holds].map((hold) => ({ hold, mesh: arrow(0.009 * size, paint(color("weak"))) }));
  const lost = machine.legs.map((_, k) => [1, -1].map((sign) => ({ sign, mesh: arrow(0.013 * size, paint(lineColor(k))) })));
  group.add(...yielding.map(({ mesh }) => mesh), ...lost.flat().map(({ mesh }) => mesh));
  const update = (place) => {
    const [x, y, z, ...v] = numbersAt(machine.weak.yielding, place, 6);
    const omega = new Vector3(x, y, z).divideScalar(reach);
    const Q = quaternionAt(machine.q, place);
    const P = vectorAt(machine.p, place);
    const moved = yielding.map(({ hold, mesh }) => {
      const arm = hold.clone().applyQuaternion(Q);
      return { mesh, at: P.clone().add(arm), velocity: new Vector3(...v).add(omega.clone().cross(arm)) };
    });
    const largest = Math.max(...moved.map(({ velocity }) => velocity.length()));
    for (const { mesh, at, velocity } of moved) aim(mesh, at, velocity.multiplyScalar((0.35 * size) / largest));
    const weakest = machine.weak.leg[place.index];
    lost.forEach((pair, k) => {
      const at = vectorAt(machine.legs[k].links.at(-1).to, place);
      for (const { sign, mesh } of pair)
        aim(mesh, at, k === weakest ? vectorAt(machine.weak.lost, { ...place, share: 0 }).multiplyScalar(0.25 * sign * size) : new Vector3());
    });
  };
  return { group, update };
}
