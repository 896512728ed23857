// A finger as it is drawn where a hand would take too long: the last two joints of one that presses with its pad.
//
// Frame: origin in the middle of the ball that touches, +y from the tip to the knuckle, +z out of the nail.
import * as THREE from './three.module.min.js';

export const RADIUS_MM = 8; // of the ball that touches: engine/web/engine/live_body.h
export const SKIN_COLOUR = new THREE.Color().setHex(0xd9a283, THREE.LinearSRGBColorSpace); // as it is shown
// Radius, mm, at so far from the middle of the tip: joints are a little thicker than what is between them.
const PROFILE = [[4, 8], [12, 7.9], [20, 8.3], [25, 8.5], [31, 8], [40, 8.2], [48, 9.3], [54, 9.4], [60, 8.8], [68, 8.9]];
const SLEEVE = [[56, 9.2], [56, 10.4], [57, 10.9], [60, 11], [68, 11.3], [75, 11.5], [77, 10.9], [78, 8], [78, 0.01]]; // height, radius
const BENT_FROM_MM = 16;
const BENT_RAD = 0.5;
const BENT_OVER_MM = 14;

function profile() {
  const tip = Array.from({ length: 12 }, (_, i) => (i / 12) * (Math.PI / 2)).map((a) => new THREE.Vector2(RADIUS_MM * Math.sin(a), -RADIUS_MM * Math.cos(a)));
  const curve = new THREE.SplineCurve([[0, RADIUS_MM], ...PROFILE].map(([y, r]) => new THREE.Vector2(r, y)));
  return [...tip, ...curve.getPoints(40), new THREE.Vector2(0.01, PROFILE.at(-1)[0])];
}

/// Bent towards the pad at the last joint, as a finger that presses is.
function bend(geometry) {
  const at = geometry.getAttribute('position');
  for (let i = 0; i < at.count; ++i) {
    const beyond = at.getY(i) - BENT_FROM_MM;
    if (beyond <= 0) continue;
    const arc = Math.min(beyond, BENT_OVER_MM);
    const angle = (BENT_RAD * arc) / BENT_OVER_MM;
    const radius = BENT_OVER_MM / BENT_RAD;
    const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
    const rest = beyond - arc;
    const z = at.getZ(i);
    at.setXYZ(i, at.getX(i), BENT_FROM_MM + radius * sin + rest * cos - z * sin, radius * (1 - cos) + rest * sin + z * cos);
  }
  geometry.computeVertexNormals();
}

/// `colour`: of nail and sleeve, by which left and right are told from each other.
export function makeFinger(colour) {
  const skin = new THREE.MeshLambertMaterial({ color: SKIN_COLOUR });
  const own = new THREE.MeshLambertMaterial({ color: colour });
  const body = new THREE.LatheGeometry(profile(), 32);
  bend(body);
  const sleeve = new THREE.LatheGeometry(SLEEVE.map(([y, r]) => new THREE.Vector2(r, y)), 32);
  bend(sleeve);
  const nail = new THREE.SphereGeometry(1, 24, 16).scale(5.2, 6.8, 2).translate(0, 0.5, 6.9);
  const group = new THREE.Group();
  group.add(new THREE.Mesh(body, skin), new THREE.Mesh(sleeve, own), new THREE.Mesh(nail, own));
  return group;
}
