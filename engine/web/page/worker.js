// The engine at work: a thousand ticks a second, a picture of the skin whenever the page is ready for one.
//
//   page ─ aims ─► (shared memory, or messages) ─► ticks ─► frames ─► page
//
// Where memory can be shared (cross-origin isolation) the worker sleeps in Atomics.wait and wakes nearly to the
// millisecond; elsewhere it is woken by timers, four ticks at a time, which a mouse cannot tell.
import { Engine } from './engine.js';
import { AimReader } from './aims.js';
import { fetchFirstBody } from './first_body.js';
import { PaceMeter } from './pace.js';

const MOST_TICKS = 50; // a wake: late ticks are caught up with, but never so many that the next wake is late too
const GIVE_UP_MS = 500; // later than that (a laptop that slept), ticks are left out and counted as lost
const AWAKE_MS = 12; // in a row, before messages are read
const FRAME_MS = 15; // a little less than a sixtieth of a second
const TAXELS = 8; // along a side of the pads that are shown

let engine = null;
let aims = null;
let running = false;
let credits = 0; // frames that the page is ready for
let sleep_on = null; // shared, or null
let due_ms = 0; // when the next tick is due
let last_frame_ms = 0;
let ticks = 0;
let first_read = false; // the trunk, but not opened
let has_lumps = false;
const pace = new PaceMeter();
const yielding = new MessageChannel();
let turn_comes = false;
function turn() {
  turn_comes = false;
  work();
}
yielding.port1.onmessage = turn;

function tickUntil(now) {
  const late = now - due_ms;
  if (late < 0) return;
  if (late > GIVE_UP_MS) {
    pace.lose(Math.floor(late));
    due_ms += Math.floor(late);
  }
  const count = Math.min(MOST_TICKS, Math.floor(now - due_ms) + 1);
  aims.read((finger, aim) => engine.aim(finger, aim));
  engine.run(count);
  pace.add(now, count, now - due_ms);
  ticks += count;
  due_ms += count;
}

function sendFrame(now) {
  if (credits === 0 || now - last_frame_ms < FRAME_MS) return;
  last_frame_ms = now;
  --credits;
  const { ranges, values } = engine.frame();
  const fingers = [engine.felt(0), engine.felt(1)];
  const kpa = has_lumps ? [0, 1].map((finger) => (fingers[finger].touch === 0 ? null : engine.pad(finger, TAXELS))) : null;
  const pads = kpa && { taxels: TAXELS, kpa };
  const message = { frame: { ranges, values, fingers, pads, tick: ticks, pace: pace.report(now) } };
  postMessage(message, [ranges.buffer, values.buffer]);
}

function work() {
  if (!running) return;
  const start = performance.now();
  let now = start;
  do {
    tickUntil(now);
    sendFrame(now);
    if (!sleep_on) break;
    const rest = due_ms - performance.now();
    if (rest > 0.05) Atomics.wait(sleep_on, 0, 0, rest);
    now = performance.now();
  } while (now - start < AWAKE_MS);
  turn_comes = true;
  if (sleep_on) yielding.port2.postMessage(0);
  else setTimeout(turn, 0);
}

function begin() {
  running = true;
  due_ms = performance.now();
  last_frame_ms = 0;
  pace.begin(due_ms);
  if (!turn_comes) work();
}

const tasks = {
  async load({ shared }) {
    sleep_on = shared ? new Int32Array(new SharedArrayBuffer(4)) : null;
    aims = new AimReader(shared);
    engine = await Engine.load();
  },
  /// Loads the engine and the trunk side by side: the trunk, to be looked at while openFirst prepares it.
  async loadFirst({ shared }) {
    const [bytes] = await Promise.all([fetchFirstBody(), tasks.load({ shared })]);
    first_read = true;
    return engine.readReady(bytes);
  },
  async openFirst() {
    if (!first_read) engine.readReady(await fetchFirstBody());
    first_read = false;
    engine.openReady();
    has_lumps = false;
    return engine.body();
  },
  /// The trunk as it was made, with the lumps of the preset.
  async openLumps() {
    await tasks.openFirst();
    engine.setLumps(true);
    has_lumps = true;
    return engine.body();
  },
  openMesh({ bytes, name, unit_mm }) {
    has_lumps = false;
    engine.openMesh(new Uint8Array(bytes), name, unit_mm);
    return engine.body();
  },
  setDysfunctions({ list }) {
    engine.setDysfunctions(list);
    return engine.stiffness();
  },
  record: () => engine.record(),
};

onmessage = async ({ data }) => {
  if (data.aim !== undefined) return aims?.take(data.finger, data.aim);
  if (data.ready) {
    credits += data.ready;
    return undefined;
  }
  running = false; // a task takes its time; ticks are not counted as late for it
  try {
    const result = await tasks[data.task](data);
    postMessage({ id: data.id, result });
  } catch (error) {
    // A trap leaves the engine in no state to go on: the page then starts another worker.
    const fatal = error instanceof WebAssembly.RuntimeError;
    postMessage({ id: data.id, error: fatal ? `the engine stopped: ${error.message}` : error.message, fatal });
    if (fatal) return close();
  }
  if (engine && !data.task.startsWith('load')) begin();
  return undefined;
};
