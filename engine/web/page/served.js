// A body that is felt by `palpate serve`: contacts come over a WebSocket, and the skin is deformed here. See source.js
// for the interface, docs/reference/serve.md for what goes over the wire.
//
//   address#token=... ─► skin, forms (HTTP) ─► ServedSkin ◄─ frames (WebSocket) ─► page
//   aims of this page, where its token lets it touch ─────────────────────────► server
import { ServedBar } from './served_bar.js';
import { ServedSkin } from './served_skin.js';

const AIM_MS = 16; // between two places of a finger
const ALIVE_MS = 150; // a pressing finger says so often that it is still meant: the server lets go of a silent one
const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 10000;
const SILENT_MS = 5000; // the server says something every second: a network that was cut closes nothing

/// From the address once, then out of it: an address that is shown or copied gives nothing away.
function takeToken() {
  const given = new URLSearchParams(location.hash.slice(1)).get('token');
  if (given) {
    sessionStorage.setItem('palpate-token', given);
    history.replaceState(null, '', location.pathname + location.search);
  }
  return given ?? sessionStorage.getItem('palpate-token');
}

class Refused extends Error {}

class ServedSource {
  constructor() {
    this.can = { open: false, dysfunctions: false, lumps: false, record: false };
    this.frame = () => {};
    this.trouble = () => {};
    this.body = () => {};
    this.away = () => {};
    this.aims = [undefined, undefined]; // of each finger: what the server has to hear
    this.told = [null, null];
    this.told_ms = [0, 0];
    this.wait_ms = FIRST_WAIT_MS;
  }
  onFrame(callback) {
    this.frame = callback;
  }
  onTrouble(callback) {
    this.trouble = callback;
  }
  onBody(callback) {
    this.body = callback;
  }
  onAway(callback) {
    this.away = callback;
  }

  async start() {
    this.token = takeToken();
    if (!this.token) throw new Error('This page shows a body that is served by another computer: open it at the address that the server printed, including #token=.');
    this.bar = new ServedBar((message) => this.say(message), () => this.reconnect());
    this.skin = await ServedSkin.load();
    const body = await this.connect();
    setInterval(() => this.sendAims(), AIM_MS);
    setInterval(() => this.listenForSilence(), 1000);
    requestAnimationFrame(() => this.draw());
    return body;
  }

  // ---- the server

  async fetched(what, signal = undefined) {
    const answer = await fetch(`./served/${what}`, { headers: { Authorization: `Bearer ${this.token}` }, cache: 'no-store', signal });
    if (answer.status === 401) throw new Refused('The server does not know this token: it was restarted with new tokens, or the address is wrong.');
    if (!answer.ok) throw new Error(`the server answered ${answer.status}`);
    return new Uint8Array(await answer.arrayBuffer());
  }

  /// A Body when it is another than before, else null.
  async connect() {
    await this.fetched('state', AbortSignal.timeout(SILENT_MS)); // a WebSocket does not say why it was refused
    const address = new URL('./served/contacts', location.href);
    address.protocol = address.protocol.replace('http', 'ws');
    this.socket = new WebSocket(address, ['palpate.1', `palpate.token.${this.token}`]);
    this.socket.binaryType = 'arraybuffer';
    const hello = await new Promise((resolve, reject) => {
      setTimeout(() => reject(new Error('it does not answer')), SILENT_MS);
      this.socket.onclose = (event) => reject(new Error(event.reason || 'the server is full or not running'));
      this.socket.onmessage = ({ data }) => {
        const message = typeof data === 'string' ? JSON.parse(data) : {};
        if (message.type === 'hello') resolve(message);
      };
    });
    const known = this.hello?.skin === hello.skin;
    this.hello = hello;
    this.newest = this.pads = null;
    this.told = [null, null];
    this.wait_ms = FIRST_WAIT_MS;
    this.heard_ms = performance.now();
    this.away(null);
    this.socket.onmessage = ({ data }) => this.take(data);
    this.socket.onclose = (event) => this.lost(event.reason);
    this.listenToPads(hello.fingers);
    if (known) return null;
    const [skin, forms] = await Promise.all([this.fetched('skin'), this.fetched('forms')]);
    this.skin.open(skin, forms);
    return {
      name: hello.title, closed: hello.closed, notes: [], landmarks: hello.landmarks, stiffness: null, bones: null,
      rest: this.skin.rest(), corners: this.skin.corners(), colours: this.skin.colours(),
    };
  }

