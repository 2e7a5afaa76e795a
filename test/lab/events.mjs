/* Events on the page: the remark of what ended a run, marks on the curves, the table beside the line of time, `when` typed in the editor; wide, narrow, by keyboard. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { attempt, clean, closer, editorOf, figureOf, fingers, finish, judge, motus, open, place, same, saved, settled, singleFile, tableOf, told } from './help.mjs';

const ball = "y'' = -9.81\ny(0) = 1\ny'(0) = 0\nmethod verlet\nstep 0.125\nuntil 5\nwhen y = 0 falling as bounce: y' = -0.8 y', record\n";
const addressOf = (text, more = '') => `${singleFile}#v=1&m=${encodeURIComponent(text)}${more}`;
const file = join(place, 'ball.motus');
writeFileSync(file, ball);
const wanted = JSON.parse(motus('run', file, '--json'));
/** Points of the lines of this colour in a picture, line by line. */
const linesOf = (svg, colour) => [...svg.matchAll(/<path d="([^"]*)" stroke="([^"]*)"[^>]*>/g)].filter(([, , stroke]) => stroke.toLowerCase() === colour).flatMap(([, d]) => d.split('M').filter(Boolean).map((piece) => piece.split('L').map((pair) => pair.split(' ').map(Number))));
const VERLET = '#7a1fc2';

await attempt('a ball that bounces', async () => {
  const page = await open(addressOf(ball, "&q=y&q=y'&f=y&f=y'"));
  same('what ended it is told', await page.locator('.status .message').textContent(), 'Verlet: bounces accumulate at t = 4.06371276887158(4).');
  same('the clock ends where the motion does', await page.locator('.transport-now').textContent(), '4.064');
  const stage = (await saved(page, 'Motion', 'SVG')).bytes.toString('utf8');
  await page.keyboard.press('Escape');
  judge('rings on the curve where it bounced', [...stage.matchAll(new RegExp(`<circle [^>]*stroke="${VERLET}"`, 'gi'))].length >= 20);

  const divided = 'Events divide the steps of this motion: none can be opened.', step = page.locator('#open-step');
  await step.focus();
  same('no step is opened that events divide, and why is told to who comes there', await step.evaluate((b) => [document.activeElement === b, b.getAttribute('aria-disabled'), document.getElementById(b.getAttribute('aria-describedby')).textContent]), [true, 'true', divided]);
  await page.keyboard.press('Enter');
  same('… and shown to who presses it', [await page.locator('#toasts .toast span').allTextContents(), await page.locator('#opened').isVisible()], [[divided], false]);
  await closer(page, 'Events');
  const events = figureOf(page, 'Events');
  await page.waitForFunction(() => /±/.test(document.querySelector('.events-table')?.textContent ?? ''));
  same('the answer', await events.locator('.figure-answer').textContent(), 'By Verlet, bounce happens 135 times, first at t = 0.4515, last at t = 4.064; bounces accumulate at t = 4.06371276887158(4).');
  const rows = await events.locator('.events-table tbody tr').evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
  same('ten rows, how many more, three', rows.length, 14);
  same('what jumps comes first', await events.locator('.events-table thead th').allTextContents(), ['event', 't', 'y′', 't, with its error', 'count', 'y']);
  same('… name, count', [rows[0][0], rows[0][4], rows[9][4], rows[11][4], rows[13][4]], ['bounce', '1', '10', '133', '135']);
  same('… a time to six digits, and to as many as tell it from the one before', [rows[0][1], rows[1][1], rows[12][1], rows[13][1]], ['0.451524', '1.17396', '4.063712768871112', '4.063712768871206']);
  const [value, error] = rows[1][3].split('±').map((part) => Number(part.trim().replace(/×10⁻¹⁵/, 'e-15')));
  judge('… a time with its error, which covers the true one', Math.abs(value - 1.1739614665629003) <= error && error < 1e-14, rows[1][3]);
  same('… the state as it came and as it left', rows[0][2], '−4.42945 → 3.54356');
  await events.getByRole('button', { name: '… 122 more' }).click();
  same('all rows when asked', await events.locator('.events-table tbody tr').count(), 135);
  const { head, rows: numbers } = await tableOf(page, 'Events');
  same('the file has the columns of --events', head, ['method', 'event', 't', 'count', 'touched', 'y', "y'", 'y.after', "y'.after"]);
  judge('… and its numbers', numbers.length === wanted.events.length && numbers.every((row, k) => Number(row[2]) === wanted.events[k].time && Number(row[3]) === wanted.events[k].count), JSON.stringify(numbers[0]));

  await events.getByRole('button', { name: /Go to bounce at t = 1\.7519/ }).click();
  judge('a time in the table sets the clock', Math.abs(Number(await figureOf(page, 'Time').locator('.figure-moving').getAttribute('aria-valuenow')) - 1.751911727) < 1e-6 || await page.waitForFunction(() => Math.abs(Number(document.querySelector('#panels figure[data-title="Time"] .figure-moving')?.getAttribute('aria-valuenow')) - 1.751911727) < 1e-6).then(() => true, () => false));
  const slow = (await saved(page, 'Time', 'SVG')).bytes.toString('utf8'), pieces = linesOf(slow, VERLET).filter((piece) => piece.length > 1 && piece.length < 60 && Math.abs(piece[0][1] - piece[piece.length - 1][1]) > 3);
  // Of the strip of the velocity, which only falls: down is more pixels.
  const velocity = pieces.filter((piece) => piece.every(([, y], i) => i === 0 || y >= piece[i - 1][1] - 0.01));
  judge('a jump is two ends, not a slope: no line of the velocity goes up', velocity.length >= 8 && !linesOf(slow, VERLET).some((piece) => piece.length > 60 && piece.some(([x], i) => i > 0 && x < piece[i - 1][0])), `${velocity.length}`);
  const phase = linesOf((await saved(page, 'Phase', 'SVG')).bytes.toString('utf8'), VERLET).filter((piece) => piece.length > 1);
  judge('nor a line from speed to speed in the phase plane', phase.length > 20 && phase.every((piece) => piece.every(([, y], i) => i === 0 || y >= piece[i - 1][1] - 0.01)), String(phase.length));
  await clean('a ball that bounces', page);
});

