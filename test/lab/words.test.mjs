/* The texts of the page stand in lab/words/, and nowhere else. Run by `node --test`; TypeScript is taken apart here, as its compiler has no such call.
 *
 * Law: no literal outside of lab/words/ reads like something that a reader is to read, and nothing in lab/words/ is said by nobody.
 */
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';

const lab = fileURLToPath(new URL('../../lab/', import.meta.url));
const { buildSync } = createRequire(join(lab, 'package.json'))('esbuild');
const built = buildSync({ entryPoints: [join(lab, 'words/index.ts')], bundle: true, format: 'esm', write: false, target: 'es2022' });
const spoken = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));

const files = ['.', 'figure', 'lessons', 'panel', 'panel/steps', 'shell', 'stage', 'theory'].flatMap((folder) => readdirSync(join(lab, folder)).filter((name) => name.endsWith('.ts')).map((name) => join(folder, name)));
const sources = new Map(files.map((name) => [name, readFileSync(join(lab, name), 'utf8')]));

/* The literals of a source ------------------------------------------------------------------------------------------ */

/** What stands in for a value inside a template. */
const HOLE = '\uFFFC';
/** A slash after these begins a regular expression; after a name, a number or a closing bracket it divides. */
const BEFORE_REGEXP = /(?:^|[=(,:;!&|?{}[+\-*%<>~^]|\b(?:return|typeof|case|in|of))\s*$/;

/** Every string and template: its text, what stands before it, its line. A template's values are holes; literals inside of them are listed too. */
function literals(source) {
  const found = [];
  let at = 0;
  const lineOf = (index) => source.slice(0, index).split('\n').length;
  const escaped = () => { const raw = source.slice(at, at + 2); at += 2; return raw === '\\n' ? '\n' : raw === '\\\n' ? '' : raw[1]; };
  function quoted(mark) {
    const from = at++;
    let text = '';
    while (at < source.length && source[at] !== mark) text += source[at] === '\\' ? escaped() : source[at++];
    at++;
    found.push({ text, before: source.slice(Math.max(0, from - 80), from), line: lineOf(from) });
  }
  function template() {
    const from = at++;
    let text = '';
    while (at < source.length && source[at] !== '`') {
      if (source[at] === '\\') text += escaped();
      else if (source.startsWith('${', at)) { at += 2; code('}'); text += HOLE; } else text += source[at++];
    }
    at++;
    found.push({ text, before: source.slice(Math.max(0, from - 80), from), line: lineOf(from) });
  }
  function regexp() {
    for (let inClass = false; ;) {
      const c = source[++at];
      if (c === '\\') at++;
      else if (c === '[') inClass = true;
      else if (c === ']') inClass = false;
      else if ((c === '/' && !inClass) || c === '\n' || c === undefined) break;
    }
    at++;
  }
  function code(end) {
    for (let depth = 0; at < source.length; ) {
      const c = source[at];
      if (source.startsWith('//', at)) { while (at < source.length && source[at] !== '\n') at++; } else if (source.startsWith('/*', at)) at = source.indexOf('*/', at) + 2;
      else if (c === '\'' || c === '"') quoted(c);
      else if (c === '`') template();
      else if (c === '/' && BEFORE_REGEXP.test(source.slice(Math.max(0, at - 20), at))) regexp();
      else {
        if (c === '{') depth++;
        if (c === '}' && depth-- === 0 && end) { at++; return; }
        at++;
      }
    }
  }
  code('');
  return found;
}

test('a source is taken apart: comments, strings, templates within templates, regular expressions', () => {
  const of = (source) => literals(source).map(({ text }) => text);
  assert.deepEqual(of("const a = 'it\\'s'; // 'no'\n/* 'no' */ b = \"“\"; c = a / 2 / 'x'.length;"), ["it's", '“', 'x']);
  assert.deepEqual(of('d = `a ${e ? `in ${f}` : { g: "h" }.g} z`; i = `}`'), [`in ${HOLE}`, 'h', `a ${HOLE} z`, '}']);
  assert.deepEqual(of("x.replace(/['\"`/]/g, 'r').match(/\\/'/); return /'/.test(y) ? 's' : 't'"), ['r', 's', 't']);
});

/* What reads like a reader's text ----------------------------------------------------------------------------------- */

/** One word, or a value, and a word after it. */
const SENTENCE = new RegExp(`(?:^|[\\s“(])(?:\\p{L}{2,}|${HOLE})[,;:.!?…’”]? \\p{L}{2,}(?=$|[\\s,;:.!?…’”)])`, 'u');
const CAPITALISED = /(?:^|[\s“(])\p{Lu}\p{Ll}+(?=$|[\s,;:.!?…’”)])/u;
const LETTERS = /\p{L}{2}/u;
/** Where a reader reads: whatever letters stand here are a text. */
const READ = /(?:(?:'aria-(?:label|valuetext|description|roledescription)'|\b(?:title|placeholder|label|caption|head)):\s*\[?|\.(?:textContent|title|placeholder)\s*=\s*|setAttribute\('aria-(?:label|valuetext|roledescription)',\s*|\b(?:say|button|pen\.text)\((?:[^()'`]*,\s*)?|new Option\()$/;

/** What stands here is no text: classes, selectors, what a programmer meets. */
const NAMES = [/(?:\b(?:class|d|viewBox)|'data-[a-z]+'): (?:[^,'`{}]*\? )?$/, /(?:querySelector(?:All)?|closest|matches|matchMedia)(?:<[^>]*>)?\($/, /\bnew Error\($/];
/** Each with its reason. */
const EXCEPTIONS = [
  // Keys of the keyboard, as events name them.
  [/./, /^(?:Arrow(?:Left|Right|Up|Down)|Home|End|Page(?:Up|Down)|Escape|Enter|Tab)$/],
  // Fields of the address.
  // Kinds of files, as the whole world calls them.
  [/./, /^(?:PNG|SVG|CSV|WebM)$/],
  // The lines of a C program.
  [/^program\.ts$/, /^\/\* cc |^static const |^    definition\./],
  // A colour.
  [/^panel\/planepicture\.ts$/, /^color-mix\(/],
  // Names of fonts.
  [/^figure\/shapes\.ts$/, /"Segoe UI"/],
  // What the build says when it fails.
  [/^thumbs\.ts$/, /^no motion$/],
];
const isName = ({ before }) => NAMES.some((pattern) => pattern.test(before.split('\n').at(-1)));

function readersTexts(name, source) {
  return literals(source)
    .filter((literal) => (SENTENCE.test(literal.text) || CAPITALISED.test(literal.text) || (READ.test(literal.before.split('\n').at(-1)) && LETTERS.test(literal.text.replaceAll(HOLE, '')))) && !isName(literal))
    .filter(({ text }) => !EXCEPTIONS.some(([file, exception]) => file.test(name) && exception.test(text)))
    .map(({ text, line }) => `${name}:${line}: ${JSON.stringify(text.slice(0, 90))}`);
}

test('no text for a reader stands outside of lab/words/', () => {
  const found = [...sources].flatMap(([name, source]) => readersTexts(name, source));
  assert.deepEqual(found, [], `\n${found.join('\n')}\n`);
});

test('every exception is one', () => {
  const all = [...sources].flatMap(([name, source]) => literals(source).map(({ text }) => [name, text]));
  for (const [file, exception] of EXCEPTIONS) assert.ok(all.some(([name, text]) => file.test(name) && exception.test(text)), `${file} ${exception}`);
});

test('index.html holds no text of its own but the name of the program', () => {
  const html = readFileSync(join(lab, 'index.html'), 'utf8').replace(/<!--[^]*?-->/g, '');
  const texts = [...html.matchAll(/>([^<]+)</g), ...html.matchAll(/ (?:aria-label|title|alt|placeholder)="([^"]*)"/g), ...html.matchAll(/<meta name="description" content="([^"]*)"/g), ...html.matchAll(/<html lang="([^"]*)"/g)];
  const left = texts.map(([, text]) => text.replace(/\{\{\w+\}\}/g, '').trim()).filter((text) => LETTERS.test(text));
  assert.deepEqual(left, ['motus', 'lab', 'motus']);
});

/* What is said by nobody -------------------------------------------------------------------------------------------- */

/** All that can be said, by its path: "words.dock.all". An array is one text. */
function leaves(of, path) {
  return typeof of === 'object' && of !== null && !Array.isArray(of) ? Object.entries(of).flatMap(([name, value]) => leaves(value, [...path, name])) : [{ path: path.join('.'), value: of }];
}
const said = Object.entries(spoken).flatMap(([name, part]) => leaves(part, [name]));

/** Paths that the sources name, through `const own = words.panel.error` too; of html, those that the page and the build name. */
function named() {
  const found = new Set();
  for (const source of [...sources.values(), readFileSync(join(lab, 'build.mjs'), 'utf8')]) {
    const roots = new Map([...Object.keys(spoken), 'drawn.words', 'drawn.html'].map((root) => [root, root.replace('drawn.', '')]));
    // A part that gets a name of its own is not said by that.
    const rest = source.replace(/\b(\w+) = ((?:words|computed|faults)(?:\.\w+)+)(?=[,;])/g, (all, own, path) => {
      if (said.some((leaf) => leaf.path === path)) return all;
      roots.set(own, path);
      return own;
    });
    for (const [own, path] of roots) {
      // After three dots, but not after one.
      for (const [, more] of rest.matchAll(new RegExp(`(?<![\\w$]|(?<!\\.\\.)\\.)${own.replace('.', '\\.')}((?:\\??\\.\\w+)+|(?=\\[))`, 'g'))) found.add(path + more.replaceAll('?.', '.'));
    }
  }
  for (const [, name] of readFileSync(join(lab, 'index.html'), 'utf8').matchAll(/\{\{(\w+)\}\}/g)) found.add(`html.${name}`);
  return found;
}

test('nothing in lab/words/ is said by nobody', () => {
  const used = named();
  // Where its path stands, and perhaps a method of it; or where one of a part is chosen, or the part is given away.
  const isUsed = (path) => [...used].some((other) => path === other || other.startsWith(`${path}.`) || (path.startsWith(`${other}.`) && other.includes('.')));
  assert.deepEqual(said.filter(({ path }) => !isUsed(path) && !/^(?:words\.scenes|notes|movedNotes)\./.test(path)).map(({ path }) => path), []);
  // Looked up by the name of their model.
  const models = readdirSync(join(lab, '../models')).map((name) => name.replace('.motus', ''));
  assert.ok([...used].includes('words.scenes') && Object.keys({ ...spoken.words.scenes, ...spoken.notes, ...spoken.movedNotes }).every((name) => models.includes(name)));
});

/** A value that is a text, a number and a list of texts. */
const anything = (text) => Object.assign(new String(text), { join: (between) => [text, text].join(between), map: (each) => [text, text].map(each), filter: () => [text, text] });

test('what is said is a sentence, whatever stands in it', () => {
  for (const { path, value } of said) {
    const answers = typeof value === 'function' ? [[anything('7')], [anything('1')], ['']].map(([argument]) => {
      try { return value(...Array.from({ length: value.length }, () => argument)); } catch { return value(...Array.from({ length: value.length }, () => [])); }
    }) : [value];
    for (const answer of answers) {
      const text = [answer].flat(2).map((part) => part.label ?? part).join(' ');
      // A part of a note may be a button to another example.
      assert.ok([answer].flat(2).every((part) => typeof part === 'string' || part instanceof String || typeof part.label === 'string'), `${path} says no text`);
      assert.doesNotMatch(text, /undefined|\[object|NaN|\bnull\b/, path);
    }
    assert.notEqual([answers[0]].flat(2).join('').trim(), '', path);
  }
  assert.ok(said.length > 300, `${said.length}`);
});
