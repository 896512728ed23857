// What node.js and browser.js have in common: the page's engine, with the trunk that comes with the package.
import { Engine } from './site/engine.js';

export class Palpate extends Engine {
  /// `module`: of palpate.mjs. `trunk`: gives the bytes of the trunk that was made ahead.
  constructor(module, trunk) {
    super(module);
    this.trunk = trunk;
  }
  /// Opens the trunk, a closed body from neck to thighs over its bones. Gives what can be drawn and named of it.
  async openTrunk() {
    this.readReady(await this.trunk());
    this.openReady();
    return this.body();
  }
  /// {name, at, normal} of a place of the open body, by its spoken name ("T6", "left PSIS").
  place(name) {
    const about = JSON.parse(this.text(this.module._palpate_about()));
    const found = about.landmarks.find((landmark) => landmark.name === name);
    if (!found) throw new Error(`${name}: this body has no such place`);
    return found;
  }
}
