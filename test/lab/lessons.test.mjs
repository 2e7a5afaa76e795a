/* The lessons: the reader of their text, and what they claim. Run by `node --test`; the page's module is that of build/lab.
 *
 * Law: every number that a lesson tells its reader is the program's for the lesson's scene, to the digits that are told.
 */
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const lab = new URL('../../lab/', import.meta.url), need = createRequire(new URL('package.json', lab));
const { buildSync } = need('esbuild');
const built = buildSync({
  stdin: { contents: "export * from './lessons/read'; export { sceneOf } from './scenes'; export { Core } from './core'; export { Answers } from './answers';", resolveDir: fileURLToPath(lab), loader: 'ts' },
  bundle: true, format: 'esm', write: false, target: 'es2022', alias: { 'ml-matrix': fileURLToPath(new URL('node_modules/ml-matrix/src/index.js', lab)) },
});
const { readLesson, readLessons, met, sceneOf, Core, Answers } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));
const answers = new Answers(new Core(new WebAssembly.Module(readFileSync(new URL('../../build/lab/motus.wasm', import.meta.url)))));
const catalogue = answers.answer('catalogue', {});
const folder = new URL('../../models/', import.meta.url);
const textOf = name => readFileSync(new URL(`${name}.motus`, folder), 'utf8');
const known = { models: readdirSync(folder).filter(name => name.endsWith('.motus')).map(name => name.slice(0, -6)), methods: catalogue.map(({ name }) => name) };
const files = readdirSync(new URL('words/en/lessons/', lab)).filter(name => name.endsWith('.txt')).map(name => ({ name, text: readFileSync(new URL(`words/en/lessons/${name}`, lab), 'utf8') }));
const lessons = readLessons(files, known);

/* The reader -------------------------------------------------------------------------------------------------------- */

const good = `# A comment.
lesson: Too high,
  too low
scene: spring
set: k = 4
methods: verlet, explicit-euler
step: 0.1
view: time, phase
predict: Where?
  There?

  A second paragraph.
hide: verlet
rail: verlet x, above on
right: Here
  You said here.
  It is.
wrong: There
  You said there.
button: Go
try: Do it.
do: method rk4 on
  RK4
do: step 0.05
do: until 30
do: set k = 9
measured: distance
do: opened step
do: scene pendulum
see: It went.
why: Because
  One.

  Two.
picture: halves
caption: half
next: another
number: “It” 3 = steps(verlet) / 2
`;
const refused = (text, file = '1-a.txt') => {
  try {
    readLesson(file, text, known);
  } catch (e) {
    return e.message;
  }
  return '';
};

test('a lesson is read as it stands', () => {
  assert.deepEqual(readLesson('lab/words/en/lessons/12-my-own.txt', good, known), {
    id: 'my-own', title: 'Too high, too low',
    scene: { model: 'spring', set: { k: '4' }, methods: ['verlet', 'explicit-euler'], step: '0.1', until: '', view: ['time', 'phase'] },
    predict: {
      text: ['Where? There?', 'A second paragraph.'], hide: ['verlet'], button: 'Go', hint: '', rail: { method: 'verlet', column: 'x' },
      choices: [{ label: 'Here', right: true, answer: 'You said here. It is.', place: 'above' }, { label: 'There', right: false, answer: 'You said there.', place: 'on' }],
    },
    attempt: {
      text: ['Do it.'],
      tasks: [
        { condition: { kind: 'method', method: 'rk4', on: true }, label: 'RK4' }, { condition: { kind: 'step', value: 0.05 }, label: 'step 0.05' },
        { condition: { kind: 'until', value: 30 }, label: 'until 30' }, { condition: { kind: 'set', name: 'k', value: '9' }, label: 'set k = 9' },
        { condition: { kind: 'opened', place: 'step' }, label: 'opened step' }, { condition: { kind: 'scene', model: 'pendulum' }, label: 'scene pendulum' },
      ], measured: 'distance',
    },
    see: ['It went.'], why: { title: 'Because', text: ['One.', 'Two.'], picture: 'halves', caption: 'half' }, next: 'another',
    numbers: [{ said: 'It', value: '3', quantity: 'steps(verlet) / 2', line: 38 }],
  });
  assert.deepEqual(readLesson('1-a.txt', '\ufeff' + good.replaceAll('\n', '\r\n'), known), readLesson('1-a.txt', good, known));
});

