/* The accuracy of the answer as a control: the switch between it and step or tolerance, what is found for it, what is said where it cannot be reached; by address, undo, keys, on every
 * screen.
 *
 * Invariant: what is found is what the program finds, and what is said of it is what the program says.
 */
import { writeFileSync } from 'node:fs';
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { attempt, audit, clean, closer, fields, fingers, finish, judge, open, place, program, same, settled, shareOf, sideways, singleFile, told } from './help.mjs';

const spring = "x'' = -x\nx(0) = 1\nx'(0) = 0\nuntil 100\n", of = (text, more = '') => `${singleFile}#v=1&m=${encodeURIComponent(text)}${more}`;
const lorenz = "x' = 10 (y - x)\ny' = x (28 - z) - y\nz' = x y - 8 z/3\nx(0) = 1\ny(0) = 1\nz(0) = 1\nuntil 60\n";
const file = join(place, 'accuracy.motus');
const run = (text, ...more) => {
  writeFileSync(file, text);
  const { stdout } = spawnSync(program, ['run', file, '--json', ...more], { encoding: 'utf8' }), { stderr } = spawnSync(program, ['run', file, ...more], { encoding: 'utf8' });
  return { told: JSON.parse(stdout.split('\n')[0] || '{}'), stderr };
};
const dial = (page, id) => page.locator(`.scale-${id}`), turn = (page) => page.getByRole('switch', { name: 'Accuracy' });
/** The page's numbers as numbers: 1.1×10⁻¹¹, 10⁻¹¹, 1e-11. */
const number = (text) => Number(text.replace(/(?:([\d.]+)×)?10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/, (_, digits = '1', power) => `${digits}e${[...power].map((c) => (c === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c))).join('')}`));
/** What the dial tells: the tolerance that was found, and what was reached. */
async function found(page) {
  const text = await dial(page, 'accuracy').locator('.steps').textContent(), [, tolerance, how, reached] = /tolerance (\S+): (reached|only) (\S+)/.exec(text) ?? [text];
  return { tolerance: number(tolerance ?? ''), how, reached: number(reached ?? '') };
}
const shown = async (page) => ({ step: await dial(page, 'step').isVisible(), tolerance: await dial(page, 'tolerance').isVisible(), accuracy: await dial(page, 'accuracy').isVisible(), on: await turn(page).isChecked() });
const nearly = (a, b) => Math.abs(a / b - 1) < 0.06;

await attempt('an equation, initial values and an end', async () => {
  const page = await open(of(spring));
  same('it opens with the accuracy', await shown(page), { step: false, tolerance: false, accuracy: true, on: true });
  same('… of motus_run_def', await page.locator('#accuracy').inputValue(), '1e-9');
  const chip = page.locator('.chip[data-method="auto"]'), method = /auto: (.+)/.exec(await chip.textContent())?.[1], rows = JSON.parse(spawnSync(program, ['methods', '--json'], { encoding: 'utf8' }).stdout).methods, name = rows.find((m) => m.title === method)?.name;
  judge('which method was chosen', name !== undefined, method);
  judge('… and why', (await chip.getAttribute('title')).includes(`${method} needs the fewest operations`), await chip.getAttribute('title'));
  const { told: ours } = run(spring, '--method', name, '--accuracy', '1e-9'), here = await found(page);
  judge('with the tolerance that the program finds', nearly(here.tolerance, ours.tolerance), `${here.tolerance} ${ours.tolerance}`);
  judge('… which reaches what the program’s does', here.how === 'reached' && nearly(here.reached, ours.reached), `${here.reached} ${ours.reached}`);
  judge('it is said to those who hear', /^1e-9, .+, tolerance .+: reached /.test(await page.locator('#accuracy-slider').getAttribute('aria-valuetext')), await page.locator('#accuracy-slider').getAttribute('aria-valuetext'));
  const note = page.locator('.goal-note');
  await closer(page);
  judge('it is told in a sentence', (await note.textContent()).includes(method) && /fewest operations/.test(await note.textContent()), await note.textContent());
  await page.evaluate(() => scrollTo(0, 0));

  await shareOf(page);
  const command = (await page.locator('.popup textarea').evaluateAll((list) => list.map((e) => e.value))).find((text) => text.startsWith('motus ')) ?? '';
  judge('the command asks for the same', command.includes(`--method ${name} --accuracy 1e-9`), command.slice(0, 200));
  await page.keyboard.press('Escape');
  await page.locator('#accuracy').fill('1e-5');
  await settled(page);
  same('another accuracy stands in the address', (await fields(page)).g, '1e-5');
  const chipText = await chip.textContent(), now = rows.find((m) => m.title === /auto: (.+)/.exec(chipText)?.[1]).name, coarse = await found(page), { told: theirs } = run(spring, '--method', now, '--accuracy', '1e-5');
  judge('… and is searched for anew', nearly(coarse.tolerance, theirs.tolerance), `${coarse.tolerance} ${theirs.tolerance}`);
  const address = page.url();
  await page.keyboard.press('Escape');
  await page.getByRole('button', { name: 'Undo' }).click();
  await settled(page);
  same('undo takes it back', await page.locator('#accuracy').inputValue(), '1e-9');
  await page.goto('about:blank');
  await page.goto(address);
  await settled(page);
  same('the address brings it back', [await page.locator('#accuracy').inputValue(), (await found(page)).tolerance], ['1e-5', coarse.tolerance]);

  await turn(page).focus();
  await page.keyboard.press('Space');
  await settled(page);
  same('the switch, by a key: steps by a tolerance', await shown(page), { step: false, tolerance: true, accuracy: false, on: false });
  same('… which is the one that was found', Number(await page.locator('#tolerance').inputValue()), coarse.tolerance);
  same('… in the address', (await fields(page)).g, 'off');
  await page.keyboard.press('Space');
  await settled(page);
  same('and back', (await shown(page)).accuracy, true);
  for (const [typed, why] of [['0', 'above 0'], ['2', 'below 1'], ['1e-17', 'below 1'], ['x', 'number']]) {
    await page.locator('#accuracy').fill(typed);
    await told(page);
    judge(`${typed} is no accuracy`, (await page.locator('#accuracy-message').textContent()).includes(why), await page.locator('#accuracy-message').textContent());
  }
  await clean('an equation, initial values and an end', page);
});

