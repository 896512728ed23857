// The keys of the page: what they are called and what they do. Those of the viewer (docs/reference/viewer.md)
// do the same here.

const STEP_MM = 2;
const TURN_PX = 15; // as dragging by so many pixels
const ZOOM = 1.1;

/// `page`: fingers, moveOnSkin(right_mm, up_mm), pressHere(), liftHere(), toggleHold(), toggleTurn(), toggleColour(name),
/// toggle(input id), markHere(), look(right, up, shifts) in pixels, lookHere(), readOut(), search(), escape(), camera.
/// A key is [names, meaning, act, and what letting it go does, if anything].
export function keysOf(page) {
  const { fingers } = page;
  const step = (event) => (event.shiftKey ? 0.5 : STEP_MM);
  const deeper = (event, sign) => fingers.deeper(fingers.active, sign * (event.shiftKey ? 0.1 : 0.5));
  const arrow = (right, up) => (e) => {
    if (page.turning()) page.look(right * TURN_PX, up * TURN_PX, e.shiftKey);
    else page.moveOnSkin(right * step(e), up * step(e));
  };
  return [
    [['Enter'], 'Put the finger on the skin and keep it pressed; press again to lift it', () => page.toggleHold()],
    [[' '], 'Press while the key is down', () => page.pressHere(), () => page.liftHere()],
    [['ArrowLeft'], 'Move the finger 2 mm to the left; with Shift 0.5 mm', arrow(-1, 0)],
    [['ArrowRight'], 'Move it to the right', arrow(1, 0)],
    [['ArrowUp'], 'Move it up', arrow(0, 1)],
    [['ArrowDown'], 'Move it down', arrow(0, -1)],
    [['PageDown', ']'], 'Press 0.5 mm deeper; with Shift 0.1 mm', (e) => deeper(e, 1)],
    [['PageUp', '['], 'Press less deep', (e) => deeper(e, -1)],
    [['1'], 'Use the left finger', () => fingers.choose(0)],
    [['2'], 'Use the right finger', () => fingers.choose(1)],
    [['Backspace'], 'Lift both fingers', () => [0, 1].forEach((finger) => fingers.leave(finger))],
    [['q'], 'Read out force, depth and place', () => page.readOut()],
    [['t'], 'Turn the body with the arrow keys, or move it with Shift; press again to move the finger', () => page.toggleTurn()],
    [['+', '='], 'Zoom in', () => page.camera.zoom(1 / ZOOM)],
    [['-'], 'Zoom out', () => page.camera.zoom(ZOOM)],
    [['f'], 'Look closely at the place under the finger', () => page.lookHere()],
    [['v'], 'Show the next view; with Shift the previous one', (e) => page.camera.nextView(e.shiftKey ? -1 : 1)],
    [['Home'], 'Show the whole body', () => page.camera.home()],
    [['/'], 'Search for a place', () => page.search()],
    [['s'], 'Colour the skin by strain; press again to stop', () => page.toggleColour('strain')],
    [['m'], 'Colour the skin by stiffness; press again to stop', () => page.toggleColour('stiffness')],
    [['o'], 'Show the bones through the skin', () => page.toggle('bones')],
    [['i'], 'Show the names of places', () => page.toggle('places')],
    [['x'], 'In the game: mark the place under the finger', () => page.markHere()],
    [['Escape'], 'Close a message; leave the search; stop marking', () => page.escape()],
    [['Tab'], 'Go to the next control', null],
  ];
}

const SHOWN = { ' ': 'Space', Escape: 'Esc', ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓', PageDown: 'PgDn', PageUp: 'PgUp' };

/// Fills the list and listens. Keys mean this only while the picture has them, or nothing has.
export function listen(keys, list, picture) {
  for (const [names, meaning] of keys) {
    const dt = document.createElement('dt');
    dt.textContent = names.map((name) => SHOWN[name] ?? (name.length === 1 ? name.toUpperCase() : name)).join(' ');
    const dd = document.createElement('dd');
    dd.textContent = meaning;
    list.append(dt, dd);
  }
  const keyOf = (event) => {
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    return keys.find(([names, , act]) => act && names.includes(name));
  };
  const down = new Map(); // of those that do something when they are let go
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (document.activeElement !== picture && document.activeElement !== document.body) return;
    picture.classList.remove('by-pointer');
    const key = keyOf(event);
    if (!key) return;
    event.preventDefault();
    if (key[3] && event.repeat) return;
    if (key[3]) down.set(event.key, key[3]);
    key[2](event);
  });
  const release = (name) => {
    down.get(name)?.();
    down.delete(name);
  };
  addEventListener('keyup', (event) => release(event.key));
  addEventListener('blur', () => [...down.keys()].forEach(release));
}
