/* The scenes of the gallery and their small pictures. Run by `node --test`; the page's module is that of build/lab. */
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { examples } from '../../lab/models.mjs';

const lab = new URL('../../lab/', import.meta.url), need = createRequire(new URL('package.json', lab));
const { buildSync } = need('esbuild');
const built = buildSync({
  stdin: { contents: `export * from './thumbs'; export * from './scenes'; export { Core } from './core'; export { Answers } from './answers'; export { stagings } from './stage/stagings'; export { words } from './words'; export { notes } from './words/en/notes';`, resolveDir: fileURLToPath(lab), loader: 'ts' },
  bundle: true, format: 'esm', write: false, target: 'es2022', alias: { 'ml-matrix': fileURLToPath(new URL('node_modules/ml-matrix/src/index.js', lab)) },
});
const { scenes, themes, thumbnails, Core, Answers, stagings, words, notes } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));
const module = new WebAssembly.Module(readFileSync(new URL('../../build/lab/motus.wasm', import.meta.url)));
const models = examples;
const lessonIds = readdirSync(new URL('words/en/lessons/', lab)).filter(name => name.endsWith('.txt')).map(name => name.replace(/^\d+-|\.txt$/g, ''));
const answers = new Answers(new Core(module));
const textOf = name => models.find(model => model.name === name).text;
const set = scene => Object.entries(scene.set ?? {}).map(([name, value]) => `${name}=${value}`);

test('every model has one scene, and every theme has some', () => {
  assert.deepEqual(scenes.map(scene => scene.model).sort(), models.map(model => model.name).sort());
  for (const theme of themes) assert.ok(scenes.some(scene => scene.theme === theme), theme);
  for (const scene of scenes) assert.ok(scene.theme === '' || themes.includes(scene.theme), scene.theme);
  assert.deepEqual(Object.keys(words.gallery.themes), themes);
  assert.deepEqual(Object.keys(words.scenes).sort(), scenes.map(scene => scene.model).sort());
  for (const key of ['title', 'question']) assert.equal(new Set(Object.values(words.scenes).map(said => said[key])).size, scenes.length);
  for (const { question } of Object.values(words.scenes)) assert.match(question, /^[A-Z].*\?$/);
});

test('a scene’s numbers, methods and columns are its model’s', () => {
  for (const scene of scenes) {
    const { methods, columns } = answers.answer('describe', { model: { text: textOf(scene.model), set: set(scene) } });
    for (const name of [...scene.methods, ...(scene.picture.methods ?? [])]) assert.ok(methods.find(m => m.name === name)?.admitted, `${scene.model}: ${name}`);
    for (const name of (scene.picture.methods ?? [])) assert.ok(scene.methods.includes(name), `${scene.model}: the picture shows ${name}, the scene does not`);
    const known = new Set(columns.map(c => c.name));
    for (const name of [...scene.picture.curves, ...(scene.picture.rods ?? [])].flat()) {
      assert.ok(known.has(name) || name === 'i' || (scene.picture.view === 'shape' && known.has(name.replace('[i]', '[1]'))), `${scene.model}: ${name}`);
    }
  }
});

const thumbs = thumbnails(module, models);

/** The corners of a path in tenths of a pixel. */
function corners(d) {
  const numbers = [...d.replace(/^M/, '').replace('l', ' ').matchAll(/-?\d+/g)].map(Number), out = [];
  for (let i = 0, x = 0, y = 0; i < numbers.length; i += 2) out.push([x += numbers[i], y += numbers[i + 1]]);
  return out;
}

test('the pictures are small, in the page’s colours, and move as the motion does', () => {
  assert.ok(JSON.stringify(thumbs).length < 48e3, `${JSON.stringify(thumbs).length} bytes`);
  for (const [name, { svg, runners }] of Object.entries(thumbs)) {
    const paths = [...svg.matchAll(/<path ([^>]*)\/>/g)].map(match => match[1]);
    for (const [, colour] of svg.matchAll(/(?:stroke|fill)="([^"]*)"/g)) assert.match(colour, /^var\(--[a-z0-9-]+(, var\(--axis\))?\)$/, name);
    const exact = paths.filter(path => path.includes('var(--exact)'));
    assert.ok(exact.length > 0, name);
    for (const path of exact) {
      const points = corners(/d="([^"]*)"/.exec(path)[1]);
      for (const [x, y] of points) assert.ok(x >= 110 && x <= 1770 && y >= 110 && y <= 930, `${name}: (${x}, ${y}) is outside`);
      const [w, h] = [0, 1].map(k => Math.max(...points.map(p => p[k])) - Math.min(...points.map(p => p[k])));
      // Balls that are pushed once go straight.
      assert.ok((points.length > 8 || name === 'newtons-cradle') && Math.max(w, h) > 40, `${name} shows a dot`);
    }
    for (const { path, pace } of runners) {
      assert.ok(paths[path].includes('var(--exact)'), name);
      assert.equal(pace[0], 0);
      assert.equal(pace.at(-1), 1000);
      assert.ok(pace.every((p, k) => k === 0 || p >= pace[k - 1]), name);
    }
  }
});

test('a corner of the green line is where the motion is, to a pixel', () => {
  // The thrown ball in tenths of a pixel: equal units, the frame is that of the three motions.
  const points = corners(/d="([^"]*)"[^>]*var\(--exact\)/.exec(thumbs['thrown-ball'].svg)[1]);
  const scale = (points.at(-1)[0] - points[0][0]) / 12, height = t => 1.7 + 10 * t - 4.905 * t * t;
  for (const [x, y] of points) {
    const t = (x - points[0][0]) / scale / 6;
    assert.ok(Math.abs((points[0][1] - y) - scale * (height(t) - 1.7)) < 3, `at ${t}`);
  }
});

test('the stage’s sliders, frames and lessons are there', () => {
  for (const [name, staging] of Object.entries(stagings)) {
    const { parameters, columns, settings } = answers.answer('describe', { model: { text: textOf(name), set: [] } });
    for (const { name: wanted, part = 0, low, high } of staging.dials ?? []) {
      const parameter = parameters.find(p => p.name === wanted);
      assert.ok(parameter && part < parameter.values.length, `${name}: no ${wanted}, part ${part}`);
      if (low !== undefined) assert.ok(low <= parameter.values[part] && parameter.values[part] <= high, `${name}: ${wanted} = ${parameter.values[part]} is not between ${low} and ${high}`);
    }
    for (const column of (staging.rods ?? []).flat()) assert.ok(columns.some(c => c.name === column), `${name}: ${column}`);
    if (staging.switch) assert.ok(models.some(m => m.name === staging.switch.to), name);
    if (staging.ask) assert.ok(lessonIds.includes(staging.ask), `${name}: ${staging.ask}`);
    // What is said of it is of what it has, and of all of it.
    const { sentence, dials = {}, switch: turn } = words.scenes[name];
    assert.deepEqual(Object.keys(dials).sort(), (staging.dials ?? []).map(dial => (dial.part === undefined ? dial.name : `${dial.name}.${'xyz'[dial.part]}`)).sort(), name);
    assert.equal(turn !== undefined, staging.switch !== undefined, name);
    // Its question has an answer: a lesson, or a note.
    assert.ok(staging.ask || notes[name], `${name}: nothing answers “${words.scenes[name].question}”`);
    assert.ok((typeof sentence === 'string' ? sentence : sentence('twelve')).length < 170 && settings.step !== null, name);
  }
  for (const { model } of scenes) assert.ok(stagings[model], `${model} has no place on the stage`);
});
