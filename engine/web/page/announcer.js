// What a screen reader says unasked: politely, seldom, and only events. Numbers that change all the time are read on demand.

const LEAST_APART_MS = 1500;

export class Announcer {
  /// `region`: an element with aria-live="polite".
  constructor(region) {
    this.region = region;
    this.said_ms = -LEAST_APART_MS;
    this.timer = null;
  }
  /// At most one in a while; of several the newest.
  say(words) {
    clearTimeout(this.timer);
    const wait = Math.max(0, this.said_ms + LEAST_APART_MS - performance.now());
    this.timer = setTimeout(() => this.now(words), wait);
  }
  /// Asked for: at once, also when the words are those of before.
  now(words) {
    clearTimeout(this.timer);
    this.said_ms = performance.now();
    const line = document.createElement('span');
    line.textContent = words;
    this.region.replaceChildren(line);
  }
}
