/* The gallery by itself, as the page holds it: with the pointer, with the keyboard alone, at every width, light and dark; and what each scene asks and answers. */
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { examples } from '../../lab/models.mjs';
import * as page_ from './help.mjs';
import { attempt, built, finish, judge, launch, place, root, same } from './help.mjs';

const lab = join(root, 'lab'), need = createRequire(join(lab, 'package.json')), { build } = need('esbuild');
const models = examples;
const alias = { 'ml-matrix': join(lab, 'node_modules/ml-matrix/src/index.js') };
const text = async (options) => (await build({ bundle: true, write: false, target: 'es2022', alias, ...options })).outputFiles[0].text;
const { thumbnails, scenes, saidOf, inkStyle } = await import('data:text/javascript;base64,' + Buffer.from(await text({
  stdin: { contents: "export * from './thumbs'; export { scenes, saidOf } from './scenes'; export { inkStyle } from './figure/ink';", resolveDir: lab, loader: 'ts' }, format: 'esm',
})).toString('base64'));
const made = { 'virtual:data': { presets: models, lessons: [], cards: {}, stagings: {}, notes: {}, movedNotes: {}, theory: '' }, 'virtual:thumbs': thumbnails(new WebAssembly.Module(readFileSync(join(built, 'motus.wasm'))), models) };
const script = await text({
  stdin: { contents: `import { gallery } from './shell/gallery'; import { loadData } from './data'; window.said = [];
    loadData().then(() => document.body.append(gallery({ state: { preset: 'kepler' } }, { open: name => window.said.push(name), close: () => window.said.push('closed') })));`, resolveDir: lab, loader: 'ts' }, format: 'iife',
  plugins: [{ name: 'made', setup(b) {
    b.onResolve({ filter: /^virtual:/ }, ({ path }) => ({ path, namespace: 'made' }));
    b.onLoad({ filter: /.*/, namespace: 'made' }, ({ path }) => ({ contents: `export default async () => (${JSON.stringify(made[path])})`, loader: 'js' }));
  } }],
});
const style = inkStyle() + ['style.css', 'shell/gallery.css'].map((name) => readFileSync(join(lab, name), 'utf8')).join('\n');
const file = join(place, 'gallery.html');
writeFileSync(file, `<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>Gallery</title><style>${style}</style><body><script>${script.replace(/<\/script/g, '<\\/script')}</script>`);

const cards = scenes.filter(({ theme }) => theme !== '');
async function open({ width = 1280, height = 900, theme = 'light', calm = false } = {}) {
  const context = await (await launch()).newContext({ viewport: { width, height }, colorScheme: theme, reducedMotion: calm ? 'reduce' : 'no-preference' });
  const page = await context.newPage();
  page.wrong = [];
  page.on('console', (message) => page.wrong.push(message.text()));
  page.on('pageerror', (error) => page.wrong.push(error.message));
  await page.goto(pathToFileURL(file).href);
  await page.locator('.thumb path').first().waitFor({ state: 'attached' });
  return page;
}
const close = async (name, page) => { same(`${name}: nothing is complained about`, page.wrong, []); await page.context().close(); };
const said = (page) => page.evaluate(() => window.said.splice(0));

await attempt('what is there', async () => {
  const page = await open();
  same('every motion is there, in order', await page.locator('.motion-title').allTextContents(), cards.map(({ model }) => saidOf(model).title));
  same('… with its question', await page.locator('.question').allTextContents(), cards.map(({ model }) => saidOf(model).question));
  same('the present one is marked', await page.locator('[aria-current]').evaluateAll((all) => all.map((a) => a.querySelector('.motion-title').textContent)), ['Planet']);
  const links = await page.locator('a.motion').evaluateAll((all) => all.map((a) => a.getAttribute('href')));
  same('each is a link to its scene', links.map((href) => /&p=([a-z-]+)/.exec(href)?.[1]), cards.map(({ model }) => model));
  const drawn = await page.locator('.thumb svg').evaluateAll((all) => all.map((svg) => [...svg.querySelectorAll('path')].reduce((sum, path) => sum + path.getTotalLength(), 0)));
  judge('every picture shows something', drawn.every((length) => length > 600), drawn.join());
  await page.locator('a.motion', { hasText: 'Comet' }).click();
  same('a click opens the scene', await said(page), ['comet']);
  await close('what is there', page);
});

