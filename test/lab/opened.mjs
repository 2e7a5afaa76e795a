/* One step, opened: four motions by the ten usual methods, whose calculations are read off the page, evaluated, and compared with the program; discs of picture and
 * recipe; ways in and out, Play, keys, phones; what cannot be opened says why.
 *
 * Invariant: figures are compared to the digits that stand there, never to hidden ones.
 */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { attempt, audit, built, clean, fields, fingers, finish, judge, motus, open, readCsv, same, settled, sideways, singleFile } from './help.mjs';

const usual = ['explicit-euler', 'symplectic-euler', 'midpoint', 'verlet', 'rk4', 'velocity-verlet', 'leapfrog', 'forest-ruth', 'implicit-midpoint', 'gauss4'];
/** The columns that stand there are of this step. */
const at = (page, step, methods) => page.waitForFunction(([n, list]) => {
  const columns = [...document.querySelectorAll('.opened-column')];
  return columns.map((c) => c.dataset.method).join() === list.join() && columns.every((c) => c.dataset.step === String(n) && (c.querySelector('.opened-picture svg') || !c.querySelector('.opened-why').hidden));
}, [step, methods]);

/** A column: its lines, each with its calculations as tokens of MathML, and the discs of the picture. */
const columnOf = (page, method) => page.locator(`.opened-column[data-method="${method}"]`).evaluate((column) => ({
  lines: [...column.querySelectorAll('.recipe > li')].map((li) => ({
    disc: li.querySelector('.disc').textContent, sentence: li.querySelector('.sentence').textContent,
    sums: [...li.querySelectorAll('.sum')].map((sum) => [...sum.querySelectorAll('mrow > *')].filter((e) => !e.closest('msub, msup') || e.localName === 'msub' || e.localName === 'msup').filter((e) => e.localName !== 'mrow').map((e) => ({ is: e.localName, text: e.textContent }))),
  })),
  discs: [...column.querySelectorAll('.opened-picture svg text')].map((t) => t.textContent).filter((t) => /^[1-9]$/.test(t)),
  closing: column.querySelector('.opened-closing').textContent.replaceAll('\u2060', ''),
}));
const written = (sum) => sum.map(({ text }) => text).join('');

/** A figure: its number, and half a unit of its last digit; figures of few digits are whole. */
function read(text) {
  const [, mantissa, power] = /^([−\d\u2009.½]+)(?:×10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?$/.exec(text) ?? [], digits = mantissa?.replaceAll('\u2009', '').replace('−', '-').replace('½', '0.5');
  if (!Number.isFinite(Number(digits))) throw new Error(`“${text}” is no figure`);
  const p = power ? Number([...power].map((c) => (c === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c))).join('')) : 0, decimals = digits.split('.')[1]?.length ?? 0, count = digits.replace(/^-?0?\.?0*|\./g, '').replace('-', '').length;
  return { value: Number(digits) * 10 ** p, off: count >= 3 || decimals >= 3 ? 0.5000001 * 10 ** (p - decimals) : 0 };
}
const both = (a, b, act) => Array.from({ length: Math.max(a.length, b.length) }, (_, k) => act(a[a.length === 1 ? 0 : k], b[b.length === 1 ? 0 : k]));
function evaluate(tokens, names) {
  let i = 0;
  const sign = (text) => tokens[i]?.is === 'mo' && tokens[i].text === text && ++i > 0;
  function one() {
    if (sign('(')) {
      const inside = total();
      if (sign(',')) inside.push(...total());
      if (!sign(')')) throw new Error(`a bracket is open in ${written(tokens)}`);
      return inside;
    }
    const { is, text } = tokens[i++];
    if (is === 'mn') return [read(text)];
    if (!names.has(text)) throw new Error(`${text} stands in no line above`);
    return names.get(text);
  }
  function product() {
    let left = one();
    for (;;) {
      if (sign('·')) left = both(left, one(), (a, b) => ({ value: a.value * b.value, off: Math.abs(a.value) * b.off + Math.abs(b.value) * a.off + a.off * b.off }));
      else if (sign('/')) left = both(left, one(), (a, b) => ({ value: a.value / b.value, off: a.off / Math.abs(b.value) }));
      else return left;
    }
  }
  function total() {
    let left = product();
    for (;;) {
      const way = sign('+') ? 1 : sign('−') ? -1 : 0;
      if (!way) return left;
      left = both(left, product(), (a, b) => ({ value: a.value + way * b.value, off: a.off + b.off }));
    }
  }
  const found = total();
  if (i !== tokens.length) throw new Error(`more than a calculation: ${written(tokens)}`);
  return found;
}
function sides(sum) {
  const out = [[]];
  for (const token of sum) if (token.is === 'mo' && token.text === '=') out.push([]); else out.at(-1).push(token);
  return out;
}

