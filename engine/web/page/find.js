// The search for a place in words: completes what is typed, flies there, or offers names that are near in spelling.
import { namesLike, namesNear, placeNamed } from './places.js';

const EXAMPLES = ['T6', 'left PSIS', 'site 4', 'left rib 7 angle']; // not every body has all of them

export class Find {
  /// `parts`: form, input, says, near. `hooks`: go({name, at, normal}), leave().
  constructor(parts, hooks) {
    Object.assign(this, { parts, hooks, landmarks: [] });
    parts.form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.look(parts.input.value);
    });
    parts.input.addEventListener('keydown', (event) => event.key === 'Escape' && hooks.leave());
    parts.input.addEventListener('input', () => this.complete(parts.input.value));
  }
  setBody({ landmarks }) {
    this.landmarks = landmarks;
    for (const part of this.parts.form.elements) part.disabled = landmarks.length === 0;
    this.examples = EXAMPLES.filter((words) => this.meant(words)).slice(0, 3);
    this.parts.input.placeholder = this.examples.join(', ');
    this.answer(landmarks.length === 0 ? 'This body has no named places.' : '', []);
  }
  /// The place of these words, or the first whose name they are a part of.
  meant(words) {
    return placeNamed(this.landmarks, words) ?? placeNamed(this.landmarks, namesLike(this.landmarks, words)[0] ?? '');
  }
  complete(words) {
    const like = namesLike(this.landmarks, words);
    const complete = like.length === 1 && like[0].toLowerCase() === words.trim().toLowerCase();
    this.answer('', complete ? [] : like);
  }
  look(words) {
    if (words.trim() === '') return;
    const place = this.meant(words);
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
