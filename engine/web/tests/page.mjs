// web.page: the page in a real browser, used as a person would: pressed, dragged, turned, played, given files.
//
//   node --test engine/web/tests/page.mjs            SITE in PALPATE_SITE (build/web/site), pictures that were drawn in
//                                             PALPATE_PICTURES (build/web/pictures), the command in PALPATE_COMMAND
//   PALPATE_BLESS=1 node --test ...           keeps what was drawn as what is expected; look at it before
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import test, { after, before } from 'node:test';
import { fileURLToPath } from 'node:url';
import { Browser, pause } from './browser.mjs';
import { plate, stlOf } from './meshes.mjs';
import { decode, difference, pixelsChanged } from './png.mjs';
import { serve } from './server.mjs';

const site = resolve(process.env.PALPATE_SITE ?? 'build/web/site');
const drawn = resolve(process.env.PALPATE_PICTURES ?? 'build/web/pictures');
const expected = join(dirname(fileURLToPath(import.meta.url)), 'pictures');
const STAGE = [0, 0, 719, 600]; // of a window of 1000 x 640: what the panel leaves
const MIDDLE = [360, 300];
const BESIDE = [40, 560];

let browser, isolated, plain, scratch;
before(async () => {
  mkdirSync(drawn, { recursive: true });
  scratch = mkdtempSync(join(tmpdir(), 'palpate-page-'));
  [browser, isolated, plain] = await Promise.all([Browser.launch(), serve(site, { isolated: true }), serve(site, { isolated: false })]);
});
after(async () => {
  await browser?.close();
  isolated?.close();
  plain?.close();
  rmSync(scratch, { recursive: true });
});

let open_tab = null; // one at a time: each of them ticks and draws
async function opened(server = isolated, { path = '', ...options } = {}) {
  if (open_tab) await browser.send('Target.closeTarget', { targetId: open_tab.target });
  // A finger and no hand, however quickly this machine draws.
  const tab = await browser.open(`${server.url}?finger=finger${path}`, options);
  open_tab = tab;
  await tab.until("document.body.dataset.state === 'ready'");
  return tab;
}
const force = (tab, finger = 0) => tab.ask(`Math.hypot(...palpate.newest.fingers[${finger}].force)`);
const untilForce = (tab, finger = 0) => tab.until(`Math.hypot(...palpate.newest.fingers[${finger}].force) > 0.5`, 10);
const untilFree = (tab) => tab.until('palpate.newest.fingers.every(({ force }) => Math.hypot(...force) < 0.01)', 10);

/// `name`: of a picture in engine/web/tests/pictures. Software drawing differs a little between versions of a browser.
async function looksAs(tab, name, box = STAGE) {
  await tab.ask('(() => { const q = palpate.picture.quality; q.change = () => {}; q.step = 0; palpate.picture.resize(); })()'); // all pixels, however slow
  await tab.until("!hint.classList.contains('gone') || getComputedStyle(hint).visibility === 'hidden'", 5);
  await pause(500);
  const picture = await tab.screenshot();
  writeFileSync(join(drawn, `${name}.png`), picture);
  if (process.env.PALPATE_BLESS) writeFileSync(join(expected, `${name}.png`), picture);
  const { mean, share } = difference(decode(picture), decode(readFileSync(join(expected, `${name}.png`))), box);
  assert.ok(mean < 2 && share < 0.01, `${name}: differs by ${mean.toFixed(2)} in the mean, ${(100 * share).toFixed(1)} % of pixels by much`);
}
const quiet = (tab) => assert.deepEqual(tab.complaints, []);

