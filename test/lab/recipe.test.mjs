/* One step as a recipe (lab/panel/steps/recipe.ts), by the module of build/lab. Run by `node --test`. Laws, for every model and every method that it admits, at the
 * first step, the second and a later one: at most four lines; each calculation, evaluated with the figures as they are written, gives its own right-hand
 * side, rounded to the digits that stand there; the last place or velocity is the core's; each line has a mark for its disc.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';
import { examples } from '../../lab/models.mjs';

const lab = new URL('../../lab/', import.meta.url), root = new URL('../../', import.meta.url);
const { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const contents = `export * from './core'; export * from './answers'; export * from './panel/steps/recipe'; export * from './panel/steps/seen'; export * from './panel/steps/figures'; export * from './panel/steps/closing'; export * from './panel/steps/local_exact';`;
const built = buildSync({ stdin: { contents, resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022', platform: 'node' });
const { Core, Answers, recipeOf, seenIn, plain, figure, factor, localExact, against } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));
const module = new WebAssembly.Module(readFileSync(new URL('build/lab/motus.wasm', root)));

/** A figure as it is read: the number, and half a unit of its last digit where it was rounded. */
function read({ text, rounded }) {
  const [, mantissa, power] = /^(−?[\d\u2009.]+)(?:×10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?$/.exec(text) ?? [];
  if (text === '½') return { value: 0.5, off: 0 };
  assert.ok(mantissa !== undefined, `“${text}” is no figure`);
  const p = power ? Number([...power].map((c) => (c === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c))).join('')) : 0, digits = mantissa.replace(/\u2009/g, '').replace('−', '-');
  return { value: Number(digits) * 10 ** p, off: rounded ? 0.5000001 * 10 ** (p - (digits.split('.')[1] ?? '').length) : 0 };
}
const each = (a, b, act) => Array.from({ length: Math.max(a.length, b.length) }, (_, k) => act(a[a.length === 1 ? 0 : k], b[b.length === 1 ? 0 : k]));
/** A calculation between its equals signs: numbers and vectors with what they may be off; names: of lines above. */
function evaluate(tokens, names) {
  let at = 0;
  const sign = (s) => tokens[at]?.kind === 'sign' && tokens[at].sign === s && ++at > 0;
  function term() {
    if (sign('(')) { const inner = total(); assert.ok(sign(')'), 'a bracket is closed'); return inner; }
    const token = tokens[at++];
    if (token.kind === 'name') { const known = names.get(`${token.name}${token.index ?? ''}`); assert.ok(known, `${token.name}${token.index ?? ''} stands in a line above`); return known; }
    return token.figures.map(read);
  }
  function product() {
    let left = term();
    for (;;) {
      if (sign('·')) left = each(left, term(), (a, b) => ({ value: a.value * b.value, off: Math.abs(a.value) * b.off + Math.abs(b.value) * a.off + a.off * b.off }));
      else if (sign('/')) left = each(left, term(), (a, b) => ({ value: a.value / b.value, off: a.off / Math.abs(b.value) }));
      else return left;
    }
  }
  function total() {
    let left = product();
    for (;;) {
      const way = sign('+') ? 1 : sign('−') ? -1 : 0;
      if (!way) return left;
      left = each(left, product(), (a, b) => ({ value: a.value + way * b.value, off: a.off + b.off }));
    }
  }
  const found = total();
  assert.equal(at, tokens.length, 'all of it is read');
  return found;
}
/** The sides of a calculation. */
function sides(sum) {
  const out = [[]];
  for (const token of sum) if (token.kind === 'sign' && token.sign === '=') out.push([]); else out.at(-1).push(token);
  return out;
}

// What happens at instants ends a step elsewhere: such steps are not traced.
const models = examples.filter(({ text }) => !/^when\b/m.test(text)).map(({ name, text }) => [name, text]);
models.push(['decay', "s' = -s\ns(0) = 1\nstep 0.1\nuntil 2\n"], ['backward', "x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil -2\n"],
  ['lorenz', "x' = 10 (y - x)\ny' = x (28 - z) - y\nz' = x y - 8/3 z\nx(0) = 1\ny(0) = 1\nz(0) = 1\nstep 0.01\nuntil 2\n"], ['at rest', "x'' = 0\nx(0) = 3\nx'(0) = 0\nstep 0.1\nuntil 2\n"], ['small', "x'' = -x\nx(0) = 1e-9\nx'(0) = 2e-9\nstep 0.1\nuntil 2\n"], ['large', "x'' = -x\nx(0) = 123456789\nx'(0) = 0\nstep 0.1\nuntil 2\n"]);
