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
import { build } from 'esbuild';
import { theory } from './theory/typeset.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const argument = (name, otherwise) => {
  const at = process.argv.indexOf(name);
  return at > 0 ? process.argv[at + 1] : otherwise;
};
const out = resolve(argument('--out', join(here, '../build/lab')));
const wasm = await readFile(resolve(argument('--core', join(here, '../build/lab/core/motus.wasm'))));

const models = join(here, '../models');
const presets = await Promise.all((await readdir(models)).filter((name) => name.endsWith('.motus')).sort()
  .map(async (name) => ({ name: name.slice(0, -'.motus'.length), text: await readFile(join(models, name), 'utf8') })));
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
const core = new Core(compiled);
const lessonTexts = await Promise.all((await readdir(join(here, 'lessons'))).filter((name) => name.endsWith('.txt'))
  .map(async (name) => ({ name: `lab/lessons/${name}`, text: await readFile(join(here, 'lessons', name), 'utf8') })));
let lessons;
try {
  lessons = readLessons(lessonTexts, { models: presets.map(({ name }) => name), methods: core.catalogue(core.create()).map(({ name }) => name) });
} catch (e) {
  console.error(e.message);
  process.exit(1);
}

/** A text or bytes, packed into a script: what is only needed later, or by a worker. Zipped, then four bytes as five of 85 characters that no quoted string has
 * to escape; the first digit counts the bytes by which the last group was filled up. */
const packed = (contents) => {
  const zipped = gzipSync(contents, { level: 9 }), fill = -zipped.length & 3, whole = Buffer.concat([zipped, Buffer.alloc(fill)]);
  const digit = (n) => String.fromCharCode(n + 35 + (n > 24) + (n > 55));
  let out = digit(fill);
  for (let i = 0; i < whole.length; i += 4) for (let n = whole.readUInt32BE(i), unit = 85 ** 4; unit >= 1; n %= unit, unit /= 85) out += digit(Math.floor(n / unit));
  return `"${out}"`;
};
const unpacking = `
const digit = (text, i) => { const c = text.charCodeAt(i); return c - 35 - (c > 60) - (c > 92); };
const unpack = (text) => {
  const bytes = new DataView(new ArrayBuffer((text.length - 1) / 5 * 4));
  for (let i = 1, at = 0; i < text.length; at += 4) {
    let n = 0;
    for (const end = i + 5; i < end; i++) n = 85 * n + digit(text, i);
    bytes.setUint32(at, n);
  }
  return new Response(new Blob([new Uint8Array(bytes.buffer, 0, bytes.byteLength - digit(text, 0))]).stream().pipeThrough(new DecompressionStream('gzip')));
};
`;

/** Modules that exist in the build only. */
const virtual = (modules) => ({
  name: 'virtual',
  setup(b) {
    b.onResolve({ filter: /^virtual:/ }, ({ path }) => ({ path, namespace: 'virtual' }));
    b.onLoad({ filter: /.*/, namespace: 'virtual' }, ({ path }) => ({ contents: modules[path], loader: 'js', resolveDir: here }));
  },
});
const bundle = async (entry, format, modules) => {
  const { outputFiles } = await build({
    entryPoints: [join(here, entry)], bundle: true, minify: !process.argv.includes('--readable'), write: false, format, target: 'es2022', charset: 'utf8', legalComments: 'none', alias,
    plugins: [virtual({
      'virtual:data': `${unpacking} export default () => unpack(${packed(JSON.stringify({ presets, lessons: lessons.map(({ numbers, ...lesson }) => lesson), cards: made.cards, stagings: drawn.stagings, notes: drawn.notes, theory: made.html }))}).json();`,
      'virtual:thumbs': `${unpacking} export default () => unpack(${packed(JSON.stringify(thumbs))}).json();`, ...modules,
    })],
  });
  return outputFiles[0].text;
};

