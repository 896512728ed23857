// What index.d.ts declares is there, and what can be called is declared. Without a compiler: tools/release --check has tsc, where
// it is installed.
//
//   node packaging/npm/check_types.mjs
import { readFileSync } from 'node:fs';

const here = (name) => readFileSync(new URL(name, import.meta.url), 'utf8');
// Engine's calls that take pointers, for who builds on the engine itself.
const INNER = ['constructor', 'text', 'bytes', 'floats', 'whole', 'doubles', 'put', 'withBytes', 'check', 'readReady', 'openReady'];

const methods = (source) => [...source.matchAll(/^ {2}(?:async )?(\w+)\([^)]*\) \{$/gm)].map((found) => found[1]);
const offered = new Set([...methods(here('palpate.js')), ...methods(here('../../engine/web/page/engine.js'))].filter((name) => !INNER.includes(name)));
const of_class = here('index.d.ts').match(/export declare class Palpate \{([^]*?)^\}/m)[1];
const declared = new Set([...of_class.matchAll(/^ {2}(\w+)\(/gm)].map((found) => found[1]));
const undeclared = [...offered].filter((name) => !declared.has(name));
const missing = [...declared].filter((name) => !offered.has(name));
for (const name of undeclared) console.log(`index.d.ts does not declare ${name}`);
for (const name of missing) console.log(`index.d.ts declares ${name}, which is not there`);
console.log(`types: ${declared.size} calls declared, ${offered.size} offered`);
process.exit(undeclared.length + missing.length > 0 || offered.size < 10 ? 1 : 0);
