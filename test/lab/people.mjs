/* For everyone: axe-core finds nothing in either theme, wide or narrow, with all pictures open; everything by keyboard, with the focus always to be
 * seen; phones; those who asked for less motion.
 */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { attempt, built, clean, editorOf, fields, figureOf, finish, judge, open, root, same, settled, shareOf, singleFile, told } from './help.mjs';

const axe = readFileSync(join(root, 'lab/node_modules/axe-core/axe.min.js'), 'utf8');
const all = '&o=time,error,drift,phase,convergence,precision,stability';

async function audit(name, page) {
  await page.evaluate(axe);
  const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) => violations.map((v) => `${v.id}: ${v.nodes.slice(0, 3).map((n) => `${n.target.join(' ')} (${n.any[0]?.message ?? n.all[0]?.message ?? ''})`).join('; ')}`)));
  judge(`axe: ${name}`, found.length === 0, found.join(' | '));
}
/** What is touched is 44 px high, or its label is. */
async function fingers(name, page) {
  const small = await page.evaluate(() => [...document.querySelectorAll('button, select, input:not([type=range]), summary, textarea, a[href]:not(.skip)')].filter((e) => {
    const { width: w, height: h } = (e.closest('label') ?? e).getBoundingClientRect();
    return w > 0 && h > 0 && h < 43.5 && e.checkVisibility();
  }).map((e) => `${e.tagName} “${(e.getAttribute('aria-label') || e.textContent || e.id).slice(0, 30)}” ${Math.round(e.getBoundingClientRect().height)}`));
  judge(`${name}: what is touched is 44 px high`, small.length === 0, `${small.length}: ${small.slice(0, 8).join(', ')}`);
}
const sideways = (page) => page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);

