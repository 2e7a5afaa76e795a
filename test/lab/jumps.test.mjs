/* Motions with events, as the worker answers them: both sides of a jump stand in the curve with nothing between them, the table is that of the run, and what ended the run is known. Run by
 * `node --test`; the source is bundled on the way.
 * Laws: between two rows of one piece a falling ball has the slope of its acceleration; a bounce turns the velocity round by its factor, to the last bit; pieces lie between the events of
 * the table; the computed motion has the same pieces.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url), need = createRequire(new URL('package.json', lab));
const built = need('esbuild').buildSync({
  stdin: { contents: "export { Core } from './core.ts'; export { Answers, reply } from './answers.ts'; export { broken, sample, SEEN } from './sample.ts'; export { placeAt, valueAt } from './stage/rows.ts'; export { concerning } from './panel/concern.ts';", resolveDir: fileURLToPath(lab), loader: 'ts' },
  bundle: true, format: 'esm', write: false, target: 'es2022', alias: { 'ml-matrix': fileURLToPath(new URL('node_modules/ml-matrix/src/index.js', lab)) },
});
const { Core, Answers, reply, broken, sample, SEEN, placeAt, valueAt, concerning } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));
const module = new WebAssembly.Module(readFileSync(new URL('../../build/lab/motus.wasm', import.meta.url)));
const answers = new Answers(new Core(module));
const ask = (text, more = {}) => {
  const { answer, problem } = reply(answers, 1, 'solve', { model: { text, set: [] }, methods: ['verlet'], step: null, until: null, tolerance: null, columns: [], rows: 6000, truth: true, coarse: true, ...more });
  assert.equal(problem, undefined, JSON.stringify(problem));
  return answer;
};
const ball = (more = '') => `y'' = -9.81\ny(0) = 1\ny'(0) = 0\nstep 0.125\nuntil 3\nwhen y = 0 falling as bounce: y' = -0.8 y', record\n${more}`;

/** The pieces of a column between its gaps; a gap: a row of NaN between two rows of its own time. */
function pieces({ times, columns }, k) {
  const found = [[]];
  times.forEach((t, i) => {
    if (Number.isNaN(columns[k][i])) {
      assert.ok(times[i - 1] === t && times[i + 1] === t, 'a gap is at one instant');
      found.push([]);
    } else found[found.length - 1].push([t, columns[k][i]]);
  });
  return found;
}

