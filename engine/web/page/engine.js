// The engine's WebAssembly as an object: text, bytes and arrays in and out. Used by the worker, and by the tests in node.
//
// The functions themselves are those of engine/web/engine/*_exports.cpp. Views of the engine's memory are taken afresh for every
// use: memory that grows leaves old views empty.

const encoder = new TextEncoder();
const decoder = new TextDecoder();
export const FLOATS_OF_VERTEX = 7;

export class Engine {
  /// `options` are those of the module that emscripten made; node gives {wasmBinary}.
  static async load(options = {}) {
    const { default: create } = await import('./palpate.mjs');
    return new Engine(await create(options));
  }

  constructor(module) {
    this.module = module;
    this.numbers = module._palpate_take(8 * 256);
  }

  // ---- memory

  text(pointer) {
    const heap = this.module.HEAPU8;
    return decoder.decode(heap.slice(pointer, heap.indexOf(0, pointer)));
  }
  bytes(pointer, count) {
    return this.module.HEAPU8.slice(pointer, pointer + count);
  }
  floats(pointer, count) {
    return this.module.HEAPF32.slice(pointer >> 2, (pointer >> 2) + count);
  }
  whole(pointer, count) {
    return this.module.HEAPU32.slice(pointer >> 2, (pointer >> 2) + count);
  }
  doubles(pointer, count) {
    return this.module.HEAPF64.slice(pointer >> 3, (pointer >> 3) + count);
  }
  put(numbers) {
    this.module.HEAPF64.set(numbers, this.numbers >> 3);
    return this.numbers;
  }

  /// Calls with pointer and length for each of the parts (text or bytes) before `rest`; throws what the engine says.
  withBytes(call, parts, ...rest) {
    const taken = [];
    try {
      const places = parts.flatMap((part) => {
        const bytes = typeof part === 'string' ? encoder.encode(part) : part;
        const pointer = this.module._palpate_take(Math.max(1, bytes.length));
        if (pointer === 0) throw new Error('there is not enough memory in this page; try a smaller mesh');
        taken.push(pointer);
        this.module.HEAPU8.set(bytes, pointer);
        return [pointer, bytes.length];
      });
      this.check(call(...places, ...rest));
    } finally {
      taken.forEach((pointer) => this.module._palpate_give(pointer));
    }
  }
  check(error) {
    if (error !== 0) throw new Error(this.text(error));
  }

  // ---- bodies

  /// The bytes of a trunk that was made ahead: {rest, corners, landmarks}, to be looked at. openReady makes it the body.
  readReady(bytes) {
    const m = this.module;
    this.withBytes(m._palpate_read_ready, [bytes]);
    return {
      rest: this.floats(m._palpate_ready_rest(), FLOATS_OF_VERTEX * m._palpate_ready_vertices()),
      corners: this.whole(m._palpate_ready_corners(), 3 * m._palpate_ready_triangles()),
      landmarks: JSON.parse(this.text(m._palpate_ready_landmarks())),
    };
  }
  openReady() {
    this.check(this.module._palpate_open_ready());
  }
  openMesh(bytes, name, unit_mm) {
    this.withBytes(this.module._palpate_open_mesh, [bytes, name], unit_mm);
  }
  setDysfunctions(list) {
    const numbers = list.flatMap(({ x, y, radius, change }) => [x, y, radius, change]);
    this.check(this.module._palpate_set_dysfunctions(this.put(numbers), list.length));
  }
  /// The lumps of the preset under the skin of the trunk, or none.
  setLumps(on) {
    this.check(this.module._palpate_set_lumps(on ? 1 : 0));
  }
  stiffness() {
    return Float32Array.from(this.doubles(this.module._palpate_stiffness(), this.module._palpate_vertices()));
  }
  /// A Body as source.js has it.
  body() {
    const m = this.module;
    const bone_vertices = m._palpate_bone_vertices();
    const colours = (map) => this.bytes(m._palpate_colours(map), 1024);
    return {
      ...JSON.parse(this.text(m._palpate_about())),
      rest: this.frame(true).values,
      corners: this.whole(m._palpate_triangle_corners(), 3 * m._palpate_triangles()),
      stiffness: this.stiffness(),
      bones: bone_vertices === 0 ? null : {
        positions: this.floats(m._palpate_bone_positions(), 3 * bone_vertices),
        corners: this.whole(m._palpate_bone_triangles(), m._palpate_bone_corners()),
      },
      colours: { stiffness: colours(0), strain: colours(2) },
    };
  }

  // ---- touch

  aim(finger, aim) {
    const { place = [0, 0, 0], normal = [0, 0, 1], depth = 0, pressed = false } = aim ?? {};
    this.module._palpate_aim(finger, aim ? 1 : 0, pressed ? 1 : 0, this.put([...place, ...normal, depth]));
  }
  run(ticks) {
    this.module._palpate_run(ticks);
  }
  felt(finger) {
    const n = this.doubles(this.module._palpate_felt(finger), 15);
    const vector = (i) => [n[i], n[i + 1], n[i + 2]];
    return { tip: vector(0), proxy: vector(3), normal: vector(6), force: vector(9), depth: n[12], touch: n[13], status: n[14] };
  }
  /// Pressures on a fingertip, kPa: taxels x taxels, the first row nearest to the head; null on a body without lumps.
  pad(finger, taxels) {
    const at = this.module._palpate_pad(finger, taxels);
    return at === 0 ? null : Array.from(this.doubles(at, taxels * taxels));
  }
  frame(all = false) {
    const m = this.module;
    const ranges = m._palpate_frame(all ? 1 : 0);
    return {
      ranges: this.whole(m._palpate_frame_ranges(), 2 * ranges),
      values: this.floats(m._palpate_frame_values(), m._palpate_frame_floats()),
    };
  }

  // ---- what was felt, taken along

  record() {
    return { csv: this.text(this.module._palpate_forces_csv()), toml: this.text(this.module._palpate_scene_toml()) };
  }
}