await attempt('a row of balls', async () => {
  const page = await open(`${singleFile}#v=1&p=newtons-cradle&a=verlet&q=x[1]&q=energy&f=x[1]&f=x[1]'`), rings = async (title) => [...(await saved(page, title, 'SVG')).bytes.toString('utf8').matchAll(new RegExp(`<circle [^>]*stroke="${VERLET}"`, 'gi'))].length;
  await closer(page, 'Time');
  same('a curve has rings of the events that concern it: of those of its ball, and none where all stays as it was', [await rings('Time'), await rings('Phase')], [1, 1]);
  await clean('a row of balls', page);
});

await attempt('a section', async () => {
  const page = await open(`${singleFile}#v=1&p=henon-heiles`);
  await closer(page, 'Section');
  const section = figureOf(page, 'Section'), full = (motions) => page.waitForFunction((n) => new RegExp(`2.000 points up to t = \\d+${n}`).test(document.querySelector('#panels figure[data-title="Section"] .figure-answer')?.textContent ?? ''), motions);
  await page.waitForFunction(() => /\d+ points/.test(document.querySelector('#panels figure[data-title="Section"] .figure-answer')?.textContent ?? ''));
  await full('');
  const first = await tableOf(page, 'Section'), x = first.head.indexOf('x'), y = first.head.indexOf('y'), u = first.head.indexOf("x'"), v = first.head.indexOf("y'");
  const energy = (row) => { const [a, b, c, d] = [x, y, u, v].map((k) => Number(row[k])); return (c * c + d * d + a * a + b * b) / 2 + a * a * b - b ** 3 / 3; };
  judge('every point is on the section', first.rows.length === 2000 && first.rows.every((row) => Math.abs(Number(row[x])) < 1e-13 && Number(row[u]) > 0));
  const box = await section.locator('.figure-still').boundingBox();
  await page.mouse.click(box.x + 0.62 * box.width, box.y + 0.5 * box.height);
  await full(', and those of one more motion');
  const second = await tableOf(page, 'Section'), own = second.rows.filter((row) => row[0] === '2');
  judge('a click starts another motion, with the same energy', own.length === 2000 && own.every((row) => Math.abs(energy(row) - energy(first.rows[0])) < 1e-6), `${own.length} ${energy(own[0])} ${energy(first.rows[0])}`);
  const mine = new URLSearchParams(new URL(page.url()).hash.slice(1)).getAll('s').map((s) => s.split('='));
  judge('it is the motion of the page', mine.length === 4 && mine.every(([name]) => /\(0\)$/.test(name)), JSON.stringify(mine));
  judge('… at the place of the click, with the digits that pixels tell', mine.filter(([, value]) => /^-?[\d.]{1,6}$/.test(value)).length >= 2, JSON.stringify(mine));
  const from = mine.map(([, value]) => Number(value)), near = own.map((row) => Math.hypot(Number(row[y]) - from[2], Number(row[v]) - from[3]));
  judge('… and comes back to where it was started', Math.min(...near) < 0.02, String(Math.min(...near)));
  await page.mouse.click(box.x + 0.93 * box.width, box.y + 0.15 * box.height);
  await page.waitForFunction(() => /^No motion with this energy passes there\.$/.test(document.querySelector('.section-note')?.textContent ?? ''));
  await page.mouse.move(2, 2);
  await section.locator('.figure-moving').focus();
  for (const key of ['ArrowLeft', 'ArrowLeft', 'ArrowUp', 'Enter']) await page.keyboard.press(key);
  await full(', and those of 2 more motions');
  const address = page.url();
  await section.locator('.section-when').fill('x = 0 rissing');
  await section.locator('.section-when').press('Enter');
  await page.waitForFunction(() => /rissing/.test(document.querySelector('.section-note')?.textContent ?? ''));
  // What is no section says why, and shows none.
  for (const [text, why] of [['xyz', /no event “xyz”: xyz is not defined/], ['floor(x) = 0', /floor\(x\) = 0 never happens/], ['', /needs a condition/]]) {
    await section.locator('.section-when').fill(text);
    await section.locator('.section-when').press('Enter');
    const told = () => section.evaluate((figure) => `${figure.querySelector('.figure-answer').textContent} ${figure.querySelector('.section-note').textContent}`);
    for (let n = 0; n < 600 && !why.test(await told()); n++) await page.waitForTimeout(100);
    judge(`“${text}” is no section`, why.test(await told()) && !/ points up to|does not happen/.test(await told()), await told());
  }
  await section.locator('.section-when').fill('xyz');
  await section.locator('.section-when').press('Enter');
  await page.waitForFunction(() => /xyz is not defined/.test(document.querySelector('.section-note').textContent));
  const notes = await section.evaluate(async (figure) => {
    const note = figure.querySelector('.section-note'), [across] = figure.querySelectorAll('select'), seen = [];
    new MutationObserver(() => seen.push(note.textContent)).observe(note, { childList: true, characterData: true, subtree: true });
    across.value = [...across.options].find(({ value }) => value !== across.value).value;
    across.dispatchEvent(new Event('change', { bubbles: true }));
    await new Promise((done) => { setTimeout(done, 1000); });
    return [...seen, note.textContent];
  });
  judge('… and goes on saying so while the rest of the scene changes', notes.every((text) => /xyz is not defined/.test(text)), JSON.stringify(notes));
  await section.locator('.section-when').fill('y = 0');
  await section.locator('.section-when').press('Enter');
  await full('');
  await clean('a section', page);
  const again = await open(address);
  await closer(again, 'Section');
  await again.waitForFunction(() => /and those of 2 more motions/.test(document.querySelector('#panels figure[data-title="Section"] .figure-answer')?.textContent ?? ''));
  await clean('a section that was shared', again);
});

