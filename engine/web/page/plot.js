// The force of both fingers over the last ten seconds, as a strip that moves to the left.

const SECONDS = 10;
const RATE = 60;
const ROOM = SECONDS * RATE;

export class Plot {
  constructor(canvas) {
    this.canvas = canvas;
    // Drawn by the processor, a strip so small costs nothing; where the processor plays graphics card it costs more than
    // the body (docs/howto/web.md).
    this.context = canvas.getContext('2d', { willReadFrequently: true });
    this.forces = [new Float32Array(ROOM), new Float32Array(ROOM)];
    this.next = 0;
    this.last_tick = 0;
  }
  colours() {
    const style = getComputedStyle(document.documentElement);
    return ['--accent', '--other', '--line', '--quiet'].map((name) => style.getPropertyValue(name).trim());
  }
  /// One frame; frames that are missing are filled, so that time goes evenly.
  add(forces, tick) {
    const steps = Math.max(1, Math.min(ROOM, Math.round(((tick - this.last_tick) * RATE) / 1000)));
    this.last_tick = tick;
    for (let i = 0; i < steps; ++i) {
      this.forces.forEach((row, finger) => {
        row[this.next] = forces[finger] ?? 0;
      });
      this.next = (this.next + 1) % ROOM;
    }
  }
  draw() {
    const { canvas, context } = this;
    const ratio = devicePixelRatio;
    const width = Math.round(canvas.clientWidth * ratio);
    const height = Math.round(canvas.clientHeight * ratio);
    if (width === 0) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const [left, right, line, quiet] = this.colours();
    const most = Math.max(2, ...this.forces.map((row) => row.reduce((a, b) => Math.max(a, b), 0)));
    const top = [2, 4, 6, 8, 10, 15, 20, 30, 40, 60, 100].find((n) => n >= most) ?? most;
    context.clearRect(0, 0, width, height);
    context.font = `${10 * ratio}px system-ui, sans-serif`;
    context.lineWidth = ratio;
    const y = (force) => height - 3 * ratio - (force / top) * (height - 8 * ratio);
    context.strokeStyle = line;
    context.fillStyle = quiet;
    for (const force of [top / 2, top]) {
      context.beginPath();
      context.moveTo(0, y(force));
      context.lineTo(width, y(force));
      context.stroke();
      context.fillText(`${force} N`, 3 * ratio, y(force) + 11 * ratio);
    }
    this.forces.forEach((row, finger) => {
      context.strokeStyle = finger === 0 ? left : right;
      context.lineWidth = 1.6 * ratio;
      context.beginPath();
      for (let i = 0; i < ROOM; ++i) context.lineTo((i / (ROOM - 1)) * width, y(row[(this.next + i) % ROOM]));
      context.stroke();
    });
  }
}
