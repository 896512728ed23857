// The page: asks whether the browser can, begins, and ties the parts together.
//
//   gestures, keys, headset ─► Fingers ─► source ─ frames ─► Picture, plot, words
//                                           ▲
//                         files, game ──────┘ bodies, hidden places
import { Announcer } from './announcer.js';
import { chooseSource } from './source.js';
import { Files } from './files.js';
import { Find } from './find.js';
import { Fingers } from './fingers.js';
import { Game } from './game.js';
import { Gestures } from './gestures.js';
import { Headset } from './headset.js';
import { Hint } from './hint.js';
import { Legend } from './legend.js';
import { Names } from './names.js';
import { Notebook, notebookToken } from './notebook.js';
import { Pads } from './pads.js';
import { Picture } from './picture.js';
import { Plot } from './plot.js';
import { inWords } from './places.js';
import { keysOf, listen } from './keys.js';
import { missingHere, wordsFor } from './support.js';
import { TouchEvents } from './touch_events.js';

const element = (id) => document.getElementById(id);
const FLIGHT_MS = 700;
const CLOSE_MM = 450; // from the eye to a place that is looked at
const FOUND_MM = 12; // radius of the ring round it
const SIDES = ['Left', 'Right'];

class Page {
  constructor(source) {
    this.source = source;
    this.picture = new Picture(element('picture'));
    this.camera = this.picture.orbit;
    this.fingers = new Fingers(source);
    this.plot = new Plot(element('plot'));
    this.names = new Names(element('names'));
    this.legend = new Legend();
    this.pads = new Pads(element('pads'));
    this.announcer = new Announcer(element('events'));
    this.hint = new Hint(element('hint'), element('picture'));
    this.touches = new TouchEvents({
      contact: (finger) => this.announcer.say(`${SIDES[finger]} finger in contact${this.placeOf(finger, ' at ')}`),
      lifted: (finger, most) => this.announcer.say(`${SIDES[finger]} finger lifted; largest force ${most.toFixed(1)} newtons`),
    });
    this.find = new Find({ form: element('find'), input: element('find-words'), says: element('find-says'), near: element('find-near') },
                         { go: (place) => this.goTo(place), leave: () => element('picture').focus() });
    this.frames = [];
    const pick = (x, y) => this.picture.pick(x, y);
    this.gestures = new Gestures(element('picture'), this.camera, this.fingers, {
      pick,
      click: (hit) => this.game.click(hit),
    });
    this.game = new Game({
      words: element('game-words'), start: element('game-start'), mark: element('game-mark'), answer: element('game-answer'), end: element('game-end'),
    }, source, {
      ring: (...ring) => {
        this.picture.fingers.showRing(...ring);
        this.picture.stale = true;
      },
      stiffness: (values) => this.picture.skin.setStiffness(values),
      colouring: (name, locked) => this.colour(name, locked),
      skinAt: (x, y) => this.picture.skinAt(x, y),
      fail: (words) => this.fail(words),
      announce: (words) => this.announcer.say(words),
      feel: () => element('picture').focus(),
    });
    this.files = new Files({ open: element('open'), file: element('file'), unit: element('unit'), export: element('export'), drop: element('drop') }, {
      open: (name, bytes, unit_mm) => this.open(name, bytes, unit_mm),
      record: () => source.record(),
      fail: (words) => this.fail(words),
    });
    this.headset = new Headset(element('headset'), this.picture.renderer, this.picture.world, {
      pick: (origin, direction) => this.picture.picker.pick(origin, direction),
      middle: () => this.picture.middle,
      fingers: this.fingers,
      resize: () => this.picture.resize(),
      fail: (words) => this.fail(words),
    });
    this.connect();
    listen(keysOf(this), element('keys'), element('picture'));
  }

