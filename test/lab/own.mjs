/* One's own model: an equation and its start are enough to see a motion; what the page supposed stands in grey and can be taken, and taken back; a slip is
 * told after a pause, with its repair; names are offered; the lines are whole and numbered.
 */
import { join } from 'node:path';
import { attempt, built, clean, editorOf, finish, judge, open, same, settled, summaryOf, told } from './help.mjs';

const shot = (page, name) => page.locator('.own .editor').screenshot({ path: join(built, 'shots', `own-${name}.png`) });
const lines = (page) => page.locator('.supposed li').evaluateAll((all) => all.map((li) => [...li.querySelectorAll('span')].map((s) => s.textContent).join(' | ')));
const coloured = (page) => page.locator('.mirror span').evaluateAll((all) => all.map((s) => `${s.className}:${s.textContent}`).join(' '));
const start = "theta'' = -sin(theta)\ntheta(0) = 2";
const grey = ["theta'(0) = 0 | at rest, not given", 'step  0.14 | 60 to a swing', 'until 25 | three swings'];

const page = await open();
const area = page.locator('#model-text'), message = page.locator('#model-problem');
await editorOf(page);
const clear = async () => { await area.focus(); await page.keyboard.press('Control+a'); await page.keyboard.press('Delete'); };

await attempt('an equation and a start are enough', async () => {
  await clear();
  await page.keyboard.type("theta'' = -sin(theta)\ntheta(0) = 2");
  await told(page);
  same('what was supposed stands in grey, with its reason', await lines(page), grey);
  judge('… and there is a picture of it', /theta/.test(await summaryOf(page, 'Motion')), await summaryOf(page, 'Motion'));
  same('… and no message', await message.textContent(), '');
  same('words have their colours', await coloured(page), 'known:theta function:sin known:theta known:theta number:0 number:2');
  same('lines are numbered, grey ones are not', await page.locator('.numbers').textContent(), '1\n2\n');
  await shot(page, 'supposed');
});

await attempt('another equation begins at its end, as a scene does', async () => {
  const now = () => page.locator('.transport-now').textContent(), scrub = page.locator('.transport .transport-scrub');
  same('typed: at its end', await now(), '25.00');
  await scrub.evaluate((line) => { line.value = '1000'; line.dispatchEvent(new Event('input', { bubbles: true })); });
  same('… and moved from there', await now(), '2.50');
  await area.fill(start.replace('= 2', '= 1.9'));
  await settled(page);
  judge('another start: the time stays', Number(await now()) === 2.5, await now());
  await area.fill("x'' = -2 x\nx(0) = 1\nstep 0.1\nuntil 45");
  await settled(page);
  same('another equation: its end', await now(), '45.0');
  await area.fill(start);
  await told(page);
});

await attempt('taking, and taking back', async () => {
  await page.locator('#model-take').click();
  await told(page);
  same('“Write it into the text” takes all', await area.inputValue(), `${start}\ntheta'(0) = 0\nstep  0.14\nuntil 25`);
  same('… nothing is grey any more', await lines(page), []);
  await page.keyboard.press('Control+z');
  await told(page);
  same('… and it can be undone', await area.inputValue(), start);
  same('… back to grey', await lines(page), grey);
  await page.keyboard.press('Tab');
  await settled(page);
  same('Tab takes the next grey line', await area.inputValue(), `${start}\ntheta'(0) = 0`);
  same('… the others stay', await lines(page), grey.slice(1));
  await page.keyboard.press('Escape');
  await page.keyboard.press('Tab');
  judge('Escape, then Tab: the field is left', await page.evaluate(() => document.activeElement?.id !== 'model-text'));
  same('… and the text stays', await area.inputValue(), `${start}\ntheta'(0) = 0`);
  await page.locator('.supposed li').nth(1).click();
  await settled(page);
  judge('a click on a grey line takes it', (await area.inputValue()).endsWith('\nuntil 25'), await area.inputValue());
  await area.blur();
  await area.focus();
  await page.keyboard.press('Tab');
  judge('who only passes through is not held', await page.evaluate(() => document.activeElement?.id !== 'model-text'));
});

