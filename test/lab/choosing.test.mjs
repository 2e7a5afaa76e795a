/* Methods that choose their steps, as the worker tells them (lab/answers.ts, lab/tolerances.ts), by the module of build/lab. Run by `node --test`.
 * Laws: the line between the ends of long steps is within half a pixel of dense output, and holds these ends; what an accuracy finds is found once, and is a run like any other; errors at
 * tolerances are those of the exact motion, in units of how far it moves, and their counts are the program's.
 */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url), root = new URL('../../', import.meta.url), program = process.env.MOTUS ?? fileURLToPath(new URL('build/motus', root));
const { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const built = buildSync({ stdin: { contents: `export * from './core'; export * from './answers'; export * from './tolerances';`, resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022', platform: 'node' });
const { Core, Answers, powerOf } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));
const module = new WebAssembly.Module(readFileSync(new URL('build/lab/motus.wasm', root)));

const WIDTH = 4000, preset = (name) => readFileSync(new URL(`models/${name}.motus`, root), 'utf8');
const question = (text, part = {}) => ({ model: { text, set: [] }, methods: ['dopri5'], step: null, tolerance: null, until: null, columns: [], rows: 6000, truth: true, ...part });
const spring = "x'' = -x\nx(0) = 1\nx'(0) = 0\n";

for (const [name, method, tolerance, set] of [['kepler', 'dopri5', 1e-2, []], ['kepler', 'dep12', 1e-6, []], ['kepler', 'dop853', 1e-6, ['until=-20']], ['driven-oscillator', 'dop853', 1e-4, []], ['double-pendulum', 'verner7', 1e-5, []]]) {
  test(`the line of ${method} on ${name}${set}`, () => {
    const text = preset(name), until = set.length ? -20 : null, answers = new Answers(new Core(module)), { tracks: [track], columns } = answers.answer('solve', question(text, { methods: [method], tolerance, until, truth: false }));
    const { curve, times } = track, core = new Core(module), of = core.create(), way = Math.sign(times[times.length - 1] - times[0]);
    assert.ok(curve && curve.times.length > 2 * times.length, `${times.length} rows, ${curve?.times.length} in the line`);
    assert.ok(curve.times.every((t, i) => i === 0 || way * (t - curve.times[i - 1]) > 0));
    core.open(of, { text, set: [] });
    const known = core.describe(of).columns, drawn = known.flatMap(({ kind }, k) => (/^(position|velocity|first-order|quantity)$/.test(kind) ? [k] : []));
    for (const k of known.keys()) assert.equal(curve.columns[k].length > 0, k === 0 || drawn.includes(k), columns[k]);
    // The ends of the steps, bit for bit.
    const at = new Map(Array.from(curve.times, (t, i) => [t, i]));
    times.forEach((t, row) => { for (const k of drawn) assert.equal(curve.columns[k][at.get(t)], track.columns[k][row]); });
    // Dense output within each piece.
    const between = Float64Array.from(curve.times.subarray(1), (t, i) => curve.times[i] + 0.37 * (t - curve.times[i]));
    core.start(of, method, null, until, tolerance);
    const exact = core.sample(of, between, drawn);
    drawn.forEach((k, c) => {
      const line = curve.columns[k], low = Math.min(...line), high = Math.max(...line);
      if (!(high - low > 1e-3 * Math.max(Math.abs(low), Math.abs(high)))) return; // it is kept, and moves by errors alone
      const most = between.reduce((m, _, i) => Math.max(m, Math.abs(exact[i * drawn.length + c] - line[i] - 0.37 * (line[i + 1] - line[i]))), 0) / (high - low) * WIDTH;
      assert.ok(most < 0.5, `${columns[k]}: the line is ${most} pixels off`);
    });
  });
}

test('methods of steps of one size have no other line than their steps', () => {
  assert.equal(new Answers(new Core(module)).answer('solve', question(preset('kepler'), { methods: ['verlet'] })).tracks[0].curve, null);
});

test('an accuracy is reached by a run like any other', () => {
  const answers = new Answers(new Core(module)), text = `${spring}until 100\n`, aim = { accuracy: 1e-9, absolute: false, at: ['auto', 'dop853'] };
  const { tracks } = answers.answer('solve', question(text, { methods: ['auto', 'dop853', 'rk4'], step: 0.1, aim }));
  assert.deepEqual(tracks.map((t) => t.goal !== null), [true, true, false]);
  for (const { method, goal, tolerance, times, columns } of tracks.slice(0, 2)) {
    assert.ok(goal.missed === null && goal.reached <= 1e-9 && goal.trials >= 1, JSON.stringify(goal));
    assert.equal(goal.choice !== '', method !== 'dop853');
    // Its bar is above its error.
    assert.ok(times.every((t, i) => Math.abs(columns[1][i] - Math.cos(t)) <= goal.reached + 1e-15));
    const [same] = answers.answer('solve', question(text, { methods: [method], tolerance })).tracks;
    assert.deepEqual(same.columns, columns);
  }
  // The same method twice is one line.
  const twice = answers.answer('solve', question(text, { methods: ['auto', tracks[0].method], aim: { ...aim, at: ['auto', tracks[0].method] } }));
  assert.deepEqual(twice.tracks.map((t) => t.method), [tracks[0].method]);
});

test('what cannot be promised is said, and drawn nevertheless', () => {
  const text = "x'' = -1/(x*x)\nx(0) = 1\nx'(0) = -1\nuntil 0.3\n", tight = { accuracy: 1e-15, absolute: false, at: ['dop853'] };
  const { tracks: [track] } = new Answers(new Core(module)).answer('solve', question(text, { methods: ['dop853'], aim: tight }));
  assert.ok(track.goal.missed?.kind === 'accuracy' && /1e-15 is not reached: the trials reached/.test(track.goal.missed.message), JSON.stringify(track.goal));
  assert.ok(track.times.length > 2 && track.problem === null);
});

test('errors at tolerances are those of the exact motion', () => {
  const folder = mkdtempSync(join(tmpdir(), 'motus-choosing-')), text = `${spring}until 20\nexact x = cos(t)\n`, file = join(folder, 'spring.motus');
  writeFileSync(file, text);
  try {
    const { rows: [row, fixed] } = new Answers(new Core(module)).answer('converge', { model: { text, set: [] }, methods: ['dopri5', 'rk4'], step: null, until: null });
    assert.equal(fixed.method, 'rk4');
    assert.ok(fixed.observed > 3.9 && fixed.power === undefined);
    const until = new Answers(new Core(module)).answer('converge', { model: { text, set: [] }, methods: ['rk4'], step: null, until: null }).reference, end = Number(/; until (\S+), not /.exec(until)?.[1] ?? 20);
    const point = row.points.find((p) => p.tolerance === 1e-6), states = Array.from({ length: 8 }, (_, k) => {
      const t = end * (k + 1) / 8, told = JSON.parse(execFileSync(program, ['run', file, '--method', 'dopri5', '--tolerance', '1e-6', '--until', String(t), '--json'], { encoding: 'utf8' }));
      return { t, x: told.state.x, v: told.state["x'"], evaluations: told.evaluations, steps: told.steps };
    });
    // x and x' of the exact motion at these times, and how far each moves there.
    const moves = (f) => { const all = [0, ...states.map(({ t }) => t)].map(f); return Math.max(...all) - Math.min(...all); };
    const error = Math.max(...states.map(({ t, x, v }) => Math.max(Math.abs(x - Math.cos(t)) / moves(Math.cos), Math.abs(v + Math.sin(t)) / moves(Math.sin))));
    assert.ok(Math.abs(point.error / error - 1) < 1e-6, `${point.error} ${error}`);
    assert.equal(point.evaluations, states[7].evaluations);
    assert.ok(Math.abs(point.step * states[7].steps / end - 1) < 1e-12);
    for (let k = 1; k < row.points.length; k++) assert.ok(row.points[k].evaluations > row.points[k - 1].evaluations && row.points[k].tolerance < row.points[k - 1].tolerance);
    // By local extrapolation the error of a step is as its estimate to the power 6/5 of it, and there are as many steps as the tolerance to the power -1/5: the error falls with the tolerance itself.
    assert.ok(row.power > 0.8 && row.power < 1.1, row.power);
    assert.ok(Math.abs(powerOf([1e-3, 1e-4, 1e-5].map((tolerance) => ({ tolerance, error: 7 * tolerance ** 0.75 }))) - 0.75) < 1e-12);
    assert.equal(powerOf([{ tolerance: 1, error: 1 }]), null);
  } finally {
    rmSync(folder, { recursive: true });
  }
});
