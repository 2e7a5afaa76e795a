/* The times at which the exact motion is read (lab/sample.ts). Run by `node --test`; the source is bundled on the way.
 * Law: straight lines between the points are within half a pixel of the motion, in a picture of 4000 by 2200 pixels of any two columns, or of one
 * against the time; the number of points is bounded; times are strictly in the order of the motion.
 */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url);
const { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const built = buildSync({ entryPoints: [fileURLToPath(new URL('sample.ts', lab))], bundle: true, format: 'esm', write: false, target: 'es2022' });
const { sample, SEEN } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));

const WIDTH = 4000, HEIGHT = 2200;
const limits = { tolerance: SEEN, points: 20000, milliseconds: 10000 };

/** of: the columns at a time. */
function motion(from, to, slopes, of) {
  const asked = { times: 0, calls: 0 };
  const ask = (times) => {
    asked.times += times.length;
    asked.calls++;
    for (let i = 1; i < times.length; i++) assert.ok((times[i] - times[i - 1]) * (to - from) > 0, 'asked in order');
    const rows = Array.from(times, of);
    return slopes.map((_, k) => Float64Array.from(rows, (row) => row[k]));
  };
  return { from, to, slopes, noise: slopes.map(() => 0), ask, of, asked };
}

const range = (column) => column.reduce(([a, b], v) => (Number.isFinite(v) ? [Math.min(a, v), Math.max(b, v)] : [a, b]), [Infinity, -Infinity]);

/** The furthest that the motion is from the lines, in pixels: `inside` times in every interval, to the nearest point of the line of that interval. */
function deviation(of, curve, inside = 23, skip = () => false) {
  const { times, columns } = curve, all = [times, ...columns], bounds = all.map(range);
  let worst = 0;
  for (let i = 0; i + 1 < times.length; i++) {
    for (let j = 1; j <= inside; j++) {
      const t = times[i] + (times[i + 1] - times[i]) * j / (inside + 1), row = [t, ...of(t)];
      if (skip(t, times[i], times[i + 1])) continue;
      for (let a = 0; a < all.length; a++) for (let b = 0; b < all.length; b++) {
        if (a === b) continue;
        const pixel = (k, v, size) => (v - bounds[k][0]) / (bounds[k][1] - bounds[k][0] || 1) * size;
        const px = pixel(a, row[a], WIDTH), py = pixel(b, row[b], HEIGHT);
        const x0 = pixel(a, all[a][i], WIDTH), y0 = pixel(b, all[b][i], HEIGHT), dx = pixel(a, all[a][i + 1], WIDTH) - x0, dy = pixel(b, all[b][i + 1], HEIGHT) - y0;
        const length = dx * dx + dy * dy, part = length > 0 ? Math.min(1, Math.max(0, ((px - x0) * dx + (py - y0) * dy) / length)) : 0;
        worst = Math.max(worst, Math.hypot(px - x0 - part * dx, py - y0 - part * dy));
      }
    }
  }
  return worst;
}

function ordered(curve, from, to) {
  const { times } = curve;
  assert.equal(times[0], from);
  assert.equal(times[times.length - 1], to);
  for (let i = 1; i < times.length; i++) assert.ok((times[i] - times[i - 1]) * (to - from) > 0);
  assert.ok(curve.columns.every((column) => column.length === times.length));
}

const drawn = (name, m, options = {}) => test(name, () => {
  const curve = sample(m, limits);
  ordered(curve, m.from, m.to);
  const most = deviation(m.of, curve, options.inside);
  assert.ok(most <= 0.5, `${most} pixels`);
  assert.ok(curve.times.length <= (options.points ?? limits.points), `${curve.times.length} points`);
  curve.times.forEach((t, i) => assert.deepEqual(curve.columns.map((column) => column[i]), m.of(t)));
});

const ball = (t) => [4 * t, 8 * t - 4.905 * t * t, 4, 8 - 9.81 * t];
drawn('a ball', motion(0, 1.5, [2, 3, -1, -1], ball), { points: 1000 });
const spring = (t) => [Math.cos(t), -Math.sin(t)];
drawn('a spring, steps of 2.1 or not', motion(0, 60 * 2.1, [1, -1], spring), { points: 8000 });
drawn('a spring, backward', motion(60, -3, [1, -1], spring), { points: 5000 });

