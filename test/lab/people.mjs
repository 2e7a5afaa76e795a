/* For everyone: axe-core finds nothing in either theme, wide or narrow, with all pictures open; everything by keyboard, with the focus always to be
 * seen; phones; those who asked for less motion.
 */
import { attempt, audit, clean, closer, editorOf, fields, figureOf, fingers, finish, judge, open, same, settled, shareOf, sideways, singleFile, told } from './help.mjs';

for (const width of [1280, 320]) {
  await attempt(`${width} px`, async () => {
    const page = await open(`${singleFile}#v=1&p=spring&q=x&f=x&f=x'`, { width, height: width < 500 ? 640 : 900, touch: width < 500 });
    const both = async (name) => {
      for (const theme of ['light', 'dark']) {
        await page.emulateMedia({ colorScheme: theme });
        await page.waitForTimeout(250);
        await audit(`${width} px, ${theme}, ${name}`, page);
      }
    };
    for (const title of ['Error', 'Phase', 'Order', 'Cost', 'Stability']) {
      await closer(page, title);
      await settled(page);
    }
    await page.evaluate(() => scrollTo(0, 0));
    await both('as it is');
    for (const summary of await page.locator('details:not([open]) > summary').all()) if (await summary.isVisible()) await summary.evaluate((s) => s.click());
    await shareOf(page);
    await settled(page);
    same(`${width} px, all folds open: the page does not scroll sideways`, await sideways(page), 0);
    // While the text has an error the step rests.
    const area = await editorOf(page);
    await page.locator('#step').fill('0');
    await area.fill("x'' = -foo");
    await told(page);
    await both('all folds open, with messages');
    if (width < 500) await fingers(`${width} px`, page);
    await clean(`${width} px`, page);
  });
}

// --- phones, and the widest ---------------------------------------------------------------------------------------------------------
for (const [width, height] of [[320, 568], [375, 667], [768, 1024], [3840, 2160]]) {
  await attempt(`${width} px`, async () => {
    const page = await open(`${singleFile}#v=1&p=double-pendulum`, { width, height, touch: width < 800 });
    same(`${width} px: the page does not scroll sideways`, await sideways(page), 0);
    const inView = (play = '.transport-play') => page.locator(play).evaluate((b) => {
      const r = b.getBoundingClientRect(), top = document.elementFromPoint(r.left + r.width / 2, r.top + r.height / 2);
      return r.top >= 0 && r.bottom <= innerHeight && r.left >= 0 && r.right <= innerWidth && b.contains(top);
    });
    judge(`${width} px: Play is in reach at the top`, await inView());
    const picture = await page.locator('#stage-picture').evaluate((p) => { const r = p.getBoundingClientRect(); return [r.top, r.width]; });
    judge(`${width} px: the picture begins on the first screen`, picture[0] < height * 0.75 && picture[1] > Math.min(width * 0.7, 600), picture.join());
    if (width < 800) {
      await page.evaluate(() => scrollTo(0, 1500));
      await page.locator('.mini-play').waitFor().catch(() => {});
      await page.waitForTimeout(100);
      judge(`${width} px: and further down`, await inView('.mini-play'));
      // No scroll trap: a finger that begins on the picture moves the page.
      same(`${width} px: fingers on a picture scroll the page`, await page.locator('#stage-figure canvas.stage-still').evaluate((c) => /auto|pan-y|manipulation/.test(getComputedStyle(c).touchAction)), true);
    }
    await page.evaluate(() => scrollTo(0, 0));
    await page.mouse.move(width / 2, height / 2);
    await page.mouse.wheel(0, 400);
    await page.waitForTimeout(200);
    judge(`${width} px: the wheel over the picture scrolls the page`, await page.evaluate(() => scrollY > 0 || document.documentElement.scrollHeight <= innerHeight));
    await clean(`${width} px`, page);
  });
}

