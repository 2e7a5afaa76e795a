/* The picture of a motion, without a browser: the library's module computes a scene, the page's code draws it onto a pen that keeps what it is asked for.
 * Law: what is written agrees with what is drawn and with the numbers of the run, and stands within the stage at every size of it.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url), { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const contents = `export { Answers } from './answers'; export { Core } from './core'; export { looksOf, named } from './figure/ink'; export { textWidth } from './figure/shapes';
  export { defaultView } from './share'; export * from './stage/picture'; export { firstMoving } from './distance'; export { seenIn } from './panel/steps/seen'; export { extentOf, suits } from './stage/bounds'; export { motionOf, furthestOf } from './stage/motion'; export { placeOf } from './stage/place'; export { HOME } from './stage/plot';
  export { stagings } from './stage/stagings'; export { subjects } from './stage/subject';`;
const bundled = buildSync({ stdin: { contents, resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022' });
const page = await import('data:text/javascript;base64,' + Buffer.from(bundled.outputFiles[0].contents).toString('base64'));
const core = new WebAssembly.Module(readFileSync(new URL('../../build/lab/motus.wasm', import.meta.url))), make = () => new page.Answers(new page.Core(core)), answers = make();
/** Whose reference takes long: each has a worker's answers of its own, which keep it. */
const dear = new Map(['outer-solar-system', 'three-body-figure-eight'].map((name) => [name, make()]));
const catalogue = answers.answer('catalogue', {}), model = (name) => readFileSync(new URL(`../../models/${name}.motus`, import.meta.url), 'utf8');

/** A scene of an example, or of a text. */
function sceneOf(name, methods, { text = model(name), set = {}, step = null, until = null } = {}) {
  const solution = (dear.get(name) ?? answers).answer('solve', { model: { text, set: Object.entries(set).map((pair) => pair.join(' = ')) }, methods, step, until, columns: [], rows: 6000, truth: true });
  return { state: { preset: name, text, set, methods, step: '', until: '', view: page.defaultView, place: '' }, description: solution.description, solution, looks: page.looksOf(methods, catalogue, page.named), catalogue };
}
const DESK = { width: 1280, height: 528, column: 290, page: { width: 1280, height: 800 } };
/** The picture of a scene, and all that is drawn of it at a time: texts with their edges, the other marks by name. */
function drawn(scene, time, { width, height, column, page: window } = DESK, { all = false, view = '' } = {}) {
  const views = page.subjects(scene.description, scene.solution), subject = views.find((v) => v.id === view) ?? views[0], staging = page.stagings[scene.state.preset] ?? {}, place = page.placeOf(width, height, column, window);
  const bounds = page.boundsFor(scene, subject, staging, all, null), picture = page.pictureOf({ scene, subject, staging, place, bounds, camera: page.HOME, before: null, pinned: null });
  const texts = [], lines = [], marks = [];
  const pen = {
    width, height, clip: (_x, _y, _w, _h, inside) => inside(), area() {}, box() {}, arrow() {}, line: (xy, stroke, count = xy.length) => lines.push({ xy: Array.from(xy).slice(0, count), ...stroke }),
    mark: (shape, x, y, r, colour) => marks.push({ shape, x, y, r, colour }),
    text(x, y, what, { anchor = 'start', size = 12 } = {}) {
      const words = typeof what === 'string' ? what : what.map((span) => span.text).join(''), wide = page.textWidth(what, size), left = anchor === 'end' ? x - wide : anchor === 'middle' ? x - wide / 2 : x;
      texts.push({ text: words.replaceAll('\u2009', ' '), x, y, left, right: left + wide, size });
    },
  };
  picture.still(pen, page.named.ink, true);
  picture.moving(pen, page.named.ink, time ?? scene.solution.tracks[0].times.at(-1));
  return { picture, place, bounds, texts, lines, marks, words: texts.map((t) => t.text), subject, staging };
}

