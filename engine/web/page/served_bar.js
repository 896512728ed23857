// Who controls the finger of a served body: words, and buttons for what this page's token allows.

const WORDS = { look: 'You are watching', control: 'You can touch', instruct: 'You are instructing' };

function element(name, properties = {}, children = []) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

export class ServedBar {
  /// `say(message)`: to the server. `reconnect()`: without waiting for the next try.
  constructor(say, reconnect) {
    this.words = element('p', { id: 'served-words' });
    this.message = element('p', { id: 'served-message', hidden: true });
    this.message.setAttribute('role', 'status');
    this.take = element('button', { id: 'served-take', type: 'button', textContent: 'Take control' });
    this.give = element('button', { id: 'served-give', type: 'button', textContent: 'Release control' });
    this.pause = element('button', { id: 'served-pause', type: 'button', textContent: 'Pause' });
    this.again = element('button', { id: 'served-again', type: 'button', textContent: 'Reconnect' });
    this.text = element('input', { id: 'served-text', type: 'text', maxLength: 120, placeholder: 'Message to all' });
    this.text.setAttribute('aria-label', 'Message to all');
    this.take.onclick = () => say({ type: 'take' });
    this.give.onclick = () => say({ type: 'give' });
    this.pause.onclick = () => say({ type: 'pause', on: !this.paused });
    this.again.onclick = () => reconnect();
    this.text.onkeydown = (event) => {
      event.stopPropagation(); // keys of the picture
      if (event.key !== 'Enter' || this.text.value.trim() === '') return;
      say({ type: 'message', text: this.text.value.trim() });
      this.text.value = '';
    };
    const buttons = element('div', { className: 'buttons' }, [this.take, this.give, this.pause, this.again]);
    const section = element('section', { id: 'served' }, [this.words, this.message, buttons, this.text]);
    section.setAttribute('aria-label', 'Server');
    document.querySelector('#panel h1').after(section);
    this.away('Connecting …');
    this.again.hidden = true;
  }

  /// There is no server now.
  away(words) {
    this.words.textContent = words;
    this.again.hidden = false;
    for (const part of [this.take, this.give, this.pause, this.text]) part.hidden = true;
  }

  show(hello, state) {
    this.again.hidden = true;
    const mine = state.holder === hello.you;
    const free = state.holder === 0;
    const who = mine ? 'you control the finger' : free ? 'no one controls the finger' : 'someone else controls the finger';
    const device = hello.fingers.find(({ device: words }) => words !== '')?.device;
    this.words.textContent = [
      `${WORDS[hello.role]}: ${hello.title}.`,
      device ? `A device (${device}) feels it.` : '',
      `${who[0].toUpperCase()}${who.slice(1)}${state.paused ? '; touch is paused' : ''}.`,
      `${state.onlookers} ${state.onlookers === 1 ? 'page' : 'pages'} connected.`,
    ].filter(Boolean).join(' ');
    this.paused = state.paused;
    const instructs = hello.role === 'instruct';
    this.take.hidden = hello.role === 'look' || mine || (!free && !instructs);
    this.give.hidden = !mine;
    this.pause.hidden = this.text.hidden = !instructs;
    this.pause.textContent = state.paused ? 'Resume' : 'Pause';
  }

  tell(words) {
    this.message.hidden = words === '';
    this.message.textContent = words; // never as HTML: somebody else wrote it
  }
}
