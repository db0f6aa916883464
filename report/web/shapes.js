import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshStandardMaterial, SphereGeometry, Vector3 } from "three";

const up = new Vector3(0, 1, 0); // the axis of a cylinder
const round = 20;

export const paint = (color, options = {}) => new MeshStandardMaterial({ color, roughness: 0.6, metalness: 0.15, ...options });

/** A rod; `between` stretches it from one point to another. */
export function rod(radius, material) {
  return new Mesh(new CylinderGeometry(radius, radius, 1, round), material);
}

export function between(mesh, from, to) {
  const along = to.clone().sub(from);
  const length = along.length();
  mesh.visible = length > 0;
  if (!mesh.visible) return;
  mesh.position.copy(from).addScaledVector(along, 0.5);
  mesh.quaternion.setFromUnitVectors(up, along.divideScalar(length));
  mesh.scale.set(1, length, 1);
}

export const ball = (radius, material) => new Mesh(new SphereGeometry(radius, round, round / 2), material);

/** A drum; `turnTo` sets its axis. */
export const drum = (radius, width, material) => new Mesh(new CylinderGeometry(radius, radius, width, round), material);
export const turnTo = (mesh, axis) => mesh.quaternion.setFromUnitVectors(up, axis);

/** An arrow from a point; `aim` sets it, and hides it if it has no length. */
export function arrow(radius, material) {
  const group = new Group();
  const shaft = new Mesh(new CylinderGeometry(radius, radius, 1, 10), material);
  const head = new Mesh(new ConeGeometry(2.6 * radius, 6 * radius, 14), material);
  group.add(shaft, head);
  group.userData = { shaft, head, radius };
  return group;
}

export function aim(group, from, vector) {
  const { shaft, head, radius } = group.userData;
  const length = vector.length();
  group.visible = length > radius;
  if (!group.visible) return;
  group.position.copy(from);
  group.quaternion.setFromUnitVectors(up, vector.clone().divideScalar(length));
  const straight = Math.max(length - 6 * radius, 1e-6);
  shaft.scale.set(1, straight, 1);
  shaft.position.set(0, straight / 2, 0);
  head.position.set(0, straight + 3 * radius, 0);
}
