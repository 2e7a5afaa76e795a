/* The three studies of “Look closer”: what each answers of a motion, against the program's own numbers or a formula, and that the picture shows it.
 */
import { attempt, clean, closer, figureOf, finish, judge, motus, open, root, same, saved, settled, singleFile } from './help.mjs';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const THIN = '\u2009';
/** The answer of a question, once it has one; it may be a sentence without a picture. */
async function answerOf(page, title) {
  await closer(page);
  const figure = figureOf(page, title), sentence = figure.locator('.figure-answer');
  await figure.locator('h3').scrollIntoViewIfNeeded();
  await settled(page, 200);
  await page.waitForFunction((name) => {
    const f = document.querySelector(`figure[data-title="${name}"]`), a = f?.querySelector('.figure-answer'), press = f?.querySelector('.figure-controls .study:not([hidden]) button');
    // What takes long on a busy machine waits for its button.
    if (press && /^Measure/.test(press.textContent)) press.click();
    return f && (f.hidden || (a && !a.hidden && a.textContent.length > 10 && f.querySelector('.figure-message').hidden));
  }, title, { polling: 100 });
  return sentence.textContent();
}
const page1 = (model, methods) => open(`${singleFile}#v=1&p=${model}&a=${methods}`);
const study = (model, methods) => JSON.parse(motus('converge', `models/${model}.motus`, '--methods', methods, '--json'));
/** The program exits with 1 where a method does not show its order; what it says is the same. */
function anyStudy(model, methods) {
  try { return study(model, methods); } catch (error) { return JSON.parse(error.stdout); }
}
/** Evaluations at which the straight line through the program's points comes to this error. */
function cost({ points }, error) {
  const list = [...points].sort((a, b) => a.evaluations - b.evaluations);
  let k = list.length - 1;
  while (k >= 0 && list[k].error !== null && list[k].error <= error) k--;
  const [a, b] = [list[k], list[k + 1]];
  return a.evaluations * (b.evaluations / a.evaluations) ** (Math.log(a.error / error) / Math.log(a.error / b.error));
}
const digits = (value, n) => String(Number(value.toPrecision(n)));
/** Texts and thick lines of a picture, as its SVG file has them. */
async function drawn(page, title) {
  const svg = (await saved(page, title, 'SVG')).bytes.toString('utf8');
  return page.evaluate((text) => {
    const xml = new DOMParser().parseFromString(text, 'image/svg+xml');
    const bars = [...xml.querySelectorAll('[stroke-width="7"]')].map((e) => (e.getAttribute('d') ?? e.getAttribute('points')).match(/-?[\d.]+/g).map(Number)).map((n) => n[2] - n[0]);
    return { texts: [...xml.querySelectorAll('text')].map((t) => t.textContent), bars };
  }, svg);
}
const has = (texts, wanted) => texts.some((text) => text.replace(/\u2009/g, ' ') === wanted);

/** Where a motion is measured over a part of its run, the answer says up to when. */
const until = ({ reference }) => { const end = /; until (\S+), not /.exec(reference ?? '')?.[1]; return end ? `, up to t = ${digits(Number(end), 3)}` : ''; };

