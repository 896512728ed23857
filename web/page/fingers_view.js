// The fingers, what they feel as an arrow, and the flags of the game.
import * as THREE from './three.module.min.js';

export const FINGER_COLOURS = [0x4f9bff, 0xff6b5e];
const RADIUS_MM = 8; // web/engine/live_body.h
const MM_PER_N = 9;

function arrow(colour) {
  const material = new THREE.MeshBasicMaterial({ color: colour });
  const shaft = new THREE.Mesh(new THREE.CylinderGeometry(1.1, 1.1, 1, 12).translate(0, 0.5, 0), material);
  const head = new THREE.Mesh(new THREE.ConeGeometry(3, 7, 16).translate(0, 3.5, 0), material);
  const group = new THREE.Group();
  group.add(shaft, head);
  return { group, shaft, head };
}

function ring(colour) {
  const mesh = new THREE.Mesh(new THREE.TorusGeometry(1, 0.06, 8, 64), new THREE.MeshBasicMaterial({ color: colour, depthTest: false }));
  mesh.renderOrder = 5;
  mesh.visible = false;
  return mesh;
}

export class FingersView {
  constructor() {
    this.group = new THREE.Group();
    this.fingers = FINGER_COLOURS.map((colour) => {
      const ball = new THREE.Mesh(new THREE.SphereGeometry(RADIUS_MM, 32, 20), new THREE.MeshLambertMaterial({ color: colour }));
      const force = arrow(0xffd34d);
      ball.visible = force.group.visible = false;
      this.group.add(ball, force.group);
      return { ball, force };
    });
    this.mark = ring(0xffffff); // where the player thinks it is
    this.truth = ring(0x57e39a); // where it is
    this.group.add(this.mark, this.truth);
  }

  /// `felt`: fingers of a frame.
  take(felt) {
    felt.forEach((finger, i) => {
      const { ball, force } = this.fingers[i];
      const here = finger.tip.every((x) => Math.abs(x) < 1e4); // farther is nowhere
      ball.visible = here;
      if (here) ball.position.fromArray(finger.tip);
      const size = Math.hypot(...finger.force);
      force.group.visible = here && size > 0.05;
      if (!force.group.visible) return;
      const direction = new THREE.Vector3().fromArray(finger.force).normalize();
      force.group.position.fromArray(finger.tip).addScaledVector(direction, RADIUS_MM);
      force.group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction);
      force.shaft.scale.y = Math.max(0.01, size * MM_PER_N);
      force.head.position.y = size * MM_PER_N;
    });
  }

  showRing(which, place, normal, radius) {
    const mesh = this[which];
    mesh.visible = place !== null;
    if (!place) return;
    mesh.position.fromArray(place);
    mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3().fromArray(normal));
    mesh.scale.setScalar(radius);
  }
}
