// When a finger comes into contact and when it is lifted: what is worth a word, out of sixty frames a second.

const LASTING_MS = 300; // a shorter contact, or a shorter pause, is none

export class TouchEvents {
  /// `hooks`: contact(finger), lifted(finger, largest force in N).
  constructor(hooks) {
    this.hooks = hooks;
    this.fingers = [0, 1].map(() => ({ on: false, since_ms: null, most: 0 }));
  }
  /// Fingers of a frame.
  take(felt, now) {
    felt.forEach(({ touch, force }, i) => this.follow(i, touch !== 0, Math.hypot(...force), now));
  }
  follow(i, on, force, now) {
    const finger = this.fingers[i];
    if (on) finger.most = Math.max(finger.most, force);
    if (on === finger.on) {
      finger.since_ms = null;
      return;
    }
    finger.since_ms ??= now;
    if (now - finger.since_ms < LASTING_MS) return;
    finger.on = on;
    finger.since_ms = null;
    if (on) this.hooks.contact(i);
    else this.hooks.lifted(i, finger.most);
    if (!on) finger.most = 0;
  }
}
