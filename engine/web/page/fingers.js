// What the page wants of its two fingers: where, how deep, pressed or hovering, kept or let go. Gestures and keys change
// it, the source is told.

export const MOST_DEPTH = 20;
const STILL_S = 0.7; // held so long without moving, a press begins to go deeper
const DEEPER_MM_PER_S = 3;

export class Fingers {
  constructor(source) {
    this.source = source;
    this.aims = [null, null];
    this.held = [false, false];
    this.still_s = [0, 0];
    this.active = 0;
    this.depth = 6; // of a new press
    this.deepens = true;
    this.changed = () => {};
  }

  tell(finger) {
    this.source.tip(finger, this.aims[finger]);
    this.changed();
  }
  choose(finger) {
    this.active = finger;
    this.changed();
  }

  hover(finger, hit) {
    if (this.aims[finger]?.pressed) return;
    this.aims[finger] = hit ? { place: hit.place, normal: hit.normal, depth: this.depth, pressed: false } : null;
    this.tell(finger);
  }
  press(finger, hit) {
    this.aims[finger] = { place: hit.place, normal: hit.normal, depth: this.depth, pressed: true };
    this.still_s[finger] = 0;
    this.tell(finger);
  }
  /// Along the skin, as deep as it is.
  move(finger, hit) {
    const aim = this.aims[finger];
    if (!aim || !hit) return;
    this.aims[finger] = { ...aim, place: hit.place, normal: hit.normal };
    this.still_s[finger] = 0;
    this.tell(finger);
  }
  /// The button was let go: it stays where it is kept, hovers otherwise.
  release(finger) {
    const aim = this.aims[finger];
    if (!aim || this.held[finger]) return;
    this.aims[finger] = { ...aim, pressed: false };
    this.tell(finger);
  }
  lift(finger) {
    this.held[finger] = false;
    this.release(finger);
    this.changed();
  }
  leave(finger) {
    this.held[finger] = false;
    this.aims[finger] = null;
    this.tell(finger);
  }
  toggleHold(finger) {
    const aim = this.aims[finger];
    if (this.held[finger]) {
      this.held[finger] = false;
      this.release(finger);
    } else if (aim) {
      this.held[finger] = true;
      this.aims[finger] = { ...aim, pressed: true };
    }
    this.tell(finger);
  }
  deeper(finger, mm) {
    const aim = this.aims[finger];
    const depth = Math.max(0.5, Math.min(MOST_DEPTH, (aim?.pressed ? aim.depth : this.depth) + mm));
    if (aim?.pressed) this.aims[finger] = { ...aim, depth };
    else this.depth = depth;
    this.tell(finger);
  }

  /// Time passes: a press that is held still goes deeper. Kept fingers stay as they are.
  pass(seconds) {
    this.aims.forEach((aim, finger) => {
      if (!aim?.pressed || this.held[finger] || !this.deepens) return;
      this.still_s[finger] += seconds;
      if (this.still_s[finger] > STILL_S && aim.depth < MOST_DEPTH) {
        this.aims[finger] = { ...aim, depth: Math.min(MOST_DEPTH, aim.depth + DEEPER_MM_PER_S * seconds) };
        this.tell(finger);
      }
    });
  }
}