// --- the keyboard -----------------------------------------------------------------------------------------------------------------------
await attempt('the keyboard', async () => {
  const page = await open(`${singleFile}#v=1&p=projectile`);
  for (const title of ['Order', 'Cost']) {
    await closer(page, title);
    await settled(page, 400);
  }
  await page.evaluate(() => { scrollTo(0, 0); document.activeElement?.blur(); });
  const seen = [], unseen = [], nameless = [];
  for (let i = 0; i < 260; i++) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => {
      const e = document.activeElement;
      if (!e || e === document.body) return null;
      window.order ??= new Map();
      if (window.order.has(e)) return 'again';
      window.order.set(e, window.order.size);
      // A ring is an outline or a shadow, of the element or of what shows it (a label, a mark beside it).
      const shows = (x) => { const s = getComputedStyle(x); return (s.outlineStyle !== 'none' && parseFloat(s.outlineWidth) > 0) || s.boxShadow !== 'none'; };
      const ring = shows(e) || [...(e.labels ?? [])].some(shows) || shows(e.parentElement) || shows(e.closest('.editor-field') ?? e) || (e.nextElementSibling !== null && shows(e.nextElementSibling));
      const r = e.getBoundingClientRect();
      const x = Math.min(innerWidth - 2, Math.max(1, r.left + Math.min(r.width / 2, 20))), y = r.top + Math.min(r.height / 2, 20), over = document.elementFromPoint(x, y);
      const covered = !over || !(e.contains(over) || over.contains(e) || [...(e.labels ?? [])].some((l) => l.contains(over)) || e.parentElement.contains(over));
      const inside = y >= 0 && y <= innerHeight;
      const name = e.getAttribute('aria-label') || (e.getAttribute('aria-labelledby') && 'named') || e.labels?.[0]?.textContent || e.textContent || e.title;
      return { what: `${e.tagName.toLowerCase()} “${(name ?? '').trim().slice(0, 40)}”`, named: Boolean(name?.trim()), ring, inside, covered, part: e.closest('main > *, body > *')?.id || e.closest('main > *, body > *')?.className || e.tagName };
    });
    if (at === null || at === 'again') break;
    seen.push(at);
    if (!at.ring || !at.inside || at.covered) unseen.push(`${at.what}${at.ring ? '' : ' has no ring'}${at.inside ? '' : ' is out of sight'}${at.covered ? ' is covered' : ''}`);
    if (!at.named) nameless.push(at.what);
  }
  judge('Tab: through everything, and no trap', seen.length > 60 && seen.length < 260, `${seen.length} stops`);
  judge('Tab: the focus can always be seen', unseen.length === 0, `${unseen.length}: ${unseen.slice(0, 6).join(', ')}`);
  judge('Tab: each stop has a name', nameless.length === 0, nameless.join());
  const parts = seen.map((s) => s.part).filter((part, i, list) => part !== list[i - 1]);
  same('Tab: one part of the page after the other', parts.length, new Set(parts).size) || console.log(`# ${parts.join(' ')}`);
  console.log(`# ${seen.length} stops: ${parts.join(', ')}`);
  const reached = await page.evaluate(() => [...document.querySelectorAll('button, select, textarea, input, summary, [tabindex="0"]')].filter((e) => e.checkVisibility() && !e.disabled && e.tabIndex >= 0 && !window.order.has(e) && !e.closest('.mini')).map((e) => e.getAttribute('aria-label') || e.textContent.slice(0, 30) || e.id));
  judge('Tab: nothing is left out', reached.length === 0, reached.join(', '));
  await page.keyboard.press('Shift+Tab');
  judge('Shift+Tab goes back', await page.evaluate(() => document.activeElement !== document.body));

  // Space plays, arrows step.
  await page.evaluate(() => document.activeElement?.blur());
  const now = () => page.locator('.transport-now').textContent();
  await page.keyboard.press('Home');
  same('Home: the start', await now(), '0.00');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  same('arrow: two steps', await now(), '0.10');
  await page.keyboard.press('ArrowLeft');
  same('arrow: one back', await now(), '0.05');
  await page.keyboard.press('End');
  same('End: the end', await now(), '3.00');
  await page.keyboard.press('Space');
  await page.waitForTimeout(400);
  const later = await now();
  judge('Space at the end plays from the start', Number(later) > 0.1 && Number(later) < 1.5, later);
  await page.keyboard.press('Space');
  const paused = await now();
  await page.waitForTimeout(200);
  same('Space pauses', await now(), paused);
  // Where keys have a meaning of their own they keep it.
  await (await editorOf(page)).focus();
  await page.keyboard.press('Control+End');
  await page.keyboard.type('# a b');
  judge('Space and arrows in the text are the text’s', (await page.locator('#model-text').inputValue()).endsWith('# a b') && await now() === paused);
  await page.locator('#step').focus();
  await page.keyboard.press('Home');
  same('Home in a field is the field’s', await now(), paused);
  await page.getByRole('button', { name: 'Share', exact: true }).focus();
  await page.keyboard.press('Space');
  same('Space on a button is the button’s', [await page.locator('.share .popup').isVisible(), await now()], [true, paused]);
  await page.keyboard.press('Escape');
  const slider = page.getByRole('slider', { name: 'Time in “Error”' });
  await slider.focus();
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowRight');
  judge('a picture’s time by the keys', /^0\.05/.test(await now()), await now());
  judge('… is read out', /midpoint/.test(await slider.getAttribute('aria-valuetext')), await slider.getAttribute('aria-valuetext'));
  await clean('the keyboard', page);
});

// --- less motion ------------------------------------------------------------------------------------------------------------------------
await attempt('less motion', async () => {
  const page = await open(singleFile, { calm: true });
  same('less motion: nothing moves unasked', await page.locator('.transport-now').textContent(), '2.00');
  await page.evaluate(() => { window.changes = 0; new MutationObserver(() => window.changes++).observe(document.querySelector('.transport-now'), { childList: true, characterData: true, subtree: true }); });
  await page.keyboard.press('Space');
  await page.waitForTimeout(1500);
  const changes = await page.evaluate(() => window.changes);
  judge('less motion: a few pictures, not a film', changes >= 1 && changes <= 5, changes);
  const moving = await page.evaluate(() => document.getAnimations().length);
  same('less motion: no transitions', moving, 0);
  await clean('less motion', page);
});
await finish();
