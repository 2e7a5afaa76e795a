/* What the panel "Step by step" says of an event. Law: a kick names the velocity at which its acceleration is taken wherever the force depends on it. */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url);
const { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const built = buildSync({ entryPoints: [fileURLToPath(new URL('panel/steps/told.ts', lab))], bundle: true, format: 'esm', write: false, target: 'es2022' });
const { tell } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));

const event = (kind, iterations) => ({
  kind, iterations, stage: 1, stages: 2, time: 0.5, step: 0.1, coefficient: 1, weight: 0, weight_x: 0, row: null, row_x: null, x: [1], v: [2], a: [3], before_x: null, before_a: null,
});
const trace = { method: 'leapfrog', step: 0.1, index: 0, total: 10, entries: [event('start', 0), event('drift', 0), event('kick', 4), event('kick', 5)], names: { x: ['x'], v: ["x'"] } };

test('a kick by a force that is free of the velocity is explicit', () => {
  const said = tell(trace, 2, [0], false);
  assert.equal(said.title, 'Kick');
  assert.ok(!/mean|Newton/.test(said.note), said.note);
});
test('a kick by a force of the velocity is implicit, at the mean velocity, with its own iterations', () => {
  const first = tell(trace, 2, [0], true), second = tell(trace, 3, [0], true), linear = tell({ ...trace, entries: trace.entries.map(e => ({ ...e, iterations: 0 })) }, 2, [0], true);
  for (const said of [first, second, linear]) { assert.equal(said.title, 'Implicit kick'); assert.match(said.note, /mean of the velocities before and after/); }
  assert.match(first.note, /4 iterations/);
  assert.match(second.note, /in 1 iteration\./);
  assert.ok(!/Newton/.test(linear.note), linear.note);
});
