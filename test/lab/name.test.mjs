/* Names of a model as pictures set them. Run by `node --test`. */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const lab = new URL('../../lab/', import.meta.url), { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const built = buildSync({ stdin: { contents: "export * from './figure/name'; export * from './stage/labels'; export { missText } from './stage/names';", resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022' });
const { nameText, nameSpans, spread, missText } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));

test('a name is set as in the equation', () => {
  for (const [name, set] of [['theta', 'θ'], ["theta'", 'θ′'], ['r.x', 'r.x'], ["r'.y", 'r′.y'], ['x1', 'x1'], ['omega0', 'ω0'], ['r[3].x', 'r[3].x'], ["x[2]'", 'x[2]′'], ['theta(0)', 'θ(0)'], ["r'(0).x", 'r′(0).x'], ['energy', 'energy'], ['a+b', 'a+b']]) assert.equal(nameText(name), set, name);
  assert.equal(nameSpans('r.x', 10)[1].sunk > 0, true);
});

test('labels keep their order and distance and move least', () => {
  const gaps = (list, gap) => list.slice(1).every((y, i) => y - list[i] >= gap - 1e-9);
  assert.deepEqual(spread([10, 50, 90], [20, 20], 0, 100), [10, 50, 90]);
  assert.deepEqual(spread([50, 50, 50], [20, 20], 0, 100), [30, 50, 70]);
  assert.deepEqual(spread([95, 96], [20], 0, 100), [80, 100]);
  // Against every list on a grid: none that keeps the distances is nearer.
  let seed = 5;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  for (let n = 0; n < 40; n++) {
    const wanted = Array.from({ length: 3 }, () => Math.round(40 * random()) + 20).sort((a, b) => a - b), made = spread(wanted, [12, 12], -1e9, 1e9);
    const cost = (list) => list.reduce((sum, y, i) => sum + (y - wanted[i]) ** 2, 0);
    assert.ok(gaps(made, 12));
    for (let a = 0; a < 80; a += 2) for (let b = a + 12; b < 100; b += 2) for (let c = b + 12; c < 120; c += 2) assert.ok(cost(made) <= cost([a, b, c]) + 1e-9, `${wanted}: ${made}, better ${[a, b, c]}`);
  }
});

test('a miss has the digits that its frame shows', () => {
  for (const [value, frame, text] of [[1.962, 8, '1.96'], [0.981, 8, '0.98'], [0.4905, 8, '0.49'], [0.12263, 8, '0.12'], [0.0245, 8, '0.025'], [39.24, 8, '39.2'], [1234.5, 8, '1235'], [1.2e-7, 1, '1.2×10⁻⁷'], [0, 8, '0']]) assert.equal(missText(value, frame), text, String(value));
});
