// The pressure under the fingertips as heat maps with a scale, beside the picture. Not drawn by the graphics card: few
// squares, twenty times a second.

const SIDE = 96; // of a map, CSS pixels
const NAMES = ['Left finger', 'Right finger'];
const TOPS_KPA = [5, 10, 20, 50, 100, 200, 500, 1000];
const RAMP = [[0, 0, 0], [58, 15, 110], [150, 40, 100], [230, 92, 48], [250, 180, 30], [252, 255, 164]];

/// Of a share of the scale, 0 to 1.
function colourOf(share) {
  const at = Math.max(0, Math.min(1, share)) * (RAMP.length - 1);
  const i = Math.min(RAMP.length - 2, Math.floor(at));
  const mixed = RAMP[i].map((from, channel) => Math.round(from + (RAMP[i + 1][channel] - from) * (at - i)));
  return `rgb(${mixed.join(' ')})`;
}

export class Pads {
  constructor(box) {
    this.box = box;
    this.top = TOPS_KPA[0];
    this.maps = NAMES.map((name) => {
      const figure = document.createElement('figure');
      const canvas = document.createElement('canvas');
      const words = document.createElement('figcaption');
      canvas.width = canvas.height = SIDE * 2;
      canvas.setAttribute('role', 'img');
      figure.append(canvas, words);
      figure.hidden = true;
      box.append(figure);
      return { name, figure, canvas, words };
    });
    this.scale = document.createElement('figure');
    this.bar = document.createElement('canvas');
    [this.bar.width, this.bar.height] = [12, SIDE];
    this.bar.setAttribute('aria-hidden', 'true');
    this.high = document.createElement('span');
    const low = Object.assign(document.createElement('span'), { textContent: '0 kPa' });
    const words = document.createElement('figcaption');
    words.append(this.high, low);
    this.scale.className = 'scale';
    this.scale.append(this.bar, words);
    box.append(this.scale);
    const context = this.bar.getContext('2d');
    for (let y = 0; y < SIDE; ++y) {
      context.fillStyle = colourOf(1 - y / (SIDE - 1));
      context.fillRect(0, y, 12, 1);
    }
  }

  /// `pads`: {taxels, kpa: of each finger its taxels, row by row, the first row nearest to the head, or null}, or null.
  show(pads) {
    this.box.hidden = !pads;
    if (!pads || pads === this.shown) return;
    this.shown = pads;
    const highest = pads.kpa.map((kpa) => (kpa ? Math.max(...kpa) : 0));
    const most = Math.max(...highest);
    const wanted = TOPS_KPA.find((kpa) => kpa >= most) ?? most;
    // A scale that went down under a finger would make a lighter press look like a harder one.
    this.top = most === 0 ? TOPS_KPA[0] : Math.max(this.top, wanted);
    this.high.textContent = `${this.top} kPa`;
    this.maps.forEach(({ name, figure, canvas, words }, finger) => {
      const kpa = pads.kpa[finger];
      figure.hidden = !kpa;
      if (!kpa) return;
      this.draw(canvas, kpa, pads.taxels);
      words.textContent = `${name}: ${highest[finger].toFixed(0)} kPa`;
      canvas.setAttribute('aria-label', `Pressure under the ${name.toLowerCase()}, highest ${highest[finger].toFixed(0)} kilopascal`);
    });
  }
  draw(canvas, kpa, taxels) {
    const context = canvas.getContext('2d');
    const cell = canvas.width / taxels;
    for (let row = 0; row < taxels; ++row) {
      for (let column = 0; column < taxels; ++column) {
        context.fillStyle = colourOf(kpa[row * taxels + column] / this.top);
        context.fillRect(Math.floor(column * cell), Math.floor(row * cell), Math.ceil(cell), Math.ceil(cell));
      }
    }
  }
}
