/* Figures of speed, printed, not judged: the machine may be busy with other things.
 *
 *   node speed.mjs [preset ...]        the presets whose sliders are dragged
 */
import { attempt, clean, finish, judge, open, settled, singleFile } from './help.mjs';

const presets = process.argv.length > 2 ? process.argv.slice(2)
  : ['projectile', 'spring', 'pendulum', 'kepler', 'damped-cubic', 'driven-oscillator', 'three-body-figure-eight', 'chain'];
const middle = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];
/** Milliseconds from an input event to the first frame in which the still layer of the motion was drawn anew after the answer. */
function redrawn(selector, value) {
  return new Promise((done) => {
    const canvas = document.querySelector('#stage-figure canvas.stage-still'), context = canvas.getContext('2d'), clear = context.clearRect;
    const field = document.querySelector(selector), began = performance.now();
    context.clearRect = function (...box) {
      delete context.clearRect;
      clear.apply(context, box);
      // The frame is drawn when its callbacks are over.
      const channel = new MessageChannel();
      channel.port1.onmessage = () => done(performance.now() - began);
      channel.port2.postMessage(0);
    };
    field.value = value;
    field.dispatchEvent(new Event('input', { bubbles: true }));
    setTimeout(() => done(NaN), 8000);
  });
}

/** What each picture shows: the event whose question was answered last before it was drawn. */
function follow() {
  const drag = window.drag = { event: 0, asked: new Map(), answered: 0 };
  const post = Worker.prototype.postMessage, seen = new WeakSet();
  Worker.prototype.postMessage = function (message, ...rest) {
    if (!seen.has(this)) {
      seen.add(this);
      this.addEventListener('message', ({ data }) => { drag.answered = drag.asked.get(data.id) ?? drag.answered; });
    }
    if (message.kind === 'solve' && drag.event) drag.asked.set(message.id, drag.event);
    return post.call(this, message, ...rest);
  };
}
/** Moves a slider once a frame, as a hand does; redraws: milliseconds from an event to the end of the frame that first shows it. */
function dragged({ low, high, value, frames }) {
  return new Promise((done) => {
    const canvas = document.querySelector('#stage-figure canvas.stage-still'), context = canvas.getContext('2d'), clear = context.clearRect;
    const slider = document.querySelector('#dragged'), redraws = [];
    let moved = 0, shown = 0;
    context.clearRect = function (...box) {
      clear.apply(context, box);
      const event = window.drag.answered;
      if (event === shown) return;
      shown = event;
      const channel = new MessageChannel();
      channel.port1.onmessage = () => redraws.push(performance.now() - event);
      channel.port2.postMessage(0);
    };
    const move = () => {
      window.drag.event = performance.now();
      slider.value = String(Math.min(high, Math.max(low, value + ((moved % 20) + 1) * (high - low) / 200)));
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      if (++moved < frames) requestAnimationFrame(move);
      else setTimeout(() => { delete context.clearRect; window.drag.event = 0; done({ frames, redraws }); }, 500);
    };
    requestAnimationFrame(move);
  });
}

await attempt('figures', async () => {
  const page = await open(singleFile + '#v=1&p=driven-oscillator', { before: follow });
  const times = [];
  for (let i = 0; i < 15; i++) {
    times.push(await page.evaluate(`(${redrawn.toString()})('#step', '${i % 2 ? '0.001' : '0.0010001'}')`));
    await settled(page, 250);
  }
  console.log(`# 100 000 steps of driven-oscillator, from a change to the redraw: ${middle(times).toFixed(0)} ms, at best ${Math.min(...times).toFixed(0)} ms (wanted: 60)`);
  judge('100 000 steps are redrawn', times.every((t) => t > 0), times.join());

  const ten = 'explicit-euler,symplectic-euler,midpoint,verlet,rk4,velocity-verlet,pefrl,yoshida4,kahan-li6,gauss4';
  await page.goto('about:blank');
  await page.goto(`${singleFile}#v=1&p=kepler&a=${ten}`);
  await settled(page);
  await page.keyboard.press('Home');
  const methods = (await page.locator('#methods .chips .chip[aria-pressed="true"]').count());
  await page.keyboard.press('Space');
  const stamps = await page.evaluate(() => new Promise((done) => {
    const all = [], began = performance.now();
    const tick = (t) => { all.push(t); if (performance.now() - began < 3000) requestAnimationFrame(tick); else done(all); };
    requestAnimationFrame(tick);
  }));
  const gaps = stamps.slice(1).map((t, i) => t - stamps[i]), dropped = gaps.reduce((sum, gap) => sum + Math.max(0, Math.round(gap / (1000 / 60)) - 1), 0);
  console.log(`# ${methods} methods overlaid, 3 s of animation: ${stamps.length} frames, ${dropped} dropped at 60 Hz, the longest gap ${Math.max(...gaps).toFixed(0)} ms`);
  judge('ten methods are overlaid and move', methods === 10 && stamps.length > 20);
  await page.keyboard.press('Space');

  for (const preset of presets) {
    await page.goto('about:blank');
    await page.goto(`${singleFile}#v=1&p=${preset}`);
    await settled(page, 400, 60000);
    const [low, high, value] = await page.locator('#all-values input[type=range]').first().evaluate((s) => { s.id = 'dragged'; return [s.min, s.max, s.value].map(Number); });
    const { frames, redraws } = await page.evaluate(dragged, { low, high, value, frames: 60 });
    const late = redraws.length ? `${middle(redraws).toFixed(0)} ms from the event to the end of the frame that shows it` : 'the model admits no other value of it';
    console.log(`# a slider of ${preset} dragged for ${frames} frames: ${redraws.length} pictures, ${late}`);
    judge(`a slider of ${preset} redraws`, redraws.length > 0);
    await settled(page, 300, 60000);
  }
  await clean('figures', page);
});
await finish();
