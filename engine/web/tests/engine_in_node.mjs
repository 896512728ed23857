// The engine of a built site, in node: the same WebAssembly as in the page.
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

/// `site`: the folder that tools/build-web made.
export async function engineOf(site) {
  // The module was made for browsers: this is what it takes for a worker.
  globalThis.importScripts ??= () => {};
  globalThis.self ??= globalThis;
  globalThis.location ??= { href: pathToFileURL(join(resolve(site), 'palpate.mjs')).href };
  const { Engine } = await import(pathToFileURL(join(resolve(site), 'engine.js')).href);
  return Engine.load({ wasmBinary: readFileSync(join(site, 'palpate.wasm')) });
}
