// web.hostile: mesh files of somebody who means harm or had bad luck. The engine answers each in words, or takes it, and
// works afterwards; nothing ends in a trap.
//
//   node engine/web/tests/hostile.mjs SITE
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import test from 'node:test';
import { gunzipSync } from 'node:zlib';
import { engineOf } from './engine_in_node.mjs';
import { plate, stlOf as stl } from './meshes.mjs';

const site = process.argv[2] ?? 'build/web/site';
const engine = await engineOf(site);
const text = (words) => new TextEncoder().encode(words);
const open = (name, bytes) => engine.openMesh(bytes, name, 0);

function isFelt() {
  engine.aim(0, { place: [50, 50, 0], normal: [0, 0, 1], depth: 5, pressed: true });
  engine.run(600);
  const { force, depth } = engine.felt(0);
  assert.ok(force[2] > 0.5, `force ${force}`);
  assert.ok(Math.abs(depth - 5) < 0.2, `depth ${depth}`);
  engine.aim(0, null);
  engine.run(10);
}

test('a plain plate is felt', () => {
  open('plate.stl', stl(plate()));
  isFelt();
});

const refused = {
  'an empty file': ['empty.stl', new Uint8Array(0)],
  'one byte': ['one.stl', text('s')],
  'a text that is not a mesh': ['letter.obj', text('Dear Sir or Madam')],
  'a picture by another name': ['cat.ply', new Uint8Array([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0, 0])],
  'an unknown ending': ['body.docx', text('PK')],
  'no ending': ['body', text('solid')],
  'an STL that claims four thousand million triangles': ['many.stl', stl(plate(2), { claimed: 0xffffffff })],
  'an STL cut in the middle': ['cut.stl', stl(plate()).slice(0, 500)],
  'numbers that are none': ['nan.stl', stl([[[NaN, 0, 0], [1, NaN, 0], [0, 1, NaN]]])],
  'a single point': ['point.stl', stl(Array(9).fill([[1, 1, 1], [1, 1, 1], [1, 1, 1]]))],
  'an OBJ of corners without vertices': ['corners.obj', text('f 1 2 3\nf 4 5 6\n')],
  'an OBJ with an index beyond counting': ['index.obj', text('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n')],
  'a PLY that claims more than it has': ['claims.ply', text('ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n')],
  'a PLY with a list of a thousand million': ['list.ply', text('ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1000000000 0 0 0\n')],
  'an OFF without numbers': ['none.off', text('OFF\n')],
  'a GLB with a wrong length': ['length.glb', new Uint8Array([0x67, 0x6c, 0x54, 0x46, 2, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 0])],
  'a glTF that names a file beside it': ['beside.gltf', text('{"asset":{"version":"2.0"},"buffers":[{"uri":"../../etc/passwd","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]}')],
  'a glTF nested a hundred thousand deep': ['deep.gltf', text('['.repeat(100000))],
  'a glTF accessor of huge count': ['huge.gltf', text('{"asset":{"version":"2.0"},"buffers":[{"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAA","byteLength":12}],"bufferViews":[{"buffer":0,"byteLength":12}],"accessors":[{"bufferView":0,"componentType":5126,"count":1431655766,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]}')],
};

for (const [what, [name, bytes]] of Object.entries(refused)) {
  test(`refused in words: ${what}`, () => {
    assert.throws(() => open(name, bytes), (error) => {
      assert.equal(error.constructor, Error, `a trap: ${error}`);
      assert.match(error.message, /\w+ \w+/);
      assert.ok(!error.message.includes('\n'), 'one line');
      assert.ok(error.message.startsWith(name), error.message);
      return true;
    });
  });
}

const trunk = gunzipSync(readFileSync(join(site, 'trunk.bin')));

test('a trunk that is cut, of another version, or damaged is refused in words', () => {
  const refuses = (bytes, words) => assert.throws(() => engine.readReady(bytes), (error) => {
    assert.equal(error.constructor, Error, `a trap: ${error}`);
    assert.match(error.message, words);
    return true;
  });
  refuses(new Uint8Array(0), /^trunk: byte 0: ends too early/);
  refuses(text('palpate trunk 0'), /another version/);
  for (const length of [20, 100, 1000, trunk.length >> 1, trunk.length - 1]) refuses(trunk.subarray(0, length), /ends too early/);
  refuses(Buffer.concat([trunk, Buffer.from([0])]), /goes on after its end/);
  const damaged = Buffer.from(trunk);
  damaged.fill(255, 200, 300000);
  refuses(damaged, /^trunk: byte \d+: /);
});

test('the trunk is felt', () => {
  engine.readReady(trunk);
  engine.openReady();
  const { landmarks, bones, rest, corners } = engine.body();
  assert.ok(bones.corners.length > 1000 && rest.length / 7 > corners.length / 6);
  const { at, normal } = landmarks.find(({ name }) => name === 'T6');
  engine.aim(0, { place: [at[0] + 30, at[1], at[2]], normal, depth: 5, pressed: true });
  engine.run(600);
  assert.ok(Math.hypot(...engine.felt(0).force) > 0.5);
  engine.aim(0, null);
});

test('what is left out of a file is told', () => {
  open('cut.obj', text('v 0 0 0\nv 90 0 0\nv 0 90 0\nf 1 2 3\nl 1 2\nl 2 3\n'));
  assert.equal(engine.body().notes[0], 'cut.obj: left out: lines (2)');
});

test('random damage to a file is answered or mended', () => {
  let state = 7;
  const random = (n) => (state = (state * 48271) % 2147483647) % n;
  const whole = stl(plate(6));
  let taken = 0;
  for (let round = 0; round < 300; ++round) {
    const bytes = whole.slice(0, random(4) === 0 ? random(whole.length) : whole.length);
    for (let i = 0; i < 1 + random(20) && bytes.length > 0; ++i) bytes[random(bytes.length)] = random(256);
    try {
      open('damaged.stl', bytes);
      ++taken;
      engine.run(2);
    } catch (error) {
      assert.equal(error.constructor, Error, `a trap: ${error}`);
    }
  }
  assert.ok(taken > 20 && taken < 300, `${taken} of 300 were taken`);
});

test('afterwards a good one is felt as before', () => {
  open('plate.stl', stl(plate()));
  isFelt();
});