function kepler(e) {
  return (t) => {
    let low = -40, high = 40;
    for (let i = 0; i < 70; i++) { const E = (low + high) / 2; if (E - e * Math.sin(E) < t) low = E; else high = E; }
    const E = (low + high) / 2, b = Math.sqrt(1 - e * e), rate = 1 / (1 - e * Math.cos(E));
    return [Math.cos(E) - e, b * Math.sin(E), -Math.sin(E) * rate, b * Math.cos(E) * rate];
  };
}
drawn('Kepler, e = 0.9, five turns', motion(0, 10 * Math.PI, [2, 3, -1, -1], kepler(0.9)), { points: 8000 });
drawn('Kepler, e = 0.99', motion(-3, 3, [2, 3, -1, -1], kepler(0.99)), { points: 4000 });

/* A bump of width w in a slow motion, between two of the times that are asked first. */
const spike = (w) => (t) => {
  const z = (t - 5.0047) / w;
  return [0.1 * t + Math.exp(-z * z), 0.1 - 2 * z / w * Math.exp(-z * z)];
};
drawn('a spike, 1/1000 of the time', motion(0, 10, [1, -1], spike(0.01)), { points: 3000 });
drawn('a layer, 1e-7 of the time', motion(0, 10, [1, -1], (t) => { const z = Math.tanh((t - 3.3) / 1e-6); return [z, (1 - z * z) / 1e-6]; }), { points: 4000 });

/* Its periods divide the first intervals: at their ends and middles it rests at the same place. */
for (const n of [64, 102.4]) drawn(`an oscillation, ${n} periods`, motion(0, 1, [1, -1], (t) => [Math.cos(2 * Math.PI * n * t), -2 * Math.PI * n * Math.sin(2 * Math.PI * n * t)]));
for (const n of [256, 512, 1024]) {
  test(`an oscillation that would hide, ${n} periods: as many points as there may be, alike everywhere`, () => {
    const m = motion(0, 1, [1, -1], (t) => [Math.cos(2 * Math.PI * n * t), -2 * Math.PI * n * Math.sin(2 * Math.PI * n * t)]);
    const curve = sample(m, limits), per = curve.times.length / n, least = (2 * Math.PI / per) ** 2 / 16 * WIDTH;
    ordered(curve, 0, 1);
    assert.ok(curve.times.length <= limits.points && curve.times.length > 0.6 * limits.points, `${curve.times.length} points`);
    const most = deviation(m.of, curve, 5);
    assert.ok(most < 5 * least + 0.5, `${most} pixels, ${least} with even points`);
  });
}

test('a jump is one steep line, at its time', () => {
  const m = motion(0, 10, [1, -1], (t) => (t < Math.PI ? [Math.sin(t), Math.cos(t)] : [2 - 0.8 * Math.sin(t), -0.8 * Math.cos(t)]));
  const curve = sample(m, limits);
  ordered(curve, 0, 10);
  const most = deviation(m.of, curve, 23, (t, from, to) => to - from < 1e-10);
  assert.ok(most <= 0.5, `${most} pixels`);
  const steep = curve.times.findIndex((t, i) => curve.times[i + 1] - t < 1e-10 && curve.columns[0][i + 1] - curve.columns[0][i] > 1.9);
  assert.ok(Math.abs(curve.times[steep] - Math.PI) < 1e-9);
  assert.ok(curve.times.length < 3000, `${curve.times.length} points`);
});

test('a bounce: the corner is a point', () => {
  const m = motion(0, 2, [1, -1], (t) => { const s = t % 0.7; return [3.43 * s - 4.9 * s * s, 3.43 - 9.8 * s]; });
  const curve = sample(m, limits);
  assert.ok(deviation(m.of, curve, 23, (t, from, to) => to - from < 1e-10) <= 0.5);
});

