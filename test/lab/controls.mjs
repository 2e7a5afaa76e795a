/* Every control does what it says: seen in the address, in the figures' summaries and in their numbers. */
import { attempt, clean, editorOf, example, fields, figureOf, closer, finish, judge, motus, open, same, settled, singleFile, summaryOf, numbersOf, tableOf, told, valuesOf } from './help.mjs';

const last = ({ head, rows }, column) => Number(rows.at(-1)[head.indexOf(column)]);
const press = (page, name) => page.getByRole('button', { name, exact: true }).click();
const shown = (page, selector) => page.locator(selector).evaluate((canvas) => canvas.toDataURL().length + ':' + canvas.toDataURL().slice(-4000));

let page = await open(singleFile + '#v=1&p=projectile');
await attempt('examples', async () => {
  await example(page, 'spring');
  same('Example: the title', await page.locator('#scene-title').textContent(), 'Mass on a spring');
  same('Example: the address', (await fields(page)).p, 'spring');
  await (await editorOf(page)).fill("x'' = -x\nx(0) = 1\nx'(0) = 0\nmethod verlet\nstep 0.1\nuntil 5\n");
  await settled(page);
  judge('a typed model: shown', (await summaryOf(page, 'Motion')).includes('from t = 0 to 5'));
  judge('a typed model: “Back to the example”', await page.getByText('Back to the example').isVisible());
  await page.getByText('Back to the example').click();
  await settled(page);
  judge('… brings the example back', (await page.locator('#model-text').inputValue()).includes('# ') && (await fields(page)).p === 'spring');
  await page.getByText('Bring it back').click();
  await settled(page);
  judge('… and “Bring it back” the reader’s own', (await page.locator('#model-text').inputValue()).startsWith("x'' = -x\n"));
});

await attempt('the model: undo, typeset, errors under the caret', async () => {
  const area = await editorOf(page);
  await area.focus();
  await page.keyboard.press('Control+End');
  await page.keyboard.type("# more");
  await page.keyboard.press('Control+z');
  judge('undo works', !(await area.inputValue()).includes('# more'));
  await area.fill("x'' = -k x^2/3\nk = 2\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 5\n");
  await settled(page);
  const mathml = await page.locator('.typeset math').first().innerHTML();
  judge('the equation is typeset: a fraction, a power', /mfrac|<mn>3/.test(mathml) && /msup/.test(mathml), mathml);
  await area.fill("g = 9.81\nL = 1\ntheta'' = -g/L sin(theta)\ntheta(0) = 1\ntheta'(0) = 0\nstep 0.01\nuntil 5\n");
  await settled(page);
  const printed = await page.locator('.typeset math').evaluateAll((all) => all.map((one) => one.innerHTML));
  judge('the pendulum as textbooks print it: a fraction before the sine', printed.some((one) => /<mfrac><mi>g<\/mi><mi>L<\/mi><\/mfrac>.*sin/.test(one)), printed.join(' | '));
  await area.fill("x'' = -k x^2/3\nk = 2\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 5\n");
  await settled(page);
  const before = await summaryOf(page, 'Motion'), picture = await shown(page, '#stage-figure canvas.stage-still');
  await area.fill("x'' = -k x^2/3 + foo\nk = 2\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 5\n");
  await told(page);
  const message = await page.locator('#model-problem').textContent();
  judge('an error: line, column and what is wrong', /Line 1, column 18: .*foo/.test(message), message);
  same('an error: aria-invalid', await area.getAttribute('aria-invalid'), 'true');
  same('an error: the mark stands under the word', await page.locator('.mirror mark').textContent(), 'foo');
  same('an error: the last picture stays', [await summaryOf(page, 'Motion'), await shown(page, '#stage-figure canvas.stage-still')], [before, picture]);
  await area.fill("x'' = -k x^2/3 + \nk = 2\n");
  await told(page);
  judge('another error: another message', (await page.locator('#model-problem').textContent()) !== message && await page.locator('#model-problem').isVisible());
  await area.fill("x'' = -k x\nk = 2\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 5\n");
  await settled(page);
  same('mended: no message, not invalid', [await page.locator('#model-problem').textContent(), await area.getAttribute('aria-invalid')], ['', 'false']);
});

