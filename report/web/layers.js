import { AxesHelper, BufferGeometry, EdgesGeometry, Group, Line, LineBasicMaterial, LineSegments, Mesh, Vector3 } from "three";
import { ghostLegs } from "./ghost_legs.js";
import { jointsOf, plate, points } from "./machine.js";
import * as mechanism from "./mechanism.js";
import { aim, arrow, ball, between, paint, rod } from "./shapes.js";
import { color, lineColor } from "./theme.js";
import { largestVector, numbersAt, quaternionAt, rotation, vectorAt } from "./tracks.js";

const errorAt = (machine, place) => [vectorAt(machine.error, place, 6, 0), vectorAt(machine.error, place, 6, 1)];

/** The simulated platform with its errors enlarged, the legs that hold it, and its path. The machine itself is drawn as commanded. */
export function errorLayer(machine, size) {
  if (machine.error.length === 0) return null;
  const group = new Group();
  const shade = color("error");
  const geometry = plate(points(machine.hold), 0.04 * size);
  const ghost = new Group();
  ghost.add(new Mesh(geometry, paint(shade, { transparent: true, opacity: 0.16, depthWrite: false })));
  ghost.add(new LineSegments(new EdgesGeometry(geometry, 20), new LineBasicMaterial({ color: shade })));
  const path = new Line(new BufferGeometry(), new LineBasicMaterial({ color: shade }));
  const P = ball(0.012 * size, paint(shade));
  const legs = ghostLegs(machine, shade);
  group.add(ghost, path, P, legs.lines);
  let factor = 1;
  const drawPath = () => {
    const commanded = points(machine.p);
    const off = commanded.map((p, index) => p.addScaledVector(errorAt(machine, { index, share: 0 })[0], factor));
    const reached = off.findIndex((p) => Number.isNaN(p.x));
    path.geometry.dispose();
    path.geometry = new BufferGeometry().setFromPoints(reached < 0 ? off : off.slice(0, reached));
  };
  const magnify = (by) => {
    factor = by;
    drawPath();
  };
  const update = (place) => {
    const [shift, turn] = errorAt(machine, place);
    // If it cannot be told from the machine's own platform, it would only stain that one.
    const off = factor * (shift.length() + 0.3 * size * turn.length());
    ghost.visible = P.visible = legs.lines.visible = off > 2e-3 * size;
    if (!ghost.visible) return;
    ghost.position.copy(vectorAt(machine.p, place)).addScaledVector(shift, factor);
    ghost.quaternion.copy(rotation(turn.multiplyScalar(factor))).multiply(quaternionAt(machine.q, place));
    P.position.copy(ghost.position);
    legs.update(place, ghost);
  };
  magnify(1);
  return { group, update, magnify };
}

const allJoints = (machine) => (machine.bodies ? mechanism.jointsOf(machine) : jointsOf(machine));

/** Every joint's axes; driven ones are longer. */
export function axesLayer(machine, size) {
  const group = new Group();
  const rods = [];
  for (const joint of allJoints(machine)) {
    joint.axes.forEach((axis, i) => {
      const mesh = rod(0.003 * size, paint(lineColor(joint.color)));
      rods.push({ mesh, joint, axis, half: (joint.driven && i === 0 ? 0.22 : 0.12) * size });
      group.add(mesh);
    });
  }
  const update = (place) => {
    for (const { mesh, joint, axis, half } of rods) {
      const at = joint.at(place);
      const along = axis(place).multiplyScalar(half);
      between(mesh, at.clone().sub(along), at.clone().add(along));
    }
  };
  return { group, update };
}

/** Frames of base and platform: x red, y green, z blue. */
export function framesLayer(machine, size) {
  const group = new Group();
  const platform = new AxesHelper(0.3 * size);
  group.add(new AxesHelper(0.3 * size), platform);
  const update = (place) => {
    platform.position.copy(vectorAt(machine.p, place));
    platform.quaternion.copy(quaternionAt(machine.q, place));
  };
  return { group, update };
}

/** Each motor's effort as an arrow along its axis; for a torque it is the moment vector. */
export function effortsLayer(machine, size) {
  const joints = allJoints(machine).filter((joint) => joint.driven);
  const count = joints.length;
  if (count === 0 || machine.efforts.length === 0 || machine.efforts.length % count !== 0) return null;
  const largest = machine.efforts.reduce((most, value) => Math.max(most, Math.abs(value ?? 0)), 0);
  const group = new Group();
  const arrows = joints.map((joint) => arrow(0.012 * size, paint(lineColor(joint.color))));
  group.add(...arrows);
  const update = (place) => {
    const efforts = numbersAt(machine.efforts, place, count);
    joints.forEach((joint, i) => {
      const length = largest > 0 ? (0.55 * joint.sense * size * efforts[i]) / largest : 0;
      aim(arrows[i], joint.at(place), joint.axes[0](place).multiplyScalar(length || 0));
    });
  };
  return { group, update };
}

/** Forces of the base on the legs and of the legs on the platform. */
export function reactionsLayer(machine, size) {
  const legs = machine.legs.length;
  const row = 3 * legs;
  if (machine.onPlatform.length < row) return null;
  let largest = 0;
  for (const track of [machine.onPlatform, machine.onBase])
    for (let leg = 0; leg < legs; ++leg) largest = Math.max(largest, largestVector(track, row, leg));
  if (largest === 0) return null;
  const group = new Group();
  const arrows = [];
  const add = (track, leg, at) => {
    const mesh = arrow(0.008 * size, paint(lineColor(leg)));
    arrows.push({ mesh, track, leg, at });
    group.add(mesh);
  };
  machine.legs.forEach((leg, k) => {
    add(machine.onPlatform, k, leg.links.at(-1).to);
    add(machine.onBase, k, leg.links[0].from);
  });
  const update = (place) => {
    for (const { mesh, track, leg, at } of arrows) {
      const force = vectorAt(track, place, row, leg).multiplyScalar((0.6 * size) / largest);
      aim(mesh, vectorAt(at, place), Number.isNaN(force.x) ? new Vector3() : force);
    }
  };
  return { group, update };
}
