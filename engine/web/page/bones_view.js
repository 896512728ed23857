// The bones as one mesh: seen when the skin is not opaque.
import * as THREE from './three.module.min.js';

export class BonesView {
  constructor(bones) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(bones.positions, 3));
    geometry.setIndex(new THREE.BufferAttribute(bones.corners, 1));
    geometry.computeVertexNormals();
    this.mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: 0xe9dcc3 }));
    this.mesh.visible = false;
    this.mesh.renderOrder = 1;
  }
  dispose() {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
