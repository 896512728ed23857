// The body that the page begins with, and a file of how it looks: drawn at once, while the engine builds it to be felt.
//
// The file: vertices, triangles, closed (each 4 bytes), then six floats a vertex (place, normal), then three 32-bit
// corners a triangle. Made by the build (web/first_body.mjs) with the same engine, so nothing moves when the real one comes.
import { FLOATS_OF_VERTEX } from './engine.js';

export const FIRST_TRIANGLES = 20389; // of skin and bones
const FILE = 'first_body.bin';
const STORED = 6;

export function packFirstBody({ rest, corners, closed }) {
  const vertices = rest.length / FLOATS_OF_VERTEX;
  const bytes = new ArrayBuffer(12 + 4 * STORED * vertices + 4 * corners.length);
  new Uint32Array(bytes, 0, 3).set([vertices, corners.length / 3, closed ? 1 : 0]);
  const floats = new Float32Array(bytes, 12, STORED * vertices);
  for (let v = 0; v < vertices; ++v) {
    floats.set(rest.subarray(FLOATS_OF_VERTEX * v, FLOATS_OF_VERTEX * v + STORED), STORED * v);
  }
  new Uint32Array(bytes, 12 + 4 * STORED * vertices).set(corners);
  return new Uint8Array(bytes);
}

/// A Body (source.js) to look at, without bones and names; null where the file is not there.
export async function fetchFirstBody() {
  const response = await fetch(new URL(FILE, import.meta.url)).catch(() => null);
  if (!response?.ok) return null;
  const bytes = await response.arrayBuffer();
  const [vertices, triangles, closed] = new Uint32Array(bytes, 0, 3);
  const floats = new Float32Array(bytes, 12, STORED * vertices);
  const rest = new Float32Array(FLOATS_OF_VERTEX * vertices);
  for (let v = 0; v < vertices; ++v) rest.set(floats.subarray(STORED * v, STORED * (v + 1)), FLOATS_OF_VERTEX * v);
  const grey = new Uint8Array(1024).fill(128);
  return {
    name: '', closed: closed === 1, notes: [], landmarks: [], stiffness: null, bones: null, rest,
    corners: new Uint32Array(bytes, 12 + 4 * STORED * vertices, 3 * triangles),
    colours: { stiffness: grey, strain: grey },
  };
}
