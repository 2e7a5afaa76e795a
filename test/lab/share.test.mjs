/* Addresses and command lines. Run by `node --test`; lab/share.ts is bundled on the way.
 * Law: what goes into an address or a shell comes out of it unchanged, and no address is an exception.
 */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url);
const { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const built = buildSync({ entryPoints: [fileURLToPath(new URL('share.ts', lab))], bundle: true, format: 'esm', write: false, target: 'es2022' });
const share = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));

const model = name => readFileSync(new URL(`../../models/${name}.motus`, import.meta.url), 'utf8');
const texts = { projectile: model('projectile'), spring: model('spring') };
const presets = {
  first: 'projectile',
  text: name => (Object.hasOwn(texts, name) ? texts[name] : undefined),
  methods: name => (name === 'projectile' ? ['explicit-euler', 'symplectic-euler', 'midpoint'] : ['verlet']),
};
const start = share.presetState(presets, 'projectile');

const nasty = [
  "it's", "''", "'\\''", '"', '`id`', '$(id)', '$HOME', '\\', '\\n', '!', '!!', '~', '*', '?', '[a]', '{a,b}', ';', '|', '&', '&&', '>', '<', '#', '%', '%41', '%zz',
  '</script>', '<!--', '-->', ']]>', '&amp;', '=', '+', ' ', '  x ', '\t', 'a\nb', '\n', '\n\n', 'MOTUS_END', 'MOTUS_END\nMOTUS_END_2', "x'' = -x\n'\nMOTUS_END\nid",
  'θ₁″ = −sin θ', '𝑥', '👩‍🔬🎯', 'é', 'é', '﻿bom', '﷽', '\u2028', '\u202e', '-n', '--', '-e', '',
];

test('an address holds what differs from the preset, and nothing else', () => {
  assert.equal(share.encode(start, presets), 'v=1&p=projectile');
  assert.equal(share.encode({ ...start, step: 'pi/100', until: '2 pi', methods: ['verlet', 'newmark(1/4, 1/2)'], set: { g: '(0, -1.62)', "r'(0)": '(1, 2)' } }, presets),
    'v=1&p=projectile&s=g%3D(0,%20-1.62)&s=r%27(0)%3D(1,%202)&a=verlet,newmark(1%2F4,%201%2F2)&h=pi%2F100&T=2%20pi');
  assert.ok(share.encode({ ...start, text: 'é\n' }, presets).startsWith('v=1&m=%C3%A9%0A&a='));
});

test('what is encoded is free of what a page or a shell might read', () => {
  for (const text of nasty) assert.match(share.encode({ ...start, text: text + '#' }, presets), /^[A-Za-z0-9\-._~(),*%&=]*$/);
});

test('every state comes back', () => {
  for (const text of nasty) {
    const one = /[\n\t\u2028]/.test(text) || text.trim() !== text || text === '' ? 'y' : text;
    const state = {
      ...start, preset: '', text, set: { x: one, [one.replace(/=/g, '') || 'k']: '1', __proto__: null, ['__proto__']: '2' }, methods: ['verlet', 'rk4'], step: one, tolerance: one, until: one,
      view: { plane: 'space', quantities: [one, 'x[1,2]'], phase: [one, "x'"], exact: false, speed: 0.25 },
    };
    const back = share.decode('#' + share.encode(state, presets), presets);
    assert.equal(back.problem, '');
    assert.deepEqual({ ...back.state, set: Object.entries(back.state.set) }, { ...state, set: Object.entries(state.set) });
    assert.equal(share.encode(back.state, presets), share.encode(state, presets));
  }
  assert.deepEqual(share.decode('', { ...presets }).state, start);
  assert.deepEqual(share.decode('v=1&p=projectile', presets).state, start);
  assert.equal({}.polluted, undefined);
});

test('a section comes back: its condition, its plane, its starts', () => {
  const own = { ...presets, section: name => (name === 'spring' ? { when: 'every 2 pi', starts: [] } : undefined) }, of = share.presetState(own, 'spring'), bare = { ...of, view: { ...of.view } };
  delete bare.view.section;
  assert.deepEqual(of.view.section, { when: 'every 2 pi', starts: [] });
  assert.equal(share.encode(of, own), 'v=1&p=spring');
  assert.deepEqual(share.decode('v=1&p=spring', own).state, of);
  assert.deepEqual(share.decode(share.encode(bare, own), own).state, bare, 'none, where the example has one');
  for (const section of [{ when: 'x = 0 rising', starts: [] }, { when: 'kick', plane: ['x mod 2 pi', "x'"], starts: [[0.1, -2e-7], [1, 2]] }]) {
    const state = { ...of, view: { ...of.view, section } };
    assert.deepEqual(share.decode(share.encode(state, own), own), { state, problem: '' });
    assert.deepEqual(share.viewFor(own, 'projectile', state.view), share.defaultView, 'another example does not keep it');
  }
  for (const wrong of ['K=x&K=y', 'b=1,2', 'k=x&K=y', 'k=x&b=1,,2', 'k=x&b=a', 'k=x&b=1e999', `k=x${'&b=1'.repeat(65)}`]) assert.notEqual(share.decode(`v=1&p=spring&${wrong}`, own).problem, '', wrong);
});

