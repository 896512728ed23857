// Run by tools/build-web, in node: the first body as it looks, in a file that the page draws while its engine still
// builds the same body to be touched (web/page/first_body.js reads it); and the hand that is drawn where it touches
// (web/page/hand_shape.js), which the engine would need a second for.
//
//   node web/first_body.mjs SITE
import { readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const site = resolve(process.argv[2]);
// The engine's module was made for browsers: this is what it takes for a worker.
globalThis.importScripts = () => {};
globalThis.self = globalThis;
globalThis.location = { href: pathToFileURL(join(site, 'palpate.mjs')).href };
const { Engine } = await import(pathToFileURL(join(site, 'engine.js')).href);
const { FIRST_TRIANGLES, packFirstBody } = await import(pathToFileURL(join(site, 'first_body.js')).href);
const { packHand } = await import(pathToFileURL(join(site, 'hand_shape.js')).href);

const engine = await Engine.load({ wasmBinary: readFileSync(join(site, 'palpate.wasm')) });
engine.openTorso(FIRST_TRIANGLES);
writeFileSync(join(site, 'first_body.bin'), packFirstBody(engine.body()));
writeFileSync(join(site, 'hand.bin'), packHand(engine.hand()));