test('what is wrong is said with file, line and what would be right', () => {
  for (const [from, to, ...said] of [
    ['scene: spring', 'scene: sprong', '1-a.txt:4: there is no scene “sprong” (did you mean “spring”?)'],
    ['methods: verlet, explicit-euler', 'methods: verlet, euler-explicit', '1-a.txt:6: there is no method “euler-explicit”'],
    ['methods: verlet,', 'methods: verlett,', '1-a.txt:6: there is no method “verlett” (did you mean “verlet”?)'],
    ['step: 0.1', 'step: small', '1-a.txt:7: step is a number above 0, not “small”'],
    ['step: 0.1', 'stepp: 0.1', '1-a.txt:7: there is no key “stepp” (did you mean “step”?)'],
    ['view: time, phase', 'view: tyme', '1-a.txt:8: there is no view “tyme” (did you mean “time”?)'],
    ['hide: verlet', 'hide: rk4', '1-a.txt:13: there is no method in this lesson “rk4”'],
    ['rail: verlet x, above on', 'rail: verlet x, above', '1-a.txt:14: the rail has 1 places for 2 choices'],
    ['rail: verlet x, above on', 'rail: verlet x, above no', '1-a.txt:14: there is no place on a rail “no” (one of above, on, below)'],
    ['rail: verlet x, above on', 'rail: x', 'a rail says whose column is guessed'],
    ['right: Here', 'wrong: Here', '1-a.txt:15: none of the choices is right'],
    ['wrong: There', 'right: There', '1-a.txt:18: “right:” stands here a second time; it is in line 15 already'],
    ['wrong: There\n  You said there.\n', 'wrong: There\n', '1-a.txt:18: what is answered to “There” is missing'],
    ['wrong: There\n  You said there.\n', '', '1-a.txt:9: a prediction has two choices or more'],
    ['do: method rk4 on', 'do: method rk4', '1-a.txt:22: a method is switched on or off'],
    ['do: method rk4 on', 'do: metod rk4 on', '1-a.txt:22: “metod rk4 on” is no condition'],
    ['do: step 0.05', 'do: step 0,05', '1-a.txt:24: step is a number above 0, not “0,05”'],
    ['do: step 0.05', 'do: step 0.05 0.1', '1-a.txt:24: “0.1” is too much'],
    ['do: opened step', 'do: opened door', '1-a.txt:28: there is no place to open “door”'],
    ['picture: halves', 'picture: halfs', '1-a.txt:35: there is no close-up picture “halfs” (did you mean “halves”?)'],
    ['do: set k = 9', 'do: set k', '1-a.txt:26: what k is set to is not said (do: set gamma = 0.1)'],
    ['measured: distance', 'measured: distnce', '1-a.txt:27: there is nothing to measure “distnce” (did you mean “distance”?)'],
    ['picture: halves\n', '', 'a caption needs a picture'],
    ['set: k = 4', 'set: k', '1-a.txt:5: “k” sets nothing'],
    ['see: It went.\n', '', '1-a.txt: “see:” is missing'],
    ['see: It went.', 'see:', '“see:” is empty'],
    ['# A comment.', '  An orphan.', '1-a.txt:1: an indented line belongs to the key above it'],
    ['button: Go', 'Go', '1-a.txt:20: “Go” is no “key: text”'],
    ['number: “It” 3 = steps(verlet) / 2', 'number: many', 'says nothing about a number'],
    ['scene: spring\nset: k = 4', 'scene: sprong\nset: k', 'there is no scene “sprong”', '“k” sets nothing'],
  ]) {
    assert.ok(good.includes(from), from);
    const message = refused(good.replace(from, to));
    for (const part of said) assert.ok(message.includes(part), `${to}: ${message}`);
  }
  assert.match(refused(good, 'mine.txt'), /named by its number/);
  assert.throws(() => readLessons([{ name: '1-a.txt', text: good }, { name: '2-a.txt', text: good }], known), /2-a.txt: another lesson has the address “a”/);
  assert.deepEqual(readLessons([{ name: '10-b.txt', text: good }, { name: '9-a.txt', text: good }], known).map(({ id }) => id), ['a', 'b']);
  let seed = 11;                                                // whatever is written, it is read or refused with a place
  const next = n => (seed = (seed * 48271) % 2147483647) % n;
  for (let i = 0; i < 1000; i++) {
    const lines = good.split('\n');
    lines.splice(next(lines.length), 1 + next(3), ...[good.split('\n')[next(30)], 'x'.repeat(next(9)), '', 'see: \u0000', ' : '].slice(next(5)));
    const message = refused(lines.join('\n'));
    assert.ok(message === '' || message.split('\n').every(line => /^1-a\.txt(:\d+)?: /.test(line)), message);
  }
});