test('a place comes back, and no other', () => {
  for (const place of ['', 'gallery', 'step', 'too-high-too-low.try.0']) assert.deepEqual(share.decode(share.encode({ ...start, place }, presets), presets), { state: { ...start, place }, problem: '' });
  for (const place of ['steps', 'step.1', 'stage']) assert.match(share.decode(`v=1&p=projectile&l=${place}`, presets).problem, /a place that does not exist/);
});

test('an embed and its sliders come back', () => {
  for (const embed of [[], ['step'], ['step', 'k', "r'(0).y", 'x[1,2](0)', 'm[2]']]) {
    const state = { ...start, embed }, fragment = share.encode(state, presets);
    assert.deepEqual(share.decode('#' + fragment, presets), { state, problem: '' });
  }
  assert.equal(share.encode({ ...start, embed: ['step', "r'(0).y"] }, presets), 'v=1&p=projectile&embed=1&c=step&c=r%27(0).y');
  assert.deepEqual(share.decode('v=1&p=projectile&embed=1&c=k&c=k', presets).state.embed, ['k']);
  assert.equal('embed' in share.decode('v=1&p=projectile', presets).state, false);
  for (const [fragment, why] of [['embed=0', /“embed” is 1/], ['embed=', /“embed” is 1/], ['embed', /“embed” is 1/], ['embed=1&embed=1', /twice/], ['c=step', /without “embed=1”/], ['embed=1&c=', /no name/],
    ['embed=1&c=%0A', /control/], ['embed=1&c=' + 'x'.repeat(300), /too long/], ['embed=1' + '&c=k'.repeat(40), /too many/], ['embed=1&l=gallery', /no other place/], ['embed=1&l=step', /no other place/]]) {
    const { state, problem } = share.decode('v=1&p=spring&' + fragment, presets);
    assert.match(problem, why, fragment);
    assert.deepEqual(state, start);
  }
});

test('a pinned run comes back, and one that cannot be read is told', () => {
  const { text, methods } = start, run = { text, set: {}, methods, step: '', tolerance: '', accuracy: '', until: '' };
  const all = [[{}, 'A=1'], [{ step: '0.1' }, 'A=1&Ah=0.1'], [{ tolerance: '1e-6' }, 'A=1&Ar=1e-6'], [{ accuracy: '1e-6' }, 'A=1&Ag=1e-6'], [{ accuracy: 'off' }, 'A=1&Ag=off'], [{ set: { g: '(0, -1.62)', "r'(0)": '(1, 2)' }, until: '2 pi', methods: ['rk4'] }, 'A=1&As=g%3D(0,%20-1.62)&As=r%27(0)%3D(1,%202)&Aa=rk4&AT=2%20pi'],
    [{ text: "x'' = 1\n", methods: ['verlet'] }, 'A=1&Am=x%27%27%20%3D%201%0A&Aa=verlet']];
  for (const [part, wanted] of all) {
    const state = { ...start, step: '0.2', pinned: { ...run, ...part } }, fragment = share.encode(state, presets);
    assert.equal(fragment, 'v=1&p=projectile&h=0.2&' + wanted);
    assert.deepEqual(share.decode('#' + fragment, presets), { state, problem: '' });
  }
  for (const text of nasty) {
    const one = /[\n\t\u2028]/.test(text) || text.trim() !== text || text === '' ? 'y' : text, state = { ...start, text: text + '1', preset: '', methods: [], pinned: { text, set: { x: one }, methods: ['rk4'], step: one, tolerance: one, accuracy: one, until: one } };
    assert.deepEqual(share.decode(share.encode(state, presets), presets), { state, problem: '' });
  }
  const plain = share.decode('v=1&p=projectile&h=0.2', presets).state;
  for (const [fragment, why] of [['A=2', /“A” is 1/], ['A', /“A” is 1/], ['Ah=0.1', /“A” is 1/], ['A=1&A=1', /twice/], ['A=1&Ah=1&Ah=2', /twice/], ['A=1&As=g', /name=value/], ['A=1&Am=%00', /control/], ['A=1&Ah=%', /percent/], ['A=1&Az=1', /“Az”/],
    ['A=1&Ah=' + '1'.repeat(300), /too long/], ['A=1' + '&As=k%3D1'.repeat(300), /too many/], ['A=1&Aa=' + 'a,'.repeat(3), ''], ['A=1&Aa=' + Array.from({ length: 60 }, (_, k) => `m${k}`).join(), /too many/]]) {
    const { state: { pinned, ...state }, problem } = share.decode('v=1&p=projectile&h=0.2&' + fragment, presets);
    assert.deepEqual(state, plain);
    if (why) { assert.match(problem, why, fragment); assert.match(problem, /pinned run A/); assert.equal(pinned, undefined); } else assert.equal(problem, '');
  }
});

