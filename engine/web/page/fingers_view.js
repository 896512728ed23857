// The fingers or hands, what they feel as an arrow, and the rings round places.
import * as THREE from './three.module.min.js';
import { makeFinger, RADIUS_MM } from './finger_shape.js';
import { makeHand } from './hand_shape.js';

// As they are shown: the picture is written without a curve (picture.js), so nothing is to be taken for sRGB.
const shown = (hex) => new THREE.Color().setHex(hex, THREE.LinearSRGBColorSpace);
export const FINGER_COLOURS = [0x4f9bff, 0xff6b5e].map(shown);
const STEEPNESS = 0.8; // radians, of the last joint against the skin
const ASIDE = 0.45; // each comes from its own side
const MM_PER_N = 9;

/// Seen through the finger that it would be hidden by.
function arrow(colour) {
  const material = new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
  const shaft = new THREE.Mesh(new THREE.CylinderGeometry(1.1, 1.1, 1, 12).translate(0, 0.5, 0), material);
  const head = new THREE.Mesh(new THREE.ConeGeometry(3, 7, 16).translate(0, 3.5, 0), material);
  shaft.renderOrder = head.renderOrder = 6;
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

/// How a finger is held whose ball touches skin of this normal: its tip towards the head, from its own side.
function heldOn(normal, left) {
  const up = new THREE.Vector3(...normal);
  const along = (axis) => axis.addScaledVector(up, -axis.dot(up));
  const cranial = along(new THREE.Vector3(0, 1, 0));
  if (cranial.length() < 0.1) along(cranial.set(0, 0, 1));
  cranial.normalize();
  const aside = left ? ASIDE : -ASIDE;
  const heading = cranial.clone().multiplyScalar(Math.cos(aside)).addScaledVector(cranial.clone().cross(up), Math.sin(aside));
  const y = up.clone().multiplyScalar(Math.sin(STEEPNESS)).addScaledVector(heading, -Math.cos(STEEPNESS));
  const z = up.clone().multiplyScalar(Math.cos(STEEPNESS)).addScaledVector(heading, Math.sin(STEEPNESS));
  return new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().makeBasis(y.clone().cross(z), y, z));
}

export class FingersView {
  /// `normalAt(place)`: of the skin at rest near a place, for a finger that hovers.
  constructor(normalAt) {
    this.normalAt = normalAt;
    this.group = new THREE.Group();
    this.fingers = FINGER_COLOURS.map((colour) => {
      const held = new THREE.Group();
      const shapes = { finger: makeFinger(colour), hand: null };
      held.add(shapes.finger);
      const force = arrow(shown(0xffd34d));
      held.visible = force.group.visible = false;
      this.group.add(held, force.group);
      return { held, shapes, force };
    });
    this.found = ring(shown(0xffd34d)); // what was searched for
    this.group.add(this.found);
    this.mark = ring(0xffffff); // where the player thinks it is
    this.truth = ring(shown(0x57e39a)); // where it is
    this.group.add(this.mark, this.truth);
  }

  /// From now on there are hands to show.
  setHand(hand) {
    this.fingers.forEach(({ held, shapes }, i) => {
      shapes.hand = makeHand(hand, FINGER_COLOURS[i], i === 0, STEEPNESS);
      held.add(shapes.hand);
    });
  }
  /// 'hand' where there is one, else 'finger'.
  showAs(wanted) {
    for (const { shapes } of this.fingers) {
      const hand = wanted === 'hand' && shapes.hand !== null;
      shapes.finger.visible = !hand;
      if (shapes.hand) shapes.hand.visible = hand;
    }
  }

  /// `felt`: fingers of a frame.
  take(felt) {
    felt.forEach((finger, i) => {
      const { held, force } = this.fingers[i];
      const here = finger.tip.every((x) => Math.abs(x) < 1e4); // farther is nowhere
      held.visible = here;
      if (here) {
        held.position.fromArray(finger.tip);
        const normal = finger.touch === 0 ? this.normalAt(finger.tip) : finger.normal;
        held.quaternion.copy(heldOn(normal ?? [0, 0, 1], i === 0));
      }
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