test('the page opens on the back of a trunk, a little turned: no complaint, nothing from elsewhere', async () => {
  const tab = await opened();
  assert.match(await tab.ask('palpate.body.name'), /^built-in trunk/);
  assert.equal(await tab.ask('palpate.body.closed'), true);
  assert.ok(Math.abs(await tab.ask('palpate.camera.yaw')) > 0.2, 'a dent shows its depth from the side');
  const [c7, s1] = await tab.ask("['C7', 'S1'].map((level) => palpate.camera.project(palpate.body.landmarks.find(({ name }) => name === level).at)[1])");
  assert.ok(c7 < 1 && s1 > -1 && c7 - s1 > 1.4, `the back fills the picture: ${c7}, ${s1}`);
  assert.equal(await tab.ask('crossOriginIsolated'), true);
  assert.equal(await tab.ask('document.getElementById("waiting").hidden'), true);
  await looksAs(tab, 'opened');
  assert.ok(tab.requests.every((url) => url.startsWith(isolated.url)), tab.requests.join(' '));
  const before_rest = isolated.asked.length;
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await tab.release(...MIDDLE);
  assert.equal(isolated.asked.length, before_rest, 'asked for more after loading');
  quiet(tab);
});

test('a press is felt and seen, deeper by the wheel, gone when it ends', async () => {
  const tab = await opened();
  await tab.ask('palpate.fingers.deepens = false');
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await pause(400);
  const shallow = await force(tab);
  assert.ok(await tab.ask('/^[1-9]\\d*\\.\\d\\d N$/.test(document.getElementById("force").textContent)'));
  await tab.wheel(...MIDDLE, -3, 1);
  await tab.until(`Math.hypot(...palpate.newest.fingers[0].force) > ${shallow * 1.1}`, 5);
  await pause(300);
  await tab.ask("palpate.colour('strain')");
  await looksAs(tab, 'pressed_strain');
  await tab.release(...MIDDLE);
  await untilFree(tab);
  quiet(tab);
});

test('a press is seen without the finger, from where the page opens', async () => {
  const tab = await opened();
  await looksAs(tab, 'opened'); // all pixels from now on
  await tab.ask('(palpate.picture.fingers.group.visible = false, palpate.fingers.deepens = false, palpate.fingers.depth = 6)');
  const rest = decode(await tab.screenshot());
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await pause(600);
  const pressed = decode(await tab.screenshot());
  const changed = pixelsChanged(rest, pressed, STAGE, 3);
  await tab.release(...MIDDLE);
  assert.ok(changed > 400, `${changed} pixels`);
});

test('force does not step although the pointer does', async () => {
  const tab = await opened();
  await tab.ask('palpate.fingers.deepens = false; palpate.fingers.depth = 8');
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await pause(500);
  for (let i = 0; i < 20; ++i) {
    await tab.move(MIDDLE[0] + 3 * i, MIDDLE[1] + 2 * i, 1);
    await pause(16);
  }
  const { csv } = await tab.ask('palpate.source.record()');
  const rows = csv.trim().split('\n').slice(1).map((line) => line.split(','));
  const pressed = rows.filter((row) => row[1] === 'left');
  const forces = pressed.map((row) => Math.hypot(row[11], row[12], row[13]));
  assert.ok(Math.max(...forces) > 1);
  const steps = forces.slice(1).map((f, i) => Math.abs(f - forces[i]));
  assert.ok(Math.max(...steps) < 0.35, `a step of ${Math.max(...steps)} N in a millisecond`);
  await tab.release(MIDDLE[0] + 57, MIDDLE[1] + 38);
  quiet(tab);
});

test('held still, a press goes deeper', async () => {
  const tab = await opened();
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await tab.until('palpate.newest.fingers[0].depth > 7.5', 30);
  await tab.release(...MIDDLE);
  quiet(tab);
});

test('beside the body and with the right button it turns, and nothing is felt', async () => {
  const tab = await opened();
  const yaw = () => tab.ask('palpate.camera.yaw');
  for (const [[x, y], button] of [[BESIDE, 'left'], [MIDDLE, 'right']]) {
    const start = await yaw();
    await tab.press(x, y, button);
    await tab.move(x + 60, y, button === 'left' ? 1 : 2);
    await tab.release(x + 60, y, button);
    assert.ok(Math.abs((await yaw()) - start) > 0.3);
    assert.ok((await force(tab)) < 0.01);
  }
  const far = await tab.ask('palpate.camera.distance');
  await tab.wheel(...BESIDE, -3);
  await tab.until(`palpate.camera.distance < ${far}`, 5);
  quiet(tab);
});

