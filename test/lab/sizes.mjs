/* For everyone, by what they have: fingers, a window at 400 %, colours that the system forces, letters that the reader made large, paper. */
import { join } from 'node:path';
import { attempt, audit, browserPath, built, chromium, clean, fingers, finish, judge, open, same, settled, sideways, singleFile } from './help.mjs';

// --- fingers, wherever one is -----------------------------------------------------------------------------------------------------------
for (const [width, height] of [[390, 844], [844, 390], [820, 1180]]) {
  await attempt(`fingers, ${width} px`, async () => {
    const page = await open(`${singleFile}#v=1&p=thrown-ball`, { width, height, touch: true, calm: true }), name = (where) => `${width} × ${height}, ${where}`;
    await fingers(name('the stage'), page);
    if (await page.locator('#menu-button').isVisible()) {
      await page.locator('#menu-button').tap();
      await fingers(name('the menu'), page);
      same(name('the menu: each of its buttons says what it does'), await page.locator('.tools > button, .tools > * > button, .tools .share > button').evaluateAll((all) => all.filter((b) => b.checkVisibility()).map((b) => b.innerText.trim())), ['Lessons', 'Equation', 'Undo', 'Share', 'Lecture', 'Colours: automatic']);
      judge(name('the menu: its names are those that are spoken'), await page.locator('.tools button:visible').evaluateAll((all) => all.every((b) => (b.getAttribute('aria-label') ?? b.innerText).startsWith(b.innerText.trim()))));
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
    for (const what of ['.transport-play', '.transport-line', '.transport-ticks', '.scale-step .dial-track', '.stops span:not(.on)', '.switch-track', '.chips .chip', '.chips .chip:not([aria-pressed=true])', '.transport-select', '#nav', '#scene-title', '.ask-button', '.pill', '#share button', '#theme button']) {
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

// --- letters as large as the reader has chosen in the browser ------------------------------------------------------------------------------------
await attempt('larger letters', async () => {
  const rows = ['#scene-title', '#scene-words', '.ask-button', '.pill small', '.nav-button', '.chip', '.dial-head label', '.dial input.value', '.stops span', '.transport-now', '.quiet-button'];
  const sizes = (page) => page.evaluate((all) => all.map((s) => { const e = document.querySelector(s); return [s, parseFloat(getComputedStyle(e).fontSize)]; }), rows);
  const usual = await open(`${singleFile}#v=1&p=thrown-ball`, { calm: true, height: 800 }), before = await sizes(usual);
  await clean('usual letters', usual);
  // Of the root alone: what the page asks of the window's width stays, so each letter can be compared.
  const doubled = () => { const sheet = new CSSStyleSheet(); sheet.replaceSync('html { font-size: 200% }'); document.adoptedStyleSheets = [sheet]; };
  const page = await open(`${singleFile}#v=1&p=thrown-ball`, { calm: true, height: 800, before: doubled });
  same('a root of 200 %: letters are twice as large', await sizes(page), before.map(([s, size]) => [s, 2 * size]));
  const cut = await page.evaluate(() => ['.chip', '.dial-head', '.transport-time', '.pill', '.nav-button', '.quiet-button', '.top', '#dials'].filter((s) => [...document.querySelectorAll(s)].some((e) => e.scrollHeight > 1.1 * e.clientHeight)));
  same('… no row is too low for them', cut, []);
  judge('… Play is round', await page.locator('.transport-play').evaluate((b) => Math.abs(b.offsetWidth - b.offsetHeight) < 1));
  judge('… the words end above the dock', await page.evaluate(() => document.querySelector('#words').getBoundingClientRect().bottom <= document.querySelector('#dock').getBoundingClientRect().top));
  await page.screenshot({ path: join(built, 'shots', 'letters-200.png') });
  await clean('a root of 200 %', page);
  // Chosen in the browser, what is asked of the window's width counts in these letters too.
  const large = await chromium.launch({ executablePath: browserPath(), args: ['--no-sandbox', '--disable-dev-shm-usage', '--blink-settings=defaultFontSize=32'] });
  const slow = "N = 2000\nx[i]'' = -sum(j = 1..N: sin(x[i] - x[j])) for i = 1..N\nx[i](0) = i/N for i = 1..N\nx[i]'(0) = 0 for i = 1..N\nmethod rk4\nstep 0.001\nuntil 1\n";
  try {
    for (const [width, height] of [[390, 844], [1280, 800], [1920, 1080]]) {
      const other = await (await large.newContext({ viewport: { width, height }, reducedMotion: 'reduce' })).newPage();
      for (const [what, hash] of [['the stage', '#v=1&p=thrown-ball'], ['a lesson', '#v=1&p=thrown-ball&a=explicit-euler&h=0.2&T=2&w=plane&l=too-high-too-low.try.0'], ['the gallery', '#v=1&p=spring&l=gallery']]) {
        await other.goto(singleFile + hash);
        await other.reload();
        await other.locator('.transport-now').filter({ hasText: /\d/ }).waitFor({ state: 'attached' });
        // The cards of the gallery get their places some frames after the page is there.
        await other.waitForFunction(() => document.documentElement.scrollWidth === document.documentElement.clientWidth).catch(() => {});
        same(`letters of 32 px, ${width} px, ${what}: not wider than the page`, await sideways(other), 0);
        if (/gallery/.test(hash)) continue;
        judge(`letters of 32 px, ${width} px, ${what}: a picture, and a way to play it`, await other.evaluate(() => document.querySelector('#stage').clientHeight >= 180 && document.querySelector('.transport-play').checkVisibility()), await other.evaluate(() => [document.querySelector('#stage').clientHeight, document.querySelector('.transport-play').checkVisibility(), document.body.className]));
      }
      await other.goto('about:blank');
      await other.goto(`${singleFile}#v=1&m=${encodeURIComponent(slow)}`);
      await other.locator('#status button', { hasText: 'Cancel' }).waitFor();
      same(`letters of 32 px, ${width} px, while it computes: not wider than the page`, await sideways(other), 0);
      judge(`letters of 32 px, ${width} px, while it computes: what it does, and the button that ends it`, await other.locator('#status').evaluate((status) => [...status.querySelectorAll('.message span, button')].every((e) => { const { left, right, top, width: w } = e.getBoundingClientRect(); return w > 0 && left >= 0 && right <= innerWidth && top >= 0; })), await other.locator('#status').textContent());
      judge(`letters of 32 px, ${width} px, while it computes: the title is not on the equation`, await other.evaluate(() => {
        const words = document.createRange(), pill = document.querySelector('.pill').getBoundingClientRect();
        words.selectNodeContents(document.querySelector('#scene-title'));
        const title = words.getBoundingClientRect();
        return title.right <= pill.left || title.bottom <= pill.top;
      }));
      await other.screenshot({ path: join(built, 'shots', `letters-computing-${width}.png`) });
      await other.context().close();
    }
  } finally {
    await large.close();
  }
});

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
  judge('paper, in a lesson: its words, the picture and its equation', /pill,math,h1,h2,p,(?:legend,)?stage-figure/.test((await printed()).join()) && !await page.locator('.choice').first().isVisible(), (await printed()).join());
  await clean('paper', page);
  // From the gallery it is the scene that is printed, whether it was seen before or not.
  const here = await open(`${singleFile}#v=1&p=spring&l=gallery`, { calm: true, height: 800 });
  const scenePrinted = async (what, title) => {
    await here.emulateMedia({ media: 'print' });
    const names = await here.evaluate(() => [...document.querySelectorAll('h1, canvas, math, table, input, a.motion')].filter((e) => e.checkVisibility({ visibilityProperty: true }) && e.getBoundingClientRect().width > 2).map((e) => e.id || e.className || e.localName));
    same(`paper, ${what}: title, equation, picture and numbers`, names.filter((name) => name !== 'stage-moving'), ['scene-title', 'math', 'stage-still', 'printed']);
    same(`paper, ${what}: of the scene`, await here.locator('#scene-title').textContent(), title);
    judge(`paper, ${what}: the picture is drawn`, await here.locator('canvas.stage-still').evaluate((c) => c.toDataURL().length > 20000 && c.getBoundingClientRect().height > 150));
    await here.screenshot({ path: join(built, 'shots', `paper-${title.toLowerCase().replace(/ /g, '-')}.png`) });
    await here.emulateMedia({ media: null });
    const sheet = await here.pdf({ format: 'A4' });
    same(`paper, ${what}: one page`, (sheet.toString('latin1').match(/\/Type\s*\/Page\b/g) ?? []).length, 1);
  };
  await scenePrinted('the gallery, opened first', 'Mass on a spring');
  await here.locator('#gallery a.motion', { hasText: 'Pendulum' }).first().click();
  await settled(here, 600);
  await here.locator('#nav button', { hasText: 'Gallery' }).click();
  await here.locator('#gallery a.motion').first().waitFor();
  await scenePrinted('the gallery, after a scene', 'Pendulum');
  same('the gallery is as it was', await here.evaluate(() => [document.querySelector('#gallery a.motion').checkVisibility({ visibilityProperty: true }), document.querySelector('#stage').checkVisibility({ visibilityProperty: true }), document.documentElement.scrollWidth - innerWidth <= 0]), [true, false, true]);
  await clean('paper, the gallery', here);
});
await finish();
