/* Every picture: it opens, has a name, a summary sentence and a data table, and can be saved: the PNG is decoded, the SVG is read as XML and drawn,
 * the CSV holds what the table shows.
 */
import { attempt, clean, figureOf, finish, judge, open, readCsv, same, saved, settled, singleFile, summaryOf } from './help.mjs';

const titles = ['Against time', 'Error', 'Drift of an invariant', 'Phase plane', 'Convergence', 'Work and precision', 'Stability'];
const all = '&o=time,error,drift,phase,convergence,precision,stability';
const colours = { light: /#15803D/i, dark: /#4ADE80/i };

/** What would take long on a slow machine waits for its button. */
async function compute(page, title) {
  const button = figureOf(page, title).getByRole('button', { name: 'Compute', exact: true });
  if (!await button.count() || !await button.isVisible()) return;
  await button.click();
  await settled(page, 600, 60000);
}
/** A cell of the table is the file's number, written shorter at most. */
function agree(cell, other) {
  const plain = cell.replaceAll('\u2212', '-').replace(/^–$/, '');
  if (plain === other) return true;
  const number = Number(plain), exact = Number(other);
  return plain !== '' && other !== '' && Math.abs(number - exact) <= 5e-10 * Math.abs(exact);
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
  const page = await open(`${singleFile}#v=1&p=${preset}${all}`, { theme, width });
  // Studies begin when they come into view.
  for (const title of preset === 'three-body-figure-eight' ? [] : titles.slice(4)) {
    await figureOf(page, title).scrollIntoViewIfNeeded();
    await settled(page, 600, 60000);
    await compute(page, title);
  }
  for (const title of preset === 'three-body-figure-eight' ? titles.slice(0, 4) : titles) {
    const name = `${preset}, ${theme}, “${title}”`;
    await attempt(name, async () => {
      const figure = figureOf(page, title);
      same(`${name}: is there once`, await figure.count(), 1);
      judge(`${name}: its name`, await page.getByRole('figure', { name: title, exact: true }).count() === 1);
      const summary = await summaryOf(page, title);
      judge(`${name}: a summary sentence`, summary.length > 25 && /\.$/.test(summary.trim()) && !/NaN|undefined|null|Infinity|\d{3,}\.\d{8,}/.test(summary), summary);
      const label = await figure.locator('canvas.figure-still').getAttribute('aria-label');
      judge(`${name}: the picture's name holds it`, label === `${title}. ${summary}`, label);
      judge(`${name}: something is drawn`, await figure.locator('canvas.figure-still').evaluate((canvas) => canvas.width > 100 && new Set(new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size > 5));

      const { name: csvName, bytes } = await saved(page, title, 'CSV');
      const [head, ...rows] = readCsv(bytes.toString('utf8'));
      judge(`${name}: CSV: as many cells in every row`, rows.length > 0 && rows.every((row) => row.length === head.length), `${head.length}: ${rows.find((row) => row.length !== head.length)}`);
      judge(`${name}: CSV: named after model and picture`, csvName.startsWith(`${preset}-`) && csvName.endsWith('.csv'), csvName);
      await figure.locator('details.figure-data > summary').click();
      await figure.locator('table').first().waitFor();
      const table = figure.locator('.figure-data table');
      await table.locator('thead th').first().waitFor();
      same(`${name}: the table's head is the file's`, await table.locator('thead th').allTextContents(), head);
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
      judge(`${name}: SVG: well-formed, with title and description, nothing that runs`, read.error === '' && read.root === 'svg' && read.title === title && read.desc === summary && read.unsafe === 0 && read.parts > 4 && !/NaN|undefined/.test(svg.replace(/<desc>.*?<\/desc>/s, '')), JSON.stringify(read));
      const drawn = await decoded(page, Buffer.from(svg), 'image/svg+xml');
      judge(`${name}: SVG: can be drawn`, drawn.width > 100 && drawn.colours > 5, JSON.stringify(drawn));
      if (title === 'Against time') judge(`${name}: the exact line is green and thick`, colours[theme].test(svg) && new RegExp(`stroke="${colours[theme].source}"[^>]*stroke-width="[3-9]|stroke-width="[3-9][^>]*stroke="${colours[theme].source}"`, 'i').test(svg));
    });
  }
  await clean(`panels, ${preset}`, page, /readback/);
}

// --- what the panels say ------------------------------------------------------------------------------------------------------------
await attempt('convergence', async () => {
  const page = await open(`${singleFile}#v=1&p=spring&a=explicit-euler,verlet,rk4${all}`);
  await figureOf(page, 'Convergence').scrollIntoViewIfNeeded();
  await settled(page, 900);
  await compute(page, 'Convergence');
  const said = await figureOf(page, 'Convergence').textContent();
  for (const [label, order] of [['explicit Euler', 1], ['Verlet', 2], ['RK4', 4]]) judge(`Convergence: ${label} has order ${order}`, new RegExp(`${label}: order ${order} confirmed`).test(said), said.slice(0, 600));
  await figureOf(page, 'Stability').scrollIntoViewIfNeeded();
  await settled(page, 600);
  const before = await summaryOf(page, 'Stability');
  await page.locator('#step').fill('2.2');
  await settled(page, 600);
  const after = await summaryOf(page, 'Stability');
  judge('Stability: the points move with the step', before !== after, `${before} / ${after}`);
  await clean('convergence', page);
});
// --- a motion that passes a singularity says so, and one that only comes near to it does not -------------------------------------
await attempt('singularity', async () => {
  const fall = (speed) => `x'' = -1/x^2\nx(0) = 1\nx'(0) = ${speed}\nmethod rk4\nstep 0.001\nuntil 2\n`;
  for (const [speed, passes] of [[0, true], [1.5, false]]) {
    const page = await open(`${singleFile}#v=1&a=rk4,verlet&o=time&m=${encodeURIComponent(fall(speed))}`);
    await settled(page, 600);
    const status = await page.locator('.status .message').textContent(), summary = await summaryOf(page, 'Against time');
    for (const text of [status, summary]) judge(`x'(0) = ${speed}: ${passes ? 'says' : 'does not say'} that the motion passes a singularity`, /RK4: the run passes a singularity of the force between t = 1\.11/.test(text) === passes && /singularity/.test(text) === passes, text);
    await clean('singularity', page);
  }
});
await finish();
