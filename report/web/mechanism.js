// A machine of any bodies and joints: rods and plates between each body's joints, as they move.
import { BufferGeometry, CanvasTexture, EdgesGeometry, Group, Line, LineBasicMaterial, LineSegments, Mesh, Sprite, SpriteMaterial, SRGBColorSpace, Vector3 } from "three";
import { ConvexGeometry } from "three/examples/jsm/geometries/ConvexGeometry.js";
import { ball, between, drum, paint, rod, turnTo } from "./shapes.js";
import { color, lineColor } from "./theme.js";
import { quaternionAt, vectorAt } from "./tracks.js";

const start = { index: 0, share: 0 };
const vector = (numbers, k = 0) => new Vector3(...numbers.slice(3 * k, 3 * k + 3));
const pointsOf = (body) => Array.from({ length: body.points.length / 3 }, (_, k) => vector(body.points, k));

/** A page where the machine moves freely has its commanded path apart. */
function pathOf(machine) {
  const along = machine.path ?? machine.p;
  return Array.from({ length: along.length / 3 }, (_, k) => vector(along, k));
}

const poseAt = (body, place) => ({ p: vectorAt(body.p, place), q: quaternionAt(body.q, place) });
const moved = (point, { p, q }) => point.clone().applyQuaternion(q).add(p);

/** The instants at which the machine's extent is taken. */
function someInstants(machine) {
  const step = Math.max(1, Math.floor(machine.t.length / 24));
  return machine.t.map((_, index) => ({ index, share: 0 })).filter(({ index }) => index % step === 0);
}

/** All points that bodies' points pass. */
export const linkEnds = (machine) =>
  someInstants(machine).flatMap((place) => machine.bodies.flatMap((body) => pointsOf(body).map((point) => moved(point, poseAt(body, place)))));

const tag_height = 0.075;
const tag_drop = 0.085;

/** A motor's name as it is painted. */
function inked(name, wrong) {
  const text = wrong ? `✗ ${name}` : name;
  const font = wrong ? "bold 44px sans-serif" : "40px sans-serif";
  const ink = document.createElement("canvas").getContext("2d");
  ink.font = font;
  return { text, font, width: Math.ceil(ink.measureText(text).width) + 8 };
}

const motorJoints = (machine) => machine.joints.filter(({ motor }) => motor >= 0).sort((a, b) => a.motor - b.motor);
const isWrong = (machine, joint) => machine.wrong.includes(joint.motor);
const placeOf = (machine, joint, place) => moved(vector(joint.onChild), poseAt(machine.bodies[joint.child], place));
const axisOf = (machine, joint, k, place) =>
  vector(joint.axes[k]).applyQuaternion(quaternionAt(machine.bodies[k === 0 ? joint.parent : joint.child].q, place)).normalize();

/** All that the machine, its labels and its path may cover, as things of fit.js. */
export function extent(machine, size) {
  const all = (at, ...half) => at.map((point) => ({ at: point, half: half.map((each) => each * size) }));
  const path = pathOf(machine);
  const tags = motorJoints(machine).flatMap((joint) => {
    const { width } = inked(joint.name, isWrong(machine, joint));
    return all([placeOf(machine, joint, start)], ((width / 64) * tag_height) / 2, tag_drop + tag_height / 2);
  });
  return [...all(linkEnds(machine), 0.055, 0.055), ...all(path, 0.016, 0.016), ...tags];
}

function nameTag(name, wrong, size) {
  const { text, font, width } = inked(name, wrong);
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width, 64];
  const ink = canvas.getContext("2d");
  ink.font = font;
  ink.textAlign = "center";
  ink.lineWidth = 7;
  ink.lineJoin = "round";
  ink.strokeStyle = color("panel");
  ink.strokeText(text, width / 2, 46);
  ink.fillStyle = color(wrong ? "fail" : "text");
  ink.fillText(text, width / 2, 46);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  const tag = new Sprite(new SpriteMaterial({ map, depthTest: false }));
  tag.center.set(0.5, 0.5 + tag_drop / tag_height); // below its joint on the screen, wherever one looks from
  tag.renderOrder = 1;
  tag.scale.set((width / 64) * tag_height * size, tag_height * size, 1);
  return tag;
}

