/* Taking it away: pictures say what they are of; the page inside another page; a film of the motion; the C program; the lecture. */
import { spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { attempt, clean, example, fields, figureOf, finish, judge, open, place, program, root, same, saved, serve, settled, shareOf, singleFile, tableOf } from './help.mjs';

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
    const told = new Map(run.stdout.trim().split('\n').map((line) => line.split(' = '))), { head, rows } = await tableOf(page, 'Against time'), last = rows.at(-1);
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