for (const [name, text] of models) {
  test(`${name}: recipes of one step`, () => {
    const answers = new Answers(new Core(module)), model = { text, set: [] }, description = answers.answer('describe', { model });
    let seen_ = 0, calculated = 0;
    const admitted = description.methods.filter((m) => m.admitted && m.name !== 'exact').map((m) => m.name);
    for (const method of admitted.flatMap((m) => (m === 'newmark' ? [m, 'newmark(0.3, 0.6)', 'newmark(0, 0.5)'] : [m]))) for (const index of [0, 1, 7]) {
      let trace;
      try { trace = answers.answer('trace', { model, method, step: null, until: null, index }); } catch (e) { if (e.problem) continue; throw e; }
      // A method that chooses its steps may be at the end before.
      if (trace.entries.length === 0) continue;
      for (const seen of seenIn(trace.names).filter((_, k) => k < 4)) {
        const recipe = recipeOf(trace, seen, description.velocity_dependent), what = `${name} by ${method}, step ${index + 1}, ${seen.id}`;
        assert.ok(recipe && recipe.lines.length >= 1 && recipe.lines.length <= 4, what);
        const names = new Map(), told = (e, k) => (seen.order === 2 ? e.x[k] : e.v[k]), end = trace.entries.at(-1), ends = seen.indices.map((k) => told(end, k));
        let arrives = false;
        seen_++;
        for (const [k, line] of recipe.lines.entries()) {
          assert.ok(line.disc && line.marks.length && line.sentence.length > 8 && !/undefined|NaN/.test(line.sentence), `${what}, line ${k + 1}: ${line.sentence}`);
          assert.ok(line.sums.length >= 1, what);
          for (const sum of line.sums) {
            const parts = sides(sum), right = parts.at(-1), written = `${what}, line ${k + 1}: ${plain(sum)}`;
            assert.ok(!/NaN|undefined|–|∞/.test(plain(sum)), written);
            assert.equal(right.length, 1, written);
            const result = right[0].figures.map(read);
            if (parts[0].length === 1 && parts[0][0].kind === 'name') names.set(`${parts[0][0].name}${parts[0][0].index ?? ''}`, result);
            if (parts.length === 3 || (parts.length === 2 && parts[0].some((t) => t.kind === 'sign' && t.sign === '·'))) {
              calculated++;
              const left = evaluate(parts.at(-2), names);
              left.forEach(({ value, off }, i) => {
                const { text } = right[0].figures[i], [, digits = '', power = ''] = /^[^.×]*(?:\.(\d*))?(?:×10(.*))?$/.exec(text), place = 10 ** (-digits.length + (power ? Math.round(Math.log10(read({ text: `1×10${power}`, rounded: false }).value)) : 0));
                // A result that was not rounded leaves out zeros.
                const limit = (right[0].figures[i].rounded ? 0.5 * place : Math.min(0.5 * place, off)) * (1 + 1e-5) + 1e-9 * Math.abs(result[i].value) + 1e-300;
                assert.ok(Math.abs(value - result[i].value) <= limit, `${written}: ${value} is not ${result[i].value} within ${limit}`);
                // What rounding allows is little beside what is written.
                assert.ok(off <= 25 * Math.max(result[i].off, 0.5 * 10 ** -9 * Math.abs(value), 1e-300) || off <= 0.02 * Math.max(Math.abs(value), 1e-300) || result[i].off === 0, `${written}: off by ${off}`);
              });
            }
            if (result.length === ends.length && result.every(({ value, off }, i) => Math.abs(value - ends[i]) <= off + 1e-12 * Math.abs(ends[i]) + 1e-300)) arrives = true;
          }
        }
        assert.ok(arrives, `${what}: one of the lines comes to where the step ends`);
      }
    }
    assert.ok(seen_ > 0 && calculated >= seen_, `${calculated} calculations in ${seen_} recipes`);
  });
}

