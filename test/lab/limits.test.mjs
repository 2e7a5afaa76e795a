/* How large the step may be, by the module of build/lab: motions with friction against limits that are known on paper. Run by `node --test`.
 * Laws: Verlet's step on x'' = -c x' multiplies by 1 and (2 - c h)/(2 + c h), so that nothing grows at any h; on x'' = -x - c x' its limit is 2 for every c;
 * a Runge-Kutta method is a map of hλ; several modes allow what the fastest allows; a moment at which the motion itself grows is left out.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url), { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const contents = `export { Answers } from './answers'; export { Core } from './core'; export { Limits } from './panel/limits'; export { motionOf } from './panel/rates'; export { limitOf } from './panel/stability';`;
const built = buildSync({ stdin: { contents, resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022', platform: 'node', external: ['virtual:*'] });
const code = built.outputFiles[0].text.replace(/^import .* from "virtual:[^"]*";$/gm, '');
const { Answers, Core, Limits, motionOf, limitOf } = await import('data:text/javascript;base64,' + Buffer.from(code).toString('base64'));
const answers = new Answers(new Core(new WebAssembly.Module(readFileSync(new URL('../../build/lab/motus.wasm', import.meta.url)))));
const catalogue = answers.answer('catalogue', {}), limits = new Limits({ ask: async (kind, ask) => answers.answer(kind, ask) });

async function limit(text, method, { step = null, until = null, count = 16 } = {}) {
  const model = { text, set: [] }, { settings, velocity_dependent, variables } = answers.answer('describe', { model }), end = until ?? settings.until ?? 1;
  const times = Array.from({ length: count }, (_, k) => (end * k) / count), spectra = answers.answer('spectrum', { model, method, step, until: end, times });
  const motion = motionOf(spectra, times, !velocity_dependent && !variables.some((v) => v.order === 1));
  return limitOf(limits, motion, method, catalogue.find((m) => m.name === method || m.aliases.includes(method)));
}
const friction = (k, c) => `x'' = -${k} x - ${c} x'\nx(0) = 0\nx'(0) = 1\nstep 0.01\nuntil 2`, preset = (name) => readFileSync(new URL(`../../models/${name}.motus`, import.meta.url), 'utf8');
const near = (found, value, what) => { assert.equal(found.kind, 'upTo', what); assert.ok(Math.abs(found.value - value) < 1e-3 * value, `${what}: ${found.value}, not ${value}`); };

test('friction alone bounds no step of Verlet, and bounds those of Runge-Kutta methods', async () => {
  assert.deepEqual(await limit("x'' = -2 x'\nx(0) = 0\nx'(0) = 1\nstep 0.01\nuntil 2", 'verlet'), { kind: 'any' });
  near(await limit("x'' = -2 x'\nx(0) = 0\nx'(0) = 1\nstep 0.01\nuntil 2", 'euler'), 1, 'Euler');
  near(await limit("x'' = -2 x'\nx(0) = 0\nx'(0) = 1\nstep 0.01\nuntil 2", 'rk4'), 2.785293563 / 2, 'RK4');
});
test('a spring with friction: 2 for Verlet, however strong the friction', async () => {
  for (const c of [0.01, 0.5, 1, 2, 5, 50]) near(await limit(friction(1, c), 'verlet', { step: 0.001 }), 2, `c = ${c}`);
  near(await limit(friction(9, 0.5), 'verlet'), 2 / 3, 'k = 9');
  // Explicit Euler: 2γ/(γ² + ω²) = c/k of conjugate rates.
  near(await limit(friction(4, 0.5), 'euler'), 0.125, 'Euler');
});
test('several masses with friction: what the fastest mode allows, also where friction mixes the modes', async () => {
  near(await limit("x'' = -x - 0.3 x'\ny'' = -16 y - 0.3 y'\nx(0) = 1\ny(0) = 1\nx'(0) = 0\ny'(0) = 0\nstep 0.01\nuntil 1", 'verlet'), 0.5, 'apart');
  near(await limit("x'' = -2 x + y - 0.3 x'\ny'' = -2 y + x - 0.3 y'\nx(0) = 1\ny(0) = 0\nx'(0) = 0\ny'(0) = 0\nstep 0.01\nuntil 1", 'verlet'), 2 / Math.sqrt(3), 'coupled');
  // Friction of one of them: Verlet ends where h²K has the eigenvalue 4, whatever the friction.
  near(await limit("x'' = -2 x + y - 0.7 x'\ny'' = -2 y + x\nx(0) = 1\ny(0) = 0\nx'(0) = 0\ny'(0) = 0\nstep 0.01\nuntil 1", 'verlet'), 2 / Math.sqrt(3), 'mixed');
});
test('without friction the limits are the catalogue’s', async () => {
  const spring = "x'' = -4 x\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 1";
  assert.equal((await limit(spring, 'verlet')).value, 2);
  near(await limit(spring, 'rk4'), Math.sqrt(8), 'RK4');
  assert.deepEqual(await limit(spring, 'explicit-euler'), { kind: 'never' });
});
test('air bounds no step of Verlet; a motion that grows of itself is left out; a method that is not admitted is not judged', async () => {
  for (const name of ['projectile-drag', 'thrown-ball-air']) assert.deepEqual(await limit(preset(name), 'verlet', { step: 0.02 }), { kind: 'any' }, name);
  // Friction with a spring: Verlet's limit is 2/√k, k the stiffest where nothing grows.
  const model = { text: preset('van-der-pol'), set: [] }, times = Array.from({ length: 16 }, (_, k) => k), spectra = answers.answer('spectrum', { model, method: 'verlet', step: 0.001, until: 16, times });
  const calm = spectra.filter(({ re }) => re.every((r) => r <= 0)).map(({ linear }) => -linear.x[0]);
  assert.ok(calm.length > 0 && calm.length < 16);
  near(await limit(model.text, 'verlet', { step: 0.001, until: 16 }), 2 / Math.sqrt(Math.max(...calm)), 'van der Pol');
  assert.deepEqual(await limit(friction(1, 1), 'verlet', { count: 1 }).then(() => limits.linear('boris', motionOf(answers.answer('spectrum', { model: { text: friction(1, 1), set: [] }, method: 'verlet', step: null, until: null, times: [0] }), [0], false).calm)), { kind: 'unknown' });
});
