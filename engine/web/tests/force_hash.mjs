// web.force_hash: along the same path on the same STL file, native code and the page's engine feel the same, to the last
// bit of every number; and so on the trunk that the page has from a file and native code makes, byte by byte the same.
// Prints one JSON object; exit code 1 where they differ, 2 where something is missing.
//
//   node engine/web/tests/force_hash.mjs SITE WEB_REFERENCE
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { gunzipSync } from 'node:zlib';
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

/// The trunk under the page's two fingers: {made_equal, numbers, felt_equal, skin_equal, first_difference}.
export async function compareTrunk(site, reference) {
  const folder = mkdtempSync(join(tmpdir(), 'palpate-web-'));
  try {
    const { FIRST_FILE, FIRST_TRIANGLES } = await import(pathToFileURL(join(resolve(site), 'first_body.js')).href);
    const { ticks_of_aim } = JSON.parse(execFileSync(reference, [folder, String(FIRST_TRIANGLES)], { encoding: 'utf8' }));
    const rows = (name) => readFileSync(join(folder, name), 'utf8').trim().split('\n').map((line) => line.split(',').map(Number));
    const engine = await engineOf(site);
    const ready = gunzipSync(readFileSync(join(site, FIRST_FILE)));
    engine.readReady(ready);
    engine.openReady();
    const native = rows('felt.csv');
    let numbers = 0;
    let differs = null;
    for (const [finger, pressed, ...aim] of rows('aims.csv')) {
      engine.aim(finger, { place: aim.slice(0, 3), normal: aim.slice(3, 6), depth: aim[6], pressed: pressed === 1 });
      for (let tick = 0; finger === 1 && tick < ticks_of_aim; ++tick) {
        engine.run(1);
        for (const side of [0, 1]) {
          const { tip, proxy, normal, force, depth, touch, status } = engine.felt(side);
          const felt = [...tip, ...proxy, ...normal, ...force, depth, touch, status];
          const wanted = native[numbers / felt.length];
          if (!felt.every((x, i) => Object.is(x, wanted[i]))) differs ??= { felt, wanted };
          numbers += felt.length;
        }
      }
    }
    const touched = native.filter((row) => Math.hypot(...row.slice(9, 12)) > 0.5).length;
    const skin = Buffer.from(engine.frame(true).values.buffer);
    return { made_equal: ready.equals(readFileSync(join(folder, 'trunk.bin'))), numbers, touched,
             felt_equal: differs === null && numbers === native.length * native[0].length, first_difference: differs,
             skin_equal: skin.equals(readFileSync(join(folder, 'skin.f32'))) };
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
  const trunk = await compareTrunk(site, reference);
  console.log(JSON.stringify({ compared, trunk }));
  const trunk_equal = trunk.made_equal && trunk.felt_equal && trunk.skin_equal && trunk.touched > 0;
  process.exit(compared.every(({ equal }) => equal) && trunk_equal ? 0 : 1);
}
