// The entry of the package in node.
import { readFile } from 'node:fs/promises';
import { gunzipSync } from 'node:zlib';
import create from './site/palpate.mjs';
import { Palpate } from './palpate.js';

const file = (name) => readFile(new URL(`./site/${name}`, import.meta.url));

export { Palpate };
export async function load() {
  const module = await create({ wasmBinary: await file('palpate.wasm') });
  return new Palpate(module, async () => gunzipSync(await file('trunk.bin')));
}
