import { BufferGeometry, CanvasTexture, EdgesGeometry, Group, Line, LineBasicMaterial, LineSegments, Mesh, Sprite, SpriteMaterial, SRGBColorSpace, Vector3 } from "three";
import { ConvexGeometry } from "three/examples/jsm/geometries/ConvexGeometry.js";
import { ball, between, drum, paint, rod, turnTo } from "./shapes.js";
import { color, lineColor } from "./theme.js";
import { quaternionAt, vectorAt } from "./tracks.js";

/** All points of a track. */
export const points = (track) =>
  Array.from({ length: Math.floor(track.length / 3) }, (_, k) => new Vector3(...track.slice(3 * k, 3 * k + 3)));

// A plate through points that need not lie in a plane.
export function plate(corners, thickness) {
  const middle = corners.reduce((sum, point) => sum.add(point), new Vector3()).divideScalar(corners.length);
  const normal = new Vector3();
  corners.forEach((point, k) => {
    const next = corners[(k + 1) % corners.length];
    normal.add(point.clone().sub(middle).cross(next.clone().sub(middle)));
  });
  if (normal.length() === 0) normal.set(0, 0, 1);
  normal.normalize().multiplyScalar(thickness / 2);
  return new ConvexGeometry(corners.flatMap((point) => [point.clone().add(normal), point.clone().sub(normal)]));
}

const up = new Vector3(0, 0, 1);

/** All points that links' ends pass. */
export const linkEnds = (machine) => machine.legs.flatMap((leg) => leg.links.flatMap(({ from, to }) => [...points(from), ...points(to)]));

// A tag's height, its place below a leg's first joint, and its width, in sizes of the machine.
const tag_height = 0.075;
const tag_drop = 0.07;
const tagWidth = (wrong) => (wrong ? 4 : 1) * tag_height;

/** All that the machine, its labels and its path may cover, as things of fit.js. */
export function extent(machine, size) {
  const all = (at, ...half) => at.map((point) => ({ at: point, half: half.map((each) => each * size) }));
  const joint = 0.055; // half of the largest drum's diagonal
  const tags = machine.legs.flatMap((leg, k) => {
    const below = points(leg.joints[0].at).map((point) => point.addScaledVector(up, -tag_drop * size));
    return all(below, tagWidth(machine.wrong.includes(k)) / 2, tag_height / 2);
  });
  const rails = machine.legs.flatMap((leg) => leg.rails.flatMap(({ from, to }) => [...points(from), ...points(to)]));
  return [...all(linkEnds(machine), joint, joint), ...all(rails, 0.02, 0.02), ...all(points(machine.path ?? machine.p), 0.016, 0.016), ...tags];
}

/** The joints of all legs as layers.js needs them. Efforts are positive about the axis reversed. */
export const jointsOf = (machine) =>
  machine.legs.flatMap((leg, k) =>
    leg.joints.map((joint) => ({
      driven: joint.driven,
      color: k,
      sense: -1,
      at: (place) => vectorAt(joint.at, place),
      axes: joint.axes.map((axis) => (place) => vectorAt(axis, place).normalize()),
    })),
  );

function makeJoint(joint, size, material) {
  const group = new Group();
  if (joint.axes.length === 0) group.add(ball(0.022 * size, material));
  joint.axes.forEach((_, k) => {
    const driven = joint.driven && k === 0;
    group.add(drum((driven ? 0.034 : 0.02) * size, (driven ? 0.085 : 0.07) * size, material));
  });
  return group;
}

// A link that begins within the previous link is a rod that slides in its cylinder.
function linkRadius(leg, k) {
  if (k > 0) return 0.011;
  return leg.links.length > 1 && leg.links[1].from !== leg.links[0].to ? 0.024 : 0.016;
}

function makeRail(rail, size) {
  const mesh = rod(0.02 * size, paint(color("metal"), { transparent: true, opacity: 0.6 }));
  const start = { index: 0, share: 0 };
  between(mesh, vectorAt(rail.from, start), vectorAt(rail.to, start));
  return mesh;
}

/** The leg's number, in front of everything; a wrong leg is called so. */
function nameTag(index, wrong, size) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [(64 * tagWidth(wrong)) / tag_height, 64];
  const ink = canvas.getContext("2d");
  ink.font = wrong ? "bold 46px sans-serif" : "40px sans-serif";
  ink.textAlign = "center";
  ink.fillStyle = color(wrong ? "fail" : "text");
  ink.fillText(wrong ? `✗ leg ${index + 1}` : `${index + 1}`, canvas.width / 2, 48);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  const tag = new Sprite(new SpriteMaterial({ map, depthTest: false }));
  tag.scale.set(tagWidth(wrong) * size, tag_height * size, 1);
  return tag;
}

function makeLeg(leg, index, size, wrong) {
  const group = new Group();
  const material = paint(lineColor(index));
  const metal = paint(color("metal"));
  const links = leg.links.map((_, k) => rod(linkRadius(leg, k) * size, material));
  const joints = leg.joints.map((joint) => makeJoint(joint, size, joint.driven ? material : metal));
  const tag = nameTag(index, wrong, size);
  group.add(...links, ...joints, tag, ...leg.rails.map((rail) => makeRail(rail, size)));
  const update = (place) => {
    leg.links.forEach((link, k) => between(links[k], vectorAt(link.from, place), vectorAt(link.to, place)));
    leg.joints.forEach((joint, k) => {
      joints[k].position.copy(vectorAt(joint.at, place));
      joint.axes.forEach((axis, i) => turnTo(joints[k].children[i], vectorAt(axis, place).normalize()));
    });
    tag.position.copy(joints[0].position).addScaledVector(up, -tag_drop * size);
  };
  return { group, update };
}

function outlined(geometry, material, edges) {
  const group = new Group();
  group.add(new Mesh(geometry, material), new LineSegments(new EdgesGeometry(geometry, 20), new LineBasicMaterial({ color: edges })));
  return group;
}

/** Base, legs of any kind, platform and path, drawn from points alone. */
export function makeMachine(machine, size) {
  const group = new Group();
  const start = { index: 0, share: 0 };
  const base_points = machine.legs.map((leg) => vectorAt(leg.links[0].from, start));
  const translucent = { transparent: true, opacity: 0.35, depthWrite: false };
  group.add(outlined(plate(base_points, 0.02 * size), paint(color("metal"), translucent), color("quiet")));
  const platform = outlined(plate(points(machine.hold), 0.04 * size), paint(color("plate"), { transparent: true, opacity: 0.85 }), color("quiet"));
  const legs = machine.legs.map((leg, k) => makeLeg(leg, k, size, machine.wrong.includes(k)));
  const path = new Line(new BufferGeometry().setFromPoints(points(machine.path ?? machine.p)), new LineBasicMaterial({ color: color("text") }));
  const P = ball(0.016 * size, paint(color("text")));
  group.add(platform, path, P, ...legs.map((leg) => leg.group));
  const update = (place) => {
    for (const leg of legs) leg.update(place);
    platform.position.copy(vectorAt(machine.p, place));
    platform.quaternion.copy(quaternionAt(machine.q, place));
    P.position.copy(platform.position);
  };
  return { group, update };
}
