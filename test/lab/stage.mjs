/* The stage: the first picture before any script, what fills the screen at each size, that nothing moves when it should not, frames that hold still, names and
 * brackets with the program's numbers, runaways, ghosts, undo, pinned runs.
 */
import { attempt, clean, example, fields, finish, held, judge, launch, motus, open, same, saved, settled, singleFile, visitAgain } from './help.mjs';

/** All texts of the picture, and its paths, as its SVG has them. */
async function drawn(page) {
  const svg = (await saved(page, 'Motion', 'SVG')).bytes.toString('utf8');
  await page.keyboard.press('Escape');
  const texts = [...svg.matchAll(/<text ([^>]*)>(.*?)<\/text>/g)].map(([, attributes, inside]) => ({
    text: inside.replace(/<[^>]*>/g, '').replaceAll('\u2009', ' '), x: Number(/ ?x="([^"]*)"/.exec(attributes)?.[1]), y: Number(/ y="([^"]*)"/.exec(attributes)?.[1]),
  }));
  return { svg, texts, words: texts.map((t) => t.text) };
}
const numbersOf = ({ texts }) => texts.filter((t) => /^−?[\d.]+( m)?$/.test(t.text));
const time = async (page) => (await page.locator('.transport-now').textContent());

// --- before any script --------------------------------------------------------------------------------------------------------------------
await attempt('without scripts', async () => {
  for (const [name, width, height] of [['desk', 1280, 800], ['wide', 1920, 1080], ['tablet', 820, 1180], ['phone', 390, 844], ['landscape', 844, 390]]) {
    const context = await (await launch()).newContext({ viewport: { width, height }, javaScriptEnabled: false }), page = await context.newPage();
    await page.goto(singleFile);
    const seen = await page.locator('#stage-picture > svg').evaluateAll((all) => all.filter((s) => getComputedStyle(s).display !== 'none').map((s) => s.getAttribute('class'))).catch(() => null);
    // Scripts are off for the page, not for the test.
    same(`${name}: one picture, its own`, seen, [`first first-${name}`]);
    const svg = page.locator(`#stage-picture > .first-${name}`);
    judge(`${name}: with the misses`, /1\.96/.test(await svg.textContent()) && /too high/.test(await svg.textContent()));
    judge(`${name}: the words are there`, await page.locator('#scene-title').textContent() === 'A thrown ball');
    await context.close();
  }
});

// --- the build's picture and the module's ------------------------------------------------------------------------------------------------
await attempt('the first picture', async () => {
  for (const [width, height] of [[320, 640], [412, 915], [932, 430], [768, 1024], [1024, 768], [1366, 650], [1440, 900], [1800, 900], [2560, 1440]]) {
    const { page, start } = await held(singleFile, { width, height, calm: true });
    await page.locator('#stage-picture > .first:visible').waitFor();
    const places = () => page.evaluate(() => ['#stage-picture', '#words', '#words .pill'].map((s) => document.querySelector(s).getBoundingClientRect()).map((b) => [b.x, b.y, b.width, b.height].map(Math.round)));
    const before = await places(), circles = await page.locator('#stage-picture > .first:visible circle').evaluateAll((all) => all.map((c) => { const b = c.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }));
    await start();
    same(`${width} × ${height}: nothing moves when the module takes over`, await places(), before);
    const ring = await page.locator('.stage-aim:not(.stage-ring)').boundingBox(), zoom = ring.width / 44, x = ring.x + 22 * zoom, y = ring.y + 22 * zoom;
    const off = Math.min(...circles.map(([cx, cy]) => Math.hypot(cx - x, cy - y)));
    judge(`${width} × ${height}: the ring of the throw was drawn where it is`, off < 1, off);
    await clean(`the first picture at ${width} × ${height}`, page);
  }
});