await attempt('spring', async () => {
  const methods = 'explicit-euler,symplectic-euler,midpoint,verlet,rk4', page = await page1('spring', methods), told = study('spring', methods);
  const slopes = Object.fromEntries(told.rows.map((row) => [row.method, row.observed]));
  judge('spring: the program measures 1, 1, 2, 2, 4', ['explicit-euler', 'symplectic-euler', 'midpoint', 'verlet', 'rk4'].every((name, k) => Math.abs(slopes[name] - [1, 1, 2, 2, 4][k]) < 0.1), JSON.stringify(slopes));
  same('spring: what half the step buys', await answerOf(page, 'Order'), 'At small steps: half the error for the Eulers, a quarter for midpoint (RK2) and Verlet, 1/16 for RK4.');
  const order = await drawn(page, 'Order');
  for (const text of ['explicit Euler: half', 'symplectic Euler: half', 'midpoint: a quarter', 'Verlet: a quarter', 'RK4: 1/16', 'here: 0.05 s', '0.05']) judge(`spring: the picture says “${text}”`, has(order.texts, text), order.texts.join(' | '));
  const numbers = await figureOf(page, 'Order').locator('.figure-summary').textContent();
  for (const row of told.rows) judge(`spring: the numbers have the slope of ${row.method}`, numbers.includes(`order ${row.declared} confirmed, slope ${row.observed.toFixed(2)}`), numbers);

  const costs = Object.fromEntries(told.rows.map((row) => [row.method, cost(row, 1e-3)])), times = (name) => digits(costs[name] / costs.rk4, 2);
  same('spring: what accuracy costs', await answerOf(page, 'Cost'), `For three digits, RK4 needs ${times('verlet')} times fewer evaluations than Verlet, ${times('midpoint')} times fewer than midpoint (RK2) and ${times('explicit-euler')} times fewer than explicit Euler${until(told)}.`);

  // ω = √(k/m) = 1: limits are steps in seconds. RK4: |R(iy)| ≤ 1 up to 2 √2.
  const rk4 = Math.sqrt(8);
  same('spring: how large the step may be', await answerOf(page, 'Stability'), `Below 2${THIN}s for symplectic Euler and Verlet, ${digits(rk4, 3)}${THIN}s for RK4; no step is small enough for explicit Euler, nor for midpoint (RK2), though it grows slowly.`);
  const card = JSON.parse(motus('methods', 'rk4', '--json')), limit = (card.methods ?? [card])[0].stability_limit ?? card.stability_limit;
  judge('spring: the catalogue has 2 √2 for RK4', Math.abs(limit - rk4) < 1e-9, limit);
  const { texts, bars } = await drawn(page, 'Stability');
  for (const text of ['explicit Euler: never', 'midpoint: never, though slowly', 'symplectic Euler: 2', 'Verlet: 2', 'RK4: 2.83', 'here: 0.05', 'step × frequency']) judge(`spring: the bars say “${text}”`, has(texts, text), texts.join(' | '));
  judge('spring: bars are as long as the limits', bars.length === 3 && Math.abs(bars[2] / bars[0] - rk4 / 2) < 0.01 && Math.abs(bars[1] - bars[0]) < 0.5, bars.join());
  // A step beyond a limit, and a stiffer spring: 2/ω with ω = 2.
  await page.locator('#step').fill('2.2');
  await settled(page, 400);
  judge('spring: a step of 2.2 is said to be too large', /^2\.2\u2009s is too large for symplectic Euler and Verlet: below 2\u2009s for symplectic Euler and Verlet,/.test(await answerOf(page, 'Stability')), await answerOf(page, 'Stability'));
  judge('spring: the line has moved', has((await drawn(page, 'Stability')).texts, 'here: 2.2'));
  await page.evaluate(() => { location.hash = '#v=1&p=spring&a=verlet&s=k=4'; });
  await settled(page, 600);
  await page.waitForFunction(() => /^Below 1\u2009s for Verlet\.$/.test(document.querySelector('figure[data-title="Stability"] .figure-answer')?.textContent ?? '')).catch(() => {});
  same('spring: four times as stiff, half the step', await answerOf(page, 'Stability'), `Below 1${THIN}s for Verlet.`);
  await clean('spring', page);
});

await attempt('thrown ball', async () => {
  const page = await page1('thrown-ball', 'explicit-euler,symplectic-euler,midpoint'), told = study('thrown-ball', 'explicit-euler,symplectic-euler,midpoint');
  same('thrown ball: the program finds midpoint exact', told.rows.map((row) => row.exact_here), [false, false, true]);
  same('thrown ball: a constant force is one sentence', await answerOf(page, 'Stability'), 'The force does not depend on the position: no step is too large.');
  const figure = figureOf(page, 'Stability');
  same('thrown ball: without a picture, without numbers', [await figure.locator('.figure-picture').isVisible(), await figure.locator('.figure-foot').isVisible(), await figure.locator('.figure-controls').locator('button').isVisible()], [false, false, false]);
  same('thrown ball: what half the step buys', await answerOf(page, 'Order'), 'At small steps: half the error for the Eulers; midpoint (RK2) is exact here.');
  const cheap = await answerOf(page, 'Cost');
  judge('thrown ball: both Eulers cost the same', Math.abs(cost(told.rows[0], 1e-3) / cost(told.rows[1], 1e-3) - 1) < 0.05 && /^For three digits, \w+ Euler needs about as many evaluations as \w+ Euler; midpoint \(RK2\) is exact at every step measured\.$/.test(cheap), cheap);
  // Nothing to pay: the question is not there.
  await page.evaluate(() => { location.hash = '#v=1&p=thrown-ball&a=midpoint'; });
  await settled(page, 800);
  same('thrown ball: midpoint alone', await answerOf(page, 'Order'), 'Nothing: midpoint (RK2) is exact here, at every step measured.');
  judge('thrown ball: with nothing to pay, cost is not asked for', await figureOf(page, 'Cost').isHidden());
  await clean('thrown ball', page);
});