// --- every size ------------------------------------------------------------------------------------------------------------------------------
const LOW = [[844, 390], [667, 375], [740, 360], [812, 375], [896, 414], [932, 430], [1000, 450], [640, 400]];
const scenes = [['spring', ['explicit-euler', 'verlet']], ['kepler', ['symplectic-euler', 'velocity-verlet']], ['pendulum', ['explicit-euler']], ['comet', ['explicit-euler', 'velocity-verlet']],
  ['charged-particle', ['explicit-euler', 'boris']], ['thrown-ball', ['explicit-euler', 'midpoint']], ['chain', ['velocity-verlet']]].map(([name, methods]) => sceneOf(name, methods));
test('on a low window every motion has room, from left to right', () => {
  for (const scene of scenes) for (const [width, height] of LOW) {
    const room = width - 284, name = `${scene.state.preset}, ${width} × ${height}`, motion = page.motionOf(scene, page.subjects(scene.description, scene.solution)[0]);
    // The line of title and equation crosses the stage.
    const { place, lines, texts } = drawn(scene, undefined, { width: room, height, column: room - 12, page: { width, height } });
    assert.ok(place.frame.right - place.frame.left >= 150 && place.frame.left >= 0 && place.frame.right <= room, `${name}: the frame`);
    const curve = lines.filter((l) => l.colour === page.named.ink.exact && l.width === 4).at(-1).xy.filter((_, k) => k % 2 === 0), wide = Math.max(...curve) - Math.min(...curve);
    assert.ok(wide > 100 && Math.min(...curve) >= 0 && Math.max(...curve) <= room, `${name}: the exact motion is ${wide} px wide, from ${Math.min(...curve)}`);
    if (motion.subject.kind === 'time') assert.ok(curve[0] < curve.at(-1), `${name}: time goes to the right`);
    for (const t of texts) assert.ok(t.left >= -1 && t.right <= room + 4, `${name}: “${t.text}” from ${t.left} to ${t.right}`);
  }
});

// --- numbers are what is drawn -----------------------------------------------------------------------------------------------------------------
test('a bracket is as long as the number beside it, at every time', () => {
  for (const [name, methods, options] of [['thrown-ball', ['explicit-euler', 'symplectic-euler'], { step: 0.4 }], ['thrown-ball', ['explicit-euler', 'symplectic-euler'], { step: 0.05 }], ['thrown-ball-air', ['explicit-euler', 'midpoint'], { step: 0.2 }]]) {
    const scene = sceneOf(name, methods, options);
    let judged = 0;
    for (let t = 0.05; t < 2; t += 0.049) {
      const { lines, texts, picture, bounds, place } = drawn(scene, t), unit = (place.frame.bottom - picture.handle.fromY) / 1.7;
      assert.ok(bounds[1][0] === 0 && unit > 20);
      for (const [colour, word] of [[scene.looks[0].colour, 'too high'], [scene.looks[1].colour, name === 'thrown-ball' ? 'too low' : 'too high']]) {
        const shaft = lines.find((l) => l.colour === colour && l.width === 1.75 && l.xy.length === 4), number = texts.map((x) => /(?:^|  )([\d.]+) m (too high|too low)$/.exec(x.text)).find((m) => m?.[2] === word);
        if (!shaft || !number) continue;
        judged++;
        // From 5 px off the ball's middle to 2 px before the method's.
        const drawnLength = (Math.abs(shaft.xy[3] - shaft.xy[1]) + 7) / unit;
        assert.ok(Math.abs(drawnLength - Number(number[1])) * unit < 3, `${name}, t = ${t}: drawn ${drawnLength} m, told ${number[0]}`);
      }
    }
    assert.ok(judged > 10, `${name}: ${judged} brackets`);
  }
  // Before the first step has landed, who is seen beside it is not "on it".
  assert.ok(!drawn(sceneOf('thrown-ball', ['symplectic-euler'], { step: 0.4 }), 0.2).words.some((w) => w.endsWith('on it')));
});