test('two touches press with two fingers, two beside the body pinch', async () => {
  const tab = await opened(isolated, { touch: true });
  const [left, right] = [[310, 300], [420, 330]];
  await tab.touch('touchStart', [left]);
  await tab.touch('touchStart', [left, right]);
  await untilForce(tab, 0);
  await untilForce(tab, 1);
  await looksAs(tab, 'two_fingers');
  await tab.touch('touchEnd', []);
  await untilFree(tab);
  const far = await tab.ask('palpate.camera.distance');
  await tab.touch('touchStart', [[20, 500]]);
  await tab.touch('touchStart', [[20, 500], [60, 500]]);
  for (let i = 1; i <= 5; ++i) await tab.touch('touchMove', [[20, 500], [60, 500 - 20 * i]]);
  await tab.touch('touchEnd', []);
  assert.ok((await tab.ask('palpate.camera.distance')) < 0.8 * far);
  quiet(tab);
});

test('by the keys alone: a finger is put, kept, moved, made deeper; the other one joins; both are lifted', async () => {
  const tab = await opened();
  await tab.ask('document.getElementById("picture").focus()');
  await tab.key('ArrowUp');
  await tab.key('Enter');
  await untilForce(tab, 0);
  const place = await tab.ask('palpate.fingers.aims[0].place');
  for (let i = 0; i < 6; ++i) await tab.key('ArrowRight');
  assert.ok((await tab.ask('palpate.fingers.aims[0].place'))[0] > place[0] + 8);
  const depth = await tab.ask('palpate.fingers.aims[0].depth');
  await tab.key('PageDown');
  assert.equal(await tab.ask('palpate.fingers.aims[0].depth'), depth + 0.5);
  await tab.key('2', 'Digit2');
  for (let i = 0; i < 20; ++i) await tab.key('ArrowLeft');
  await tab.key('Enter');
  await untilForce(tab, 1);
  assert.ok((await force(tab, 0)) > 0.5, 'the first one stays');
  await tab.key('Backspace');
  await untilFree(tab);
  quiet(tab);
});

test('overlays: stiffness with its legend, bones through the skin, names', async () => {
  const tab = await opened();
  await tab.ask("document.getElementById('colouring').value = 'stiffness'; document.getElementById('colouring').dispatchEvent(new Event('change'))");
  assert.match(await tab.ask('document.getElementById("legend").innerText'), /Stiffness[^]*N\/mm/);
  await looksAs(tab, 'stiffness');
  await tab.ask("palpate.colour('plain')");
  await tab.click('#bones');
  await tab.click('#places');
  await tab.until("[...document.querySelectorAll('#names span')].filter((s) => !s.hidden).length > 10", 5);
  assert.match(await tab.ask('document.getElementById("names").innerText'), /T6/);
  await looksAs(tab, 'bones_and_names');
  quiet(tab);
});

test('light surroundings are readable too', async () => {
  const tab = await opened(isolated, { dark: false });
  await looksAs(tab, 'light', [0, 0, 1000, 600]);
  quiet(tab);
});

