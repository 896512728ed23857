// The entry of the package in browsers and bundlers; a module worker may use it, too.
import create from './site/palpate.mjs';
import { fetchFirstBody } from './site/first_body.js';
import { Palpate } from './palpate.js';

export { Palpate };
export async function load() {
  return new Palpate(await create(), fetchFirstBody);
}