test('the two steps of the concept’s picture', () => {
  const answers = new Answers(new Core(module)), model = { text: readFileSync(new URL('models/spring.motus', root), 'utf8'), set: [] };
  const said = (method, index) => {
    const trace = answers.answer('trace', { model, method, step: 0.8, until: 20, index }), recipe = recipeOf(trace, seenIn(trace.names)[0], false);
    return recipe.lines.map((line) => [line.sentence, ...line.sums.map(plain)].join(' '));
  };
  assert.deepEqual(said('midpoint', 0), ['Go half a step with the velocity you have. x = 1 + 0.4 · 0 = 1', 'Read the velocity there. v = 0 + 0.4 · (−1) = −0.4', 'Start again, and go the whole step with it. x = 1 + 0.8 · (−0.4) = 0.680']);
  assert.deepEqual(said('verlet', 1), ['Keep going: the same stretch once more. 2 · 0.68 − 1 = 0.36', 'Add what the force does in a whole step. h²a = 0.64 · (−0.68) = −0.435', 'That is the new place. No velocity was needed. x = 0.36 − 0.435 = −0.075']);
  assert.deepEqual(said('kahan-li8', 0).length, 4);
  assert.match(said('kahan-li8', 0)[3], /^And so on, 35 parts\. The last: x = /);
});
test('a step without parts of its own is one sentence', () => {
  const answers = new Answers(new Core(module)), model = { text: readFileSync(new URL('models/spring.motus', root), 'utf8'), set: [] };
  const said = (method) => {
    const trace = answers.answer('trace', { model, method, step: null, tolerance: 1e-6, until: 20, index: 1 });
    return recipeOf(trace, seenIn(trace.names)[0], false).lines.map((line) => line.sentence);
  };
  assert.match(said('taylor').join(), /^Sum the Taylor series/);
  for (const method of ['gragg', 'gragg-stormer']) assert.deepEqual(said(method), ['Take the step in more and more parts, and read off where shorter and shorter parts lead.']);
});
test('what does not fit is not said: a start that is written in another way, numbers of a part that are not its formula’s', async () => {
  const text = "x'' = -x + cos(t)\nx(abs(0)) = 1\nx'(abs(0)) = 0\nstep 0.1\nuntil 2\n", answers = new Answers(new Core(module)), model = { text, set: [] }, description = answers.answer('describe', { model }), client = { ask: async (kind, ask) => answers.answer(kind, ask) };
  const trace = answers.answer('trace', { model, method: 'leapfrog', step: null, until: null, index: 5 });
  assert.deepEqual(await localExact(client, { description, state: { text, set: {} } }, trace), { exact: null, earlier: null });
  const [start, drift, kick, ...rest] = trace.entries, other = { ...trace, entries: [start, drift, { ...kick, v: [kick.v[0] + 0.001] }, ...rest] };
  const lines = (of) => recipeOf(of, seenIn(of.names)[0], false).lines.map((l) => l.sums[0].filter((t) => t.kind === 'sign' && t.sign === '=').length);
  assert.deepEqual([lines(trace), lines(other)], [[2, 2, 2], [2, 1, 2]]);
});
test('a method of more stages than lines', () => {
  const stage = (k) => ({ kind: 'stage', stage: k, stages: 6, iterations: 0, time: 0.1 * k, step: 1, coefficient: 0.1 * k, weight: 1 / 6, weight_x: 0, row: [0, 0, 0, 0, 0, 0].map((_, j) => (j === k - 2 ? 0.1 * k : 0)), row_x: null, x: [k], v: [2], a: [0], before_x: null, before_a: null });
  const end = (kind, time, x) => ({ ...stage(0), kind, stage: 0, time, row: null, x: [x], v: [2], a: [0] });
  const trace = { method: 'six', step: 1, index: 0, total: 5, names: { x: ['x'], v: ["x'"] }, entries: [end('start', 0, 0), ...[1, 2, 3, 4, 5, 6].map(stage), end('end', 1, 2)] }, { lines } = recipeOf(trace, seenIn(trace.names)[0], false);
  assert.deepEqual(lines.map((l) => l.sums.map(plain).join()), ['v1 = 2', 'v2 = 2 + 0.2 · 0 = 2', 'v3 = 2 + 0.3 · 0 = 2', 'x = 2']);
  assert.match(lines[3].sentence, /^And so on: 6 in all\./);
});
test('figures', () => {
  const kind = { decimals: 3, most: 1 };
  assert.deepEqual([figure(1, kind), figure(-0.4, kind), figure(0.68, kind, true), figure(0.69671, kind), figure(-0, kind), figure(1e-17, kind)].map((f) => f.text), ['1', '−0.4', '0.680', '0.697', '0', '0']);
  assert.deepEqual([figure(1e-9, { decimals: 12, most: 1e-9 }).text, figure(123456789, { decimals: 0, most: 2e8 }).text, figure(12345.678, { decimals: 1, most: 2e4 }).text], ['1×10⁻⁹', '1.23456789×10⁸', '12\u2009345.7']);
  assert.deepEqual([factor(Math.PI / 100, 4), factor(0.4, 4)].map(({ text, rounded, shown }) => [text, rounded, shown]), [['0.03142', true, 0.03142], ['0.4', false, 0.4]]);
});