await attempt('the model names its method', async () => {
  const area = await editorOf(page);
  const model = (method, start = 1) => `x'' = -x\nx(0) = ${start}\nx'(0) = 0\nmethod ${method}\nstep 0.1\nuntil 5\n`;
  const chosen = async () => (await fields(page)).a;
  for (const [written, name] of [['verlet', 'verlet'], ['rk4', 'rk4'], ['Euler', 'explicit-euler']]) {
    await area.fill(model(written));
    await settled(page);
    same(`method ${written}: it comes first`, (await chosen())?.split(',')[0], name);
  }
  const before = await chosen();
  await area.fill(model('rk'));
  await told(page);
  judge('no such method: told under the word', /Line 4, column 8: .*rk/.test(await page.locator('#model-problem').textContent()), await page.locator('#model-problem').textContent());
  same('… and not chosen', [await page.locator('.mirror mark').textContent(), await chosen()], ['rk', before]);
  await area.fill(model('rk4', 3));
  await settled(page);
  same('an initial value in the text moves its slider', await page.locator('#all-values').getByLabel('x(0), as a number', { exact: true }).inputValue(), '3');
});

await attempt('methods', async () => {
  await example(page, 'projectile');
  const toggle = (name) => page.locator(`.chip[data-method="${name}"]`);
  await toggle('rk4').click();
  await settled(page);
  same('a method is added', [(await fields(page)).a, await toggle('rk4').getAttribute('aria-pressed')], ['explicit-euler,symplectic-euler,midpoint,rk4', 'true']);
  judge('… in the numbers', (await numbersOf(page)).head.includes('r.y (rk4)'));
  await toggle('explicit-euler').click();
  await settled(page);
  judge('a method is taken away', (await fields(page)).a === 'symplectic-euler,midpoint,rk4' && !(await numbersOf(page)).head.includes('r.y (explicit-euler)'));
  await page.locator('.chip-more').click();
  await page.locator('#method-search').fill('order 4 symplectic');
  const found = await page.locator('.toggles .chip:visible[data-method]').evaluateAll((all) => all.map((t) => t.dataset.method));
  judge('search: order 4, symplectic', found.includes('forest-ruth') || found.some((name) => /pefrl|gauss4|yoshida/.test(name)), found.join());
  judge('search: says how many', /\d+ methods/.test(await page.locator('.methods .quiet[role=status]').textContent()));
  await page.locator('#method-search').fill('');
  const more = await page.locator('.toggles .chip:visible:not([aria-disabled="true"])').evaluateAll((all) => all.map((t) => t.dataset.method));
  for (const name of more.slice(0, 11)) await toggle(name).evaluate((chip) => chip.click());
  await settled(page);
  const chosen = (await fields(page)).a.split(',').length;
  judge('twelve methods at most, and it says so', chosen === 12 && /12 methods/.test(await page.locator('.methods .message').textContent()), `${chosen}: ${await page.locator('.methods .message').textContent()}`);
  const looks = await page.locator('.methods .chip[aria-pressed="true"] .picture').evaluateAll((all) => all.map((p) => p.innerHTML));
  same('each has a line and marker of its own', new Set(looks).size, looks.length);
  await example(page, 'damped-cubic');
  const refused = toggle('symplectic-euler');
  same('a refused method: cannot be chosen', await refused.getAttribute('aria-disabled'), 'true');
  judge('… and says why', (await refused.textContent()).includes('velocity'), await refused.textContent());
  const before = (await fields(page)).a;
  await refused.click({ force: true });
  same('… and a click changes nothing', (await fields(page)).a, before);
});