test('the game is played to its answer', async () => {
  const tab = await opened(isolated, { path: '&game=7' });
  await tab.until("document.body.dataset.game === 'playing'", 20);
  assert.equal(await tab.ask("document.querySelector('#colouring option[value=stiffness]').disabled"), true);
  await tab.ask("palpate.toggleColour('stiffness')");
  assert.equal(await tab.ask('palpate.colouring'), 'plain', 'the map would tell');
  assert.equal(await tab.ask("document.getElementById('game-answer').disabled"), true);
  // Where it is, as the picture shows it; and the same place on the other side of the spine.
  const at = (x) => tab.ask(`(() => { const h = palpate.game.hidden; const p = palpate.camera.project(palpate.picture.skinAt(${x}, h.y).place); return [(p[0] + 1) / 2 * picture.clientWidth, (1 - p[1]) / 2 * picture.clientHeight]; })()`);
  const [there, mirrored] = [await at('h.x'), await at('-h.x')];
  await tab.ask('palpate.fingers.deepens = false');
  const pressed = [];
  for (const place of [there, mirrored]) {
    await tab.press(...place);
    await untilForce(tab);
    await pause(600);
    pressed.push(await force(tab));
    await tab.release(...place);
    await untilFree(tab);
  }
  assert.ok(pressed[0] > 1.25 * pressed[1], `${pressed} N: the place is stiffer`);
  await tab.click('#game-mark');
  await tab.press(there[0] + 4, there[1]);
  await tab.release(there[0] + 4, there[1]);
  assert.match(await tab.ask("document.getElementById('game-words').textContent"), /Marked at/);
  await tab.click('#game-answer');
  await tab.until("document.body.dataset.game === 'answered'", 5);
  const { points, distance } = await tab.ask('palpate.game.result');
  assert.ok(points > 700 && distance < 15, `${points} points, ${distance} mm`);
  assert.match(await tab.ask("document.getElementById('game-words').textContent"), /\d+ points.*Found.*mm away/);
  assert.equal(await tab.ask('palpate.colouring'), 'stiffness');
  await tab.move(...BESIDE);
  await untilFree(tab);
  await looksAs(tab, 'game_answered');
  quiet(tab);
});

/// By Tab to the control of this id; each one on the way shows that it has the focus.
async function tabTo(tab, id) {
  for (let i = 0; i < 60; ++i) {
    await tab.key('Tab');
    const [at, outline] = await tab.ask("[document.activeElement.id, getComputedStyle(document.activeElement).outlineStyle]");
    assert.notEqual(outline, 'none', `${at} does not show its focus`);
    if (at === id) return;
  }
  assert.fail(`Tab does not come to ${id}`);
}

test('the game is played by the keys alone, and its clock runs', async () => {
  const tab = await opened();
  await tabTo(tab, 'game-start');
  await tab.key('Enter');
  await tab.until("document.body.dataset.game === 'playing' && document.activeElement.id === 'picture'", 20);
  assert.equal(await tab.ask('palpate.game.started'), null);
  await tab.key('Enter');
  await untilForce(tab);
  await tab.until('palpate.game.started !== null', 5);
  const place = await tab.ask('palpate.fingers.aims[0].place');
  for (let i = 0; i < 5; ++i) await tab.key('ArrowLeft');
  assert.ok((await tab.ask('palpate.fingers.aims[0].place'))[0] < place[0] - 6);
  assert.ok((await force(tab)) > 0.5, 'the finger is dragged to the next place');
  await tab.key('x');
  assert.match(await tab.ask("document.getElementById('game-words').textContent"), /Marked at/);
  await tabTo(tab, 'game-answer');
  await tab.key('Enter');
  await tab.until("document.body.dataset.game === 'answered'", 5);
  assert.ok((await tab.ask('palpate.game.result.seconds')) > 0);
  assert.equal(await tab.ask('document.activeElement.id'), 'game-start', 'the focus is where it goes on');
  quiet(tab);
});

