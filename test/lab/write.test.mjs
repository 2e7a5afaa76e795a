/* What the editor writes. Laws: a slider's number changes nothing but its digits; a repair changes nothing but its range; colours follow their words; a
 * name that is offered begins with what is typed. */
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
const { another, written } = await load('shell/write.ts');
const { repairs, appended } = await load('shell/repair.ts');
const { pieces, shifted } = await load('shell/kinds.ts');
const { completion } = await load('shell/complete.ts');
const { ownTitle } = await load('shell/title.ts');

const plain = { suggestions: [] };
const model = "# g = 1, not this\r\nk = 1 # comment\r\n  g = (0, -9.81)  # down\nm = [1, 2, 3]; w = 2 k\nE = 1/3\n\nr'' = g - k r\nx'' = -x; x(0) = 2 ; x'(0)=-1e-3\n"
  + "r(0) = (0, 1.7)\nr'(0) = ( 6,10 )\ny'' = -y\ny(0) = sqrt(k)\ny'(0) = (1 +\n 2)\nz[i]'' = -z[i] for i = 1..3\nz[i](0) = i for i = 1..3\nmethod velocity-verlet  # good\n\tstep\t0.05\nuntil 2 pi   # once";

test('a number is replaced, and nothing else', () => {
  const cases = [
    ['k', 0, 2.5, 'k = 1 #', 'k = 2.5 #'], ['g', 1, -3, '(0, -9.81)', '(0, -3)'], ['g', 0, 7, '(0, -9.81)', '(7, -9.81)'], ['m', 2, 4, '[1, 2, 3]', '[1, 2, 4]'],
    ['E', 0, 0.5, 'E = 1/3', 'E = 0.5'], ['x(0)', 0, -2, 'x(0) = 2 ;', 'x(0) = -2 ;'], ["x'(0)", 0, 1e-7, "x'(0)=-1e-3", "x'(0)=1e-7"], ['r(0)', 1, 3, '(0, 1.7)', '(0, 3)'],
    ["r'(0)", 0, 5.5, '( 6,10 )', '( 5.5,10 )'], ["r'(0)", 1, 0.1 + 0.2, '( 6,10 )', '( 6,0.3 )'], ["y'(0)", 0, 4, '(1 +\n 2)', '4'], ['step', 0, 0.1, 'step\t0.05', 'step\t0.1'],
    ['until', 0, 8, 'until 2 pi   #', 'until 8   #'], ['method', 0, 'rk4', 'method velocity-verlet  #', 'method rk4  #'],
  ];
  for (const [name, component, value, before, after] of cases) {
    assert.equal(model.split(before).length, 2, before);
    assert.equal(written(model, plain, name, value, component), model.replace(before, after), `${name}[${component}] = ${value}`);
  }
});

test('what the text computes is left alone, and what it has not', () => {
  for (const [name, component] of [['w', 0], ['y(0)', 0], ['z(0)', 0], ['g', 2], ['k', 1], ['q', 0], ['r', 0], ['x', 0], ['', 0]]) assert.equal(written(model, plain, name, 1, component), null, name);
  for (const value of [NaN, Infinity, '', '1\nk = 2', '1 # a']) assert.equal(written(model, plain, 'k', value), null);
  assert.equal(written('step T/20', plain, 'step', 1), null);
  assert.equal(written('k = [1, # first\n 2]', plain, 'k', 1, 1), null);
  assert.equal(written("x'' = -x # k = 1", plain, 'k', 1), null);
});

test('a line that was supposed is added when its number is chosen', () => {
  const description = { suggestions: [{ line: "r'(0) = (0, 0)", why: '' }, { line: 'step  0.14', why: '' }, { line: 'until 25', why: '' }, { line: "x[i]'(0) = 0 for i = 1..3", why: '' }] };
  assert.equal(written("r'' = -r\nr(0) = (1, 0)", description, "r'(0)", 2, 1), "r'' = -r\nr(0) = (1, 0)\nr'(0) = (0, 2)");
  assert.equal(written("r'' = -r\n", description, 'step', 0.1), "r'' = -r\nstep  0.1\n");
  assert.equal(written("r'' = -r\r\n", description, 'until', 3), "r'' = -r\r\nuntil 3\r\n");
  assert.equal(written("r'' = -r\n", description, 'method', 'rk4'), "r'' = -r\nmethod rk4\n");
  assert.equal(written("r'' = -r\n", description, "x'(0)", 1), null);
  assert.equal(written("r'' = -r\n", plain, 'step', 0.1), null);
});

const wrong = (line, column, word, instead) => ({ kind: 'name', message: '', hint: '', line, column, source: '', caret: '', time: null, variable: '', word, instead });
const applied = (text, { from, to, text: by }) => text.slice(0, from) + by + text.slice(to);

