/* The numbers of the notes (lab/words/en/notes.ts) are the program's. Run by `node --test`; MOTUS names the program.
 *
 * Law: what a note says is in it as it is written here, and the program computes it to the digits that are said.
 */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import test from 'node:test';
import { fileURLToPath } from 'node:url';

const lab = new URL('../../lab/', import.meta.url), root = fileURLToPath(new URL('../../', import.meta.url));
const { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const built = buildSync({ stdin: { contents: "export { movedNotes, notes } from './words/en/notes'; export { words, html } from './words'; export { stagings } from './stage/stagings'; export { scenes } from './scenes';", resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022' });
const { movedNotes, notes, stagings, scenes, words: said, html } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));

const motus = (...words) => execFileSync(process.env.MOTUS ?? `${root}build/motus`, words, { cwd: root, encoding: 'utf8', maxBuffer: 1 << 28 });
/** Columns of a run, by name. */
function run(model, columns, ...options) {
  const text = motus('run', `models/${model}.motus`, '-o', '-', '--quiet', '--columns', columns.join(','), ...options);
  const [, ...rows] = text.replace(/^#.*\n/gm, '').trim().split('\n').map(row => row.split(',').map(Number));
  return Object.fromEntries(columns.map((name, k) => [name, rows.map(row => row[k])]));
}
/** Errors at the end, by method. */
const errors = (model, methods, ...options) => Object.fromEntries(JSON.parse(motus('compare', `models/${model}.motus`, '--methods', methods.join(), '--json', ...options)).rows.map(row => [row.method, row.error_final]));
const last = list => list.at(-1);
/** As many digits as are said: 58 is 57.5 to 58.5. */
function near(got, said) {
  const digits = String(said).includes('e') ? 10 ** Number(String(said).split('e')[1]) : 10 ** -(String(said).split('.')[1]?.length ?? 0);
  assert.ok(Math.abs(got - Number(said)) <= 0.5001 * digits, `${got} is not ${said}`);
}
/** When two runs are first so far apart. */
function apart(model, places, set, limits, ...options) {
  const columns = ['t', ...places], one = run(model, columns, ...options), other = run(model, columns, ...options, '--set', set);
  return limits.map(limit => one.t[one.t.findIndex((_, i) => Math.hypot(...places.map(name => one[name][i] - other[name][i])) > limit)]);
}
const text = name => notes[name].map(piece => (typeof piece === 'string' ? piece : piece.map(part => (typeof part === 'string' ? part : part.label)).join(''))).join(' ');
/** What is said of a scene, and how it is computed. */
const claims = (name, said, check) => test(name, () => {
  for (const words of said) assert.ok(text(name).includes(words), `the note says no more: ${words}`);
  check();
});

const told = (model, ...options) => JSON.parse(motus('run', `models/${model}.motus`, '--json', ...options));
claims('bouncing-ball', ['before 4.0637 s', '135 of the bounces', '64 % of the height', 'about one step h longer', 'about g h faster', 'in steps of 0.125 s the ball comes to rise above its start', 'never comes to rest'], () => {
  const { accumulated, events } = told('bouncing-ball');
  near(accumulated.time, '4.0637');
  assert.equal(events.length, 135);
  near((events[1].time - events[0].time) ** 2 * 9.81 / 8, '0.64');
  const euler = told('bouncing-ball', '--method', 'explicit-euler', '--until', '40');
  assert.equal(euler.accumulated, null);
  assert.ok(Math.abs(euler.events.at(-1).time - 40) < 2, 'it bounces on');
  // A flight that begins with v takes 2 v/g and ends with v; "about" is to a tenth of what Euler adds.
  const g = 9.81, h = 0.125, e = 0.8;
  euler.events.slice(1).forEach(({ time, state }, k) => {
    const before = euler.events[k], left = -e * before.state["y'"];
    assert.ok(Math.abs(time - before.time - 2 * left / g - h) < 0.1 * h && Math.abs(-state["y'"] - left - g * h) < 0.1 * g * h, `flight ${k}`);
  });
  assert.ok(Math.max(...run('bouncing-ball', ['y'], '--method', 'explicit-euler', '--until', '40').y) > 1);
});
test('notes for other values have no number of the model’s values', () => {
  const numbers = Object.entries(movedNotes).flatMap(([name, note]) => { assert.ok(name in notes, name); return note.join(' ').match(/\d[\d.]*\d/g) ?? []; });
  assert.deepEqual(numbers, ['0.971635']);
});
claims('newtons-cradle', ['three contacts in the one instant t = 1', 'Momentum and energy stay 1 and 1/2'], () => {
  const { events, invariants } = told('newtons-cradle');
  assert.deepEqual(events.map(({ time }) => time), [1, 1, 1]);
  assert.deepEqual([invariants.momentum.final, invariants.energy.final], [1, 0.5]);
});
claims('billiard', ['Within 0.4 of the centre', '55 hits in 100 units', 'the same 1.833'], () => {
  const { events, invariants } = told('billiard');
  near(invariants.angular.final, '0.4');
  assert.equal(events.length, 55);
  for (let i = 1; i < events.length; i++) near(events[i].time - events[i - 1].time, '1.833');
});
claims('stick-slip', ['up to a pull of 1', 'with 0.6', 'slips back for 4.9337', 'the period 6.533703423', 'stretched to 1.240312 at most'], () => {
  const { events } = told('stick-slip');
  near(events[1].time - events[0].time, '4.9337');
  near(events[2].time - events[0].time, '6.533703423');
  near(events.at(-1).time - events.at(-3).time, '6.533703423');
  near(Math.max(...run('stick-slip', ['x'], '--every', '0.001').x), '1.240312');
});
claims('kicked-rotor', ['K = 0.971635', 'after 100 kicks no digit is known'], () => {
  assert.equal(told('kicked-rotor').events.length, 100);
  assert.notEqual(told('kicked-rotor', '--set', 'K=5').significant_until, null);
});
claims('projectile', ['0.7357 above', '0.7357 below', 'six hundred steps still leave 0.0736'], () => {
  for (const [h, said] of [['0.05', '0.7357'], ['0.005', '0.0736']]) {
    const all = errors('projectile', ['explicit-euler', 'symplectic-euler', 'midpoint', 'verlet'], '--step', h);
    // 0.73575 is between two numbers of four digits.
    for (const method of ['explicit-euler', 'symplectic-euler']) assert.ok(Math.abs(all[method] - Number(said)) < 6e-5, all[method]);
    assert.ok(all.midpoint < 1e-10 && all.verlet < 1e-10);
  }
});
claims('projectile-drag', ['2.62 s for the 43 m up', '53 m far', '3.25 s and 37 m', 'lands after 5.87 s', '25 m/s of the 50 m/s'], () => {
  assert.equal(scenes.find(({ model }) => model === 'projectile-drag').until, '5.87');
  const { t, 'r.x': x, 'r.y': y, "r'.x": u, "r'.y": v } = run('projectile-drag', ['t', 'r.x', 'r.y', "r'.x", "r'.y"], '--until', '5.8723', '--method', 'rk4', '--step', '0.001'), top = y.indexOf(Math.max(...y));
  near(t[top], '2.62');
  near(y[top], '43');
  near(x[top], '53');
  near(last(t) - t[top], '3.25');
  near(last(x) - x[top], '37');
  near(Math.hypot(last(u), last(v)), '25');
  near(Math.hypot(u[0], v[0]), '50');
  assert.ok(Math.abs(last(y)) < 0.01);
});
claims('spring', ['explicit Euler spirals outward', 'grow by a factor of 1.88 at every step', '2 s is the largest step'], () => {
  const most = (method, step) => { const { t, x } = run('spring', ['t', 'x'], '--method', method, '--step', step, '--until', '190'); return x.filter((_, i) => Math.abs(t[i] / step - Math.round(t[i] / step)) < 1e-6).map(Math.abs); };
  const grows = most('explicit-euler', '0.05');
  assert.ok(last(grows) > 5 * grows[0]);
  // Of both ends of the range at which they are stable.
  for (const method of ['symplectic-euler', 'verlet']) {
    assert.ok(Math.max(...most(method, '1.9')) < 4 && Math.max(...most(method, '1.99')) < 20, method);
    const far = most(method, '2.1');
    near(far.at(-1) / far.at(-2), '1.88');
  }
  // The slightly tilted ellipse: x² + v² − h x v.
  const { x, "x'": v } = run('spring', ['x', "x'"]), kept = x.map((q, i) => q * q + v[i] * v[i] - 0.05 * q * v[i]);
  assert.ok(Math.max(...kept) - Math.min(...kept.slice(0, -1)) < 1e-10);
});
claims('damped-spring', ['27 % narrower', '47 % less energy'], () => {
  const { x } = run('damped-spring', ['x'], '--method', 'rk4', '--step', '0.001'), peaks = x.filter((v, i) => i > 0 && v > x[i - 1] && v >= x[i + 1]);
  for (let k = 1; k < 5; k++) {
    near(100 * (1 - peaks[k] / peaks[k - 1]), '27');
    near(100 * (1 - (peaks[k] / peaks[k - 1]) ** 2), '47');
  }
});
claims('pendulum', ['at 2 it is 0.909', 'takes 8.35, a third longer than the 6.28', 'a swing takes 21.04'], () => {
  near(Math.sin(2), '0.909');
  for (const [start, said] of [['2', '8.35'], ['0.01', '6.28'], ['3.1', '21.04']]) {
    const { t, "theta'": v } = run('pendulum', ['t', "theta'"], '--set', `theta(0)=${start}`, '--until', '30', '--step', '0.005', '--method', 'gauss8'), back = v.findIndex((w, i) => i > 1 && w >= 0 && v[i + 1] < 0);
    near(t[back] + (t[back + 1] - t[back]) * v[back] / (v[back] - v[back + 1]), said);
  }
});
claims('resonance', ['by 2 cm', '58 cm to each side', '1.93 m, at t = 289'], () => {
  near(100 * Math.max(...run('resonance', ['x']).x.map(Math.abs)), '58');
  const { t, x } = run('resonance', ['t', 'x'], '--step', '0.5', '--until', '700'), most = Math.max(...x.map(Math.abs));
  near(most, '1.93');
  near(t[x.findIndex(v => Math.abs(v) === most)], '289');
});
claims('driven-oscillator', ['swells to 0.81 at t = 15', 'nearly at rest at t = 34', 'from 0.1 to 0.11', '7×10⁻⁷'], () => {
  const { t, x, "x'": v } = run('driven-oscillator', ['t', 'x', "x'"]), first = x.map(Math.abs).findIndex((a, i) => a > 0.8 && a > Math.abs(x[i + 1] ?? 0));
  near(Math.abs(x[first]), '0.81');
  near(t[first], '15');
  const rest = t.findIndex(u => u >= 34);
  assert.ok(Math.hypot(x[rest], v[rest]) < 0.05);
  assert.ok(Math.max(...x.map(Math.abs)) < 1);
  near(errors('driven-oscillator', ['verlet']).verlet, '7e-7');
  assert.ok(Math.abs(last(run('driven-oscillator', ['x'], '--set', 'F=0.11', '--until', '68').x)) > 1);
});
claims('damped-cubic', ['Half the step leaves a quarter of the error', 'takes 0.40, the fifth 0.84'], () => {
  const off = errors('damped-cubic', ['verlet'], '--step', '0.001').verlet;
  near(errors('damped-cubic', ['verlet'], '--step', '0.0005').verlet / off, '0.25');
  const { t, "x'": v } = run('damped-cubic', ['t', "x'"]), turns = [0, ...t.filter((_, i) => i > 1 && (v[i] > 0) !== (v[i - 1] > 0))];
  near(turns[1] - turns[0], '0.40');
  near(turns[5] - turns[4], '0.84');
});
claims('van-der-pol', ['From 0.1 as from 4', '2.02', 'a turn to 11.6'], () => {
  for (const start of ['0.1', '4']) {
    const { t, x } = run('van-der-pol', ['t', 'x'], '--set', `x(0)=${start}`, '--until', '60'), peaks = t.filter((_, i) => i > 0 && x[i] > x[i - 1] && x[i] >= x[i + 1]);
    near(x[t.indexOf(last(peaks))], '2.02');
    near(last(peaks) - peaks.at(-2), '11.6');
  }
});
claims('kepler', ['Kahan–Li 8 is 2×10⁻¹¹', 'turns backward, by 0.37° from one far end to the next', 'velocity Verlet ends 0.0016 away, and Kahan–Li 8 only 2×10⁻¹¹', 'lose no energy in the long run'], () => {
  near(errors('kepler', ['kahan-li8'])['kahan-li8'], '2e-11');
  for (const method of ['symplectic-euler', 'velocity-verlet']) {
    const { 'axis.x': x, 'axis.y': y, 'r.x': u, 'r.y': v, energy } = run('kepler', ['axis.x', 'axis.y', 'r.x', 'r.y', 'energy'], '--method', method), far = u.map((w, i) => Math.hypot(w, v[i]));
    const ends = far.map((_, i) => i).filter(i => i > 0 && i + 1 < far.length && far[i] > far[i - 1] && far[i] >= far[i + 1]), at = ends.map(i => Math.atan2(y[i], x[i]) * 180 / Math.PI);
    assert.equal(ends.length, 10);
    for (let k = 1; k < at.length; k++) near(at[k - 1] - at[k], '0.37');
    // Of the same place on the ellipse, the energy is the same on each turn.
    assert.ok(Math.abs(energy[ends[9]] - energy[ends[0]]) < 1e-4, method);
  }
  const dear = JSON.parse(motus('compare', 'models/kepler.motus', '--methods', 'velocity-verlet,kahan-li8', '--evaluations', '35700', '--json')).rows;
  near(dear.find(r => r.method === 'velocity-verlet').error_final, '0.0016');
  near(dear.find(r => r.method === 'kahan-li8').error_final, '2e-11');
});
claims('comet', ['0.19 au a year', 'sixty times as fast', 'Verlet is 2.3 au off and RK4 4.6 au', '7×10⁻⁶ au', '211 au away'], () => {
  const { "r'.x": u, "r'.y": v } = run('comet', ["r'.x", "r'.y"]), speeds = u.map((w, i) => Math.hypot(w, v[i])), off = errors('comet', ['explicit-euler', 'velocity-verlet', 'rk4', 'kahan-li8']);
  near(speeds[0], '0.19');
  near(Math.max(...speeds) / speeds[0], '60');
  near(off['velocity-verlet'], '2.3');
  near(off.rk4, '4.6');
  near(off['kahan-li8'], '7e-6');
  near(off['explicit-euler'], '211');
});
claims('arenstorf', ['One of 0.0001', 'ends 0.76 of that way', 'one of 10⁻⁸ at the start is 1.4×10⁻⁴', 'RK4 with the step 0.0085'], () => {
  const missed = (start, ...options) => { const { x, y } = run('arenstorf', ['x', 'y'], '--set', `x(0)=${start}`, '--every', '1000 steps', ...options); return Math.hypot(last(x) - start, last(y)); };
  near(missed(0.9941), '0.76');
  near(missed(0.99400001), '1.4e-4'.replace('1.4e-4', '0.00014'));
  near(38.44, '38');
  assert.ok(missed(0.994) < 1e-8 && missed(0.994, '--method', 'rk4', '--step', '0.0085') > 0.5);
});
claims('outer-solar-system', ['Jupiter has gone round 46 times, Saturn 18.6, Uranus 6.5, Neptune 3.3 and Pluto 2.3', '4.4 au from its place', '7×10⁻⁷ au'], () => {
  const places = [1, 2, 3, 4, 5, 6].flatMap(k => [`r[${k}].x`, `r[${k}].y`, `r[${k}].z`]), of = run('outer-solar-system', places), verlet = run('outer-solar-system', places, '--method', 'velocity-verlet');
  ['46', '18.6', '6.5', '3.3', '2.3'].forEach((said, k) => {
    const angles = of['r[1].x'].map((x, i) => Math.atan2(of[`r[${k + 2}].y`][i] - of['r[1].y'][i], of[`r[${k + 2}].x`][i] - x));
    const turned = angles.slice(1).reduce((sum, a, i) => { const d = a - angles[i]; return sum + d - 2 * Math.PI * Math.round(d / (2 * Math.PI)); }, 0);
    near(turned / (2 * Math.PI), said);
  });
  near(Math.hypot(...['x', 'y', 'z'].map(c => last(of[`r[2].${c}`]) - last(verlet[`r[2].${c}`]))), '4.4');
  near(errors('outer-solar-system', ['kahan-li8'])['kahan-li8'], '7e-7');
});
claims('three-body-figure-eight', ['after a third of the period', 'to seven digits'], () => {
  const names = [1, 2, 3].flatMap(k => [`r[${k}].x`, `r[${k}].y`]), of = run('three-body-figure-eight', names, '--until', String(6.32591398 / 3));
  [[1, 3], [2, 1], [3, 2]].forEach(([one, other]) => { for (const c of ['x', 'y']) assert.ok(Math.abs(last(of[`r[${one}].${c}`]) - of[`r[${other}].${c}`][0]) < 5e-8); });
});
claims('chain', ['by t = 1000 the third wave has 0.3 %', 'down to 97.5 % at t = 4580', 'the third wave has 4 % by t = 1000'], () => {
  const { t, E1, E3 } = run('chain', ['t', 'E1', 'E3'], '--until', '9000', '--every', '10'), least = E1.indexOf(Math.min(...E1));
  near(100 * E3[t.findIndex(u => u >= 1000)] / E1[0], '0.3');
  near(100 * E1[least] / E1[0], '97.5');
  near(t[least], '4580');
  assert.ok(E1[t.findIndex(u => u >= 8980)] / E1[0] > 0.995);
  const tall = run('chain', ['E1', 'E3'], '--set', 'A=2', '--every', '10');
  near(100 * last(tall.E3) / tall.E1[0], '4');
});
claims('charged-particle', ['the speed across the magnetic field is 1', 'RK4 loses 1.4×10⁻⁶', '2.7 times as fast', 'E.x = 0.5', 'swings between 0.82 and 1.30', '= 0.53125', 'RK4 loses 1.5×10⁻⁶ by t = 10', 'it is 3.89', 'the speed 2.99 in place of 1.26'], () => {
  const of = (method, ...options) => run('charged-particle', ["r'.x", "r'.y", "r'.z", 'energy'], '--method', method, ...options), none = ['--set', 'E=(0, 0, 0)'];
  const across = method => { const { "r'.x": u, "r'.y": v } = of(method, ...none); return u.map((w, i) => Math.hypot(w, v[i])); };
  for (const h of ['0.05', '0.4']) for (const v of (() => { const { "r'.x": u, "r'.y": w } = of('boris', ...none, '--step', h); return u.map((a, i) => Math.hypot(a, w[i])); })()) assert.ok(Math.abs(v - 1) < 1e-13, v);
  near(1e6 * (1 - last(across('rk4'))), '1.4');
  near(last(across('explicit-euler')), '2.7');
  // The model's own electric field.
  const speeds = method => { const { "r'.x": u, "r'.y": v, "r'.z": w } = of(method); return u.map((a, i) => Math.hypot(a, v[i], w[i])); };
  near(Math.min(...speeds('boris')), '0.82');
  near(Math.max(...speeds('boris')), '1.30');
  const energy = method => of(method).energy;
  for (const e of energy('boris')) assert.ok(Math.abs(e - 0.53125) < 1e-14, e);
  near(1e6 * (0.53125 - last(energy('rk4'))), '1.5');
  near(last(energy('explicit-euler')), '3.89');
  near(last(speeds('explicit-euler')), '2.99');
  for (const method of ['boris', 'kahan-li8']) near(last(speeds(method)), '1.26');
});
claims('crossed-fields', ['1 mm a nanosecond', '0.23 mm off after 150 ns', '28 mm away'], () => {
  const off = errors('crossed-fields', ['explicit-euler', 'boris']);
  near(off.boris, '0.23');
  near(off['explicit-euler'], '28');
});
claims('penning-trap', ['between 1 and 1.25 from the axis', '√2 wz = 2.83'], () => {
  const { 'r.x': x, 'r.y': y } = run('penning-trap', ['r.x', 'r.y']), away = x.map((u, i) => Math.hypot(u, y[i]));
  near(Math.min(...away), '1.00');
  near(Math.max(...away), '1.25');
  near(2 * Math.SQRT2, '2.83');
});
claims('double-pendulum', ['Change the first angle by 0.0001', '1 cm from where it would have been after 4.9 s, 10 cm after 5.6 s and 1 m after 7.0 s'], () => {
  apart('double-pendulum', ['x2', 'y2'], 'θ1(0)=2.0001', [0.01, 0.1, 1], '--method', 'gauss8', '--step', '0.002').forEach((t, k) => near(t, ['4.9', '5.6', '7.0'][k]));
});
claims('duffing', ['0.0001 farther out', '0.01 apart after 16 units of time, 0.1 after 32, and in different valleys at t = 79'], () => {
  apart('duffing', ['x'], 'x(0)=1.0001', [0.01, 0.1], '--method', 'rk4', '--step', '0.002').forEach((t, k) => near(t, ['16', '32'][k]));
  const [one, other] = ['1', '1.0001'].map(start => last(run('duffing', ['x'], '--set', `x(0)=${start}`, '--method', 'rk4', '--step', '0.002', '--until', '79').x));
  assert.ok(one * other < -0.1, `${one}, ${other}`);
});
claims('henon-heiles', ['with 0.125', 'begun 0.0001 nearer the centre, it is 0.01 away after 60 units of time and 0.1 after 130'], () => {
  near(run('henon-heiles', ['energy'], '--until', '1').energy[0], '0.125');
  apart('henon-heiles', ['x', 'y'], 'y(0)=-0.2499', [0.01, 0.1], '--method', 'gauss8', '--step', '0.02', '--until', '200').forEach((t, k) => near(t, ['60', '130'][k]));
});
claims('ueda', ['0.001 apart after 9 units of time, 0.01 after 37 and 0.1 after 96'], () => {
  apart('ueda', ['x'], 'x(0)=3.0001', [0.001, 0.01, 0.1], '--step', '0.002').forEach((t, k) => near(t, ['9', '37', '96'][k]));
});
claims('thrown-ball', ['1.962 m too high', '1.962 m too low', 'it is 0.981 m'], () => {
  for (const [h, said] of [['0.2', '1.962'], ['0.1', '0.981']]) for (const off of Object.values(errors('thrown-ball', ['explicit-euler', 'symplectic-euler'], '--step', h))) near(off, said);
});
claims('thrown-ball-air', ['(10.55, 1.09) m', '(11.81, 1.95) m', 'misses by 1.5 cm with the step 0.2, by 3.6 mm with 0.1'], () => {
  const at = (...options) => { const { 'r.x': x, 'r.y': y } = run('thrown-ball-air', ['r.x', 'r.y'], '--method', 'rk4', '--step', '0.001', ...options); return [last(x), last(y)]; };
  at().forEach((v, k) => near(v, ['10.55', '1.09'][k]));
  at('--set', 'm=4').forEach((v, k) => near(v, ['11.81', '1.95'][k]));
  near(100 * errors('thrown-ball-air', ['midpoint']).midpoint, '1.5');
  near(1000 * errors('thrown-ball-air', ['midpoint'], '--step', '0.1').midpoint, '3.6');
});

test('what a note names in quotation marks is a question of the page, or a heading of its theory', () => {
  const theory = readFileSync(new URL('theory/theory.html', lab), 'utf8'), questions = [...Object.values(said.panel), ...Object.values(said.study)].map(part => part?.question).filter(Boolean);
  const headings = [...questions, html.works, ...[...theory.matchAll(/<h[23][^>]*>(.*?)<\/h[23]>/g)].map(match => match[1])];
  let named = 0;
  for (const name of Object.keys(notes)) for (const [, heading] of text(name).matchAll(/“([^”]*)”/g)) { named++; assert.ok(headings.includes(heading), `${name}: ${heading}`); }
  assert.ok(named > 4);
});
test('each note that answers the question of its scene is computed here', () => {
  const source = readFileSync(fileURLToPath(import.meta.url), 'utf8');
  for (const { model } of scenes) if (!stagings[model].ask) assert.ok(source.includes(`claims('${model}'`), model);
});
