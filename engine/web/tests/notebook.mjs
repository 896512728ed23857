// web.notebook: what a page in a notebook's cell tells Python, and what Python may ask of it.
//
//   node --test engine/web/tests/notebook.mjs
import assert from 'node:assert/strict';
import test from 'node:test';
import { Fingers } from '../../web/page/fingers.js';
import { Notebook, notebookToken } from '../../web/page/notebook.js';

const felt = (touch, force = 0) => ({ touch, depth: 1.5, tip: [1, 2, 3], proxy: [4, 5, 6], normal: [0, 0, 1], force: [0, 0, force] });
const frame = (tick, left, right = felt(0)) => ({ tick, fingers: [left, right] });

/// A page whose skin is the plane z = 0, with one place.
function pageOfAPlane() {
  const told = [];
  const page = {
    told,
    body: { name: 'plane', landmarks: [{ name: 'T6', at: [10, 20, 0], normal: [0, 0, 1] }] },
    picture: { picker: { pick: ([x, y]) => ({ place: [x, y, 0], normal: [0, 0, 1] }) } },
    source: { tip: (finger, aim) => told.push([finger, aim]), record: async () => ({ csv: 't_s\n', toml: '' }) },
    opened: [],
    open: async (name, bytes, unit_mm) => page.opened.push([name, bytes.byteLength, unit_mm]),
    goTo: ({ name }) => { page.went = name; },
  };
  page.fingers = new Fingers(page.source);
  return page;
}

/// Python: `requests` of each exchange in turn; what it was told is in `heard`.
function python(...requests) {
  const heard = [];
  const ask = async (path, { method, headers, body } = {}) => {
    if (path === 'notebook/mesh') return { ok: true, arrayBuffer: async () => new ArrayBuffer(12) };
    heard.push({ path, method, token: headers.Authorization, ...JSON.parse(body) });
    return { ok: true, json: async () => ({ requests: requests.shift() ?? [] }) };
  };
  return { heard, ask };
}

test('rows begin with a touch and end with the first frame without', async () => {
  const { heard, ask } = python();
  const notebook = new Notebook(pageOfAPlane(), 'secret', ask);
  notebook.take([frame(1, felt(0)), frame(16, felt(1, 2.5)), frame(32, felt(2, 2), felt(1, 1)), frame(48, felt(0)), frame(64, felt(0))]);
  await notebook.exchange();
  assert.deepEqual(heard[0].rows.map((row) => row.slice(0, 3)), [[16, 0, 1], [32, 0, 2], [32, 1, 1], [48, 0, 0], [48, 1, 0]]);
  assert.deepEqual(heard[0].rows[0], [16, 0, 1, 1.5, 1, 2, 3, 4, 5, 6, 0, 0, 1, 0, 0, 2.5]);
  assert.equal(heard[0].token, 'Bearer secret');
  assert.equal(heard[0].body, 'plane');
  await notebook.exchange();
  assert.deepEqual(heard[1].rows, [], 'told once');
});

test('what was not heard is told again', async () => {
  const { heard, ask } = python();
  let deaf = true;
  const notebook = new Notebook(pageOfAPlane(), 'secret', async (...given) => (deaf ? { ok: false, status: 503 } : ask(...given)));
  notebook.take([frame(16, felt(1))]);
  await assert.rejects(notebook.exchange(), /503/);
  deaf = false;
  await notebook.exchange();
  assert.equal(heard[0].rows.length, 1);
});

test('a press that Python asks for stays, as deep as it was asked for, until it is lifted', async () => {
  const { heard, ask } = python([{ id: 1, name: 'press', place: 'T6 right 5 mm', depth: 8, finger: 1 }], [{ id: 2, name: 'lift', finger: 1 }], []);
  const page = pageOfAPlane();
  const notebook = new Notebook(page, 'secret', ask);
  await notebook.exchange();
  assert.deepEqual(page.told.at(-1), [1, { place: [15, 20, 0], normal: [0, 0, 1], depth: 8, pressed: true }]);
  page.fingers.pass(10);
  assert.equal(page.fingers.aims[1].depth, 8, 'kept fingers stay as they are');
  await notebook.exchange();
  assert.deepEqual(heard[1].answers, [{ id: 1, result: null }]);
  assert.deepEqual(page.told.at(-1), [1, null]);
});

test('places, recordings and meshes go both ways; what cannot be done is said in words', async () => {
  const { heard, ask } = python([{ id: 1, name: 'go', place: 'T6' }, { id: 2, name: 'record' }, { id: 3, name: 'open', file: 'a.ply', unit_mm: 1 },
                                 { id: 4, name: 'go', place: 'T99' }, { id: 5, name: 'format' }]);
  const page = pageOfAPlane();
  const notebook = new Notebook(page, 'secret', ask);
  await notebook.exchange();
  await notebook.exchange();
  assert.equal(page.went, 'T6');
  assert.deepEqual(page.opened, [['a.ply', 12, 1]]);
  assert.deepEqual(heard[1].answers.slice(0, 3), [{ id: 1, result: null }, { id: 2, result: { csv: 't_s\n', toml: '' } }, { id: 3, result: null }]);
  assert.match(heard[1].answers[3].error, /no place T99/);
  assert.match(heard[1].answers[4].error, /not a function/);
});

test('a page that nobody knows any more falls silent', async () => {
  let asked = 0;
  const notebook = new Notebook(pageOfAPlane(), 'old', async () => {
    ++asked;
    return { ok: false, status: 401 };
  }, async () => {});
  await notebook.run();
  assert.equal(asked, 1);
});

test('only an address with #notebook= has a token', () => {
  assert.equal(notebookToken({ hash: '#notebook=abc-_1' }), 'abc-_1');
  assert.equal(notebookToken({ hash: '#token=abc' }), null);
  assert.equal(notebookToken({ hash: '' }), null);
});