test('everything the mouse does is done by the keys: press and let go, turn, shift, zoom, look closely', async () => {
  const tab = await opened();
  await tab.ask("document.getElementById('picture').focus()");
  const camera = () => tab.ask('({ ...palpate.camera, camera: null, middle: null, flight: null, target: palpate.camera.target.toArray() })');
  await tab.keyDown(' ', { text: ' ' });
  await untilForce(tab);
  await tab.keyUp(' ');
  await untilFree(tab);
  const start = await camera();
  await tab.key('t');
  await tab.key('ArrowRight');
  await tab.key('ArrowUp');
  const turned = await camera();
  assert.ok(turned.yaw < start.yaw && turned.pitch < start.pitch, 'as dragging to the right and up');
  await tab.keyDown('ArrowRight', { modifiers: 8 });
  await tab.keyUp('ArrowRight', { modifiers: 8 });
  assert.notDeepEqual((await camera()).target, turned.target);
  await tab.key('t');
  await tab.key('+');
  assert.ok((await camera()).distance < turned.distance);
  await tab.key('-');
  await tab.key('f');
  await tab.until('palpate.camera.flight === null && palpate.camera.distance < 500', 10);
  await tab.key('Home');
  assert.equal((await camera()).distance, await tab.ask('palpate.camera.fitting()'), 'the whole body');
  await tab.key('v');
  assert.notEqual((await camera()).yaw, start.yaw);
  const help = await tab.ask("document.getElementById('keys').textContent");
  for (const words of ['Press while the key is down', 'Turn the body', 'Zoom in', 'Search for a place', 'Read out', 'Lift both fingers']) assert.ok(help.includes(words), words);
  quiet(tab);
});

test('a place is found by its words: flown to, marked, and under the finger; misspelt ones get suggestions', async () => {
  const tab = await opened();
  await tab.ask("document.getElementById('picture').focus()");
  await tab.key('/');
  assert.equal(await tab.ask('document.activeElement.id'), 'find-words');
  await tab.type('t6 right 30');
  await tab.key('Enter');
  await tab.until('palpate.camera.flight === null && palpate.camera.distance < 500', 10);
  const { t6, aim, ring } = await tab.ask(`({ t6: palpate.body.landmarks.find(({ name }) => name === 'T6').at, aim: palpate.fingers.aims[0].place,
    ring: [palpate.picture.fingers.found.visible, ...palpate.picture.fingers.found.position] })`);
  assert.equal(ring[0], true);
  assert.ok(Math.hypot(aim[0] - t6[0] - 30, aim[1] - t6[1]) < 8, `${aim}`);
  await tab.until("/^T\\d+, \\d+ mm right/.test(document.getElementById('place').textContent)", 5);
  await tab.until("document.getElementById('events').textContent === 'At T6 right 30 mm'", 5);
  await tab.key('Enter');
  await untilForce(tab);
  await looksAs(tab, 'found');
  await tab.key('Backspace');
  await tab.until("/lifted/.test(document.getElementById('events').textContent)", 5);
  await tab.key('/');
  await tab.type('lft rib 7 angel');
  await tab.key('Enter');
  const near = await tab.ask("[...document.querySelectorAll('#find-near button')].map((b) => b.textContent)");
  assert.equal(near[0], 'left rib 7 angle');
  assert.ok(near.length <= 3);
  await tab.click('#find-near button');
  await tab.until("document.getElementById('events').textContent === 'At left rib 7 angle'", 5);
  await tab.key('/');
  await tab.type('the moon');
  await tab.key('Enter');
  assert.match(await tab.ask("document.getElementById('find-says').textContent"), /No place here is called “the moon”. Try “T6”/);
  assert.equal(await tab.ask("document.querySelectorAll('#find-near button').length"), 0);
  quiet(tab);
});

test('a name that is typed is completed: both sites 4 are offered, Enter takes the first; the PSIS is found too', async () => {
  const tab = await opened();
  const offered = () => tab.ask("[...document.querySelectorAll('#find-near button')].map((b) => b.textContent)");
  const said = (words) => tab.until(`document.getElementById('events').textContent === ${JSON.stringify(words)}`, 5);
  await tab.ask('palpate.search()');
  await tab.type('site 4');
  assert.deepEqual(await offered(), ['left site 4', 'right site 4']);
  await tab.key('Escape');
  assert.equal(await tab.ask('document.activeElement.id'), 'picture');
  await tab.key('/');
  await tab.type('site 4');
  await tab.key('Enter');
  await said('At left site 4');
  const { t10, aim } = await tab.ask("({ t10: palpate.body.landmarks.find(({ name }) => name === 'T10').at, aim: palpate.fingers.aims[0].place })");
  assert.ok(Math.hypot(aim[0] - t10[0] + 30, aim[1] - t10[1]) < 8, `${aim}`);
  await tab.ask('palpate.search()');
  await tab.type('right site 4');
  assert.deepEqual(await offered(), [], 'it is complete');
  await tab.key('Enter');
  await said('At right site 4');
  await tab.ask('palpate.search()');
  await tab.type('psis');
  assert.deepEqual((await offered()).sort(), ['left PSIS', 'right PSIS']);
  await tab.type(' left');
  await tab.key('Enter');
  await said('At left PSIS');
  await tab.until('palpate.camera.flight === null', 10);
  await tab.key('Enter');
  await untilForce(tab);
  await tab.until("document.getElementById('place').textContent === 'left PSIS'", 5);
  await looksAs(tab, 'left_psis');
  quiet(tab);
});

