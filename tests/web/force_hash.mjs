// web.force_hash: along the same path on the same STL file, native code and the page's engine feel the same, to the last
// bit of every number. Prints one JSON object; exit code 1 where they differ, 2 where something is missing.
//
//   node tests/web/force_hash.mjs SITE WEB_REFERENCE
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { engineOf } from './engine_in_node.mjs';

export async function compareWithNative(site, reference) {
  const folder = mkdtempSync(join(tmpdir(), 'palpate-web-'));
  try {
    const native = JSON.parse(execFileSync(reference, [folder], { encoding: 'utf8' }));
    const engine = await engineOf(site);
    engine.withBytes(engine.module._palpate_bench_open, [readFileSync(join(folder, 'back.stl'))]);
    const path = readFileSync(join(folder, 'back_slide.csv'));
    return native.map((figures) => {
      const runs = [1, 2, 3].map(() => {
        engine.withBytes(engine.module._palpate_bench_run, [path], figures.radius_mm);
        return JSON.parse(engine.text(engine.module._palpate_bench_report()));
      });
      const web = runs.reduce((best, run) => (run.p50_us < best.p50_us ? run : best));
      const equal = runs.every(({ hash, ticks }) => hash === figures.hash && ticks === figures.ticks);
      return { radius_mm: figures.radius_mm, equal, native: figures, web, p50_ratio: web.p50_us / figures.p50_us };
    });
  } finally {
    rmSync(folder, { recursive: true });
  }
}

if (process.argv[1]?.endsWith('force_hash.mjs')) {
  const [site, reference] = process.argv.slice(2);
  if (!reference || !existsSync(join(site, 'palpate.wasm')) || !existsSync(reference)) {
    console.error('usage: node force_hash.mjs SITE WEB_REFERENCE (tools/build-web makes the one, the tests the other)');
    process.exit(2);
  }
  const compared = await compareWithNative(site, reference);
  console.log(JSON.stringify(compared));
  process.exit(compared.every(({ equal }) => equal) ? 0 : 1);
}
