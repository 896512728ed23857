// How many pictures a second there are, and less to draw while there are too few: fewer pixels, a finger for a hand.

const FEW = 29; // pictures a second
const MANY = 55;
const STEPS = [1, 0.75, 0.5, 0.35];

export class Quality {
  /// `apply(share)`: of the pixels of the screen, along a side.
  constructor(apply) {
    this.apply = apply;
    this.step = 0;
    this.fps = 0;
    this.patience_s = 6; // before it is tried with more again; doubles each time that was in vain
    this.begin(0);
  }
  begin(now) {
    this.start = now;
    this.pictures = 0;
    this.drawn = 0;
  }
  /// Whether there is time for what is drawn only because it is beautiful.
  generous() {
    return this.step === 0;
  }
  share() {
    return STEPS[this.step];
  }
  /// The screen asked for a picture at `now`, ms; one was drawn, or nothing was new. Judged is time that was drawn in.
  add(now, drawn) {
    // A page that was hidden has not been slow.
    if (now - (this.last ?? now) > 500) this.begin(now);
    this.last = now;
    ++this.pictures;
    if (drawn) ++this.drawn;
    if (now - this.start < 1500) return;
    this.fps = (1000 * this.pictures) / (now - this.start);
    const busy = this.drawn > 0.8 * this.pictures;
    this.begin(now);
    if (!busy) return;
    if (this.fps < FEW && this.step < STEPS.length - 1) this.change(now, 1);
    else if (this.fps > MANY && this.step > 0 && now - this.changed > 1000 * this.patience_s) this.change(now, -1);
  }
  change(now, by) {
    if (by > 0 && now - (this.raised ?? -1e9) < 10000) this.patience_s *= 2;
    if (by < 0) this.raised = now;
    this.step += by;
    this.changed = now;
    this.apply(this.share());
  }
}