await attempt('damped spring', async () => {
  const page = await page1('damped-spring', 'verlet,explicit-euler,rk4');
  // λ² + 2γλ + ω₀² = 0: explicit Euler is stable up to 2γ/ω₀², Verlet up to 2/ω₀ with any friction, RK4 where |R(hλ)| = 1.
  const [gamma, omega] = [0.1, 2], lambda = [-gamma, Math.sqrt(omega * omega - gamma * gamma)];
  const r = (h, order) => {
    let sum = [1, 0], term = [1, 0];
    for (let k = 1; k <= order; k++) { term = [(term[0] * lambda[0] - term[1] * lambda[1]) * h / k, (term[0] * lambda[1] + term[1] * lambda[0]) * h / k]; sum = [sum[0] + term[0], sum[1] + term[1]]; }
    return Math.hypot(...sum);
  };
  const largest = (order, low, high) => {
    for (let k = 0; k < 60; k++) { const middle = (low + high) / 2; if (r(middle, order) <= 1) low = middle; else high = middle; }
    return low;
  };
  same('damped spring: how large the step may be', await answerOf(page, 'Stability'), `Below ${digits(2 * gamma / omega ** 2, 3)} for explicit Euler, ${digits(2 / omega, 3)} for Verlet, ${digits(largest(4, 1, 2), 3)} for RK4.`);
  judge('damped spring: the line is at the step', has((await drawn(page, 'Stability')).texts, 'here: 0.01'));
  const figure = figureOf(page, 'Stability');
  await figure.getByRole('button', { name: 'The whole plane' }).click();
  await settled(page, 300);
  judge('damped spring: behind them the plane', has((await drawn(page, 'Stability')).texts, 'Re hλ') && await figure.getByRole('button', { name: 'The bars' }).getAttribute('aria-pressed') === 'true');
  same('damped spring: the answer stays', (await answerOf(page, 'Stability')).slice(0, 14), 'Below 0.05 for');
  same('damped spring: what half the step buys', await answerOf(page, 'Order'), 'At small steps: half the error for explicit Euler, a quarter for Verlet, 1/16 for RK4.');
  const told = study('damped-spring', 'verlet,explicit-euler,rk4'), costs = told.rows.map((row) => cost(row, 1e-3));
  same('damped spring: what accuracy costs', await answerOf(page, 'Cost'), `For three digits, RK4 needs ${digits(costs[0] / costs[2], 2)} times fewer evaluations than Verlet and ${digits(costs[1] / costs[2], 2)} times fewer than explicit Euler${until(told)}.`);
  // Midpoint's limit is 0.4 to the last digit. The step 0.4 is not beyond it; one that rounds to it is, and does not read like it.
  const own = largest(2, 0.1, 1);
  for (const [h, sentence] of [['0.4', 'Below 0.4 for midpoint (RK2).'], ['0.4003', '0.4003 is too large for midpoint (RK2): below 0.4 for midpoint (RK2).']]) {
    await page.evaluate((step) => { location.hash = `#v=1&p=damped-spring&a=midpoint&h=${step}`; }, h);
    await page.waitForFunction((text) => document.querySelector('figure[data-title="Stability"] .figure-answer')?.textContent === text, sentence).catch(() => {});
    judge(`damped spring: midpoint at its limit, the step ${h}`, Math.abs(own - 0.4) < 1e-9 && await answerOf(page, 'Stability') === sentence, `${own} ${await answerOf(page, 'Stability')}`);
  }
  await clean('damped spring', page);
});

