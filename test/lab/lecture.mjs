/* The lecture: its keys, the whole screen, what is seen of a scene and of a lesson at the sizes of projectors. */
import { join } from 'node:path';
import { attempt, clean, example, fields, finish, judge, open, root, same, settled, singleFile } from './help.mjs';

const lecturing = (page) => page.evaluate(() => document.body.classList.contains('lecture'));
await attempt('the lecture’s keys', async () => {
  const page = await open(singleFile + '#v=1&p=thrown-ball'), time = () => page.locator('.transport-now').textContent(), press = async (...keys) => { for (const key of keys) await page.keyboard.press(key); await page.waitForTimeout(150); };
  const step = async () => { await settled(page); return page.locator('#step').inputValue(); }, on = () => page.locator('#methods .chip[aria-pressed=true]').evaluateAll((all) => all.map((c) => c.dataset.method));
  await press(']', '1', 'PageUp', '?');
  same('before it, its keys do nothing', [await step(), (await on()).length, await time(), await page.locator('#keys').isVisible()], ['0.2', 3, '2.00', false]);
  await page.locator('.pill').click();
  await page.locator('#model-text').focus();
  await page.keyboard.press('l');
  same('an L in a text is a letter', [await lecturing(page), (await page.locator('#model-text').inputValue()).includes('l')], [false, true]);
  await example(page, 'thrown-ball');
  await page.locator('.words-head .close').click();
  await page.evaluate(() => document.activeElement.blur());
  const before = await page.locator('.transport-now').evaluate((e) => e.getBoundingClientRect().height);
  await press('l');
  same('L begins it, on the whole screen', [await lecturing(page), await page.evaluate(() => document.fullscreenElement === document.documentElement)], [true, true]);
  const after = await page.locator('.transport-now').evaluate((e) => e.getBoundingClientRect().height);
  judge('letters are 1.6 times as large', Math.abs(after / before - 1.6) < 0.1, after / before);
  await press('[');
  same('[ halves the step', await step(), '0.1');
  await press(']', ']');
  same('] doubles it', await step(), '0.4');
  await press(']', ']', ']', ']');
  same('but not beyond the motion', await step(), '1.6');
  await press('[', '[', '[');
  same('the model’s own step is no change', (await fields(page)).h, undefined);
  await press('2');
  same('2 takes the second method away', await on(), ['explicit-euler', 'midpoint']);
  await press('2', '4');
  same('… and back, 4 adds the fourth', (await on()).sort(), ['explicit-euler', 'midpoint', 'symplectic-euler', 'verlet']);
  await press('9', 'Home');
  same('9 is none; Home', [(await on()).length, await time()], [4, '0.00']);
  await press('ArrowRight');
  same('the right arrow: a step', await time(), '0.20');
  await press('End');
  same('End', await time(), '2.00');
  await press('PageDown');
  same('Page Down plays', await page.getByRole('button', { name: 'Pause (space)' }).count(), 1);
  await press(' ', 'PageUp');
  same('Space halts, Page Up goes to the start', [await page.getByRole('button', { name: 'Play (space)' }).count(), await time()], [1, '0.00']);
  await press('?');
  judge('? shows the keys', await page.locator('#keys').isVisible() && /Page Down/.test(await page.locator('#keys').textContent()));
  await press('?');
  same('and hides them', await page.locator('#keys').isVisible(), false);
  await page.locator('#methods .chip').first().click();
  await page.keyboard.press(' ');
  await page.waitForTimeout(150);
  same('after a click Space is the motion’s', await page.getByRole('button', { name: 'Pause (space)' }).count(), 1);
  await press('l');
  same('L ends it', [await lecturing(page), await page.evaluate(() => document.fullscreenElement)], [false, null]);
  await press('Control+l', 'Alt+l');
  same('with Ctrl or Alt it is not ours', await lecturing(page), false);
  // A ring that is dragged stays under the pointer.
  await press('L');
  await settled(page);
  const ring = await page.locator('.stage-aim:not(.stage-ring)').boundingBox();
  await page.mouse.move(ring.x + ring.width / 2, ring.y + ring.height / 2);
  await page.mouse.down();
  await page.mouse.move(ring.x + ring.width / 2 - 12, ring.y + ring.height / 2 + 10, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  // On a busy machine the last picture may come after the core is quiet.
  let moved = ring;
  for (let i = 0; i < 30 && Math.abs(moved.x - ring.x + 12) >= 4; i++) {
    await page.waitForTimeout(100);
    moved = await page.locator('.stage-aim:not(.stage-ring)').boundingBox();
  }
  judge('the arrow follows the pointer', Math.abs(moved.x - ring.x + 12) < 4 && Math.abs(moved.y - ring.y - 10) < 4, JSON.stringify([ring, moved]));
  await clean('the lecture’s keys', page);

  const lesson = await open(singleFile + '#v=1&p=thrown-ball&l=too-high-too-low.predict', { before: () => { Element.prototype.requestFullscreen = () => Promise.reject(new TypeError('no')); } });
  await lesson.keyboard.press('L');
  same('refused the whole screen, it is in the window', [await lecturing(lesson), await lesson.evaluate(() => document.fullscreenElement)], [true, null]);
  const part = () => lesson.locator('.parts [aria-current]').textContent(), told = [];
  for (const key of ['PageDown', 'PageDown', 'PageDown', 'PageUp', 'PageUp', 'PageUp', 'PageUp']) { await lesson.keyboard.press(key); await lesson.waitForTimeout(100); told.push(await part()); }
  same('Page Down and Page Up go through the parts', told, ['Try', 'See', 'Why', 'See', 'Try', 'Predict', 'Predict']);
  for (let i = 0; i < 4; i++) { await lesson.keyboard.press('PageDown'); await lesson.waitForTimeout(100); }
  await settled(lesson);
  same('after the last the next lesson', [await part(), (await lesson.locator('.lesson-head > :first-child').textContent())], ['Predict', 'Lesson 3 of 7']);
  await lesson.keyboard.press('Escape');
  same('Escape leaves', await lecturing(lesson), false);
  await clean('a lecture without the whole screen', lesson);
});
for (const [width, height, theme] of [[1280, 720, 'light'], [1920, 1080, 'dark'], [1280, 720, 'dark'], [1920, 1080, 'light']]) {
  const page = await open('about:blank', { width, height, theme, settle: false });
  for (const fragment of ['#v=1&p=thrown-ball', '#v=1&p=spring', '#v=1&p=thrown-ball&l=too-high-too-low.predict', '#v=1&p=three-body-figure-eight']) {
    await attempt(`a lecture, ${width}, ${fragment}`, async () => {
      const name = `a lecture, ${width} × ${height}, ${theme}, ${fragment}`;
      await page.goto('about:blank');
      await page.goto(singleFile + fragment);
      await settled(page);
      await page.keyboard.press('l');
      await page.waitForTimeout(500);
      const box = (s) => page.locator(s).evaluate((e) => { const r = e.getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]; });
      const [left, top, right, bottom] = await box('#stage-picture'), dock = await box('#dock'), words = await box('#words'), inLesson = fragment.includes('l=');
      judge(`${name}: the picture is the largest`, (right - left) * (bottom - top) > (inLesson ? 0.35 : 0.5) * width * height, [left, top, right, bottom].join());
      judge(`${name}: nothing lies on another, nothing is cut off`, bottom <= dock[1] + 1 && (words[3] <= top + 1 || words[2] <= left + 1) && dock[3] <= height + 1 && dock[2] <= width + 1 && right <= width + 1
        && await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth && document.documentElement.scrollHeight <= innerHeight), JSON.stringify([words, [left, top, right, bottom], dock]));
      const smallest = await page.evaluate(() => Math.min(...[...document.querySelectorAll('#dock *, #words *')].filter((e) => e.checkVisibility({ visibilityProperty: true }) && !e.closest('math, .unseen, option') && parseFloat(getComputedStyle(e).fontSize) > 0 && [...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim()))
        .map((e) => parseFloat(getComputedStyle(e).fontSize) * (e.currentCSSZoom ?? 1))));
      judge(`${name}: no letters under 19 px`, smallest >= 19, smallest);
      await page.screenshot({ path: join(root, `build/lab/shots/lecture-${width}-${theme}-${fragment.replace(/.*[=.]/, '')}.png`) });
    });
  }
  await clean(`a lecture, ${width} × ${height}, ${theme}`, page);
}
await finish();
