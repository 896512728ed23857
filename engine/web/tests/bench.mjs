// tools/bench-web: how fast the page is, in numbers. See docs/howto/web.md for what each means.
//
//   node engine/web/tests/bench.mjs [--json] [--seconds N] [--reference WEB_REFERENCE] [--site SITE]
import { existsSync, readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { gzipSync } from 'node:zlib';
import { Browser, findBrowser, pause } from './browser.mjs';
import { compareWithNative } from './force_hash.mjs';
import { serve } from './server.mjs';

function option(name, fallback) {
  const at = process.argv.indexOf(`--${name}`);
  return at < 0 ? fallback : process.argv[at + 1];
}
const site = resolve(option('site', 'build/web/site'));
const reference = option('reference', 'build/release/tests/web_reference');
const seconds = Number(option('seconds', '10'));

/// A finger presses and drags all the while, in a window whose picture is 640 x 360.
async function inBrowser() {
  const server = await serve(site, { isolated: true });
  const browser = await Browser.launch();
  try {
    const first = await browser.open(server.url, { width: 640, height: 400 });
    await first.until("document.body.dataset.state === 'ready'", 60);
    await browser.send('Target.closeTarget', { targetId: first.target });
    // Once more, now that everything is in the browser's cache.
    const tab = await browser.open('about:blank', { width: 920, height: 391 });
    const start = performance.now();
    await tab.go(server.url);
    await tab.until("document.body.dataset.state === 'pictured' || document.body.dataset.state === 'ready'", 60);
    const first_picture_s = (performance.now() - start) / 1000;
    await tab.until("document.body.dataset.state === 'ready'", 60);
    const first_touch_s = (performance.now() - start) / 1000;
    const [width, height] = await tab.ask('palpate.picture.pixels()');
    await tab.ask('palpate.picture.quality.add = function (now, drawn) { this.pictures += 1; }; palpate.fingers.deepens = false; palpate.fingers.depth = 7');
    await tab.ask(`(() => { const e = document.getElementById('picture'); const [w, h] = [e.clientWidth, e.clientHeight];
      let t = 0; const send = (type, x, y) => e.dispatchEvent(new PointerEvent(type, { pointerId: 1, pointerType: 'mouse', button: 0, buttons: 1, clientX: x, clientY: y, bubbles: true }));
      e.setPointerCapture = () => {}; send('pointerdown', w / 2, h / 2);
      const step = () => { t += 1 / 60; send('pointermove', w / 2 + 0.08 * w * Math.sin(2 * t), h / 2 + 0.15 * h * Math.sin(1.3 * t)); requestAnimationFrame(step); }; step(); })()`);
    await pause(2000);
    const count = () => tab.ask('({ now: performance.now(), drawn: palpate.picture.drawn, ticks: palpate.newest.tick, pace: palpate.newest.pace, force: Math.hypot(...palpate.newest.fingers[0].force) })');
    const before = await count();
    const late = [];
    while ((await count()).now - before.now < 1000 * seconds) {
      await pause(1000);
      late.push((await count()).pace.late_ms);
    }
    const after = await count();
    const passed_s = (after.now - before.now) / 1000;
    late.sort((a, b) => a - b);
    return {
      ticks_per_s: (after.ticks - before.ticks) / passed_s,
      fps_640x360: (after.drawn - before.drawn) / passed_s,
      picture: `${width}x${height}`,
      late_p99_ms: late[Math.floor(late.length / 2)],
      lost_ticks: after.pace.lost,
      force_n: after.force,
      first_picture_s,
      first_touch_s,
      seconds: passed_s,
    };
  } finally {
    await browser.close();
    server.close();
  }
}

if (!existsSync(`${site}/palpate.wasm`)) {
  console.error(`bench-web: ${site} is not built (tools/build-web)`);
  process.exit(2);
}
const gzip = (name) => gzipSync(readFileSync(`${site}/${name}`), { level: 9 }).length / 1000;
const result = { wasm_gzip_kb: gzip('palpate.wasm'), glue_gzip_kb: gzip('palpate.mjs'), three_gzip_kb: gzip('three.module.min.js') };
if (existsSync(reference)) {
  const compared = await compareWithNative(site, reference, 12);
  result.hash_equal = compared.every(({ equal }) => equal);
  result.tick = compared.map(({ radius_mm, web, native, p50_ratio }) => ({ radius_mm, p50_us: web.p50_us, native_p50_us: native.p50_us, p50_ratio }));
} else {
  result.hash_equal = null; // not compared: the reference is not built
}
if (findBrowser()) Object.assign(result, await inBrowser());

if (process.argv.includes('--json')) console.log(JSON.stringify(result));
else for (const [name, value] of Object.entries(result)) console.log(name.padEnd(16), typeof value === 'number' ? value.toFixed(2) : JSON.stringify(value));
