/* Events on the page: the remark of what ended a run, marks on the curves, the table beside the line of time, `when` typed in the editor; wide, narrow, by keyboard. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { attempt, clean, closer, editorOf, figureOf, finish, judge, motus, open, place, same, saved, settled, singleFile, tableOf, told } from './help.mjs';

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
  same('what ended it is told', await page.locator('.status .message').textContent(), 'Verlet: bounces accumulate at t = 4.0637127688716(4)');
  same('the clock ends where the motion does', await page.locator('.transport-now').textContent(), '4.064');
  const stage = (await saved(page, 'Motion', 'SVG')).bytes.toString('utf8');
  await page.keyboard.press('Escape');
  judge('rings on the curve where it bounced', [...stage.matchAll(new RegExp(`<circle [^>]*stroke="${VERLET}"`, 'gi'))].length >= 20);

  await closer(page, 'Events');
  const events = figureOf(page, 'Events');
  await page.waitForFunction(() => /±/.test(document.querySelector('.events-table')?.textContent ?? ''), null, { timeout: 20000 });
  same('the answer', await events.locator('.figure-answer').textContent(), 'By Verlet, bounce 135 times, first at t = 0.4515, last at t = 4.064; bounces accumulate at t = 4.0637127688716(4).');
  const rows = await events.locator('.events-table tbody tr').evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
  same('ten rows, how many more, three', rows.length, 14);
  same('… name, count', [rows[0][0], rows[0][2], rows[9][2], rows[11][2], rows[13][2]], ['bounce', '1', '10', '133', '135']);
  const [value, error] = rows[1][1].split('±').map((part) => Number(part.trim().replace(/×10⁻¹⁵/, 'e-15')));
  judge('… a time with its error, which covers the true one', Math.abs(value - 1.1739614665629003) <= error && error < 1e-14, rows[1][1]);
  same('… the state as it came and as it left', rows[0][4], '−4.42945 → 3.54356');
  await events.getByRole('button', { name: '… 122 more' }).click();
  same('all rows when asked', await events.locator('.events-table tbody tr').count(), 135);
  const { head, rows: numbers } = await tableOf(page, 'Events');
  same('the file has the columns of --events', head, ['method', 'event', 't', 'count', 'touched', 'y', "y'", 'y.after', "y'.after"]);
  judge('… and its numbers', numbers.length === wanted.events.length && numbers.every((row, k) => Number(row[2]) === wanted.events[k].time && Number(row[3]) === wanted.events[k].count), JSON.stringify(numbers[0]));

  await events.getByRole('button', { name: /Go to bounce at t = 1\.7519/ }).click();
  judge('a time in the table sets the clock', Math.abs(Number(await figureOf(page, 'Time').locator('.figure-moving').getAttribute('aria-valuenow')) - 1.751911727) < 1e-6 || await page.waitForFunction(() => Math.abs(Number(document.querySelector('#panels figure[data-title="Time"] .figure-moving')?.getAttribute('aria-valuenow')) - 1.751911727) < 1e-6, null, { timeout: 3000 }).then(() => true, () => false));
  const slow = (await saved(page, 'Time', 'SVG')).bytes.toString('utf8'), pieces = linesOf(slow, VERLET).filter((piece) => piece.length > 1 && piece.length < 60 && Math.abs(piece[0][1] - piece[piece.length - 1][1]) > 3);
  // Of the strip of the velocity, which only falls: down is more pixels.
  const velocity = pieces.filter((piece) => piece.every(([, y], i) => i === 0 || y >= piece[i - 1][1] - 0.01));
  judge('a jump is two ends, not a slope: no line of the velocity goes up', velocity.length >= 8 && !linesOf(slow, VERLET).some((piece) => piece.length > 60 && piece.some(([x], i) => i > 0 && x < piece[i - 1][0])), `${velocity.length}`);
  const phase = linesOf((await saved(page, 'Phase', 'SVG')).bytes.toString('utf8'), VERLET).filter((piece) => piece.length > 1);
  judge('nor a line from speed to speed in the phase plane', phase.length > 20 && phase.every((piece) => piece.every(([, y], i) => i === 0 || y >= piece[i - 1][1] - 0.01)), String(phase.length));
  await clean('a ball that bounces', page);
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
  await clean('on a phone', page);
});
await finish();
