/* Names of a model as an equation sets them: theta as θ, r.x as r with index x, primes as primes.
 *
 * Invariant: the letters are those that the core's MathML has for the same name (lang/typeset).
 */
import type { Said, Span } from './types';

const GREEK: Readonly<Record<string, string>> = {
  alpha: 'α', beta: 'β', gamma: 'γ', delta: 'δ', epsilon: 'ε', zeta: 'ζ', eta: 'η', theta: 'θ', iota: 'ι', kappa: 'κ', lambda: 'λ', mu: 'μ', nu: 'ν', xi: 'ξ', pi: 'π',
  rho: 'ρ', sigma: 'σ', tau: 'τ', upsilon: 'υ', phi: 'φ', chi: 'χ', psi: 'ψ', omega: 'ω',
  Gamma: 'Γ', Delta: 'Δ', Theta: 'Θ', Lambda: 'Λ', Xi: 'Ξ', Pi: 'Π', Sigma: 'Σ', Phi: 'Φ', Psi: 'Ψ', Omega: 'Ω',
};

/** The name of the time, the first column: t, unless the model says another. */
export const timeName = (solution: { readonly columns: readonly string[] }): string => solution.columns[0] ?? 't';

/** A name in italic letters, its index lowered. */
export function nameSpans(name: string, size: number): Span[] {
  const start = /^(.*?)(\(0\)(?:\.\w+)?)$/.exec(name);
  if (start) return [...nameSpans(start[1] ?? '', size), { text: start[2] ?? '', size }];
  const parts = /^([\p{L}_]+)(\d*)((?:\[[^\]]*\])?)('*)((?:\.\w+)?)('*)$/u.exec(name);
  if (!parts) return [{ text: name, italic: true, size }];
  const [, word = '', digits = '', bracket = '', primes = '', part = '', later = ''] = parts;
  const index = [digits, bracket.slice(1, -1), part.slice(1)].filter(Boolean).join(', ');
  const spans: Span[] = [{ text: GREEK[word] ?? word, italic: true, size }];
  const marks = '′'.repeat(primes.length + later.length);
  if (marks) spans.push({ text: marks, size });
  if (index) spans.push({ text: index, size: 0.72 * size, sunk: 0.22 * size, italic: !/^\d/.test(index) });
  return spans;
}
/** The same as plain text, where nothing can be lowered: r′.x, x[1]. */
export const nameText = (name: string): string => name.replace(/^[\p{L}_]+/u, (word) => GREEK[word] ?? word).replace(/'/g, '′');

/** A text with such names in it, as nodes of the page. */
export function saidNodes(said: Said): Node[] {
  if (typeof said === 'string') return [document.createTextNode(said)];
  return said.map((span) => {
    const text = document.createTextNode(span.text);
    if (!span.italic && !span.sunk) return text;
    const node = document.createElement(span.sunk ? 'sub' : 'i');
    if (span.sunk && !span.italic) node.className = 'upright';
    node.append(text);
    return node;
  });
}
export const saidText = (said: Said): string => (typeof said === 'string' ? said : said.map((span) => span.text).join(''));
