// The picture: renderer, body, fingers and camera put together, drawn when something changed.
import * as THREE from './three.module.min.js';
import { BonesView } from './bones_view.js';
import { FLOATS_OF_VERTEX } from './engine.js';
import { FingersView } from './fingers_view.js';
import { fetchHand } from './hand_shape.js';
import { OrbitCamera } from './camera.js';
import { Picker } from './picker.js';
import { Quality } from './quality.js';
import { SkinView } from './skin_view.js';
import { drawsInSoftware } from './support.js';

const SEE_THROUGH = 0.38;
const TIME_FOR_HAND_MS = 16; // of a picture without it: with the hand it takes half as long again, and 30 come in a second
const MEASURED_PICTURES = 4;
const WIDTH_OF_BACK = 0.72; // of that of the spine: to where the ribs turn to the side
const BEYOND_LEVELS_MM = 30;
const MOST_PIXELS = 1.7e6; // of a screen with very many, not all are drawn

/// {centre, half}: what is palpated of a back, from C7 to S1; null for a body without these names.
function backOf(landmarks) {
  const [top, bottom] = ['C7', 'S1'].map((level) => landmarks.find(({ name }) => name === level)?.at);
  if (!top || !bottom) return null;
  const half = (top[1] - bottom[1]) / 2;
  return { centre: [0, (top[1] + bottom[1]) / 2, (top[2] + bottom[2]) / 2], half: [half * WIDTH_OF_BACK, half + BEYOND_LEVELS_MM, 0] };
}

export class Picture {
  constructor(canvas) {
    this.canvas = canvas;
    this.in_software = drawsInSoftware();
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !this.in_software, alpha: true, powerPreference: 'high-performance' });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // the skin's shader ends in sRGB itself
    this.scene = new THREE.Scene();
    this.world = new THREE.Group();
    this.scene.add(this.world);
    this.orbit = new OrbitCamera();
    const sun = new THREE.DirectionalLight(0xffffff, 2.2);
    sun.position.set(-0.45, 0.62, 0.64);
    this.orbit.camera.add(sun, sun.target, new THREE.AmbientLight(0xffffff, 0.9)); // its target too: it comes with the camera
    this.scene.add(this.orbit.camera);
    this.fingers = new FingersView((place) => this.picker?.normalAround(place, [0, 0, 0]));
    this.world.add(this.fingers.group);
    this.quality = new Quality(() => {
      this.fingers.showAs(this.quality.generous() ? 'hand' : 'finger');
      this.resize();
    });
    this.shown_as = new URLSearchParams(location.search).get('finger'); // 'hand' or 'finger'; else what there is time for
    this.drawn = 0;
    this.passed = 0;
    new ResizeObserver(() => {
      this.resize();
      this.render(); // or what was emptied would be shown
    }).observe(canvas.parentElement);
    this.resize();
  }

  /// A hand for the finger, as long as pictures come quickly.
  async bringHand() {
    const hand = await fetchHand();
    if (!hand) return;
    this.fingers.setHand(hand);
    this.fingers.showAs(this.quality.generous() ? 'hand' : 'finger');
    this.stale = true;
  }
  /// Once there is a body: a hand where a picture of it takes so little that there is time for one.
  chooseHand() {
    const hand = this.shown_as === 'hand' || (this.shown_as !== 'finger' && this.pictureMs() < TIME_FOR_HAND_MS);
    return hand ? this.bringHand() : undefined;
  }
  /// The quickest of a few pictures, from the first command to the last pixel; the first ones compile shaders.
  pictureMs() {
    const gl = this.renderer.getContext();
    let least = Infinity;
    for (let i = 0; i < MEASURED_PICTURES; ++i) {
      const start = performance.now();
      this.render();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits until all is drawn
      least = Math.min(least, performance.now() - start);
    }
    return least;
  }

  setBody(body) {
    for (const part of [this.skin, this.bones]) {
      if (part) {
        this.world.remove(part.mesh);
        part.dispose();
      }
    }
    this.skin = new SkinView(body, this.in_software);
    this.skin.setPictureHeight(this.canvas.clientHeight);
    this.bones = body.bones ? new BonesView(body.bones) : null;
    this.world.add(this.skin.mesh);
    if (this.bones) this.world.add(this.bones.mesh);
    this.picker = new Picker(body.rest, FLOATS_OF_VERTEX, body.corners);
    const { low, high } = this.picker.nodes[0];
    this.middle = low.map((l, axis) => (l + high[axis]) / 2);
    const half = low.map((l, axis) => (high[axis] - l) / 2);
    if (String([this.middle, half]) !== this.shape) this.orbit.frame(this.middle, half, backOf(body.landmarks)); // another body
    this.shape = String([this.middle, half]);
    this.stale = true;
  }
  showBones(on) {
    if (this.bones) this.bones.mesh.visible = on;
    this.skin.setOpacity(on && this.bones ? SEE_THROUGH : 1);
    this.stale = true;
  }

  /// The skin under a point of the picture, -1 to 1: {place, normal, distance} or null.
  pick(x, y) {
    if (!this.picker) return null;
    const { origin, direction } = this.orbit.ray(x, y);
    return this.picker.pick(origin, direction);
  }
  /// The skin above a place of the map plane, seen from the back.
  skinAt(x, y) {
    return this.picker.pick([x, y, 1e4], [0, 0, -1]);
  }

  take(frame) {
    this.skin.take(frame);
    this.fingers.take(frame.fingers);
    const tips = JSON.stringify(frame.fingers.map(({ tip, force }) => [tip, force]));
    if (frame.ranges.length > 0 || tips !== this.tips) this.stale = true;
    this.tips = tips;
  }

  resize() {
    if (this.renderer.xr.isPresenting) return;
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    const least = Math.sqrt(MOST_PIXELS / (width * height));
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, least) * this.quality.share());
    this.renderer.setSize(width, height, false);
    this.orbit.resize(width, height);
    this.skin?.setPictureHeight(height);
    this.stale = true;
  }
  pixels() {
    return [this.canvas.width, this.canvas.height];
  }

  render() {
    this.stale = false;
    ++this.drawn;
    this.renderer.render(this.scene, this.orbit.camera);
  }
  /// Once a picture of the screen; draws only what is new.
  draw(now) {
    this.orbit.fly(now);
    const camera = this.orbit.camera.matrixWorld.elements.join();
    if (camera !== this.camera_before) this.stale = true;
    this.camera_before = camera;
    ++this.passed;
    // Before it is drawn: another number of pixels empties the picture.
    this.quality.add(now, this.stale || this.renderer.xr.isPresenting);
    if (this.stale || this.renderer.xr.isPresenting) this.render();
  }
}
