// Several files as one: a ZIP archive (PKWARE, APPNOTE 6.3), compressed where the browser can.

const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});

export function crc32(bytes) {
  let c = 0xffffffff;
  for (const byte of bytes) c = TABLE[(c ^ byte) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

async function deflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function record(size, numbers) {
  const view = new DataView(new ArrayBuffer(size));
  for (const [offset, width, value] of numbers) width === 2 ? view.setUint16(offset, value, true) : view.setUint32(offset, value, true);
  return new Uint8Array(view.buffer);
}

/// `files`: {name: text}. Names of ASCII letters.
export async function zipOf(files) {
  const parts = [];
  const directory = [];
  let offset = 0;
  const method = typeof CompressionStream === 'function' ? 8 : 0;
  for (const [name, text] of Object.entries(files)) {
    const bytes = new TextEncoder().encode(text);
    const label = new TextEncoder().encode(name);
    const stored = method === 8 ? await deflated(bytes) : bytes;
    const crc = crc32(bytes);
    const sizes = (at) => [[at, 4, crc], [at + 4, 4, stored.length], [at + 8, 4, bytes.length], [at + 12, 2, label.length]];
    parts.push(record(30, [[0, 4, 0x04034b50], [4, 2, 20], [8, 2, method], [12, 2, 0x21], ...sizes(14)]), label, stored);
    directory.push(record(46, [[0, 4, 0x02014b50], [4, 2, 20], [6, 2, 20], [10, 2, method], [14, 2, 0x21], ...sizes(16), [42, 4, offset]]), label);
    offset += 30 + label.length + stored.length;
  }
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  const count = Object.keys(files).length;
  const end = record(22, [[0, 4, 0x06054b50], [8, 2, count], [10, 2, count], [12, 4, size], [16, 4, offset]]);
  return new Blob([...parts, ...directory, end], { type: 'application/zip' });
}
