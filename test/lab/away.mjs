/* Taking it away: pictures say what they are of; the page inside another page; a film of the motion; the C program; the lecture. */
import { spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { attempt, clean, example, fields, figureOf, finish, judge, open, place, program, root, same, saved, serve, settled, shareOf, singleFile, numbersOf, tableOf } from './help.mjs';

const words = (svg) => [...svg.matchAll(/<text [^>]*>(.*?)<\/text>/g)].map(([, inside]) => inside.replace(/<[^>]*>/g, '').replaceAll('&#38;', '&').replaceAll('&#39;', "'").replaceAll('&#60;', '<').replaceAll('&#62;', '>').replaceAll('\u2009', ' '));

// --- pictures say what they are of ---------------------------------------------------------------------------------------------------------
await attempt('captions', async () => {
  const page = await open(singleFile + '#v=1&p=thrown-ball&h=0.1');
  const strip = words((await saved(page, 'Motion', 'SVG')).bytes.toString('utf8')).slice(-4);
  same('below the motion: title, equation, step and methods, link', strip, ['A thrown ball', "r'' = g", 'step 0.1 s · explicit Euler, symplectic Euler, midpoint (RK2)', '#v=1&p=thrown-ball&h=0.1']);
  await page.keyboard.press('Escape');
  const panel = words((await saved(page, 'Error', 'SVG')).bytes.toString('utf8')).slice(-4);
  same('below a panel: its own name too', [panel[0], panel.slice(1)], ['Error · A thrown ball', strip.slice(1)]);
  const { bytes } = await saved(page, 'Motion', 'PNG');
  const stage = await page.locator('#stage-picture').boundingBox();
  same('the PNG has room for it', [bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [2 * stage.width, 2 * (stage.height + 86)]);
  await page.keyboard.press('Escape');

  const nasty = "# <b>\"&amp;\nk = 2\nx'' = -k x  # </svg>\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 2\n";
  await page.goto('about:blank');
  await page.goto(`${singleFile}#v=1&m=${encodeURIComponent(nasty)}&a=verlet`);
  await settled(page);
  const own = (await saved(page, 'Motion', 'SVG')).bytes.toString('utf8');
  same('of a text of one’s own: its comment, its equation', words(own).slice(-4, -1), ['<b>"&amp;'.replaceAll('"', '&#34;'), "x'' = -k x", 'step 0.1 · Verlet']);
  same('… and it is well formed', await page.evaluate((text) => new DOMParser().parseFromString(text, 'image/svg+xml').querySelector('parsererror')?.textContent ?? '', own), '');
  await clean('captions', page);

  const { address } = await serve();
  const hosted = await open(`${address}motus-lab.html#v=1&p=spring&s=k%3D3`);
  judge('what is set is told', words((await saved(hosted, 'Motion', 'SVG')).bytes.toString('utf8')).at(-3).endsWith(';  k = 3'));
  const link = words((await saved(hosted, 'Motion', 'SVG')).bytes.toString('utf8')).at(-1);
  same('on a server the link is the whole address', link, `${address}motus-lab.html#v=1&p=spring&s=k%3D3`);
  await clean('captions, hosted', hosted);
  const long = await open(`${singleFile}#v=1&m=${encodeURIComponent(`${'# words and words\n'.repeat(200)}x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 2\n`)}`, { width: 390 });
  const short = words((await saved(long, 'Motion', 'SVG')).bytes.toString('utf8')).at(-1);
  judge('a long link is cut', short.startsWith('#v=1&m=') && short.endsWith('…') && short.length < 80, short);
  await clean('captions, long', long);
});

// --- inside another page ----------------------------------------------------------------------------------------------------------------------
const seen = (page) => page.evaluate(() => [...document.querySelectorAll('button, input, select, textarea, a, h1, h2, p, summary, label')]
  .filter((e) => e.checkVisibility({ visibilityProperty: true }) && e.getBoundingClientRect().width > 1 && e.closest('.dial-value') === null).map((e) => e.getAttribute('aria-label') ?? e.textContent.trim()).filter(Boolean));
for (const [width, height, fragment, dials] of [[320, 240, '#v=1&p=thrown-ball&embed=1&c=step', ['Step h', 'Step h']], [480, 320, "#v=1&p=thrown-ball&embed=1&c=step&c=r'(0).y", ['Step h', 'Step h', 'Upwards']], [600, 400, '#v=1&p=spring&embed=1', []],
  [720, 480, '#v=1&p=spring&embed=1&c=k&c=m', ['Stiffness', 'Mass']], [900, 600, '#v=1&p=kepler&embed=1&c=step&c=nothing', ['Step h', 'Step h']], [320, 240, '#v=1&p=three-body-figure-eight&embed=1&c=step', ['Step h', 'Step h']]]) {
  await attempt(`an embed, ${width} × ${height}`, async () => {
    const name = `an embed, ${width} × ${height}, ${fragment}`, writes = () => { window.writes = []; for (const way of ['setItem', 'removeItem']) { const of = Storage.prototype[way]; Storage.prototype[way] = function (...given) { window.writes.push(given[0]); return of.apply(this, given); }; } };
    const page = await open(singleFile + fragment, { width, height, first: true, before: writes });
    await page.waitForTimeout(900);
    same(`${name}: nothing plays by itself`, await page.getByRole('button', { name: 'Play (space)' }).count(), 1);
    const controls = await seen(page), known = ['Play (space)', 'Present time', ...dials, 'Open in motus lab', 'Initial velocity: arrow keys turn it up, down, left and right', 'show all'];
    judge(`${name}: picture, Play, time, sliders, link, nothing else`, ['Play (space)', 'Present time', ...dials, 'Open in motus lab'].every((c) => controls.includes(c)) && controls.every((c) => known.includes(c) || /^Step\b/.test(c)), controls.join('; '));
    const boxes = await page.evaluate(() => ['#stage-picture', '#dock', '.transport', '.embed-link', ...(document.querySelector('.embedded.embed-step') ? ['.scale-step'] : [])].map((s) => { const r = document.querySelector(s).getBoundingClientRect(); return [s, r.left, r.top, r.right, r.bottom]; }));
    judge(`${name}: nothing overflows`, boxes.every(([, l, t, r, b]) => l >= 0 && t >= 0 && r <= width + 0.5 && b <= height + 0.5) && await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth && document.documentElement.scrollHeight <= innerHeight && document.querySelector('#dock').scrollHeight <= document.querySelector('#dock').clientHeight + 1), JSON.stringify(boxes));
    const [, , top, , bottom] = boxes[0];
    judge(`${name}: the picture has most of it`, bottom - top > 0.45 * height, `${top} to ${bottom}`);
    await page.screenshot({ path: join(root, `build/lab/shots/embed-${width}-${dials.length}.png`) });
    await page.locator('.transport-play').click();
    await page.waitForTimeout(300);
    same(`${name}: it plays`, await page.getByRole('button', { name: 'Pause (space)' }).count(), 1);
    if (dials[0] === 'Step h') {
      await page.locator('#step-slider').focus();
      await page.keyboard.press('ArrowRight');
      await settled(page);
      judge(`${name}: the link is of what is seen`, /&h=/.test(await page.locator('.embed-link').getAttribute('href')) && !/embed|&c=/.test(await page.locator('.embed-link').getAttribute('href')));
    }
    await page.waitForTimeout(500);
    same(`${name}: it writes nothing, and keeps its address`, [await page.evaluate(() => window.writes), new URL(page.url()).hash], [[], fragment]);
    await clean(name, page);
  });
}
await attempt('the snippet', async () => {
  const text = `# "><script>window.hit=1</script> & 'it'\nk = 2\nx'' = -k x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 2\n`, { address } = await serve();
  const page = await open(`${address}motus-lab.html#v=1&m=${encodeURIComponent(text)}&a=verlet`), popup = await shareOf(page);
  await popup.getByText('Embed', { exact: true }).click();
  await popup.getByLabel('Slider for k', { exact: true }).check();
  const html = await popup.getByLabel('For the HTML of another page').inputValue();
  const parsed = await page.evaluate((source) => { const body = new DOMParser().parseFromString(source, 'text/html').body, f = body.firstElementChild; return { n: body.querySelectorAll('*').length, ...Object.fromEntries([...f.attributes].map((a) => [a.name, a.value])) }; }, html);
  same('the snippet is one frame, whatever the model says', [parsed.n, parsed.title, parsed.width, parsed.height, parsed.loading, Object.keys(parsed).length], [1, `"><script>window.hit=1</script> & 'it'`, '720', '480', 'lazy', 6]);
  judge('… of this address', parsed.src.startsWith(`${address}motus-lab.html#v=1&m=`) && parsed.src.endsWith('&embed=1&c=step&c=k'), parsed.src.slice(-60));
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await popup.getByRole('button', { name: 'Copy frame' }).click();
  await page.waitForTimeout(100);
  same('“Copy frame” copies it', await page.evaluate(() => navigator.clipboard.readText()), html);
  await clean('the snippet', page);

  writeFileSync(join(place, 'other.html'), `<!DOCTYPE html><title>Another page</title>${html.replace('lazy', 'eager')}`);
  const other = await serve(place), outer = await open(`${other.address}other.html`, { settle: false }), inner = outer.frameLocator('iframe');
  await inner.locator('.scale-step').waitFor();
  await inner.locator('canvas.stage-still[aria-label*="from t = 0 to 2"]').waitFor();
  same('in another page it shows the motion with its sliders', [await inner.locator('.dial:visible').count(), await inner.locator('.embed-link').getAttribute('target')], [2, '_blank']);
  await clean('another page', outer, /404/);

  const disk = await open(singleFile), share = await shareOf(disk);
  await share.getByText('Embed', { exact: true }).click();
  same('the dials of the scene are offered', await share.locator('fieldset label').allTextContents(), [' step', ' Upwards', ' Sideways']);
  judge('on a disk it is told', /lies on a disk, where other pages cannot reach it/.test(await share.textContent()));
  await clean('on a disk', disk);
});

// --- a film -----------------------------------------------------------------------------------------------------------------------------------
/** Duration, size, and pictures at the start and the end, as another page's player has them. */
async function played(bytes) {
  const player = await open('about:blank', { settle: false });
  const found = await player.evaluate(async (data) => {
    const video = document.createElement('video'), once = (name) => new Promise((done, fail) => { video.addEventListener(name, done, { once: true }); setTimeout(() => fail(new Error(`no ${name}`)), 8000); });
    video.muted = true;
    video.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))], { type: 'video/webm' }));
    await once('loadeddata');
    const canvas = document.createElement('canvas'), context = canvas.getContext('2d', { willReadFrequently: true });
    canvas.width = video.videoWidth;
    canvas.height = video.videoHeight;
    const pixels = () => { context.drawImage(video, 0, 0); return context.getImageData(0, 0, canvas.width, canvas.height).data; };
    const first = pixels().slice();
    // Played through, since what was recorded as it went can hardly be wound: the largest difference to its beginning, and how long it is.
    let differ = 0, over = false;
    video.addEventListener('ended', () => { over = true; });
    setTimeout(() => { over = true; }, 12000);
    await video.play();
    while (!over) {
      await Promise.race([new Promise((done) => video.requestVideoFrameCallback(done)), new Promise((done) => setTimeout(done, 300))]);
      const now = pixels();
      let count = 0;
      for (let i = 0; i < now.length; i += 4) if (Math.abs(now[i] - first[i]) + Math.abs(now[i + 1] - first[i + 1]) + Math.abs(now[i + 2] - first[i + 2]) > 90) count++;
      differ = Math.max(differ, count);
    }
    return { duration: video.currentTime, width: video.videoWidth, height: video.videoHeight, differ, ground: [...first.slice(0, 3)] };
  }, bytes.toString('base64'));
  await player.context().close();
  return found;
}
await attempt('a film', async () => {
  const page = await open(singleFile + '#v=1&p=thrown-ball'), popup = await shareOf(page), button = popup.getByRole('button', { name: 'Save “Motion” as WebM' }), said = popup.locator('p[role=status]');
  const [download] = await Promise.all([page.waitForEvent('download', { timeout: 20000 }), (async () => {
    await button.click();
    await page.waitForTimeout(1000);
    const part = await popup.locator('progress').evaluate((p) => p.value);
    judge('its progress is told', part > 0.2 && part < 0.9 && /Recording 2 s/.test(await said.textContent()), part);
  })()]);
  same('the film has the model’s name', download.suggestedFilename(), 'thrown-ball-motion.webm');
  await download.saveAs(join(place, 'film.webm'));
  const bytes = readFileSync(join(place, 'film.webm')), box = await page.locator('#stage-picture').boundingBox(), found = await played(bytes);
  same('it begins as EBML does', bytes.subarray(0, 4).toString('hex'), '1a45dfa3');
  const s = Math.min(2, 1920 / box.width);
  judge('it decodes: two seconds, the picture with its caption', Math.abs(found.duration - 2) < 0.6 && Math.abs(found.width - s * box.width) <= 2 && Math.abs(found.height - s * (box.height + 86)) <= 2, JSON.stringify(found));
  judge('and it moves', found.differ > 1000, found.differ);
  await page.waitForTimeout(200);
  same('the end is told', await said.textContent(), 'The film is saved.');
  let got = false;
  page.on('download', () => { got = true; });
  await button.click();
  await page.waitForTimeout(400);
  await popup.getByRole('button', { name: 'Cancel the film' }).click();
  await page.waitForTimeout(2200);
  same('cancelled: nothing is saved', [got, await said.textContent(), await button.textContent()], [false, 'No film was made.', 'WebM']);
  await clean('a film', page);
  const without = await open(singleFile, { before: () => { delete window.MediaRecorder; } }), share = await shareOf(without);
  await share.getByRole('button', { name: 'Save “Motion” as WebM' }).click();
  judge('a browser without a recorder is told', /records no WebM/.test(await share.locator('p[role=status]').textContent()));
  await clean('without a recorder', without);
  const dark = await open(singleFile + '#v=1&p=kepler', { theme: 'dark' }), menu = await shareOf(dark);
  const [other] = await Promise.all([dark.waitForEvent('download', { timeout: 30000 }), menu.getByRole('button', { name: 'Save “Motion” as WebM' }).click()]);
  await other.saveAs(join(place, 'dark.webm'));
  const night = await played(readFileSync(join(place, 'dark.webm')));
  judge('no longer than twelve seconds, and of the theme', night.duration > 6 && night.duration < 12.6 && night.ground.every((c) => c < 60), JSON.stringify(night));
  await clean('a dark film', dark);
});

