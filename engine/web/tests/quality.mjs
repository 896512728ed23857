// web.quality: fewer pixels while pictures come too slowly, more again when they do not, never for a still picture.
//
//   node --test engine/web/tests/quality.mjs
import assert from 'node:assert/strict';
import test from 'node:test';
import { Quality } from '../../web/page/quality.js';

/// Pictures `every_ms` apart for so long, from `now` on; `drawn(i)`: whether something was new.
function show(quality, now, seconds, every_ms, drawn = () => true) {
  const end = now + 1000 * seconds;
  for (let i = 0; now < end; ++i) quality.add((now += every_ms), drawn(i));
  return now;
}
function watched() {
  const shares = [];
  return { shares, quality: new Quality((share) => shares.push(share)) };
}

test('slow pictures get fewer pixels, step by step, and no fewer than the last step', () => {
  const { shares, quality } = watched();
  show(quality, 0, 30, 100);
  assert.deepEqual(shares, [0.75, 0.5, 0.35]);
  assert.ok(Math.abs(quality.fps - 10) < 1, `${quality.fps}`);
});

test('quick pictures keep all pixels', () => {
  const { shares, quality } = watched();
  show(quality, 0, 30, 16.7);
  assert.deepEqual(shares, []);
});

test('what was slow for a while gets its pixels back, later each time that it was in vain', () => {
  const { shares, quality } = watched();
  let now = show(quality, 0, 2, 50);
  assert.deepEqual(shares, [0.75]);
  now = show(quality, now, 10, 16.7);
  assert.deepEqual(shares, [0.75, 1]);
  const patience = quality.patience_s;
  now = show(quality, now, 4, 50);
  assert.ok(quality.patience_s > patience);
  assert.ok(quality.share() < 1);
});

test('a picture in which nothing is new, and a page that was hidden, have not been slow', () => {
  const { shares, quality } = watched();
  let now = show(quality, 0, 10, 100, (i) => i % 3 === 0);
  assert.deepEqual(shares, []);
  for (let i = 0; i < 10; ++i) quality.add((now += 2000), true);
  assert.deepEqual(shares, []);
});
