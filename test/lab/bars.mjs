/* Bars of error: the last numbers as value ± error, the band about the line of a motion against time, since when no digit is known, and what is asked for when.
 *
 * Invariant: what is told covers the exact motion, and is what the program tells but for the times at which it was looked at.
 */
import { attempt, clean, closer, figureOf, finish, judge, motus, open, same, saved, settled, singleFile } from './help.mjs';

/** "0.0477824 ± 1.5×10⁻⁶" as two numbers. */
function barOf(text, name) {
  const powers = '⁰¹²³⁴⁵⁶⁷⁸⁹', plain = text.replace(/×10(⁻?)([⁰¹²³⁴⁵⁶⁷⁸⁹]+)/g, (_, sign, power) => `e${sign ? '-' : ''}${[...power].map((c) => powers.indexOf(c)).join('')}`).replace(/−/g, '-').replace(/\u00a0/g, ' ');
  const [, value, error] = new RegExp(`${name} = (-?\\d+(?:\\.\\d+)?(?:e-?\\d+)?) ± (\\d+(?:\\.\\d+)?(?:e-?\\d+)?)`).exec(plain) ?? [];
  return value === undefined ? null : { value: Number(value), error: Number(error) };
}
const answer = async (page) => {
  await closer(page, 'Error');
  await figureOf(page, 'Error').scrollIntoViewIfNeeded();
  await page.waitForFunction(() => /±|no digit/.test(document.querySelector('#panels figure[data-title="Error"] .figure-answer')?.textContent ?? ''));
  return figureOf(page, 'Error').locator('.figure-answer').textContent();
};

await attempt('value ± error', async () => {
  const page = await open(`${singleFile}#v=1&p=driven-oscillator`);
  const here = barOf(await answer(page), 'x'), told = JSON.parse(motus('run', 'models/driven-oscillator.motus', '--json'));
  judge('the last number with its error', here !== null && Math.abs(here.value - told.state.x) <= here.error, JSON.stringify(here));
  judge('… is that of the program', here.error > told.error.x / 2 && here.error < 3 * told.error.x, `${here.error} and ${told.error.x}`);
  judge('… and covers the exact motion', Math.abs(here.value - 0.04778309565760847) <= here.error);
  await page.goto(`${singleFile}#v=1&p=driven-oscillator&a=dop853&r=1e-10`);
  await settled(page);
  await page.waitForFunction(() => /Dormand.*±/.test(document.querySelector('#panels figure[data-title="Error"] .figure-answer')?.textContent ?? ''));
  const finer = barOf(await figureOf(page, 'Error').locator('.figure-answer').textContent(), 'x');
  judge('an adaptive method, finer, covers it too', finer !== null && finer.error < here.error / 100 && Math.abs(finer.value - 0.04778309565760847) <= finer.error, JSON.stringify(finer));
  await clean('value ± error', page);
});
await attempt('an error that is known', async () => {
  // A bar as wide as the flight is high says less than the error beside it.
  const page = await open(`${singleFile}#v=1&p=thrown-ball`);
  await settled(page, 1500);
  await closer(page, 'Error');
  await figureOf(page, 'Error').scrollIntoViewIfNeeded();
  await settled(page, 1500);
  const text = await figureOf(page, 'Error').locator('.figure-answer').textContent();
  judge('where a formula gives the motion, no bar stands beside the error', /explicit Euler off by 1\.96/.test(text) && !text.includes('±'), text);
  await clean('an error that is known', page);
});
await attempt('the band', async () => {
  let said = [], dots = 0;
  const areas = async (hash) => {
    const page = await open(`${singleFile}#v=1&${hash}`);
    await settled(page, 900);
    const svg = (await saved(page, 'Motion', 'SVG')).bytes.toString('utf8');
    await clean(hash, page);
    said = [...svg.matchAll(/<text[^>]*>([^<]*no digit[^<]*)</g)].map(([, text]) => text);
    dots = (svg.match(/stroke-dasharray="1\.5[ ,]6"/g) ?? []).length;
    // Areas, not lines.
    return [...svg.matchAll(/<path[^>]*>/g)].filter(([tag]) => /Z"/.test(tag)).flatMap(([tag]) => /opacity="(0\.22|0\.08)"/.exec(tag)?.[1] ?? []);
  };
  judge('errors that can be seen have a band', (await areas('p=driven-oscillator&h=0.5&T=40')).includes('0.22'));
  same('errors that cannot have none', await areas('p=driven-oscillator&a=dop853&r=1e-10&T=40'), []);
  judge('where no digit is known it fills the picture, paler', (await areas('p=driven-oscillator&h=0.5&T=100')).includes('0.08'));
  same('… and the picture says so, where the line is dotted', said.slice(0, 1), ['Verlet: no digit known from here on']);
  judge('… and there alone', dots > 0, dots);
});
await attempt('no digit', async () => {
  const page = await open(`${singleFile}#v=1&p=driven-oscillator&h=0.5&T=100`);
  const text = await answer(page), told = JSON.parse(motus('run', 'models/driven-oscillator.motus', '--step', '0.5', '--json'));
  const at = Number(/no digit of Verlet is known from t = ([\d.]+) on/.exec(text)?.[1]);
  judge('since when no digit is known', told.significant_until !== null && Math.abs(at - told.significant_until) < 0.1 * told.significant_until, `${text} ${told.significant_until}`);
  await page.context().close();
});
await finish();
