// The smallest whole program: a fingertip presses the trunk over T6, holds, and drags towards the head.
//
//   node node_modules/palpate/examples/press.mjs
import { load } from 'palpate';

const palpate = await load();
const body = await palpate.openTrunk();
const { at, normal } = palpate.place('T6');
console.log(`${body.name}: ${body.corners.length / 3} triangles, ${body.landmarks.length} places`);

palpate.aim(0, { place: at, normal, depth: 12, pressed: true });
for (let tenth = 1; tenth <= 6; ++tenth) {
  palpate.run(100); // ticks of a millisecond
  const { depth, force } = palpate.felt(0);
  console.log(`${tenth / 10} s: ${depth.toFixed(2)} mm deep, ${Math.hypot(...force).toFixed(2)} N`);
}

palpate.aim(0, { place: [at[0], at[1] + 10, at[2]], normal, depth: 12, pressed: true });
palpate.run(200);
const felt = palpate.felt(0);
console.log(`dragged: the skin ${['is free', 'sticks', 'slips'][felt.touch]}`);

const frame = palpate.frame(true); // the skin: 7 numbers a vertex, its position first
let farthest = 0;
for (let i = 0; i < frame.values.length; i += 7) {
  farthest = Math.max(farthest, Math.hypot(...[0, 1, 2].map((axis) => frame.values[i + axis] - body.rest[i + axis])));
}
console.log(`the skin gives way by up to ${farthest.toFixed(2)} mm`);
console.log(`force ${felt.force.join(' ')} N`);
