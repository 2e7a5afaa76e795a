/* The page in Firefox: its way from the first picture to an equation of one's own, without a complaint, its policy kept; and equations stand where they
 * stand in Chromium.
 *
 * FIREFOX names the browser; without one this test fails.
 */
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { firefox, firefoxPath } from './bidi.mjs';
import { attempt, built, clean, editorOf, example, finish, judge, open, same, settled, singleFile } from './help.mjs';

const shots = join(built, 'shots');
mkdirSync(shots, { recursive: true });
const caption = () => document.querySelector('#stage-figure figcaption')?.textContent ?? '';
const says = (page, selector, pattern) => page.until((s, p) => [...document.querySelectorAll(s)].map((e) => e.value ?? e.textContent).find((text) => new RegExp(p).test(text)) ?? null, selector, pattern);
const rests = () => document.querySelector('.transport-play').getAttribute('aria-label').startsWith('Play');

async function way(browser) {
  const page = await browser.open(singleFile);
  await attempt('it starts', async () => {
    await says(page, '#stage-figure figcaption', '1\\.96');
    same('it is seen from its end', await page.evaluate(() => document.querySelector('.transport-now').textContent), '2.00');
    const colours = () => page.until(() => {
      const seen = {};
      for (const canvas of document.querySelectorAll('#stage-picture > canvas')) {
        const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
        for (let i = 0; i < data.length; i += 4) if (data[i + 3] === 255) { const c = data.subarray(i, i + 3).join(); seen[c] = (seen[c] ?? 0) + 1; }
      }
      return Object.values(seen).some((n) => n > 500) ? seen : null;
    });
    const seen = await colours();
    for (const [name, colour] of [['exact', '21,128,61'], ['explicit Euler', '217,67,46'], ['symplectic Euler', '31,79,224']]) judge(`the picture has the colour of ${name}`, seen[colour] > 100, seen[colour]);
    judge('no script runs that is not the page’s own', await page.evaluate(() => {
      window.hit = 0;
      const script = document.createElement('script');
      script.textContent = 'window.hit = 1';
      document.body.append(script);
      script.remove();
      return window.hit === 0 && document.querySelector('meta[http-equiv="Content-Security-Policy"]').content.includes("default-src 'none'");
    }));
    await page.until(() => window.violations.length > 0);
    judge('… and the browser says so', (await page.evaluate(() => window.violations.splice(0))).every((v) => v.startsWith('script-src')));
    page.wrong.splice(0, page.wrong.length, ...page.wrong.filter((line) => !/Content-Security-Policy/.test(line)));
  });
  await attempt('Play', async () => {
    await page.click('.transport-play');
    await page.until(() => { const t = Number(document.querySelector('.transport-now').textContent); return t > 0.2 && t < 1.9; });
    judge('Play moves the time', true);
    await page.until(() => document.querySelector('.transport-now').textContent === '2.00');
    judge('… and it ends', await page.until(rests));
  });
  await attempt('the step by keys', async () => {
    await page.evaluate(() => document.querySelector('#step-slider').focus());
    await page.press('ArrowRight');
    judge('the address has the step', await page.until(() => /[#&]h=0\.1(&|$)/.test(location.hash)));
    judge('… and the miss is half', await says(page, '#stage-figure figcaption', '0\\.981'));
    judge('the slider says what it is', (await page.evaluate(() => document.querySelector('#step-slider').getAttribute('aria-valuetext'))) === '0.1 s, 20 steps');
  });
  await attempt('popovers', async () => {
    const shown = () => page.evaluate(() => document.querySelector('#all-values').matches(':popover-open') && document.querySelector('#all-values').checkVisibility());
    await page.click('button', 'All values');
    judge('a sheet opens', await page.until(() => document.querySelector('#all-values').matches(':popover-open')));
    const [left, top, right, bottom] = await page.evaluate(() => { const r = document.querySelector('#all-values').getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]; });
    judge('… on the screen', left >= 0 && top >= 0 && right <= 1280 && bottom <= 800 && right - left > 300 && bottom - top > 100, [left, top, right, bottom].join());
    await page.press('Escape');
    same('… and Escape closes it', await shown(), false);
  });
  await attempt('the gallery', async () => {
    await page.click('.nav-button', 'Gallery');
    await page.until(() => document.querySelectorAll('#gallery a.motion .thumb svg path').length > 23);
    await page.screenshot(join(shots, 'firefox-gallery.png'));
    await page.click('#gallery a.motion', 'Mass on a spring');
    judge('a card leads to its scene', await page.until(() => /[#&]p=spring(&|$)/.test(location.hash) && document.querySelector('#scene-title').textContent === 'Mass on a spring'));
    judge('… which is drawn', await says(page, '#stage-figure figcaption', '^x against time'));
    await page.screenshot(join(shots, 'firefox-spring.png'));
  });
  await attempt('a lesson', async () => {
    await page.goto(`${singleFile}#v=1&p=thrown-ball`);
    // The question that the build wrote opens the lesson once the script has put its own in its place.
    await page.until(() => document.querySelector('.transport-play') !== null && document.querySelector('.stage-figure')?.getAttribute('aria-busy') === 'false');
    await page.click('.ask-button');
    await page.click('.choice', 'On the green ball');
    await says(page, '#stage-figure figcaption', '^Path');
    await page.screenshot(join(shots, 'firefox-lesson.png'));
    await page.click('.lesson .primary', 'Throw');
    judge('it answers', await says(page, '.answer', 'it ends 1\\.96\\sm above\\.'));
    await page.until(rests);
    await page.click('.text-button', 'Leave');
  });
  await attempt('an equation of one’s own', async () => {
    await page.click('.pill');
    await page.until(() => document.activeElement?.id === 'model-text');
    await page.press('Control+a');
    await page.type("theta'' = -sin(theta)\ntheta(0) = 2");
    judge('its motion is shown', /from t = 0 to 25\b/.test(await says(page, '#stage-figure figcaption', '^theta against time, from t = 0 to 25')), await page.evaluate(caption));
    same('nothing is complained about', await page.evaluate(() => document.querySelector('#model-problem').textContent), '');
    judge('it is typeset', await page.until(() => document.querySelector('.typeset .equation math mi')?.textContent === 'θ'));
    await page.screenshot(join(shots, 'firefox-own.png'));
  });
  same('no error, no warning', page.wrong, []);
  same('its policy is kept', await page.evaluate(() => window.violations), []);
  await page.close();
}

/** Where each equation stands in its box, and how high it is; runs in the page. */
function placed() {
  return [...document.querySelectorAll('.pill, .typeset .equation')].filter((box) => box.checkVisibility()).flatMap((box) => [...box.querySelectorAll('math')].map((math) => {
    const a = box.getBoundingClientRect(), ink = [...math.querySelectorAll('mi, mn, mo')].map((e) => e.getBoundingClientRect()).filter((r) => r.width > 0), outer = math.getBoundingClientRect();
    return { name: box.className, text: math.textContent.slice(0, 40), left: Math.min(...ink.map((r) => r.left)) - a.left, middle: (outer.top + outer.bottom) / 2 - (a.top + a.bottom) / 2, box: a.height, width: Math.max(...ink.map((r) => r.right)) - Math.min(...ink.map((r) => r.left)) };
  }));
}
const models = ['thrown-ball', 'spring', 'pendulum', 'kepler', 'van-der-pol'];
async function equations(browser) {
  const there = await browser.open(singleFile), here = await open(singleFile, { height: 800 });
  for (const model of models) {
    await attempt(`the equations of ${model}`, async () => {
      await example(here, model);
      await there.goto(`about:blank`);
      await there.goto(`${singleFile}#v=1&p=${model}`);
      const found = [];
      for (const editing of [false, true]) {
        if (editing) { await editorOf(here); await there.click('.pill'); }
        await settled(here);
        const ours = await here.evaluate(placed);
        await there.until((wanted) => [...document.querySelectorAll('.pill math, .typeset .equation math')].filter((m) => m.checkVisibility()).map((m) => m.textContent.slice(0, 40)).join() === wanted, ours.map((e) => e.text).join());
        await there.evaluate(() => document.fonts.ready.then(() => true));
        found.push([ours, await there.evaluate(placed)]);
      }
      await there.screenshot(join(shots, `firefox-${model}.png`));
      await here.screenshot({ path: join(shots, `chromium-${model}.png`) });
      await here.locator('.words-head .close').click();
      for (const [ours, theirs] of found) {
        // Firefox has a thin space of its own behind sin and cos.
        for (const [what, most] of [['left', () => 2], ['middle', () => 2], ['box', () => 2], ['width', (e) => 2 + 0.04 * e.width]]) {
          const off = ours.map((e, i) => ({ ...e, by: theirs[i][what] - e[what] })).filter((e) => Math.abs(e.by) > most(e));
          judge(`${model}: ${what} as in Chromium`, off.length === 0, off.map((e) => `${e.name} ${e.text}: ${e.by.toFixed(1)} px`).join('; '));
        }
      }
    });
  }
  await there.close();
  await clean('the equations', here);
}

if (judge('Firefox is installed', firefoxPath() !== '', 'apt-get install firefox-esr, or name one in FIREFOX')) {
  const browser = await firefox();
  try {
    await way(browser);
    await equations(browser);
  } finally {
    await browser.close();
  }
}
await finish();
