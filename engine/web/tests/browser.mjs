// A headless Chromium, spoken to over a pipe in its own protocol (Chrome DevTools Protocol): no package, no open port.
import { spawn, spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export function findBrowser() {
  const names = [process.env.PALPATE_CHROMIUM, 'chromium', 'chromium-browser', 'google-chrome'].filter(Boolean);
  return names.find((name) => spawnSync(name, ['--version']).status === 0) ?? null;
}

const FLAGS = ['--headless=new', '--remote-debugging-pipe', '--no-first-run', '--no-default-browser-check', '--disable-background-networking',
  '--disable-component-update', '--disable-dev-shm-usage', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--hide-scrollbars',
  '--disable-renderer-backgrounding', '--disable-background-timer-throttling'];

export class Browser {
  static async launch(flags = []) {
    const browser = new Browser();
    browser.profile = mkdtempSync(join(tmpdir(), 'palpate-chromium-'));
    const sandbox = process.getuid?.() === 0 ? ['--no-sandbox'] : [];
    browser.process = spawn(findBrowser(), [...FLAGS, ...sandbox, ...flags, `--user-data-dir=${browser.profile}`, 'about:blank'],
                            { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    browser.waiting = new Map();
    browser.next_id = 1;
    browser.listeners = [];
    let rest = '';
    browser.process.stdio[4].setEncoding('utf8').on('data', (chunk) => {
      const messages = (rest + chunk).split('\0');
      rest = messages.pop();
      messages.forEach((message) => browser.take(JSON.parse(message)));
    });
    await browser.send('Target.setDiscoverTargets', { discover: true });
    return browser;
  }
  take(message) {
    if (message.id === undefined) {
      this.listeners.forEach((listener) => listener(message));
      return;
    }
    const { resolve, reject } = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    if (message.error) reject(new Error(message.error.message));
    else resolve(message.result);
  }
  send(method, params = {}, sessionId = undefined) {
    const id = this.next_id++;
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
  }
  async open(url, { width = 1000, height = 640, touch = false, dark = true } = {}) {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
    const tab = new Tab(this, sessionId, targetId);
    await Promise.all(['Page', 'Runtime', 'Log', 'Network'].map((domain) => tab.send(`${domain}.enable`)));
    await tab.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
    await tab.send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }] });
    if (touch) await tab.send('Emulation.setTouchEmulationEnabled', { enabled: true, maxTouchPoints: 3 });
    await tab.go(url);
    return tab;
  }
  async close() {
    const gone = new Promise((done) => this.process.once('exit', done));
    this.send('Browser.close').catch(() => {});
    const late = setTimeout(() => this.process.kill('SIGKILL'), 5000);
    await gone;
    clearTimeout(late);
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }
}

export const pause = (ms) => new Promise((done) => setTimeout(done, ms));

// What a driver of software GL says of its own speed, on a busy computer: nothing that the page did wrong.
const ADVICE = /GL Driver Message \(OpenGL, Performance,/;

class Tab {
  constructor(browser, session, target) {
    Object.assign(this, { browser, session, target });
    this.complaints = []; // what a console would show in red
    this.requests = [];
    browser.listeners.push((message) => message.sessionId === session && this.hear(message));
  }
  hear({ method, params }) {
    if (method === 'Runtime.exceptionThrown') this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type)) {
      this.complaints.push(params.args.map((a) => a.value ?? a.description).join(' '));
    }
    if (method === 'Log.entryAdded' && ['error', 'warning'].includes(params.entry.level) && !ADVICE.test(params.entry.text)) {
      this.complaints.push(`${params.entry.text} ${params.entry.url ?? ''}`);
    }
    if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
  }
  send(method, params) {
    return this.browser.send(method, params, this.session);
  }
  go(url) {
    return this.send('Page.navigate', { url });
  }
  /// The value of an expression in the page.
  async ask(expression) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }
  close() {
    return this.browser.send('Target.closeTarget', { targetId: this.target });
  }
  async until(expression, seconds = 30) {
    const end = Date.now() + 1000 * seconds;
    for (;;) {
      const value = await this.ask(expression).catch(() => undefined);
      if (value) return value;
      if (Date.now() > end) throw new Error(`never true within ${seconds} s: ${expression}; page says: ${await this.ask('document.body.innerText').catch(() => '?')}`);
      await pause(40);
    }
  }
  async screenshot() {
    const { data } = await this.send('Page.captureScreenshot', { format: 'png' });
    return Buffer.from(data, 'base64');
  }

  // ---- hands

  mouse(type, x, y, more = {}) {
    return this.send('Input.dispatchMouseEvent', { type, x, y, ...more });
  }
  move(x, y, buttons = 0) {
    return this.mouse('mouseMoved', x, y, { buttons });
  }
  async press(x, y, button = 'left') {
    await this.move(x, y);
    await this.mouse('mousePressed', x, y, { button, buttons: button === 'left' ? 1 : 2, clickCount: 1 });
  }
  release(x, y, button = 'left') {
    return this.mouse('mouseReleased', x, y, { button, clickCount: 1 });
  }
  wheel(x, y, notches, buttons = 0) {
    return this.mouse('mouseWheel', x, y, { deltaX: 0, deltaY: 100 * notches, buttons });
  }
  touch(type, points) {
    return this.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  }
  async click(selector) {
    const [x, y] = await this.ask(`(() => { const e = document.querySelector('${selector}'); e.scrollIntoView({block: 'nearest'}); const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()`);
    await this.press(x, y);
    await this.release(x, y);
  }
  async key(key, code = key) {
    const text = key.length === 1 ? key : { Enter: '\r' }[key];
    const codes = { Enter: 13, Tab: 9, Escape: 27, '/': 191, '+': 187, '-': 189, ArrowLeft: 37, ArrowRight: 39, ArrowUp: 38, ArrowDown: 40, PageDown: 34, Backspace: 8, Home: 36 };
    const windowsVirtualKeyCode = codes[key] ?? key.toUpperCase().charCodeAt(0);
    await this.send('Input.dispatchKeyEvent', { type: 'keyDown', key, code, text, windowsVirtualKeyCode });
    await this.send('Input.dispatchKeyEvent', { type: 'keyUp', key, code, windowsVirtualKeyCode });
  }
  keyDown(key, more = {}) {
    return this.send('Input.dispatchKeyEvent', { type: 'keyDown', key, windowsVirtualKeyCode: key.toUpperCase().charCodeAt(0), ...more });
  }
  keyUp(key, more = {}) {
    return this.send('Input.dispatchKeyEvent', { type: 'keyUp', key, windowsVirtualKeyCode: key.toUpperCase().charCodeAt(0), ...more });
  }
  async type(words) {
    await this.send('Input.insertText', { text: words });
  }
  /// A file from this machine into the page's file chooser.
  async choose(selector, files) {
    const { root } = await this.send('DOM.getDocument');
    const { nodeId } = await this.send('DOM.querySelector', { nodeId: root.nodeId, selector });
    await this.send('DOM.setFileInputFiles', { nodeId, files });
  }
  /// Dropped on the page.
  async drop(x, y, files) {
    const data = { items: [], files, dragOperationsMask: 1 };
    for (const type of ['dragEnter', 'dragOver', 'drop']) await this.send('Input.dispatchDragEvent', { type, x, y, data });
  }
}
