/* How lines are stroked on a canvas. Law: the pieces of a line are the line, its dashes go on from piece to piece, what one can see through is stroked
 * once; and lines are thin only while pictures come too slowly for a hand that moves something.
 */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url), { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const contents = "export { canvasPen } from './figure/pen'; export { haste } from './stage/haste';";
const bundled = buildSync({ stdin: { contents, resolveDir: fileURLToPath(lab), loader: 'ts' }, bundle: true, format: 'esm', write: false, target: 'es2022' });
const { canvasPen, haste } = await import('data:text/javascript;base64,' + Buffer.from(bundled.outputFiles[0].contents).toString('base64'));

/** What is stroked: of each stroke its corners, its style and where its dashes begin. */
function stroked(act, widest) {
  const strokes = [];
  let corners = [];
  const context = {
    lineDashOffset: 0, globalAlpha: 1,
    setLineDash(dash) { this.dash = dash; },
    beginPath() { corners = []; },
    moveTo(x, y) { corners.push([x, y, 'move']); },
    lineTo(x, y) { corners.push([x, y, 'line']); },
    stroke() { strokes.push({ corners: corners.slice(), offset: this.lineDashOffset, width: this.lineWidth, alpha: this.globalAlpha, dash: this.dash.length }); },
  };
  act(canvasPen(context, 1000, 1000, widest));
  return strokes;
}
const spiral = Array.from({ length: 1001 }, (_, k) => [500 + 0.4 * k * Math.cos(0.1 * k), 500 + 0.4 * k * Math.sin(0.1 * k)]), flat = spiral.flat();
const lengths = spiral.map(() => 0);
for (let k = 1; k < spiral.length; k++) lengths[k] = lengths[k - 1] + Math.hypot(spiral[k][0] - spiral[k - 1][0], spiral[k][1] - spiral[k - 1][1]);

test('the pieces of a line are the line, each corner in its order, and overlap by a pixel', () => {
  const pieces = stroked((pen) => pen.line(flat, { colour: '#000', width: 2 }));
  assert.ok(pieces.length > 20, `${pieces.length} pieces`);
  const corners = [];
  pieces.forEach(({ corners: of }, n) => {
    assert.equal(of.filter(([, , how]) => how === 'move').length, 1);
    if (n) {
      const last = corners[corners.length - 1], [x, y] = of[0];
      assert.ok(Math.hypot(x - last[0], y - last[1]) <= 1 + 1e-9, 'a piece begins a pixel before the end of the last one');
      assert.deepEqual(of[1].slice(0, 2), last, 'and goes on at its end');
      corners.push(...of.slice(2).map(([a, b]) => [a, b]));
    } else corners.push(...of.map(([a, b]) => [a, b]));
  });
  assert.deepEqual(corners, spiral);
});
test('the dashes of a piece begin where the line has come to', () => {
  const short = spiral.slice(0, 200), pieces = stroked((pen) => pen.line(short.flat(), { colour: '#000', width: 2, dash: [8, 4] }));
  assert.ok(pieces.length > 4 && pieces.every(({ dash }) => dash === 2));
  pieces.forEach(({ corners, offset }, n) => {
    if (!n) { assert.equal(offset, 0); return; }
    const k = short.findIndex(([x, y]) => x === corners[1][0] && y === corners[1][1]);
    assert.ok(Math.abs(offset - (lengths[k] - Math.hypot(corners[0][0] - short[k][0], corners[0][1] - short[k][1]))) < 1e-9);
  });
  // Such a line fills the picture many times over.
  assert.ok(stroked((pen) => pen.line(flat, { colour: '#000', width: 2, dash: [8, 4] })).every(({ dash }) => dash === 0));
});
test('a line that one sees through is stroked once; one with gaps has its gaps', () => {
  assert.equal(stroked((pen) => pen.line(flat, { colour: '#000', width: 2, alpha: 0.5 })).length, 1);
  const gaps = stroked((pen) => pen.line([0, 0, 10, 0, NaN, NaN, 20, 0, 30, 0], { colour: '#000', width: 2, dash: [4, 4] }));
  assert.deepEqual(gaps.map(({ corners, offset }) => [corners.map(([x]) => x), offset]), [[[0, 10], 0], [[20, 30], 0]]);
});
test('no line is wider than is allowed', () => {
  assert.ok(stroked((pen) => pen.line(flat, { colour: '#000', width: 4 }), 1).every(({ width }) => width === 1));
  assert.ok(stroked((pen) => pen.line(flat, { colour: '#000', width: 4 })).every(({ width }) => width === 4));
});

function hurried() {
  let waiting = null, over = 0;
  const of = haste(() => { over++; }, (act) => { waiting = act; return 1; }, () => { waiting = null; });
  return { draws: (now, changing) => of.draws(now, changing), pause: () => { const act = waiting; waiting = null; act?.(); }, over: () => over, waits: () => waiting !== null };
}
test('lines are thin after three slow pictures of a change, and full again in a pause', () => {
  const hand = hurried(), thin = [0, 60, 120, 180, 240].map((now) => hand.draws(now, true));
  assert.deepEqual(thin, [false, false, false, true, true]);
  hand.pause();
  assert.equal(hand.over(), 1);
  assert.equal(hand.draws(300, true), false);
});
test('they stay full where pictures come in time, where nothing is changed, and where the hand pauses', () => {
  const fast = hurried(), idle = hurried(), slow = hurried();
  for (let k = 0; k < 50; k++) {
    assert.equal(fast.draws(16.7 * k, true), false);
    assert.equal(idle.draws(60 * k, false), false);
    assert.equal(slow.draws(400 * k, true), false);
  }
  assert.ok(!fast.waits() && !idle.waits() && !slow.waits());
});