await attempt('a model with a step', async () => {
  const page = await open(`${singleFile}#v=1&p=kepler&a=verlet`);
  same('it opens with its step', await shown(page), { step: true, tolerance: false, accuracy: false, on: false });
  await page.locator('.accuracy-switch').click();
  await settled(page);
  same('the switch adds the method that is found, the others stay', [await shown(page), await page.locator('.chip[aria-pressed="true"]').count()], [{ step: true, tolerance: false, accuracy: true, on: true }, 2]);
  same('… in the address', [(await fields(page)).g, (await fields(page)).a], ['1e-9', 'auto,verlet']);
  await page.locator('.accuracy-switch').click();
  await settled(page);
  same('it goes again', [await shown(page), (await fields(page)).a], [{ step: true, tolerance: false, accuracy: false, on: false }, 'verlet']);
  await clean('a model with a step', page);
});

await attempt('lines of the model', async () => {
  const page = await open(of(`${spring}accuracy 1e-6\nmethod dopri5\n`));
  const here = await found(page), { told: ours } = run(`${spring}accuracy 1e-6\nmethod dopri5\n`);
  same('accuracy and method are the model’s', [await page.locator('#accuracy').inputValue(), (await fields(page)).g], ['0.000001', undefined]);
  judge('… and what is found the program’s', nearly(here.tolerance, ours.tolerance) && nearly(here.reached, ours.reached), `${JSON.stringify(here)} ${ours.tolerance} ${ours.reached}`);
  await clean('lines of the model', page);
});

await attempt('what cannot be reached', async () => {
  const page = await open(of(lorenz, '&a=dop853&g=1e-9')), { stderr } = run(lorenz, '--method', 'dop853', '--accuracy', '1e-9'), said = /motus: (.*)/.exec(stderr)?.[1];
  judge('the program says that it cannot', /is not reached/.test(said ?? ''), stderr);
  const text = await page.locator('#status').textContent();
  // Its run has no bars of error, so it tells of the trials where the program tells of the run.
  judge('the page says the same, of the method', text.includes(said.split(':')[0]) && text.includes('Dormand–Prince'), `${text} | ${said}`);
  judge('… beside the number, too', /not reached/.test(await dial(page, 'accuracy').locator('.steps').textContent()), await dial(page, 'accuracy').locator('.steps').textContent());
  judge('the motion is there nevertheless', await page.locator('#stage-figure figcaption').textContent().then((t) => /\w/.test(t)));
  await clean('what cannot be reached', page);
});

for (const [width, height, theme, touch] of [[1280, 800, 'light', false], [1920, 1080, 'dark', false], [390, 844, 'dark', true], [320, 640, 'light', true]]) {
  await attempt(`${width} × ${height}`, async () => {
    const page = await open(`${singleFile}#v=1&p=kepler&a=auto,verlet&g=1e-9`, { width, height, theme, touch }), name = `${width} × ${height}, ${theme}`;
    await audit(name, page);
    same(`${name}: nothing stands out sideways`, await sideways(page), 0);
    if (touch) await fingers(name, page);
    const boxes = await page.locator('#dials > .dial:visible').evaluateAll((list) => list.map((e) => { const { left, right } = e.getBoundingClientRect(); return [left, right]; }));
    judge(`${name}: step, accuracy and switch stand beside each other`, boxes.length === 3 && boxes.every(([left, right], k) => right > left + 40 && (k === 0 || left >= boxes[k - 1][1] || left <= boxes[0][0] + 1)), JSON.stringify(boxes));
    await page.screenshot({ path: join('build/lab/shots', `accuracy-${width}.png`) });
    await clean(name, page);
  });
}
await finish();
