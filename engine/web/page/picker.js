// Where a ray meets the skin at rest, and the skin's direction averaged over a fingertip there.
//
// A tree of boxes over the triangles, made once for a body (a tenth of a second for 200,000 triangles). At rest: a finger
// picked on its own dent would slide into the hole that it makes.

const LEAF = 8;

export class Picker {
  /// `rest`: `stride` floats a vertex that begin with place and normal.
  constructor(rest, stride, corners) {
    Object.assign(this, { rest, stride, corners });
    const triangles = corners.length / 3;
    this.order = Uint32Array.from({ length: triangles }, (_, i) => i);
    this.middles = new Float32Array(3 * triangles);
    for (let t = 0; t < triangles; ++t) {
      for (let axis = 0; axis < 3; ++axis) {
        this.middles[3 * t + axis] = (this.at(t, 0, axis) + this.at(t, 1, axis) + this.at(t, 2, axis)) / 3;
      }
    }
    this.nodes = []; // {low, high, left, right} or {low, high, first, end}
    if (triangles > 0) this.build(0, triangles);
  }

  at(triangle, corner, axis) {
    return this.rest[this.corners[3 * triangle + corner] * this.stride + axis];
  }

  build(first, end) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = first; i < end; ++i) {
      for (let corner = 0; corner < 3; ++corner) {
        for (let axis = 0; axis < 3; ++axis) {
          const x = this.at(this.order[i], corner, axis);
          if (x < low[axis]) low[axis] = x;
          if (x > high[axis]) high[axis] = x;
        }
      }
    }
    const index = this.nodes.length;
    this.nodes.push({ low, high, first, end, left: -1, right: -1 });
    if (end - first > LEAF) {
      const size = high.map((h, axis) => h - low[axis]);
      const axis = size.indexOf(Math.max(...size));
      const part = this.order.subarray(first, end);
      part.sort((a, b) => this.middles[3 * a + axis] - this.middles[3 * b + axis]);
      const middle = (first + end) >> 1;
      this.nodes[index].left = this.build(first, middle);
      this.nodes[index].right = this.build(middle, end);
    }
    return index;
  }

  /// The nearest place in front of the ray on a triangle that faces it: {place, normal, distance}, or null.
  pick(origin, direction) {
    if (this.nodes.length === 0) return null;
    // Never 0: on the face of a box 0 times infinity would be no number, and the box missed.
    const inverse = direction.map((d) => 1 / (Math.abs(d) < 1e-12 ? 1e-12 : d));
    const stack = [0];
    let best = Infinity;
    while (stack.length > 0) {
      const node = this.nodes[stack.pop()];
      if (boxDistance(node, origin, inverse) >= best) continue;
      if (node.left >= 0) {
        const left = boxDistance(this.nodes[node.left], origin, inverse);
        const right = boxDistance(this.nodes[node.right], origin, inverse);
        if (left < right) stack.push(node.right, node.left);
        else stack.push(node.left, node.right);
        continue;
      }
      for (let i = node.first; i < node.end; ++i) best = Math.min(best, this.triangleDistance(this.order[i], origin, direction));
    }
    if (best === Infinity) return null;
    const place = origin.map((o, axis) => o + best * direction[axis]);
    const normal = this.normalAround(place, direction);
    return normal ? { place, normal, distance: best } : null;
  }

  /// Möller and Trumbore (1997); Infinity where it is missed or seen from behind.
  triangleDistance(t, o, d) {
    const p = [0, 1, 2].map((corner) => [this.at(t, corner, 0), this.at(t, corner, 1), this.at(t, corner, 2)]);
    const e1 = minus(p[1], p[0]);
    const e2 = minus(p[2], p[0]);
    const h = cross(d, e2);
    const det = dot(e1, h);
    if (det <= 1e-12) return Infinity;
    const s = minus(o, p[0]);
    const u = dot(s, h);
    const slack = 1e-9 * det; // a ray along an edge must not fall between its triangles
    if (u < -slack || u > det + slack) return Infinity;
    const q = cross(s, e1);
    const v = dot(d, q);
    if (v < -slack || u + v > det + slack) return Infinity;
    const distance = dot(e2, q) / det;
    return distance > 0 ? distance : Infinity;
  }

  /// Of vertices within a fingertip of the place that do not look away from the one who picks; the nearest one's where
  /// none is so near (a coarse mesh).
  normalAround(place, direction, radius = 9) {
    const sum = [0, 0, 0];
    let nearest = Infinity;
    let normal_of_nearest = null;
    const stack = [0];
    const reach = [radius, 60, 1e9];
    for (const wide of reach) {
      stack.push(0);
      while (stack.length > 0) {
        const node = this.nodes[stack.pop()];
        if (boxGap(node, place) > wide) continue;
        if (node.left >= 0) {
          stack.push(node.left, node.right);
          continue;
        }
        for (let i = 3 * node.first; i < 3 * node.end; ++i) {
          const v = this.corners[3 * this.order[Math.floor(i / 3)] + (i % 3)] * this.stride;
          const n = [this.rest[v + 3], this.rest[v + 4], this.rest[v + 5]];
          if (dot(n, direction) > 0) continue;
          const away = Math.hypot(this.rest[v] - place[0], this.rest[v + 1] - place[1], this.rest[v + 2] - place[2]);
          if (away < nearest) {
            nearest = away;
            normal_of_nearest = n;
          }
          const weight = Math.max(0, 1 - away / radius);
          for (let axis = 0; axis < 3; ++axis) sum[axis] += weight * n[axis];
        }
      }
      if (normal_of_nearest) break;
    }
    const length = Math.hypot(...sum);
    return length > 1e-6 ? sum.map((x) => x / length) : normal_of_nearest;
  }
}

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

function boxDistance(node, origin, inverse) {
  let near = 0;
  let far = Infinity;
  for (let axis = 0; axis < 3; ++axis) {
    const a = (node.low[axis] - origin[axis]) * inverse[axis];
    const b = (node.high[axis] - origin[axis]) * inverse[axis];
    near = Math.max(near, Math.min(a, b));
    far = Math.min(far, Math.max(a, b));
  }
  return near <= far ? near : Infinity;
}

function boxGap(node, place) {
  let sum = 0;
  for (let axis = 0; axis < 3; ++axis) {
    const gap = Math.max(node.low[axis] - place[axis], 0, place[axis] - node.high[axis]);
    sum += gap * gap;
  }
  return Math.sqrt(sum);
}
