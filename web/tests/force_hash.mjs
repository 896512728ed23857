// web.force_hash: along the same path on the same STL file, native code and the page's engine feel the same, to the last
// bit of every number. Prints one JSON object; exit code 1 where they differ, 2 where something is missing.
//
//   node web/tests/force_hash.mjs SITE WEB_REFERENCE
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { engineOf } from './engine_in_node.mjs';

const quickest = (runs) => runs.reduce((best, run) => (run.p50_us < best.p50_us ? run : best));

/// Native and web in turn, so that both meet the same moods of the processor; of each the quickest counts.
export async function compareWithNative(site, reference, times = 3) {
  const folder = mkdtempSync(join(tmpdir(), 'palpate-web-'));
  try {
    const native = () => JSON.parse(execFileSync(reference, [folder], { encoding: 'utf8' }));
    const rounds = [{ native: native() }];
    const engine = await engineOf(site);
    engine.withBytes(engine.module._palpate_bench_open, [readFileSync(join(folder, 'back.stl'))]);
    const path = readFileSync(join(folder, 'back_slide.csv'));
    const web = () => rounds[0].native.map(({ radius_mm }) => {
      engine.withBytes(engine.module._palpate_bench_run, [path], radius_mm);
      return JSON.parse(engine.text(engine.module._palpate_bench_report()));
    });
    rounds[0].web = web();
    while (rounds.length < times) rounds.push({ native: native(), web: web() });
    return rounds[0].native.map(({ radius_mm, hash, ticks }, i) => {
      const equal = rounds.every((round) => round.web[i].hash === hash && round.web[i].ticks === ticks);
      const best = { native: quickest(rounds.map((round) => round.native[i])), web: quickest(rounds.map((round) => round.web[i])) };
      return { radius_mm, equal, ...best, p50_ratio: best.web.p50_us / best.native.p50_us };
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