// --- the C program -------------------------------------------------------------------------------------------------------------------------
await attempt('the C program', async () => {
  const page = await open(singleFile), build = dirname(program);
  const own = "# it's \"θ\" ??/ \\ %s\nk = 2\nx'' = -k sin(x) - 0.1 x'\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 3\nenergy = x'^2/2 - k cos(x)\n";
  for (const [fragment, label] of [['#v=1&p=projectile&a=midpoint,rk4', 'midpoint'], ['#v=1&p=pendulum&a=rk4&h=1%2F64&T=2%20pi&s=theta(0)%3D3', 'rk4'], ['#v=1&p=damped-spring&a=newmark(1%2F4,%201%2F2)', 'newmark(1/4, 1/2)'],
    [`#v=1&m=${encodeURIComponent(own)}&a=verlet&h=0,02`, 'verlet'], [`#v=1&m=${encodeURIComponent("k = 1\ntheta'' = -k sin(theta)\ntheta(0) = 2")}&a=rk4&s=k%3D4`, 'rk4']]) {
    await page.goto('about:blank');
    await page.goto(singleFile + fragment);
    // A number that the address sets is written into a text of one's own, which is computed anew.
    await settled(page, 900);
    const popup = await shareOf(page);
    await popup.getByText('As a C program').click();
    const source = await popup.getByLabel(/prints its last row/).inputValue();
    await page.keyboard.press('Escape');
    writeFileSync(join(place, 'motion.c'), source);
    const cc = spawnSync('cc', ['-std=c17', '-Wall', '-Wextra', '-Wpedantic', '-Werror', '-I', join(root, 'include'), join(place, 'motion.c'), join(build, 'libmotus.a'), '-lm', '-ldl', '-pthread', '-o', join(place, 'motion')], { encoding: 'utf8' });
    judge(`${label}: it compiles`, cc.status === 0, cc.stderr);
    const run = spawnSync(join(place, 'motion'), { encoding: 'utf8' });
    judge(`${label}: it runs`, run.status === 0, run.stderr);
    const told = new Map(run.stdout.trim().split('\n').map((line) => line.split(' = '))), { head, rows } = await numbersOf(page), last = rows.at(-1);
    const shown = head.map((name, i) => [name, last[i]]).filter(([name]) => name === 't' || name.endsWith(` (${label})`)).map(([name, value]) => [name.replace(` (${label})`, ''), Number(value)]);
    judge(`${label}: its last row is the page's, bit for bit`, shown.length > 1 && shown.every(([name, value]) => Object.is(Number(told.get(name) ?? NaN), value)), JSON.stringify([shown, [...told]]));
  }
  const popup = await shareOf(page);
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await popup.getByText('As a C program').click().catch(() => {});
  if (!await popup.getByRole('button', { name: 'Copy as C program' }).isVisible()) await popup.getByText('As a C program').click();
  await popup.getByRole('button', { name: 'Copy as C program' }).click();
  await page.waitForTimeout(100);
  const copied = await page.evaluate(() => navigator.clipboard.readText()).catch(() => '');
  judge('“Copy as C program” copies it, or selects it', copied.startsWith('/* cc') || await page.evaluate(() => document.activeElement.selectionEnd > 100), copied.slice(0, 40));
  await clean('the C program', page);
});

// --- the lecture -------------------------------------------------------------------------------------------------------------------------------
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
  for (const fragment of ['#v=1&p=thrown-ball', '#v=1&p=spring', '#v=1&p=thrown-ball&l=too-high-too-low.predict', '#v=1&p=three-body-figure-eight']) {
    await attempt(`a lecture, ${width}, ${fragment}`, async () => {
      const page = await open(singleFile + fragment, { width, height, theme }), name = `a lecture, ${width} × ${height}, ${theme}, ${fragment}`;
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
      await clean(name, page);
    });
  }
}

await finish();
