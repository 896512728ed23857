// The skin that a server sends, deformed here: engine/web/engine/served_exports.cpp as an object.
import { Engine } from './engine.js';

const COLOURS = { stiffness: 0, strain: 2 };

export class ServedSkin {
  static async load() {
    return new ServedSkin(await Engine.load());
  }
  constructor(engine) {
    this.engine = engine;
    this.module = engine.module;
  }

  /// Bytes as Uint8Array; throws in words.
  open(skin, forms) {
    this.engine.withBytes(this.module._palpate_served_open, [skin, forms]);
  }
  rest() {
    return this.pack(true).values;
  }
  corners() {
    const m = this.module;
    return this.engine.whole(m._palpate_served_corners(), 3 * m._palpate_served_triangles());
  }
  colours() {
    const m = this.module;
    const map = (number) => {
      const at = m._palpate_colours(number);
      return m.HEAPU8.slice(at, at + 1024);
    };
    return Object.fromEntries(Object.entries(COLOURS).map(([name, number]) => [name, map(number)]));
  }

  /// Deforms by a frame; its fingers and its tick.
  follow(bytes) {
    const m = this.module;
    this.engine.withBytes(m._palpate_served_follow, [bytes]);
    const fingers = Array.from({ length: m._palpate_served_fingers() }, (_, finger) => {
      const n = this.engine.doubles(m._palpate_served_felt(finger), 14);
      const vector = (i) => [n[i], n[i + 1], n[i + 2]];
      return { tip: vector(0), proxy: vector(3), normal: vector(6), force: vector(9), depth: n[12], touch: n[13] };
    });
    return { fingers, tick: m._palpate_served_tick() };
  }
  /// What changed, as a frame of source.js has it.
  pack(all = false) {
    const m = this.module;
    const ranges = m._palpate_served_pack(all ? 1 : 0);
    return {
      ranges: this.engine.whole(m._palpate_served_ranges(), 2 * ranges),
      values: this.engine.floats(m._palpate_served_values(), m._palpate_served_floats()),
    };
  }
}

