/* Every lesson from its first word to its last, on a screen and on a phone: with the page's own controls on the screen, with the tasks' buttons on the phone.
 *
 * Invariant: what a lesson asks for can be done, and is then ticked off; the button that goes on is in sight at every moment; what a lesson says in numbers
 * stands on the page once its tasks are done.
 */
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { attempt, clean, finish, judge, open, root, same, saved, settled, singleFile } from './help.mjs';

const { buildSync } = createRequire(join(root, 'lab/package.json'))('esbuild'), folder = join(root, 'lab/words/en/lessons');
const reader = buildSync({ entryPoints: [join(root, 'lab/lessons/read.ts')], bundle: true, format: 'esm', write: false, target: 'es2022' }).outputFiles[0].contents;
const { readLessons } = await import('data:text/javascript;base64,' + Buffer.from(reader).toString('base64'));
const names = (path, ending) => readdirSync(join(root, path)).filter((name) => name.endsWith(ending)).map((name) => name.slice(0, -ending.length));
const methods = [...readFileSync(join(root, 'core/methods.c'), 'utf8').matchAll(/CARD\("([a-z0-9-]+)"/g)].map((match) => match[1]);
const lessons = readLessons(names('lab/words/en/lessons', '.txt').map((name) => ({ name: `${name}.txt`, text: readFileSync(join(folder, `${name}.txt`), 'utf8') })), { models: names('models', '.motus'), methods: ['exact', ...methods] });

/** Whether all of a control can be seen and pressed: nothing lies on its edges. */
const inSight = (page, selector, n = 0) => page.locator(selector).nth(n).evaluate((control) => {
  const { left, right, top, bottom } = control.getBoundingClientRect();
  return left >= 0 && right <= innerWidth && top >= 0 && bottom <= innerHeight && [top + 3, (top + bottom) / 2, bottom - 3].every((y) => control.contains(document.elementFromPoint((left + right) / 2, y)));
});
const plain = (text) => text.replaceAll('\u00a0', ' ').replaceAll('\u2009', ' ').replaceAll('\u202f', ' ');
const shown = async (page, selector) => (await page.locator(selector).allTextContents()).map(plain);
/** The table of the runs: step -> method -> what is written. */
const table = (page) => page.locator('.runs').evaluate((runs) => {
  const [, ...heads] = [...runs.tHead.rows[0].cells].map((cell) => cell.textContent);
  return Object.fromEntries([...runs.tBodies[0].rows].map((row) => [row.cells[0].textContent, Object.fromEntries(heads.map((head, k) => [head, row.cells[k + 1].textContent]))]));
});
const valueOf = (text) => Number(text.replace(/×10⁻(.)/, (_, power) => `e-${'⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(power)}`));
const toEnd = (page) => page.locator('#transport .transport-scrub').evaluate((line) => { line.value = line.max; line.dispatchEvent(new Event('input', { bubbles: true })); });
/** The letters of the picture. */
async function drawn(page) {
  await toEnd(page);
  await settled(page);
  const svg = (await saved(page, 'Motion', 'SVG')).bytes.toString('utf8');
  await page.keyboard.press('Escape');
  return plain([...svg.matchAll(/<text [^>]*>(.*?)<\/text>/g)].map(([, inside]) => inside.replace(/<[^>]*>/g, '')).join(' | '));
}

async function backToLesson(page) {
  await page.getByRole('button', { name: 'Back to the lesson' }).click();
  await page.waitForFunction(() => !document.body.classList.contains('in-step'));
}
/** By the dock's controls. */
async function byDock(page, condition) {
  switch (condition.kind) {
    case 'method': await page.locator(`#methods .chip[data-method="${condition.method}"]`).first().click(); return;
    case 'step':
      await page.locator('#step-slider').focus();
      for (let i = 0; i < 8; i++) {
        const now = Number(await page.locator('#step').inputValue());
        if (Math.abs(now - condition.value) < 1e-9) return;
        await page.keyboard.press(now > condition.value ? 'ArrowRight' : 'ArrowLeft');
        await settled(page, 100);
      }
      throw new Error(`the step’s slider has no stop at ${condition.value}; it is at ${await page.locator('#step').inputValue()}`);
    case 'until':
      await page.getByRole('button', { name: 'All values' }).click();
      await page.locator('#until').fill(String(condition.value));
      await page.keyboard.press('Escape');
      return;
    case 'set': await page.locator(`#dials [data-name="${condition.name} 0 field"]`).fill(condition.value); return;
    case 'opened': await page.locator('#open-step').click(); await backToLesson(page); return;
    case 'scene': await page.locator('.dial.switch:not(.accuracy-switch)').click(); return;
  }
}
async function byTask(page, condition, k) {
  await page.locator('.task').nth(k).scrollIntoViewIfNeeded();
  judge('a task’s button is in sight', await inSight(page, '.task', k), JSON.stringify(condition));
  await page.locator('.task').nth(k).tap();
  if (condition.kind === 'opened') await backToLesson(page);
}

/** What the page shows of a lesson's numbers once a task is done, by its number; -1: when the motion has been let go. */
const checks = {
  'straight-steps': async (page, k, name) => {
    if (k < 2 && await page.locator('.scale-step .steps').isVisible()) same(`${name}: as many pieces`, (await shown(page, '.scale-step .steps'))[0].replace(/\D/g, ''), ['10', '5', '160'][k + 1]);
  },
  'look-ahead': async (page, k, name) => {
    if (k !== 1) return;
    const said = await page.locator('#stage-figure figcaption').textContent();
    judge(`${name}: on green with five steps`, /(?:×10⁻¹[⁰¹²³⁴⁵⁶⁷⁸⁹]|\b0|on it) for midpoint/.test(said), said);
  },
  'energy': async (page, k, name) => {
    if (k === -1 && !page.phone) judge(`${name}: 4.9 times as wide`, /\b4\.9 times/.test(await drawn(page)), await drawn(page));
  },
  'blow-up': async (page, k, name) => {
    if (k !== 2 || page.phone) return;
    const [, wide] = /(\d\.\d)×10⁷ times/.exec(await drawn(page)) ?? [];
    judge(`${name}: about eighty million`, Math.round(Number(wide)) === 8, wide);
    same(`${name}: thirty steps`, (await shown(page, '.scale-step .steps'))[0].replace(/\D/g, ''), '30');
  },
};
/** Half the step makes so many times less; as the texts say of each order. */
function halves(rows, name, method, factor, from) {
  const steps = Object.keys(rows).map(Number).filter((h) => h <= from).sort((a, b) => b - a), off = steps.map((h) => valueOf(rows[h][method]));
  judge(`${name}: ${method}, ${steps.join(', ')}`, steps.length > 1 && off.every((value, i) => i === 0 || Math.abs(value / off[i - 1] / factor - 1) < 0.15), off.join());
}

async function walk(page, lesson, number, name) {
  const primary = '.lesson > .primary', { predict, attempt: { tasks, measured }, see } = lesson;
  await page.locator('.lesson h2', { hasText: lesson.title }).waitFor();
  await settled(page);
  same(`${name}: the reader is in the lesson`, await page.evaluate(() => document.activeElement.closest('.lesson') !== null), true);
  const right = predict.choices.findIndex((choice) => choice.right);
  for (let k = 0; k < predict.choices.length; k++) judge(`${name}: choice ${k} is in sight`, await inSight(page, '.choice', k));
  await page.locator('.choice').nth(right).click();
  judge(`${name}, Predict: the button is in sight`, await inSight(page, primary));
  await page.locator(primary).click();
  await page.locator('.answer').waitFor();
  same(`${name}: the answer`, await shown(page, '.answer'), [predict.choices[right].answer]);
  await settled(page);
  await checks[lesson.id]?.(page, -1, name);
  same(`${name}: nothing is done yet`, await page.locator('.tasks .done').count(), 0);
  for (const [k, { condition, label }] of tasks.entries()) {
    judge(`${name}, Try: the button is in sight`, await inSight(page, primary));
    await (page.phone ? byTask(page, condition, k) : byDock(page, condition));
    await page.waitForFunction((at) => document.querySelectorAll('.tasks li')[at]?.classList.contains('done'), k).then(() => judge(`${name}: “${label}” is ticked off`, true), () => judge(`${name}: “${label}” is ticked off`, false));
    await settled(page);
    await checks[lesson.id]?.(page, k, name);
  }
  same(`${name}: all is done`, await page.locator('.tasks .done').count(), tasks.length);
  await page.locator(primary).click();
  judge(`${name}, See: the button is in sight`, await inSight(page, primary));
  if (measured) {
    const rows = await table(page), cells = Object.values(rows).flatMap((row) => Object.values(row));
    for (const [, said] of [...see, predict.choices[right].answer].join(' ').matchAll(/(\d\.\d+) m\b/g)) judge(`${name}: ${said} m stands in the table`, cells.includes(said), cells.join());
    const steps = tasks.flatMap(({ condition }) => (condition.kind === 'step' ? [condition.value] : []));
    for (const step of [lesson.scene.step, ...steps]) judge(`${name}: a row for ${step}`, rows[step], Object.keys(rows).join());
    if (lesson.id === 'halve-the-step') {
      halves(rows, name, 'Verlet', 0.25, 0.1);
      halves(rows, name, 'symplectic Euler', 0.5, 0.1);
      halves(rows, name, 'explicit Euler', 0.5, 0.05);
    }
    if (lesson.id === 'verlets-trick') halves(rows, name, 'Verlet', 0.25, 0.1);
    if (lesson.id === 'too-high-too-low') { halves(rows, name, 'explicit Euler', 0.5, 0.2); halves(rows, name, 'symplectic Euler', 0.5, 0.2); }
    same(`${name}: nothing stands for a step on its way`, Object.keys(rows).length, new Set([Number(lesson.scene.step), ...steps]).size);
  }
  await page.locator(primary).click();
  await page.locator('.lesson h2', { hasText: lesson.why.title }).waitFor();
  judge(`${name}, Why: the button is in sight`, await inSight(page, primary));
  judge(`${name}: nothing scrolls sideways`, await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await page.locator(primary).click();
}

for (const [width, height, touch] of [[1280, 800, false], [390, 844, true]]) {
  await attempt(`all lessons, ${width} × ${height}`, async () => {
    const page = await open(singleFile, { width, height, touch });
    page.phone = touch;
    if (touch) await page.locator('#menu-button').click();
    await page.locator('[data-place=lessons]').focus();
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => document.activeElement?.closest('.lesson-list') !== null);
    judge('the list of lessons is in sight', await inSight(page, '.lesson-list button', lessons.length - 1));
    await page.keyboard.press('Enter');
    for (const [k, lesson] of lessons.entries()) await walk(page, lesson, k + 1, `${width} × ${height}, ${k + 1}`);
    await page.waitForFunction(() => document.body.classList.contains('in-gallery'));
    await clean(`all lessons, ${width} × ${height}`, page);
  });
}

await attempt('a lesson keeps to its numbers', async () => {
  const page = await open(`${singleFile}#v=1&p=thrown-ball&l=too-high-too-low.predict`, { height: 800 });
  await page.locator('#step').fill('0.05');
  await settled(page);
  await page.locator('.choice').first().click();
  await page.locator('.lesson > .primary').click();
  await page.locator('.answer').waitFor();
  await page.waitForFunction(() => document.querySelector('#step').value === '0.2');
  await page.waitForFunction(() => Number(document.querySelector('.transport-now').textContent) < 1.5);
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  await page.waitForFunction(() => document.querySelector('.transport-now').textContent === '2.00');
  await page.emulateMedia({ media: 'print' });
  same('paper: the lesson’s words, and no buttons', await page.evaluate(() => ['.lesson h1', '.answer', '.lesson-body > p', '.task', '.stage-still', '.parts', '.lesson > .primary', '#dock'].map((what) => document.querySelector(what).checkVisibility())), [true, true, true, true, true, false, false, false]);
  await page.emulateMedia({ media: null });
  // What is done stays done, whatever is looked at in between.
  await settled(page);
  same('what was done before the guess is not ticked off', await page.locator('.tasks .done').count(), 0);
  await page.locator('.task').nth(1).click();
  await page.waitForFunction(() => document.querySelectorAll('.tasks .done').length === 1);
  await settled(page);
  await page.locator('.task').nth(2).click();
  await page.waitForFunction(() => document.querySelectorAll('.tasks .done').length === 2);
  await page.locator('.parts button', { hasText: 'See' }).click();
  await page.locator('.parts button', { hasText: 'Try' }).click();
  same('… also after another part', await page.locator('.tasks .done').count(), 2);
  await page.getByRole('button', { name: 'Leave' }).click();
  judge('Leave: the focus is where the lesson was asked for', await page.evaluate(() => document.activeElement.matches('.ask-button, .pill')));
  await clean('a lesson keeps to its numbers', page);
});
await finish();