test('tasks tick themselves off', () => {
  const lesson = { scene: { set: { gamma: '0' } } };
  const done = { model: 'spring', methods: ['verlet'], step: 0.1, until: 20, set: { gamma: '0' }, opened: new Set(['step']) };
  for (const [condition, yes, no] of [
    [{ kind: 'method', method: 'verlet', on: true }, {}, { methods: ['rk4'] }],
    [{ kind: 'method', method: 'rk4', on: false }, {}, { methods: ['rk4'] }],
    [{ kind: 'step', value: 0.05 }, { step: 0.0502 }, { step: 0.052 }],
    [{ kind: 'until', value: 60 }, { until: 60 }, { until: 59 }],
    [{ kind: 'set', name: 'gamma' }, { set: { gamma: '0.1' } }, { set: { gamma: '0.0' } }],
    [{ kind: 'set', name: 'gamma' }, { set: {} }, {}],                 // its own value is friction too
    [{ kind: 'opened', place: 'step' }, {}, { opened: new Set() }],
    [{ kind: 'scene', model: 'spring' }, {}, { model: 'pendulum' }],
  ]) {
    assert.equal(met(condition, lesson, { ...done, ...yes }), true, JSON.stringify(condition));
    assert.equal(met(condition, lesson, { ...done, ...no }), false, JSON.stringify(condition));
  }
});

test('the lesson that the manual shows is read, and its words are the reader’s', () => {
  const manual = readFileSync(new URL('../../doc/lessons.md', import.meta.url), 'utf8');
  const shown = manual.split('\n').filter(line => line.startsWith('    ') || line === '').map(line => line.slice(4)).join('\n');
  assert.equal(readLesson('2-shown.txt', shown, known).why.text.length, 2);
  const reader = readFileSync(new URL('lessons/read.ts', lab), 'utf8');
  const keys = [.../const keys[^]*?\n};/.exec(reader)[0].matchAll(/'([a-z]+)': \{/g)].map(match => match[1]);
  assert.ok(keys.length > 20);
  const [, table] = /\| key \|[^\n]*\n([^]*?)\n\n/.exec(manual);
  assert.deepEqual([...table.matchAll(/`([a-z]+)`(?=[^|]*\|)/g)].map(match => match[1]).filter(word => keys.includes(word)).filter((word, k, all) => all.indexOf(word) === k).sort(), [...keys].sort());
  for (const [, words] of reader.matchAll(/export const (?:pictures|places|opened|measured) = \[([^\]]*)\]/g)) for (const [, word] of words.matchAll(/'([^']*)'/g)) assert.ok(manual.includes(word), word);
});

/* What the lessons claim -------------------------------------------------------------------------------------------- */

test('the lessons are the seven, each leads to the next, and their scenes admit their methods', () => {
  assert.deepEqual(lessons.map(({ title }) => title), ['A step is a straight line', 'Too high, too low', 'Midpoint looks ahead', 'Halve the step', 'Who keeps the energy?', 'Verlet’s trick', 'When it blows up']);
  lessons.forEach((lesson, k) => {
    assert.equal(lesson.next !== '', k < lessons.length - 1, lesson.id);
    assert.ok(sceneOf(lesson.scene.model)?.theme, `${lesson.scene.model} is in the gallery`);
    const set = Object.entries(lesson.scene.set).map(([name, value]) => `${name}=${value}`);
    const { methods, columns, parameters } = answers.answer('describe', { model: { text: textOf(lesson.scene.model), set } });
    const asked = [...lesson.scene.methods, ...lesson.attempt.tasks.flatMap(({ condition }) => (condition.kind === 'method' ? [condition.method] : []))];
    for (const name of asked) assert.ok(methods.find(m => m.name === name)?.admitted, `${lesson.id}: ${name}`);
    for (const { condition } of lesson.attempt.tasks) if (condition.kind === 'set') assert.ok(parameters.some(p => p.name === condition.name), `${lesson.id}: ${condition.name}`);
    if (lesson.predict.rail) assert.ok(columns.some(c => c.name === lesson.predict.rail.column), lesson.id);
    // Nothing is done before the reader has done it.
    const done = { model: lesson.scene.model, methods: lesson.scene.methods, step: Number(lesson.scene.step), until: Number(lesson.scene.until), set: lesson.scene.set, opened: new Set() };
    for (const { condition, label } of lesson.attempt.tasks) assert.equal(met(condition, lesson, done), false, `${lesson.id}: ${label}`);
  });
});

