// Find the dysfunction: a place of the back is stiffer than it should be; feel for it, mark it, see how near it was.
//
// The seed in the address (?game=7) makes the same place for everybody. What is hidden is in the engine's stiffness; the
// page shows it after the answer only.
import { inWords } from './places.js';

export const HIDDEN = { radius: 18, change: 60 };
const LEVELS = ['T4', 'T6', 'T8', 'T10', 'T12', 'L2'];
const BESIDE_MM = 30;
const SCATTER_MM = 10;
const FOR_PLACE = 700; // points: all at the middle, none a hand's breadth away
const NONE_AT_MM = 60;
const FOR_TIME = 300; // all at once, none after three minutes; only for a place that was found
const NONE_AT_S = 180;

/// Numbers in [0, 1) from a seed: mulberry32 (Ettinger, public domain).
function randomOf(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/// Beside the spine, at one of six levels, on one side.
export function hiddenPlace(seed, landmarks) {
  const random = randomOf(seed);
  const level = LEVELS[Math.floor(random() * LEVELS.length)];
  const side = random() < 0.5 ? -1 : 1;
  const spine = landmarks.find(({ name }) => name === level);
  const scatter = () => (2 * random() - 1) * SCATTER_MM;
  return { x: spine.at[0] + side * BESIDE_MM + scatter(), y: spine.at[1] + scatter(), ...HIDDEN };
}

/// Points, 0 to 1000.
export function score(distance_mm, seconds) {
  const place = FOR_PLACE * Math.max(0, 1 - distance_mm / NONE_AT_MM);
  const time = distance_mm <= HIDDEN.radius ? FOR_TIME * Math.max(0, 1 - seconds / NONE_AT_S) : 0;
  return Math.round(place + time);
}

export const canPlay = (body) => LEVELS.every((level) => body.landmarks.some(({ name }) => name === level));

export class Game {
  /// `hooks`: ring(which, place, normal, radius), colouring(name, locked), skinAt(x, y) -> {place, normal} or null,
  /// fail(words), announce(words), feel(): the picture gets the keys.
  constructor(parts, source, hooks) {
    Object.assign(this, { parts, source, hooks, state: 'idle', body: null });
    const seed = new URLSearchParams(location.search).get('game');
    this.seed = /^\d{1,9}$/.test(seed ?? '') ? Number(seed) : null;
    parts.start.addEventListener('click', () => this.begin().then(hooks.feel)); // the button is gone then
    parts.mark.addEventListener('click', () => this.setMarking(!this.marking));
    parts.answer.addEventListener('click', () => this.answer());
    parts.end.addEventListener('click', () => {
      this.end();
      hooks.feel();
    });
  }

  setBody(body) {
    this.body = body;
    this.state = 'idle';
    const playable = this.source.can.dysfunctions && canPlay(body);
    this.parts.start.disabled = !playable;
    this.say(playable ? `One place on the back is ${HIDDEN.change} % stiffer than it should be. Find it by touch and mark it.`
                      : 'The game needs the body that the page opens with.');
    this.show();
    if (this.seed !== null && playable) this.begin();
  }
  say(words) {
    this.parts.words.textContent = words;
  }
  /// For those too who do not see the panel.
  tell(words) {
    this.say(words);
    this.hooks.announce(words);
  }
  show() {
    const playing = this.state === 'playing';
    this.parts.start.hidden = playing;
    this.parts.start.textContent = this.state === 'answered' ? 'Play again' : 'Start';
    this.parts.mark.hidden = this.parts.answer.hidden = this.parts.end.hidden = !playing;
    this.parts.answer.disabled = !this.mark;
    this.parts.mark.setAttribute('aria-pressed', String(Boolean(this.marking)));
    document.body.dataset.game = this.state;
  }

  async begin() {
    if (this.state === 'answered' || this.seed === null) this.seed = Math.floor(Math.random() * 1e6);
    const address = new URL(location.href);
    address.searchParams.set('game', this.seed);
    history.replaceState(null, '', address);
    this.hidden = hiddenPlace(this.seed, this.body.landmarks);
    this.mark = null;
    this.hooks.ring('mark', null);
    this.hooks.ring('truth', null);
    this.hooks.colouring('plain', true);
    try {
      this.stiffness = await this.source.setDysfunctions([this.hidden]);
    } catch (error) {
      return this.hooks.fail(error.message);
    }
    this.state = 'playing';
    this.started = null; // the clock starts with the first contact
    this.setMarking(false);
    this.tell('It is next to the spine, between T4 and L2. Compare left and right, then choose Mark and press on the place (key: X).');
    return undefined;
  }
  end() {
    this.seed = null;
    this.setMarking(false);
    this.source.setDysfunctions([]).then((stiffness) => this.hooks.stiffness(stiffness), (error) => this.hooks.fail(error.message));
    this.state = 'idle';
    this.hooks.ring('mark', null);
    this.hooks.colouring('plain', false);
    this.tell('You gave up. Play again?');
    this.show();
  }

  setMarking(on) {
    this.marking = on;
    this.show();
  }
  /// A finger touches, whatever moved it.
  touched() {
    if (this.state === 'playing') this.started ??= performance.now();
  }
  /// The skin was clicked: true when that was a mark.
  click(hit) {
    if (this.state !== 'playing' || !this.marking) return false;
    this.mark = hit;
    this.hooks.ring('mark', hit.place, hit.normal, 9);
    this.setMarking(false);
    this.tell(`Marked at ${inWords(this.body.landmarks, hit.place)}. Mark another place, or choose Answer.`);
    return true;
  }

  answer() {
    const seconds = (performance.now() - (this.started ?? performance.now())) / 1000;
    const distance = Math.hypot(this.mark.place[0] - this.hidden.x, this.mark.place[1] - this.hidden.y);
    const points = score(distance, seconds);
    this.state = 'answered';
    this.hooks.stiffness(this.stiffness);
    this.hooks.colouring('stiffness', false);
    const skin = this.hooks.skinAt(this.hidden.x, this.hidden.y);
    if (skin) this.hooks.ring('truth', skin.place, skin.normal, HIDDEN.radius);
    const found = distance <= HIDDEN.radius ? 'Found' : 'Not quite';
    const b = document.createElement('b');
    b.textContent = `${points} points. `;
    this.parts.words.replaceChildren(b, `${found}: ${distance.toFixed(0)} mm away after ${seconds.toFixed(0)} s. `
      + `The place was at ${inWords(this.body.landmarks, skin?.place ?? [this.hidden.x, this.hidden.y, 0])}.`);
    this.result = { points, distance, seconds };
    this.show();
    this.parts.start.focus(); // the button that was pressed is gone
    this.hooks.announce(this.parts.words.textContent);
  }
}