test('repairs', () => {
  const text = "# é𝜃\ntheta'' = (a +\n theat)\n";
  const [replace, slider] = repairs(text, wrong(3, 2, 'theat', 'theta'));
  assert.equal(applied(text, replace), "# é𝜃\ntheta'' = (a +\n theta)\n");
  assert.equal(applied(text, slider), "# é𝜃\ntheat = 1\ntheta'' = (a +\n theat)\n");
  assert.equal(replace.label, 'Replace by theta');
  assert.deepEqual(repairs('𝜃x = sni(x)', wrong(1, 6, 'sni', 'sin')).map(r => [r.label, r.from]), [['Replace by sin', 6]]);
  assert.deepEqual(repairs('x = k', wrong(1, 5, 'k', '')).map(r => r.label), ['Make it a slider']);
  // A slider of 1 would make 30 radians of 30 degrees.
  for (const unit of ['deg', 'degrees']) {
    const line = `theta(0) = 30 ${unit}\n`, found = repairs(line, wrong(1, 15, unit, ''));
    assert.deepEqual(found.map(r => [r.label, applied(line, r)]), [[`Add ${unit} = pi/180`, `${unit} = pi/180\n${line}`]]);
  }
  assert.deepEqual(repairs('x(0) = 2.5 kg', wrong(1, 12, 'kg', '')).map(r => [r.label, applied('x(0) = 2.5 kg', r)]), [['Remove the unit kg', 'x(0) = 2.5'], ['Make it a slider', 'kg = 1\nx(0) = 2.5 kg']]);
  assert.deepEqual(repairs('x = x2 m', wrong(1, 8, 'm', '')).map(r => r.label), ['Make it a slider']);
  assert.deepEqual(repairs('method rk', { ...wrong(1, 8, 'rk', 'rk4'), kind: 'method' }).map(r => r.label), ['Replace by rk4']);
  assert.equal(applied("x'' = -x", repairs("x'' = -x", wrong(1, 1, '', 'x(0) = 1'))[0]), "x'' = -x\nx(0) = 1");
  assert.deepEqual(repairs('x = 2', wrong(1, 5, 'k', 'l')), []);       // the text has changed meanwhile
  assert.deepEqual(repairs('x = 2', wrong(0, 0, 'k', 'l')), []);
  assert.equal(applied('a\n', appended('a\n', ['b', 'c'])), 'a\nb\nc\n');
});

test('colours follow their words', () => {
  const word = (from, to, kind = 'known') => ({ from, to, kind });
  assert.deepEqual(shifted([word(0, 1), word(4, 6), word(7, 9)], 'a = bc d1', 'a = b2c d1'), [word(0, 1), word(8, 10)]);
  assert.deepEqual(shifted([word(0, 1)], 'a', 'a'), [word(0, 1)]);
  assert.deepEqual(shifted([word(0, 1), word(2, 3)], 'a a', 'a'), [word(0, 1)]);
  const told = (text, words, mark) => pieces(text, words, mark).map(p => [p.text, p.kind]);
  assert.deepEqual(told('a + bc', [word(0, 1), word(4, 6, 'unknown')], [4, 6]), [['a', 'known'], [' + ', ''], ['bc', 'mark']]);
  assert.deepEqual(told('ab', [], [2, 3]), [['ab', ''], ['', 'mark']]);
  assert.deepEqual(told('a b', [word(0, 1)], null), [['a', 'known'], [' b', '']]);
  assert.deepEqual(told('a b', [word(0, 1), word(5, 9)], [1, 2]), [['a', 'known'], [' ', 'mark'], ['b', '']]);
});

test('names', () => {
  const text = "theta'' = -si", known = {
    words: [{ from: 0, to: 5, kind: 'known' }], methods: ['verlet', 'rk4', 'velocity-verlet'], description: { variables: [{ name: 'theta', order: 2 }] },
    vocabulary: { functions: ['sin', 'sinh', 'sign'], settings: ['step', 'method'], names: ['t', 'pi'], operators: ['for'] },
  };
  const offers = (more, caret = more.length, force = false) => completion(text + more, text.length + caret, known, force)?.offers ?? null;
  assert.deepEqual(offers(''), ['sin(', 'sinh(', 'sign(']);
  assert.deepEqual(offers('n(th'), ['theta', "theta'"]);
  assert.deepEqual(offers('n(TH'), ['theta', "theta'"]);
  assert.deepEqual(offers('\nst'), ['step']);
  assert.deepEqual(offers('; me'), ['method']);
  assert.deepEqual(offers('\nmethod ve'), ['verlet', 'velocity-verlet']);
  assert.deepEqual(offers('\nmethod '), ['verlet', 'rk4', 'velocity-verlet']);
  for (const more of ['\n# st', '\ns', '\nmethod rk4', 'n(theta', '\n2si', 'zz']) assert.equal(offers(more), null, more);
  assert.deepEqual(offers('\nst x', 3), ['step']);
  assert.equal(completion('sixth', 2, known), null);                   // inside a word
  assert.deepEqual(offers('\ns', 2, true), ['step']);
});

test('the title is the model’s own', () => {
  const titles = [['# a pendulum, let go\nx', 'A pendulum, let go'], ['# A spring. With friction.', 'A spring'], ["x'' = -x # no", ''], ['', ''], ['# ----\n# spring', ''],
    ['\n\n## über alles:', 'Über alles'], [`# ${'long '.repeat(20)}`, '']];
  for (const [text, title] of titles) assert.equal(ownTitle(text), title, text);
});

test('a text that keeps no line is another model', () => {
  assert.equal(another("x'' = -k x\nk = 2\n", "x'' = -k x\nk = 3\n"), false);
  assert.equal(another("x'' = -x\nx(0) = 1", "# mine\n\n  x'' = -x"), false);
  assert.equal(another("x'' = -x\n\nx(0) = 1", "theta'' = -theta\n\ntheta(0) = 1"), true);
  assert.equal(another("x'' = -x", ''), true);
});
