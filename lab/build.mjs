/* Puts the page together, twice, from the same sources: build/lab/index.html with its modules, for a server of static files, and
 * build/lab/motus-lab.html, one file that works from disk.
 *
 *   node build.mjs [--core motus.wasm] [--out DIR] [--readable]
 *
 * Invariant: the page's Content-Security-Policy allows the very scripts and styles that are written here, by their hashes, and nothing else.
 */
import { createHash } from 'node:crypto';
import { mkdir, readFile, readdir, writeFile } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { minify as shorten } from 'terser';
import { build } from 'esbuild';
import { examples } from './models.mjs';
import { theory } from './theory/typeset.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const argument = (name, otherwise) => {
  const at = process.argv.indexOf(name);
  return at > 0 ? process.argv[at + 1] : otherwise;
};
const out = resolve(argument('--out', join(here, '../build/lab')));
const wasm = await readFile(resolve(argument('--core', join(here, '../build/lab/core/motus.wasm'))));

const presets = examples;
const made = await theory();

// Its sources, so that what is not used falls away.
const alias = { 'ml-matrix': join(here, 'node_modules/ml-matrix/src/index.js') };

/** What the page's own code makes here: the first picture, those of the gallery, the lessons. */
const { outputFiles: [{ text: code }] } = await build({
  stdin: { contents: "export * from './thumbs'; export * from './lessons/read'; export { Core } from './core'; export * as drawn from './stage/first';", resolveDir: here, loader: 'ts' },
  bundle: true, write: false, format: 'esm', target: 'es2022', alias,
});
const { thumbnails, readLessons, Core, drawn } = await import(`data:text/javascript;base64,${Buffer.from(code).toString('base64')}`);
const compiled = await WebAssembly.compile(wasm);
const thumbs = thumbnails(compiled, presets);
const first = presets.find(({ name }) => name === 'thrown-ball');
const scene = drawn.sceneOf(compiled, first.name, first.text, ['explicit-euler', 'symplectic-euler', 'midpoint']);
const core = new Core(compiled), { language } = drawn.html;
const lessonTexts = await Promise.all((await readdir(join(here, 'words', language, 'lessons'))).filter((name) => name.endsWith('.txt'))
  .map(async (name) => ({ name: `lab/words/${language}/lessons/${name}`, text: await readFile(join(here, 'words', language, 'lessons', name), 'utf8') })));
let lessons;
try {
  lessons = readLessons(lessonTexts, { models: presets.map(({ name }) => name), methods: core.catalogue(core.create()).map(({ name }) => name) });
} catch (e) {
  console.error(e.message);
  process.exit(1);
}

/** A text or bytes for lab/unpack.ts. Zopfli finds the shortest such packing, where zlib takes one that is found soon: a twentieth less. */
const packed = async (contents) => {
  // Here, as it would print itself with any error from before.
  const { default: zopfli } = await import('@gfx/zopfli');
  const zipped = await zopfli.zlibAsync(Buffer.from(contents), { numiterations: 15 }), pairs = Math.ceil(8 * zipped.length / 13);
  const digit = (n) => String.fromCharCode(n + 33 + (n > 0) + (n > 25) + (n > 56));
  let out = digit(Math.floor(13 * pairs / 8) - zipped.length), held = 0, bits = 0;
  for (let i = 0, k = 0; k < pairs; k++, held >>= 13, bits -= 13) {
    for (; bits < 13; bits += 8) held |= (zipped[i++] ?? 0) << bits;
    out += digit((held & 8191) % 91) + digit(Math.floor((held & 8191) / 91));
  }
  return out;
};

/** Modules that exist in the build only. */
const virtual = (modules) => ({
  name: 'virtual',
  setup(b) {
    b.onResolve({ filter: /^virtual:/ }, ({ path }) => ({ path, namespace: 'virtual' }));
    b.onLoad({ filter: /.*/, namespace: 'virtual' }, ({ path }) => ({ contents: modules[path], loader: 'js', resolveDir: here }));
  },
});
/** esbuild bundles; Terser then shortens what it wrote by a twentieth more. */
const bundle = async (entry, format, modules) => {
  const readable = process.argv.includes('--readable');
  const { outputFiles } = await build({
    entryPoints: [join(here, entry)], bundle: true, minify: !readable, write: false, format, target: 'es2022', charset: 'utf8', legalComments: 'none', alias,
    plugins: [virtual(modules)],
  });
  const [{ text }] = outputFiles;
  return readable ? text : (await shorten(text, { module: format === 'esm', ecma: 2020, compress: { passes: 2 } })).code;
};

/** What is needed once the first picture stands. */
const later = {
  data: JSON.stringify({ presets, lessons: lessons.map(({ numbers, ...lesson }) => lesson), cards: made.cards, stagings: drawn.stagings, notes: drawn.notes, movedNotes: drawn.movedNotes, theory: made.html }),
  thumbs: JSON.stringify(thumbs),
};
const quoted = async (contents) => `import { unpack } from './unpack'; export default () => unpack("${await packed(contents)}").json();`;
const hosted = {
  'virtual:data': await quoted(later.data),
  'virtual:thumbs': await quoted(later.thumbs),
  'virtual:host': `
export const coreModule = async () => {
  const answer = await fetch('motus.wasm');
  return answer.headers.get('content-type') === 'application/wasm' ? WebAssembly.compileStreaming(answer) : WebAssembly.compile(await answer.arrayBuffer());
};
export const createWorker = () => new Worker('worker.js');
`,
};
/* From disk a page may load nothing: all is inside it, packed, each part in an element of its own that no browser runs. The only script that stands in the
 * page unpacks the others; the policy names the hash of what it puts into a script element. */