  connect() {
    const on = (id, name, act) => element(id).addEventListener(name, act);
    on('message-away', 'click', () => this.closeMessage());
    on('colouring', 'change', () => this.colour(element('colouring').value));
    on('bones', 'change', () => this.picture.showBones(element('bones').checked));
    on('places', 'change', () => {
      this.names.show(element('places').checked);
    });
    on('wanted-depth', 'input', () => this.setDepth(Number(element('wanted-depth').value)));
    on('deeper', 'change', () => {
      this.fingers.deepens = element('deeper').checked;
    });
    [0, 1].forEach((finger) => on(`finger-${finger}`, 'click', () => this.fingers.choose(finger)));
    on('hold', 'click', () => this.toggleHold());
    on('turn', 'click', () => this.toggleTurn());
    on('read-out', 'click', () => this.readOut());
    on('whole', 'click', () => this.camera.home());
    on('next-view', 'click', () => this.camera.nextView());
    on('first-body', 'click', () => this.changeBody(() => this.source.firstBody(), false));
    on('lumps', 'click', () => this.changeBody(() => this.source.lumps(), true));
    on('give-up', 'click', () => this.giveUp());
    on('panel-button', 'click', () => this.showPanel(document.body.classList.contains('narrow')));
    this.fingers.changed = () => this.showFingers();
    const can = this.source.can;
    element('open').disabled = !can.open;
    element('export').disabled = !can.record;
    element('lumps').hidden = !can.lumps;
    this.source.onFrame((frame) => this.frames.push(frame));
    this.source.onTrouble((words) => this.fail(words));
    this.source.onBody((body) => this.setBody(body));
    this.source.onAway?.((words) => this.away(words));
  }

  async start() {
    this.wait('Building the body …');
    const preview = await this.source.preview?.();
    const starting = this.source.start();
    starting.catch(() => {}); // awaited below
    if (preview) this.lookAt(preview);
    this.setBody(await starting);
    this.wait(null);
    this.picture.chooseHand();
    this.picture.renderer.setAnimationLoop((now) => this.pass(now));
  }
  /// A body that cannot be felt yet.
  lookAt(body) {
    this.picture.setBody(body);
    this.picture.draw(performance.now());
    document.body.dataset.state = 'pictured';
    this.picture.renderer.setAnimationLoop((now) => this.picture.draw(now));
  }
  setBody(body) {
    this.body = body;
    this.takeFrames(); // those of the old body
    [0, 1].forEach((finger) => this.fingers.leave(finger));
    this.picture.setBody(body);
    this.names.setBody(body);
    this.names.show(element('places').checked);
    this.find.setBody(body);
    for (const ring of ['mark', 'truth', 'found']) this.picture.fingers.showRing(ring, null);
    this.colour('plain');
    element('bones').disabled = !body.bones;
    element('places').disabled = body.landmarks.length === 0;
    element('bones').checked = element('bones').checked && Boolean(body.bones);
    this.picture.showBones(element('bones').checked);
    element('notes').replaceChildren(...[body.name, ...body.notes].map((words) => {
      const item = document.createElement('li');
      item.textContent = words;
      return item;
    }));
    this.game.setBody(body);
  }

  // ---- one picture

