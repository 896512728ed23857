// The camera that goes round a place: turned, shifted and zoomed by gestures; and rays through points of the picture.
import * as THREE from './three.module.min.js';

const STEEPEST = 1.5; // radians: not quite from straight above
const FIELD_DEG = 32;
// Round the body's long axis, and up: obliquely from behind, where a dent shows its depth; from the back, the patient's
// right, the front, the left, above.
const OBLIQUE = [0.32, 0.2];
const VIEWS = [OBLIQUE, [0, 0], [Math.PI / 2, 0], [Math.PI, 0], [-Math.PI / 2, 0], [0, 0.9]];

export class OrbitCamera {
  constructor() {
    this.camera = new THREE.PerspectiveCamera(FIELD_DEG, 1, 10, 20000);
    this.target = new THREE.Vector3();
    this.radius = 500;
    this.view = 0;
    this.home();
  }

  /// Looks at a body of this middle and half size (mm); first at a part of it, where one is given: {centre, half}.
  frame(centre, half, part = null) {
    this.middle = new THREE.Vector3(...centre);
    this.half = half;
    this.home();
    this.part = part;
    if (part) this.lookAtPart();
  }
  lookAtPart() {
    this.target.set(...this.part.centre);
    this.distance = this.fitting(this.part.half);
    this.place();
  }
  home() {
    this.flight = null;
    this.part = null;
    [this.yaw, this.pitch] = VIEWS[this.view];
    if (this.middle) this.target.copy(this.middle);
    this.distance = this.fitting();
    this.place();
  }
  nextView(step = 1) {
    this.view = (this.view + step + VIEWS.length) % VIEWS.length;
    this.home();
  }
  /// How far away the whole body, or so much of it, is seen in a picture of this shape.
  fitting(half = this.half) {
    if (!half) return 2000;
    const tangent = Math.tan((FIELD_DEG * Math.PI) / 360);
    return Math.max(half[1] / tangent, Math.max(half[0], half[2]) / (tangent * this.camera.aspect)) * 1.06 + half[2];
  }
  resize(width, height) {
    const seen = [this.part?.half, this.half].find((half) => half && Math.abs(this.distance - this.fitting(half)) < 1);
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    if (seen) this.distance = this.fitting(seen);
    this.place();
  }
  place() {
    const level = Math.cos(this.pitch);
    const away = new THREE.Vector3(Math.sin(this.yaw) * level, Math.sin(this.pitch), Math.cos(this.yaw) * level);
    this.camera.position.copy(this.target).addScaledVector(away, this.distance);
    this.camera.lookAt(this.target);
    this.camera.near = Math.max(5, this.distance / 100);
    this.camera.far = this.distance * 20;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  /// Looks obliquely at a place of the skin from so far away, mm, after `ms` of flight.
  flyTo(place, normal, distance, ms) {
    const bounded = (angle) => Math.max(-STEEPEST, Math.min(STEEPEST, angle));
    const yaw = Math.atan2(normal[0], normal[2]) + OBLIQUE[0];
    const round = Math.round((this.yaw - yaw) / (2 * Math.PI)) * 2 * Math.PI; // the short way
    const to = { target: new THREE.Vector3(...place), yaw: yaw + round, pitch: bounded(Math.asin(normal[1]) + OBLIQUE[1]), distance };
    const from = { target: this.target.clone(), yaw: this.yaw, pitch: this.pitch, distance: this.distance };
    this.flight = { from, to, ms, start: null };
    if (ms === 0) this.fly(0);
  }
  /// Time is `now`, ms: a flight goes on.
  fly(now) {
    if (!this.flight) return;
    const { from, to, ms } = this.flight;
    this.flight.start ??= now;
    const t = ms > 0 ? Math.min(1, (now - this.flight.start) / ms) : 1;
    const share = t * t * (3 - 2 * t);
    for (const key of ['yaw', 'pitch', 'distance']) this[key] = from[key] + share * (to[key] - from[key]);
    this.target.lerpVectors(from.target, to.target, share);
    if (t === 1) this.flight = null;
    this.place();
  }

  turn(dx, dy) {
    this.flight = null;
    this.yaw -= dx * 0.008;
    this.pitch = Math.max(-STEEPEST, Math.min(STEEPEST, this.pitch + dy * 0.008));
    this.place();
  }
  /// By pixels of a picture so high.
  shift(dx, dy, height) {
    this.flight = null;
    const mm = (2 * this.distance * Math.tan((FIELD_DEG * Math.PI) / 360)) / height;
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 0);
    const up = new THREE.Vector3().setFromMatrixColumn(this.camera.matrix, 1);
    this.target.addScaledVector(right, -dx * mm).addScaledVector(up, dy * mm);
    this.place();
  }
  zoom(factor) {
    this.flight = null;
    this.distance = Math.max(60, Math.min(20 * this.fitting(), this.distance * factor));
    this.place();
  }

  /// Through a point of the picture, -1 to 1 to the right and up.
  ray(x, y) {
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(x, y), this.camera);
    return { origin: caster.ray.origin.toArray(), direction: caster.ray.direction.toArray() };
  }
  /// Where a place of the body is in the picture, -1 to 1; null behind the camera.
  project(place) {
    const p = new THREE.Vector3(...place).project(this.camera);
    return p.z < 1 ? [p.x, p.y] : null;
  }
  /// Of the picture, as directions of the body: right, up, towards the eye.
  axes() {
    return [0, 1, 2].map((i) => new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, i).toArray());
  }
}