await attempt('a slip: told after a pause, mended by a press', async () => {
  await area.fill(start);
  await settled(page);
  const picture = await summaryOf(page, 'Motion');
  const boxes = () => page.evaluate(() => ['#dock', '.dials-more > *', '.scale-step', '#stage', '#scene-title', '.editor-field'].map((s) => { const { x, y, width, height } = document.querySelector(s).getBoundingClientRect(); return [x, y, width, height].join(); }));
  const before = await boxes();
  await area.fill(start.replace('(theta)', '(theat)'));
  await page.waitForTimeout(250);
  same('while one types nothing is said', await message.textContent(), '');
  await told(page);
  judge('an unknown name comes first, with what was meant', /^Line 1, column 16: theat is not defined\. Did you mean theta\?$/.test(await message.textContent()), await message.textContent());
  same('the mark stands under it', await page.locator('.mirror mark').textContent(), 'theat');
  same('the last picture stays', await summaryOf(page, 'Motion'), picture);
  same('the repairs', await page.locator('.mend button').allTextContents(), ['Replace by theta', 'Make it a slider']);
  await shot(page, 'slip');
  // What stands there of the last text is not told of this one; nothing moves.
  const seen = (what) => page.locator(what).evaluate((e) => [getComputedStyle(e).visibility, getComputedStyle(e).opacity, e.inert]);
  await page.waitForFunction(() => getComputedStyle(document.querySelector('.typeset')).opacity === '0');
  same('the equation of the last text is away, its sliders rest', [(await seen('.typeset'))[0], await seen('.scale-step'), await page.locator('.dials-more').evaluate((e) => e.inert), await seen('.dials-more > :first-child'), await page.locator('#all-values .sliders fieldset').evaluateAll((all) => all.every((f) => f.inert))],
    ['hidden', ['visible', '0.4', true], true, ['visible', '0.4', false], true]);
  same('… and it is told', await page.locator('#status .message').textContent(), 'The last motion that could be read, with its sliders.');
  same('… and nothing has moved', await boxes(), before);
  await page.locator('#stage-figure').screenshot({ path: join(built, 'shots', 'own-slip-stage.png') });
  await page.getByRole('button', { name: 'Make it a slider' }).click();
  await told(page);
  same('a slider: its line stands before the equation', await area.inputValue(), `theat = 1\n${start.replace('(theta)', '(theat)')}`);
  same('… and it is well', await message.textContent(), '');
  same('… the equation is its own again, and the sliders', [await page.locator('.typeset').isVisible(), await page.locator('.scale-step').evaluate((e) => e.inert), await page.locator('.dials-more').evaluate((e) => e.inert)], [true, false, false]);
  await page.keyboard.press('Control+z');
  await told(page);
  await page.getByRole('button', { name: 'Replace by theta' }).click();
  await page.waitForTimeout(250);
  same('replaced: gone at once', [await area.inputValue(), await message.textContent()], [start, '']);
  await area.fill("theta'' = -sin(theta)");
  await told(page);
  await page.getByRole('button', { name: 'Add theta(0) = 1' }).click();
  await told(page);
  same('a start is missing: a press adds it', [await area.inputValue(), await message.textContent()], ["theta'' = -sin(theta)\ntheta(0) = 1", '']);
});

await attempt('names are offered', async () => {
  await area.fill(start);
  await settled(page);
  await page.keyboard.press('Control+End');
  await page.keyboard.type('\nmethod vel');
  same('a method', await page.locator('#model-names li').allTextContents(), ['velocity-verlet']);
  await page.keyboard.press('Tab');
  judge('Tab takes it', (await area.inputValue()).endsWith('method velocity-verlet'), await area.inputValue());
  judge('… and the list closes', await page.locator('#model-names').isHidden());
  await page.keyboard.type('\nw = si');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowDown');
  same('arrows choose, and it is said which', await page.locator(`#${await area.getAttribute('aria-activedescendant')}`).textContent(), 'sinh(');
  await page.keyboard.press('Enter');
  judge('Enter takes what was chosen', (await area.inputValue()).endsWith('w = sinh('), await area.inputValue());
  await page.keyboard.type('th');
  await page.keyboard.press('Escape');
  judge('Escape closes', await page.locator('#model-names').isHidden());
  await page.keyboard.type('et');
  await page.keyboard.press('Enter');
  judge('Enter alone is a new line', (await area.inputValue()).endsWith('sinh(thet\n'), await area.inputValue());
});