const openPage = async (page, hash) => { await page.goto(`${singleFile}#v=1&${hash}`); await settled(page); };
await attempt('tolerance', async () => {
  await openPage(page, 'p=kepler&a=velocity-verlet');
  const step = page.locator('.scale-step'), dial = page.locator('.scale-tolerance'), field = page.locator('#tolerance'), message = () => page.locator('#tolerance-message').textContent();
  same('steps of one size have a step alone', [await step.isVisible(), await dial.isVisible()], [true, false]);
  await openPage(page, 'p=kepler&a=velocity-verlet,dop853');
  same('with a method that chooses its own, both', [await step.isVisible(), await dial.isVisible()], [true, true]);
  await openPage(page, 'p=kepler&a=dop853');
  same('such methods alone have a tolerance in the step’s place', [await step.isVisible(), await dial.isVisible(), await field.inputValue()], [false, true, '1e-9']);
  const steps = async () => Number((await dial.locator('.steps').textContent()).replace(/\u2009/g, '').match(/(\d+) steps/)?.[1]), fine = await steps();
  await page.locator('#tolerance-slider').focus();
  await page.keyboard.press('ArrowLeft');
  await settled(page);
  same('an arrow goes to the power of ten before, also in the address', [await field.inputValue(), (await fields(page)).r, await page.locator('#tolerance-slider').getAttribute('aria-valuetext').then((text) => text.startsWith('1e-8, '))], ['1e-8', '1e-8', true]);
  judge('… and fewer steps are taken', await steps() < fine, `${await steps()} of ${fine}`);
  await page.keyboard.press('Control+z');
  await settled(page);
  same('undone', [await field.inputValue(), (await fields(page)).r], ['1e-9', undefined]);
  for (const [typed, words] of [['0', /above 0/], ['-1e-6', /above 0/], ['', /needed/], ['abc', /no number/]]) {
    await field.fill(typed);
    await settled(page, 150);
    judge(`a tolerance of “${typed}”: a message`, words.test(await message()) && await field.getAttribute('aria-invalid') === 'true', await message());
  }
  await field.fill('1e-5');
  await settled(page);
  const told = JSON.parse(motus('run', 'models/kepler.motus', '--method', 'dop853', '--tolerance', '1e-5', '--json'));
  same('as many steps as the program takes', await steps(), told.steps);
  same('… and as many refused', Number((await dial.locator('.steps').textContent()).match(/(\d+) refused/)?.[1] ?? 0), told.rejected);
});

await attempt('step and end', async () => {
  await example(page, 'projectile');
  const step = page.locator('#step'), until = page.locator('#until'), message = () => page.locator('#step-message').textContent();
  await step.fill('0.1');
  await settled(page);
  judge('a step', Math.abs(last(await numbersOf(page), 'r.y (explicit-euler)') + 30.645 - 1.4715) < 1e-12);
  same('… in the address', (await fields(page)).h, '0.1');
  await step.fill('0,2');
  await settled(page);
  judge('a decimal comma', Math.abs(last(await numbersOf(page), 'r.y (explicit-euler)') + 30.645 - 2.943) < 1e-12);
  same('… is a point in the address', (await fields(page)).h, '0.2');
  await step.fill('1/64');
  await settled(page);
  same('an expression', (await numbersOf(page)).rows.length, 193);
  const before = await summaryOf(page, 'Motion');
  for (const [typed, words] of [['0', /zero/], ['-0.1', /above 0/], ['', /needed/], ['1e-12', /10 million/], ['abc', /no number|unknown/i], ['1e400', /large|no number/], ['NaN', /no number/], ['inf', /no number/], ['0/0', /no number/], ['9'.repeat(300), /long|large/], ['((((((((((', /no number/]]) {
    await step.fill(typed);
    await settled(page, 150);
    judge(`a step of “${typed.slice(0, 12)}”: a message`, words.test(await message()) && await step.getAttribute('aria-invalid') === 'true', await message());
    same(`a step of “${typed.slice(0, 12)}”: the picture stays`, await summaryOf(page, 'Motion'), before);
  }
  await step.fill('1e9');
  await settled(page);
  judge('a huge step: one step, and a remark', /one step/.test(await message()) && (await numbersOf(page)).rows.length === 2, await message());
  await page.getByRole('button', { name: 'Step: back to the model’s' }).click();
  await settled(page);
  same('reset', [await step.inputValue(), (await fields(page)).h], ['0.05', undefined]);
  await page.locator('#step-slider').focus();
  await page.keyboard.press('ArrowRight');
  await settled(page);
  same('the slider of the step halves it', (await fields(page)).h, '0.025');
  await valuesOf(page);
  for (const [typed, end] of [['2', '2'], ['1.01', '1.01'], ['2 pi', String(2 * Math.PI)], ['-1', '-1']]) {
    await valuesOf(page);
    await until.fill(typed);
    await settled(page);
    same(`an end of ${typed}: the run ends there exactly`, (await numbersOf(page)).rows.at(-1)[0], end);
  }
  for (const typed of ['0', '', 'x', '1e300']) {
    await valuesOf(page);
    await until.fill(typed);
    await settled(page, 150);
    const said = await page.locator('#until-message').textContent() + await message();
    judge(`an end of “${typed}”: a message`, said.length > 10, said);
  }
  await valuesOf(page);
  await page.getByRole('button', { name: 'End: back to the model’s' }).click();
  await settled(page);
  same('reset of the end', (await fields(page)).T, undefined);
});

