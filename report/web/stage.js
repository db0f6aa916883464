import { AmbientLight, Box3, DirectionalLight, Group, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { eyeFor } from "./fit.js";
import { axesLayer, effortsLayer, errorLayer, framesLayer, reactionsLayer } from "./layers.js";
import * as manipulator from "./machine.js";
import * as mechanism from "./mechanism.js";
import { weakLayer } from "./weak_layer.js";
import { largestVector, placeAt, resolved } from "./tracks.js";

const makers = [
  ["error", "errors, enlarged", true, errorLayer],
  ["efforts", "efforts", false, effortsLayer],
  ["reactions", "reactions", false, reactionsLayer],
  ["axes", "joint axes", false, axesLayer],
  ["frames", "frames", false, framesLayer],
  ["weak", "singular directions", false, weakLayer],
];
/** The page's own word for what a layer draws: a machine of sliding motors has forces. */
const headingOf = (key) => document.querySelector(`#${key} > h2`)?.textContent.toLowerCase();
const usual = new Vector3(-0.75, 1.15, -0.5).normalize();
const slope = Math.tan((17.5 * Math.PI) / 180); // of half the camera's angle
const filled = 0.97; // share of the stage that the machine takes

/** What draws a machine: one of legs and a platform, or one of any bodies. */
const drawing = (machine) => (machine.bodies ? mechanism : manipulator);

/** Powers of ten that make the largest error visible, the default first; 1 if it is visible without. */
function factorsFor(machine, size) {
  const largest = machine.error.length ? largestVector(machine.error, 6) : 0;
  if (largest === 0) return machine.error.length ? [1] : [];
  const best = Math.max(0, Math.floor(Math.log10((0.3 * size) / largest)));
  const out = [10 ** best];
  for (const lower of [1, 2, 3]) if (best - lower > 0) out.push(10 ** (best - lower));
  return [...new Set([...out, 1])];
}

function lights() {
  const group = new Group();
  const sun = new DirectionalLight(0xffffff, 2.2);
  sun.position.set(3, -4, 6);
  const fill = new DirectionalLight(0xffffff, 0.8);
  fill.position.set(-4, 3, 2);
  group.add(new AmbientLight(0xffffff, 1.1), sun, fill);
  return group;
}

class Stage {
  #machine;
  #size;
  #things;
  #layers = new Map();
  #shown = new Map(makers.map(([key, , on]) => [key, on]));
  #asked = false;

  constructor(host, machine, clock, renderer) {
    const box = new Box3().setFromPoints(drawing(machine).linkEnds(machine));
    this.#machine = machine;
    this.#size = box.getSize(new Vector3()).length() / 1.8;
    this.middle = box.getCenter(new Vector3());
    this.clock = clock;
    this.host = host;
    this.renderer = renderer;
    this.#things = drawing(machine).extent(machine, this.#size);
    this.camera = new PerspectiveCamera((360 / Math.PI) * Math.atan(slope), 1, 0.01 * this.#size, 50 * this.#size);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, renderer.domElement);
    this.controls.addEventListener("change", () => this.render());
    this.factors = factorsFor(machine, this.#size);
    this.factor = this.factors[0] ?? 1;
    this.repaint();
    this.layers = makers.filter(([key]) => this.#layers.get(key)).map(([key, text, on]) => [key, headingOf(key) ?? text, on]);
    this.resetView();
    clock.onChange(() => this.render());
    new ResizeObserver(() => this.#fit()).observe(renderer.domElement.parentElement);
  }

  /** Builds everything again in the colours of the style sheet. */
  repaint() {
    this.scene = new Scene();
    this.drawn = drawing(this.#machine).makeMachine(this.#machine, this.#size);
    this.scene.add(lights(), this.drawn.group);
    for (const [key, , , make] of makers) {
      const layer = make(this.#machine, this.#size);
      this.#layers.set(key, layer);
      if (!layer) continue;
      layer.group.visible = this.#shown.get(key);
      this.scene.add(layer.group);
    }
    this.magnify(this.factor);
  }

  show(key, on) {
    this.#shown.set(key, on);
    this.#layers.get(key).group.visible = on;
    this.render();
  }

  magnify(factor) {
    this.factor = factor;
    this.#layers.get("error")?.magnify(factor);
    this.render();
  }

  resetView() {
    this.#look(this.#machine.view ? new Vector3(...this.#machine.view) : usual);
  }

  /** Looks along `forward`, so that all of machine, labels and path is seen. */
  #look(forward) {
    const { camera, controls } = this;
    camera.position.copy(eyeFor(this.#things, forward, camera.up, [filled * slope * camera.aspect, filled * slope]));
    const ahead = this.middle.clone().sub(camera.position).dot(forward);
    controls.target.copy(camera.position).addScaledVector(forward, ahead);
    controls.update();
    this.render();
  }

  #fit() {
    const { clientWidth: width, clientHeight: height } = this.renderer.domElement.parentElement;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.#look(this.camera.getWorldDirection(new Vector3()));
  }

  /** Draws once a frame at most. */
  render() {
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => {
      this.#asked = false;
      const place = placeAt(this.#machine.t, this.clock.t);
      this.drawn.update(place);
      for (const layer of this.#layers.values()) if (layer?.group.visible) layer.update(place);
      this.renderer.render(this.scene, this.camera);
    });
  }
}

/** Replaces the machine's drawing by the moving machine. Without WebGL it returns null and the drawing stays. */
export function addStage(host, machine, clock) {
  let renderer;
  try {
    renderer = new WebGLRenderer({ antialias: true, alpha: true });
  } catch {
    return null;
  }
  const frame = document.createElement("div");
  frame.className = "screen";
  const canvas = renderer.domElement;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "The machine along its motion; drag to turn it, scroll or pinch to zoom");
  frame.append(canvas);
  host.append(frame);
  host.classList.add("moving");
  return new Stage(host, resolved(machine), clock, renderer);
}
