// Mouse, touch and pen over the picture: which pointer presses with which finger, and which ones turn, shift and zoom.
//
//   left on the skin presses, beside the body it turns; right turns; middle, or shift and left, shifts; wheel: depth
//   while a finger is down, zoom otherwise. Touch: each finger on the skin presses with its own, beside it one turns and
//   two pinch. The Turn switch makes all of them turn, for bodies that fill the screen.

const TREMBLE_PX = 2; // a hand that holds still moves so much
const MM_A_NOTCH = 0.5;

export class Gestures {
  /// `hooks`: pick(x, y) -> hit or null; click(hit) -> true when it takes the press for itself (a mark is set).
  constructor(canvas, camera, fingers, hooks) {
    Object.assign(this, { canvas, camera, fingers, hooks });
    this.pointers = new Map();
    this.turning = false; // the Turn switch
    const on = (name, handler, options) => canvas.addEventListener(name, handler, options);
    on('pointerdown', (e) => this.down(e));
    on('pointermove', (e) => this.move(e));
    on('pointerup', (e) => this.up(e));
    on('pointercancel', (e) => this.up(e));
    on('pointerleave', (e) => this.left(e));
    on('wheel', (e) => this.wheel(e), { passive: false });
    on('contextmenu', (e) => e.preventDefault());
    addEventListener('blur', () => this.letGo());
  }

  hit(event) {
    const box = this.canvas.getBoundingClientRect();
    return this.hooks.pick(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
  }
  pressing() {
    return [...this.pointers.values()].filter((p) => p.finger !== undefined);
  }
  looking() {
    return [...this.pointers.values()].filter((p) => p.finger === undefined);
  }

  down(event) {
    this.canvas.classList.add('by-pointer'); // no frame round it for those who see where they press
    this.canvas.focus({ preventScroll: true });
    if (event.pointerType === 'mouse' && this.pointers.has(event.pointerId)) return; // a second button
    event.preventDefault();
    this.canvas.setPointerCapture(event.pointerId);
    const pointer = { x: event.clientX, y: event.clientY, still: [event.clientX, event.clientY] };
    const plain = event.button === 0 && !event.ctrlKey && !event.shiftKey && !event.altKey && !this.turning;
    const hit = plain ? this.hit(event) : null;
    if (hit && this.hooks.click(hit)) return;
    if (hit) {
      pointer.finger = this.freeFinger();
      if (pointer.finger !== undefined) this.fingers.press(pointer.finger, hit);
    } else {
      pointer.shifts = event.button === 1 || event.shiftKey;
    }
    this.pointers.set(event.pointerId, pointer);
  }
  /// The one that was chosen, or, for a second touch, the other.
  freeFinger() {
    const taken = this.pressing().map((p) => p.finger);
    return [this.fingers.active, 1 - this.fingers.active].find((finger) => !taken.includes(finger));
  }

  move(event) {
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) {
      if (event.pointerType !== 'touch' && !this.turning) this.fingers.hover(this.fingers.active, this.hit(event));
      return;
    }
    const [dx, dy] = [event.clientX - pointer.x, event.clientY - pointer.y];
    if (pointer.finger !== undefined) {
      if (Math.hypot(event.clientX - pointer.still[0], event.clientY - pointer.still[1]) < TREMBLE_PX) return;
      pointer.still = [event.clientX, event.clientY];
      this.fingers.move(pointer.finger, this.hit(event));
    } else if (this.looking().length >= 2) {
      this.pinch(pointer, event, dx, dy);
    } else if (pointer.shifts) {
      this.camera.shift(dx, dy, this.canvas.clientHeight);
    } else {
      this.camera.turn(dx, dy);
    }
    [pointer.x, pointer.y] = [event.clientX, event.clientY];
  }
  pinch(pointer, event, dx, dy) {
    const other = this.looking().find((p) => p !== pointer);
    const before = Math.hypot(pointer.x - other.x, pointer.y - other.y);
    const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
    if (before > 10 && after > 10) this.camera.zoom(before / after);
    this.camera.shift(dx / 2, dy / 2, this.canvas.clientHeight);
  }

  up(event) {
    const pointer = this.pointers.get(event.pointerId);
    this.pointers.delete(event.pointerId);
    if (pointer?.finger === undefined) return;
    this.fingers.release(pointer.finger);
    if (event.pointerType === 'touch' && !this.fingers.held[pointer.finger]) this.fingers.leave(pointer.finger);
  }
  left(event) {
    if (!this.pointers.has(event.pointerId)) this.fingers.hover(this.fingers.active, null);
  }
  letGo() {
    for (const pointer of this.pressing()) this.fingers.release(pointer.finger);
    this.pointers.clear();
  }

  wheel(event) {
    event.preventDefault();
    const notches = Math.max(-3, Math.min(3, event.deltaY / (event.deltaMode === 0 ? 100 : 3)));
    const down = this.pressing()[0]?.finger;
    if (down !== undefined) this.fingers.deeper(down, -notches * (event.shiftKey ? 0.1 : MM_A_NOTCH));
    else this.camera.zoom(1.1 ** notches);
  }
}
