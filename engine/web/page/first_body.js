// The body that the page begins with: a trunk that the build made (engine/web/make_ahead.mjs), packed by gzip.
import { FLOATS_OF_VERTEX } from './engine.js';

export const FIRST_TRIANGLES = 40000; // of skin and bones
export const FIRST_FILE = 'trunk.bin';

/// The bytes that Engine.readReady takes. Throws an Error that can be shown.
export async function fetchFirstBody() {
  if (typeof DecompressionStream !== 'function') throw new Error('This browser is too old to unpack the body: it has no DecompressionStream.');
  const response = await fetch(new URL(FIRST_FILE, import.meta.url)).catch(() => null);
  if (!response?.ok) throw new Error('the body could not be loaded; reload the page to try again');
  const unpacked = response.body.pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(unpacked).arrayBuffer());
}

/// A Body (source.js) to look at while the engine prepares the one to be felt: without bones and stiffness.
export function bodyToSee({ rest, corners, landmarks }) {
  const grey = new Uint8Array(1024).fill(128);
  return {
    name: '', closed: true, notes: [], landmarks, stiffness: new Float32Array(rest.length / FLOATS_OF_VERTEX), bones: null,
    rest, corners, colours: { stiffness: grey, strain: grey },
  };
}
