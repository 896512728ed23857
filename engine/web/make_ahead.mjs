// Run by tools/build-web, in node: what the page needs not make itself. The trunk that it begins with, read by its engine
// (engine/core/palpate/scene/ready_body.h) in a fraction of the seconds that making it takes; and the hand that is drawn where it
// touches (engine/web/page/hand_shape.js).
//
//   node engine/web/make_ahead.mjs BUILD SITE        BUILD has ahead.mjs, SITE the page's own files
import { readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';

const [build, site] = process.argv.slice(2).map((folder) => resolve(folder));
const module_url = pathToFileURL(join(build, 'ahead.mjs')).href;
// The module was made for browsers: this is what it takes for a worker.
globalThis.importScripts = () => {};
globalThis.self = globalThis;
globalThis.location = { href: module_url };
const { default: create } = await import(module_url);
const { Engine } = await import(pathToFileURL(join(site, 'engine.js')).href);
const { FIRST_FILE, FIRST_TRIANGLES } = await import(pathToFileURL(join(site, 'first_body.js')).href);
const { packHand } = await import(pathToFileURL(join(site, 'hand_shape.js')).href);

const maker = new Engine(await create({ wasmBinary: readFileSync(join(build, 'ahead.wasm')) }));
const m = maker.module;

function trunk() {
  maker.check(m._palpate_make_trunk(FIRST_TRIANGLES));
  return maker.bytes(m._palpate_trunk_bytes(), m._palpate_trunk_length());
}
/// {positions, corners, held: pad, direction of its joint and of the forearm}.
function hand() {
  maker.check(m._palpate_make_hand());
  return {
    positions: maker.floats(m._palpate_hand_positions(), 3 * m._palpate_hand_vertices()),
    corners: maker.whole(m._palpate_hand_triangles(), m._palpate_hand_corners()),
    held: maker.doubles(m._palpate_hand_held(), 9),
  };
}
writeFileSync(join(site, FIRST_FILE), gzipSync(trunk(), { level: 9 }));
writeFileSync(join(site, 'hand.bin'), packHand(hand()));
