// The page: asks whether the browser can, begins, and ties the parts together.
//
//   gestures, keys, headset ─► Fingers ─► source ─ frames ─► Picture, plot, words
//                                           ▲
//                         files, game ──────┘ bodies, hidden places
import { chooseSource } from './source.js';
import { Files } from './files.js';
import { Fingers } from './fingers.js';
import { Game } from './game.js';
import { Gestures } from './gestures.js';
import { Headset } from './headset.js';
import { Legend } from './legend.js';
import { Names } from './names.js';
import { Picture } from './picture.js';
import { Plot } from './plot.js';
import { keysOf, listen } from './keys.js';
import { missingHere, wordsFor } from './support.js';

const element = (id) => document.getElementById(id);

class Page {
  constructor(source) {
    this.source = source;
    this.picture = new Picture(element('picture'));
    this.camera = this.picture.orbit;
    this.fingers = new Fingers(source);
    this.plot = new Plot(element('plot'));
    this.names = new Names(element('names'));
    this.legend = new Legend();
    this.frames = [];
    const pick = (x, y) => this.picture.pick(x, y);
    this.gestures = new Gestures(element('picture'), this.camera, this.fingers, {
      pick,
      click: (hit) => {
        element('hint').classList.add('gone');
        return this.game.click(hit);
      },
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
    on('message-away', 'click', () => {
      element('message').hidden = true;
    });
    on('colouring', 'change', () => this.colour(element('colouring').value));
    on('bones', 'change', () => this.picture.showBones(element('bones').checked));
    on('places', 'change', () => {
      this.names.show(element('places').checked);
    });
    on('wanted-depth', 'input', () => this.wishDepth(Number(element('wanted-depth').value)));
    on('deeper', 'change', () => {
      this.fingers.deepens = element('deeper').checked;
    });
    [0, 1].forEach((finger) => on(`finger-${finger}`, 'click', () => this.fingers.choose(finger)));
    on('hold', 'click', () => this.fingers.toggleHold(this.fingers.active));
    on('turn', 'click', () => this.toggleTurn());
    on('whole', 'click', () => this.camera.home());
    on('next-view', 'click', () => this.camera.nextView());
    on('first-body', 'click', () => this.backToFirst());
    on('give-up', 'click', () => this.giveUp());
    on('panel-button', 'click', () => {
      const narrow = document.body.classList.toggle('narrow');
      element('panel-button').setAttribute('aria-expanded', String(!narrow));
    });
    this.fingers.changed = () => this.showFingers();
    const can = this.source.can;
    element('open').disabled = !can.open;
    element('export').disabled = !can.record;
    this.source.onFrame((frame) => this.frames.push(frame));
    this.source.onTrouble((words) => this.fail(words));
    this.source.onBody((body) => this.setBody(body));
    this.source.onAway?.((words) => this.away(words));
  }

  async start() {
    this.wait('Building the body');
    const starting = this.source.start();
    starting.catch(() => {}); // awaited below
    const preview = await this.source.preview?.();
    if (preview) this.lookAt(preview);
    this.setBody(await starting);
    this.wait(null);
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
    for (const ring of ['mark', 'truth']) this.picture.fingers.showRing(ring, null);
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
    this.picture.draw(now);
    this.names.draw(this.camera);
    if (!newest) return;
    this.newest = newest;
    this.showFelt(newest.fingers);
    if (now - (this.plotted ?? 0) > 45) {
      this.plotted = now;
      this.plot.draw();
      this.showPace(newest.pace);
    }
    if (document.body.dataset.state !== 'ready') document.body.dataset.state = 'ready';
  }
  showFelt(felt) {
    const finger = felt[this.fingers.active];
    element('force').textContent = `${Math.hypot(...finger.force).toFixed(2)} N`;
    element('depth').textContent = finger.touch === 0 ? 'free' : `${finger.depth.toFixed(1)} mm deep, ${finger.touch === 2 ? 'slides' : 'sticks'}`;
  }
  showPace(pace) {
    if (this.is_away) return;
    const [width, height] = this.picture.pixels();
    const fps = this.picture.quality.fps;
    const ticks = pace ? `${pace.ticks_per_s.toFixed(0)} ticks/s, late ${pace.late_ms.toFixed(1)} ms (p99)${pace.lost > 0 ? `, ${pace.lost} lost` : ''}` : '';
    element('pace').textContent = `${ticks} · ${fps.toFixed(0)} pictures/s at ${width} x ${height} · ${this.body.corners.length / 3} triangles`;
  }
  /// Whoever feels the body is out of reach (words), or back (null): nothing old may look like news.
  away(words) {
    this.is_away = words !== null;
    if (!this.is_away) return;
    element('pace').textContent = words;
    element('force').textContent = '–';
    element('depth').textContent = 'no server';
  }
  showFingers() {
    const { active, aims, held } = this.fingers;
    [0, 1].forEach((finger) => element(`finger-${finger}`).setAttribute('aria-pressed', String(finger === active)));
    element('hold').setAttribute('aria-pressed', String(held[active]));
    const depth = aims[active]?.pressed ? aims[active].depth : this.fingers.depth;
    element('wanted-depth').value = depth;
    element('wanted-depth-words').textContent = `${depth.toFixed(1)} mm`;
  }

  // ---- wishes

  wishDepth(mm) {
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
  markHere() {
    const aim = this.fingers.aims[this.fingers.active];
    if (!aim || this.game.state !== 'playing') return;
    this.game.setMarking(true);
    this.game.click(aim);
  }

  // ---- bodies

  async open(name, bytes, unit_mm) {
    this.wait(`Reading ${name}`, true);
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
  async backToFirst() {
    this.wait('Building the body');
    try {
      this.setBody(await this.source.firstBody());
      element('first-body').hidden = true;
    } catch (error) {
      this.fail(error.message);
    }
    this.wait(null);
  }
  async giveUp() {
    this.wait('Putting the old body back');
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
}

begin().catch((error) => {
  element('waiting').hidden = true;
  element('message').hidden = false;
  element('message-words').textContent = error.message;
  document.body.dataset.state = 'failed';
});