await attempt('the keyboard', async () => {
  const page = await open();
  await page.keyboard.press('Tab');
  same('the search comes first', await page.evaluate(() => document.activeElement.type), 'search');
  await page.keyboard.press('Tab');
  await page.keyboard.press('Enter');
  same('Enter on a card opens it', await said(page), ['thrown-ball']);
  let count = 1;
  for (; count < 40; count++) { await page.keyboard.press('Tab'); if (!await page.evaluate(() => document.activeElement.matches('a.motion'))) break; }
  same('Tab goes through all of them', count, cards.length);
  await page.locator('a.motion').nth(7).focus();
  await page.keyboard.press('Escape');
  same('Escape leaves', await said(page), ['closed']);
  await close('the keyboard', page);
});

await attempt('the search', async () => {
  const page = await open(), field = page.locator('.gallery-search'), titles = () => page.locator('.motion-title:visible').allTextContents();
  await field.fill('  SUN breaks ');
  same('all the words are looked for', await titles(), ['Comet']);
  same('how many there are is said', await page.locator('.gallery-found').textContent(), '1 motion');
  await page.keyboard.press('Enter');
  same('Enter opens the first', await said(page), ['comet']);
  await field.fill('boris');
  same('a method is found', await titles(), ['Charge in a magnet', 'Crossed fields', 'Penning trap']);
  same('themes without any are away', await page.locator('.gallery-row h2:visible').allTextContents(), ['Many bodies, magnetic fields']);
  await field.fill('<b>zzz');
  judge('nothing found is said', /“<b>zzz”/.test(await page.locator('.gallery-found').textContent()) && (await titles()).length === 0);
  await page.keyboard.press('Escape');
  same('Escape brings them all back, and stays', [(await titles()).length, await said(page)], [cards.length, []]);
  await page.keyboard.press('Escape');
  same('… and leaves then', await said(page), ['closed']);
  await close('the search', page);
});

await attempt('bodies run', async () => {
  const page = await open(), ball = (title) => page.locator('a.motion', { hasText: new RegExp(`^${title}`) }).locator('.ball').first();
  const at = (title) => ball(title).evaluate((circle) => `${getComputedStyle(circle).display} ${circle.getAttribute('cx')} ${circle.getAttribute('cy')}`);
  const rest = await at('A thrown ball'), pendulum = await at('Pendulum');
  judge('a ball that rests is seen, one that does not is not', rest.startsWith('inline') && pendulum.startsWith('none'), `${rest}, ${pendulum}`);
  await page.locator('a.motion', { hasText: /A thrown ball/ }).hover();
  await page.waitForTimeout(500);
  const going = await at('A thrown ball');
  judge('the pointer makes it run', going !== rest, going);
  await page.waitForTimeout(2300);
  same('once, back to its place', await at('A thrown ball'), rest);
  await page.locator('a[href$="p=pendulum"]').focus();
  await page.waitForTimeout(300);
  judge('so does the focus', (await at('Pendulum')).startsWith('inline'));
  await close('bodies run', page);
  const calm = await open({ calm: true });
  await calm.locator('a.motion', { hasText: /A thrown ball/ }).hover();
  await calm.waitForTimeout(300);
  same('nothing runs for those who asked for less motion', await calm.locator('.running').count(), 0);
  await close('less motion', calm);
});

