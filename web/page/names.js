// What the places of the body are called, beside them: those that look at the viewer and do not cover each other; and a
// place in the words of an examiner.
import { dot, minus } from './picker.js';

export class Names {
  constructor(layer) {
    this.layer = layer;
    this.landmarks = [];
    this.shown = false;
  }
  setBody(body) {
    this.landmarks = body.landmarks;
    this.layer.replaceChildren(...this.landmarks.map(({ name }) => {
      const span = document.createElement('span');
      span.textContent = name;
      return span;
    }));
    this.boxes = null;
  }
  show(on) {
    this.shown = on;
    this.layer.hidden = !on;
  }
  draw(camera) {
    if (!this.shown || this.landmarks.length === 0) return;
    const [width, height] = [this.layer.clientWidth, this.layer.clientHeight];
    this.boxes ??= [...this.layer.children].map((span) => [span.offsetWidth || 40, span.offsetHeight || 16]);
    const eye = camera.camera.position.toArray();
    const taken = [];
    this.landmarks.forEach(({ at, normal }, i) => {
      const span = this.layer.children[i];
      const p = dot(minus(eye, at), normal) > 0 ? camera.project(at) : null;
      const box = p && [((p[0] + 1) / 2) * width + 4, ((1 - p[1]) / 2) * height - this.boxes[i][1] / 2, ...this.boxes[i]];
      const free = box && !taken.some((b) => box[0] < b[0] + b[2] && b[0] < box[0] + box[2] && box[1] < b[1] + b[3] && b[1] < box[1] + box[3]);
      span.hidden = !free;
      if (!free) return;
      taken.push(box);
      span.style.transform = `translate(${box[0].toFixed(1)}px, ${box[1].toFixed(1)}px)`;
    });
  }
}

/// "T9, 28 mm right": the nearest place on the spine, else the nearest of all.
export function inWords(landmarks, place) {
  const spine = landmarks.filter(({ name }) => /^[CTL]\d+$/.test(name));
  const among = spine.length > 0 ? spine : landmarks;
  if (among.length === 0) return '';
  const nearest = among.reduce((best, l) => (Math.abs(l.at[1] - place[1]) < Math.abs(best.at[1] - place[1]) ? l : best));
  const [dx, dy] = [place[0] - nearest.at[0], place[1] - nearest.at[1]];
  const parts = [];
  if (Math.abs(dx) >= 1) parts.push(`${Math.abs(dx).toFixed(0)} mm ${dx > 0 ? 'right' : 'left'}`);
  if (Math.abs(dy) >= 3) parts.push(`${Math.abs(dy).toFixed(0)} mm ${dy > 0 ? 'up' : 'down'}`);
  return [nearest.name, ...parts].join(', ');
}
