/* Figures of speed, printed, not judged: the machine may be busy with other things. */
import { attempt, clean, finish, judge, open, settled, singleFile } from './help.mjs';

const middle = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];
/** Milliseconds from an input event to the first frame in which the still layer of the motion was drawn anew after the answer. */
function redrawn(selector, value) {
  return new Promise((done) => {
    const canvas = document.querySelector('#stage-figure canvas.figure-still'), context = canvas.getContext('2d'), clear = context.clearRect;
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

await attempt('figures', async () => {
  const page = await open(singleFile + '#v=1&p=driven-oscillator');
  const times = [];
  for (let i = 0; i < 7; i++) {
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
  const methods = (await page.locator('.toggle[aria-pressed="true"]').count());
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

  for (const preset of ['projectile', 'spring', 'pendulum', 'kepler', 'damped-cubic', 'driven-oscillator', 'three-body-figure-eight', 'chain']) {
    await page.goto('about:blank');
    await page.goto(`${singleFile}#v=1&p=${preset}`);
    await settled(page, 400, 60000);
    const drags = [];
    const [low, high] = await page.locator('#parameters input[type=range]').first().evaluate((s) => { s.id = 'dragged'; return [Number(s.min), Number(s.max), Number(s.value)]; });
    const value = Number(await page.locator('#dragged').inputValue());
    for (let i = 1; i <= 5; i++) {
      drags.push(await page.evaluate(`(${redrawn.toString()})('#dragged', '${Math.min(high, Math.max(low, value + i * (high - low) / 200))}')`));
      await page.waitForTimeout(60);
    }
    console.log(`# a slider of ${preset}: ${middle(drags).toFixed(0)} ms from the event to the redraw (${drags.map((d) => d.toFixed(0)).join(' ')})`);
    judge(`a slider of ${preset} redraws`, drags.every((d) => d > 0), drags.join());
    await settled(page, 300, 60000);
  }
  await clean('figures', page);
});
await finish();
