// What the places of the body are called, beside them: those that look at the viewer and do not cover each other. Names
// of the left are set to the left of their place, so that both sides have room.
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
    this.landmarks.forEach(({ name, at, normal }, i) => {
      const span = this.layer.children[i];
      const p = dot(minus(eye, at), normal) > 0 ? camera.project(at) : null;
      const aside = name.startsWith('left ') ? -this.boxes[i][0] - 4 : 4;
      const box = p && [((p[0] + 1) / 2) * width + aside, ((1 - p[1]) / 2) * height - this.boxes[i][1] / 2, ...this.boxes[i]];
      const free = box && !taken.some((b) => box[0] < b[0] + b[2] && b[0] < box[0] + box[2] && box[1] < b[1] + b[3] && b[1] < box[1] + box[3]);
      span.hidden = !free;
      if (!free) return;
      taken.push(box);
      span.style.transform = `translate(${box[0].toFixed(1)}px, ${box[1].toFixed(1)}px)`;
    });
  }
}