test('a pole: points are not spent on it, the motion on both sides is drawn', () => {
  const m = motion(0, 3, [1, -1], (t) => [1 / (1 - t), 1 / (1 - t) ** 2]);
  const curve = sample(m, limits);
  ordered(curve, 0, 3);
  assert.ok(curve.times.length < 2000, `${curve.times.length} points`);
  assert.ok(curve.columns[0].every((x) => Math.abs(x) < 1e7), 'what is drawn beside it remains to be seen');
  assert.ok(curve.times.filter((t) => t < 0.9).length > 20 && curve.times.filter((t) => t > 1.1).length > 20);
});

test('numbers that are not finite are a gap, whose ends are found', () => {
  const m = motion(0, 4, [-1, -1], (t) => [Math.sqrt(2 - t), t > 3 ? Infinity : t]);
  const curve = sample(m, limits), x = curve.columns[0];
  ordered(curve, 0, 4);
  const last = x.reduce((found, v, i) => (Number.isFinite(v) ? i : found), -1);
  assert.ok(Math.abs(curve.times[last] - 2) < 1e-9, `${curve.times[last]}`);
  // A column that is no number here and there, or nowhere, takes nothing from the others.
  const beside = motion(0, 40, [1, -1, -1, -1], (t) => [Math.sin(t), Math.cos(t), NaN, Math.sqrt(Math.sin(0.3 * t))]), lines = sample(beside, limits);
  ordered(lines, 0, 40);
  assert.ok(deviation((t) => spring(t - Math.PI / 2), { times: lines.times, columns: lines.columns.slice(0, 2) }) <= 0.5);
  assert.ok(lines.times.length < 6000, `${lines.times.length} points`);
  const none = sample(motion(0, 1, [-1], () => [NaN]), limits);
  assert.ok(none.columns[0].every(Number.isNaN) && none.times.length < 1000);
});

test('what rests, and what moves by rounding alone, takes few points', () => {
  const m = motion(0, 10, [-1, -1, -1], (t) => [5, 3 + 4e-16 * Math.sin(1e9 * t), 0]);
  const curve = sample(m, limits);
  assert.ok(curve.times.length < 600, `${curve.times.length} points`);
});

test('times that are next to each other are not divided', () => {
  const from = 1e9, to = 1e9 + 40 * 2 ** -23;
  const m = motion(from, to, [-1], (t) => [Math.sin((t - from) * 1e9)]);
  ordered(sample({ ...m }, limits), from, to);
});

test('a motion that is slow to ask ends in time', () => {
  let asked = 0;
  const slow = motion(0, 100, [-1], (t) => { asked++; const until = performance.now() + 0.02; while (performance.now() < until); return [Math.sin(t * t)]; });
  const curve = sample(slow, { ...limits, milliseconds: 60 });
  // There is room for 3000 of them in 60 ms, on a busy machine for fewer.
  assert.ok(asked < 2 * 60 / 0.02, asked);
  ordered(curve, 0, 100);
});

test('times that are known are gone on from, and asked once where they are enough', () => {
  const m = motion(0, 20, [1, -1], spring), first = sample(m, limits);
  const again = motion(0, 20, [1, -1], (t) => spring(t).map((v) => v * (1 + 1e-6)));
  const second = sample(again, limits, first.times);
  assert.equal(again.asked.times, second.times.length);
  assert.ok(second.times.length < 1.1 * first.times.length);
});

test('a bend whose middle lies on the straight line is seen by the slopes', () => {
  const m = motion(0, 20 * Math.PI, [1, -1], (t) => [Math.sin(t), Math.cos(t)]);
  const curve = sample(m, limits, Float64Array.from({ length: 11 }, (_, i) => 2 * Math.PI * i));
  const most = deviation(m.of, curve);
  assert.ok(most <= 0.5, `${most} pixels`);
});

test('a peak evenly between two times is seen by the values around it, where slopes are not known', () => {
  const n = 64, h = 2 * Math.PI / n, m = motion(0, 2 * Math.PI, [-1], (t) => [Math.sin(t + h / 2)]);
  const curve = sample(m, limits, Float64Array.from({ length: n + 1 }, (_, i) => (i === n ? m.to : i * h)));
  const most = deviation(m.of, curve);
  assert.ok(most <= 0.5, `${most} pixels`);
});
