// Places in words, and words for places: "T6", "left PSIS", "left site 4", "T6 right 30 mm".
//
// The names are those that a body brings (Body.landmarks); the rules are those of engine/core/palpate/body/places.cpp, so that a
// served body, of which the page has the landmarks only, is searched in the same way.

const DIRECTIONS = { right: [1, 0], left: [-1, 0], up: [0, 1], down: [0, -1], cranial: [0, 1], caudal: [0, -1] };
const SAY_NOTHING = ['spinous', 'process', 'the'];
const LEVELS_FIRST = 0.5; // a spinous process counts as half as far: examiners think in levels
const AT_MM = 4; // nearer than a finger's pad is there
const SUGGESTIONS = 3; // for a misspelt name
const COMPLETIONS = 4; // for one that is being typed
const SITE_LEVELS = ['T4', 'T6', 'T8', 'T10', 'T12', 'L2']; // of the twelve training sites, on both sides
const SITE_BESIDE_MM = 30;

const wordsOf = (text) => text.toLowerCase().split(/[\s,_]+/).filter(Boolean);
const inOrder = (words) => words.filter((word) => !SAY_NOTHING.includes(word)).sort().join(' ');

/// {name: words, by: [right, up]}: the distances taken away from the words.
function withoutDistances(words) {
  const moved = { name: [], by: [0, 0], as_written: '' };
  for (let i = 0; i < words.length; ++i) {
    const direction = DIRECTIONS[words[i]];
    const distance = direction && /^\d+(\.\d+)?(mm)?$/.test(words[i + 1] ?? '') ? parseFloat(words[i + 1]) : null;
    if (distance === null) {
      moved.name.push(words[i]);
      continue;
    }
    moved.by = moved.by.map((sum, axis) => sum + distance * direction[axis]);
    moved.as_written += ` ${words[i]} ${distance} mm`;
    i += words[i + 2] === 'mm' ? 2 : 1;
  }
  return moved;
}

/// Sites 1 to 6 from the highest level down, left and right, where the body has the level.
function sitesOf(landmarks) {
  return SITE_LEVELS.flatMap((level, i) => {
    const spine = landmarks.find(({ name }) => name === level);
    if (!spine) return [];
    const site = (side, aside) => ({ name: `${side} site ${i + 1}`, at: [spine.at[0] + aside, spine.at[1], spine.at[2]], normal: spine.normal });
    return [site('left', -SITE_BESIDE_MM), site('right', SITE_BESIDE_MM)];
  });
}
const allOf = (landmarks) => [...landmarks, ...sitesOf(landmarks)];

/// {name, at, normal}, or null where nothing is called so. Moved places lie over or under the skin.
export function placeNamed(landmarks, text) {
  const { name, by, as_written } = withoutDistances(wordsOf(text));
  const wanted = inOrder(name);
  const found = allOf(landmarks).find((place) => inOrder(wordsOf(place.name)) === wanted);
  if (!found) return null;
  const [x, y, z] = found.at;
  return { name: found.name + as_written, at: [x + by[0], y + by[1], z], normal: found.normal };
}

/// A few names that have every word that was typed, those that begin with it first: for "site 4" both of them.
export function namesLike(landmarks, text) {
  const typed = text.trim().toLowerCase();
  const words = typed.split(/\s+/).filter(Boolean);
  if (words.length === 0) return [];
  const like = allOf(landmarks).map(({ name }) => name).filter((name) => words.every((word) => name.toLowerCase().includes(word)));
  const begins = (name) => (name.toLowerCase().startsWith(typed) ? 0 : 1);
  return like.sort((a, b) => begins(a) - begins(b)).slice(0, COMPLETIONS);
}

/// Letters to insert, remove or replace until one text is the other (Levenshtein 1966).
function editDistance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 0; i < a.length; ++i) {
    const next = [i + 1];
    for (let j = 0; j < b.length; ++j) next.push(Math.min(row[j] + (a[i] === b[j] ? 0 : 1), next[j] + 1, row[j + 1] + 1));
    row = next;
  }
  return row.at(-1);
}

/// Up to three names that are near in spelling, the nearest first.
export function namesNear(landmarks, text) {
  const words = withoutDistances(wordsOf(text.slice(0, 64))).name;
  const written = words.join(' ');
  if (written === '') return [];
  const most = Math.max(2, Math.ceil(written.length / 3));
  return allOf(landmarks)
    .map(({ name }) => {
      const known = wordsOf(name);
      return { name, away: Math.min(editDistance(written, known.join(' ')), editDistance(inOrder(words), inOrder(known))) };
    })
    .filter(({ name, away }) => away <= most && away < Math.max(written.length, name.length))
    .sort((a, b) => a.away - b.away)
    .slice(0, SUGGESTIONS)
    .map(({ name }) => name);
}

/// "T6", "T6, 12 mm right and 8 mm up": from the landmark that an examiner would start from. '' without landmarks.
export function inWords(landmarks, place) {
  const off = (landmark) => landmark.at.map((x, axis) => place[axis] - x);
  const far = (landmark) => Math.hypot(...off(landmark)) * (/^[CTLS]\d+$/.test(landmark.name) ? LEVELS_FIRST : 1);
  let nearest = null;
  for (const landmark of landmarks) if (nearest === null || far(landmark) < far(nearest)) nearest = landmark;
  if (nearest === null) return '';
  const part = (along, positive, negative) => (Math.abs(along) < AT_MM ? [] : [`${Math.abs(along).toFixed(0)} mm ${along > 0 ? positive : negative}`]);
  const [dx, dy] = off(nearest);
  const parts = [...part(dx, 'right', 'left'), ...part(dy, 'up', 'down')].join(' and ');
  return nearest.name + (parts ? `, ${parts}` : '');
}