  takeFrames() {
    const frames = this.frames;
    this.frames = [];
    if (frames.length > 0) this.source.taken(frames.length);
    return frames;
  }
  pass(now) {
    const seconds = Math.min(0.1, (now - (this.before ?? now)) / 1000);
    this.before = now;
    this.fingers.pass(seconds);
    this.headset.follow();
    const frames = this.takeFrames();
    for (const frame of frames) {
      this.picture.take(frame);
      this.plot.add(frame.fingers.map(({ force }) => Math.hypot(...force)), frame.tick);
    }
    const newest = frames.at(-1);
    this.notebook?.take(frames);
    if (newest) this.felt(newest.fingers, now);
    this.picture.draw(now);
    this.names.draw(this.camera);
    if (!newest) return;
    this.newest = newest;
    this.showFelt(newest.fingers);
    this.pads.show(newest.pads ?? null);
    if (now - (this.plotted ?? 0) > 45) {
      this.plotted = now;
      this.plot.draw();
      this.showPace(newest.pace);
      this.showPlace();
    }
    if (document.body.dataset.state !== 'ready') document.body.dataset.state = 'ready';
  }
  showFelt(felt) {
    const finger = felt[this.fingers.active];
    element('force').textContent = `${Math.hypot(...finger.force).toFixed(2)} N`;
    element('depth').textContent = finger.touch === 0 ? 'no contact' : `${finger.depth.toFixed(1)} mm deep, ${finger.touch === 2 ? 'slips' : 'sticks'}`;
  }
  /// Events of touch: for the game's clock, and in words for those who do not see them.
  felt(fingers, now) {
    this.touches.take(fingers, now);
    if (fingers.every(({ touch }) => touch === 0)) return;
    this.hint.done();
    this.game.touched();
  }
  /// Where a finger is wanted, in words, or '' where it is nowhere.
  placeOf(finger, before = '') {
    const aim = this.fingers.aims[finger];
    const words = aim ? inWords(this.body.landmarks, aim.place) : '';
    return words && before + words;
  }
  showPlace() {
    element('place').textContent = this.placeOf(this.fingers.active);
  }
  /// Asked for: what the readout shows.
  readOut() {
    const felt = this.newest?.fingers[this.fingers.active];
    if (!felt || this.is_away) return this.announcer.now('No connection to the server');
    const touch = felt.touch === 0 ? 'No contact' : `${Math.hypot(...felt.force).toFixed(1)} newtons, ${felt.depth.toFixed(1)} millimetres deep`;
    return this.announcer.now(touch + this.placeOf(this.fingers.active, ', '));
  }
  showPace(pace) {
    if (this.is_away) return;
    const [width, height] = this.picture.pixels();
    const fps = this.picture.quality.fps; // 0: not measured yet
    const ticks = pace ? `${pace.ticks_per_s.toFixed(0)} ticks/s, late ${pace.late_ms.toFixed(1)} ms (p99)${pace.lost > 0 ? `, ${pace.lost} lost` : ''}` : '';
    const pictures = fps > 0 ? `${fps.toFixed(0)} pictures/s at ${width} x ${height}` : '';
    element('pace').textContent = [ticks, pictures, `${this.body.corners.length / 3} triangles`].filter(Boolean).join(' · ');
  }
  /// Whoever feels the body is out of reach (words), or back (null): nothing old may look like news.
  away(words) {
    const was_away = Boolean(this.is_away);
    this.is_away = words !== null;
    element('pace').classList.toggle('lost', this.is_away);
    if (this.is_away) {
      element('pace').textContent = words;
      element('force').textContent = '–';
      element('depth').textContent = 'no server';
      this.pads.show(null);
    }
    if (was_away !== this.is_away) this.announcer.say(this.is_away ? 'The connection to the server is lost' : 'Connected to the server again');
  }
  showFingers() {
    const { active, aims, held } = this.fingers;
    [0, 1].forEach((finger) => element(`finger-${finger}`).setAttribute('aria-pressed', String(finger === active)));
    element('hold').setAttribute('aria-pressed', String(held[active]));
    const depth = aims[active]?.pressed ? aims[active].depth : this.fingers.depth;
    element('wanted-depth').value = depth;
    element('wanted-depth').setAttribute('aria-valuetext', `${depth.toFixed(1)} millimetres`);
    element('wanted-depth-words').textContent = `${depth.toFixed(1)} mm`;
  }

  // ---- requests