/** One quantity: `miss(METHOD, COLUMN, step H, until T, set NAME=VALUE, scene MODEL)`, a number, or two of them with - or / between. */
function quantity(lesson, text) {
  const both = /^(.*\)|[\d.]+) ([-/]) (.*)$/.exec(text);
  if (both) return both[2] === '/' ? quantity(lesson, both[1]) / quantity(lesson, both[3]) : quantity(lesson, both[1]) - quantity(lesson, both[3]);
  if (/^[\d.]+$/.test(text)) return Number(text);
  const [, name, inside] = /^([a-z]+)\((.*)\)$/.exec(text) ?? [];
  assert.ok(name, `${lesson.id}: “${text}” is no quantity`);
  const options = { step: lesson.scene.step, until: lesson.scene.until, scene: lesson.scene.model, set: [] }, words = [];
  for (const part of inside.split(/\s*,\s*/)) {
    const [, key, value] = /^(step|until|scene|set) (.+)$/.exec(part) ?? [];
    if (key === 'set') options.set.push(value); else if (key) options[key] = value; else words.push(part);
  }
  const [method, column = ''] = words, row = catalogue.find(m => m.name === method);
  if (name === 'order') return row.order;
  if (name === 'limit') return row.stability_limit;
  const own = options.scene === lesson.scene.model ? Object.entries(lesson.scene.set).filter(([key]) => !options.set.some(s => s.startsWith(`${key}=`))).map(([key, value]) => `${key}=${value}`) : [];
  const claimed = name === 'spread' ? `\nclaimed = ${column}\n` : '', asked = name === 'steps' ? [] : name === 'spread' ? ['claimed'] : name === 'width' ? ['x', "x'"] : [column];
  const { tracks: [track], truth } = answers.answer('solve', {
    model: { text: textOf(options.scene) + claimed, set: [...own, ...options.set] }, methods: [method], step: Number(options.step), until: Number(options.until), columns: asked, rows: 1e5, truth: name === 'miss',
  });
  assert.equal(track.problem, null, text);
  const values = track.columns[0], end = values?.at(-1);
  switch (name) {
    case 'steps': return track.steps;
    case 'value': return end;
    case 'miss': return Math.abs(end - truth.columns[0].at(-1));
    case 'largest': return Math.max(...values.map(Math.abs));
    case 'spread': return Math.max(...values) - Math.min(...values);
    case 'width': return Math.hypot(end, track.columns[1].at(-1)) / Math.hypot(values[0], track.columns[1][0]);
    default: assert.fail(`${lesson.id}: there is no quantity ${name}`);
  }
}

/** Half a unit in the last digit that is told. */
function half(told) {
  const [, decimals = '', exponent = '0'] = /^-?\d+(?:\.(\d+))?(?:e(\d+))?$/.exec(told);
  return 0.5 * 10 ** (Number(exponent) - decimals.length);
}

test('every number of a lesson is the program’s', () => {
  let count = 0;
  for (const lesson of lessons) for (const { said, value, quantity: text, line } of lesson.numbers) {
    const computed = quantity(lesson, text);
    assert.ok(Math.abs(computed - Number(value)) <= half(value), `${lesson.id}, line ${line}: “${said}” is told as ${value}; ${text} is ${computed}`);
    count++;
  }
  assert.ok(count > 40, `${count}`);
});

test('no number of a lesson is without its computation', () => {
  const spelled = /\b(?:five|ten|twenty|thirty|hundred|thousand|(?:\w+ )?million|quarter)\b/gi;
  for (const lesson of lessons) {
    const { predict, attempt, see, why, scene } = lesson, said = lesson.numbers.map(n => n.said);
    // What is given or chosen, rather than claimed.
    const given = [scene.step, scene.until, ...attempt.tasks.flatMap(({ condition }) => ('value' in condition ? [String(condition.value)] : [])), ...predict.choices.map(c => c.label)];
    const texts = [...predict.text, ...predict.choices.map(c => c.answer), ...attempt.text, ...see, why.title, ...why.text, why.caption];
    for (const text of texts) {
      const told = text.replace(/Lesson \d/g, '').match(/\d+(?:\.\d+)?(?!\d*h)/g) ?? [];
      for (const number of told) assert.ok(given.includes(number) || said.some(s => s.match(/\d+(?:\.\d+)?/g)?.includes(number)), `${lesson.id}: ${number} in “${text}”`);
      for (const [word] of text.matchAll(spelled)) assert.ok(said.some(s => s.toLowerCase().includes(word.toLowerCase())) || /\bmake five steps\b/.test(text) || predict.choices.some(c => c.label.toLowerCase().includes(word.toLowerCase())), `${lesson.id}: ${word} in “${text}”`);
    }
    for (const s of said) assert.ok(texts.some(text => text.toLowerCase().includes(s.toLowerCase())) || predict.choices.some(c => `${c.label} ${c.answer}`.toLowerCase().includes(s.toLowerCase())), `${lesson.id} does not say “${s}”`);
  }
});