// --- the scale of the step on phones -------------------------------------------------------------------------------------------------------
await attempt('the scale of the step', async () => {
  for (const width of [320, 390]) {
    const page = await open(`${singleFile}#v=1&p=arenstorf`, { width, height: 844, touch: true, calm: true });
    await page.evaluate(() => document.fonts.ready);
    const { stops, marks, track } = await page.evaluate(() => {
      const all = [...document.querySelectorAll('.scale-step .stops span')], box = document.querySelector('.scale-step .stops').getBoundingClientRect();
      return { track: [box.left, box.right], stops: all.map((s) => { const { left, right } = s.getBoundingClientRect(); return [left, right]; }), marks: all.map((s) => s.getBoundingClientRect().left + parseFloat(getComputedStyle(s, '::before').left) + 3) };
    });
    judge(`${width}: its numbers are seen whole, and none on another`, stops.length === 5 && stops.filter(([left, right]) => right - left > 8).length === 3 && stops[0][0] >= 8 && stops[4][1] <= width - 8 && stops.every(([left, right], k) => k === 0 || left > stops[k - 1][1] + 2 || right - left < 8), JSON.stringify(stops));
    judge(`${width}: the marks stand where the slider stops`, marks.every((x, k) => Math.abs(x - (track[0] + (track[1] - track[0]) * k / 4)) < 1), `${marks} of ${track}`);
    if (width === 390) {
      await page.evaluate(() => { location.hash = `#v=1&m=${encodeURIComponent("x'' = -x\nx(0) = 1\nstep 1\nuntil 1")}`; });
      await settled(page);
      same('one step is one', await page.locator('#step-slider').getAttribute('aria-valuetext'), '1, 1 step');
    }
    await clean(`the scale of the step at ${width}`, page);
  }
});

// --- it fills the screen, and nothing shifts ----------------------------------------------------------------------------------------------
function shifts() {
  window.shift = 0;
  new PerformanceObserver((list) => { for (const entry of list.getEntries()) if (!entry.hadRecentInput) window.shift += entry.value; }).observe({ type: 'layout-shift', buffered: true });
}
// What a fast machine draws at once, a slow one draws in parts, between which things could shift.
for (const [width, height] of [[320, 640], [390, 844], [844, 390], [820, 1180], [1024, 768], [1280, 800], [1920, 1080], [3840, 2160]]) {
  await attempt(`${width} × ${height}`, async () => {
    const page = await open(singleFile, { width, height, touch: width < 1000, calm: true, before: shifts, slower: Math.min(width, height) < 400 ? 6 : 1 }), name = `${width} × ${height}`;
    await page.waitForTimeout(300);
    const shift = await page.evaluate(() => window.shift);
    judge(`${name}: nothing shifts while it loads`, shift <= 0.02, shift);
    // What a slow browser shows in parts, the equation last and first in a font that is 7 px wider: the question below keeps its place.
    const stood = await page.evaluate(() => {
      const pill = document.querySelector('#words .pill'), top = () => document.querySelector('#words .ask').getBoundingClientRect().top, now = top();
      pill.style.paddingRight = `${parseFloat(getComputedStyle(pill).paddingRight) + 7}px`;
      const wider = top();
      pill.style.display = 'none';
      const without = top();
      pill.removeAttribute('style');
      return [wider - now, without - now];
    });
    if (width < 1280) same(`${name}: the question stands before the equation does`, stood, [0, 0]);
    const box = (selector) => page.locator(selector).evaluate((e) => { const r = e.getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]; });
    const [left, top, right, bottom] = await box('#stage-picture'), area = (right - left) * (bottom - top) / (width * height);
    judge(`${name}: the picture is the largest thing on the first screen`, area > 0.36 && bottom <= height + 1 && right <= width + 1 && top >= 0, [left, top, right, bottom, area].join());
    for (const what of ['.transport-play', '#step-slider', '#methods .chips .chip:first-child']) {
      const [l, t, r, b] = await box(what);
      judge(`${name}: ${what} is on the first screen`, l >= 0 && t >= 0 && b <= height && l < width && (r <= width || what.includes('chip')), [l, t, r, b].join());
    }
    if (width < 500) { const [, , , b] = await box('.transport-play'); judge(`${name}: Play is in thumb's reach`, b > height - 130, b); }
    same(`${name}: no scrolling sideways`, await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth), 0);
    const before = await Promise.all(['#stage-picture', '#dock', '#words', '.transport-play'].map(box));
    await page.locator('.transport-play').click();
    await page.waitForTimeout(400);
    same(`${name}: Play moves nothing on the page`, await Promise.all(['#stage-picture', '#dock', '#words', '.transport-play'].map(box)), before);
    same(`${name}: and does not scroll it`, await page.evaluate(() => scrollY), 0);
    await clean(name, page);
  });
}