/** Rows of the program's own table. */
const table = (...words) => readCsv(motus('run', ...words, '--quiet', '-o', '-').replace(/^#.*\n/gm, ''));

// --- the figures ---------------------------------------------------------------------------------------------------------------------------
for (const preset of ['spring', 'thrown-ball', 'kepler', 'duffing']) {
  const plane = preset === 'thrown-ball' || preset === 'kepler', places = plane ? ['r.x', 'r.y'] : ['x'], speeds = plane ? ["r'.x", "r'.y"] : ["x'"];
  await attempt(preset, async () => {
    const { methods: known } = JSON.parse(motus('check', `models/${preset}.motus`, '--json')), admitted = usual.filter((name) => known.some((m) => m.name === name && m.admitted));
    judge(`${preset}: most of the usual methods can be opened`, admitted.length >= 8, admitted.join());
    const page = await open(`${singleFile}#v=1&p=${preset}&a=${admitted.slice(0, 2)}&l=step`, { height: 800, calm: true });
    for (let k = 0; k < admitted.length; k += 2) {
      const methods = admitted.slice(k, k + 2);
      if (k > 0) await page.evaluate((hash) => { location.hash = hash; }, `v=1&p=${preset}&a=${methods}&l=step`);
      await at(page, k > 0 ? 2 : 1, methods);
      if (k === 0) { await page.keyboard.press('ArrowRight'); await at(page, 2, methods); }
      await settled(page, 250);
      for (const method of methods) {
        const { lines, discs, closing } = await columnOf(page, method), what = `${preset} by ${method}`, names = new Map();
        judge(`${what}: at most four lines`, lines.length >= 1 && lines.length <= 4, lines.length);
        same(`${what}: discs of the picture are those of the lines`, [...discs].sort(), lines.map((l) => l.disc));
        same(`${what}: discs count`, lines.map((l) => l.disc), lines.map((_, i) => String(i + 1)));
        for (const line of lines) for (const sum of line.sums) {
          const parts = sides(sum), right = evaluate(parts.at(-1), names);
          if (parts[0].length === 1 && parts[0][0].is !== 'mn') names.set(parts[0][0].text, right);
          if (parts.length < 3 && !parts[0].some((t) => t.text === '·')) continue;
          const left = evaluate(parts.at(-2), names);
          judge(`${what}: ${written(sum)}`, left.every(({ value, off }, i) => Math.abs(value - right[i].value) <= off + right[i].off + 1e-12 * Math.abs(value)), left.map(({ value, off }) => `${value} ± ${off}`).join());
        }
        // The program's own row after two steps.
        const sum = lines.at(-1).sums.at(-1), [name] = sides(sum), right = sides(sum).at(-1).filter((t) => t.is === 'mn').map((t) => read(t.text)), of = written(name) === 'v' ? speeds : places;
        const [head, ...rows] = table(`models/${preset}.motus`, '--method', method, '--every', '1 steps', '--until', { spring: '0.2', 'thrown-ball': '1', kepler: 'pi/20', duffing: '0.02' }[preset]);
        const told = of.map((column) => Number(rows[2][head.indexOf(column)]));
        judge(`${what}: the last calculation is the program’s row`, right.length === told.length && right.every(({ value, off }, i) => Math.abs(value - told[i]) <= Math.max(off, 1e-12) + 1e-12 * Math.abs(told[i])), `${written(sum)}, ${told}`);
        // With the numbers, where their digits show the difference; else the difference alone.
        const since = method === 'verlet' ? 'through both places' : 'from here', known = ['spring', 'thrown-ball'].includes(preset), miss = '(on it|[\\d.×⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+(\u2009m)? (too (high|low)|off))\\.';
        const whole = new RegExp(`^${known ? `Exact ${since} is` : `Computed in small steps ${since} it is`} \\(?−?[\\d.]+.*: .+ is ${miss}`), alone = new RegExp(`^Against the ${known ? 'exact motion' : 'motion computed in small steps'} ${since}, .+ is ${miss}`);
        judge(`${what}: says how far off`, whole.test(closing) || alone.test(closing), closing);
      }
    }
    await clean(preset, page);
  });
}
await attempt('as on the picture', async () => {
  const page = await open(`${singleFile}#v=1&p=spring&a=midpoint,verlet,symplectic-euler&h=0.8&T=20&l=step`, { height: 800, calm: true });
  await at(page, 1, ['midpoint', 'verlet']);
  await settled(page);
  const { lines, closing } = await columnOf(page, 'midpoint');
  same('midpoint, the first step', lines.map((l) => [l.sentence, ...l.sums.map(written)]), [['Go half a step with the velocity you have.', 'x=1+0.4·0=1'], ['Read the velocity there.', 'v=0+0.4·(−1)=−0.4'], ['Start again, and go the whole step with it.', 'x=1+0.8·(−0.4)=0.680']]);
  same('… and how far off', closing, 'Exact is 0.697: midpoint is 0.017\u2009m too low. The velocity is now −0.8.');
  same('the head', [await page.locator('.opened-about').textContent(), await page.locator('.opened-step').textContent()], ['mass on a spring, h = 0.8\u2009s', 'step 1 of 25']);
  const tops = () => page.locator('.recipe > li, .opened-closing, .opened-picture, .opened-folds, .opened-foot').evaluateAll((all) => all.map((e) => Math.round(e.getBoundingClientRect().top)));
  await page.keyboard.press('ArrowRight');
  await at(page, 2, ['midpoint', 'verlet']);
  await settled(page);
  const second = await tops();
  for (let step = 3; step <= 6; step++) {
    await page.keyboard.press('ArrowRight');
    await at(page, step, ['midpoint', 'verlet']);
    await settled(page, 100);
    same(`step ${step}: nothing has moved`, await tops(), second);
  }
  // All digits, the card, a file.
  const column = page.locator('.opened-column[data-method="verlet"]');
  await column.locator('summary', { hasText: 'Every part' }).click();
  const trace = await column.locator('.parts-list').textContent(), row = table('models/spring.motus', '--method', 'verlet', '--step', '0.8', '--until', '20').find(([t]) => Math.abs(Number(t) - 4.8) < 1e-9);
  judge('every part, with all digits', row !== undefined && trace.includes(String(Number(row[1])).replace('-', '−')) && /Recurrence/.test(trace), `${row}: ${trace.slice(0, 400)}`);
  await column.locator('summary', { hasText: 'The formula' }).click();
  judge('the card of the method', /order 2/.test(await column.locator('.card').textContent()) && await column.locator('.card math').count() > 0);
  const [file] = await Promise.all([page.waitForEvent('download'), column.getByRole('button', { name: 'Save “One step by Verlet” as CSV' }).click()]);
  const [head, ...rows] = readCsv(readFileSync(await file.path(), 'utf8'));
  same('the parts as a file', [head.slice(0, 5), rows.map((r) => r[1])], [['part', 'what', 't', 'x', "x'"], ['start', 'step', 'end']]);
  await page.keyboard.press('Escape');
  await clean('as on the picture', page);
});

// --- ways in and out, Play, methods --------------------------------------------------------------------------------------------------------
await attempt('coming and going', async () => {
  const page = await open(`${singleFile}#v=1&p=thrown-ball`, { height: 800, calm: true }), here = () => page.evaluate(() => document.body.classList.contains('in-step') && !document.querySelector('#opened').hidden);
  const gone = () => page.waitForFunction(() => !document.body.classList.contains('in-step') && document.querySelector('#opened').hidden && document.querySelector('#stage').checkVisibility());
  await page.locator('#open-step').click();
  await at(page, 1, ['explicit-euler', 'symplectic-euler']);
  same('it has an address', (await fields(page)).l, 'step');
  await page.keyboard.press('Escape');
  await gone();
  same('Escape leaves: the clock is where it was, the focus where one left', [await page.locator('.transport-now').textContent(), await page.evaluate(() => document.activeElement.id)], ['2.00', 'open-step']);
  same('… and so is the address', (await fields(page)).l, undefined);
  await page.locator('#open-step').click();
  await at(page, 1, ['explicit-euler', 'symplectic-euler']);
  await page.waitForFunction(() => location.hash.includes('l=step'));
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  await at(page, 3, ['explicit-euler', 'symplectic-euler']);
  await page.getByRole('button', { name: 'Back to the motion' }).click();
  await gone();
  same('who went on finds the motion there', await page.locator('.transport-now').textContent(), '0.60');
  await page.waitForFunction(() => !location.hash.includes('l=step'));
  await page.goBack();
  await at(page, 3, ['explicit-euler', 'symplectic-euler']);
  judge('Back goes to it, at the step of the clock', await here());
  await page.goBack();
  await gone();
  // From a lesson and back to it.
  await page.goto('about:blank');
  await page.goto(`${singleFile}#v=1&p=thrown-ball&l=look-ahead.try.1`);
  await settled(page);
  same('the lesson’s task waits', await page.locator('.tasks li.done').count(), 0);
  await page.locator('.tasks button', { hasText: 'one step' }).click();
  await at(page, 1, ['explicit-euler', 'symplectic-euler']);
  await page.getByRole('button', { name: 'Back to the lesson' }).click();
  await gone();
  same('back in the lesson: the task is done', await page.locator('.tasks li.done').allTextContents(), ['Open one step done']);
  await clean('coming and going', page);
});
await attempt('Play, keys, methods', async () => {
  const page = await open(`${singleFile}#v=1&p=spring&a=midpoint,verlet,symplectic-euler,rk4&h=0.8&T=4&l=step`, { height: 800, calm: true });
  await at(page, 1, ['midpoint', 'verlet']);
  await settled(page);
  const line = (n) => page.waitForFunction((k) => [...document.querySelector('.opened-column .recipe').children].findIndex((li) => li.getAttribute('aria-current') === 'step') === k - 1, n, { polling: 20 });
  const began = Date.now();
  await page.keyboard.press('Space');
  await line(1);
  const first = Date.now();
  judge('Play begins at once with line 1', first - began < 900, first - began);
  const discs = () => page.locator('.opened-column').first().locator('.opened-picture svg text').allTextContents().then((texts) => texts.filter((t) => /^[1-9]$/.test(t)));
  same('… of which alone the picture has the disc', await discs(), ['1']);
  await line(2);
  judge('a line takes 1.2 s', Date.now() - first > 900, Date.now() - first);
  await line(3);
  await at(page, 2, ['midpoint', 'verlet']);
  await line(1);
  judge('then on: the next step, from its line 1', true);
  same('Play says that it pauses', await page.locator('.opened-play').getAttribute('aria-label'), 'Pause (space)');
  await page.keyboard.press('Space');
  await page.keyboard.press('ArrowDown');
  await line(2);
  await page.keyboard.press('ArrowUp');
  await line(1);
  await page.keyboard.press('End');
  await at(page, 5, ['midpoint', 'verlet']);
  await line(0);
  same('End: the last step, of which all is shown', [await discs(), await page.locator('.opened-nav button').last().isDisabled()], [['1', '2', '3'], true]);
  await page.keyboard.press('Home');
  await at(page, 1, ['midpoint', 'verlet']);
  const scrub = page.locator('.opened-foot input[type=range]');
  same('the time line', [await scrub.getAttribute('max'), await scrub.getAttribute('aria-valuetext'), await page.locator('.opened-foot .transport-ticks i').count()], ['5', 'step 1 of 5, from 0.0\u2009s to 0.8\u2009s', 5]);
  await scrub.fill('3');
  await at(page, 3, ['midpoint', 'verlet']);
  await scrub.focus();
  await page.keyboard.press('Space');
  await line(1);
  same('Space on the time line is this place’s, not the motion’s', await page.locator('.transport-play').getAttribute('aria-label').then((l) => l.startsWith('Play')), true);
  await page.keyboard.press('Space');
  const chip = (name) => page.locator(`.opened-foot .chip[data-opened="${name}"]`);
  await chip('rk4').click();
  await at(page, 3, ['verlet', 'rk4']);
  same('a method gets a column, and the first gives its own', (await fields(page)).a, 'verlet,rk4,midpoint,symplectic-euler');
  await chip('verlet').click();
  await at(page, 3, ['rk4']);
  await chip('rk4').click();
  same('the last one stays', await page.locator('.opened-column').count(), 1);
  same('the main method is the first column’s', (await fields(page)).a.split(',')[0], 'rk4');
  await clean('Play, keys, methods', page);
});

// --- what is looked at ---------------------------------------------------------------------------------------------------------------------
await attempt('what is looked at', async () => {
  const page = await open(`${singleFile}#v=1&p=thrown-ball&l=step`, { height: 800, calm: true });
  await at(page, 1, ['explicit-euler', 'symplectic-euler']);
  same('a path: both numbers, or one', await page.locator('.opened-choice option').allTextContents(), ['x and y', 'x', 'y']);
  await page.locator('.opened-choice').selectOption({ label: 'y' });
  await settled(page);
  same('one number against time', (await columnOf(page, 'explicit-euler')).lines.map((l) => l.sums.map(written).join()), ['ry=1.7+0.2·10=3.700', 'v=10+0.2·(−9.81)=8.038']);
  await page.evaluate((hash) => { location.hash = hash; }, 'v=1&p=double-pendulum&l=step');
  await at(page, 1, ['gauss6', 'rk4']);
  same('an angle, where the stage shows places that follow from angles', (await columnOf(page, 'rk4')).lines.at(-1).sums.at(-1)[0].text, 'θ1');
  await clean('what is looked at', page);
});

// --- what is out of the ordinary -----------------------------------------------------------------------------------------------------------
await attempt('what was refused', async () => {
  const page = await open(`${singleFile}#v=1&p=driven-oscillator&a=dop853&r=1e-6&l=step`);
  await at(page, 1, ['dop853']);
  const lines = await page.locator('.opened-tried li').allTextContents(), tried = lines.slice(0, -1).map((line) => /^Tried a step of ([\d.]+): the estimated error is ([\d.]+) times/.exec(line)?.slice(1).map(Number)), [size, share] = /^Taken: a step of ([\d.]+), with an estimated error of ([\d.]+) of/.exec(lines.at(-1))?.slice(1).map(Number) ?? [];
  judge('a step was tried and refused, another taken', tried.length > 0 && tried.every((t) => t && t[1] > 1) && share <= 1, lines.join(' | '));
  // The next size follows from the error: 0.9 times its root by the order of the estimate and one more.
  tried.forEach(([h, error], k) => { const next = tried[k + 1]?.[0] ?? size; judge('… its error says how long the next one is', Math.abs(0.75 * h * error ** (-1 / 8) / next - 1) < 0.02, `${h} ${error} ${next}`); });
  same('it is in the picture', await page.locator('.opened-picture svg text').evaluateAll((all) => all.filter((t) => t.textContent === 'refused').length), tried.length);
  // The same steps as the program takes.
  const total = Number((await page.locator('.opened-step').textContent()).match(/of ([\d\u2009]+)/)?.[1].replace(/\u2009/g, ''));
  same('as many steps as the program takes', total, JSON.parse(motus('run', 'models/driven-oscillator.motus', '--method', 'dop853', '--tolerance', '1e-6', '--json')).steps);
  await page.keyboard.press('ArrowRight');
  await at(page, 2, ['dop853']);
  judge('the next step begins where this one ended', Math.abs(Number(/start, ([\d.]+)/.exec(await page.locator('.opened-picture svg').textContent())?.[1]) - size) < 0.001 + 0.001 * size);
  await clean('refused steps', page);
});

await attempt('out of the ordinary', async () => {
  const own = (text, more = '') => `${singleFile}#v=1&m=${encodeURIComponent(text)}${more}&l=step`;
  const first = await open(own("s' = -s\nu' = s - u\ns(0) = 1\nu(0) = 0\nstep 0.1\nuntil 2\n", '&a=midpoint,rk4'), { height: 800, calm: true });
  await at(first, 1, ['midpoint', 'rk4']);
  await settled(first);
  const { lines, closing } = await columnOf(first, 'midpoint');
  same('first order: no velocity is spoken of', lines.map((l) => [l.sentence, ...l.sums.map(written)]), [['Go half a step with the rate of change you have.', 's=1+0.05·(−1)=0.95'], ['Read the rate of change there.', 's′=−0.95'], ['Start again, and go the whole step with it.', 's=1+0.1·(−0.95)=0.9050']]);
  judge('… and how far off', /^Computed in small steps it is 0\.90484: midpoint is 1\.6×10⁻⁴ too large\.$/.test(closing), closing);
  await clean('first order', first);

  const back = await open(`${singleFile}#v=1&p=spring&a=verlet,midpoint&h=0.5&T=-4&l=step`, { height: 800, calm: true });
  await at(back, 1, ['verlet', 'midpoint']);
  await settled(back);
  same('time runs backward', (await columnOf(back, 'midpoint')).lines[1].sums.map(written), ['v=0−0.25·(−1)=0.25']);
  await back.keyboard.press('End');
  await at(back, 8, ['verlet', 'midpoint']);
  judge('… to its end', /from −3\.50\u2009s to −4\.00\u2009s$/.test(await back.locator('.opened-foot input').getAttribute('aria-valuetext')), await back.locator('.opened-foot input').getAttribute('aria-valuetext'));
  await clean('backward', back);

  const blown = await open(own("x'' = x^3\nx(0) = 2\nx'(0) = 2\nstep 0.1\nuntil 5\n", '&a=midpoint,verlet'), { height: 800, calm: true });
  await at(blown, 1, ['midpoint', 'verlet']);
  await blown.keyboard.press('End');
  await blown.waitForFunction(() => [...document.querySelectorAll('.opened-why')].every((p) => !p.hidden && p.textContent.length > 30));
  judge('a run that ended early says so', /^No step by .+ can be opened here: .*x/.test(await blown.locator('.opened-why').first().textContent()), await blown.locator('.opened-why').first().textContent());
  await blown.keyboard.press('Home');
  await at(blown, 1, ['midpoint', 'verlet']);
  same('… and its first step is still there', (await columnOf(blown, 'midpoint')).lines.length, 3);
  await clean('blown', blown);

  const wrong = await open(own("x'' = -foo x\nx(0) = 1\n"), { height: 800, calm: true, settle: false });
  await wrong.waitForFunction(() => /cannot be computed/.test(document.querySelector('#opened .message')?.textContent ?? ''));
  judge('an equation with an error: a sentence, and no column', await wrong.locator('.opened-column').count() === 0);
  await wrong.keyboard.press('Escape');
  await wrong.waitForFunction(() => document.querySelector('#stage').checkVisibility());
  await clean('wrong', wrong);
});

// --- for everyone --------------------------------------------------------------------------------------------------------------------------
for (const [width, height, touch] of [[1280, 800, false], [390, 844, true], [1920, 1080, false]]) {
  await attempt(`${width} px`, async () => {
    const page = await open(`${singleFile}#v=1&p=spring&a=midpoint,verlet,symplectic-euler&h=0.8&T=20&l=step`, { width, height, touch, calm: true });
    const shown = ['midpoint', 'verlet', 'symplectic-euler'].slice(0, width < 900 ? 1 : width < 1600 ? 2 : 3);
    await at(page, 1, shown);
    await settled(page);
    same(`${width} px: nothing scrolls sideways`, await sideways(page), 0);
    for (const theme of ['light', 'dark']) {
      await page.emulateMedia({ colorScheme: theme });
      await page.waitForTimeout(100);
      await page.screenshot({ path: join(built, 'shots', `opened-${width}-${theme}.png`) });
      await audit(`${width} px, ${theme}`, page);
    }
    if (touch) {
      await fingers(`${width} px`, page);
      const swipe = (by) => page.locator('.opened-picture').evaluate((picture, dx) => {
        const { left, top, width: w, height: h } = picture.getBoundingClientRect(), x = left + w / 2, y = top + h / 2;
        for (const [type, at_] of [['pointerdown', x], ['pointerup', x + dx]]) picture.dispatchEvent(new PointerEvent(type, { bubbles: true, pointerType: 'touch', isPrimary: true, clientX: at_, clientY: y }));
      }, by);
      await swipe(-120);
      await at(page, 1, ['verlet']);
      await swipe(120);
      await at(page, 1, ['midpoint']);
      await swipe(-20);
      await page.locator('.opened-foot .chip', { hasText: 'symplectic Euler' }).tap();
      await at(page, 1, ['symplectic-euler']);
      judge('a phone: chips and swipes choose the method', true);
      await page.locator('.opened-play').tap();
      await page.waitForFunction(() => document.querySelector('.recipe > [aria-current=step]'));
      for (const summary of await page.locator('#opened summary').all()) await summary.tap();
      await page.evaluate(() => document.querySelector('.opened-play.on')?.click());
      same('a phone, folds open: nothing scrolls sideways', await sideways(page), 0);
      await fingers('a phone, folds open', page);
      judge('a phone: Play stays in reach', await page.locator('.opened-play').evaluate((b) => { const r = b.getBoundingClientRect(); return r.top > innerHeight - 160 && r.bottom <= innerHeight; }));
    }
    await clean(`${width} px`, page);
  });
}
await finish();