await attempt('kepler', async () => {
  const page = await page1('kepler', 'symplectic-euler,velocity-verlet'), told = study('kepler', 'symplectic-euler,velocity-verlet');
  // At the nearest point, from where it starts, the swing across has ω = r^(-3/2), r = 0.4.
  const r = 0.4, fastest = r ** -1.5;
  const model = readFileSync(join(root, 'models/kepler.motus'), 'utf8');
  judge('kepler: it starts at a (1 - e)', /^r\(0\) +=\s*\(a \(1 - e\), 0\)/m.test(model) && /^a +=\s*1\b/m.test(model) && /^e +=\s*0\.6\b/m.test(model));
  same('kepler: how large the step may be, at its fastest', await answerOf(page, 'Stability'), `Where it is fastest, near t = 0, below ${digits(2 / fastest, 3)} for symplectic Euler and velocity Verlet.`);
  const summary = await figureOf(page, 'Stability').locator('.figure-summary').textContent();
  judge('kepler: the numbers say that this is no promise', summary.includes(`Its fastest frequency is ${digits(fastest, 4)}, near t = 0`) && /no promise for all between/.test(summary), summary);
  same('kepler: what half the step buys', await answerOf(page, 'Order'), 'At small steps: half the error for symplectic Euler, a quarter for velocity Verlet.');
  same('kepler: what accuracy costs', await answerOf(page, 'Cost'), `For three digits, velocity Verlet needs ${digits(cost(told.rows[0], 1e-3) / cost(told.rows[1], 1e-3), 2)} times fewer evaluations than symplectic Euler${until(told)}.`);
  await clean('kepler', page);
});

await attempt('chain', async () => {
  const page = await page1('chain', 'velocity-verlet');
  // The largest frequency at the start, where the springs are as long as then: the largest eigenvalue of -∂a/∂x, by powers.
  const N = 32, beta = 0.7, x = Array.from({ length: N + 2 }, (_, i) => (i === 0 || i > N ? 0 : Math.sin(Math.PI * i / (N + 1)))), k = Array.from({ length: N + 1 }, (_, i) => 1 + 3 * beta * (x[i + 1] - x[i]) ** 2);
  let u = Array.from({ length: N }, (_, i) => (i % 2 ? 1 : -1) * (1 + i / N)), largest = 0;
  for (let n = 0; n < 20000; n++) {
    const w = u.map((v, i) => (k[i] + k[i + 1]) * v - (i > 0 ? k[i] * u[i - 1] : 0) - (i < N - 1 ? k[i + 1] * u[i + 1] : 0));
    largest = Math.hypot(...w) / Math.hypot(...u);
    u = w.map((v) => v / Math.hypot(...w));
  }
  const said = await answerOf(page, 'Stability'), [, at, step] = /^Where it is fastest, near t = (\S+), below (\S+) for velocity Verlet\.$/.exec(said) ?? [];
  judge('chain: how large the step may be, at its fastest', step !== undefined && Number(step) <= 2 / Math.sqrt(largest) * 1.001 && Number(step) > 0.9 * 2 / Math.sqrt(largest), `${said}; at the start ${2 / Math.sqrt(largest)}`);
  if (at === '0') same('chain: that is two over the largest frequency', step, digits(2 / Math.sqrt(largest), 3));
  const told = study('chain', 'velocity-verlet'), answer = await answerOf(page, 'Cost');
  same('chain: one method’s own cost', answer, `For four digits, velocity Verlet needs ${digits(cost(told.rows[0], 1e-4), 2)} evaluations of the force up to t = ${digits(Number(/until (\S+), not/.exec(told.reference)[1]), 3)}.`);
  await clean('chain', page);
});

await attempt('an order that is not seen', async () => {
  const page = await page1('arenstorf', 'gauss8'), [row] = anyStudy('arenstorf', 'gauss8').rows;
  judge('arenstorf: the program does not confirm order 8', !row.passed && row.declared === 8 && row.observed > 7 && row.observed < 8, JSON.stringify(row.observed));
  same('arenstorf: says what was measured, and what the order says', await answerOf(page, 'Order'), `At small steps: 1/${digits(2 ** row.observed, 2)} of the error for Gauss 8, where its order says 1/256.`);
  // The slope had no room to settle, and denies no order.
  judge('arenstorf: the numbers say that this is not certified', row.uncertain && (await figureOf(page, 'Order').locator('.figure-summary').textContent()).includes(`: ${row.certificate}.`), row.certificate);
  same('arenstorf: an implicit method may take any step', (await answerOf(page, 'Stability')).replace(/near t = \S+,/, 'near t = …,'), 'At the moments of the run that were looked at, any step for Gauss 8.');
  await clean('arenstorf', page);
});

