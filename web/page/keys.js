// The keys of the page: what they are called and what they do. Those of the viewer (docs/reference/viewer.md)
// do the same here.

const STEP_MM = 2;

/// `page`: fingers, moveOnSkin(right_mm, up_mm), toggleTurn(), toggleColour(name), toggle(input id), markHere(), camera.
export function keysOf(page) {
  const { fingers } = page;
  const step = (event) => (event.shiftKey ? 0.5 : STEP_MM);
  const deeper = (event, sign) => fingers.deeper(fingers.active, sign * (event.shiftKey ? 0.1 : 0.5));
  return [
    [['Enter'], 'Keep the finger pressed; again: lift it', () => fingers.toggleHold(fingers.active)],
    [['PageDown', ']'], 'Deeper', (e) => deeper(e, 1)],
    [['PageUp', '['], 'Less deep', (e) => deeper(e, -1)],
    [['ArrowLeft'], 'Finger to the left', (e) => page.moveOnSkin(-step(e), 0)],
    [['ArrowRight'], 'Finger to the right', (e) => page.moveOnSkin(step(e), 0)],
    [['ArrowUp'], 'Finger up', (e) => page.moveOnSkin(0, step(e))],
    [['ArrowDown'], 'Finger down', (e) => page.moveOnSkin(0, -step(e))],
    [['1'], 'Left finger', () => fingers.choose(0)],
    [['2'], 'Right finger', () => fingers.choose(1)],
    [['Backspace'], 'Lift every finger', () => [0, 1].forEach((finger) => fingers.leave(finger))],
    [['Home'], 'The whole body', () => page.camera.home()],
    [['v'], 'The next view', (e) => page.camera.nextView(e.shiftKey ? -1 : 1)],
    [['s'], 'Colour by strain', () => page.toggleColour('strain')],
    [['m'], 'Colour by stiffness', () => page.toggleColour('stiffness')],
    [['o'], 'Bones through the skin', () => page.toggle('bones')],
    [['i'], 'Names of places', () => page.toggle('places')],
    [['t'], 'Turn the body by the left button', () => page.toggleTurn()],
    [['x'], 'In the game: mark the place under the finger', () => page.markHere()],
    [['Tab'], 'The controls, one after the other', null],
  ];
}

const SHOWN = { ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓', PageDown: 'PgDn', PageUp: 'PgUp' };

/// Fills the list and listens. Keys mean this only while the picture has them, or nothing has.
export function listen(keys, list, picture) {
  for (const [names, meaning] of keys) {
    const dt = document.createElement('dt');
    dt.textContent = names.map((name) => SHOWN[name] ?? (name.length === 1 ? name.toUpperCase() : name)).join(' ');
    const dd = document.createElement('dd');
    dd.textContent = meaning;
    list.append(dt, dd);
  }
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (document.activeElement !== picture && document.activeElement !== document.body) return;
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const key = keys.find(([names, , act]) => act && names.includes(name));
    if (!key) return;
    event.preventDefault();
    key[2](event);
  });
}
