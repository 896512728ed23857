// How fast and how punctual the ticks are: counts over the last second, lateness as a histogram.

const STEP_MS = 0.1;
const STEPS = 600;

export class PaceMeter {
  constructor() {
    this.histogram = new Uint32Array(STEPS + 1);
    this.all = { ticks: 0, lost: 0, worst_ms: 0, since_ms: 0 };
    this.begin(0);
  }
  begin(now) {
    this.window = { start_ms: now, ticks: 0, wakes: 0, worst_ms: 0 };
    this.histogram.fill(0);
    this.last = null;
  }
  /// A wake at `now` that did so many ticks, the first of them so late.
  add(now, ticks, late_ms) {
    this.window.ticks += ticks;
    ++this.window.wakes;
    this.window.worst_ms = Math.max(this.window.worst_ms, late_ms);
    ++this.histogram[Math.min(STEPS, Math.max(0, Math.floor(late_ms / STEP_MS)))];
    this.all.ticks += ticks;
    this.all.worst_ms = Math.max(this.all.worst_ms, late_ms);
  }
  lose(ticks) {
    this.all.lost += ticks;
  }
  /// Of the last whole second; null in the first.
  report(now) {
    const seconds = (now - this.window.start_ms) / 1000;
    if (seconds >= 1) {
      this.last = {
        ticks_per_s: this.window.ticks / seconds,
        late_ms: this.percentile(0.99),
        worst_ms: this.window.worst_ms,
        wakes_per_s: this.window.wakes / seconds,
        ticks: this.all.ticks,
        lost: this.all.lost,
      };
      this.window = { start_ms: now, ticks: 0, wakes: 0, worst_ms: 0 };
      this.histogram.fill(0);
    }
    return this.last;
  }
  percentile(share) {
    let left = share * this.window.wakes;
    for (let i = 0; i <= STEPS; ++i) {
      left -= this.histogram[i];
      if (left <= 0) return i * STEP_MS;
    }
    return STEPS * STEP_MS;
  }
}
