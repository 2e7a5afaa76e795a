/* The theory and the methods' cards, typeset when the page is built: theory.html and cards.html in, HTML and XML with MathML out, and the math
 * font cut down to the characters in use.
 *
 * Invariant: what comes out has no style attribute and no script, is well formed, and every character of its formulas is in the font.
 */
import { readFile } from 'node:fs/promises';
import temml from 'temml';
import subsetFont from 'subset-font';

const read = name => readFile(new URL(name, import.meta.url), 'utf8');
const unescape = text => text.replaceAll('&lt;', '<').replaceAll('&gt;', '>').replaceAll('&amp;', '&');

/* Temml places displays, and the few rest of what it says in style attributes, by CSS below or by the browser anyway; a strict policy forbids the attributes. */
const KNOWN = /^(display:\s*(block|inline) math;?|math-depth:\s*\d;?|padding[^;]*;?|text-align:[^;]*;?|)$/;
function bare(mathml) {
  return mathml.replace(/ style="([^"]*)"/g, (_, style) => {
    for (const rule of style.split(';')) if (!KNOWN.test(rule.trim())) throw new Error(`a formula needs the style "${rule}"`);
    return '';
  });
}

function formula(tex, displayMode, xml) {
  const mathml = temml.renderToString(unescape(tex), { displayMode, xml, throwOnError: true, strict: true });
  return bare(mathml).replaceAll('&nbsp;', '\u00a0')
    // What the browser's own tables of operators and displays say as well.
    .replace(/ (fence|separator)="true"| class="tml-display"/g, '').replace(/ form="(prefix|postfix)"(?=[^>]*>[()]<)/g, '')
    .replace(/<mspace ([^>]*)><\/mspace>/g, xml ? '<mspace $1/>' : '$&');
}

/* A display in parts that may stand below each other on a narrow screen: set apart by \quad or \qquad, or one going on after \allowbreak. */
function display(tex, xml) {
  const found = [{ tex: '', on: false }];
  let depth = 0;
  for (const piece of tex.split(/(\\begin\b|\\end\b|\\left\b|\\right\b|\\q?quad\b|\\allowbreak\b|\\[{}]|[{}])/)) {
    if (depth === 0 && /^\\(q?quad|allowbreak)$/.test(piece)) { found.push({ tex: '', on: piece === '\\allowbreak' }); continue; }
    if (piece === '{' || piece === '\\begin' || piece === '\\left') depth++;
    if (piece === '}' || piece === '\\end' || piece === '\\right') depth--;
    found[found.length - 1].tex += piece;
  }
  return `<div class="formula">${found.map(part => `<span${part.on ? ' class="on"' : ''}>${formula((part.on ? '{}' : '') + part.tex.trim(), true, xml)}</span>`).join('')}</div>`;
}

function typeset(source, xml) {
  return source
    .replace(/<!--[\s\S]*?-->\s*/g, '')
    .replace(/\$\$([\s\S]*?)\$\$/g, (_, tex) => display(tex, xml))
    .replace(/\$([^$]+)\$([.,;:)’]*)/g, (_, tex, after) => {
      const math = formula(tex, false, xml);
      return after ? `<span class="unbroken">${math}${after}</span>` : math;
    });
}

/* What the core's own MathML may hold beside the formulas of this folder: letters that models use, digits, operators, marks. */
function alphabet() {
  let all = '';
  for (let c = 0x20; c < 0x7f; c++) all += String.fromCharCode(c);
  all += 'ΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΣΤΥΦΧΨΩαβγδεζηθικλμνξοπρςστυφχψωϑϕϵħ';
  for (let c = 0x1d434; c <= 0x1d467; c++) all += String.fromCodePoint(c);       // italic Latin; its h stands elsewhere
  for (let c = 0x1d6e2; c <= 0x1d71b; c++) all += String.fromCodePoint(c);       // italic Greek
  return all + 'ℎ±·×÷′″‴−∓√∛∑∫∂∇∞≈≠≤≥→⟹∧∨¬∈…⋯|‖⌊⌋⌈⌉⃗˙¨¯^~ˆ∘\u00a0';
}

/** range: of the characters that this face has for all formulas, whichever elements they stand in. */
async function face(family, path, text, note, range = '') {
  const font = await subsetFont(await readFile(new URL(`../node_modules/${path}`, import.meta.url)), text, { targetFormat: 'woff2', noHinting: true, preserveNameIds: [13, 14] });
  return `/* ${note} */\n@font-face { font-family: '${family}'; src: url(data:font/woff2;base64,${font.toString('base64')}) format('woff2'); font-display: block;${range && ` unicode-range: ${range};`} }\n`;
}

async function fonts(text) {
  return await face('STIX Two Math', '@fontsource/stix-two-math/files/stix-two-math-latin-400-normal.woff2', text,
    'STIX Two Math, in part. Copyright 2001-2021 The STIX Fonts Project Authors. SIL Open Font License 1.1, https://openfontlicense.org')
    // In that edition a prime is raised already, and raised once more, as a superscript, it would be a dot. These lie on the line. A rule of their own for
    // the elements that hold primes would do as well, but Firefox gives a script with a font of its own the size of what it stands at.
    + await face('Primes', 'temml/dist/Temml.woff2', '\u2032', 'The prime of KaTeX, by way of Temml. MIT license', 'U+2032');
}

/** html: the sections of the theory. cards: by method, title and body (XHTML). fontCss: the font, and theory.css. */
export async function theory() {
  const html = typeset(await read('theory.html'), false);
  const cards = {};
  for (const [, method, title, body] of (await read('cards.html')).matchAll(/<article data-method="([^"]+)" data-title="([^"]+)">\s*([\s\S]*?)\s*<\/article>/g))
    cards[method] = { title, body: typeset(body, true) };
  const text = [html, ...Object.values(cards).map(card => card.body)].join('');
  const used = text.match(/<math[\s\S]*?<\/math>/g).join('').replace(/<[^>]*>/g, '').replace(/&#x([0-9a-f]+);/gi, (_, hex) => String.fromCodePoint(parseInt(hex, 16)));
  return { html, cards, fontCss: await fonts([...new Set(alphabet() + unescape(used))].join('')) + await read('theory.css') };
}