for (const width of [1280, 320]) {
  await attempt(`${width} px`, async () => {
    const page = await open(`${singleFile}#v=1&p=spring${all}`, { width, height: width < 500 ? 640 : 900, touch: width < 500 });
    const both = async (name) => {
      for (const theme of ['light', 'dark']) {
        await page.emulateMedia({ colorScheme: theme });
        await page.waitForTimeout(250);
        await audit(`${width} px, ${theme}, ${name}`, page);
      }
    };
    for (const title of ['Error', 'Phase plane', 'Convergence', 'Work and precision', 'Stability']) {
      await figureOf(page, title).scrollIntoViewIfNeeded();
      await settled(page, 300, 60000);
    }
    await page.evaluate(() => scrollTo(0, 0));
    await both('as it is');
    for (const summary of await page.locator('details:not([open]) > summary').all()) if (await summary.isVisible()) await summary.evaluate((s) => s.click());
    await shareOf(page);
    await settled(page);
    same(`${width} px, all folds open: the page does not scroll sideways`, await sideways(page), 0);
    await (await editorOf(page)).fill("x'' = -foo");
    await page.locator('#step').fill('0');
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

// --- fingers, wherever one is -----------------------------------------------------------------------------------------------------------
for (const [width, height] of [[390, 844], [844, 390], [820, 1180]]) {
  await attempt(`fingers, ${width} px`, async () => {
    const page = await open(`${singleFile}#v=1&p=thrown-ball`, { width, height, touch: true, calm: true }), name = (where) => `${width} × ${height}, ${where}`;
    await fingers(name('the stage'), page);
    if (await page.locator('#menu-button').isVisible()) {
      await page.locator('#menu-button').tap();
      await fingers(name('the menu'), page);
      await page.keyboard.press('Escape');
    }
    for (const [button, sheet] of [['All values', '#all-values'], [/ more$/, '#all-methods']]) {
      await page.getByRole('button', { name: button }).first().tap();
      await page.locator(sheet).waitFor();
      await fingers(name(`the sheet ${sheet}`), page);
      await page.keyboard.press('Escape');
    }
    for (const part of ['predict', 'try.1', 'see.1', 'why.1']) {
      await page.goto('about:blank');
      await page.goto(`${singleFile}#v=1&p=thrown-ball&l=too-high-too-low.${part}`);
      await settled(page);
      judge(`${name(part)}: the lesson is there`, await page.locator('.lesson [aria-current=step]').isVisible());
      await fingers(name(`lesson, ${part}`), page);
    }
    await page.goto('about:blank');
    await page.goto(`${singleFile}#v=1&p=thrown-ball&l=gallery`);
    await settled(page);
    await fingers(name('the gallery'), page);
    await clean(`fingers, ${width} px`, page);
  });
}

// --- 400 %: a window of 1280 × 1024 has room for 320 × 256 of the page's pixels ---------------------------------------------------------
await attempt('400 %', async () => {
  const page = await open(singleFile, { width: 320, height: 256, calm: true });
  const seen = () => page.locator('#stage-picture').evaluate((p) => { const { top, bottom, width } = p.getBoundingClientRect(), r = { top: Math.max(0, top), bottom: Math.min(innerHeight, bottom) }; return [(r.bottom - r.top) / innerHeight, width, document.elementFromPoint(160, (r.top + r.bottom) / 2)?.closest('#stage-picture') !== null]; });
  const at = async (where) => { const [part, width, free] = await seen(); judge(`400 %, ${where}: the picture has 60 % of the height`, part >= 0.6 && width === 320 && free, `${part}, ${width} px, ${free ? '' : 'covered'}`); };
  await at('at first');
  same('400 %: nothing scrolls sideways', await sideways(page), 0);
  for (const what of ['.chips .chip', '#step-slider', '.transport-play', '.ask-button', '.pill']) {
    await page.locator(what).first().focus();
    await at(`at ${what}`);
    const [top, bottom, covered] = await page.locator(what).first().evaluate((e) => { const r = e.getBoundingClientRect(), over = document.elementFromPoint(r.left + r.width / 2, r.top + r.height / 2); return [r.top, r.bottom, !e.contains(over) && !over?.contains(e)]; });
    judge(`400 %: ${what} is seen below it`, top >= 0.6 * 256 && bottom <= 257 && !covered, [top, bottom, covered].join());
  }
  await page.locator('.transport-play').click();
  await page.waitForFunction(() => document.querySelector('.transport-play').getAttribute('aria-label').startsWith('Play') && document.querySelector('.transport-now').textContent === '2.00');
  await at('after Play');
  await page.locator('.ask-button').click();
  await page.locator('.choice').first().waitFor();
  await page.locator('.choice input').first().focus();
  await at('in a lesson');
  await audit('400 %, a lesson', page);
  await clean('400 %', page);
});

// --- colours that the system forces ---------------------------------------------------------------------------------------------------------
/** How far the colours within a box are from its first pixel's, at most. */
async function contrast(page, selector) {
  const picture = `data:image/png;base64,${(await page.locator(selector).first().screenshot()).toString('base64')}`;
  const sheet = await page.context().newPage();
  const found = await sheet.evaluate(async (source) => {
    const image = new Image();
    image.src = source;
    await image.decode();
    const { data } = (() => { const canvas = document.createElement('canvas'), pen = canvas.getContext('2d'); [canvas.width, canvas.height] = [image.width, image.height]; pen.drawImage(image, 0, 0); return pen.getImageData(0, 0, image.width, image.height); })();
    let most = 0;
    for (let i = 0; i < data.length; i += 4) most = Math.max(most, Math.abs(data[i] - data[0]) + Math.abs(data[i + 1] - data[1]) + Math.abs(data[i + 2] - data[2]));
    return most;
  }, picture);
  await sheet.close();
  return found;
}
for (const theme of ['light', 'dark']) {
  await attempt(`forced colours, ${theme}`, async () => {
    const page = await open(`${singleFile}#v=1&p=thrown-ball`, { theme, calm: true, height: 800, forced: true });
    for (const what of ['.transport-play', '.transport-line', '.transport-ticks', '.dial.step .dial-track', '.stops span:not(.on)', '.switch-track', '.chips .chip', '.chips .chip:not([aria-pressed=true])', '.transport-select', '#nav', '#scene-title', '.ask-button', '.pill', '#share button', '#theme button']) {
      const most = await contrast(page, what);
      judge(`forced colours, ${theme}: ${what} is seen`, most > 300, most);
    }
    const ground = await page.evaluate(() => { const probe = document.createElement('p'); probe.style.color = 'Canvas'; document.body.append(probe); const { color } = getComputedStyle(probe); probe.remove(); return color; });
    same(`forced colours, ${theme}: the picture’s own ground is the system’s`, await page.evaluate(() => { const probe = document.createElement('p'); probe.style.color = 'var(--surface)'; probe.style.forcedColorAdjust = 'none'; document.body.append(probe); const { color } = getComputedStyle(probe); probe.remove(); return color; }), ground);
    await page.screenshot({ path: join(built, 'shots', `forced-${theme}.png`) });
    await page.getByRole('button', { name: 'Why do the two Eulers miss?' }).click();
    await page.locator('.choice').first().click();
    for (const what of ['.parts', '.choice', '.lesson .primary']) judge(`forced colours, ${theme}: ${what} is seen`, await contrast(page, what) > 300);
    await page.screenshot({ path: join(built, 'shots', `forced-${theme}-lesson.png`) });
    await page.locator('#nav button', { hasText: 'Gallery' }).click();
    await page.locator('#gallery a.motion .thumb').first().waitFor();
    judge(`forced colours, ${theme}: a card’s picture is seen`, await contrast(page, '#gallery .thumb') > 300);
    await page.screenshot({ path: join(built, 'shots', `forced-${theme}-gallery.png`) });
    await clean(`forced colours, ${theme}`, page);
  });
}

// --- paper -----------------------------------------------------------------------------------------------------------------------------------
await attempt('paper', async () => {
  const page = await open(`${singleFile}#v=1&p=thrown-ball`, { calm: true, height: 800 });
  const printed = () => page.evaluate(() => [...document.querySelectorAll('h1, h2, p, button, canvas, math, table, select, input, summary, textarea, figure')].filter((e) => e.checkVisibility() && !e.closest('.unseen') && e.getBoundingClientRect().width > 2)
    .map((e) => e.id || e.className || e.localName));
  const wanted = ['scene-title', 'scene-words', 'pill', 'math', 'stage-figure', 'stage-still', 'stage-moving', 'printed'];
  await page.emulateMedia({ media: 'print' });
  same('paper: title, equation, picture, numbers, and nothing else', (await printed()).filter((name) => !/^motion-title$/.test(name)), wanted);
  same('paper: the numbers', await page.locator('.printed tr').evaluateAll((rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent).join(' | ')).slice(0, 3)),
    ['Method | Step (s) | Steps | Distance (m)', 'explicit Euler | 0.2 | 10 | 1.962', 'symplectic Euler | 0.2 | 10 | 1.962']);
  await page.emulateMedia({ media: null });
  const pdf = await page.pdf({ format: 'A4' });
  same('paper: one page', (pdf.toString('latin1').match(/\/Type\s*\/Page\b/g) ?? []).length, 1);
  await page.getByRole('button', { name: 'Why do the two Eulers miss?' }).click();
  await page.locator('.choice').first().waitFor();
  await page.emulateMedia({ media: 'print' });
  judge('paper, in a lesson: the picture and its equation', (await printed()).join().includes('pill,math,stage-figure') && !await page.locator('.choice').first().isVisible(), (await printed()).join());
  await clean('paper', page);
});

// --- the keyboard -----------------------------------------------------------------------------------------------------------------------
await attempt('the keyboard', async () => {
  const page = await open(`${singleFile}#v=1&p=projectile${all}`);
  for (const title of ['Step by step', 'Convergence', 'Work and precision', 'Stability']) {
    await figureOf(page, title).scrollIntoViewIfNeeded();
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
  await page.locator('#step-view').scrollIntoViewIfNeeded();
  await settled(page);
  judge('step mode: the step and its formula, with the numbers', /Step 2 of 60|2 of 60|3 of 60/.test(await page.locator('#step-view').textContent()) && /0\.05 · /.test(await page.locator('#step-view').textContent()), (await page.locator('#step-view').textContent()).slice(0, 300));
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