const hosted = `
export const coreModule = async () => {
  const answer = await fetch('motus.wasm');
  return answer.headers.get('content-type') === 'application/wasm' ? WebAssembly.compileStreaming(answer) : WebAssembly.compile(await answer.arrayBuffer());
};
export const createWorker = () => new Worker('worker.js');
`;
/* From disk a page may load nothing: module and worker are inside it. */
const single = (worker) => `${unpacking}
let address = '';
export const coreModule = async () => {
  const [module, script] = await Promise.all([unpack(${packed(wasm)}).arrayBuffer().then((bytes) => WebAssembly.compile(bytes)), unpack(${packed(worker)}).blob()]);
  address = URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
  return module;
};
export const createWorker = () => new Worker(address);
`;

const hash = (text) => `'sha256-${createHash('sha256').update(text, 'utf8').digest('base64')}'`;
/* A script element ends at the first "</script", whatever stands around it. */
const closed = (script) => script.replace(/<\/(script)/gi, '<\\/$1').replace(/<!--/g, '<\\!--');
const minify = async (css) => (await build({ stdin: { contents: css, loader: 'css' }, minify: true, write: false, bundle: false, target: 'es2022' })).outputFiles[0].text;
const put = (html, mark, value) => {
  if (html.split(mark).length !== 2) throw new Error(`index.html wants ${mark} once`);
  return html.replace(mark, () => value);
};

const sheets = ['style.css', 'figure/figure.css', 'panel/steps.css', 'shell/editor.css', 'shell/gallery.css'];
const style = await minify([made.fontCss, drawn.inkStyle(), ...await Promise.all(sheets.map((name) => readFile(join(here, name), 'utf8')))].join('\n'));
const words = `<div class="words-inner"><div class="words-head"><h1 id="scene-title">A thrown ball</h1></div><p id="scene-words">Green is how it really flies. The others are a computer’s answers, ten straight steps each.</p><p class="ask"><button type="button" class="ask-button"><span>${drawn.question(scene)}</span><svg viewBox="0 0 24 24" width="20" height="20" aria-hidden="true" focusable="false" class="icon"><path d="M5 12h13M12.5 6l5.5 6-5.5 6"/></svg></button></p><button type="button" class="pill"><span class="pill-math">${drawn.equation(scene)}</span><small>Type your own</small></button></div>`;
const template = put(put(await readFile(join(here, 'index.html'), 'utf8'), '<!-- picture -->', drawn.firstPictures(scene)), '<!-- words -->', words);
const page = ({ script, element, connect, worker }) => {
  const policy = ["default-src 'none'", `script-src ${script} 'wasm-unsafe-eval'`, `style-src ${hash(style)}`, 'img-src data: blob:', 'font-src data:', `connect-src ${connect}`,
    `worker-src ${worker}`, "base-uri 'none'", "form-action 'none'"].join('; ');
  let html = put(template, '<!-- csp -->', `<meta http-equiv="Content-Security-Policy" content="${policy}">`);
  html = put(html, '<!-- style -->', `<style>${style}</style>`);
  return put(html, '<!-- script -->', element);
};

await mkdir(out, { recursive: true });
const worker = await bundle('worker.ts', 'iife', {});
const main = await bundle('main.ts', 'esm', { 'virtual:host': hosted });
const all = closed(await bundle('main.ts', 'iife', { 'virtual:host': single(worker) }));
const files = {
  'motus.wasm': wasm, 'worker.js': worker, 'main.js': main,
  'index.html': page({ script: "'self'", element: '<script type="module" src="main.js"></script>', connect: "'self'", worker: "'self'" }),
  'motus-lab.html': page({ script: hash(all), element: `<script>${all}</script>`, connect: "'none'", worker: 'blob:' }),
};
for (const [name, contents] of Object.entries(files)) await writeFile(join(out, name), contents);
const size = (contents) => `${(Buffer.byteLength(contents) / 1000).toFixed(0)} KB`;
console.log(Object.entries(files).map(([name, contents]) => `${name} ${size(contents)}`).join(', ') + `; the module packed ${size(gzipSync(wasm, { level: 9 }))}`);
