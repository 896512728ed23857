// Meshes that the tests hand to the page.

/// Binary STL of triangles [[x, y, z], [x, y, z], [x, y, z]]; `claimed`: how many the file says it has.
export function stlOf(triangles, { claimed = triangles.length } = {}) {
  const view = new DataView(new ArrayBuffer(84 + 50 * triangles.length));
  view.setUint32(80, claimed, true);
  triangles.forEach((corners, t) => corners.flat().forEach((x, i) => view.setFloat32(84 + 50 * t + 12 + 4 * i, x, true)));
  return new Uint8Array(view.buffer);
}

/// A plate of 2 n^2 triangles, 100 mm wide, that looks up.
export function plate(n = 12) {
  const at = (i, j) => [(100 * i) / n, (100 * j) / n, 0];
  const cells = Array.from({ length: n * n }, (_, k) => [Math.floor(k / n), k % n]);
  return cells.flatMap(([i, j]) => [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]);
}