for (const [name, methods] of [['steps of one size', ['verlet']], ['steps that adapt', ['dopri5']], ['the computed motion', ['verlet']]]) {
  test(`a velocity jumps without a slope: ${name}`, () => {
    const solution = ask(ball(), { methods }), [track] = solution.tracks, of = name === 'the computed motion' ? solution.truth : track.curve, v = solution.columns.indexOf("y'"), y = solution.columns.indexOf('y');
    const own = pieces(of, v);
    assert.equal(own.length, track.events.count + 1, 'one piece more than there are bounces');
    for (const piece of own) for (let i = 1; i < piece.length; i++) {
      const slope = (piece[i][1] - piece[i - 1][1]) / (piece[i][0] - piece[i - 1][0]);
      assert.ok(piece[i][0] > piece[i - 1][0] && Math.abs(slope + 9.81) < 1e-6 * 9.81 / (piece[i][0] - piece[i - 1][0]), `${slope} at ${piece[i][0]}`);
    }
    own.slice(1).forEach((piece, k) => {
      const before = own[k][own[k].length - 1];
      assert.equal(piece[0][0], before[0], 'both sides are at one time');
      assert.ok(Math.abs(piece[0][1] + 0.8 * before[1]) <= 1e-15 * Math.abs(before[1]) * 4, `${before[1]} became ${piece[0][1]}`);
    });
    assert.equal(pieces(of, y).length, 1, 'the place does not jump');
  });
}
test('rows that lie on an event give way to its two sides', () => {
  const text = "x'' = 0\nx(0) = 0\nx'(0) = 1\nstep 0.25\nuntil 2\nwhen every 1 as kick: x' = x' + 1, record\n", { columns, tracks: [track] } = ask(text), v = columns.indexOf("x'");
  assert.deepEqual(pieces(track.curve, v).map((piece) => piece.map(([, value]) => value)), [[1, 1, 1, 1, 1], [2, 2, 2, 2, 2], [3]]);
  const { times } = track.curve;
  assert.equal(valueAt(track.curve.columns[v], placeAt(times, 2)), 3, 'at its end it is where the last event left it');
  assert.equal(valueAt(track.curve.columns[v], placeAt(times, 1)), 2);
  assert.equal(valueAt(track.curve.columns[v], placeAt(times, 1 - 1e-9)), 1);
});
test('backward too', () => {
  const { columns, tracks: [track], truth } = ask("x'' = 0\nx(0) = 0\nx'(0) = 1\nstep 0.25\nuntil -2\nwhen x = -0.6 as wall: x' = -x', record\n"), v = columns.indexOf("x'");
  for (const of of [track.curve, truth]) assert.deepEqual(pieces(of, v).map((piece) => [...new Set(piece.map(([, value]) => Number(value.toFixed(9))))]), [[1], [-1]]);
});
test('several events at one instant are one jump', () => {
  const { columns, tracks: [track] } = ask("x[i]'' = 0 for i = 1..3\np = [0, 2, 3]\ns = [1, 0, 0]\nx[i](0) = p[i] for i = 1..3\nx[i]'(0) = s[i] for i = 1..3\nstep 0.3\nuntil 2\nwhen x[i+1] - x[i] = 1 falling as contact: x[i]' = x[i+1]', x[i+1]' = x[i]', record for i = 1..2\n");
  assert.deepEqual([...track.events.names], ['contact[1]', 'contact[2]']);
  assert.equal(pieces(track.curve, columns.indexOf("x[1]'")).length, 2);
  assert.equal(pieces(track.curve, columns.indexOf("x[2]'")).length, 1, 'what it came to and what it left are the same');
  assert.equal(pieces(track.curve, columns.indexOf("x[3]'")).length, 2);
});
test('an event concerns the numbers of the bodies that it changes', () => {
  const of = (text, more) => { const solution = ask(text, more), { events } = solution.tracks[0], { description } = solution; return (...names) => [...events.names].filter((_, row) => concerning({ description, solution }, events, names)(row)); };
  const cradle = of(readFileSync(new URL('../../models/newtons-cradle.motus', import.meta.url), 'utf8')), all = ['contact[1]', 'contact[2]', 'contact[3]'];
  for (const name of ['x[1]', "x[1]'"]) assert.deepEqual(cradle(name), all.slice(0, 1));
  for (const name of ['x[4]', "x[4]'"]) assert.deepEqual(cradle(name), all.slice(2));
  assert.deepEqual(cradle('x[2]'), all.slice(0, 2));
  assert.deepEqual(cradle('x[1]', "x[4]'"), [all[0], all[2]], 'a plane has the events of both its axes');
  assert.deepEqual(cradle('energy'), [], 'what is exchanged stays');
  const bounces = of(ball());
  for (const name of ['y', "y'"]) assert.ok(bounces(name).length > 5 && bounces(name).every((event) => event === 'bounce'));
  const belt = of(readFileSync(new URL('../../models/stick-slip.motus', import.meta.url), 'utf8'), { methods: ['gauss8'] });
  for (const name of ['x', "x'", 'stuck']) assert.deepEqual(belt(name).slice(0, 2), ['slip', 'stick'], `a mode is no number of the state, so its events concern all: ${name}`);
  const plane = of("r'' = (0, -1)\nr(0) = (0, 1)\nr'(0) = (1, 0)\nstep 0.1\nuntil 3\nwhen r.y = 0 falling as ground: r'.y = -r'.y, record\nwhen r.x = 1 as line: record\n");
  assert.deepEqual([...new Set(plane('r.x'))].sort(), ['ground', 'line'], 'both coordinates are one body');
});
test('what ends a run', () => {
  const stopped = ask(ball('when y = 0.5 rising as half: stop\n')), [track] = stopped.tracks;
  assert.equal(track.ended.ended, 'half');
  assert.equal(track.problem, null);
  assert.ok(Math.abs(stopped.truth.times[stopped.truth.times.length - 1] - track.times[track.times.length - 1]) < 1e-12, 'the computed motion ends there too');
  const still = ask(ball().replace('until 3', 'until 5')).tracks[0];
  assert.ok(Math.abs(still.ended.accumulated.time - 4.063712768871578) <= still.ended.accumulated.error, JSON.stringify(still.ended));
  assert.equal(still.ended.accumulates, 'bounce');
  assert.equal(ask(ball()).tracks[0].ended, null);
});
test('a touch is told, and what only records leaves one curve', () => {
  const { columns, tracks: [track] } = ask("x'' = 2\nx(0) = 1\nx'(0) = -2\nstep 0.25\nuntil 3\nwhen x = 0 as graze: record\nwhen x = 1 rising as up: record\n");
  assert.deepEqual([...track.events.names, ...track.events.touched], ['graze', 'up', 1, 0]);
  assert.equal(track.events.changed.some(Boolean), false);
  for (let k = 0; k < columns.length; k++) assert.equal(pieces(track.curve, k).length, 1);
});
test('a mode is a number to look at, not a coordinate', () => {
  const { columns, description, tracks: [track] } = ask(`n = 0\n${ball('when y = 0.3 rising as tick: n = n + 1\n')}`);
  assert.equal(description.columns.find(({ name }) => name === 'n').kind, 'quantity');
  assert.equal(description.variables.some(({ name }) => name === 'n'), false);
  assert.ok(description.parameters.some(({ name }) => name === 'n'), 'its start can be set');
  assert.equal(track.columns[columns.indexOf('n')].at(-1), 2);
});
test('a hostile model ends with a sentence', () => {
  const { tracks: [track] } = ask("x'' = 0\nx(0) = 0\nx'(0) = 1\nstep 0.25\nuntil 2\nwhen x = 1 rising: x = 0.5\n");
  assert.ok(track.problem === null || track.problem.message, 'it ends');
  const falling = "y'' = -1\ny(0) = 1\ny'(0) = 0\nstep 0.25\nuntil 3\n", endless = ask(`${falling}when y = 0 falling as bounce: y' = -y'\nwhen y' > 0 as back: y' = -y'\n`).tracks[0];
  assert.equal(endless.problem.kind, 'events');
  assert.match(endless.problem.message, /bounce|back/);
  // Its action does not turn it round, so it has passed: once, and falls on.
  const through = ask(`${falling}when y = 0 falling as bounce: y' = 2 y', record\n`).tracks[0];
  assert.equal(through.problem, null);
  assert.equal(through.events.count, 1);
});
test('a curve is sampled in pieces', () => {
  let asked = 0;
  const motion = {
    from: 0, to: 2, slopes: [1, -1], noise: [0, 0], breaks: { times: [1], before: [Float64Array.of(1), Float64Array.of(1)], after: [Float64Array.of(1), Float64Array.of(-1)] },
    ask: (times) => { asked += times.length; return [Float64Array.from(times, (t) => (t < 1 ? t : 2 - t)), Float64Array.from(times, (t) => (t < 1 ? 1 : -1))]; },
  };
  const curve = sample(motion, { tolerance: SEEN, points: 20000, milliseconds: 10000 });
  assert.ok(asked < 1400, `straight pieces need no more than a look: ${asked}`);
  assert.deepEqual(pieces(curve, 1).map((piece) => [...new Set(piece.map(([, v]) => v))]), [[1], [-1]]);
  assert.equal(broken(curve, { times: [], before: [], after: [] }, true).times.length, curve.times.length);
});