test('the first sentence says what to do: with a mouse, with the keys, by touch; and goes when it was done', async () => {
  const hint = (tab) => tab.ask("document.getElementById('hint').textContent");
  let tab = await opened();
  assert.equal(await tab.ask("document.body.innerText.split('\\n').find((line) => line.trim() !== '')"), await hint(tab));
  assert.match(await hint(tab), /^Press on the back with the left mouse button/);
  await tab.key('Tab');
  assert.match(await hint(tab), /^Press Enter to put a finger on the back/);
  await tab.key('Enter');
  await tab.until("document.getElementById('hint').classList.contains('gone')", 10);
  tab = await opened(isolated, { touch: true, width: 390, height: 780 });
  assert.match(await hint(tab), /^Press and hold on the back/);
  quiet(tab);
});

test('on a phone every target is at least 44 pixels wide and high', async () => {
  const tab = await opened(isolated, { path: '&game=7', touch: true, width: 390, height: 780 });
  await tab.until("document.body.dataset.game === 'playing'", 20);
  await tab.ask("(palpate.fail('A message'), palpate.find.look('left rib 7 angel'))");
  const small = () => tab.ask(`[...document.querySelectorAll('button, select, input, summary')].filter((e) => e.checkVisibility())
    .map((e) => [e.id || e.textContent, (e.type === 'checkbox' ? e.closest('label') : e).getBoundingClientRect()])
    .filter(([, { width, height }]) => width < 44 || height < 44).map(([name, { width, height }]) => name + ' ' + width + ' x ' + height)`);
  assert.deepEqual(await small(), []);
  assert.ok((await tab.ask("document.querySelectorAll('#find-near button').length")) > 0);
  await tab.ask("document.getElementById('message-away').click()");
  await looksAs(tab, 'phone', [0, 0, 390, 430]);
  await tab.touch('touchStart', [[195, 200]]);
  await tab.until("/right|left|T\\d+/.test(document.getElementById('place').textContent)", 10);
  const beyond = await tab.ask(`['place', 'hint', 'force', 'depth', 'plot', 'find', 'status'].filter((id) => { const e = document.getElementById(id);
    return e.getBoundingClientRect().right > innerWidth || e.scrollWidth > e.clientWidth + 1; })`);
  assert.deepEqual(beyond, [], 'cut at the right');
  await tab.touch('touchEnd', []);
  quiet(tab);
});

