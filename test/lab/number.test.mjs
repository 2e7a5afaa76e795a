/* Numbers as people type them, and how far sliders reach. Law: what comes out is a number of the language, and a slider holds the model's value. */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url);
const { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const load = async name => {
  const built = buildSync({ entryPoints: [fileURLToPath(new URL(name, lab))], bundle: true, format: 'esm', write: false, target: 'es2022' });
  return import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));
};
const { compact, normal, numberOf, plain, tuple } = await load('shell/number.ts');
const { logPosition, logValue, reach, widen } = await load('shell/range.ts');

test('a comma is a point, a typographic minus is a minus', () => {
  const pairs = [['0,5', '0.5'], ['-0,5', '-0.5'], ['−3', '-3'], ['.5', '0.5'], ['5.', '5'], ['+2', '2'], [' 1e-3 ', '1e-3'], ['1,5e3', '1.5e3'], [',5', '0.5'], ['-.5', '-0.5'], ['5.e3', '5e3']];
  for (const [typed, meant] of pairs) assert.ok([meant, meant.replace(/^0(?=\.)/, '')].includes(normal(typed)), `${typed}: ${normal(typed)}`);
  for (const [typed, meant] of pairs) { assert.equal(numberOf(typed), Number(meant)); assert.ok(plain(normal(typed)), typed); }
});

test('what is no number is none', () => {
  for (const typed of ['', ' ', '1,2,3', '1.2,3', 'pi', '1/2', 'NaN', 'Infinity', '1e400', '0x10', '1_0', '--1', '.', ',', '-', 'e5', '1 2']) assert.equal(numberOf(typed), null, typed);
  assert.equal(normal('pi/100'), 'pi/100');
});

test('a tuple is taken apart, or not at all', () => {
  assert.deepEqual(tuple('(0, -9.81)'), { open: '(', close: ')', parts: ['0', '-9.81'] });
  assert.deepEqual(tuple('[1,2, 3]').parts, ['1', '2', '3']);
  assert.deepEqual(tuple('2.95912208286e-4').parts, ['2.95912208286e-4']);
  for (const text of ['(a, 1)', '1, 2', 'sqrt(2)', '(1, 2) + (3, 4)', '', '(1', '((1), 2)']) assert.equal(tuple(text), null, text);
});

test('a slider holds the value of the model, and zero where a sign may change', () => {
  for (const value of [0, 1, -1, 9.81, -9.81, 0.012277471, 2.95912208286e-4, 6.674e-11, 1.989e30, 32, 1e-300]) for (const signed of [true, false]) for (const scale of [0, Math.abs(value), 50]) {
    const { low, high, step } = reach(value, scale, signed, false);
    assert.ok(low < high && low <= value && value <= high && step > 0 && (high - low) / step < 1e4, `${value} ${signed} ${scale}: ${low} ${high} ${step}`);
    if (signed) assert.ok(low < 0 && high > 0);
  }
  assert.deepEqual(reach(32, 0, false, true), { low: 1, high: 128, step: 1 });
  const wide = widen({ low: 0, high: 2, step: 0.01 }, 7);
  assert.ok(wide.high >= 7);
  assert.ok(widen({ low: 0, high: 2, step: 0.01 }, -7).low <= -7);
});

test('a scale of powers is run through both ways', () => {
  for (const value of [0.001, 0.0125, 0.05, 0.2, 2.4]) {
    const back = logValue(logPosition(value, 0.001, 2.5, 300), 0.001, 2.5, 300);
    assert.ok(Math.abs(Math.log(back / value)) < Math.log(2500) / 300 + 0.05, `${value}: ${back}`);
  }
});

test('a narrow field shows what fits', () => {
  for (const value of [0, -9.81, 2.95912208286e-4, 17.0652165601579, 6.674e-11, 1.989e30, -123456.789, 200000]) assert.ok(compact(value).length <= 11, compact(value));
});
