/* The card of a method, shown beside its picture: title, formula, two sentences, and what the catalogue says of it.
 *
 * Invariant: the facts are the catalogue's, never written twice; a method without a card of its own gets one from the catalogue's words.
 */
import { data } from '../data';
import type { Method } from '../protocol';
import { words } from '../words';

function element<K extends keyof HTMLElementTagNameMap>(tag: K, className: string, text = ''): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  if (className) made.className = className;
  made.textContent = text;
  return made;
}

/** Our own text, typeset when the page was built. */
function typeset(body: string): readonly Node[] {
  const parsed = new DOMParser().parseFromString(`<div xmlns="http://www.w3.org/1999/xhtml">${body}</div>`, 'application/xhtml+xml');
  return Array.from(parsed.documentElement.childNodes, node => document.importNode(node, true));
}

/** A heading: the card's own, or the catalogue's words. */
const methodTitle = (method: Method): string => data.cards[method.name]?.title ?? method.title.charAt(0).toUpperCase() + method.title.slice(1);

function limit(h: number): string {
  if (h === 0) return words.cards.never;
  if (!Number.isFinite(h)) return words.cards.always;
  return words.cards.below(String(Number(h.toPrecision(4))));
}

/** In a few words each. */
function facts(method: Method): string[] {
  if (method.order === 0) return [words.cards.exact];
  return [
    words.cards.order(String(method.order)),
    method.evaluations === 0 ? words.cards.implicit : words.cards.evaluations(method.evaluations),
    method.symplectic ? words.cards.symplectic : words.cards.notSymplectic,
    method.reversible ? words.cards.reversible : words.cards.notReversible,
    limit(method.stability_limit),
  ];
}

export function methodCard(method: Method): HTMLElement {
  const made = element('section', 'card');
  const title = element('h3', '', methodTitle(method));
  const own = data.cards[method.name];
  made.append(title);
  if (own) made.append(...typeset(own.body));
  else made.append(
    element('p', 'plain', method.formula.replace(/ {2,}/g, '\u2003')),
    element('p', '', method.use.replace(/\s+/g, ' ')));
  const list = element('ul', 'facts');
  for (const fact of facts(method)) list.append(element('li', '', fact));
  made.append(list);
  return made;
}
