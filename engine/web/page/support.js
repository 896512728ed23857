// What the page needs of a browser, asked before anything is loaded: words for what is missing, or nothing.

// The smallest modules that use what is asked about; a browser that knows it finds them valid.
const SIMD = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];
const EXCEPTIONS = [0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11];

const valid = (bytes) => WebAssembly.validate(new Uint8Array(bytes));

export function missingHere() {
  const missing = [];
  if (!document.createElement('canvas').getContext('webgl2')) missing.push('WebGL 2 (3D graphics)');
  if (typeof WebAssembly !== 'object') missing.push('WebAssembly');
  else {
    if (!valid(SIMD)) missing.push('WebAssembly SIMD');
    if (!valid(EXCEPTIONS)) missing.push('WebAssembly exceptions');
  }
  return missing;
}

/// Whether pictures are drawn by the processor: then every sample of every pixel is taken from the engine's time.
export function drawsInSoftware() {
  const gl = document.createElement('canvas').getContext('webgl2', { failIfMajorPerformanceCaveat: false });
  if (!gl) return false;
  const names = gl.getExtension('WEBGL_debug_renderer_info'); // where there is none, RENDERER itself says it
  const name = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  gl.getExtension('WEBGL_lose_context')?.loseContext(); // browsers keep only a few
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

export function wordsFor(missing) {
  return `This browser lacks what the page needs: ${missing.join(', ')}. A current Chromium, Chrome, Edge, Firefox or Safari has it;
where WebGL is missing, look whether the browser's hardware acceleration is switched off.`;
}
