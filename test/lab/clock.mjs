/* Time: Play plays, at a speed that no monitor changes, to the end and not beyond it; the other controls of the clock; long work can be cancelled.
 */
import { attempt, clean, example, finish, judge, open, same, settled, singleFile, summaryOf, valuesOf } from './help.mjs';

const now = async (page) => Number((await page.locator('.transport-now').textContent()).replace('\u2212', '-'));
const press = (page, name) => page.locator('.transport').getByRole('button', { name }).click();

/** A monitor of our own: frames come when we say, with the times we say. */
function monitor() {
  let waiting = new Map(), count = 0, time = 1000;
  window.requestAnimationFrame = (f) => { waiting.set(++count, f); return count; };
  window.cancelAnimationFrame = (id) => { waiting.delete(id); };
  window.frames = (howMany, milliseconds) => {
    for (let i = 0; i < howMany; i++) {
      time += milliseconds;
      const due = [...waiting.values()];
      waiting = new Map();
      for (const f of due) f(time);
    }
  };
}

await attempt('speed and monitor', async () => {
  const page = await open(singleFile + '#v=1&p=projectile');
  await page.evaluate(monitor);
  const seen = {};
  for (const hertz of [15, 30, 60, 144, 240]) {
    await page.keyboard.press('Home');
    await page.keyboard.press('Space');
    await page.evaluate((hz) => { window.frames(1, 0); window.frames(hz, 1000 / hz); }, hertz);
    seen[hertz] = await now(page);
    judge(`${hertz} Hz: one second shows as much`, Math.abs(seen[hertz] - 1) < 0.011, seen[hertz]);
    await page.evaluate((hz) => window.frames(3 * hz, 1000 / hz), hertz);
    same(`${hertz} Hz: it stops at the end exactly`, [await page.locator('.transport-now').textContent(), await page.locator('.transport-play').getAttribute('aria-label')], ['3.00', 'Play (space)']);
  }
  for (const [speed, after] of [['0.25', 0.25], ['0.5', 0.5], ['2', 2], ['4', 3]]) {
    await page.locator('.transport select').selectOption(speed);
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press('Home');
    await page.keyboard.press('Space');
    await page.evaluate(() => { window.frames(1, 0); window.frames(60, 1000 / 60); });
    judge(`speed ${speed}`, Math.abs(await now(page) - after) < 0.02, await now(page));
    await page.evaluate(() => window.frames(1200, 1000 / 60));
    same(`speed ${speed}: the end exactly`, await now(page), 3);
  }
  await clean('speed and monitor', page);
});

await attempt('the clock', async () => {
  const page = await open(singleFile + '#v=1&p=projectile&h=0.07&T=1');
  // A busy machine may draw no frame for a while, and long gaps are not made up for: it is never ahead of the wall.
  const began = Date.now();
  await page.keyboard.press('Home');
  await press(page, 'Play (space)');
  await page.waitForFunction(() => Number(document.querySelector('.transport-now').textContent) > 0.3);
  await press(page, 'Pause (space)');
  const half = await now(page), passed = (Date.now() - began) / 1000;
  judge('Play plays, by the clock on the wall', half > 0.3 && half < passed + 0.02, `${half} after ${passed} s`);
  await press(page, 'One step forward (right arrow)');
  judge('one step forward ends at a step', Math.abs(await now(page) / 0.07 - Math.round(await now(page) / 0.07)) < 0.02 && await now(page) > half - 1e-9, await now(page));
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('Home');
  same('Home: the start', await now(page), 0);
  await press(page, 'One step back (left arrow)');
  same('no step before the start', await now(page), 0);
  for (let i = 0; i < 20; i++) await press(page, 'One step forward (right arrow)');
  same('no step beyond the end; the last one is shorter', await now(page), 1);
  const scrub = page.getByRole('slider', { name: 'Present time' });
  await scrub.evaluate((s) => { s.value = '5000'; s.dispatchEvent(new Event('input', { bubbles: true })); });
  judge('dragging the time', Math.abs(await now(page) - 0.5) < 0.01, await now(page));
  judge('… is read out', /t = 0\.50.* of 1/.test(await scrub.getAttribute('aria-valuetext')), await scrub.getAttribute('aria-valuetext'));
  await valuesOf(page);
  await page.locator('#until').fill('-1');
  await settled(page);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('End');
  same('backward in time: the end', await now(page), -1);
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowRight');
  judge('backward in time: a step', Math.abs(await now(page) + 0.07) < 1e-9, await now(page));
  await clean('the clock', page);
});

await attempt('long work', async () => {
  const slow = "N = 2000\nx[i]'' = -sum(j = 1..N: sin(x[i] - x[j])) for i = 1..N\nx[i](0) = i/N for i = 1..N\nx[i]'(0) = 0 for i = 1..N\nmethod rk4\nstep 0.001\nuntil 1\n";
  const page = await open(singleFile + '#v=1&m=' + encodeURIComponent(slow), { settle: false });
  const cancel = page.locator('#status button', { hasText: 'Cancel' });
  await cancel.waitFor({ state: 'visible' });
  judge('long work says so', /Computing/.test(await page.locator('#status').textContent()));
  const frames = await page.evaluate(() => new Promise((done) => {
    const stamps = [];
    const tick = (t) => { stamps.push(t); if (stamps.length < 31) requestAnimationFrame(tick); else done(Math.max(...stamps.slice(1).map((s, i) => s - stamps[i]))); };
    requestAnimationFrame(tick);
  }));
  judge('the page goes on meanwhile', frames < 500, frames);
  await cancel.click();
  await settled(page, 300, 10000);
  judge('it can be cancelled', /stopped/.test(await page.locator('#status').textContent()), await page.locator('#status').textContent());
  await example(page, 'spring');
  await settled(page);
  judge('and the next one is computed', (await summaryOf(page, 'Motion')).includes('60'), await summaryOf(page, 'Motion'));
  await clean('long work', page);
});

await finish();