const star = readFileSync(new URL('../../models/henon-heiles.motus', import.meta.url), 'utf8');
const asked = (kind, question, of = answers) => { const { answer, problem } = reply(of, 1, kind, question); if (problem) throw new Error(problem.message); return answer; };
const cut = { model: { text: star, set: [], when: ['x = 0 rising as section: record'] }, method: 'pefrl', step: 0.05, tolerance: null, from: [0, -0.25, 0.42, 0], kind: 'section', columns: ['x', 'y', "x'", "y'"], have: 0, most: 60, milliseconds: 1e5 };
const energy = ([x, y, u, v]) => (u * u + v * v + x * x + y * y) / 2 + x * x * y - y ** 3 / 3;

test('a section that is filled in pieces is that of one run, also when the worker has been replaced', () => {
  const whole = asked('section', cut), rows = (columns) => columns[0].length;
  assert.equal(rows(whole.columns), 60);
  assert.ok(whole.columns[0].every((x) => Math.abs(x) < 1e-14) && whole.columns[2].every((u) => u > 0), 'x = 0, rising');
  const table = ask(star + 'when x = 0 rising as section: record\n', { methods: ['pefrl'], truth: false }).tracks[0].events;
  table.before[2].forEach((y, i) => assert.equal(whole.columns[1][i], y, 'the same numbers as the table of a run'));
  let other = answers;
  for (let have = 0, turn = 0; have < 60; turn++) {
    // A fresh one knows of nothing.
    if (turn === 2) other = new Answers(new Core(module));
    const { columns } = asked('section', { ...cut, have, most: Math.min(60, have + 17) }, other);
    columns.forEach((column, k) => column.forEach((value, i) => assert.equal(value, whole.columns[k][have + i])));
    have += rows(columns);
  }
});
test('through a point of the plane: on the section, with the energy, or nowhere', () => {
  const through = (values) => asked('through', { model: { text: star, set: [] }, near: [0, -0.25, 0.42, 0], columns: ['y', "y'"], values, surface: '(x) - (0)', keep: [{ name: 'energy', value: energy([0, -0.25, 0.42, 0]) }] });
  const state = through([0.1, 0.2]);
  assert.ok(Math.abs(state[0]) < 1e-12 && Math.abs(state[1] - 0.1) < 1e-12 && Math.abs(state[3] - 0.2) < 1e-12 && state[2] > 0, String(state));
  assert.ok(Math.abs(energy(state) - energy([0, -0.25, 0.42, 0])) < 1e-14);
  assert.throws(() => through([0.1, 0.6]), /No motion with this energy passes there/);
});
test('what is wrong with its condition is told', () => {
  assert.throws(() => asked('section', { ...cut, model: { ...cut.model, when: ['x = 0 sinking as section: record'] } }), /sinking/);
  assert.throws(() => asked('section', { ...cut, model: { ...cut.model, when: ['q = 0 as section: record'] } }), /q/);
});
