// A page in a cell of a notebook: what is felt goes to the Python that serves it, and Python's requests are done here.
//
//   frames ─► Notebook ── POST notebook/exchange, ten a second ──► palpate.notebook (Python)
//   page   ◄─ requests ◄─────────────── its answer ──────────────
//
// An address with #notebook=TOKEN makes a page one: the part after # goes to no server and no log.
import { placeNamed } from './places.js';

const NEWS_MS = 100; // between two exchanges while something is felt
const QUIET_MS = 300; // while nothing is
const TROUBLE_MS = 2000; // after one that failed
const MOST_ROWS = 20000; // of an exchange that has to wait: five minutes of frames
const FOUND_FROM_MM = 200; // over a place, to look for the skin under it

export function notebookToken(address = location) {
  return new URLSearchParams(address.hash.slice(1)).get('notebook');
}

const row = (tick, finger, { touch, depth, tip, proxy, normal, force }) => [tick, finger, touch, depth, ...tip, ...proxy, ...normal, ...force];

export class Notebook {
  /// `ask(path, options)`: as fetch; `wait(ms)`: a promise. Both are replaced in tests.
  constructor(page, token, ask = (...given) => fetch(...given), wait = (ms) => new Promise((done) => setTimeout(done, ms))) {
    Object.assign(this, { page, ask, wait });
    this.headers = { Authorization: `Bearer ${token}` };
    this.rows = [];
    this.answers = [];
    this.touching = [false, false];
    this.running = true;
  }

  /// Every frame in which a finger touches, and the first in which it does not any more.
  take(frames) {
    for (const { fingers, tick } of frames) {
      fingers.forEach((felt, finger) => {
        const touches = felt.touch !== 0;
        if (touches || this.touching[finger]) this.rows.push(row(tick, finger, felt));
        this.touching[finger] = touches;
      });
    }
    if (this.rows.length > MOST_ROWS) this.rows.splice(0, this.rows.length - MOST_ROWS);
  }

  async run() {
    while (this.running) {
      let rest = QUIET_MS;
      try {
        const had_news = this.rows.length > 0;
        await this.exchange();
        if (had_news || this.answers.length > 0) rest = NEWS_MS;
      } catch {
        rest = TROUBLE_MS; // the kernel was restarted, or is busy: what was felt is kept
      }
      await this.wait(rest);
    }
  }
  /// One there and back. Rejects, and keeps everything, where it is not heard.
  async exchange() {
    const sent = { rows: this.rows.length, answers: this.answers.length };
    const body = JSON.stringify({ body: this.page.body?.name ?? null, rows: this.rows, answers: this.answers });
    const heard = await this.ask('notebook/exchange', { method: 'POST', headers: { ...this.headers, 'Content-Type': 'application/json' }, body });
    if (!heard.ok) {
      if (heard.status === 401 || heard.status === 410) this.running = false; // another kernel's page, or a closed one
      throw new Error(`notebook: ${heard.status}`);
    }
    this.rows.splice(0, sent.rows);
    this.answers.splice(0, sent.answers);
    const { requests } = await heard.json();
    for (const request of requests) this.answers.push(await this.answer(request));
  }

  async answer({ id, name, ...given }) {
    try {
      return { id, result: (await this[`on_${name}`](given)) ?? null };
    } catch (error) {
      return { id, error: error.message };
    }
  }
  placeOf(words) {
    const place = placeNamed(this.page.body.landmarks, words);
    if (!place) throw new Error(`this body has no place ${words}`);
    const from = place.at.map((x, axis) => x + FOUND_FROM_MM * place.normal[axis]);
    const hit = this.page.picture.picker.pick(from, place.normal.map((x) => -x)) ?? { place: place.at, normal: place.normal };
    return { place, hit };
  }

  // ---- what Python may ask for

  on_go({ place }) {
    this.page.goTo(this.placeOf(place).place);
  }
  /// Pressed and kept so: nobody's hand holds it.
  on_press({ place, depth, finger }) {
    const { hit } = this.placeOf(place);
    const { fingers } = this.page;
    fingers.leave(finger);
    fingers.hover(finger, hit);
    fingers.toggleHold(finger);
    fingers.deeper(finger, depth - fingers.aims[finger].depth);
  }
  on_lift({ finger }) {
    this.page.fingers.leave(finger);
  }
  /// {csv, toml} of every tick so far.
  on_record() {
    return this.page.source.record();
  }
  async on_open({ file, unit_mm }) {
    const heard = await this.ask('notebook/mesh', { headers: this.headers });
    if (!heard.ok) throw new Error(`the mesh could not be loaded (HTTP ${heard.status})`);
    await this.page.open(file, await heard.arrayBuffer(), unit_mm);
  }
}