  /// Where the scene gives a finger a pad, its pressures are asked for.
  listenToPads(fingers) {
    const padded = fingers.find(({ pad }) => pad > 0);
    if (padded) this.say({ type: 'touch', on: true, pad: padded.pad, pad_mm: padded.pad_mm });
  }
  listenForSilence() {
    if (this.socket?.readyState !== WebSocket.OPEN || performance.now() - this.heard_ms < SILENT_MS) return;
    this.drop();
    this.lost('it does not answer');
  }
  /// The connection ends without a word to anybody.
  drop() {
    if (!this.socket) return;
    this.socket.onclose = this.socket.onmessage = null;
    this.socket.close();
  }
  lost(reason) {
    this.gone(`The connection to the server is lost${reason ? ` (${reason})` : ''}. Trying to reconnect.`);
    // Apart from each other, or a hall of pages comes back in the same moment.
    const wait_ms = this.wait_ms * (0.75 + 0.5 * Math.random());
    this.wait_ms = Math.min(LONGEST_WAIT_MS, 2 * this.wait_ms);
    this.timer = setTimeout(() => this.again(), wait_ms);
  }
  gone(words) {
    this.state = this.newest = this.pads = null;
    this.bar.away(words);
    this.away(words);
  }
  /// The user does not want to wait.
  reconnect() {
    clearTimeout(this.timer);
    this.wait_ms = FIRST_WAIT_MS;
    this.again();
  }
  async again() {
    if (this.connecting) return undefined;
    this.connecting = true;
    try {
      const body = await this.connect();
      if (body) this.body(body);
    } catch (error) {
      this.drop();
      if (!(error instanceof Refused)) return this.lost(error.message);
      this.gone(error.message);
      this.trouble(error.message);
    } finally {
      this.connecting = false;
    }
    return undefined;
  }

  take(data) {
    this.heard_ms = performance.now();
    if (typeof data !== 'string') {
      this.newest = new Uint8Array(data); // older ones are of no use
      return;
    }
    const message = JSON.parse(data);
    if (message.type === 'state') {
      this.state = message;
      this.bar.show(this.hello, message);
    } else if (message.type === 'message') {
      this.bar.tell(message.text);
    } else if (message.type === 'touch') {
      const kpa = message.fingers.map(({ kpa: taxels }, finger) => (this.hello.fingers[finger]?.pad > 0 ? taxels ?? null : null));
      this.pads = { taxels: message.pad, kpa };
    } else if (message.type === 'refused') {
      this.bar.tell(message.why);
    }
  }
  taken() {} // pictures are made when they are drawn
  say(message) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  // ---- the fingers of this page

  tip(finger, aim) {
    this.aims[finger] = aim;
  }
  mayTouch(finger) {
    if (this.hello.role === 'look' || this.hello.fingers[finger]?.device !== '') return false;
    return Boolean(this.state) && (this.state.holder === this.hello.you || this.state.holder === 0);
  }
  sendAims() {
    const now = performance.now();
    this.aims.forEach((aim, finger) => {
      if (aim === undefined || !this.mayTouch(finger)) return;
      const hovers_over_nobodys = this.state.holder === 0 && !aim?.pressed;
      const alive = aim?.pressed && now - this.told_ms[finger] > ALIVE_MS;
      if (hovers_over_nobodys || (aim === this.told[finger] && !alive)) return;
      this.told[finger] = aim;
      this.told_ms[finger] = now;
      this.say(aim ? { type: 'finger', finger, pressed: aim.pressed, place: aim.place, normal: aim.normal, depth_mm: aim.depth } : { type: 'lift', finger });
    });
  }

  // ---- pictures

  draw() {
    requestAnimationFrame(() => this.draw());
    if (!this.newest) return;
    const bytes = this.newest;
    this.newest = null;
    try {
      const { fingers, tick } = this.skin.follow(bytes);
      this.frame({ ...this.skin.pack(), fingers, pads: this.pads, tick: (1000 * tick) / this.hello.ticks_per_s, pace: this.pace() });
    } catch (error) {
      this.socket.onclose = null;
      this.socket.close();
      this.trouble(error.message);
    }
  }
  pace() {
    const servo = this.state?.servo;
    if (!servo) return null;
    return { ticks_per_s: servo.ticks_per_s, late_ms: servo.lateness_us.p99 / 1000, worst_ms: servo.lateness_us.max / 1000, lost: servo.overruns };
  }
}

export function createSource() {
  return new ServedSource();
}