test('a screen reader: everything has a name, numbers are read on demand, only events are announced', async () => {
  const tab = await opened();
  const { nodes } = await tab.send('Accessibility.getFullAXTree');
  const named = nodes.filter(({ ignored, role }) => !ignored && ['application', 'button', 'checkbox', 'combobox', 'searchbox', 'slider', 'image'].includes(role?.value));
  assert.ok(named.some(({ role, name }) => role.value === 'application' && name.value === 'Body to palpate'));
  for (const { role, name } of named) assert.ok(name?.value, `a ${role.value} without a name`);
  assert.equal(await tab.ask("['force', 'depth', 'wanted-depth-words', 'place', 'pace'].some((id) => document.getElementById(id).closest('output, [aria-live], [role=status], [role=alert]'))"), false);
  await tab.ask(`(palpate.heard = [], new MutationObserver(() => palpate.heard.push(document.getElementById('events').textContent))
    .observe(document.getElementById('events'), { childList: true }), 0)`);
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await pause(3000);
  await tab.release(...MIDDLE);
  await untilFree(tab);
  await tab.until('palpate.heard.length >= 2', 10);
  const heard = await tab.ask('palpate.heard');
  assert.equal(heard.length, 2, heard.join('; '));
  assert.match(heard[0], /^Left finger in contact at T\d+/);
  assert.match(heard[1], /^Left finger lifted; largest force \d+\.\d newtons/);
  await tab.key('q');
  await tab.until("/^No contact, T\\d+/.test(document.getElementById('events').textContent)", 5);
  quiet(tab);
});

test('a hand presses where pictures come quickly, a finger where they do not', async () => {
  const tab = await opened();
  const shown = () => tab.ask("Object.entries(palpate.picture.fingers.fingers[0].shapes).filter(([, shape]) => shape?.visible).map(([name]) => name)");
  assert.deepEqual(await shown(), ['finger'], 'asked for');
  const brought = await tab.ask(`(async () => { const p = palpate.picture; const was = [p.pictureMs, p.bringHand]; const brought = [];
    p.bringHand = () => brought.push(p.pictureMs()); p.shown_as = null;
    for (const ms of [5, 40]) { p.pictureMs = () => ms; await p.chooseHand(); }
    [p.pictureMs, p.bringHand] = was; return brought; })()`);
  assert.deepEqual(brought, [5], 'only where a picture takes little time');
  assert.ok((await tab.ask('palpate.picture.pictureMs()')) > 0);
  await tab.ask('(palpate.picture.quality.change = () => {}, palpate.picture.quality.step = 0, palpate.fingers.deepens = false, palpate.picture.bringHand())');
  await tab.until('palpate.picture.fingers.fingers[0].shapes.hand !== null', 10);
  assert.deepEqual(await shown(), ['hand']);
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await pause(500);
  await looksAs(tab, 'hand');
  await tab.release(...MIDDLE);
  await tab.ask('(delete palpate.picture.quality.change, palpate.picture.quality.change(performance.now(), 1))');
  assert.deepEqual(await shown(), ['finger']);
  quiet(tab);
});

test('the same seed hides the same place, another seed another one', async () => {
  const tab = await opened();
  const places = await tab.ask(`import('./game.js').then(({ hiddenPlace }) => [7, 7, 8].map((seed) => hiddenPlace(seed, palpate.body.landmarks)))`);
  assert.deepEqual(places[0], places[1]);
  assert.notDeepEqual(places[0], places[2]);
  const scores = await tab.ask(`import('./game.js').then(({ score }) => [score(0, 0), score(0, 1000), score(30, 0), score(200, 0)])`);
  assert.deepEqual(scores, [1000, 700, 350, 0]);
});

test('a mesh of one\'s own, dropped on the page, is felt; and the trunk comes back', async () => {
  const file = join(scratch, 'plate.stl');
  writeFileSync(file, stlOf(plate(24)));
  const tab = await opened();
  await tab.drop(...MIDDLE, [file]);
  await tab.until("!document.getElementById('first-body').hidden", 20);
  assert.match(await tab.ask("document.getElementById('notes').innerText"), /plate\.stl/);
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await looksAs(tab, 'own_plate');
  await tab.release(...MIDDLE);
  await tab.click('#first-body');
  await tab.until('palpate.body.landmarks.length > 0', 20);
  quiet(tab);
});

test('a file that is not a mesh is answered in words, and the touch goes on', async () => {
  const bad = join(scratch, 'letter.obj');
  writeFileSync(bad, 'Dear Sir or Madam');
  const tab = await opened();
  await tab.choose('#file', [bad]);
  await tab.until("!document.getElementById('message').hidden", 10);
  assert.match(await tab.ask("document.getElementById('message-words').textContent"), /^letter\.obj:1: .+/);
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await tab.release(...MIDDLE);
  await tab.click('#message-away');
  assert.equal(await tab.ask("document.getElementById('message').hidden"), true);
  quiet(tab);
});

