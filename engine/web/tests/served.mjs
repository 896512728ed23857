// web.served: pages of a real browser on a real `palpate serve`: one presses, another looks on, one instructs.
//
//   node --test engine/web/tests/served.mjs          SITE in PALPATE_SITE (build/web/site), the command in PALPATE_COMMAND
//                                             (build/release/palpate), pictures in PALPATE_PICTURES (build/web/pictures)
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { chmodSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import test, { after, before } from 'node:test';
import { Browser, pause } from './browser.mjs';

const site = resolve(process.env.PALPATE_SITE ?? 'build/web/site');
const command = resolve(process.env.PALPATE_COMMAND ?? 'build/release/palpate');
const drawn = resolve(process.env.PALPATE_PICTURES ?? 'build/web/pictures');
const MIDDLE = [360, 300];

let browser, other, server, address, tokens;

async function started(port = 0, more = []) {
  const token_file = join(drawn, `tokens-${process.pid}${more.length ? more[0].replace(/\W/g, '') : ''}.json`);
  const child = spawn(command, ['serve', '--port', String(port), '--json', '--site', site, '--token-file', token_file, ...more],
                      { stdio: ['ignore', 'pipe', 'ignore'] });
  const line = await new Promise((done, fail) => {
    let text = '';
    child.stdout.setEncoding('utf8').on('data', (chunk) => {
      text += chunk;
      if (text.includes('\n')) done(text.slice(0, text.indexOf('\n')));
    });
    child.once('exit', () => fail(new Error('the command ended')));
  });
  return { child, ...JSON.parse(line) };
}
const ended = (child) => new Promise((done) => {
  child.once('exit', done);
  child.kill('SIGTERM');
});

before(async () => {
  mkdirSync(drawn, { recursive: true });
  server = await started();
  address = server.address;
  tokens = JSON.parse(readFileSync(server.token_file, 'utf8'));
  // A page that is hidden is slowed down, and its finger let go: whoever presses has a browser of his own.
  [browser, other] = await Promise.all([Browser.launch(), Browser.launch()]);
});
after(async () => {
  await Promise.all([browser?.close(), other?.close()]);
  await ended(server.child);
});

async function opened(role, where = browser) {
  const tab = await where.open(`${address}/#token=${tokens[role]}`);
  await tab.until("document.body.dataset.state === 'ready'");
  return tab;
}
const pressing = (tab) => tab.until('Math.hypot(...palpate.newest.fingers[0].force) > 0.5', 15);
const free = (tab) => tab.until('palpate.newest.fingers[0].touch === 0', 15);
const says = (tab, words) => tab.until(`document.querySelector('#served').innerText.includes(${JSON.stringify(words)})`, 15);

test('one page presses, another sees it, and who instructs halts it', { timeout: 240000 }, async () => {
  const hand = await opened('control', other);
  await hand.press(...MIDDLE);
  await pressing(hand);
  await says(hand, 'You control the finger');
  assert.equal(await hand.ask('location.hash'), '', 'the token stays in the address');
  assert.equal(await hand.ask('crossOriginIsolated'), true);
  writeFileSync(join(drawn, 'served_hand.png'), await hand.screenshot());

  const watcher = await opened('look');
  await pressing(watcher);
  await says(watcher, 'Someone else controls the finger');
  assert.ok(await watcher.ask('document.querySelector("#served-take").hidden'));
  writeFileSync(join(drawn, 'served_watcher.png'), await watcher.screenshot());

  const teacher = await opened('instruct');
  await teacher.click('#served-pause');
  await says(watcher, 'touch is paused');
  await free(teacher); // the watcher's page is hidden behind it: a browser draws it no more
  await teacher.ask("(() => { const e = document.querySelector('#served-text'); e.value = '<b>softer</b>'; e.dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter'})); })()");
  await says(watcher, '<b>softer</b>');
  for (const tab of [hand, watcher, teacher]) assert.deepEqual(tab.complaints, []);
  await hand.release(...MIDDLE); // or it would have the finger again after the next start of the server
  await hand.close();
});

test('where the scene has a pad, its pressures are drawn beside the picture with their scale', { timeout: 240000 }, async () => {
  const scene = join(drawn, `pad-${process.pid}.toml`);
  writeFileSync(scene, '[[lump]]\nat = "T9 right 30 mm"\ndepth_mm = 5\nstiffness_ratio = 15\n[[finger]]\nname = "index"\nradius_mm = 8\npad = 8\nscript = [{ do = "press" }]\n');
  const padded = await started(0, [scene]);
  const own = await Browser.launch();
  try {
    const { control } = JSON.parse(readFileSync(padded.token_file, 'utf8'));
    const hand = await own.open(`${padded.address}/#token=${control}`);
    await hand.until("document.body.dataset.state === 'ready'");
    await hand.press(...MIDDLE);
    await pressing(hand);
    await hand.until('palpate.newest.pads?.kpa[0]?.some((kpa) => kpa > 5)', 15);
    assert.deepEqual(await hand.ask('palpate.newest.pads.kpa.map((kpa) => kpa?.length ?? null)'), [64, null]);
    assert.match(await hand.ask("document.querySelector('#pads').innerText"), /Left finger: \d+ kPa[^]*0 kPa/);
    assert.equal(await hand.ask("document.querySelector('#pads').hidden"), false);
    writeFileSync(join(drawn, 'served_pad.png'), await hand.screenshot());
    assert.deepEqual(hand.complaints, []);
  } finally {
    await own.close();
    await ended(padded.child);
    rmSync(scene);
  }
});

test('a page says that the server is gone, and comes back when it does', { timeout: 240000 }, async () => {
  const tab = await opened('look');
  const { port } = server;
  await ended(server.child);
  await says(tab, 'Trying to reconnect');
  assert.match(await tab.ask("document.getElementById('pace').textContent"), /^The connection to the server is lost/);
  assert.equal(await tab.ask("document.getElementById('force').textContent"), '–');
  assert.equal(await tab.ask("document.getElementById('served-again').hidden"), false);
  await pause(4000); // it tries less and less often
  server = await started(port);
  await tab.click('#served-again');
  assert.ok(await tab.until("/ticks\\/s/.test(document.getElementById('pace').textContent)", 15));
  assert.equal(await tab.ask("document.getElementById('served-again').hidden"), true);
  await says(tab, 'You are watching');
  const frames = await tab.ask('palpate.newest.tick');
  await tab.until(`palpate.newest.tick !== ${frames}`);
});

test('a server that answers no more is gone too, although nothing was closed', { timeout: 240000 }, async () => {
  const tab = await opened('look');
  server.child.kill('SIGSTOP');
  try {
    await tab.until("/^The connection to the server is lost \\(it does not answer\\)/.test(document.getElementById('pace').textContent)", 20);
  } finally {
    server.child.kill('SIGCONT');
  }
  await tab.until("/ticks\\/s/.test(document.getElementById('pace').textContent)", 30);
});

test('a page that comes to be hidden lifts its finger, and does not knock', { timeout: 240000 }, async () => {
  const watcher = await opened('look');
  const hand = await opened('control', other);
  await hand.press(...MIDDLE);
  await pressing(watcher);
  await other.open('about:blank'); // in front of it
  await free(watcher);
  for (let i = 0; i < 30; ++i) {
    assert.equal(await watcher.ask('palpate.newest.fingers[0].touch'), 0);
    await pause(100);
  }
});

test('a wrong token and none are told in words', { timeout: 120000 }, async () => {
  for (const [end, words] of [['#token=wrong-0123456789abcdef', 'does not know this token'], ['', 'open it at the address']]) {
    const tab = await browser.open(`${address}/${end}`);
    await tab.until("document.body.dataset.state === 'failed'");
    assert.match(await tab.ask("document.querySelector('#message-words').textContent"), new RegExp(words));
    await tab.ask('sessionStorage.clear()');
    await pause(10);
  }
});

test('a page feels over TLS: https for the page, wss for the touch', { timeout: 240000 }, async () => {
  const [key, certificate] = ['key', 'cert'].map((name) => join(drawn, `tls-${process.pid}-${name}.pem`));
  execFileSync('openssl', ['req', '-x509', '-newkey', 'rsa:2048', '-nodes', '-days', '2', '-subj', '/CN=127.0.0.1', '-keyout', key, '-out', certificate],
               { stdio: 'ignore' });
  chmodSync(key, 0o600);
  const secure = await started(0, ['--tls-cert', certificate, '--tls-key', key]);
  const trusting = await Browser.launch(['--ignore-certificate-errors']); // nobody signed this one
  try {
    assert.match(secure.address, /^https:/);
    const { control } = JSON.parse(readFileSync(secure.token_file, 'utf8'));
    const hand = await trusting.open(`${secure.address}/#token=${control}`);
    await hand.until("document.body.dataset.state === 'ready'");
    await hand.press(...MIDDLE);
    await pressing(hand);
    assert.equal(await hand.ask('location.protocol'), 'https:');
    assert.deepEqual(hand.complaints, []);
  } finally {
    await trusting.close();
    await ended(secure.child);
    for (const file of [key, certificate]) rmSync(file);
  }
});
