// Both eyes, where the browser has WebXR: the body at true size before the viewer, touched by the ray of a controller.
import * as THREE from './three.module.min.js';

const BEFORE_M = 0.55;
const HEIGHT_M = 1.15;

export class Headset {
  /// `world`: the group of everything in mm. `hooks`: pick(origin, direction), fingers, fail(words).
  constructor(button, renderer, world, hooks) {
    Object.assign(this, { button, renderer, world, hooks, session: null });
    button.addEventListener('click', () => this.toggle());
    navigator.xr?.isSessionSupported('immersive-vr').then((yes) => {
      button.hidden = !yes;
    }, () => {});
  }

  async toggle() {
    if (this.session) return this.session.end();
    try {
      this.session = await navigator.xr.requestSession('immersive-vr', { optionalFeatures: ['local-floor'] });
    } catch (error) {
      return this.hooks.fail(`the headset: ${error.message}`);
    }
    this.session.addEventListener('end', () => this.ended());
    this.renderer.xr.enabled = true;
    await this.renderer.xr.setSession(this.session);
    this.world.scale.setScalar(0.001);
    const middle = this.hooks.middle();
    this.world.position.set(-middle[0] / 1000, HEIGHT_M - middle[1] / 1000, -BEFORE_M - middle[2] / 1000);
    this.controllers = [0, 1].map((index) => this.controller(index));
    return undefined;
  }
  ended() {
    this.session = null;
    this.renderer.xr.enabled = false;
    this.world.scale.setScalar(1);
    this.world.position.set(0, 0, 0);
    [0, 1].forEach((finger) => this.hooks.fingers.leave(finger));
    this.hooks.resize();
  }

  /// One for each hand, or a finger that looks at the skin.
  controller(index) {
    const controller = this.renderer.xr.getController(index);
    controller.userData.pressed = false;
    controller.addEventListener('selectstart', () => {
      const hit = this.rayOf(controller);
      if (hit) this.hooks.fingers.press(index, hit);
      controller.userData.pressed = Boolean(hit);
    });
    controller.addEventListener('selectend', () => {
      controller.userData.pressed = false;
      this.hooks.fingers.release(index);
    });
    return controller;
  }
  rayOf(controller) {
    const turn = new THREE.Matrix4().extractRotation(controller.matrixWorld);
    const direction = new THREE.Vector3(0, 0, -1).applyMatrix4(turn).toArray();
    const origin = new THREE.Vector3().setFromMatrixPosition(controller.matrixWorld).sub(this.world.position).multiplyScalar(1000);
    return this.hooks.pick(origin.toArray(), direction);
  }
  /// Before a picture: fingers follow their controllers.
  follow() {
    if (!this.session) return;
    this.controllers?.forEach((controller, finger) => {
      const hit = this.rayOf(controller);
      if (controller.userData.pressed) this.hooks.fingers.move(finger, hit);
      else this.hooks.fingers.hover(finger, hit);
    });
  }
}
