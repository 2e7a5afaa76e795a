/* What keeps the page quick, as counts: how often something is asked, begun or drawn. Times are measured, not judged, by bench/page.mjs.
 *
 *   node speed.mjs [preset ...]        the presets whose sliders are dragged
 */
import { attempt, clean, finish, judge, open, same, settled, singleFile } from './help.mjs';

const presets = process.argv.length > 2 ? process.argv.slice(2)
  : ['projectile', 'spring', 'pendulum', 'kepler', 'damped-cubic', 'driven-oscillator', 'three-body-figure-eight', 'chain'];

/** Keeps each question about a motion with the number of the worker that was asked, and says which worker answers. */
function follow() {
  const seen = window.told = { workers: 0, asked: [], answered: [] }, numbers = new WeakMap(), post = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (message, ...rest) {
    if (!numbers.has(this)) {
      numbers.set(this, seen.workers++);
      this.addEventListener('message', ({ data }) => { if (data.answer?.tracks) seen.answered.push(numbers.get(this)); });
    }
    if (message.kind === 'solve') seen.asked.push({ unexamined: message.ask.unexamined === true, methods: message.ask.methods.length, worker: numbers.get(this) });
    return post.call(this, message, ...rest);
  };
}
/** Moves a slider once a frame, as a hand does; how often the still layer was drawn, and which questions had been asked when the hand came to rest. */
function dragged({ low, high, value, frames }) {
  return new Promise((done) => {
    const canvas = document.querySelector('#stage-figure canvas.stage-still'), context = canvas.getContext('2d'), clear = context.clearRect;
    const slider = document.querySelector('#dragged'), from = window.told.asked.length;
    let moved = 0, drawn = 0;
    context.clearRect = function (...box) { drawn++; clear.apply(context, box); };
    const move = () => {
      slider.value = String(Math.min(high, Math.max(low, value + ((moved % 20) + 1) * (high - low) / 200)));
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      if (++moved < frames) { requestAnimationFrame(move); return; }
      const asked = window.told.asked.slice(from);
      setTimeout(() => { delete context.clearRect; done({ asked, drawn }); }, 500);
    };
    requestAnimationFrame(move);
  });
}

await attempt('sliders', async () => {
  const page = await open(`${singleFile}#v=1&p=spring`, { before: follow });
  for (const preset of presets) {
    await page.goto('about:blank');
    await page.goto(`${singleFile}#v=1&p=${preset}`);
    await settled(page, 400);
    const [low, high, value] = await page.locator('#all-values input[type=range]').first().evaluate((s) => { s.id = 'dragged'; return [s.min, s.max, s.value].map(Number); });
    const { asked, drawn } = await page.evaluate(dragged, { low, high, value, frames: 60 });
    judge(`a slider of ${preset} redraws`, drawn > 0);
    judge(`… and asks at most once a frame for the methods, which are not examined meanwhile: ${preset}`,
      asked.length > 0 && asked.filter((a) => a.methods && a.unexamined).length <= 60 && asked.filter((a) => a.methods && !a.unexamined).length <= 1, JSON.stringify(asked.slice(0, 8)));
    await settled(page);
    judge(`when the hand rests they are: ${preset}`, await page.evaluate(() => window.told.asked.filter((a) => a.methods).at(-1).unexamined === false));
  }
  await clean('sliders', page);
});

await attempt('a spare worker', async () => {
  const page = await open(`${singleFile}#v=1&p=kepler`, { before: follow });
  await page.waitForFunction(() => window.told.workers === 2);
  const answered = await page.evaluate(() => window.told.answered.slice());
  same('the first worker answers', [...new Set(answered)], [0]);
  // So long that it is given up for the next.
  await page.locator('#until').evaluate((field) => { field.value = '60000'; field.dispatchEvent(new Event('input', { bubbles: true })); });
  await page.waitForFunction(() => window.told.asked.at(-1).worker === 0);
  await page.waitForTimeout(100);
  await page.locator('#until').evaluate((field) => { field.value = '7'; field.dispatchEvent(new Event('input', { bubbles: true })); });
  await page.waitForFunction((n) => window.told.answered.length > n, answered.length);
  const [next, workers] = await page.evaluate((n) => [window.told.answered[n], window.told.workers], answered.length);
  same('one that has to be ended is replaced by one that is ready', [next, workers], [1, 2]);
  await page.waitForFunction(() => window.told.workers === 3);
  await clean('a spare worker', page);
});

await attempt('nothing is drawn twice', async () => {
  const page = await open(`${singleFile}#v=1&p=spring`, { calm: true });
  /** How many pixels of the layer that keeps still are of the exact motion's colour, however faint. */
  const green = () => page.locator('#stage-figure canvas.stage-still').evaluate((canvas) => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let some = 0;
    for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 20 && data[i + 3] < 120 && data[i + 1] > data[i] + 40 && data[i + 1] > data[i + 2] + 20) some++;
    done(some);
  }))));
  const over = await green();
  await page.locator('body').press('Home');
  const before = await green();
  await page.locator('body').press('End');
  same('what is to come stands behind the motion until it is over', [over, before > 1000, await green()], [0, true, 0]);
  await clean('nothing is drawn twice', page, /readback/);
});

await attempt('ten methods', async () => {
  const ten = 'explicit-euler,symplectic-euler,midpoint,verlet,rk4,velocity-verlet,pefrl,yoshida4,kahan-li6,gauss4';
  const page = await open(`${singleFile}#v=1&p=kepler&a=${ten}`);
  await page.keyboard.press('Home');
  const methods = await page.locator('#methods .chips .chip[aria-pressed="true"]').count();
  await page.keyboard.press('Space');
  const seen = await page.evaluate(() => new Promise((done) => {
    const all = new Set();
    const tick = () => { all.add(document.querySelector('.transport-now').textContent); if (all.size < 20) requestAnimationFrame(tick); else done(all.size); };
    requestAnimationFrame(tick);
  }));
  same('ten methods are overlaid and move', [methods, seen], [10, 20]);
  await clean('ten methods', page);
});
await finish();
