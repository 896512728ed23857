// Where the fingers are wanted, from the page to the worker: through shared memory that is read before every tick, or,
// where memory cannot be shared, by messages.
//
// Shared: for each finger a count and ten numbers. The writer makes the count odd, writes, makes it even; a reader that
// finds it odd or changed looks again at the next tick.

const NUMBERS = 10; // present, pressed, place, normal, depth, one spare
const FINGERS = 2;
export const AIM_BYTES = FINGERS * (8 + 8 * NUMBERS);

function views(shared) {
  return { counts: new Int32Array(shared, 0, 2 * FINGERS), numbers: new Float64Array(shared, 8 * FINGERS) };
}

export class AimWriter {
  constructor(shared) {
    Object.assign(this, views(shared));
  }
  write(finger, aim) {
    Atomics.add(this.counts, 2 * finger, 1);
    const numbers = aim ? [1, aim.pressed ? 1 : 0, ...aim.place, ...aim.normal, aim.depth] : [0, 0, 0, 0, 0, 0, 0, 1, 0];
    this.numbers.set(numbers, NUMBERS * finger);
    Atomics.add(this.counts, 2 * finger, 1);
  }
}

export class AimReader {
  /// `shared`: of AIM_BYTES, or null.
  constructor(shared) {
    this.shared = shared ? views(shared) : null;
    this.seen = [0, 0];
    this.waiting = [undefined, undefined];
  }
  /// One that came by message.
  take(finger, aim) {
    this.waiting[finger] = aim;
  }
  /// Calls `use` for each finger whose aim is new.
  read(use) {
    for (let finger = 0; finger < FINGERS; ++finger) {
      const aim = this.shared ? this.fromShared(finger) : this.waiting[finger];
      this.waiting[finger] = undefined;
      if (aim !== undefined) use(finger, aim);
    }
  }
  fromShared(finger) {
    const { counts, numbers } = this.shared;
    const count = Atomics.load(counts, 2 * finger);
    if (count === this.seen[finger] || count % 2 !== 0) return undefined;
    const n = numbers.slice(NUMBERS * finger, NUMBERS * (finger + 1));
    if (Atomics.load(counts, 2 * finger) !== count) return undefined;
    this.seen[finger] = count;
    if (n[0] === 0) return null;
    return { pressed: n[1] === 1, place: [n[2], n[3], n[4]], normal: [n[5], n[6], n[7]], depth: n[8] };
  }
}
