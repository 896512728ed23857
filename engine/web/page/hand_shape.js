// The engine's hand, drawn where pictures come quickly: made once, when the page is built (web/first_body.mjs).
//
// File: vertices and triangles (two numbers), pad, its joint's direction and the forearm's (nine floats), places, corners.
import * as THREE from './three.module.min.js';
import { RADIUS_MM, SKIN_COLOUR } from './finger_shape.js';

const FILE = 'hand.bin';
const PULP_MM = 13;
const SLEEVE_FROM_MM = [85, 110]; // from the wrist: between skin and sleeve, softly, as the mesh is coarse there
const HEADER = 8 + 4 * 9;

export function packHand({ positions, corners, held }) {
  const bytes = new ArrayBuffer(HEADER + 4 * positions.length + 2 * corners.length);
  new Uint32Array(bytes, 0, 2).set([positions.length / 3, corners.length / 3]);
  new Float32Array(bytes, 8, 9).set(held);
  new Float32Array(bytes, HEADER, positions.length).set(positions);
  new Uint16Array(bytes, HEADER + 4 * positions.length).set(corners);
  return new Uint8Array(bytes);
}

/// A hand to make meshes of, or null where the file is not there.
export async function fetchHand() {
  const response = await fetch(new URL(FILE, import.meta.url)).catch(() => null);
  if (!response?.ok) return null;
  const bytes = await response.arrayBuffer();
  const [vertices, triangles] = new Uint32Array(bytes, 0, 2);
  const held = [...new Float32Array(bytes, 8, 9)];
  return {
    pad: held.slice(0, 3),
    slope: Math.asin(-held[5]), // of the last joint, against the hand
    forearm: held.slice(6),
    positions: new Float32Array(bytes, HEADER, 3 * vertices),
    corners: new Uint16Array(bytes, HEADER + 12 * vertices, 3 * triangles),
  };
}

/// Skin, and from the forearm on a sleeve of the finger's colour.
function coloursOf({ positions, forearm }, colour) {
  const [skin, sleeve] = [SKIN_COLOUR, colour];
  const colours = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    const along = positions[i] * forearm[0] + positions[i + 1] * forearm[1] + positions[i + 2] * forearm[2];
    colours.set(skin.clone().lerp(sleeve, THREE.MathUtils.smoothstep(along, ...SLEEVE_FROM_MM)).toArray(), i);
  }
  return colours;
}

/// How far the pulp reaches beyond the pad's middle, in a direction of the hand.
function pulpReach({ positions, pad }, down) {
  let reach = 0;
  for (let i = 0; i < positions.length; i += 3) {
    const away = [0, 1, 2].map((axis) => positions[i + axis] - pad[axis]);
    if (Math.hypot(...away) < PULP_MM) reach = Math.max(reach, away.reduce((sum, x, axis) => sum + x * down[axis], 0));
  }
  return reach;
}

/// Held in the frame of makeFinger, its pad on the ball's lowest point when the last joint is so steep, radians.
export function makeHand(hand, colour, left, steepness) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(hand.positions, 3));
  geometry.setAttribute('color', new THREE.BufferAttribute(coloursOf(hand, colour), 3));
  geometry.setIndex(new THREE.BufferAttribute(hand.corners, 1));
  geometry.computeVertexNormals();
  const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ vertexColors: true }));
  // The finger's frame looks along -y of the hand; the skin is below the joint by its steepness.
  const tilt = hand.slope;
  const down = new THREE.Vector3(0, -Math.sin(steepness), -Math.cos(steepness)); // to the skin, in the finger's frame
  const turn = new THREE.Matrix4().makeRotationFromEuler(new THREE.Euler(-tilt, 0, 0)).multiply(new THREE.Matrix4().makeRotationZ(Math.PI));
  const down_in_hand = down.clone().transformDirection(turn.clone().invert());
  const pad = new THREE.Vector3(...hand.pad).applyMatrix4(turn);
  mesh.quaternion.setFromRotationMatrix(turn);
  mesh.position.copy(down).multiplyScalar(RADIUS_MM - pulpReach(hand, down_in_hand.toArray())).sub(pad);
  const group = new THREE.Group();
  group.add(mesh);
  if (left) group.scale.x = -1;
  return group;
}
