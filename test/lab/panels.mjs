/* Every picture that looks closer: it has a question, a sentence of answer whose numbers are the program's, and a data table, and can be saved: the PNG
 * is decoded, the SVG is read as XML and drawn, the CSV holds what the table shows. One that has nothing to say is not there, and one that is not seen is
 * not computed.
 */
import { attempt, clean, closer, example, fields, figureOf, finish, judge, motus, open, readCsv, same, saved, settled, singleFile, summaryOf } from './help.mjs';

const titles = ['Time', 'Error', 'Energy', 'Phase', 'Order', 'Cost', 'Stability'];
const answered = ['Time', 'Error', 'Energy', 'Phase', 'Order', 'Cost', 'Stability'];
/** On a constant force any step is stable, which is a sentence without a picture. */
const without = (preset, title) => preset === 'projectile' && title === 'Stability';
const colours = { light: /#15803D/i, dark: /#4ADE80/i };

/** What would take long on a slow machine waits for its button. */
async function compute(page, title) {
  const button = figureOf(page, title).locator('.figure-controls .study button');
  if (!await button.count() || !await button.isVisible()) return;
  await button.click();
  await settled(page, 600);
}
/** A cell of the table is the file's number, written shorter at most. */
function agree(cell, other) {
  const plain = cell.replaceAll('\u2212', '-').replace(/^–$/, '');
  if (plain === other) return true;
  const number = Number(plain), exact = Number(other);
  return plain !== '' && other !== '' && Math.abs(number - exact) <= 5.01e-6 * Math.abs(exact);
}
/** Size and number of colours of a picture, as the browser decodes it. */
const decoded = (page, bytes, type) => page.evaluate(async ([data, kind]) => {
  const image = new Image();
  // A picture of the page's own making: its policy has nothing against data.
  image.src = `data:${kind};base64,${data}`;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  const context = canvas.getContext('2d', { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  const colours = new Set(new Uint32Array(context.getImageData(0, 0, canvas.width, canvas.height).data.buffer));
  return { width: canvas.width, height: canvas.height, colours: colours.size };
}, [bytes.toString('base64'), type]);

for (const [preset, theme, width] of [['spring', 'light', 1280], ['projectile', 'dark', 375], ['three-body-figure-eight', 'light', 800]]) {
  const page = await open(`${singleFile}#v=1&p=${preset}${preset === 'spring' ? "&q=x&f=x&f=x'" : ''}`, { theme, width });
  // Studies begin when they come into view.
  for (const title of preset === 'three-body-figure-eight' ? [] : titles.slice(4).filter((t) => !without(preset, t))) {
    await closer(page, title);
    await settled(page, 600);
    await compute(page, title);
  }
  for (const title of preset === 'three-body-figure-eight' ? titles.slice(0, 4) : titles.filter((t) => !without(preset, t))) {
    const name = `${preset}, ${theme}, “${title}”`;
    await attempt(name, async () => {
      const figure = figureOf(page, title);
      await closer(page, title);
      // The errors of the curves are asked for after a rest that is longer than `closer` waits; what is said must not change while it is read.
      if (title === 'Time') await settled(page, 600);
      same(`${name}: is there once`, await figure.count(), 1);
      const question = await figure.locator('h3').textContent(), answer = await figure.locator('.figure-answer').textContent();
      judge(`${name}: its question is its name`, await page.getByRole('figure', { name: question, exact: true }).count() === 1, question);
      if (answered.includes(title)) judge(`${name}: a question and an answer, which is a sentence`, /^[^ ].+\?$/.test(question) && /^\S.{8,}\.$/.test(answer) && await figure.locator('.figure-answer').isVisible(), `${question} ${answer}`);
      const summary = await summaryOf(page, title);
      judge(`${name}: a summary sentence`, summary.length > 25 && /\.$/.test(summary.trim()) && !/NaN|undefined|null|Infinity|\d{3,}\.\d{8,}/.test(summary), summary);
      const label = await figure.locator('canvas.figure-still').getAttribute('aria-label');
      judge(`${name}: the picture's name holds it`, label === [/\?$/.test(question) ? question : `${question}.`, answer, summary].filter(Boolean).join(' '), label);
      judge(`${name}: something is drawn`, await figure.locator('canvas.figure-still').evaluate((canvas) => canvas.width > 100 && new Set(new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size > 5));

      const { name: csvName, bytes } = await saved(page, title, 'CSV');
      const [head, ...rows] = readCsv(bytes.toString('utf8'));
      judge(`${name}: CSV: as many cells in every row`, rows.length > 0 && rows.every((row) => row.length === head.length), `${head.length}: ${rows.find((row) => row.length !== head.length)}`);
      judge(`${name}: CSV: named after model and picture`, csvName.startsWith(`${preset}-`) && csvName.endsWith('.csv'), csvName);
      await figure.locator('details.figure-data > summary').click();
      await figure.locator('table').first().waitFor();
      const table = figure.locator('.figure-data table');
      await table.locator('thead th').first().waitFor();
      same(`${name}: the table has the file's columns`, await table.locator('thead th').count(), head.length);
      const heads = await table.locator('thead th').allTextContents();
      judge(`${name}: each head says another thing, as equations set it`, new Set(heads).size === heads.length && (!answered.includes(title) || !heads.some((h) => /'|\[|\w\.\w/.test(h))), heads.join(' | '));
      const cells = await table.locator('tbody tr').evaluateAll((trs) => trs.map((tr) => [...tr.children].map((td) => td.textContent)));
      const stray = cells.find((row) => !rows.some((other) => row.every((cell, i) => agree(cell, other[i]))));
      judge(`${name}: the table's rows are of the file`, cells.length > 0 && !stray, stray);
      judge(`${name}: the table has a caption, its head a scope`, await table.locator('caption').count() === 1 && await table.locator('thead th:not([scope])').count() === 0);
      await figure.locator('details.figure-data > summary').click();

      const box = await figure.locator('canvas.figure-still').boundingBox();
      const png = await saved(page, title, 'PNG');
      const picture = await decoded(page, png.bytes, 'image/png');
      // Below it stand four lines of 18 pixels, and 14 about them: what it is of.
      judge(`${name}: PNG: twice the picture's size, not empty`, png.bytes.subarray(1, 4).toString() === 'PNG' && Math.abs(picture.width - 2 * box.width) <= 2 && Math.abs(picture.height - 2 * (box.height + 86)) <= 2 && picture.colours > 5, JSON.stringify([picture, box]));
      const svg = (await saved(page, title, 'SVG')).bytes.toString('utf8');
      const read = await page.evaluate((text) => {
        const xml = new DOMParser().parseFromString(text, 'image/svg+xml');
        return {
          error: xml.querySelector('parsererror')?.textContent ?? '', root: xml.documentElement.localName, title: xml.querySelector('title')?.textContent, desc: xml.querySelector('desc')?.textContent,
          unsafe: xml.querySelectorAll('script, foreignObject, [onload], [href^="http"]').length, parts: xml.querySelectorAll('path, polyline, line, circle, text, rect').length,
        };
      }, svg);
      judge(`${name}: SVG: well-formed, with title and description, nothing that runs`, read.error === '' && read.root === 'svg' && read.title === title && read.desc === [answer, summary].filter(Boolean).join(' ') && read.unsafe === 0 && read.parts > 4 && !/NaN|undefined/.test(svg.replace(/<desc>.*?<\/desc>/s, '')), JSON.stringify(read));
      const drawn = await decoded(page, Buffer.from(svg), 'image/svg+xml');
      judge(`${name}: SVG: can be drawn`, drawn.width > 100 && drawn.colours > 5, JSON.stringify(drawn));
      // “exact” alone is what a formula gives; among the drawn names, not in what the file says of itself.
      const words = [...svg.matchAll(/<text [^>]*>(.*?)<\/text>/g)].map(([, inside]) => inside.replace(/<[^>]*>/g, ''));
      if (['Time', 'Phase'].includes(title)) same(`${name}: how the green line is called`, [...new Set(words.flatMap((w) => /exact|computed/.exec(w) ?? []))], [preset === 'three-body-figure-eight' ? 'computed' : 'exact']);
      if (title === 'Time') judge(`${name}: the exact line is green and thick`, colours[theme].test(svg) && new RegExp(`stroke="${colours[theme].source}"[^>]*stroke-width="[3-9]|stroke-width="[3-9][^>]*stroke="${colours[theme].source}"`, 'i').test(svg));
    });
  }
  await clean(`panels, ${preset}`, page, /readback/);
}

// --- what they say is true -------------------------------------------------------------------------------------------------------------
/** "8.69\u2009%" and "2.26×10⁻¹¹" as numbers. */
const numberOf = (text) => Number(text.replace('−', '-').replace(/×10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/, (_, power) => `e${[...power].map((c) => (c === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c))).join('')}`));
const NUMBER = '−?\\d+(?:\\.\\d+)?(?:×10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?';
/** The number behind these words in a sentence; NaN: they are not in it. */
const behind = (sentence, words) => numberOf(new RegExp(`${words} (${NUMBER})`).exec(sentence)?.[1] ?? 'none');
const near = (a, b) => Math.abs(a - b) <= 0.0051 * Math.abs(b);
const answerOf = async (page, title) => {
  await closer(page, title);
  const answer = figureOf(page, title).locator('.figure-answer');
  // A sentence comes some frames after its figure; a figure that never gets one says so by its absence.
  await answer.filter({ hasText: /\S/ }).waitFor({ state: 'attached', timeout: 10000 }).catch(() => {});
  return answer.textContent();
};
/** The energy at each row of a run of the program. */
function energies(...words) {
  const [head, ...rows] = readCsv(motus('run', ...words, '-o', '-', '--quiet').split('\n').filter((line) => !line.startsWith('#')).join('\n'));
  return rows.map((row) => Number(row[head.indexOf('energy')]));
}
/** Where a run of the program ends, in the plane. */
function place(...words) {
  const [head, ...rows] = readCsv(motus('run', ...words, '-o', '-', '--quiet').split('\n').filter((line) => !line.startsWith('#')).join('\n')), last = rows.filter((row) => row.length === head.length).at(-1);
  return head.flatMap((name, k) => (/^(r\.)?[xy]$/.test(name) ? [Number(last[k])] : []));
}
const farthest = (values) => Math.max(...values.map((v) => Math.abs(v - values[0]))) / Math.abs(values[0]);

await attempt('answers are the program’s', async () => {
  const page = await open(`${singleFile}#v=1&p=spring&h=0.16&T=20`);
  const compared = (model, ...words) => JSON.parse(motus('compare', `models/${model}.motus`, ...words, '--json')).rows;
  for (const [fragment, model, labels, options] of [
    ['#v=1&p=spring&h=0.16&T=20', 'spring', { 'explicit-euler': 'explicit Euler', 'symplectic-euler': 'symplectic Euler', verlet: 'Verlet' }, ['--step', '0.16', '--until', '20']],
    ['#v=1&p=thrown-ball', 'thrown-ball', { 'explicit-euler': 'explicit Euler', 'symplectic-euler': 'symplectic Euler' }, []],
    ['#v=1&p=kepler', 'kepler', { 'symplectic-euler': 'symplectic Euler', 'velocity-verlet': 'velocity Verlet' }, []]]) {
    await page.evaluate((hash) => { location.hash = hash; }, fragment);
    await settled(page, 400);
    const said = await answerOf(page, 'Error'), energy = await answerOf(page, 'Energy');
    for (const row of compared(model, '--methods', Object.keys(labels).join(','), ...options)) {
      const told = behind(said, `${labels[row.method]} off by`);
      // In the plane it is the distance of the two places, not the larger of two coordinates.
      const exact = place(`models/${model}.motus`, ...options, '--method', 'kahan-li8'), off = Math.hypot(...place(`models/${model}.motus`, ...options, '--method', row.method).map((x, k) => x - exact[k]));
      judge(`${model}: how far off ${row.method} is`, near(told, off), `${told}, not ${off}: ${said}`);
      const values = energies(`models/${model}.motus`, '--method', row.method, ...options);
      const rate = model === 'spring' ? values[1] / values[0] - 1 : Math.abs(values[1] - values[0]) / Math.abs(values[0]);
      const [number, wanted] = row.method === 'explicit-euler' || model === 'thrown-ball' ? [behind(energy.toLowerCase(), `${labels[row.method].toLowerCase()} (?:adds|loses)`), 100 * rate]
        : [behind(energy.toLowerCase(), `${labels[row.method].toLowerCase()}(?: strays by at most| by)?`), 100 * farthest(values)];
      judge(`${model}: what ${row.method} does with the energy`, near(number, wanted), `${number}, not ${wanted}: ${energy}`);
    }
  }
  judge('what is round-off is said to be on it', /midpoint \(RK2\) on it/.test(await (await example(page, 'thrown-ball'), answerOf(page, 'Error'))));
  await example(page, 'kepler');
  const swing = await answerOf(page, 'Phase');
  judge('kepler: between the ends of the axis, once in a period', near(behind(swing, 'between'), -1.6) && near(behind(swing, 'and'), 0.4) && near(behind(swing, 'once in'), 2 * Math.PI), swing);
  const there = await answerOf(page, 'Time');
  judge('kepler: after ten and a half turns at the far end', near(behind(there, 'rx ='), -1.6), there);
  await clean('answers', page);
});
await attempt('the words of a scene are so', async () => {
  const page = await open(`${singleFile}#v=1&p=spring&h=2.1`), knob = () => page.locator('#step-slider').inputValue().then(Number), follow = (name) => page.locator('.note button', { hasText: name }).click();
  same('a step beyond the stops: the knob is at the end of a wider range', [await page.locator('#step').inputValue(), await knob()], ['2.1', 0]);
  const stops = await page.locator('.scale-step .stops span:visible').evaluateAll((all) => all.map((s) => [s.textContent, parseFloat(s.style.left)]));
  judge('… and its stops are where they belong', stops.length === 5 && stops[0][0] === '0.2' && Math.abs(stops[0][1] - 100 * Math.log(2.1 / 0.2) / Math.log(2.1 / 0.0125)) < 0.2, JSON.stringify(stops));
  await closer(page);
  await follow('1.9');
  same('the note’s button takes its step', [(await fields(page)).h, await page.locator('#step').inputValue()], ['1.9', '1.9']);
  same('the blue one is asked about', await page.locator('.ask-button').allTextContents(), ['Why does the blue one stay?']);
  await page.evaluate(() => { location.hash = '#v=1&p=spring&a=verlet'; });
  await page.waitForFunction(() => !document.querySelector('.ask-button'));
  judge('… and not where it is not shown', true);
  await example(page, 'projectile-drag');
  await closer(page);
  await follow('5.87');
  same('the ball in air runs until it lands', (await fields(page)).T, '5.87');
  judge('what an invariant is', (await answerOf(page, 'Invariant')).startsWith('The hodograph is a number made of'), await answerOf(page, 'Invariant'));
  await example(page, 'van-der-pol');
  const balance = await answerOf(page, 'Invariant');
  judge('… of another one', /^The balance is the energy of the swing less .*\. RK4 /.test(balance), balance);
  await example(page, 'damped-cubic');
  await page.locator('.ask-button').click();
  same('the question of the braked spring leads to its note', await page.evaluate(() => document.activeElement.textContent), 'Does friction spoil Verlet?');
  await clean('words of scenes', page);
});
await attempt('a run that breaks off', async () => {
  const page = await open(`${singleFile}#v=1&a=verlet&m=${encodeURIComponent("x'' = -sign(x')\nx(0) = 0\nx'(0) = 1\nstep 0.1\nuntil 3\n")}`);
  await page.waitForFunction(() => /could not solve/.test(document.querySelector('.status .message').textContent));
  same('the name of the method stands once', await page.locator('.status .message').textContent(), 'Verlet could not solve its implicit equation at t = 1: x\' does not converge.');
  judge('the picture is told of in the same way', (await summaryOf(page, 'Motion')).includes('Verlet stops at t = 0.9: the implicit equation of its next step could not be solved.'), await summaryOf(page, 'Motion'));
  same('the clock ends where the run does', Number(await page.locator('.transport-now').textContent()), 0.9);
  const said = await answerOf(page, 'Stability');
  same('no step is said to be short enough', said, 'The run broke off, so it cannot be told which steps are short enough.');
  await clean('breaks off', page);
});
await attempt('digits that are not the motion’s', async () => {
  const page = await open(`${singleFile}#v=1&a=rk4&q=x&m=${encodeURIComponent("x' = 10 (y - x)\ny' = x (28 - z) - y\nz' = x y - 8/3 z\nx(0) = 1\ny(0) = 1\nz(0) = 1\nstep 0.01\nuntil 40\n")}`);
  await page.waitForFunction(() => /no green curve/.test(document.querySelector('.status .message').textContent));
  const said = await answerOf(page, 'Time');
  judge('are called so', /^By RK4, at t = 40: x = .*There is no green curve: these digits are the method’s, and need not be the motion’s\.$/.test(said), said);
  await clean('digits', page);
});
await attempt('what is said of what leaves, and of what is not steady', async () => {
  const page = await open(`${singleFile}#v=1&p=spring&h=2.2&T=400&a=verlet`);
  judge('Verlet beyond its limit is not said to come back', /^Verlet (?:ends with|ends|leaves)/.test(await answerOf(page, 'Energy')), await answerOf(page, 'Energy'));
  await page.evaluate(() => { location.hash = "#v=1&a=explicit-euler&h=0.1&m=" + encodeURIComponent("x'' = x^3\nx(0) = 1\nx'(0) = 1\ninvariant energy = x'^2/2 - x^4/4\nuntil 10\n"); });
  await settled(page, 500);
  const energy = await answerOf(page, 'Energy');
  judge('one that is no number any more leaves, at a time of the run', /^Explicit Euler leaves at t = [12]\./.test(energy), energy);
  await clean('leaving', page);
});
await attempt('what has nothing to say is not there, and what is not seen costs nothing', async () => {
  const page = await open(`${singleFile}#v=1&m=${encodeURIComponent("theta'' = -sin(theta)\ntheta(0) = 2\n")}`, { width: 390, height: 844 });
  same('nothing is made before one looks closer', [await page.locator('#panels figure').count(), await page.locator('.mini-links button').count()], [0, 0]);
  await closer(page);
  const there = () => page.locator('#panels > figure:not([hidden])').evaluateAll((figures) => figures.map((f) => f.dataset.title));
  judge('a model without an invariant has no panel of one, and its stage shows it against time', !(await there()).some((t) => ['Energy', 'Invariant', 'Time'].includes(t)) && (await there()).includes('Phase'), (await there()).join());
  judge('what is far below is not computed', await page.evaluate(() => document.querySelector('#panels figure:last-child canvas').width === 300));
  await page.setViewportSize({ width: 1280, height: 900 });
  await page.evaluate(() => scrollTo(0, 0));
  await example(page, 'spring');
  await closer(page);
  judge('the spring’s stage shows both: neither is there again', !(await there()).some((t) => t === 'Time' || t === 'Phase') && (await there()).includes('Energy'), (await there()).join());
  const phaseIs = (hidden) => page.waitForFunction((wanted) => document.querySelector('figure[data-figure="phase"]').hidden === wanted, hidden).then(() => true, () => false);
  await page.setViewportSize({ width: 390, height: 844 });
  judge('a narrow stage has no room for the phase plane: it is a question below', await phaseIs(false));
  await page.setViewportSize({ width: 1280, height: 900 });
  judge('… and no more on a wide one', await phaseIs(true));
  await example(page, 'arenstorf');
  await closer(page);
  judge('what is kept is asked for by its name', await figureOf(page, 'Invariant').locator('h3').textContent() === 'Who keeps jacobi?' && await figureOf(page, 'Invariant').locator('h3 i').count() === 1);
  await clean('absent', page);
});
// --- a motion that passes a singularity says so, and one that only comes near to it does not -------------------------------------
await attempt('singularity', async () => {
  const fall = (speed) => `x'' = -1/x^2\nx(0) = 1\nx'(0) = ${speed}\nmethod rk4\nstep 0.001\nuntil 2\n`;
  for (const [speed, passes] of [[0, true], [1.5, false]]) {
    const page = await open(`${singleFile}#v=1&a=rk4,verlet&q=x&m=${encodeURIComponent(fall(speed))}`);
    await settled(page, 600);
    const status = await page.locator('.status .message').textContent(), summary = await summaryOf(page, 'Time');
    for (const text of [status, summary]) judge(`x'(0) = ${speed}: ${passes ? 'says' : 'does not say'} that the motion passes a singularity`, /RK4(?: and Verlet)?: the run passes a singularity of the force between t = 1\.11/.test(text) === passes && /singularity/.test(text) === passes, text);
    await clean('singularity', page);
  }
});
await finish();
