/* The exact motion as the worker tells it (lab/answers.ts, lab/draft.ts), by the module of build/lab. Run by `node --test`.
 * Laws: a draft is within a quarter of a pixel of the reference, brings no errors, and changes none; straight lines between the times are within half a
 * pixel of the reference at times between them; a draft that misses a force is not shown.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url), root = new URL('../../', import.meta.url);
const { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const contents = `export * from './core'; export * from './answers';`;
const built = buildSync({ stdin: { contents, resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022', platform: 'node' });
const { Core, Answers } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));
const module = new WebAssembly.Module(readFileSync(new URL('build/lab/motus.wasm', root)));

const WIDTH = 4000;
/* So short that the steps of a draft miss it. */
const kick = "x'' = -x + 5e5 exp(-((t - 5.003)/1e-6)^2)\nx(0) = 1\nx'(0) = 0\nstep 0.05\nuntil 10\n";
const preset = (name) => readFileSync(new URL(`models/${name}.motus`, root), 'utf8');
const question = (text, part = {}) => ({ model: { text, set: [] }, methods: ['rk4'], step: null, until: null, columns: [], rows: 6000, truth: true, ...part });
const range = (column) => column.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
/** By how many pixels q is off p, which is drawn; a column that rests has no pixels. */
function apart(p, q) {
  const [low, high] = range(p);
  if (!(high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high)))) return 0;
  return p.reduce((most, v, i) => Math.max(most, Math.abs(v - q[i])), 0) / (high - low) * WIDTH;
}
/** The reference itself, at any times. */
function reference(text, until = null) {
  const core = new Core(module), of = core.create();
  core.open(of, { text, set: [] });
  core.reference(of, null, until);
  const nx = core.positions(of), nv = core.velocities(of);
  return (times) => {
    const { x, v } = core.referenceAt(of, times), pick = (from, width, k) => Float64Array.from({ length: times.length }, (_, i) => from[i * width + k]);
    return [...Array.from({ length: nx }, (_, k) => pick(x, nx, k)), ...Array.from({ length: nv }, (_, k) => pick(v, nv, k))];
  };
}

for (const name of ['arenstorf', 'kepler', 'duffing', 'driven-oscillator']) {
  test(name, () => {
    const text = preset(name), answers = new Answers(new Core(module));
    const first = answers.answer('solve', question(text, { truth: false }));
    assert.equal(first.truth, null);
    const { truth: draft, tracks, errors } = answers.answer('solve', question(text, { methods: [], coarse: true }));
    assert.ok(draft.coarse && tracks.length === 0 && errors.length === 0);
    const whole = answers.answer('solve', question(text)), truth = whole.truth;
    assert.ok(!truth.coarse && truth.error === truth.off && whole.errors.length === 1);

    const at = reference(text), known = at(draft.times), numbers = known.length;
    for (let k = 0; k < numbers; k++) assert.ok(apart(draft.columns[1 + k], known[k]) < 0.25, `${first.columns[1 + k]}: ${apart(draft.columns[1 + k], known[k])} pixels`);
    for (const { times, columns } of [draft, truth]) {
      const between = Float64Array.from(times.subarray(1), (t, i) => times[i] + 0.37 * (t - times[i])), exact = at(between);
      exact.forEach((column, k) => {
        const drawn = columns[1 + k], [low, high] = range(drawn);
        const most = column.reduce((m, v, i) => Math.max(m, Math.abs(v - drawn[i] - 0.37 * (drawn[i + 1] - drawn[i]))), 0) / (high - low) * WIDTH;
        assert.ok(most < 0.5, `${first.columns[1 + k]}: the line is ${most} pixels off`);
      });
    }

    // The same as if there had been no draft.
    const alone = new Answers(new Core(module)).answer('solve', question(text));
    assert.deepEqual([whole.errors, whole.tracks, truth.name, truth.error], [alone.errors, alone.tracks, alone.truth.name, alone.truth.error]);
  });
}

test('quantities are those of the exact motion; of a draft, where they are known', () => {
  const answers = new Answers(new Core(module));
  for (const coarse of [true, false]) {
    const { truth, columns } = answers.answer('solve', question(preset('duffing'), { methods: [], coarse })), of = (name) => truth.columns[columns.indexOf(name)];
    assert.equal(truth.coarse, coarse);
    of('x').forEach((x, i) => {
      const potential = -(x ** 2) / 2 + x ** 4 / 4;
      assert.ok(Math.abs(of('potential')[i] - potential) < 1e-3, `${of('potential')[i]} is not ${potential}`);
      assert.ok(Math.abs(of('energy')[i] - potential - of("x'")[i] ** 2 / 2) < 1e-3);
    });
  }
  // Kept: what a draft is off would be drawn as its motion.
  const { truth, columns } = answers.answer('solve', question(preset('kepler'), { methods: [], coarse: true })), kept = truth.columns[columns.indexOf('L')], [low, high] = range(kept);
  assert.ok(truth.coarse && (kept.length === 0 || high - low < 1e-9 * high), `L moves by ${high - low}`);
});

test('a draft of another motion leaves the reference as it was', () => {
  for (const text of [preset('pendulum'), kick]) {
    const answers = new Answers(new Core(module)), { errors } = answers.answer('solve', question(text));
    assert.equal(errors.length, 1);
    for (const part of [{ rows: 100 }, { until: 7 }, { methods: [], rows: 6000, until: 7 }]) {
      const other = answers.answer('solve', question(text, { coarse: true, ...part }));
      assert.ok(other.truth.times.length > 2 && (!other.truth.coarse || other.errors.length === 0));
      assert.deepEqual(answers.answer('solve', question(text)).errors, errors);
    }
  }
});

test('a motion backward, and one with an exact line', () => {
  const answers = new Answers(new Core(module));
  for (const coarse of [true, false]) {
    const { truth } = answers.answer('solve', question("x'' = -sin(x)\nx(0) = 1\nx'(0) = 0.3\nstep 0.1\nuntil -20\n", { coarse }));
    assert.ok(truth.coarse === coarse && truth.times[0] === 0 && truth.times[truth.times.length - 1] === -20);
    assert.ok(truth.times.every((t, i) => i === 0 || t < truth.times[i - 1]));
    const ball = answers.answer('solve', question(preset('projectile'), { coarse }));
    assert.ok(!ball.truth.coarse && ball.truth.name === 'exact' && ball.truth.error === 0 && ball.errors.length === 1);
  }
});

test('a force that steps miss is in no draft', () => {
  const { truth } = new Answers(new Core(module)).answer('solve', question(kick, { coarse: true }));
  const known = reference(kick)(truth?.times ?? new Float64Array(0));
  known.forEach((column, k) => assert.ok(apart(column, truth?.columns[1 + k] ?? column) < 0.5));
});

test('a motion that ends at a singularity has neither', () => {
  const answers = new Answers(new Core(module)), text = "x'' = -1/x^2\nx(0) = 1\nx'(0) = 0\nstep 0.001\nuntil 2\n";
  for (const coarse of [true, false]) assert.equal(answers.answer('solve', question(text, { coarse })).truth, null);
  assert.match(answers.answer('solve', question(text)).problem.message, /there is no reference solution/);
});
