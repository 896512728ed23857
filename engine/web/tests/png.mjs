// Reads PNG files as a browser writes them (8 bits a channel, not interlaced), and says how far two pictures differ.
import { inflateSync } from 'node:zlib';

export function decode(file) {
  let [width, height, channels, at] = [0, 0, 0, 8];
  const parts = [];
  while (at < file.length) {
    const length = file.readUInt32BE(at);
    const kind = file.toString('latin1', at + 4, at + 8);
    const data = file.subarray(at + 8, at + 8 + length);
    if (kind === 'IHDR') {
      [width, height] = [data.readUInt32BE(0), data.readUInt32BE(4)];
      channels = { 2: 3, 6: 4 }[data[9]];
      if (data[8] !== 8 || !channels || data[12] !== 0) throw new Error('a PNG of another kind');
    }
    if (kind === 'IDAT') parts.push(data);
    at += 12 + length;
  }
  const raw = inflateSync(Buffer.concat(parts));
  const row = width * channels;
  const out = Buffer.alloc(height * row);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (row + 1)];
    for (let x = 0; x < row; ++x) {
      const left = x >= channels ? out[y * row + x - channels] : 0;
      const up = y > 0 ? out[(y - 1) * row + x] : 0;
      const corner = x >= channels && y > 0 ? out[(y - 1) * row + x - channels] : 0;
      out[y * row + x] = raw[y * (row + 1) + 1 + x] + [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter];
    }
  }
  return { width, height, channels, pixels: out };
}

function paeth(a, b, c) {
  const p = a + b - c;
  const [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
  if (pa <= pb && pa <= pc) return a;
  return pb <= pc ? b : c;
}

/// Within a box [x, y, width, height]: the mean difference of a channel (0 to 255), and the share of pixels in which any
/// channel differs by more than 32.
export function difference(one, other, [x0, y0, width, height]) {
  if (one.width !== other.width || one.height !== other.height) return { mean: 255, share: 1 };
  let [sum, far] = [0, 0];
  for (let y = y0; y < y0 + height; ++y) {
    for (let x = x0; x < x0 + width; ++x) {
      let most = 0;
      for (let c = 0; c < 3; ++c) {
        const d = Math.abs(one.pixels[(y * one.width + x) * one.channels + c] - other.pixels[(y * other.width + x) * other.channels + c]);
        sum += d;
        most = Math.max(most, d);
      }
      if (most > 32) ++far;
    }
  }
  return { mean: sum / (3 * width * height), share: far / (width * height) };
}

/// Within a box: how many pixels have a channel that differs by more than `least`.
export function pixelsChanged(one, other, [x0, y0, width, height], least) {
  let changed = 0;
  for (let y = y0; y < y0 + height; ++y) {
    for (let x = x0; x < x0 + width; ++x) {
      const at = (y * one.width + x) * one.channels;
      if ([0, 1, 2].some((c) => Math.abs(one.pixels[at + c] - other.pixels[at + c]) > least)) ++changed;
    }
  }
  return changed;
}
