// The source of a page that stands by itself: the engine in a worker (worker.js). See source.js for the interface.
import { AIM_BYTES, AimWriter } from './aims.js';
import { bodyToSee } from './first_body.js';

const FIRST_BODY = { task: 'openFirst' };
const LUMPS = { task: 'openLumps' };
const FRAMES_AHEAD = 2;

class LocalSource {
  constructor() {
    this.can = { open: true, dysfunctions: true, lumps: true, record: true };
    this.frame = () => {};
    this.trouble = () => {};
    this.shared = globalThis.crossOriginIsolated ? new SharedArrayBuffer(AIM_BYTES) : null;
    this.opening = FIRST_BODY; // what the worker is told to open when it begins anew
  }

  onFrame(callback) {
    this.frame = callback;
  }
  onTrouble(callback) {
    this.trouble = callback;
  }
  onBody() {} // nobody but this page changes its body

  async preview() {
    return bodyToSee(await this.launch('loadFirst'));
  }
  async start() {
    if (!this.worker) await this.launch('load');
    const body = await this.ask(this.opening);
    this.worker.postMessage({ ready: FRAMES_AHEAD });
    return body;
  }

  tip(finger, aim) {
    if (this.shared) this.writer.write(finger, aim);
    else this.worker?.postMessage({ finger, aim });
  }

  async open(name, bytes, unit_mm) {
    // A copy goes to the worker: should the worker fail, the old body is built anew.
    const opening = { task: 'openMesh', name, bytes, unit_mm };
    const body = await this.ask(opening);
    this.opening = opening;
    return body;
  }
  async firstBody() {
    const body = await this.ask(FIRST_BODY);
    this.opening = FIRST_BODY;
    return body;
  }
  async lumps() {
    const body = await this.ask(LUMPS);
    this.opening = LUMPS;
    return body;
  }
  /// A page that is hidden draws nothing and takes nothing: then the worker keeps its frames to itself.
  taken(frames) {
    const ready = Math.min(frames, this.owed); // not those of a worker that was given up
    this.owed -= ready;
    if (ready > 0) this.worker?.postMessage({ ready });
  }
  setDysfunctions(list) {
    return this.ask({ task: 'setDysfunctions', list });
  }
  record() {
    return this.ask({ task: 'record' });
  }
  /// Gives up whatever the worker is busy with; what was asked rejects. The old body comes back as a new one.
  async restart() {
    const error = new Error('given up');
    error.given_up = true;
    this.fail(error);
    return this.start();
  }

  // ---- the worker

  /// `task`: load, or loadFirst, and what that gives.
  launch(task) {
    this.asked = new Map();
    this.next_id = 1;
    this.owed = 0; // frames that it sent and nobody drew yet
    if (this.shared) this.writer = new AimWriter(this.shared);
    this.worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
    this.worker.onmessage = ({ data }) => this.take(data);
    this.worker.onerror = (event) => {
      const error = new Error(event.message || 'the engine could not be loaded');
      this.fail(error);
      this.trouble(error.message);
    };
    return this.ask({ task, shared: this.shared });
  }
  fail(error) {
    this.worker?.terminate();
    this.worker = null;
    for (const { reject } of this.asked.values()) reject(error);
    this.asked.clear();
  }
  ask(message) {
    if (!this.worker) return Promise.reject(new Error('the engine is not running'));
    const id = this.next_id++;
    this.worker.postMessage({ id, ...message });
    return new Promise((resolve, reject) => this.asked.set(id, { resolve, reject }));
  }
  take(data) {
    if (data.frame) {
      ++this.owed;
      this.frame(data.frame);
      return;
    }
    const { resolve, reject } = this.asked.get(data.id) ?? {};
    this.asked.delete(data.id);
    if (data.error === undefined) return resolve?.(data.result);
    const error = new Error(data.error);
    error.fatal = data.fatal;
    return reject?.(error);
  }
}

export function createSource() {
  return new LocalSource();
}
