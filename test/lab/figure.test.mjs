/* Pens, axes, numbers and files of the pictures. Run by `node --test`; the sources are bundled on the way.
 * Laws: SVG is well formed whatever it is made of; axes map what is finite to what is finite; thinning loses no peak; a table's numbers are whole.
 */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url);
const { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const contents = `
  export * from './figure/svg'; export * from './figure/axes'; export * from './figure/number'; export * from './figure/export';
  export * from './figure/track'; export * from './figure/table'; export * from './figure/ink';`;
const built = buildSync({ stdin: { contents, resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022' });
const f = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));

const ink = { text: '#111111', quiet: '#555555', grid: '#eeeeee', axis: '#888888', surface: '#ffffff', exact: '#15803D', accent: '#1D4ED8', danger: '#B42318' };
const nasty = ['</text><script>', '<!--', ']]>', '&amp;', '"\'><', '\u0000\u0008\u001b', '\ud800', 'θ₁″ 👩‍🔬', '\uffff', 'url(#x)', '" onload="'];

/** Every tag closed in order, every attribute quoted, no stray < or & and no character that XML forbids. */
function wellFormed(text) {
  const open = [];
  assert.doesNotMatch(text, /[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]|\p{Cs}/u);
  assert.doesNotMatch(text, /&(?!#\d+;)/);
  const rest = text.replace(/<(\/?)([A-Za-z]+)((?:\s+[A-Za-z:-]+="[^"<]*")*)\s*(\/?)>/g, (_, close, name, attributes, empty) => {
    const names = [...attributes.matchAll(/([A-Za-z:-]+)=/g)].map((m) => m[1]);
    assert.equal(new Set(names).size, names.length, 'no attribute twice');
    if (close) assert.equal(open.pop(), name); else if (!empty) open.push(name);
    return '';
  });
  assert.deepEqual(open, []);
  assert.doesNotMatch(rest, /[<>]/);
}

test('SVG is well formed for any label, colour and number', () => {
  for (const text of nasty) {
    const pen = f.svgPen(300, 200);
    f.axes(pen, ink, { min: -1, max: 1, label: text }, { min: 1e-9, max: 1, log: true, label: text });
    pen.line([0, NaN, 1, 2, Infinity, 3, 4, 5], { colour: text, width: 2, dash: [NaN, 3] });
    pen.area([0, 0, 1, NaN], text, 0.5);
    for (const shape of ['circle', 'square', 'triangle', 'diamond', 'cross', 'plus', 'star', 'down', 'ring', 'bar']) pen.mark(shape, 1, 2, 3, text), pen.mark(shape, NaN, 0, 3, text);
    pen.arrow(0, 0, 9, 9, { colour: text, width: 1 });
    pen.arrow(0, 0, 0, 0, { colour: text, width: 1 });
    pen.text(1, 1, text, { colour: text, turn: -90, bold: true, italic: true, anchor: 'end', baseline: 'top', size: 9 });
    pen.box(0, 0, NaN, 1, text);
    pen.cells(0, 0, 10, 10, 2, 2, Uint8Array.of(0, 1, 1, 2), ['', text, 'red']);
    assert.throws(() => pen.clip(0, 0, 5, 5, () => { throw new Error('inside'); }));
    const svg = pen.svg(text, text, text);
    wellFormed(svg);
    assert.doesNotMatch(svg, /NaN|Infinity/);
  }
});

test('axes are finite whatever the bounds', () => {
  const bounds = [[0, 0], [1, 1], [NaN, NaN], [Infinity, -Infinity], [5, -5], [1e-320, 1e-310], [-1e308, 1e308], [1, 1 + 4e-16], [-3, 0], [1e300, Infinity], [10.625, 10.6250000000005]];
  for (const [min, max] of bounds) for (const log of [false, true]) for (const linear of [undefined, 1e-3]) for (const size of [[60, 40], [320, 200], [3000, 2000]]) {
    const frame = f.axes(f.svgPen(...size), ink, { min, max, log, label: 'x' }, { min, max, log, linear, label: 'y' });
    for (const scale of [frame.x, frame.y]) for (const v of scale.ticks) {
      assert.ok(Number.isFinite(scale(v)), `${min} ${max} ${log} ${v}`);
      assert.doesNotMatch(scale.label(v), /NaN|Infinity|undefined|-|e/);
    }
  }
});

test('equal axes have one unit', () => {
  for (const size of [[320, 300], [900, 300], [200, 700]]) {
    const { x, y } = f.axes(f.svgPen(...size), ink, { min: -2, max: 5, label: 'x' }, { min: 1e5, max: 1e5 + 3, label: 'y' }, { equal: true });
    assert.ok(Math.abs((x(1) - x(0)) + (y(1e5 + 1) - y(1e5))) < 1e-6);
  }
});

test('labels along an axis differ, and leave each other room', () => {
  for (const [min, max] of [[0, 3], [0, 65.97], [-1e-7, 1e-7], [0, 1e9], [0.1, 0.13], [10.625 - 1e-13, 10.625 + 1e-13], [0, 17.0652165601579]]) for (const width of [150, 320, 1200]) {
    const { x } = f.axes(f.svgPen(width, 200), ink, { min, max, label: 't' }, { min: 0, max: 1, label: '' });
    const labels = x.ticks.map(x.label);
    assert.equal(new Set(labels).size, labels.length, labels.join(' '));
    assert.ok(labels.length >= 1);
  }
});

test('thinning keeps the ends, the peaks and the gaps', () => {
  const n = 100000, x = Float64Array.from({ length: n }, (_, i) => i), y = Float64Array.from({ length: n }, (_, i) => (i === 51234 ? 1000 : i === 61234 ? -1000 : Math.sin(i)));
  y[70000] = NaN;
  const fx = Object.assign((v) => v / 200, { ticks: [] }), fy = Object.assign((v) => v, { ticks: [] });
  const xy = f.thin(x, y, fx, fy), ys = xy.filter((_, i) => i % 2 === 1);
  assert.ok(xy.length < 2 * (4 * 501 + 4));
  assert.ok(ys.includes(1000) && ys.includes(-1000) && ys.some(Number.isNaN));
  assert.equal(ys[0], y[0]);
  assert.equal(ys[ys.length - 1], y[n - 1]);
  for (let i = 2; i < xy.length; i += 2) assert.ok(!(xy[i] < xy[i - 2]));
});

test('values come from rows, and from nowhere else', () => {
  const t = [0, 1, 2], back = [2, 1, 0], v = [10, 20, 40];
  assert.equal(f.valueAt(t, v, 1), 20);
  assert.equal(f.valueAt(t, v, 1.5), 30);
  assert.equal(f.valueAt(back, v, 0.5), 30);
  for (const at of [-1, 3]) assert.ok(Number.isNaN(f.valueAt(t, v, at)));
  assert.ok(Number.isNaN(f.valueAt([], [], 0)));
});

test('one runaway does not spoil the view', () => {
  const calm = [0, 1, -1, 0], wild = [0, 5, -1e300, 1e308];
  for (const truth of [null, calm]) {
    const { bounds, leaving } = f.viewOf(truth, [calm, wild]);
    assert.deepEqual(leaving, [1]);
    assert.ok(bounds[0] > -4 && bounds[1] < 4);
  }
});

test('a table is saved with every digit, and text is not a formula', () => {
  const text = f.csv({ head: ['t', 'a "b"', '=x'], rows: [[0.1 + 0.2, -1e-300, '=1+1'], [NaN, Infinity, 'a,b'], [-5, -0.25, '-x']] });
  assert.equal(text, '"t","a ""b""","\'=x"\n0.30000000000000004,-1e-300,"\'=1+1"\n,inf,"a,b"\n-5,-0.25,"\'-x"\n');
  assert.deepEqual(f.evenly(3), [0, 1, 2]);
  const many = f.evenly(4001);
  assert.equal(many.length, 200);
  assert.equal(many[0], 0);
  assert.equal(many[199], 4000);
});

test('every method looks like itself alone, those of tomorrow too', () => {
  globalThis.document = { documentElement: { dataset: { theme: 'light' } } };
  globalThis.getComputedStyle = () => ({ getPropertyValue: () => '' });
  globalThis.matchMedia = () => ({ matches: false });
  const today = JSON.parse(execFileSync(process.env.MOTUS ?? fileURLToPath(new URL('../../build/motus', import.meta.url)), ['methods', '--json'])).methods;
  const tomorrow = Array.from({ length: 40 }, (_, k) => ({ name: `new-${k}`, title: `New ${k}`, aliases: [`n${k}`], adaptive: k % 2 > 0 }));
  const catalogue = [...today, ...tomorrow], seen = new Map();
  for (const method of catalogue) {
    const [look] = f.looksOf([method.name], catalogue);
    assert.equal(look.label, method.title);
    const { colour, dash, marker } = look, key = JSON.stringify([colour, dash, marker]);
    assert.equal(seen.get(key), undefined, `${method.name} looks like ${seen.get(key)}`);
    seen.set(key, method.name);
    // A new row behind changes nobody's look.
    if (!method.name.startsWith('new-')) assert.deepEqual(f.looksOf([method.name], today), [look]);
  }
  const [known, other] = f.looksOf(['new-3', 'n3'], catalogue);
  assert.deepEqual({ ...known, method: '' }, { ...other, method: '' });
  assert.equal(f.looksOf(['newmark(1/6, 1/2)'], catalogue)[0].label, 'Newmark(1/6, 1/2)');
  delete globalThis.document, delete globalThis.getComputedStyle;
});

test('files have names that every system takes', () => {
  for (const name of ['../../etc/passwd', 'a b', 'θ₁', '', '...', 'CON:', 'x'.repeat(500), '\u0000', '-rf']) {
    f.nameExports(name);
    assert.match(f.fileName('time', 'csv'), /^[\p{L}\p{N}_][\p{L}\p{N}._-]*-time\.csv$/u);
  }
});

test('numbers read as on paper', () => {
  assert.deepEqual([0, -1.5, 1234.5678, 2.5e-9, -1e300, NaN, Infinity, 99999.6, 123456].map((v) => f.readable(v)), ['0', '−1.5000', '1234.6', '2.5×10⁻⁹', '−1×10³⁰⁰', '–', '∞', '1×10⁵', '1.2346×10⁵']);
  assert.equal(f.brief(2.5), '2.5');
  assert.equal(f.brief(100), '100');
});

/* Oklab [Ottosson 2020] of a colour as it is seen, and by those who lack one of two kinds of cones [Machado, Oliveira and Fernandes 2009]; in it, 0.02 is what two colours differ by when the eye
 * just tells them apart. */
const times = (rows, v) => rows.map((row) => row.reduce((sum, c, i) => sum + c * v[i], 0));
const linear = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16) / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
const EYES = [
  [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
];
const seenAs = (colour) => EYES.map((eye) => {
  const cones = times([[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566], [0.0883024619, 0.2817188376, 0.6299787005]], times(eye, linear(colour)).map((c) => Math.min(1, Math.max(0, c))));
  return times([[0.2104542553, 0.793617785, -0.0040720468], [1.9779984951, -2.428592205, 0.4505937099], [0.0259040371, 0.7827717662, -0.808675766]], cones.map(Math.cbrt));
});
const apart = (a, b) => Math.min(...seenAs(a).map((p, i) => Math.hypot(...p.map((c, k) => c - seenAs(b)[i][k]))));
const contrast = (a, b) => { const [p, q] = [a, b].map((c) => times([[0.2126, 0.7152, 0.0722]], linear(c))[0] + 0.05); return Math.max(p / q, q / p); };

test('methods that choose their steps are told from the others and from the exact motion, by every eye, on both themes', () => {
  globalThis.getComputedStyle = () => ({ getPropertyValue: () => '' });
  globalThis.matchMedia = () => ({ matches: false });
  const catalogue = JSON.parse(execFileSync(process.env.MOTUS ?? fileURLToPath(new URL('../../build/motus', import.meta.url)), ['methods', '--json'])).methods;
  const first = ['explicit-euler', 'symplectic-euler', 'midpoint', 'verlet', 'rk4'], choosing = catalogue.filter((m) => m.adaptive).map((m) => m.name), most = ['dopri5', 'dop853', 'dep12'];
  for (const [theme, grounds] of [['light', ['#FFFFFF', '#F4F5F7']], ['dark', ['#0F1214', '#1B2025']]]) {
    globalThis.document = { documentElement: { dataset: { theme } } };
    const look = (name) => f.looksOf([name], catalogue)[0], own = first.map((name) => look(name).colour);
    for (const name of choosing) assert.ok(!own.includes(look(name).colour), `${name}, ${theme}`);
    for (const name of most) {
      for (const other of [...first, ...most, 'exact', 'velocity-verlet', 'kahan-li8']) {
        if (other !== name) assert.ok(apart(look(name).colour, look(other).colour) > 3 * 0.02, `${name} and ${other}, ${theme}: ${apart(look(name).colour, look(other).colour)}`);
      }
    }
    for (const { name } of catalogue) for (const ground of grounds) {
      assert.ok(contrast(look(name).colour, ground) >= 3, `${name} on ${ground}`);
      assert.ok(contrast(look(name).tone, ground) >= 4.5, `letters of ${name} on ${ground}: ${contrast(look(name).tone, ground)}`);
    }
  }
});
