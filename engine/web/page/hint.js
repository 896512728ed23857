// The first sentence of the page: what to do, for the hand that is there.

const WORDS = {
  touch: 'Press and hold on the back to feel it. Slide to pull the skin. The Turn button lets you turn the body.',
  mouse: 'Press on the back with the left mouse button to feel it. Drag to pull the skin. The right button turns the body.',
  keys: 'Press Enter to put a finger on the back and again to lift it. Arrow keys move it; Page Down presses deeper.',
};

export class Hint {
  constructor(element, picture) {
    this.element = element;
    this.say(matchMedia('(pointer: coarse)').matches ? 'touch' : 'mouse');
    picture.addEventListener('focus', () => {
      if (picture.matches(':focus-visible:not(.by-pointer)')) this.say('keys');
    });
    picture.addEventListener('pointerdown', (event) => this.say(event.pointerType === 'touch' ? 'touch' : 'mouse'));
  }
  say(hand) {
    this.element.textContent = WORDS[hand];
  }
  /// It was done once.
  done() {
    this.element.classList.add('gone');
  }
}
