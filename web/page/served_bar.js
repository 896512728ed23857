// Who has the finger of a body that is felt elsewhere: words, and buttons for what this page's token allows.

const WORDS = { look: 'You look on', control: 'You may touch', instruct: 'You instruct' };

function element(name, properties = {}, children = []) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

export class ServedBar {
  /// `say(message)`: to the server.
  constructor(say) {
    this.words = element('p', { id: 'served-words' });
    this.message = element('p', { id: 'served-message', hidden: true });
    this.message.setAttribute('role', 'status');
    this.take = element('button', { id: 'served-take', type: 'button', textContent: 'Take the finger' });
    this.give = element('button', { id: 'served-give', type: 'button', textContent: 'Give it back' });
    this.pause = element('button', { id: 'served-pause', type: 'button', textContent: 'Pause' });
    this.text = element('input', { id: 'served-text', type: 'text', maxLength: 120, placeholder: 'A message to all' });
    this.text.setAttribute('aria-label', 'A message to all');
    this.take.onclick = () => say({ type: 'take' });
    this.give.onclick = () => say({ type: 'give' });
    this.pause.onclick = () => say({ type: 'pause', on: !this.paused });
    this.text.onkeydown = (event) => {
      event.stopPropagation(); // keys of the picture
      if (event.key !== 'Enter' || this.text.value.trim() === '') return;
      say({ type: 'message', text: this.text.value.trim() });
      this.text.value = '';
    };
    const buttons = element('div', { className: 'buttons' }, [this.take, this.give, this.pause]);
    const section = element('section', { id: 'served' }, [this.words, this.message, buttons, this.text]);
    section.setAttribute('aria-label', 'Felt elsewhere');
    document.querySelector('#panel h1').after(section);
    this.away('connecting');
  }

  /// There is no server now.
  away(words) {
    this.words.textContent = words;
    for (const part of [this.take, this.give, this.pause, this.text]) part.hidden = true;
  }

  show(hello, state) {
    const mine = state.holder === hello.you;
    const free = state.holder === 0;
    const who = mine ? 'you have the finger' : free ? 'nobody has the finger' : 'somebody has the finger';
    const device = hello.fingers.find(({ device: words }) => words !== '')?.device;
    this.words.textContent = [
      `${WORDS[hello.role]}: ${hello.title}.`,
      device ? `Felt with a device (${device}).` : '',
      `${who[0].toUpperCase()}${who.slice(1)}${state.paused ? ', and it is paused' : ''}.`,
      `${state.onlookers} here.`,
    ].filter(Boolean).join(' ');
    this.paused = state.paused;
    const instructs = hello.role === 'instruct';
    this.take.hidden = hello.role === 'look' || mine || (!free && !instructs);
    this.give.hidden = !mine;
    this.pause.hidden = this.text.hidden = !instructs;
    this.pause.textContent = state.paused ? 'Go on' : 'Pause';
  }

  tell(words) {
    this.message.hidden = words === '';
    this.message.textContent = words; // never as HTML: somebody else wrote it
  }
}