// A plate through corners in the order of their outline, which lie nearly in a plane.
function plateMesh(corners, thickness, material) {
  const middle = corners.reduce((sum, point) => sum.add(point), new Vector3()).divideScalar(corners.length);
  const normal = new Vector3();
  corners.forEach((point, k) => {
    const next = corners[(k + 1) % corners.length];
    normal.add(point.clone().sub(middle).cross(next.clone().sub(middle)));
  });
  if (normal.length() === 0) return null;
  normal.normalize().multiplyScalar(thickness / 2);
  const geometry = new ConvexGeometry(corners.flatMap((point) => [point.clone().add(normal), point.clone().sub(normal)]));
  const group = new Group();
  group.add(new Mesh(geometry, material), new LineSegments(new EdgesGeometry(geometry, 20), new LineBasicMaterial({ color: color("quiet") })));
  return group;
}

/** A body at the reference pose; its pose moves the whole group. */
function makeBody(body, index, size) {
  const group = new Group();
  const shade = body.fixed ? color("metal") : body.output ? color("plate") : lineColor(index);
  const solid = paint(shade);
  const radius = (body.output ? 0.018 : 0.012) * size;
  const points = pointsOf(body);
  for (const [from, to] of body.rods) {
    const mesh = rod(radius, body.fixed ? paint(shade, { transparent: true, opacity: 0.5 }) : solid);
    between(mesh, points[from], points[to]);
    group.add(mesh);
  }
  if (body.plate.length > 2) {
    const pale = paint(shade, { transparent: true, opacity: body.fixed ? 0.3 : body.output ? 0.8 : 0.45, depthWrite: false });
    const mesh = plateMesh(body.plate.map((k) => points[k]), (body.output ? 0.03 : 0.016) * size, pale);
    if (mesh) group.add(mesh);
  }
  return group;
}

const drum_of = { revolute: [0.02, 0.07], prismatic: [0.024, 0.05], universal: [0.018, 0.06] };

function makeJoint(machine, joint, size) {
  const group = new Group();
  const driven = joint.motor >= 0;
  const material = paint(driven ? (isWrong(machine, joint) ? color("fail") : lineColor(joint.motor)) : color("metal"));
  const [radius, width] = drum_of[joint.kind] ?? [0, 0];
  joint.axes.forEach(() => group.add(drum((driven ? 1.7 : 1) * radius * size, (driven ? 1.25 : 1) * width * size, material)));
  if (joint.kind === "ball") group.add(ball(0.02 * size, material));
  // What slides stays joined to where it slides by a rail.
  const rail = joint.kind === "prismatic" ? rod(0.008 * size, paint(color("metal"), { transparent: true, opacity: 0.6 })) : null;
  const tag = driven ? nameTag(joint.name, isWrong(machine, joint), size) : null;
  const all = new Group();
  all.add(group, ...[rail, tag].filter(Boolean));
  const update = (place) => {
    group.position.copy(placeOf(machine, joint, place));
    joint.axes.forEach((_, k) => turnTo(group.children[k], axisOf(machine, joint, k, place)));
    if (rail) between(rail, moved(vector(joint.at), poseAt(machine.bodies[joint.parent], place)), group.position);
    tag?.position.copy(group.position);
  };
  return { group: all, update };
}

/** The joints as layers.js needs them: where they are, their axes, and the sense of efforts, in the order of motors. */
export const jointsOf = (machine) =>
  [...motorJoints(machine), ...machine.joints.filter(({ motor }) => motor < 0)].map((joint) => ({
    driven: joint.motor >= 0,
    color: Math.max(joint.motor, 0),
    sense: 1,
    at: (place) => placeOf(machine, joint, place),
    axes: joint.axes.map((_, k) => (place) => axisOf(machine, joint, k, place)),
  }));

/** Ground, bodies, joints, motors with their names, and the output's path. */
export function makeMachine(machine, size) {
  const group = new Group();
  let moving = 0;
  const bodies = machine.bodies.map((body) => makeBody(body, body.fixed ? 0 : moving++, size));
  const joints = machine.joints.map((joint) => makeJoint(machine, joint, size));
  const path = pathOf(machine);
  const line = new Line(new BufferGeometry().setFromPoints(path), new LineBasicMaterial({ color: color("text") }));
  const output = ball(0.016 * size, paint(color("text")));
  group.add(...bodies, ...joints.map((joint) => joint.group), line, output);
  const update = (place) => {
    machine.bodies.forEach((body, k) => {
      const { p, q } = poseAt(body, place);
      bodies[k].position.copy(p);
      bodies[k].quaternion.copy(q);
    });
    for (const joint of joints) joint.update(place);
    output.position.copy(vectorAt(machine.p, place));
  };
  return { group, update };
}