await attempt('a field', async () => {
  const page = await page1('charged-particle', 'explicit-euler,boris,rk4');
  // The velocity turns with ω = q B/m = 2: Runge–Kutta methods see λ = ±iω alone, Boris' rotation no rate.
  same('charged particle: Boris is not judged by a rate', await answerOf(page, 'Stability'), `Below ${digits(Math.sqrt(8) / 2, 3)} for RK4; no step is small enough for explicit Euler; for Boris no largest step can be given here.`);
  await page.evaluate(() => { location.hash = '#v=1&p=charged-particle&a=boris'; });
  await settled(page, 600);
  await page.waitForFunction(() => /rotation/.test(document.querySelector('figure[data-title="Stability"] .figure-answer')?.textContent ?? '')).catch(() => {});
  judge('charged particle: Boris alone is a sentence', /^Boris turns the velocity about the field by a rotation, which is stable at any step;/.test(await answerOf(page, 'Stability')) && await figureOf(page, 'Stability').locator('.figure-picture').isHidden());
  await clean('a field', page);
});

await attempt('a dear study', async () => {
  const page = await open(`${singleFile}#v=1&p=outer-solar-system&a=velocity-verlet`, { settle: false }), figure = figureOf(page, 'Order');
  // Its reference takes long as well: this does not wait until nothing is computed any more.
  await page.waitForFunction(() => window.lab.asked > 0);
  await page.locator('#looking > h2').evaluate((heading) => heading.scrollIntoView());
  await figure.waitFor();
  await figure.locator('h3').scrollIntoViewIfNeeded();
  const button = figure.locator('.figure-controls .study button');
  await page.waitForFunction(() => /^Measure, /.test(document.querySelector('figure[data-title="Order"] .study button')?.textContent ?? '') && !document.querySelector('figure[data-title="Order"] .study').hidden);
  judge('dear: the button says what it will take', /^Measure, (more than 2\u2009s|about \d+(\.\d)?\u2009s)$/.test(await button.textContent()), await button.textContent());
  await button.click();
  await page.waitForFunction(() => document.querySelector('figure[data-title="Order"] .study button')?.textContent === 'Cancel');
  await button.click();
  judge('dear: it can be called off', /^Measure, /.test(await button.textContent()) && await figure.locator('.figure-message').textContent() === 'Cancelled.');
  await clean('a dear study', page);
});
await attempt('methods that choose their steps', async () => {
  const page = await page1('kepler', 'dopri5,rk4&r=1e-6'), answer = await answerOf(page, 'Order'), title = 'Dormand–Prince 5(4)';
  judge('kepler: what a tenth of the tolerance buys', new RegExp(`^At small steps: 1/16 of the error for RK4; ${title.replace(/[()]/g, '\\$&')} chooses its steps, and a tenth of the tolerance leaves (a tenth|0\\.\\d+) of its error\\.$`).test(answer), answer);
  judge('… it is drawn at its mean steps', (await drawn(page, 'Order')).texts.some((t) => t.startsWith('Dormand–Prince 5')));
  const table = (await saved(page, 'Order', 'CSV')).bytes.toString('utf8').split('\n').filter((line) => line.startsWith(title));
  judge('… and its numbers are there, with the tolerances', table.length > 8 && table.some((line) => /,0?\.?0*1e-?0*6$|,0\.000001$/.test(line)), table.slice(0, 6).join(' '));
  judge('kepler: what it costs is compared', new RegExp(`${title.replace(/[()]/g, '\\$&')} needs .* times fewer evaluations than RK4`).test(await answerOf(page, 'Cost')), await answerOf(page, 'Cost'));
  await figureOf(page, 'Cost').getByText('Side by side at this step').click();
  await settled(page);
  const side = figureOf(page, 'Cost').locator('.compared tbody tr');
  await side.nth(1).waitFor();
  judge('… and side by side', (await side.allTextContents()).some((row) => row.includes(title) && /tolerance/.test(row)), (await side.allTextContents()).join(' | '));
  await clean('methods that choose their steps', page);
  const alone = await page1('spring', 'dop853&r=1e-8');
  judge('one alone', /^Dormand–Prince 8\(5, 3\) chooses its steps, and a tenth of the tolerance leaves \S+( tenth)? of its error\.$/.test(await answerOf(alone, 'Order')), await answerOf(alone, 'Order'));
  await clean('one alone', alone);
});
await finish();
