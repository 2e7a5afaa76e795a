/* Every number that the stage and the panels show of a scene, read as it stands there and compared with the core's own: all scenes, the methods of the dock, five steps, three
 * widths, at the end of the run and between two steps. Run by `node --test`, by the module of build/lab and without a browser (dom.mjs).
 *
 * Laws: each number is the core's, rounded to the digits that are shown; where two numbers stand beside their difference, it is that of what is shown; no number is left unread.
 * Scenes are shortened to STEPS of the model's steps, and the numbers of a scene are computed once a step for all widths.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';
import { frame, size } from './dom.mjs';

const STEPS = 100, ROWS = 400, WIDTHS = [[1280, 800], [1024, 768], [390, 844]], DEAR = new Set(['outer-solar-system', 'double-pendulum', 'chain']), DOCK = ['explicit-euler', 'symplectic-euler', 'midpoint', 'verlet', 'rk4'];
const lab = new URL('../../lab/', import.meta.url), root = new URL('../../', import.meta.url), { build } = createRequire(new URL('package.json', lab))('esbuild');
const contents = `export { Answers } from './answers'; export { Core } from './core'; export { scenes } from './scenes'; export { stagings } from './stage/stagings'; export { data } from './data';
  export { looksOf, named } from './figure/ink'; export { defaultView } from './share'; export { shortLabel } from './figure/ends'; export { bodiesOf } from './distance';
  export { errorPanel } from './panel/error'; export { timePanel } from './panel/time'; export { phasePanel } from './panel/phase'; export { driftPanel } from './panel/drift';
  export * from './stage/picture'; export { placeOf } from './stage/place'; export { HOME } from './stage/plot'; export { subjects } from './stage/subject'; export { textWidth } from './figure/shapes';`;
const nothing = { name: 'virtual', setup(of) { of.onResolve({ filter: /^virtual:/ }, () => ({ path: 'nothing', namespace: 'virtual' })); of.onLoad({ filter: /.*/, namespace: 'virtual' }, () => ({ contents: 'export default async () => ({})' })); } };
const made = await build({ stdin: { contents, resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022', plugins: [nothing] });
const page = await import('data:text/javascript;base64,' + Buffer.from(made.outputFiles[0].contents).toString('base64'));
const module = new WebAssembly.Module(readFileSync(new URL('build/lab/motus.wasm', root))), answers = new page.Answers(new page.Core(module)), catalogue = answers.answer('catalogue', {});
page.data.presets = page.scenes.map(({ model }) => ({ name: model, text: readFileSync(new URL(`models/${model}.motus`, root), 'utf8') }));
page.data.stagings = page.stagings;

// --- reading ----------------------------------------------------------------------------------------------------------------------------------
const NUMBER = '−?\\d[\\d\\u2009]*(?:\\.\\d+)?(?:×10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?|≈ 0|∞';
/** A number as it is written, and half a unit of its last digit; a whole number may be rounded to three digits. */
function read(text) {
  if (text === '≈ 0') return { value: 0, off: Infinity };
  if (text === '∞') return { value: Infinity, off: 0 };
  const [, mantissa, power] = /^(−?[\d\u2009.]+)(?:×10(.*))?$/.exec(text), digits = mantissa.replaceAll('\u2009', '').replace('−', '-');
  const p = power ? Number([...power].map((c) => (c === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c))).join('')) : 0, decimals = digits.split('.')[1]?.length ?? 0;
  return { value: Number(digits) * 10 ** p, off: 0.5 * 10 ** (p - decimals) };
}
/** digits: zeros at the end are not written, so a number is to so many digits. */
function agrees(text, is, digits, slack = 0) {
  const { value, off } = read(text), wide = digits && Math.abs(value) > 0 ? Math.min(off, Math.max(0.5 * 10 ** (Math.floor(Math.log10(Math.abs(value))) + 1 - digits), 1e-300)) : off;
  return (Number.isNaN(is) && text === '–') || value === is || Math.abs(value - is) <= wide * (1 + 1e-6) + slack + 1e-12 * Math.abs(is);
}

// --- the core's own ---------------------------------------------------------------------------------------------------------------------------
const own = new page.Core(module), known = own.create();
/** The exact motion or the reference of a scene, at any time, of all numbers; and how far off it is. */
function truthOf(text, until) {
  own.open(known, { text, set: [] });
  const { error } = own.reference(known, null, until), nx = own.positions(known), nv = own.velocities(known), kept = new Map();
  return { error, nx, nv, at(t) { if (!kept.has(t)) { const { x, v } = own.referenceAt(known, Float64Array.of(t)); kept.set(t, [...x, ...v]); } return kept.get(t); } };
}
const valueAt = ({ times }, column, t) => {
  const way = times[times.length - 1] < times[0] ? -1 : 1;
  let i = 0;
  while (i + 2 < times.length && (times[i + 1] - t) * way <= 0) i++;
  const part = (t - times[i]) / (times[i + 1] - times[i] || 1);
  return part === 0 ? column[i] : part === 1 ? column[i + 1] : column[i] + part * (column[i + 1] - column[i]);
};
const sizeOf = (column) => column.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);


/** Letters of a text that are numbers, and what stands between; method names and names of bodies are no numbers. */
function parts(text, names) {
  let rest = text.replaceAll('\u00a0', ' ');
  for (const name of [...names].sort((a, b) => b.length - a.length)) if (/\d/.test(name)) rest = rest.replaceAll(name, (all) => all.replace(/\d/g, '•'));
  return rest.replaceAll('\u2009', ' ').replace(/(\d) (?=\d{3}(?!\d))/g, '$1\u2009');
}
const N = `(${NUMBER})`, UNIT = '(?: (?:m/s|mm/ns|au/year|au/day|m|s|au|years|days|mm|ns))?';

for (const entry of page.scenes) test(entry.model, () => {
  const { model } = entry, text = page.data.presets.find(({ name }) => name === model).text, description = answers.answer('describe', { model: { text, set: [] } }), { settings } = description;
  const methods = [...new Set([...entry.methods, ...DOCK])].filter((name) => description.methods.some((m) => m.name === name && m.admitted)), [largest] = page.stagings[model]?.stops ?? [4];
  const span = settings.until - settings.start, until = settings.step === null ? settings.until : settings.start + Math.sign(span) * Math.min(Math.abs(span), (DEAR.has(model) ? STEPS / 4 : STEPS) * settings.step);
  let truth = null, judged = 0;
  const store = { client: { ask: async () => new Promise(() => undefined) }, numbers: { until }, look() {}, state: {}, catalogue, subscribe() {} }, seen = { kind: 'plane', side: '' };
  const panels = [page.errorPanel(store), page.timePanel(store, () => seen), page.phasePanel(store, () => seen), page.driftPanel(store)];
  for (let k = 0; k < (settings.step === null ? 1 : 5); k++) {
    const step = settings.step === null ? null : largest * settings.step / 2 ** k;
    const solution = answers.answer('solve', { model: { text, set: [] }, methods, step, until, columns: [], rows: ROWS, truth: true, unexamined: true }), { tracks, columns, errors } = solution;
    const scene = { state: { preset: model, text, set: {}, methods, step: '', until: '', view: page.defaultView, place: '' }, description, solution, looks: page.looksOf(tracks.map((t) => t.method), catalogue, page.named), catalogue };
    if (solution.truth && errors.length) truth ??= truthOf(text, until);
    const labels = scene.looks.map((l) => l.label.replaceAll('\u00a0', ' ')), staging = page.stagings[model] ?? {}, units = staging.units;
    const at = (name) => description.columns.findIndex((c) => c.name === name) - 1, exact = (name, t) => (truth && at(name) >= 0 && at(name) < truth.nx + truth.nv ? truth.at(t)[at(name)] : NaN);
    const states = description.columns.filter((c) => c.kind === 'position'), firsts = description.columns.filter((c) => c.kind === 'first-order'), names = (states.length ? states : firsts).map((c) => c.name);
    const bodies = states.length ? page.bodiesOf(names).map((b) => b.parts.map((i) => names[i])) : names.map((name) => [name]), column = (track, name) => track.columns[columns.indexOf(name)];
    /** Of the drawn line. */
    const lineAt = (track, name, t) => { const i = columns.indexOf(name), curve = track.curve?.columns[i]?.length ? track.curve : track; return valueAt(curve, curve.columns[i], t); };
    const furthest = (track, t, of) => Math.max(...of.map((body) => Math.hypot(...body.map((name) => lineAt(track, name, t) - exact(name, t)))));
    const range = (name) => { const of = solution.truth?.columns[columns.indexOf(name)]; if (!of?.length) return 0; const [low, high] = sizeOf(of); return high - low; };
    const judge = (good, what, text) => { judged++; assert.ok(good, `${model}, step ${step}: ${what}: “${text}”`); };

    // --- the stage
    const views = page.subjects(description, solution);
    if (truth) for (const subject of views.slice(0, 2)) for (const [width, height] of WIDTHS) {
      const wide = width > 600, place = page.placeOf(width, wide ? height - 270 : 330, wide ? 290 : 0, { width, height }), bounds = page.boundsFor(scene, subject, staging, false, null);
      const picture = page.pictureOf({ scene, subject, staging, place, bounds, camera: page.HOME, before: null, pinned: null }), shown = subject.bodies.map((b) => b.columns.map((c) => columns[c])), side = page.sideOf(scene, subject, staging, place);
      const end = tracks[0].times.at(-1), rows = tracks[0].times, i = Math.floor(0.6 * (rows.length - 1)), upright = shown.length === 1 && subject.kind !== 'space' && (staging.upright === true || (subject.kind === 'time' && side === ''));
      for (const time of [end, rows[i] + 0.4 * (rows[i + 1] - rows[i])]) {
        const said = [], pen = {
          width, height, clip: (_x, _y, _w, _h, inside) => inside(), area() {}, box() {}, arrow() {}, line() {}, mark() {},
          text(x, y, what, { colour }) { said.push({ x, y, colour, text: parts(typeof what === 'string' ? what : what.map((s) => s.text).join(''), [...labels, ...labels.map(page.shortLabel)]) }); },
        };
        picture.moving(pen, page.named.ink, time);
        for (const { text, colour } of said) {
          const found = new RegExp(`${N}${UNIT} (too high|too low|off)(?:, (.+))?$`).exec(text), named = labels.findIndex((l) => [l, page.shortLabel(l)].some((n) => text.startsWith(`${parts(n, [n])}  `))), look = named >= 0 ? named : scene.looks.findIndex((l) => l.tone === colour), what = `${subject.id}, ${width} px, t = ${time}`;
          if (found) {
            // Two methods may have one colour.
            const able = named >= 0 ? [tracks[named]] : tracks.filter((_, i) => scene.looks[i].tone === colour), of = subject.unlike || shown.length > 1 || subject.kind === 'space' ? bodies : [upright || subject.kind === 'time' ? shown[0].slice(-1) : shown[0]];
            const last = of[0].at(-1), slack = time === end ? truth.error : 2 / 12000 * Math.max(...of.flat().map(range)), all = able.map((track) => furthest(track, time, of)), track = able.find((_, i) => agrees(found[1], all[i], 0, slack));
            judge(track, `${what}, ${labels[look]} is ${all} off`, text);
            if (upright) judge((lineAt(track, last, time) - exact(last, time) > -slack) === (found[2] === 'too high') || furthest(track, time, of) <= 2 * slack, what, text);
            continue;
          }
          const wider = new RegExp(`^${N} times too wide at ${N}${UNIT}$`).exec(text);
          if (wider && model === 'spring') {
            const energy = column(tracks[look], 'energy');
            judge(Math.abs(read(wider[1]).value / Math.sqrt(energy.at(-1) / energy[0]) - 1) < 0.06, what, text);
          }
          if (wider) { judge(agrees(wider[2], end, 3), what, text); continue; }
          const when = new RegExp(`^(?:.* )?at ${N}${UNIT}(?:,.*)?$`).exec(text);
          if (when) { const { value } = read(when[1]); judge(value >= Math.min(settings.start, until) - 1e-3 && value <= Math.max(settings.start, until) * 1.001, what, text); continue; }
          const speed = new RegExp(`^${N} (?:m/s|mm/ns|au/year|au/day)$`).exec(text);
          if (speed) { judge(agrees(speed[1], Math.hypot(...shown[0].map((name) => column(tracks[0], name.replace(/^(\w+)/, "$1'"))?.[0] ?? NaN)), 3), what, text); continue; }
          // On a small stage a miss stands in two lines.
          const alone = new RegExp(`^${N}${UNIT}$`).exec(text);
          if (alone && look >= 0) {
            const of = upright ? shown[0].slice(-1) : shown[0], all = tracks.filter((_, i) => scene.looks[i].tone === colour).map((track) => furthest(track, time, [of]));
            judge(all.some((is) => agrees(alone[1], is, 0, time === end ? truth.error : 2 / 12000 * Math.max(...of.map(range)))), `${what}, ${labels[look]} is ${all} off`, text);
            continue;
          }
          judge(!/\d/.test(text) || /^−?[\d.]+$/.test(text) || text === 'v0' || /^mass \d$/.test(text) || /= \d methods$/.test(text), `${what}: a number is read by nobody`, text);
        }
      }
    }

    // --- the panels
    size.width = WIDTHS[k % 3][0];
    for (const panel of panels) {
      if (!panel.there(scene)) continue;
      panel.show(scene);
      frame();
      let told = parts(`${panel.element.querySelector('.figure-answer').textContent} ${panel.element.querySelector('.figure-summary').textContent}`, labels);
      for (const message of tracks.flatMap((t) => [t.problem?.message, t.singular?.message])) if (message) told = told.replaceAll(message, '').replaceAll(message.replace(/^\S+ /, ''), '');
      const what = panel.id, end = tracks.reduce((t, track) => (Math.abs(track.times.at(-1) - settings.start) > Math.abs(t - settings.start) ? track.times.at(-1) : t), solution.truth?.times.at(-1) ?? settings.start);
      const cut = (pattern, act) => { told = told.replace(new RegExp(pattern, 'giu'), (...all) => { act(...all); return '·'; }); };
      const byName = (name) => labels.findIndex((l) => parts(l, [l]).toLowerCase() === name.toLowerCase());
      const name_ = '([^,;:.]+?)', some = labels.map((l) => parts(l, [l]).replace(/[()]/g, '\\$&')).join('|'), BY = `(${some})`;
      cut(`(?:accumulate|accumulates) at t = ${N}\\((\\d+)\\)`, (said, n) => judge(tracks.some((t) => t.ended?.accumulated && agrees(n, t.ended.accumulated.time, 0, 10 * (t.ended.accumulated.error ?? 0))), what, said));
      if (what !== 'phase') cut('at (?:t = )?' + N + UNIT + '(?=[:,])', (all, t) => judge(agrees(t, end, 4) || agrees(t, solution.truth?.times.at(-1), 4), what, all));
      if (what === 'error') {
        const all = (track) => { const e = errors.find((row) => row.method === track.method); return e.x.length ? e.x : e.s; };
        cut(`${BY} off by less than ${N}`, (said, name, n) => judge(all(tracks[byName(name)]).at(-1) <= read(n).value * 1.06, what, said));
        cut(`${BY} off by ${N}`, (said, name, n) => {
          const track = tracks[byName(name)], is = all(track).at(-1);
          judge(agrees(n, is, 3), what, said);
          // … and by the other instance of the core.
          if (truth && track.times.at(-1) === until) judge(Math.abs(furthest(track, until, bodies) - is) <= 1e-6 * is + 4 * truth.error + 1e-12, `${what}: ${is} is not ${furthest(track, until, bodies)}`, said);
        });
        cut(`${BY} leaves at (?:t = )?${N}`, (said, name, n) => judge(Number.isFinite(read(n).value), what, said));
        cut(`${N} by ${BY}( \\(round-off\\))?`, (said, n, name, small) => judge(agrees(n, Math.max(...all(tracks[byName(name)]).filter((e) => !Number.isNaN(e))), small ? 2 : 3), what, said));
        cut(`own error is about ${N}`, (said, n) => judge(agrees(n, solution.truth.error, 2), what, said));
        cut(`(?<=a reference, [^.]*?(?:step |tolerance ))${N}`, (said, n) => judge(solution.truth.name.split(/[ ;,]/).some((word) => agrees(n, Number(word), 4)), what, said));
        cut('a reference, [^,]*', () => undefined);
      }
      if (what === 'time') {
        const exactly = (name) => truth && at(name) < truth.nx + truth.nv && solution.truth?.columns[columns.indexOf(name)]?.length > 0, slack = (name) => (truth?.error ?? 0) + 1e-12 * range(name);
        const shown = names.length ? names : description.columns.slice(1).map((c) => c.name), plainly = (name) => name.replace(/[.\[\]]/g, '');
        cut(`t = ${N} to ${N}`, (said, from, to) => judge(agrees(from, settings.start, 4) && agrees(to, end, 4), what, said));
        const [, of, list] = /At the end, (.+?): (.*?)(?:\. |\.$)/.exec(told) ?? [], which = description.columns.find((c) => parts(c.name, []) === of)?.name ?? shown.find((name) => name === of);
        if (list && which) for (const part of list.split(/, | and (?=\S)/)) {
          const [, by, n] = new RegExp(`^(.+?) ${N}$`).exec(part) ?? [];
          if (!by) continue;
          const track = tracks[byName(by)], is = /^(exact|computed)$/.test(by) ? exact(which, end) : track ? valueAt(track, column(track, which), end) : NaN;
          if (Number.isFinite(is)) judge(agrees(n, is, 6, slack(which) + (track ? 0 : 1e-7 * range(which))), `${what}: ${is}`, part);
        }
        told = told.replace(/At the end, .*?(?:\. |\.$)/, '');
        shown.forEach((name) => { if (exactly(name)) cut(`(?<![\\p{L}])${plainly(name)} = ${N}`, (said, n) => judge(agrees(n, exact(name, end), 3, slack(name) + 1e-7 * range(name)), `${what}: ${exact(name, end)}`, said)); });
        cut(`[\\p{L}\\d′′]+ = ${N}`, () => undefined);
        cut('\\d+ of \\d+ chosen', () => undefined);
      }
      if (what === 'drift') {
        const name = description.columns.find((c) => c.kind === 'invariant').name, change = (track) => { const v = column(track, name), scale = Math.abs(v[0]) > 1e-12 ? Math.abs(v[0]) : 1; return v.map((x) => (x - v[0]) / scale); };
        const most = (track) => Math.max(...change(track).map(Math.abs).filter((x) => !Number.isNaN(x))), share = (n, percent) => ({ n, part: percent ? 100 : 1 });
        cut(`begins at ${N}`, (said, n) => judge(agrees(n, column(tracks[0], name)[0], 6), what, said));
        cut(`${N} by ${BY}( \\(round-off\\))?`, (said, n, by, small) => judge(agrees(n, most(tracks[byName(by)]), small ? 2 : 3), `${what}: ${most(tracks[byName(by)])}`, said));
        cut(`${BY} strays by at most ${N}( %)?`, (said, by, n, percent) => judge(agrees(n, most(tracks[byName(by)]) * share(n, percent).part, 3), what, said));
        cut(`${BY} ends ${N}( %)?(?: of its first value)? (higher|lower)`, (said, by, n, percent) => judge(agrees(n, Math.abs(change(tracks[byName(by)]).at(-1)) * (percent ? 100 : 1), 3), what, said));
        cut(`${BY} ends with ${N} times`, (said, by, n) => judge(agrees(n, column(tracks[byName(by)], name).at(-1) / column(tracks[byName(by)], name)[0], 3), what, said));
        cut(`${BY} (?:adds|loses) ${N}( %)?( of the first value)? at every step`, (said, by, n, percent, first) => {
          const v = column(tracks[byName(by)], name), rates = [...v].slice(1, -1).map((x, i) => Math.abs((x - v[i]) / (first ? v[0] : v[i])) * (percent ? 100 : 1)).sort((a, b) => a - b);
          judge(read(n).value >= rates[0] * 0.98 && read(n).value <= rates.at(-1) * 1.02, what, said);
        });
        cut(`${BY} keeps it to ${N}`, (said, by, n) => judge(agrees(n, most(tracks[byName(by)]), 2), what, said));
        // The others of a kind, by name and number alone: one of what is said of that kind.
        cut(`${BY} (?:by|to|with|at) (?:t = )?${N}( %)?`, (said, by, n, percent) => {
          const track = tracks[byName(by)], v = column(track, name), c = change(track), all = [most(track), Math.abs(c.at(-1)), v.at(-1) / v[0] / (percent ? 100 : 1), track.problem?.time ?? NaN, Math.abs((v[1] - v[0]) / v[0])];
          judge(all.some((is) => agrees(n, is * (percent ? 100 : 1), 3) || agrees(n, is, 2) || Math.abs(read(n).value / (is * (percent ? 100 : 1)) - 1) < 0.012), `${what}: ${all}`, said);
        });
        cut(`${BY} leaves at (?:t = )?${N}`, () => undefined);
      }
      if (what === 'phase') {
        const x = column(tracks[0], names[0]);
        const stands = (n, row, digits) => tracks[0].columns.some((c) => agrees(n, c.at(row), digits));
        for (const [before, row, digits] of [['from the ring', 0, 4], ['ends at', -1, 5]]) cut(`${before} \\(${N}, ${N}\\)`, (said, a, b) => judge(stands(a, row, digits) && stands(b, row, digits), what, said));
        if (truth && x) {
          const dense = Array.from({ length: 4001 }, (_, i) => settings.start + i / 4000 * (until - settings.start)), drawn = solution.truth.columns, near = (n, is, name) => Math.abs(read(n).value - is) <= read(n).off * 1.001 + 0.003 * range(name);
          const limits = columns.filter((_, i) => drawn[i]?.length).map((name) => ({ name, range: sizeOf(drawn[columns.indexOf(name)]) }));
          cut(`between ${N}${UNIT} and ${N}`, (said, a, b) => judge(limits.some(({ name, range: [low, high] }) => near(a, low, name) && near(b, high, name)), what, said));
          assert.ok(dense.length);
        }
        cut(`between ${N}${UNIT} and ${N}`, () => undefined);
        cut(`(?:once in|once, at|twice, at|first at|last at|and) (?:t = )?${N}`, (said, n) => judge(read(n).value <= Math.abs(until) + Math.abs(settings.start) || /and/.test(said), what, said));
        cut('\\d+ times, ', () => undefined);
      }
      cut('\\(body \\d\\)', () => undefined);
      cut('and \\d+ more|, \\d+ more|\\d+ more', () => undefined);
      told = told.replace(/[\p{L}_′]+\[?\d+\]?[\p{L}′]*/gu, '');
      judge(!/\d/.test(told), `${what}: a number is read by nobody`, told);
    }
  }
  assert.ok(judged > (truth ? 20 : 0), `${judged} numbers`);
});
