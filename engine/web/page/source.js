// Where the body is felt: by the engine in this page's own worker (local.js), or by `palpate serve` (served.js).
//
// Everything else of the page knows a source only by this interface:
//
//   source.can                      {open, dysfunctions, lumps, record}: what it offers besides touch, each true or false
//   await source.preview?.()        a Body to look at until the one to feel is there; null when there is none
//   await source.start()            a Body; rejects with an Error whose message can be shown
//   source.tip(finger, aim)         finger 0 (left, blue) or 1 (right, red) is wanted there from now on:
//                                   aim = {place: [x, y, z], normal: [x, y, z], depth, pressed}
//                                   place: on the skin at rest, mm; normal: out of it; depth: mm under it when pressed;
//                                   not pressed: the finger hovers. null: the finger leaves.
//   source.onFrame(callback)        callback(frame), at most one a picture, see below
//   source.taken(frames)            so many of them were drawn or thrown away: only then others follow
//   source.onTrouble(callback)      callback(words) when it stops for good; onBody(callback): another Body from now on
//   source.onAway?.(callback)       callback(words) while who feels the body is out of reach, callback(null) when back
//   await source.open(name, bytes, unit_mm)      a mesh file: a Body; rejects in words and keeps the old body
//   await source.setDysfunctions([{x, y, radius, change}])   gives the new stiffness (Float32Array)
//   await source.lumps()            the trunk with the lumps of the preset: a Body
//   await source.record()           {csv, toml}: what was felt so far and the scene it was felt on
//
//   Body  = {name, closed, notes: [words], landmarks: [{name, at, normal}], stiffness: Float32Array or null,
//            rest: Float32Array (7 a vertex, as frame.values), corners: Uint32Array (3 a triangle),
//            bones: {positions: Float32Array, corners: Uint32Array} or null, colours: {name: Uint8Array of 256 x 4}}
//   frame = {ranges: Uint32Array (first, end, first, end ...), values: Float32Array (7 a vertex of the ranges: place,
//            normal, strain), fingers: [{tip, proxy, normal, force: [x, y, z], depth, touch}] (touch 0 free, 1 sticks,
//            2 slips), pads: {taxels, kpa: of each finger taxels x taxels numbers or null} or null, tick,
//            pace: {ticks_per_s, late_ms, worst_ms, lost} or null}
//
// A source is chosen once: by <meta name="palpate-source" content="served">, or by ?served in the address.

export async function chooseSource() {
  const meta = document.querySelector('meta[name="palpate-source"]');
  const served = meta?.content === 'served' || new URLSearchParams(location.search).has('served');
  const { createSource } = served ? await import('./served.js') : await import('./local.js');
  return createSource();
}