test('while it is hidden no frames pile up, and it goes on where it was', async () => {
  const tab = await opened();
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await tab.ask('palpate.picture.renderer.setAnimationLoop(null)'); // what a hidden tab comes to
  await pause(1500);
  assert.ok((await tab.ask('palpate.frames.length')) <= 2);
  await tab.ask('(palpate.seen = palpate.newest.tick, palpate.picture.renderer.setAnimationLoop((now) => palpate.pass(now)))');
  await tab.until('palpate.newest.tick > palpate.seen + 1400', 5);
  await tab.release(...MIDDLE);
  await untilFree(tab);
  quiet(tab);
});

test('a mesh that takes too long is given up, and the body before is felt again', async () => {
  const file = join(scratch, 'fine.stl');
  writeFileSync(file, stlOf(plate(550))); // 605,000 triangles: seconds
  const tab = await opened();
  await tab.choose('#file', [file]);
  await tab.until("!document.getElementById('give-up').hidden", 10);
  await tab.ask("document.getElementById('give-up').click()");
  assert.match(await tab.ask("document.getElementById('waiting-words').textContent"), /previous body/);
  await tab.until("document.getElementById('waiting').hidden && palpate.body.landmarks.length > 0", 60);
  assert.equal(await tab.ask("document.getElementById('message').hidden"), true, 'it was wished, so it is not a fault');
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await tab.release(...MIDDLE);
  quiet(tab);
});

test('what was felt is saved as files that palpate reads', async () => {
  const tab = await opened();
  await tab.click('#export');
  assert.match(await tab.until("document.getElementById('message-words').textContent", 5), /nothing was felt yet/);
  await tab.click('#message-away');
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await tab.release(...MIDDLE);
  await untilFree(tab);
  await browser.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: scratch });
  await tab.click('#export');
  const archive = join(scratch, 'palpate-felt.zip');
  for (let i = 0; i < 100 && !existsSync(archive); ++i) await pause(50);
  assert.ok(existsSync(archive), readdirSync(scratch).join());
  const unzipped = spawnSync('unzip', ['-o', '-q', archive, '-d', scratch]);
  if (unzipped.error) return; // no unzip here
  assert.equal(unzipped.status, 0, String(unzipped.stderr));
  const rows = readFileSync(join(scratch, 'forces.csv'), 'utf8').trim().split('\n');
  assert.match(rows[0], /^t_s,finger,tip_x_mm/);
  assert.ok(rows.some((row) => row.includes(',stick,')));
  assert.match(readFileSync(join(scratch, 'scene.toml'), 'utf8'), /kind = "trunk"\ntriangles = 40000/);
  const command = process.env.PALPATE_COMMAND;
  if (!command) return;
  const info = spawnSync(command, ['recording', 'info', join(scratch, 'forces.csv')], { encoding: 'utf8' });
  assert.equal(info.status, 0, info.stderr);
  assert.match(info.stdout, /left/);
});

test('from a server without headers, and in a folder of it, the page works by messages', async () => {
  const tab = await opened(plain);
  assert.equal(await tab.ask('crossOriginIsolated'), false);
  await tab.press(...MIDDLE);
  await untilForce(tab);
  await tab.until('palpate.newest.pace?.ticks_per_s > 900', 20);
  await tab.release(...MIDDLE);
  await untilFree(tab);
  quiet(tab);
});

test('a browser without WebGL is told so', async () => {
  const poor = await Browser.launch(['--disable-3d-apis']);
  try {
    const tab = await poor.open(isolated.url);
    await tab.until("document.body.dataset.state === 'failed'", 20);
    assert.match(await tab.ask("document.getElementById('message-words').textContent"), /lacks[^]*WebGL 2/);
  } finally {
    await poor.close();
  }
});