await attempt('typed', async () => {
  const page = await open(addressOf("y'' = -9.81\ny(0) = 1\ny'(0) = 0\nstep 0.125\nuntil 2\n"));
  const area = await editorOf(page);
  const type = async (text) => { await area.fill(text); await told(page); };
  await type(`${await area.inputValue()}when y = 0 faling: y' = -y'\n`);
  judge('what is wrong with a `when` is told at its word', /faling/.test(await page.locator('#editor, .editor').first().textContent()), await page.locator('#editor, .editor').first().textContent());
  await type((await area.inputValue()).replace('faling', 'falling as hit').replace("-y'", "-y', record"));
  await page.keyboard.press('Escape');
  await closer(page, 'Events');
  judge('the right one happens', /hit/.test(await figureOf(page, 'Events').locator('.figure-answer').textContent()), await figureOf(page, 'Events').locator('.figure-answer').textContent());
  judge('what no reference knows is not waited for', !await figureOf(page, 'Error').isVisible().catch(() => false));
  await clean('typed', page);
});

await attempt('on a phone', async () => {
  const page = await open(addressOf(ball), { width: 390, height: 844, theme: 'dark', touch: true });
  await closer(page, 'Events');
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  judge('nothing is wider than the page', wide <= 390, wide);
  const box = await figureOf(page, 'Events').locator('.events-table .figure-table').boundingBox();
  judge('the table scrolls in its own box', box && box.width <= 390, JSON.stringify(box));
  const first = figureOf(page, 'Events').locator('.events-table tbody tr:first-child'), [row, time] = await Promise.all(['th', 'button'].map((cell) => first.locator(cell).boundingBox()));
  const jump = await first.locator('td:nth-child(3)').evaluate((cell) => { const text = document.createRange(); text.selectNodeContents(cell); return text.getBoundingClientRect().right; });
  judge('what a bounce did is in sight', jump <= box.x + box.width, `${jump} ${JSON.stringify(box)}`);
  judge('a name stands beside its time', Math.abs(row.y + row.height / 2 - time.y - time.height / 2) < 1.5, JSON.stringify([row, time]));
  await page.goto(`${singleFile}#v=1&p=ueda`);
  await settled(page);
  await closer(page, 'Section');
  await page.waitForFunction(() => /points/.test(document.querySelector('#panels figure[data-title="Section"] .figure-answer')?.textContent ?? ''));
  judge('nor is the section', await page.evaluate(() => document.documentElement.scrollWidth) <= 390);
  await fingers('the section', page);
  await clean('on a phone', page);
});
await finish();