// --- the founding scene ---------------------------------------------------------------------------------------------------------------------
await attempt('the founding scene', async () => {
  const page = await open(singleFile, { calm: true, height: 800 });
  const first = await drawn(page);
  const { rows } = JSON.parse(motus('compare', 'models/thrown-ball.motus', '--methods', 'explicit-euler,symplectic-euler,midpoint', '--json'));
  const off = rows.find((row) => row.method === 'explicit-euler').error_final.toFixed(2);
  same('the bracket has the program’s error', [off, first.words.includes(`${off} m too high`), first.words.includes(`${off} m too low`)], ['1.96', true, true]);
  judge('the names stand at the ends, what coincides together', ['explicit Euler', 'symplectic Euler', 'exact = midpoint'].every((w) => first.words.includes(w)), first.words.join(' | '));
  const order = ['explicit Euler', 'exact = midpoint', 'symplectic Euler'].map((w) => first.texts.find((t) => t.text === w).y);
  judge('… in the order of the balls', order[0] < order[1] && order[1] < order[2], order.join());
  same('it is seen from its end', await time(page), '2.00');
  await page.locator('#step-slider').focus();
  await page.keyboard.press('ArrowRight');
  await settled(page);
  const half = await drawn(page);
  same('half the step, half the miss', [(await fields(page)).h, half.words.includes('0.98 m too high')], ['0.1', true]);
  same('the axes hold still', numbersOf(half), numbersOf(first));
  judge('the curve of before stays as a ghost', /opacity="0.55"/.test(half.svg));
  await page.waitForTimeout(1600);
  judge('… for a while', !/opacity="0.4"/.test((await drawn(page)).svg));
  await page.keyboard.press('Control+z');
  await settled(page);
  same('undo', [(await fields(page)).h, await page.locator('#step').inputValue()], [undefined, '0.2']);
  await page.keyboard.press('Control+y');
  await settled(page);
  same('redo', (await fields(page)).h, '0.1');
  await page.keyboard.press('Control+z');
  await settled(page);
  // The frame goes along once a motion leaves it, and only afterwards.
  const up = page.getByLabel('Upwards', { exact: true });
  // The strip of the numbers at the left, before and soon after, in one go: a busy machine could let the frame move between two questions.
  const strips = await up.evaluate(async (slider) => {
    const canvas = document.querySelector('#stage-figure canvas.stage-still'), dpr = canvas.width / canvas.clientWidth;
    const strip = () => canvas.getContext('2d').getImageData(296 * dpr, 60 * dpr, 24 * dpr, 340 * dpr).data.join();
    const frames = (n) => new Promise((done) => { const next = () => (n-- ? requestAnimationFrame(next) : done()); next(); });
    const before = strip(), address = document.querySelector('#stage-figure figcaption').textContent;
    slider.dispatchEvent(new PointerEvent('pointerdown', { bubbles: true }));
    slider.value = '16';
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    for (let i = 0; i < 400 && document.querySelector('#stage-figure figcaption').textContent === address; i++) await frames(1);
    const after = strip();
    slider.dispatchEvent(new PointerEvent('pointerup', { bubbles: true }));
    return [before, after, address, document.querySelector('#stage-figure figcaption').textContent];
  });
  judge('a motion that leaves: the frame still holds', strips[0] === strips[1] && /[^0,]/.test(strips[0]) && strips[2] !== strips[3], strips.slice(2).join(' | '));
  await page.waitForTimeout(2200);
  judge('… and has moved when the hand rests', JSON.stringify(numbersOf(await drawn(page))) !== JSON.stringify(numbersOf(first)));
  await page.locator('#undo button').click();
  await settled(page);
  await page.locator('.dials-more .switch').click();
  await settled(page, 400);
  same('air: another model, the same throw', [(await fields(page)).p, (await drawn(page)).words.some((w) => w.startsWith('computed'))], ['thrown-ball-air', true]);
  judge('… in which mass matters', await page.getByLabel('Mass', { exact: true }).isVisible());
  await page.locator('.dials-more .switch').click();
  await settled(page);
  same('and back', (await fields(page)).p, 'thrown-ball');
  // The initial velocity is taken hold of.
  await page.locator('.stage-aim:not(.stage-ring)').focus();
  await page.keyboard.press('ArrowUp');
  await settled(page);
  judge('the arrow of the throw, by keys', /^r'\(0\)=\(6, 10\.[0-9]+\)$/.test((await fields(page)).s), (await fields(page)).s);
  const ring = await page.locator('.stage-aim:not(.stage-ring)').boundingBox();
  await page.mouse.move(ring.x + 22, ring.y + 22);
  await page.mouse.down();
  await page.mouse.move(ring.x + 42, ring.y + 2, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  judge('… and by the pointer', !/\(6, /.test((await fields(page)).s), (await fields(page)).s);
  await clean('the founding scene', page, /readback/);
});

// --- runaways ---------------------------------------------------------------------------------------------------------------------------------
await attempt('a runaway', async () => {
  const page = await open(singleFile + '#v=1&p=spring&a=explicit-euler,symplectic-euler,verlet&h=0.16&T=20', { calm: true, height: 800 });
  const first = await drawn(page);
  judge('it is clipped with a word and a number', first.words.includes('explicit Euler leaves') && first.words.some((w) => /^4\.[89] times too wide at 20 s$/.test(w)), first.words.join(' | '));
  await page.locator('.stage-all').click();
  await page.waitForTimeout(300);
  const all = await drawn(page);
  judge('“show all” shows all', !all.words.includes('explicit Euler leaves') && JSON.stringify(numbersOf(all)) !== JSON.stringify(numbersOf(first)));
  same('… and offers the way back', await page.locator('.stage-all').textContent(), 'show the exact motion');
  await page.locator('.stage-all').click();
  await page.waitForTimeout(300);
  same('… which is the frame of before', numbersOf(await drawn(page)), numbersOf(first));
  await clean('a runaway', page);
});

await attempt('one that stops', async () => {
  const page = await open(`${singleFile}#v=1&m=${encodeURIComponent("x'' = x - x^3\nx(0) = 0.1\nstep 0.2\nuntil 60\n")}&a=explicit-euler,verlet`, { calm: true, height: 800 });
  const told = () => page.locator('#stage-figure figcaption').textContent();
  await page.waitForFunction(() => /stops at t/.test(document.querySelector('#stage-figure figcaption').textContent));
  judge('… has no distance at the end', /Explicit Euler stops at t = [\d.]+/.test(await told()) && !/for explicit Euler/.test(await told()), await told());
  await clean('one that stops', page);
});

// --- pinned -------------------------------------------------------------------------------------------------------------------------------------
await attempt('a pinned run', async () => {
  const page = await open(singleFile, { calm: true, height: 800 });
  await page.getByRole('button', { name: /^Pin this run/ }).click();
  await page.locator('#step').fill('0.1');
  await settled(page);
  await page.waitForTimeout(1500);
  judge('A stays, B is what is changed', (await drawn(page)).words.filter((w) => w === 'A').length >= 2 && /A: h 0.2/.test(await page.locator('#dock-links').textContent()), await page.locator('#dock-links').textContent());
  await example(page, 'spring');
  judge('another example lets it go', !(await drawn(page)).words.includes('A'));
  await clean('a pinned run', page);
});

// --- one gentle run -------------------------------------------------------------------------------------------------------------------------------
await attempt('the first visit', async () => {
  const page = await open(singleFile, { settle: false, first: true });
  await page.waitForFunction(() => { const t = Number(document.querySelector('.transport-now')?.textContent); return t > 0 && t < 1.9; });
  await page.waitForFunction(() => document.querySelector('.transport-now').textContent === '2.00');
  judge('it runs once by itself and ends where it began', true);
  const seen = () => page.evaluate(() => localStorage.getItem('motus-lab-1:seen'));
  same('… which the page remembers', await seen(), '1');
  // Even a browser that lost what was stored knows that a page is loaded again.
  await page.evaluate(() => localStorage.removeItem('motus-lab-1:seen'));
  await page.reload();
  await settled(page);
  await page.waitForTimeout(1200);
  same('… and not when it is loaded again', await time(page), '2.00');
  await visitAgain(page, singleFile, () => page.evaluate(() => localStorage.setItem('motus-lab-1:seen', '1')), 'seen,1');
  await page.waitForTimeout(1200);
  same('… and never again on this device', await time(page), '2.00');
  await clean('the first visit', page);
});
await finish();
