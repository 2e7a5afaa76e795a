/* Every example: it starts without an error, something moves, each open panel says what it shows, and pictures of it are kept in build/lab/shots/
 * to be looked at: light and wide, dark and narrow.
 */
import { mkdirSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { attempt, built, clean, example, figureOf, finish, judge, open, root, same, settled, singleFile } from './help.mjs';

const shots = join(built, 'shots');
mkdirSync(shots, { recursive: true });
const names = readdirSync(join(root, 'models')).filter((name) => name.endsWith('.motus')).map((name) => name.slice(0, -6)).sort();

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
    await example(page, name);
    await page.waitForTimeout(200);
    const summary = await page.locator('#stage-figure figcaption').textContent();
    judge(`${name}: the motion says what it shows`, /from t = .* to /.test(summary), summary);
    same(`${name}: no message, and nothing stopped`, [await page.locator('#model-problem').textContent(), await page.locator('#status .message').textContent()], ['', '']);
    await page.evaluate(() => document.activeElement?.blur());
    await page.keyboard.press('Home');
    const before = await pixels(page);
    await page.keyboard.press('End');
    await page.waitForTimeout(80);
    const after = await pixels(page);
    judge(`${name}: something moves`, before.some > 0 && after.some > 0 && before.sum !== after.sum, JSON.stringify([before, after]));
    for (const title of ['Against time', 'Error', 'Drift of an invariant', 'Phase plane']) {
      const figure = figureOf(page, title);
      await figure.scrollIntoViewIfNeeded();
      await page.waitForTimeout(60);
      const said = (await figure.locator('.figure-summary').textContent()) || (await figure.locator('.figure-message').textContent());
      judge(`${name}: “${title}” has a summary or says why it is empty`, said.length > 20 && !/NaN|undefined|null|Infinity/.test(said), said);
    }
    for (const [theme, width, height] of [['dark', 375, 740], ['light', 1280, 900]]) {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme: theme });
      await page.evaluate(() => scrollTo(0, 0));
      await page.waitForTimeout(150);
      judge(`${name}, ${width} px: the page does not scroll sideways`, await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), await page.evaluate(() => document.documentElement.scrollWidth));
      await page.screenshot({ path: join(shots, `${name}-${theme}.png`) });
    }
  });
}
await clean('examples', page, /readback/);
await finish();