const own = (text, methods, options) => sceneOf('', methods, { ...options, text });
test('who swings too wide, and who only leaves', () => {
  const last = (scene) => drawn(scene).words.filter((w) => / times too wide at |^at /.test(w));
  assert.deepEqual(last(own("x'' = -9.81\nx(0) = 1000\nstep 0.1\nuntil 1", ['explicit-euler'])), []);
  assert.ok(!drawn(own("x'' = -9.81\nx(0) = 1000\nstep 0.1\nuntil 1", ['symplectic-euler'])).words.some((w) => w.includes('too wide')), 'a fall is no swing');
  assert.match(last(sceneOf('spring', ['explicit-euler'], { step: 0.16, until: 20 })).join(), /^4\.[89] times too wide at 20 s$/);
  assert.match(last(sceneOf('spring', ['explicit-euler'])).join(), /^4\.5 times too wide at 60 s$/);
  // Swings that grow: the largest of the last one, of the method and of the exact motion.
  assert.match(last(sceneOf('resonance', ['explicit-euler'])).join(), /^2\.3 times too wide at 60 s$/);
});
test('a method leaves when its line crosses the edge', () => {
  const { picture, words } = drawn(sceneOf('thrown-ball', ['symplectic-euler'], { step: 0.4 })), [left] = picture.leaving;
  // Below the ground, in its last step.
  assert.ok(left && left.time > 1.6 && left.time < 1.99, `at ${left?.time}`);
  assert.ok(words.includes(`at ${Number(left.time.toPrecision(3))} s`) && picture.remarks()[0].includes(String(Number(left.time.toPrecision(4)))), words.join());
});
test('an axis of numbers that nearly agree says from which one they differ', () => {
  assert.ok(drawn(own("x'' = -9.81\nx(0) = 6371000\nstep 0.1\nuntil 1", ['midpoint'])).words.some((w) => w.replaceAll('\u2009', ' ').includes('6 371 000 +')));
  assert.ok(drawn(own("T' = -1e-6 (T - 20)\nT(0) = 90\nstep 1\nuntil 10", ['rk4'])).words.some((w) => w.includes('90 +')));
  assert.ok(!drawn(sceneOf('spring', ['verlet'])).words.some((w) => w.endsWith(' +')));
});
test('a throw ends on the ground, and the picture says so', () => {
  for (const options of [{ set: { "r'(0)": '(6, 3)' } }, { until: 4 }]) {
    const { bounds, words, texts, picture, place } = drawn(sceneOf('thrown-ball', ['explicit-euler', 'symplectic-euler'], options));
    assert.ok(bounds[1][0] === 0 && bounds[0][1] < 15, JSON.stringify(bounds));
    assert.ok(words.some((w) => /^exact lands at [\d.]+ s$/.test(w)) && words.includes('symplectic Euler lands'), words.join(' | '));
    assert.match(picture.remarks()[0], /below the ground/);
    for (const t of texts) assert.ok(t.left >= 0 && t.right <= place.width + 4 && t.y < place.height, t.text);
  }
});
test('“exact” alone is what a formula gives', () => {
  const small = { width: 390, height: 330, column: 0, page: { width: 390, height: 844 } };
  const said = (scene, size) => drawn(scene, undefined, size).words.filter((w) => /exact|computed/.test(w));
  const computed = own("x'' = -sin(x)\nx(0) = 1\nstep 0.2\nuntil 10", ['explicit-euler']);
  for (const size of [small, undefined]) assert.ok(said(computed, size).length > 0 && said(computed, size).every((w) => /^computed( = |$)/.test(w)), said(computed, size).join());
  assert.deepEqual(said(sceneOf('thrown-ball', ['explicit-euler']), small), ['exact']);
});
test('bodies at rest are named, and numbers of axes in space stand apart', () => {
  assert.deepEqual(drawn(sceneOf('arenstorf', ['gauss8'])).words.filter((w) => /Earth|Moon|Sun/.test(w)), ['Earth', 'Moon']);
  for (const size of [DESK, { width: 356, height: 400, column: 0, page: { width: 640, height: 400 } }]) {
    const numbers = drawn(sceneOf('charged-particle', ['boris']), 0, size).texts.filter((t) => /^−?[\d.]+$/.test(t.text));
    assert.ok(numbers.length >= 4);
    numbers.forEach((a, i) => numbers.slice(0, i).forEach((b) => assert.ok(a.right + 4 <= b.left || b.right + 4 <= a.left || Math.abs(a.y - b.y) >= 13, `${a.text} and ${b.text}`)));
  }
});
test('notes of what lands or leaves cover no curve, no other note and no name', () => {
  const sizes = [{ width: 390, height: 330, column: 0, page: { width: 390, height: 844 } }, { width: 320, height: 262, column: 0, page: { width: 320, height: 640 } }, DESK];
  const given = [['thrown-ball', ['explicit-euler', 'symplectic-euler', 'midpoint'], { until: 4 }], ['thrown-ball-air', ['explicit-euler', 'midpoint'], { until: 4 }], ['spring', ['explicit-euler', 'verlet'], {}]];
  for (const size of sizes) for (const [name, methods, options] of given) {
    const { texts, lines, words } = drawn(sceneOf(name, methods, options), undefined, size), what = `${name}, ${size.width}`;
    const notes = texts.filter((t) => /(lands|leaves|times too wide|lands at)/.test(t.text)), names = texts.filter((t) => /^(exact|computed)$/.test(t.text));
    assert.ok(notes.length >= 2, `${what}: ${words.join(' | ')}`);
    const box = (t) => ({ left: t.left, right: t.right, top: t.y - 0.7 * t.size, bottom: t.y }), apart = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
    [...notes, ...names.map((n) => ({ ...n, y: n.y + 0.35 * n.size }))].forEach((a, i, all) => all.slice(0, i).forEach((b) => assert.ok(apart(box(a), box(b)), `${what}: “${a.text}” on “${b.text}”`)));
    // Curves of the motion, walked along.
    for (const { xy } of lines.filter((l) => (l.width === 4 || l.width === 2) && l.xy.length > 8)) for (let k = 0; k + 3 < xy.length; k += 2) for (let s = 0; s <= 1; s += 0.05) {
      const x = xy[k] + s * (xy[k + 2] - xy[k]), y = xy[k + 1] + s * (xy[k + 3] - xy[k + 1]);
      for (const note of notes) { const b = box(note); assert.ok(x < b.left || x > b.right || y < b.top || y > b.bottom, `${what}: “${note.text}” on a curve at ${x.toFixed()}, ${y.toFixed()}`); }
    }
  }
});
test('a throw that is computed is shown down to the ground, also before its green curve has come', () => {
  const scene = sceneOf('thrown-ball-air', ['explicit-euler', 'midpoint'], { until: 4 });
  assert.equal(drawn({ ...scene, solution: { ...scene.solution, truth: null, errors: [] } }).bounds[1][0], 0);
});
const lorenz = "sigma = 10\nrho = 28\nx' = sigma (y - x)\ny' = x (rho - z) - y\nz' = x y - 8/3 z\nx(0) = 1\ny(0) = 1\nz(0) = 1\nstep 0.01\nuntil 5";
const eaten = "prey' = prey - prey eater\neater' = prey eater - eater\nprey(0) = 1.5\neater(0) = 1\nstep 0.1\nuntil 20";
test('of first order: variables against one another, and how far off each method ends', () => {
  const ids = (scene) => page.subjects(scene.description, scene.solution).map((s) => `${s.id}: ${s.label}`), three = own(lorenz, ['rk4', 'explicit-euler']), two = own(eaten, ['midpoint']);
  assert.deepEqual(ids(three), ['space-x-y-z: in space', 'plane-x-y: path in x, y', 'plane-x-z: path in x, z', 'plane-y-z: path in y, z', 'time-x: x against time', 'time-y: y against time', 'time-z: z against time']);
  assert.deepEqual(ids(two), ['time-prey: prey against time', 'time-eater: eater against time', 'plane-prey-eater: path in prey, eater']);
  assert.deepEqual(ids(own("x' = -x\nx(0) = 1\nexact x = exp(-t)\nstep 0.1\nuntil 2", ['rk4'])), ['time-x: x against time']);
  const off = (scene, view) => drawn(scene, undefined, DESK, { view }).words.map((w) => /^(?:explicit Euler|midpoint)  ([\d.]+) off$/.exec(w)).find(Boolean)?.[1];
  for (const [scene, view] of [[three, 'plane-x-z'], [three, 'space-x-y-z'], [two, 'plane-prey-eater']]) {
    const told = off(scene, view), is = scene.solution.errors.at(-1).s.at(-1);
    assert.ok(Math.abs(Number(told) - is) <= 0.06 * is, `${view}: ${told} is not ${is}`);
  }
  // Rabbits are no lengths of foxes: the curve fills the frame both ways.
  const { place, lines } = drawn(two, undefined, DESK, { view: 'plane-prey-eater' }), curve = lines.filter((l) => l.colour === page.named.ink.exact && l.width === 4).at(-1).xy;
  for (const [k, low, high] of [[0, place.frame.left, place.frame.right], [1, place.frame.top, place.frame.bottom]]) {
    const of = curve.filter((_, i) => i % 2 === k);
    assert.ok(Math.max(...of) - Math.min(...of) > 0.7 * (high - low), `along axis ${k}`);
  }
});
const boxOf = (t) => ({ left: t.left, right: t.right, top: t.y - 0.7 * t.size, bottom: t.y }), apartOf = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
/** Whether a curve of the motion runs through this box. */
const crossed = (lines, b) => lines.some(({ xy, width }) => (width === 4 || width === 2) && xy.length > 8 && xy.some((x, k) => {
  if (k % 2 || k + 3 >= xy.length) return false;
  return Array.from({ length: 21 }, (_, s) => [x + s / 20 * (xy[k + 2] - x), xy[k + 1] + s / 20 * (xy[k + 3] - xy[k + 1])]).some(([px, py]) => px > b.left && px < b.right && py > b.top && py < b.bottom);
}));
test('names beside a path lie on no number of its axes, and the velocity is told where no curve runs', () => {
  const tablet = { width: 1024, height: 366, column: 0, page: { width: 1024, height: 768 } };
  for (const [name, methods] of [['kepler', ['symplectic-euler', 'velocity-verlet', 'kahan-li8']], ['comet', ['velocity-verlet', 'kahan-li8']]]) for (const size of [tablet, DESK]) {
    const { texts, lines } = drawn(sceneOf(name, methods), undefined, size), what = `${name}, ${size.width}`;
    const numbers = texts.filter((t) => /^−?[\d.]+$/.test(t.text) && t.size === 12), names = texts.filter((t) => /^(computed|symplectic|velocity)/.test(t.text)), speed = texts.findIndex((t) => t.text === 'v0');
    assert.ok(numbers.length > 4 && names.length >= 2 && speed >= 0, what);
    const told = texts.slice(speed, speed + 2);
    for (const t of [...names.map((n) => ({ ...n, y: n.y + 0.35 * n.size })), ...told]) for (const n of numbers) assert.ok(told.includes(n) || apartOf(boxOf(t), boxOf({ ...n, y: n.y + 0.35 * n.size })), `${what}: “${t.text}” on ${n.text}`);
    for (const t of told) assert.ok(!crossed(lines, boxOf(t)), `${what}: a curve runs through “${t.text}”`);
  }
});
test('on a phone the end of a curve in time is named at its right', () => {
  for (const [size, scene] of [[390, sceneOf('spring', ['verlet'])], [320, sceneOf('spring', ['verlet'])], [390, sceneOf('pendulum', ['explicit-euler'])], [320, sceneOf('pendulum', ['explicit-euler'])]]) {
    const { texts, place, marks } = drawn(scene, undefined, { width: size, height: 330, column: 0, page: { width: size, height: 844 } }), name = texts.find((t) => /^(exact|computed)$/.test(t.text));
    const ball = marks.filter((m) => m.colour === page.named.ink.exact).at(-1);
    assert.ok(name && name.left > ball.x && name.right <= place.width, `${size}: from ${name?.left} to ${name?.right}, the ball at ${ball.x}`);
    assert.ok(Math.abs(name.y - ball.y) < 24, `${name.y - ball.y} beside it`);
  }
  const { texts, marks } = drawn(sceneOf('spring', ['verlet']), undefined, { width: 560, height: 390, column: 548, page: { width: 844, height: 390 } });
  assert.ok(texts.find((t) => t.text === 'exact').left > marks.filter((m) => m.colour === page.named.ink.exact).at(-1).x, 'also on one that lies on its side');
});
test('each of several bodies is named once, beside itself and on nothing that is written', () => {
  const PHONE = { width: 390, height: 397, column: 0, page: { width: 390, height: 844 } }, planets = ['Sun', 'Jupiter', 'Saturn', 'Uranus', 'Neptune', 'Pluto'];
  const own_ = own("sun'' = (0, 0)\nrock'' = -rock/|rock|^3\nsun(0) = (0, 0)\nsun'(0) = (0, 0)\nrock(0) = (1, 0)\nrock'(0) = (0, 1)\nstep 0.1\nuntil 6", ['rk4', 'verlet']);
  for (const [what, scene, names] of [['planets', sceneOf('outer-solar-system', ['kahan-li8', 'velocity-verlet']), planets], ['eight', sceneOf('three-body-figure-eight', ['kahan-li6', 'velocity-verlet']), ['1', '2', '3']], ['own', own_, ['sun', 'rock']]]) {
    const { times } = scene.solution.tracks[0];
    for (const size of [DESK, PHONE]) for (const part of [1, 0, 0.13, 0.31, 0.5, 0.77]) {
      const { texts, marks, place } = drawn(scene, times[0] + part * (times.at(-1) - times[0]), size), at = `${what}, ${size.width}, ${part}`;
      // Names stand in the middle of their height.
      const of = (t) => { const b = boxOf(t); return names.includes(t.text) ? { ...b, top: t.y - t.size / 2, bottom: t.y + t.size / 2 } : b; }, found = texts.filter((t) => names.includes(t.text));
      assert.deepEqual(found.map((t) => t.text).sort(), [...names].sort(), at);
      const balls = marks.filter((m) => m.colour === page.named.ink.exact), written = texts.filter((t) => / off$|^computed|^exact|lands|leaves/.test(t.text));
      assert.equal(balls.length, names.length, at);
      for (const t of found) {
        assert.ok(t.left >= 0 && t.right <= place.width && t.y < place.height, `${at}: ${t.text}`);
        for (const other of [...found, ...written]) if (other !== t) assert.ok(apartOf(of(t), of(other)), `${at}: “${t.text}” on “${other.text}”`);
        for (const { x, y } of balls) assert.ok(x <= t.left || x >= t.right || Math.abs(y - t.y) > t.size / 2, `${at}: “${t.text}” on a body`);
        // It is nearer to its own body than the names of others could be: no further than its line reaches.
        const b = balls[names.indexOf(t.text)], far = Math.hypot(Math.max(0, t.left - b.x, b.x - t.right), Math.max(0, Math.abs(t.y - b.y) - t.size / 2));
        assert.ok(far < 100, `${at}: “${t.text}” ${far} from its body`);
      }
    }
  }
  assert.ok(!drawn(sceneOf('kepler', ['velocity-verlet'])).words.includes('r'), 'one body alone needs no name');
  // Numbers and names of axes in space stay on a narrow stage.
  for (const name of ['outer-solar-system', 'charged-particle']) for (const t of drawn(sceneOf(name, ['velocity-verlet', 'boris'].slice(name === 'charged-particle' ? 1 : 0, name === 'charged-particle' ? 2 : 1)), undefined, PHONE).texts) assert.ok(t.left >= 0 && t.right <= 391, `${name}: ${t.text} from ${t.left} to ${t.right}`);
});
/** At the last row of a run: the distance of each body, by columns of the truth at the same time. */
function apartAt(scene, k, bodies) {
  const { solution: { tracks, truth, columns } } = scene, i = tracks[k].times.length - 1, j = truth.times.length - 1;
  return bodies.map((parts) => Math.hypot(...parts.map((name) => tracks[k].columns[columns.indexOf(name)][i] - truth.columns[columns.indexOf(name)][j])));
}
test('how far off: one distance everywhere, that between the two places; of several bodies the furthest, by its name', () => {
  const close = (a, b, what) => assert.ok(Math.abs(a - b) <= 1e-6 * b, `${what}: ${a}, not ${b}`);
  for (const [name, methods, vector] of [['kepler', ['symplectic-euler', 'velocity-verlet'], ['x', 'y']], ['charged-particle', ['verlet', 'boris'], ['x', 'y', 'z']], ['thrown-ball', ['explicit-euler'], ['x', 'y']]]) {
    const scene = sceneOf(name, methods), names = vector.map((part) => (scene.solution.columns.includes(`r.${part}`) ? `r.${part}` : part));
    scene.solution.errors.forEach((e, k) => { close(e.x.at(-1), apartAt(scene, k, [names])[0], `${name}, ${methods[k]}`); assert.equal(page.furthestOf(e, e.x.length - 1), ''); });
  }
  const scene = sceneOf('outer-solar-system', ['velocity-verlet']), [e] = scene.solution.errors, called = page.stagings['outer-solar-system'].bodies;
  const each = apartAt(scene, 0, [1, 2, 3, 4, 5, 6].map((n) => ['x', 'y', 'z'].map((part) => `r[${n}].${part}`))), most = Math.max(...each);
  close(e.x.at(-1), most, 'planets');
  assert.equal(page.furthestOf(e, e.x.length - 1, called), 'Saturn');
  assert.equal(each.indexOf(most), called.indexOf('saturn'));
  // A mass on a spring has one number.
  const spring = sceneOf('spring', ['explicit-euler']);
  close(spring.solution.errors[0].x.at(-1), apartAt(spring, 0, [['x']])[0], 'spring');
});
test('the body that panels and One step show first: not one that nearly rests, and by its name', () => {
  const first = (scene) => page.firstMoving(page.subjects(scene.description, scene.solution)[0].bodies.map((b) => b.columns.map((k) => scene.solution.tracks[0].columns[k])));
  assert.equal(first(sceneOf('outer-solar-system', ['kahan-li8'])), 1, 'Jupiter, not the Sun');
  assert.equal(first(sceneOf('three-body-figure-eight', ['kahan-li8'])), 0);
  assert.equal(first(sceneOf('kepler', ['velocity-verlet'])), 0);
  assert.equal(page.firstMoving([[[1, 1]], [[2, 2]]]), 0, 'all at rest');
  const names = { x: ['r[1].x', 'r[1].y', 'r[2].x', 'r[2].y'], v: ["r[1]'.x", "r[1]'.y", "r[2]'.x", "r[2]'.y"] };
  const labels = page.seenIn(names, (body) => ({ 'r[1]': 'Sun', 'r[2]': 'Jupiter' })[body]).map((s) => s.label);
  assert.ok(labels.some((l) => l.startsWith('Jupiter')) && !labels.some((l) => /r/.test(l.replace('Jupiter', ''))), labels.join(' | '));
});
test('rings stand on the bodies that an event changed, and leave the curve to be seen', () => {
  const rings = (scene) => drawn(scene).marks.filter(({ shape }) => shape === 'ring');
  const apart = rings(sceneOf('newtons-cradle', ['verlet'], { set: { d: 0.9 } }));
  assert.equal(apart.length, 6, 'three contacts of two balls each');
  // Against time, left of the plane of velocities.
  const kicks = rings(sceneOf('kicked-rotor', ['verlet'], { set: { K: 5 } })).filter(({ x }) => x < 780), near = kicks.slice(1).filter(({ x, y }, k) => Math.hypot(x - kicks[k].x, y - kicks[k].y) < 20);
  assert.ok(kicks.length > 20 && near.length === 0, `${near.length} of ${kicks.length} kicks cover one another`);
});
test('the time goes as far as the clock, also where events end the exact motion before', () => {
  const scene = sceneOf('bouncing-ball', ['explicit-euler']), { truth } = scene.solution;
  assert.ok(truth.times.at(-1) < 4.1, 'the ball comes to rest');
  assert.deepEqual(drawn(scene).bounds[0], [0, 5]);
});