const inside = (id) => `import { unpackElement } from './unpack'; export default () => unpackElement('${id}').json();`;
const single = {
  'virtual:data': inside('data'),
  'virtual:thumbs': inside('thumbs'),
  'virtual:host': `
import { unpackElement } from './unpack';
let address = '';
export const coreModule = async () => {
  const [module, script] = await Promise.all([unpackElement('core').arrayBuffer().then((bytes) => WebAssembly.compile(bytes)), unpackElement('worker').blob()]);
  address = URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
  return module;
};
export const createWorker = () => new Worker(address);
`,
};

const hash = (text) => `'sha256-${createHash('sha256').update(text, 'utf8').digest('base64')}'`;
/* A script element ends at the first "</script", whatever stands around it. */
const closed = (script) => script.replace(/<\/(script)/gi, '<\\/$1').replace(/<!--/g, '<\\!--');
const minify = async (css) => (await build({ stdin: { contents: css, loader: 'css' }, minify: true, write: false, bundle: false, target: 'es2022' })).outputFiles[0].text;
const put = (html, mark, value) => {
  if (html.split(mark).length !== 2) throw new Error(`index.html wants ${mark} once`);
  return html.replace(mark, () => value);
};

/* The first picture, and what moves with it, need these; what opens later has sheets of its own, which the single file holds packed too. */
const sheets = { first: ['style.css', 'figure/figure.css'], later: ['later.css', 'panel/steps.css', 'panel/study.css', 'shell/editor.css', 'shell/gallery.css'] };
const styleOf = async (names, ...before) => minify([...before, ...await Promise.all(names.map((name) => readFile(join(here, name), 'utf8')))].join('\n'));
const style = await styleOf(sheets.first, made.fontCss, drawn.inkStyle()), laterStyle = await styleOf(sheets.later);
const escaped = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`), said = drawn.said(scene);
const words = `<div class="words-inner"><div class="words-head"><h1 id="scene-title">${escaped(said.title)}</h1></div><p id="scene-words">${escaped(said.sentence)}</p><p class="ask"><button type="button" class="ask-button"><span>${escaped(said.ask)}</span><svg viewBox="0 0 24 24" width="20" height="20" aria-hidden="true" focusable="false" class="icon"><path d="M5 12h13M12.5 6l5.5 6-5.5 6"/></svg></button></p><button type="button" class="pill"><span class="pill-math">${drawn.equation(scene)}</span><small>${escaped(drawn.words.headline.type)}</small></button></div>`;
/** The words of the language in the marks {{…}}. */
const spoken = (html) => html.replace(/\{\{(\w+)\}\}/g, (mark, name) => {
  if (!Object.hasOwn(drawn.html, name)) throw new Error(`index.html wants ${mark}, which words/${language}/html.ts does not have`);
  return escaped(drawn.html[name]);
});
const template = put(put(spoken(await readFile(join(here, 'index.html'), 'utf8')), '<!-- picture -->', drawn.firstPictures(scene)), '<!-- words -->', words);
const early = closed(await bundle('early.ts', 'iife', {}));
const page = ({ script, style, hidden = [], element, connect, worker }) => {
  const policy = ["default-src 'none'", `script-src ${hash(early)} ${script} 'wasm-unsafe-eval'`, `style-src ${[style, ...hidden].map(hash).join(' ')}`, 'img-src data: blob:', 'font-src data:', `connect-src ${connect}`,
    `worker-src ${worker}`, "base-uri 'none'", "form-action 'none'"].join('; ');
  let html = put(template, '<!-- csp -->', `<meta http-equiv="Content-Security-Policy" content="${policy}">`);
  html = put(html, '<!-- style -->', `<style>${style}</style>`);
  html = put(html, '<!-- early -->', `<script>${early}</script>`);
  return put(html, '<!-- script -->', element);
};

await mkdir(out, { recursive: true });
const worker = await bundle('worker.ts', 'iife', {});
const whole = await bundle('main.ts', 'iife', single);
const boot = closed(await bundle('boot.ts', 'iife', {}));
const parts = { main: whole, core: wasm, worker, style: laterStyle, ...later };
const elements = [];
for (const [id, contents] of Object.entries(parts)) elements.push(`<script type="text/plain" id="packed-${id}">${await packed(contents)}</script>`);
elements.push(`<script>${boot}</script>`);
const files = {
  'motus.wasm': wasm, 'worker.js': worker, 'main.js': await bundle('main.ts', 'esm', hosted),
  'index.html': page({ script: "'self'", style: style + laterStyle, element: '<script type="module" src="main.js"></script>', connect: "'self'", worker: "'self'" }),
  'motus-lab.html': page({ script: `${hash(boot)} ${hash(whole)}`, style, hidden: [laterStyle], element: elements.join('\n'), connect: "'none'", worker: 'blob:' }),
};
for (const [name, contents] of Object.entries(files)) await writeFile(join(out, name), contents);
const size = (contents) => `${(Buffer.byteLength(contents) / 1000).toFixed(0)} KB`;
console.log(Object.entries(files).map(([name, contents]) => `${name} ${size(contents)}`).join(', ') + `; the module packed ${size(gzipSync(wasm, { level: 9 }))}`);
