/* Every example: it starts without an error, something moves, each question below the stage that is there has an answer and a picture, a note says what to
 * try, and pictures of it are kept in build/lab/shots/ to be looked at: light and wide, dark and narrow.
 */
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { examples } from '../../lab/models.mjs';
import { attempt, built, clean, closer, example, finish, intoView, judge, open, same, settled, singleFile } from './help.mjs';

const shots = join(built, 'shots');
mkdirSync(shots, { recursive: true });
const names = examples.map(({ name }) => name);

/** A ball that comes to rest does so before its end. */
const accumulates = /^Verlet: bounces accumulate at t = 4\.06371276887\d+\(\d\)\u2009s\.$/;
/** What a canvas shows, as a number: that two pictures differ. */
const pixels = (page) => page.locator('#stage-figure canvas.stage-moving').evaluate((canvas) => {
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let sum = 0, some = 0;
  for (let i = 0; i < data.length; i += 4) if (data[i + 3]) { some++; sum = (sum * 31 + i + data[i]) % 4294967291; }
  return { some, sum };
});

const page = await open(singleFile);
for (const name of names) {
  await attempt(name, async () => {
    await page.evaluate(() => scrollTo(0, 0));
    await example(page, name);
    await page.waitForTimeout(200);
    const summary = await page.locator('#stage-figure figcaption').textContent();
    judge(`${name}: the motion says what it shows`, /from t = .* to /.test(summary), summary);
    same(`${name}: no message, and nothing stopped`, [await page.locator('#model-problem').textContent(), (await page.locator('#status .message').textContent()).replace(accumulates, '')], ['', '']);
    await page.evaluate(() => document.activeElement?.blur());
    await page.keyboard.press('Home');
    const before = await pixels(page);
    await page.keyboard.press('End');
    await page.waitForTimeout(80);
    const after = await pixels(page);
    judge(`${name}: something moves`, before.some > 0 && after.some > 0 && before.sum !== after.sum, JSON.stringify([before, after]));
    await closer(page);
    const figures = page.locator('#panels > figure:not([hidden]):is([data-figure="error"], [data-figure="drift"], [data-figure="time"], [data-figure="phase"], [data-figure="section"], [data-figure="events"])'), count = await figures.count();
    judge(`${name}: there are questions`, count >= 1, count);
    for (let k = 0; k < count; k++) {
      const figure = figures.nth(k), id = await figure.getAttribute('data-figure');
      await intoView(figure);
      // A reference may be computed first.
      await page.waitForFunction((of) => !document.querySelector(`figure[data-figure="${of}"] .figure-answer`).hidden, id);
      const [question, answer, summary] = await Promise.all(['h3', '.figure-answer', '.figure-summary'].map((part) => figure.locator(part).textContent()));
      judge(`${name}: ${id}: a question with an answer`, /\?$/.test(question) && /^\S.{8,}\.$/.test(answer), `${question} ${answer}`);
      judge(`${name}: ${id}: numbers are numbers`, !/NaN|undefined|null|Infinity|∞|–\.| – /.test(`${question} ${answer} ${summary}`) && /\d|on it|round-off/.test(answer), `${answer} ${summary}`);
      // Grey are the axes; names stand at the right.
      const part = await figure.locator('canvas.figure-still').evaluate((canvas) => {
        const width = Math.round(0.6 * canvas.width), { data } = canvas.getContext('2d').getImageData(0, 0, width, canvas.height), columns = new Set();
        for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 60 && Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 40) columns.add(i / 4 % width);
        return columns.size / width;
      });
      judge(`${name}: ${id}: a picture, with a curve across it`, part > (id === 'events' ? 0.002 : 0.3), part);
    }
    judge(`${name}: a note says what to try`, (await page.locator('#scene-note').textContent()).length > 60);
    for (const [theme, width, height] of [['dark', 390, 844], ['light', 1280, 900]]) {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme: theme });
      await page.evaluate(() => scrollTo(0, 0));
      await page.waitForTimeout(150);
      const fits = await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth).then(() => true, () => false);
      judge(`${name}, ${width} px: the page does not scroll sideways`, fits, await page.evaluate(() => `${document.documentElement.scrollWidth} of ${innerWidth}`));
      await page.screenshot({ path: join(shots, `${name}-${theme}.png`) });
    }
  });
}
// Numbers of a note are those of the example's own values.
for (const [address, own, other] of [['p=bouncing-ball', /4\.0637/, /e² of the height/], ['p=pendulum', /\d\.\d/, /own values, which have been changed/]]) {
  await attempt(address, async () => {
    const note = page.locator('#scene-note');
    await example(page, address.slice(2));
    judge(`${address}: its numbers`, own.test(await note.textContent()), await note.textContent());
    await page.evaluate((hash) => { location.hash = hash; }, `#v=1&${address}&s=${address === 'p=pendulum' ? 'theta(0)%3D1' : 'e%3D0.5'}`);
    await settled(page);
    judge(`${address}: none of them for other values`, other.test(await note.textContent()) && !own.test(await note.textContent()), await note.textContent());
  });
}
await page.locator('#scene-note button').click();
await settled(page);
judge('back to its values: the answer', /\d\.\d/.test(await page.locator('#scene-note').textContent()), await page.locator('#scene-note').textContent());
await clean('examples', page, /readback/);
await finish();
