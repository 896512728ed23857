// What the colours of the skin mean.

const WORDS = {
  strain: { title: 'Strain of the skin', low: (x) => `${x.toFixed(0)} % shorter`.replace('-', ''), high: (x) => `${x.toFixed(0)} % longer` },
  stiffness: { title: 'Stiffness', low: (x) => `${x.toFixed(2)} N/mm`, high: (x) => `${x.toFixed(2)} N/mm` },
};

export class Legend {
  constructor() {
    const element = (id) => document.getElementById(id);
    this.box = element('legend');
    this.bar = element('legend-bar');
    this.parts = { title: element('legend-title'), high: element('legend-high'), low: element('legend-low') };
  }
  /// `colours`: 256 of four bytes; `range`: low and high end.
  show(name, colours, range) {
    const words = WORDS[name];
    this.box.hidden = !words;
    if (!words) return;
    const context = this.bar.getContext('2d');
    const { width, height } = this.bar;
    for (let y = 0; y < height; ++y) {
      const i = 4 * Math.round((255 * (height - 1 - y)) / (height - 1));
      context.fillStyle = `rgb(${colours[i]}, ${colours[i + 1]}, ${colours[i + 2]})`;
      context.fillRect(0, y, width, 1);
    }
    this.parts.title.textContent = words.title;
    this.parts.low.textContent = words.low(range[0]);
    this.parts.high.textContent = words.high(range[1]);
  }
}
