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
import { theory, theoryPlugin } from './theory/typeset.mjs';

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
    entryPoints: [join(here, entry)], bundle: true, minify: !process.argv.includes('--readable'), write: false, format, target: 'es2022', charset: 'utf8', legalComments: 'none',
    // Its sources, so that what is not used falls away.
    alias: { 'ml-matrix': join(here, 'node_modules/ml-matrix/src/index.js') },
    plugins: [theoryPlugin(made), virtual({ 'virtual:presets': `export default ${JSON.stringify(presets)}`, ...modules })],
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
const single = (worker) => `
const packed = ${JSON.stringify(gzipSync(wasm, { level: 9 }).toString('base64'))};
export const coreModule = async () => {
  const bytes = Uint8Array.from(atob(packed), (c) => c.charCodeAt(0));
  return WebAssembly.compile(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer());
};
let address = '';
export const createWorker = () => new Worker(address ||= URL.createObjectURL(new Blob([${JSON.stringify(worker)}], { type: 'text/javascript' })));
`;

const hash = (text) => `'sha256-${createHash('sha256').update(text, 'utf8').digest('base64')}'`;
/* A script element ends at the first "</script", whatever stands around it. */
const closed = (script) => script.replace(/<\/(script)/gi, '<\\/$1').replace(/<!--/g, '<\\!--');
const minify = async (css) => (await build({ stdin: { contents: css, loader: 'css' }, minify: true, write: false, bundle: false, target: 'es2022' })).outputFiles[0].text;
const put = (html, mark, value) => {
  if (html.split(mark).length !== 2) throw new Error(`index.html wants ${mark} once`);
  return html.replace(mark, () => value);
};

const sheets = ['style.css', 'figure/figure.css', 'shell/transport.css', 'shell/editor.css', 'panel/steps.css'];
const style = await minify([made.fontCss, ...await Promise.all(sheets.map((name) => readFile(join(here, name), 'utf8')))].join('\n'));
const template = put(await readFile(join(here, 'index.html'), 'utf8'), '<!-- theory -->', made.html);
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
