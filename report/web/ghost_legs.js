import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Vector3 } from "three";
import { vectorAt } from "./tracks.js";

const tiny = 1e-6;

/** The knee between A and B of a leg in the plane of `inPlane`, on the side of `knee`; null if the links do not reach. */
function kneeInPlane(A, B, knee, commanded, inPlane) {
  const [l, s] = [knee.distanceTo(A), commanded.distanceTo(knee)];
  const along = B.clone().sub(A);
  const q = along.length();
  const share = (q * q + l * l - s * s) / (2 * q);
  if (!(Math.abs(share) < l)) return null;
  along.divideScalar(q);
  const side = inPlane.clone().addScaledVector(along, -inPlane.dot(along));
  if (side.length() < tiny) return null;
  const was = commanded.clone().sub(A).normalize();
  const bend = knee.clone().sub(A);
  bend.addScaledVector(was, -bend.dot(was));
  const wasSide = inPlane.clone().addScaledVector(was, -inPlane.dot(was));
  side.normalize().multiplyScalar(Math.sign(bend.dot(wasSide)) * Math.sqrt(l * l - share * share));
  return A.clone().addScaledVector(along, share).add(side);
}

// Enlarged errors may put B out of the leg's reach; then the leg is drawn turned and stretched.
function kneeStretched(A, B, knee, commanded) {
  const [from, to] = [commanded.clone().sub(A), B.clone().sub(A)];
  const turned = knee.clone().sub(A);
  const axis = from.clone().cross(to);
  if (axis.length() > 0) turned.applyAxisAngle(axis.normalize(), from.angleTo(to));
  return A.clone().addScaledVector(turned, to.length() / from.length());
}

/** The knee of a leg that the platform holds at B instead of at the commanded point. */
export function kneeFor(leg, place, B) {
  const A = vectorAt(leg.links[0].from, place);
  const knee = vectorAt(leg.links[0].to, place);
  const commanded = vectorAt(leg.links.at(-1).to, place);
  const u = vectorAt(leg.joints[0].axes[0], place);
  const normal = knee.clone().sub(A).cross(commanded.clone().sub(A));
  const bends = normal.length() > tiny * knee.distanceTo(A) * commanded.distanceTo(A);
  const turnsInPlane = bends && Math.abs(normal.normalize().dot(u)) < tiny;
  return (turnsInPlane && kneeInPlane(A, B, knee, commanded, u)) || kneeStretched(A, B, knee, commanded);
}

/** Thin legs from the base to the points of a platform that is off its path. */
export function ghostLegs(machine, color) {
  const positions = new BufferAttribute(new Float32Array(12 * machine.legs.length), 3);
  const geometry = new BufferGeometry().setAttribute("position", positions);
  const lines = new LineSegments(geometry, new LineBasicMaterial({ color }));
  lines.frustumCulled = false; // its points move, but its bounds would stay
  const holds = machine.legs.map((_, k) => new Vector3(...machine.hold.slice(3 * k, 3 * k + 3)));
  const update = (place, platform) => {
    machine.legs.forEach((leg, k) => {
      const B = holds[k].clone().applyQuaternion(platform.quaternion).add(platform.position);
      const knee = kneeFor(leg, place, B);
      [vectorAt(leg.links[0].from, place), knee, knee, B].forEach((point, i) => positions.setXYZ(4 * k + i, ...point));
    });
    positions.needsUpdate = true;
  };
  return { lines, update };
}
