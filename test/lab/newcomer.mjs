/* A newcomer's way through the page, from the first visit to a link that is sent to somebody: the ball flies by itself, the step is dragged, the question of
 * the picture leads to its lesson, which answers; an equation of one's own swings, and its link brings the same numbers.
 *
 * Invariant: nothing here waits for a number of milliseconds; each step waits until the page shows what the step is about.
 */
import { attempt, clean, finish, judge, open, same, saved, settled, shareOf, singleFile, tableOf } from './help.mjs';

/** The texts of the picture, and how high each stands. */
async function drawn(page) {
  await settled(page);
  const svg = (await saved(page, 'Motion', 'SVG')).bytes.toString('utf8');
  await page.keyboard.press('Escape');
  const texts = [...svg.matchAll(/<text ([^>]*)>(.*?)<\/text>/g)].map(([, attributes, inside]) => ({ text: inside.replace(/<[^>]*>/g, '').replaceAll('\u2009', ' '), y: Number(/ y="([^"]*)"/.exec(attributes)?.[1]) }));
  const height = (name) => texts.find(({ text }) => text === name)?.y ?? NaN;
  return { words: texts.map(({ text }) => text), apart: height('symplectic Euler') - height('explicit Euler') };
}
const shows = (page, selector, pattern) => page.waitForFunction(([s, p]) => [...document.querySelectorAll(s)].some((e) => e.checkVisibility() && new RegExp(p).test(e.value ?? e.textContent)), [selector, pattern]);
const time = (page) => page.locator('.transport-now').textContent();

const page = await open(singleFile, { first: true, settle: false, height: 800 });
await attempt('the ball flies', async () => {
  await page.waitForFunction(() => { const t = Number(document.querySelector('.transport-now')?.textContent); return t > 0 && t < 1.9; });
  judge('the clock says that it runs', await page.locator('.transport-play').getAttribute('aria-label').then((label) => label.startsWith('Pause')));
  await page.waitForFunction(() => document.querySelector('.transport-now').textContent === '2.00' && document.querySelector('.transport-play').getAttribute('aria-label').startsWith('Play'));
  same('… and ends where it lands', await time(page), '2.00');
});

/** The step is taken by its ring and carried to the stop that says so much. */
async function drag(h) {
  const track = await page.locator('#step-slider').boundingBox(), y = track.y + track.height / 2;
  const [from, to] = await page.locator('#step-slider').evaluate((slider, wanted) => {
    const stops = [...document.querySelectorAll('.scale-step .stops span')], at = stops.findIndex((s) => s.textContent === wanted), ring = 20, { left, width } = slider.getBoundingClientRect();
    return [slider.valueAsNumber / Number(slider.max), at / (stops.length - 1)].map((part) => left + ring / 2 + part * (width - ring));
  }, h);
  await page.mouse.move(from, y);
  await page.mouse.down();
  await page.mouse.move((from + to) / 2, y, { steps: 4 });
  await page.mouse.move(to, y, { steps: 4 });
  await page.mouse.up();
  await shows(page, '#step', `^${h}$`);
}
await attempt('the step is dragged', async () => {
  const first = await drawn(page);
  judge('at first the Eulers miss by 1.96 m', first.words.includes('1.96 m too high') && first.words.includes('1.96 m too low'), first.words.join(' | '));
  await drag('0.1');
  const half = await drawn(page);
  judge('half the step: the Eulers come together', half.apart < first.apart - 20, `${half.apart}, ${first.apart} before`);
  judge('… and half the number stands in the bracket', half.words.includes('0.98 m too high') && half.words.includes('0.98 m too low'), half.words.join(' | '));
  await drag('0.4');
  const twice = await drawn(page);
  judge('twice the step: twice the number', twice.words.includes('3.92 m too high'), twice.words.join(' | '));
});

await attempt('the question of the picture', async () => {
  await page.getByRole('button', { name: 'Why do the two Eulers miss?' }).click();
  await shows(page, '.lesson h2', '^Too high, too low$');
  judge('lesson 2 has the scene as it tells of it', await page.waitForFunction(() => document.querySelector('#step').value === '0.2'));
  const guess = page.locator('.choice', { hasText: 'On the green ball' });
  await guess.click();
  judge('the answer is chosen', await guess.locator('input').isChecked());
  await page.getByRole('button', { name: 'Throw' }).click();
  await shows(page, '.answer', 'You said on the green ball\\. With ten steps it ends 1\\.96\\sm above\\.');
  await page.waitForFunction(() => document.querySelector('.transport-now').textContent === '2.00' && document.querySelector('.transport-play').getAttribute('aria-label').startsWith('Play'));
  const { words } = await drawn(page);
  judge('… and the picture shows it', words.includes('explicit Euler') && words.includes('1.96 m too high'), words.join(' | '));
  await page.getByRole('button', { name: 'Leave' }).click();
  await page.waitForFunction(() => !document.body.classList.contains('in-lesson'));
});

let address = '', numbers = null, told = '';
await attempt('an equation of one’s own', async () => {
  await page.locator('.pill').click();
  await page.locator('#model-text').focus();
  await page.keyboard.press('Control+a');
  await page.keyboard.type("theta'' = -sin(theta)\ntheta(0) = 2");
  await shows(page, '#stage-figure figcaption', 'theta against time');
  await settled(page);
  told = await page.locator('#stage-figure figcaption').textContent();
  judge('it swings', /theta against time, from t = 0 to 25\b/.test(told), told);
  same('the step that was dragged for the ball is not the swing’s', await page.locator('#step').inputValue(), '0.14');
  same('nothing is complained about', await page.locator('#model-problem').textContent(), '');
  judge('what was not given is said', await page.locator('.supposed li').first().textContent().then((line) => line.includes("theta'(0) = 0")));
  await page.locator('.transport-play').click();
  await page.waitForFunction(() => Number(document.querySelector('.transport-now').textContent) > 1);
  await page.keyboard.press('Escape');
  await page.locator('.transport-play').click();
  await page.waitForFunction(() => document.querySelector('.transport-play').getAttribute('aria-label').startsWith('Play'));
  same('an angle is not measured in metres, nor too high', [(await drawn(page)).words.filter((w) => / m$| m |too (high|low)/.test(w)), await page.locator('.transport-unit').textContent()], [[], '']);
  numbers = await tableOf(page, 'Motion');
  judge('its numbers are a swing about zero', numbers.rows.length > 60 && numbers.rows.some((row) => Number(row[2]) < -1.9), `${numbers.head.join()}: ${numbers.rows.length} rows`);
});

await attempt('a link', async () => {
  await shareOf(page);
  await shows(page, '.popup input', '#v=1');
  address = await page.getByLabel('The address holds the model, its numbers and the view').inputValue();
  judge('the link has the equation', decodeURIComponent(address).includes("theta'' = -sin(theta)"), address);
  await page.keyboard.press('Escape');
  await page.waitForFunction((wanted) => location.href === wanted, address);
  await page.reload();
  await settled(page);
  same('reload: the same numbers', await tableOf(page, 'Motion'), numbers);
  const other = await open(address);
  await shows(other, '#stage-figure figcaption', 'theta against time');
  same('somebody else: the same picture in words', await other.locator('#stage-figure figcaption').textContent(), told);
  same('… and the same numbers', await tableOf(other, 'Motion'), numbers);
  await clean('somebody else', other);
});
await clean('a newcomer', page);
await finish();
