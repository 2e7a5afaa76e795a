/* What the studies say, from points, slopes and rates that are known: no browser, no core. Run by `node --test`. */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const lab = new URL('../../lab/', import.meta.url), { build } = createRequire(new URL('package.json', lab))('esbuild');
const contents = `export * from './panel/reading'; export * from './panel/rates'; export { swingsOf } from './panel/swings'; export { words } from './words'; export { Limits } from './panel/limits'; export { halfStep } from './panel/convergence'; export { accuracy } from './panel/precision'; export { largestSteps } from './panel/stability';`;
// What only the build knows: nothing here asks for it.
const virtual = { name: 'virtual', setup(b) { b.onResolve({ filter: /^virtual:/ }, ({ path }) => ({ path, namespace: 'virtual' })); b.onLoad({ filter: /.*/, namespace: 'virtual' }, () => ({ contents: 'module.exports = {};', loader: 'js' })); } };
const built = await build({ stdin: { contents, resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022', plugins: [virtual], logLevel: 'error' });
const { swingsOf, words, buysOf, needOf, digitsOf, motionOf, Limits, halfStep, accuracy, largestSteps } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));

/** A row whose error is c h^p at halving steps; each step costs `cost`. */
function row(method, p, { c = 1, cost = 1, from = 1, count = 10, passed = true, observed = p, exact = false, declared = Math.round(p) } = {}) {
  const points = Array.from({ length: count }, (_, k) => ({ step: from / 2 ** k, error: c * (from / 2 ** k) ** p, evaluations: cost * 2 ** k, used: true }));
  return { method, declared, observed: exact ? null : observed, standard_error: 0.01, exact_here: exact, passed, points, certificate: exact ? '' : 'no slope' };
}
const close = (a, b, part, what) => assert.ok(Math.abs(a - b) <= part * Math.abs(b), `${what}: ${a}, not ${b}`);

test('half the step: two to the power of minus the slope, methods alike together', () => {
  const rows = [row('a', 1.01, { declared: 1 }), row('b', 0.99, { declared: 1 }), row('c', 2), row('d', 4)];
  assert.equal(halfStep(rows, ['explicit Euler', 'symplectic Euler', 'Verlet', 'RK4']), 'At small steps: half the error for the Eulers, a quarter for Verlet, 1/16 for RK4.');
  assert.equal(halfStep([row('c', 3), row('d', 3)], ['RK3', 'Ruth 3']), 'At small steps: an eighth of the error for RK3 and Ruth 3.');
});
test('half the step: a slope that is not the declared one, an exact method, none at all', () => {
  assert.equal(halfStep([row('a', 1.5, { declared: 2, passed: false })], ['Verlet']), 'At small steps: 0.35 of the error for Verlet, where its order says a quarter.');
  assert.equal(halfStep([row('a', 7.59, { declared: 8, passed: false })], ['Gauss 8']), 'At small steps: 1/190 of the error for Gauss 8, where its order says 1/256.');
  assert.equal(halfStep([row('a', 0, { declared: 2, passed: false })], ['Verlet']), 'At small steps: nothing for Verlet.');
  assert.equal(halfStep([row('a', 2, { exact: true })], ['midpoint']), 'Nothing: midpoint is exact here, at every step measured.');
  assert.equal(halfStep([row('a', 1), row('b', 2, { exact: true })], ['explicit Euler', 'Verlet']), 'At small steps: half the error for explicit Euler; Verlet is exact here.');
  const silent = { ...row('a', 2), observed: null, passed: false };
  assert.equal(halfStep([silent], ['Verlet']), 'That cannot be told here: no steady share for Verlet.');
  assert.equal(halfStep([{ ...silent, points: [] }], ['Verlet']), 'That cannot be told here: Verlet could not be measured.');
  assert.equal(halfStep([], []), '');
  assert.equal(buysOf(row('a', 1.8, { passed: false, declared: 2 })).power, null);
});

test('so many digits: between two points along the straight line, for good', () => {
  // c h^2 with h = 1/N: an error of 1e-3 takes N = sqrt(c/1e-3).
  const verlet = row('verlet', 2, { c: 0.5 }), euler = row('euler', 1, { c: 0.5, count: 14 });
  close(needOf(verlet, 1e-3).work, Math.sqrt(500), 1e-12, 'order 2');
  close(needOf(euler, 1e-3).work, 500, 1e-12, 'order 1');
  assert.equal(digitsOf([verlet, euler]), 3);
  assert.equal(accuracy([euler, verlet], ['symplectic Euler', 'Verlet']), `For three digits, Verlet needs ${Number((500 / Math.sqrt(500)).toPrecision(2))} times fewer evaluations than symplectic Euler.`);
  // An error that is small by chance at a long step, and large again after it, does not count.
  const lucky = { ...verlet, points: verlet.points.map((point, k) => (k === 1 ? { ...point, error: 1e-9 } : point)) };
  close(needOf(lucky, 1e-3).work, Math.sqrt(500), 1e-12, 'lucky');
  // Before the first point, or after one that ran away, it is a bound.
  assert.deepEqual(needOf(verlet, 1), { work: 1, exact: false });
  assert.deepEqual(needOf({ ...verlet, points: verlet.points.map((point, k) => (k < 3 ? { ...point, error: null } : point)) }, 0.01), { work: 8, exact: false });
  assert.equal(needOf(verlet, 1e-9), null);
});
test('accuracy: until when it was measured, for several methods as for one', () => {
  const said = accuracy([row('euler', 1, { c: 0.5, count: 14 }), row('verlet', 2, { c: 0.5 })], ['symplectic Euler', 'Verlet'], '4.76');
  assert.match(said, /^For three digits, Verlet needs [\d.]+ times fewer evaluations than symplectic Euler, up to t = 4\.76\.$/);
});
test('where it turns back: not at the start, where it was at rest; as one end of what repeats, the start counts', () => {
  const cosine = (until) => { const t = Array.from({ length: 401 }, (_, k) => (until * k) / 400); return swingsOf(t, t.map(Math.cos), t.map((s) => (s ? -Math.sin(s) : 0))); };
  const few = cosine(7), many = cosine(12);
  assert.deepEqual([few.turns.length, few.repeats], [2, null]);
  few.turns.forEach(({ time }, k) => close(time, (k + 1) * Math.PI, 1e-4, `turn ${k}`));
  assert.equal(many.turns.length, 3);
  close(many.repeats.period, 2 * Math.PI, 1e-4, 'period');
  const { turns } = words.panel.phase;
  assert.deepEqual([turns(1, 't = 3', 't = 3'), turns(2, 't = 4.17', 't = 8.35'), turns(31, 'a', 'b')], [' turns back once, at t = 3.', ' turns back twice, at t = 4.17 and t = 8.35.', ' turns back 31 times, first at a, last at b.']);
});
test('accuracy: who does not come so far, who is exact, one alone, nothing', () => {
  const verlet = row('verlet', 2, { c: 0.5 }), poor = row('euler', 1, { c: 0.5, count: 5 });
  assert.equal(accuracy([poor, verlet], ['explicit Euler', 'Verlet']), 'For one digit, Verlet needs 2.2 times fewer evaluations than explicit Euler.');
  assert.equal(accuracy([row('euler', 1, { c: 5, count: 3 }), verlet], ['explicit Euler', 'Verlet']), 'For three digits, Verlet needs 22 evaluations of the force; explicit Euler does not get so far with the steps measured.');
  assert.equal(accuracy([verlet], ['Verlet'], '4.76'), 'For three digits, Verlet needs 22 evaluations of the force up to t = 4.76.');
  assert.equal(accuracy([verlet, row('m', 2, { exact: true })], ['Verlet', 'midpoint']), 'For three digits, Verlet needs 22 evaluations of the force; midpoint is exact at every step measured.');
  assert.equal(accuracy([row('m', 2, { exact: true })], ['midpoint']), '');
  assert.equal(accuracy([row('e', 1, { c: 9, count: 2 })], ['explicit Euler']), 'With the steps measured, explicit Euler does not come to one digit.');
});

const spectrum = (pairs, more = {}) => ({ re: Float64Array.from(pairs.map((p) => p[0])), im: Float64Array.from(pairs.map((p) => p[1])), free: false, springs: true, ...more });
test('rates: swings, friction, growth, nothing', () => {
  const spring = motionOf([spectrum([[0, 3], [0, -3], [0, 1], [0, -1]]), spectrum([[0, 3], [0, -3], [0, 1], [0, -1]])], [0, 1], true);
  assert.deepEqual([spring.kind, spring.steady, spring.frequencies], ['swings', true, [3, 1]]);
  const varying = motionOf([spectrum([[0, 1], [0, -1]]), spectrum([[0, 5], [0, -5]]), spectrum([[2, 0], [-2, 0]])], [0, 1, 2], true);
  assert.deepEqual([varying.kind, varying.steady, varying.fastest.time, varying.frequencies, varying.growing], ['swings', false, 1, [5], true]);
  const damped = motionOf([spectrum([[-0.1, 2], [-0.1, -2]])], [0], false);
  assert.deepEqual([damped.kind, damped.judged.length], ['fades', 1]);
  assert.equal(motionOf([spectrum([[-0.1, 2], [-0.1, -2]])], [0], false, -1).kind, 'grows', 'backward, friction is growth');
  assert.equal(motionOf([spectrum([[2, 0], [-2, 0]])], [0], true).kind, 'grows');
  assert.equal(motionOf([spectrum([[0, 0], [0, 0]], { free: true })], [0], true).kind, 'still');
  assert.equal(motionOf([spectrum([[0, 0], [0, 0]])], [0], true).kind, 'rateless');
});

/* Growth of one step of Runge-Kutta methods, and of Verlet on a spring: by their formulas. */
const times = ([a, b], [c, d]) => [a * c - b * d, a * d + b * c];
function taylor(order) {
  return (re, im) => {
    let sum = [1, 0], term = [1, 0];
    for (let k = 1; k <= order; k++) { term = times(term, [re / k, im / k]); sum = [sum[0] + term[0], sum[1] + term[1]]; }
    return Math.hypot(...sum);
  };
}
const client = (growth) => ({ ask: async (_, { re, im }) => Float64Array.from(re, (x, k) => growth(x, im[k])) });
test('limits: of the axis by the catalogue and the growth, of friction by the growth', async () => {
  const card = (name, limit) => ({ name, stability_limit: limit });
  assert.deepEqual(await new Limits(client(taylor(1))).axis('euler', card('euler', 0)), { kind: 'never' });
  assert.deepEqual(await new Limits(client(taylor(2))).axis('any name', card('any name', 0)), { kind: 'slow' });
  assert.deepEqual(await new Limits(client(taylor(4))).axis('rk4', card('rk4', 2.8284)), { kind: 'upTo', value: 2.8284 });
  assert.deepEqual(await new Limits(client(() => 1)).axis('gauss', card('gauss', Infinity)), { kind: 'any' });
  // With arguments of its own, nothing is certified: 2 √2 from the growth alone.
  close((await new Limits(client(taylor(4))).axis('rk4(1)', card('rk4', 9))).value, Math.sqrt(8), 1e-3, 'rk4 without its row');
  // Explicit Euler on λ = -γ ± iω: 1 at h = 2γ/(γ² + ω²).
  const rates = [{ time: 0, re: -0.1, im: Math.sqrt(3.99) }];
  close((await new Limits(client(taylor(1))).steps('euler', card('euler', 0), rates)).value, 0.05, 1e-3, 'explicit Euler with friction');
  // On the negative real axis RK4 ends at 2.785293563405282.
  close((await new Limits(client(taylor(4))).steps('rk4', card('rk4', 2.8284), [{ time: 0, re: -10, im: 0 }, { time: 0, re: -1, im: 0 }])).value, 0.27852935634, 1e-3, 'RK4 on decays');
  // A swing without friction beside them: the smaller of both.
  close((await new Limits(client(taylor(4))).steps('rk4', card('rk4', Math.sqrt(8)), [{ time: 0, re: -1, im: 0 }, { time: 0, re: 0, im: 10 }])).value, Math.sqrt(8) / 10, 1e-12, 'both');
  assert.deepEqual(await new Limits(client(() => NaN)).steps('splitting', card('splitting', 2), rates), { kind: 'unknown' });
});
test('the largest steps in a sentence', () => {
  const judged = [{ name: 'explicit Euler', limit: { kind: 'never' } }, { name: 'symplectic Euler', limit: { kind: 'upTo', value: 2 } }, { name: 'midpoint', limit: { kind: 'slow' } }, { name: 'Verlet', limit: { kind: 'upTo', value: 2 } }, { name: 'Gauss 4', limit: { kind: 'any' } }];
  const written = (h) => `${Number(h.toPrecision(3))} s`;
  assert.equal(largestSteps(judged, 4, 0.1, written, ''), 'Below 0.5 s for symplectic Euler and Verlet; any step for Gauss 4; no step is small enough for explicit Euler, nor for midpoint, though it grows slowly.');
  assert.equal(largestSteps(judged.slice(3), 4, 0.6, written, ''), '0.6 s is too large for Verlet: below 0.5 s for Verlet; any step for Gauss 4.');
  assert.equal(largestSteps(judged.slice(2, 3), 4, 0.6, written, 'for its fastest swing, '), 'For its fastest swing, no step is small enough for midpoint, though it grows slowly.');
  assert.equal(largestSteps([], 1, 1, written, ''), '');
});