await attempt('parameters and initial values', async () => {
  await example(page, 'projectile-drag');
  await valuesOf(page);
  const rows = await page.locator('#all-values .row label').allTextContents();
  judge('a slider for each number', ['m', 'c'].every((name) => rows.includes(name)) && rows.some((name) => name.startsWith("r'(0)")), rows.join());
  const field = (name) => page.locator('#all-values').getByLabel(`${name}, as a number`, { exact: true });
  const before = await numbersOf(page);
  await valuesOf(page);
  await field('m').fill('2,5');
  await settled(page);
  same('a number with a comma', (await fields(page)).s, 'm=2.5');
  judge('mass matters: another motion', JSON.stringify(before.rows) !== JSON.stringify((await numbersOf(page)).rows));
  await valuesOf(page);
  await field('m').fill('2..5');
  await settled(page, 150);
  judge('no number: a message, the state stays', /number/.test(await page.locator('#all-values').textContent()) && (await fields(page)).s === 'm=2.5' && await field('m').getAttribute('aria-invalid') === 'true');
  await field('m').fill('2.5');
  await page.locator('#all-values').getByRole('button', { name: /^m: back to/ }).click();
  await settled(page);
  same('reset', (await fields(page)).s, undefined);
  const slider = page.locator('#all-values').getByLabel("r'(0).x", { exact: true });
  await slider.focus();
  await page.keyboard.press('ArrowRight');
  await settled(page);
  judge('a slider of an initial value', /^r'\(0\)=\(/.test((await fields(page)).s), (await fields(page)).s);
  await example(page, 'projectile');
  const first = await numbersOf(page);
  await valuesOf(page);
  await field('m').fill('7');
  await settled(page);
  same('without drag the mass cancels', (await numbersOf(page)).rows, first.rows);
  await valuesOf(page);
  await field('g.y').fill('-1.62');
  await settled(page);
  judge('gravity', Math.abs(last(await numbersOf(page), 'exact r.y') - (4.5 * 3 - 1.62 * 4.5)) < 1e-12);
});

await attempt('a slider is dragged', async () => {
  await example(page, 'damped-spring');
  await page.locator('#all-values input[type=range]').first().evaluate((slider) => new Promise((done) => {
    const from = slider.valueAsNumber, part = (Number(slider.max) - Number(slider.min)) / 100;
    let moves = 0;
    const move = () => {
      slider.value = String(from + ++moves * part);
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      if (moves < 20) requestAnimationFrame(move); else done();
    };
    move();
  }));
  await settled(page);
  const dragged = await numbersOf(page);
  await page.waitForTimeout(500);          // the address follows
  await page.reload();
  await settled(page);
  judge('in the end every step is kept', dragged.rows.length === 5001, dragged.rows.length);
  same('and it is the motion of what the slider says', dragged, await numbersOf(page));
});

await attempt('the pictures’ own controls', async () => {
  await example(page, 'projectile');
  const view = page.locator('#stage-view');
  await view.selectOption({ label: 'y against time' });
  await settled(page);
  judge('Motion: view', (await summaryOf(page, 'Motion')).startsWith('r.y against time') && (await fields(page)).w === 'time', await summaryOf(page, 'Motion'));
  await view.selectOption({ index: 0 });
  await settled(page);
  await closer(page, 'Time');
  const time = figureOf(page, 'Time');
  await time.locator('.figure-choice summary').click();
  await time.getByLabel('energy', { exact: true }).check();
  judge('Time: quantities', /energy/.test(JSON.stringify((await fields(page)).q)) && (await tableOf(page, 'Time')).head.some((h) => h.startsWith('energy')));
  await page.keyboard.press('Escape');
  await closer(page, 'Error');
  const position = (await tableOf(page, 'Error')).rows.at(-1).join();
  await figureOf(page, 'Error').getByLabel('Error of the').selectOption('v');
  judge('Error: of the velocity', position !== (await tableOf(page, 'Error')).rows.at(-1).join());
  await closer(page, 'Phase');
  await figureOf(page, 'Phase').getByLabel('Across').selectOption({ label: 'energy' });
  await settled(page);
  judge('Phase: another pair', (await summaryOf(page, 'Phase')).includes('against energy') && JSON.stringify((await fields(page)).f).includes('energy'), await summaryOf(page, 'Phase'));
  // The bar's links lead to the questions that are there.
  for (const link of await page.locator('.mini-links button').all()) {
    const title = await link.textContent();
    await link.click();
    await page.waitForFunction((name) => { const figure = document.querySelector(`figure[data-title="${name}"]`), { top } = figure.getBoundingClientRect(); return figure.contains(document.activeElement) && top > 60 && top < innerHeight; }, title);
    judge(`the link “${title}” leads to its question`, true);
  }
  same('… and to all of them', await page.locator('.mini-links button').allTextContents(), await page.locator('#panels > figure:not([hidden])').evaluateAll((figures) => figures.map((f) => f.dataset.title)));
  judge('open panels are none of the address', (await fields(page)).o === undefined);
  await settled(page, 600);
});

await attempt('a picture in space is turned', async () => {
  await example(page, 'charged-particle');
  await page.evaluate(() => scrollTo(0, 0));
  const canvas = page.locator('#stage-figure canvas.stage-still'), box = await canvas.boundingBox();
  const first = await shown(page, '#stage-figure canvas.stage-still');
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 80, box.y + box.height / 2 + 30, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(150);
  const dragged = await shown(page, '#stage-figure canvas.stage-still');
  judge('by the pointer', dragged !== first);
  await canvas.focus();
  await page.keyboard.press('ArrowLeft');
  await page.waitForTimeout(150);
  judge('by the keys', await shown(page, '#stage-figure canvas.stage-still') !== dragged);
});

await attempt('colours', async () => {
  const seen = [];
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const button = page.locator('#theme button');
  for (const theme of ['light', 'dark', undefined]) {
    await button.click();
    await page.waitForTimeout(100);
    same(`colours: ${theme ?? 'automatic'}`, await page.evaluate(() => document.documentElement.dataset.theme), theme);
    seen.push(await ground());
  }
  judge('light and dark differ; automatic is the system’s', seen[0] !== seen[1] && seen[2] === seen[0], seen.join());
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.waitForTimeout(200);
  same('… and follows it', await ground(), seen[1]);
  await page.emulateMedia({ colorScheme: 'light' });
});

await attempt('the links of the theory and of the notes', async () => {
  await example(page, 'projectile');
  await page.locator('#scene-note').getByRole('button', { name: 'the spring' }).click();
  await settled(page);
  same('the note leads to the spring', await page.locator('#scene-title').textContent(), 'Mass on a spring');
  await example(page, 'projectile');
  for (const link of await page.locator('#theory a, #theory button').all()) {
    const words = await link.textContent();
    await link.scrollIntoViewIfNeeded();
    await link.click();
    await settled(page);
    judge(`the theory's “${words}” leads somewhere`, await page.evaluate(() => location.protocol) === 'file:' && await page.locator('#scene-title').isVisible());
    await example(page, 'projectile');
  }
});
await clean('controls', page);

await attempt('back to where one began', async () => {
  page = await open(singleFile);
  const title = await page.locator('#scene-title').textContent();
  await example(page, 'spring');
  await page.waitForTimeout(600);          // the address follows
  await page.goBack();
  await settled(page);
  same('Back shows the first example again', await page.locator('#scene-title').textContent(), title);
  await clean('back', page);
});

// --- everything that can be pressed, in an order of its own: nothing breaks ----------------------------------------------------------
await attempt('everything pressed', async () => {
  page = await open(singleFile + '#v=1&p=kepler');
  await settled(page, 800);
  // Those that are there at the start and those that a press brings: twice round, each once.
  for (let round = 0; round < 2; round++) {
    await page.evaluate((own) => {
      window.pressed ??= new WeakSet();
      for (const control of document.querySelectorAll('button, summary, input[type=checkbox]')) {
        const name = control.getAttribute('aria-label') || control.textContent;
        if (window.pressed.has(control) || control.disabled || !control.checkVisibility() || new RegExp(own).test(name) || control.closest('.ask, .lesson')) continue;
        window.pressed.add(control);
        control.click();
      }
    }, '^Save|^(Gallery|Lessons|Leave|Back to the gallery)$');      // other places of the page have tests of their own
    await settled(page);
  }
  for (const select of await page.locator('figure select:visible').all()) {
    for (const value of await select.locator('option').evaluateAll((all) => all.map((o) => o.value))) {
      if (!await select.isVisible()) break;
      await select.selectOption(value);
    }
  }
  await settled(page, 500);
  judge('the page lives', await page.locator('#stage-figure figcaption').isVisible());
  await clean('everything pressed', page);
});
await finish();