  setDepth(mm) {
    const finger = this.fingers.active;
    const aim = this.fingers.aims[finger];
    this.fingers.deeper(finger, mm - (aim?.pressed ? aim.depth : this.fingers.depth));
  }
  /// `locked`: the stiffness is not to be seen.
  colour(name, locked = this.game?.state === 'playing') {
    this.colouring = locked && name === 'stiffness' ? 'plain' : name;
    const select = element('colouring');
    select.value = this.colouring;
    select.querySelector('[value=stiffness]').disabled = locked;
    this.picture.skin.setColouring(this.colouring);
    this.picture.stale = true;
    this.legend.show(this.colouring, this.body.colours[this.colouring], this.picture.skin.range(this.colouring));
  }
  toggleColour(name) {
    this.colour(this.colouring === name ? 'plain' : name);
  }
  toggle(id) {
    if (!element(id).disabled) element(id).click();
  }
  toggleTurn() {
    this.gestures.turning = !this.gestures.turning;
    element('turn').setAttribute('aria-pressed', String(this.gestures.turning));
  }
  /// By the keys: the active finger along the picture's right and up; from the middle of the body where it is nowhere.
  moveOnSkin(right_mm, up_mm) {
    const finger = this.fingers.active;
    const aim = this.fingers.aims[finger];
    const from = aim?.place ?? this.picture.pick(0, 0)?.place;
    if (!from) return;
    const [right, up, back] = this.camera.axes();
    const origin = from.map((x, axis) => x + right_mm * right[axis] + up_mm * up[axis] + 400 * back[axis]);
    const hit = this.picture.picker.pick(origin, back.map((x) => -x));
    if (!hit) return;
    if (aim) this.fingers.move(finger, hit);
    else this.fingers.hover(finger, hit);
  }
  /// The active finger is somewhere on the skin: in the middle of the picture where it was nowhere.
  putFinger() {
    if (!this.fingers.aims[this.fingers.active]) this.moveOnSkin(0, 0);
    return this.fingers.aims[this.fingers.active];
  }
  toggleHold() {
    if (this.putFinger()) this.fingers.toggleHold(this.fingers.active);
  }
  pressHere() {
    const aim = this.putFinger();
    this.pressed_by_key = this.fingers.active;
    if (aim) this.fingers.press(this.pressed_by_key, aim);
  }
  liftHere() {
    this.fingers.lift(this.pressed_by_key);
  }
  turning() {
    return this.gestures.turning;
  }
  look(right_px, up_px, shifts) {
    if (shifts) this.camera.shift(right_px, -up_px, element('picture').clientHeight);
    else this.camera.turn(right_px, -up_px);
  }
  flyTo({ place, normal }) {
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.camera.flyTo(place, normal, Math.min(CLOSE_MM, this.camera.fitting()), still ? 0 : FLIGHT_MS);
  }
  lookHere() {
    const aim = this.fingers.aims[this.fingers.active];
    if (aim) this.flyTo(aim);
  }
  /// A place that was found in words: seen, marked, and under the finger.
  goTo({ name, at, normal }) {
    const from = at.map((x, axis) => x + 200 * normal[axis]);
    const hit = this.picture.picker.pick(from, normal.map((x) => -x)) ?? { place: at, normal };
    this.picture.fingers.showRing('found', hit.place, hit.normal, FOUND_MM);
    this.picture.stale = true;
    this.flyTo(hit);
    this.fingers.leave(this.fingers.active);
    this.fingers.hover(this.fingers.active, hit);
    this.announcer.now(`At ${name}`);
    element('picture').focus();
  }
  showPanel(on) {
    document.body.classList.toggle('narrow', !on);
    element('panel-button').setAttribute('aria-expanded', String(on));
  }
  search() {
    this.showPanel(true);
    element('find-words').focus();
    element('find-words').select();
  }
  escape() {
    this.closeMessage();
    this.game.setMarking(false);
  }
  closeMessage() {
    const had_focus = element('message').contains(document.activeElement);
    element('message').hidden = true;
    if (had_focus) element('picture').focus();
  }
  markHere() {
    const aim = this.fingers.aims[this.fingers.active];
    if (!aim || this.game.state !== 'playing') return;
    this.game.setMarking(true);
    this.game.click(aim);
  }

  // ---- bodies

  async open(name, bytes, unit_mm) {
    this.wait(`Reading ${name} …`, true);
    let given_up = false;
    try {
      this.setBody(await this.source.open(name, bytes, unit_mm));
      element('first-body').hidden = false;
      element('message').hidden = true;
    } catch (error) {
      given_up = error.given_up;
      if (given_up) return; // giveUp goes on, and says so
      if (error.fatal) this.setBody(await this.source.restart());
      throw error;
    } finally {
      if (!given_up) this.wait(null);
    }
  }
  /// `other`: it is not the first one.
  async changeBody(make, other) {
    this.wait('Building the body …');
    try {
      this.setBody(await make());
      element('first-body').hidden = !other;
    } catch (error) {
      this.fail(error.message);
    }
    this.wait(null);
  }
  async giveUp() {
    this.wait('Restoring the previous body …');
    try {
      this.setBody(await this.source.restart());
    } catch (error) {
      this.fail(error.message);
    }
    this.wait(null);
  }

  // ---- words

  wait(words, can_give_up = false) {
    element('waiting').hidden = words === null;
    element('give-up').hidden = !can_give_up;
    if (words !== null) element('waiting-words').textContent = words;
  }
  fail(words) {
    element('message').hidden = false;
    element('message-words').textContent = words;
  }
}

async function begin() {
  const missing = missingHere();
  if (missing.length > 0) throw new Error(wordsFor(missing));
  const page = new Page(await chooseSource());
  globalThis.palpate = page; // for the browser's console, and the tests
  await page.start();
  const token = notebookToken();
  if (token) {
    page.notebook = new Notebook(page, token);
    page.notebook.run();
  }
}

begin().catch((error) => {
  element('waiting').hidden = true;
  element('message').hidden = false;
  element('message-words').textContent = error.message;
  document.body.dataset.state = 'failed';
});
