/* Taking it away: pictures say what they are of; the page inside another page; the C program. */
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { attempt, clean, finish, judge, open, place, program, root, same, saved, serve, settled, shareOf, singleFile, numbersOf } from './help.mjs';

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
await finish();