test('the exact motion from where a step starts: for every model, and no further from a step by Gauss’ method than that errs', async () => {
  const cells = (start) => `x[i]'' = -x[i] for i = 1..3\n${start}\nx[i]'(0) = 0 for i = 1..3\nstep 0.1\nuntil 2\n`;
  for (const [name, text] of [...models, ['one cell', cells('x[i](0) = 0 for i = 1..3\nx[2](0) = 1')], ['two ranges', cells('x[i](0) = 0 for i = 1..2 # at rest\nx[3](0) = 1 # pulled')]]) {
    const answers = new Answers(new Core(module)), model = { text, set: [] }, description = answers.answer('describe', { model }), client = { ask: async (kind, ask) => answers.answer(kind, ask) };
    for (const index of [0, 5]) {
      const trace = answers.answer('trace', { model, method: 'gauss8', step: null, until: null, index }), end = trace.entries.at(-1), start = trace.entries[0];
      const { exact: found, earlier } = await localExact(client, { description, state: { text, set: {} } }, trace), what = `${name}, step ${index + 1}`;
      assert.ok(found && !earlier, `${what}: it is there`);
      const all = [...trace.names.x, ...trace.names.v], of = (e) => [...e.x, ...e.v], at = all.map((column) => found.columns.get(column)?.[found.end]), size = Math.max(...[...of(start), ...of(end)].map(Math.abs));
      assert.ok(Math.abs(found.times[found.end] - (start.time + start.step)) <= 1e-9 * Math.abs(start.step), `${what}: its times`);
      at.forEach((x, k) => assert.ok(Math.abs(x - of(end)[k]) <= 1e-7 * size, `${what}, ${all[k]}: ${x} is not ${of(end)[k]}`));
      all.forEach((column, k) => assert.equal(found.columns.get(column)?.[0], of(start)[k], `${what}, ${column}: it starts where the step starts`));
    }
  }
});
test('a mantissa is below ten, also after it was rounded', () => {
  for (const [value, text] of [[9.9999e-5, '1.00×10⁻⁴'], [-9.9999e-5, '−1.00×10⁻⁴'], [9.99e-5, '9.99×10⁻⁵'], [5e-8, '5×10⁻⁸']]) assert.equal(figure(value, { decimals: 7 + (value === 5e-8 ? 3 : 0), most: 1e-4 }).text, text);
  assert.equal(figure(999999, { decimals: -3, most: 1e6 }).text, '1.00×10⁶');
});
test('a miss that the digits of the place do not show is told alone', () => {
  const kind = { decimals: 10, most: 5e-8 }, miss = (text, shown, unit) => ({ text, shown, unit });
  assert.equal(against([5e-8 + 8.3e-15], [5e-8], kind, 'Verlet', miss('8.3×10⁻¹⁵ too high', 8.3e-15, 1e-16), 'start', false), 'Against the motion computed in small steps, Verlet is 8.3×10⁻¹⁵ too high.');
  assert.equal(against([5.1e-8], [5e-8], kind, 'Verlet', miss('1×10⁻⁹ too high', 1e-9, 1e-10), 'here', true), 'Exact from here is 5.00×10⁻⁸: Verlet is 1×10⁻⁹ too high.');
  assert.match(against([1], [1], { decimals: 2, most: 1 }, 'Verlet', miss('', 0, 0), 'start', true), /Verlet is on it/);
});
test('a place and a miss agree with where the step is written to end; else the place has more digits, or is left out', () => {
  const of = (end, exact, text, shown, unit) => against([end], [exact], { decimals: 4, most: 1 }, 'midpoint', { text, shown, unit }, 'start', true);
  assert.equal(of(0.905, 0.904837, '1.6×10⁻⁴ too large', 1.6e-4, 1e-5), 'Exact is 0.90484: midpoint is 1.6×10⁻⁴ too large.');
  assert.equal(of(0.12345, 0.12305, '0.0004 too large', 4e-4, 1e-4), 'Exact is 0.1231: midpoint is 0.0004 too large.');
  assert.equal(of(0.12344, 0.12336, '8×10⁻⁵ too large', 8e-5, 1e-5), 'Against the exact motion, midpoint is 8×10⁻⁵ too large.');
});
test('a step of a recurrence is measured against the exact motion through both of its places', async () => {
  const client = (answers) => ({ ask: async (kind, ask) => answers.answer(kind, ask) });
  for (const [name, text, places, h] of [['spring', "x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.8\nuntil 20\n", 1, 0.8], ['long steps', "x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 1.9\nuntil 20\n", 1, 1.9], ['driven', "x'' = -x + 0.3 cos(t)\nx(0) = 1\nx'(0) = 0\nstep 0.5\nuntil 20\n", 0, 0.5],
    ['plane', "r'' = -r/|r|^3\nr(0) = (1, 0)\nr'(0) = (0, 1.1)\nstep 0.3\nuntil 5\n", 0, 0.3], ['cells', "x[i]'' = x[i+1] - 2 x[i] + x[i-1] for i = 1..6\nx[0] = 0\nx[7] = 0\nx[i](0) = sin(i) for i = 1..6\nx[i]'(0) = 0 for i = 1..6\nstep 0.4\nuntil 9\n", 0, 0.4]]) {
    const answers = new Answers(new Core(module)), model = { text, set: [] }, description = answers.answer('describe', { model }), size = 3;
    for (const index of [1, 6]) {
      const trace = answers.answer('trace', { model, method: 'verlet', step: null, until: null, index }), { exact, earlier } = await localExact(client(answers), { description, state: { text, set: {} } }, trace), { before_x: before } = trace.entries.find((e) => e.before_x), { x } = trace.entries[0], what = `${name}, step ${index + 1}`;
      assert.ok(exact && earlier, `${what}: it is there`);
      trace.names.x.forEach((column, k) => {
        assert.equal(exact.columns.get(column)[0], x[k], what);
        assert.ok(Math.abs(earlier.columns.get(column)[earlier.end] - before[k]) < 1e-11 * size, `${what}, ${column}: the place before`);
        // Of a spring in closed form.
        if (places) assert.ok(Math.abs(exact.columns.get(column)[exact.end] - (2 * Math.cos(h) * x[k] - before[k])) < 1e-10, `${what}: ${exact.columns.get(column)[exact.end]}`);
      });
    }
  }
});
test('of first order: a rate is read at a place, and the place is calculated', () => {
  const answers = new Answers(new Core(module)), text = "x' = 10 (y - x)\ny' = x (28 - z) - y\nz' = x y - 8/3 z\nx(0) = 1\ny(0) = 1\nz(0) = 1\nstep 0.01\nuntil 1";
  const trace = answers.answer('trace', { model: { text, set: [] }, method: 'rk4', step: null, until: null, index: 1 });
  for (const seen of seenIn(trace.names)) {
    const said = recipeOf(trace, seen, true).lines.slice(1).map((l) => l.sums.map(plain));
    said.forEach(([place, rate], k) => { assert.match(place, new RegExp(`^${seen.name}${k + 2} = .* [·].* = `)); assert.match(rate, new RegExp(`^${seen.name}'${k + 2} = `)); });
  }
});