test('no address is an exception', () => {
  const wrong = ['v=2&p=projectile', 'p=projectile', 'v=1', 'v=1&p=nothing', 'v=1&p=__proto__', 'v=1&p=constructor', 'v=1&m=%', 'v=1&m=%4', 'v=1&m=%GG', 'v=1&m=%FF', 'v=1&m=%C3',
    'v=1&m=%ED%A0%80', 'v=1&m=%00', 'v=1&m=%1B%5B2J', 'v=1&p=spring&zz=1', 'v=1&p=spring&p=spring', 'v=1&p=spring&s=k', 'v=1&p=spring&s==2', 'v=1&p=spring&s=k%3D', 'v=1&p=spring&w=9',
    'v=1&p=spring&f=x', 'v=1&p=spring&e=2', 'v=1&p=spring&z=-1', 'v=1&p=spring&z=0', 'v=1&p=spring&z=NaN', 'v=1&p=spring&h=1%0A2',
    'v=1&m=' + 'x'.repeat(share.longest), 'v=1&p=spring&' + 's=k%3D1&'.repeat(300), 'v=1&p=spring&h=' + '1'.repeat(300), '=', '&', '%', '#'];
  for (const fragment of wrong) {
    const { state, problem } = share.decode('#' + fragment, presets);
    assert.notEqual(problem, '', fragment.slice(0, 60));
    assert.deepEqual(state, start);
  }
  let seed = 7;                                                 // and noise, always the same
  const next = n => (seed = (seed * 48271) % 2147483647) % n;
  for (let i = 0; i < 3000; i++) {
    const noise = Array.from({ length: next(40) }, () => 'v=1&pmsahTwqfoezcA%0123456789ABCDEF()[]\'"<>\u00e9\ud83d'[next(52)] ?? '').join('');
    assert.equal(typeof share.decode(noise, presets).problem, 'string');
    assert.equal(typeof share.decode('v=1&p=spring&' + noise, presets).state.text, 'string');
  }
});

test('a lone surrogate does no harm', () => {
  assert.equal(share.decode(share.encode({ ...start, text: 'a\ud83db' }, presets), presets).state.text, 'a\ufffdb');
});

test('a word stays one word in a shell', () => {
  for (const text of nasty) {
    assert.equal(execFileSync('sh', ['-c', `printf %s ${share.quote(text)}`], { encoding: 'utf8' }), text);
  }
});

/* What a program named motus would be given by the command: its arguments, one a line, NUL-terminated, and its input. */
const heard = text => execFileSync('sh', ['-c', `motus() { printf '%s\\0' "$@"; printf 'INPUT\\0'; cat; }\n${text}`], { encoding: 'utf8', input: '' }).split('\0');

test('the command says what the page computed', () => {
  assert.equal(share.command(start, start.methods).text.split('\n')[0], "motus compare - --methods explicit-euler,symplectic-euler,midpoint <<'MOTUS_END'");
  assert.equal(heard(share.command(start, start.methods).text).at(-1), start.text.endsWith('\n') ? start.text : start.text + '\n');
  assert.equal(share.command({ ...start, step: 'pi/100', set: { g: '(0, -1.62)', "r'(0)": '(1, 2)' } }, ['verlet']).text.split('\n')[0],
    "motus run - --method verlet --step pi/100 --set 'g=(0, -1.62)' --set 'r'\\''(0)=(1, 2)' <<'MOTUS_END'");
  for (const text of nasty) {
    const one = /[\n\t]/.test(text) ? 'y' : text;
    const got = heard(share.command({ ...start, text, step: one || '1', set: { x: one } }, ['rk4']).text);
    const input = text.endsWith('\n') || text === '' ? text : text + '\n';
    assert.deepEqual(got, ['run', '-', '--method', 'rk4', '--step', one || '1', '--set', `x=${one}`, 'INPUT', input]);
  }
});

test('a decimal comma is the reader’s, not the program’s', () => {
  const { state } = share.decode('#v=1&p=spring&h=0,05&T=1,5', presets);
  assert.equal(share.command(state, ['verlet']).text.split('\n')[0], "motus run - --method verlet --step 0.05 --until 1.5 <<'MOTUS_END'");
  // A step is for steps of one size, a tolerance for the others; the program compares steps of one size alone.
  const both = { ...state, tolerance: '1e-6' }, lines = (methods, adaptive) => share.command(both, methods, adaptive).text.split('\n').filter(line => line.startsWith('motus'));
  assert.deepEqual(lines(['dop853'], ['dop853']), ["motus run - --method dop853 --tolerance 1e-6 --until 1.5 <<'MOTUS_END'"]);
  assert.deepEqual(lines(['verlet', 'dop853'], ['dop853']), ["motus run - --method verlet --step 0.05 --until 1.5 <<'MOTUS_END'", "motus run - --method dop853 --tolerance 1e-6 --until 1.5 <<'MOTUS_END'"]);
});

test('control characters are refused', () => {
  for (const c of ['\0', '\x1b', '\x7f', '\x9b', '\r']) {
    assert.equal(share.command({ ...start, text: `x${c}` }, ['rk4']).text, '');
    assert.equal(share.command({ ...start, step: `1${c}` }, ['rk4']).text, '');
    assert.notEqual(share.command({ ...start, text: `x${c}` }, ['rk4']).problem, '');
  }
});
