// The search for a place in words: flies there, or offers names that are near in spelling.
import { namesNear, placeNamed } from './places.js';

const EXAMPLES = ['T6', 'left PSIS', 'left rib 7 angle']; // not every body has all of them

export class Find {
  /// `parts`: form, input, says, near. `hooks`: go({name, at, normal}).
  constructor(parts, hooks) {
    Object.assign(this, { parts, hooks, landmarks: [] });
    parts.form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.look(parts.input.value);
    });
    parts.input.addEventListener('input', () => this.answer('', []));
  }
  setBody({ landmarks }) {
    this.landmarks = landmarks;
    for (const part of this.parts.form.elements) part.disabled = landmarks.length === 0;
    this.examples = EXAMPLES.filter((words) => placeNamed(landmarks, words)).slice(0, 2);
    this.parts.input.placeholder = this.examples.join(', ');
    this.answer(landmarks.length === 0 ? 'This body has no named places.' : '', []);
  }
  look(words) {
    if (words.trim() === '') return;
    const place = placeNamed(this.landmarks, words);
    if (place) {
      this.answer('', []);
      this.hooks.go(place);
      return;
    }
    const near = namesNear(this.landmarks, words);
    const advice = near.length > 0 ? 'Did you mean:' : `Try “${this.examples.join('” or “')}”.`;
    this.answer(`No place here is called “${words.trim()}”. ${advice}`, near);
  }
  answer(words, names) {
    this.parts.says.textContent = words;
    this.parts.near.replaceChildren(...names.map((name) => {
      const button = Object.assign(document.createElement('button'), { type: 'button', textContent: name });
      button.addEventListener('click', () => {
        this.parts.input.value = name;
        this.look(name);
      });
      return button;
    }));
  }
}