await attempt('whole lines, as many as the model has, up to 20', async () => {
  const rows = () => area.evaluate((a) => { const line = parseFloat(getComputedStyle(a).lineHeight), edge = parseFloat(getComputedStyle(a).paddingTop); return (a.clientHeight - edge) / line; });
  for (const count of [8, 20, 40]) {
    await area.fill(`x'' = -x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 5${'\n# more'.repeat(count - 5)}`);
    await settled(page);
    same(`${count} lines`, await rows(), Math.min(20, count));
  }
  await area.evaluate((a) => { a.scrollTop = 1e6; });
  same('… and at the end of the text whole ones', await area.evaluate((a) => a.scrollTop % parseFloat(getComputedStyle(a).lineHeight)), 0);
  await area.fill(`x'' = -x ${'+ 0 x '.repeat(40)}\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 5\n# a\n# b`);
  await settled(page);
  same('… also above a scroll bar', await rows(), 7);
  const apart = await page.evaluate(() => {
    const [text, mirror] = ['#model-text', '.mirror'].map((s) => document.querySelector(s));
    text.scrollLeft = 150;
    text.dispatchEvent(new Event('scroll'));
    return [text.scrollLeft - mirror.scrollLeft, text.scrollHeight - text.clientHeight];
  });
  same('the mirror goes along', apart, [0, 0]);
  judge('and is as wide', await page.evaluate(() => document.querySelector('.mirror').scrollWidth >= document.querySelector('#model-text').scrollWidth));
});

await attempt('what another program has in store', async () => {
  await area.fill("r'' = (0, -9.81)\nr(0) = (0, 0)\nr'(0) = (3, 4)\ny'' = y^2\ny(0) = 1");
  await told(page);
  same('several dimensions: what falls lands before the other is infinite', await lines(page), ["y'(0) = 0 | at rest, not given", 'step  0.041 | 20 steps', 'until 0.815 | when r.y is at 0']);
  await area.fill("x[i]'' = -x[i] for i = 1..3\nx[i](0) = i for i = 1..3\nr'' = -r\nr(0) = (1, 2, 3)");
  await told(page);
  same('families and vectors', (await lines(page)).slice(0, 2), ["x[i]'(0) = 0 for i = 1..3 | at rest, not given", "r'(0) = (0, 0, 0) | at rest, not given"]);
  await page.locator('#model-take').click();
  await told(page);
  same('… can be read', [await message.textContent(), (await lines(page)).length], ['', 0]);
});
await clean('one’s own model', page);

for (const [name, options] of [['dark', { theme: 'dark' }], ['narrow', { width: 320, height: 640, touch: true }]]) {
  const other = await open(undefined, options);
  const field = await editorOf(other);
  same(`${name}: the editor opens at its top`, await other.evaluate(() => { const title = document.querySelector('#scene-title').getBoundingClientRect(), words = document.querySelector('#words').getBoundingClientRect(), area = document.querySelector('#model-text');
    return [area.scrollTop, area.selectionEnd, document.activeElement === area, title.top >= words.top && title.bottom <= words.bottom]; }), [0, 0, true, true]);
  await field.fill(start);
  await told(other);
  same(`${name}: the same lines`, await lines(other), grey);
  judge(`${name}: nothing is wider than the page`, await other.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await shot(other, name);
  await other.locator('#model-text').fill(start.replace('(theta)', '(theat)'));
  await told(other);
  await shot(other, `${name}-slip`);
  await clean(name, other);
}
await finish();