/* The page itself: each scene asks on the stage what its card asks, and leads to what answers it. */
/** Another scene, drawn. A reference, which changes no words, is not waited for, but what is told of events above the picture is. */
async function drawn(page, model) {
  // What is out of sight is not drawn.
  await page.evaluate((hash) => { scrollTo(0, 0); location.hash = hash; }, `#v=1&p=${model}`);
  await page.waitForFunction((question) => document.querySelector('.ask-button')?.textContent === question && document.querySelector('.stage-figure')?.getAttribute('aria-busy') === 'false', saidOf(model).question).catch(() => {});
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  if (/^\s*when /m.test(models.find(({ name }) => name === model).text)) await page_.settled(page);
}
const lessonsOf = { 'thrown-ball': 'Too high, too low', spring: 'Who keeps the energy?' };
for (const [width, height] of [[390, 844], [1280, 800]]) {
  await attempt(`${width} px: questions`, async () => {
    const page = await page_.open(undefined, { width, height, touch: width < 800, calm: true });
    for (const { model } of cards) {
      await drawn(page, model);
      const ask = page.locator('.ask-button'), { question } = saidOf(model);
      same(`${width} px, ${model}: the stage asks what the card asks`, await ask.allTextContents(), [question]);
      const [words, shown, stage, dock] = await page.evaluate(() => ['#words', '.ask-button', '#stage', '#dock'].map((s) => { const { top, bottom, height: h } = document.querySelector(s).getBoundingClientRect(); return { top, bottom, h }; }));
      if (width < 800) judge(`${width} px, ${model}: the words are above the picture, which has its room`, words.bottom <= stage.top + 0.5 && shown.bottom <= words.bottom && stage.h >= 240 && dock.bottom <= height + 0.5, JSON.stringify([words, shown, stage, dock]));
      else judge(`${width} px, ${model}: the words end above the dock`, words.bottom <= dock.top, JSON.stringify([words, dock]));
      if (model === 'resonance' || model === 'thrown-ball') await page_.summaryOf(page, 'Motion');
      if (model === 'resonance' || model === 'thrown-ball') await page.screenshot({ path: join(built, 'shots', `question-${model}-${width}.png`) });
      await ask.click();
      if (lessonsOf[model]) {
        await page.locator('.lesson .parts').waitFor();
        same(`${width} px, ${model}: a lesson answers, the right one`, await page.evaluate(() => {
          const list = document.getElementById('lessons');
          list.showPopover();
          const title = list.querySelector('[aria-current] span').textContent;
          list.hidePopover();
          return title;
        }), lessonsOf[model]);
        await page.locator('.lesson-head .text-button').click();
        continue;
      }
      const note = page.locator('.note h3');
      same(`${width} px, ${model}: the note answers it, in sight and with the focus`, [await note.textContent(), await note.evaluate((h) => { const { top, bottom } = h.getBoundingClientRect(); return document.activeElement === h && top > 60 && bottom < innerHeight; })], [question, true]);
      if (model === 'resonance') await page.screenshot({ path: join(built, 'shots', `answer-${model}-${width}.png`) });
    }
    await page_.clean(`${width} px: questions`, page);
  });
}

await attempt('every width', async () => {
  for (const [width, columns, theme] of [[320, 2, 'dark'], [390, 2, 'light'], [800, 3, 'dark'], [1024, 5, 'light'], [1280, 5, 'dark'], [1920, 5, 'light']]) {
    const page = await open({ width, theme });
    judge(`${width} px: nothing is wider than the page`, await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    const boxes = await page.locator('a.motion').evaluateAll((all) => all.map((a) => { const { x, y, width: w, height } = a.getBoundingClientRect(); return { x, y, w, height }; }));
    same(`${width} px: so many a row`, boxes.filter(({ y }) => y === boxes[0].y).length, columns);
    judge(`${width} px: no target is too small`, boxes.every(({ w, height }) => w >= 44 && height >= 44) && (await page.locator('.gallery-search').boundingBox()).height >= 44);
    // What axe judges depends on the colours, and on whether there is room: the narrowest and the widest.
    if (width !== 320 && width !== 1920) { await close(`${width} px`, page); continue; }
    await page.evaluate(readFileSync(need.resolve('axe-core/axe.min.js'), 'utf8'));
    const violations = await page.evaluate(() => window.axe.run(document.querySelector('.gallery')).then(({ violations: all }) => all.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 100)}`)));
    same(`${width} px, ${theme}: axe has nothing to say`, violations, []);
    await close(`${width} px`, page);
  }
});
/* In the page, whose own margins grow with the window. */
await attempt('wider and wider', async () => {
  const page = await page_.open(`${page_.singleFile}#v=1&p=spring&l=gallery`, { width: 1280, height: 900, calm: true });
  await page.locator('#gallery .thumb svg').first().waitFor();
  const wide = () => page.evaluate(() => ['#gallery .gallery-row', '#gallery .thumb'].map((s) => document.querySelector(s).getBoundingClientRect().width));
  let before = [0, 0];
  for (const width of [1280, 1440, 1590, 1700, 1920, 2560]) {
    await page.setViewportSize({ width, height: 900 });
    const now = await wide();
    judge(`${width} px: a row is no narrower than in a narrower window, a picture has its room`, now[0] >= before[0] && now[1] >= 180, JSON.stringify([before, now]));
    before = now;
  }
  judge('2560 px: it stands in the middle', await page.evaluate(() => { const { left, right } = document.querySelector('#gallery .gallery-row').getBoundingClientRect(); return Math.abs(left + right - document.documentElement.clientWidth) < 2; }));
  await page_.example(page, 'spring');
  await page_.closer(page);
  judge('2560 px: so does what looks closer', await page.evaluate(() => document.querySelector('#panels').clientWidth > 1500));
  await page_.clean('wider and wider', page);
});
await finish();
