/* The model as a book would set it: MathML from the core's own graph.
 *
 * Invariant: only elements of MathML enter the page, and none of their attributes can call or fetch anything.
 */
import type { Statement } from '../protocol';
import type { LiveStore } from '../state';
import { el } from '../dom';
import { words } from '../words';

const mathml = 'http://www.w3.org/1998/Math/MathML';

/** null: no well-formed <math>. */
export function math(source: string): Element | null {
  const parsed = new DOMParser().parseFromString(source, 'application/xml').documentElement;
  if (parsed.namespaceURI !== mathml || parsed.localName !== 'math') return null;
  for (const element of [parsed, ...parsed.querySelectorAll('*')]) {
    if (element.namespaceURI !== mathml) return null;
    for (const { name } of [...element.attributes]) if (/^on|href|src|style$/i.test(name)) element.removeAttribute(name);
  }
  return document.importNode(parsed, true);
}

/** Which statements are the equation itself; the rest waits behind a fold. */
const leading = new Set(['motion', 'first-order', 'exact', 'function']);

export function typesetView(store: LiveStore): HTMLElement {
  const equations = el('div', { class: 'equations' }), others = el('div', { class: 'equations' });
  const summary = el('summary', {}, words.editor.typeset.all);
  const fold = el('details', {}, summary, others);
  const element = el('section', { class: 'typeset', 'aria-label': words.editor.typeset.model }, equations, fold);

  const row = (statement: Statement): HTMLElement | null => {
    const formula = math(statement.mathml);
    return formula && el('div', { class: `equation ${statement.kind.replace(/[^a-z]/g, '')}` }, formula as Node);
  };
  // A formula wider than its place scrolls, and can then be reached by keyboard.
  const sizes = new ResizeObserver(entries => {
    for (const { target } of entries) {
      if (!(target instanceof HTMLElement)) continue;
      const wide = target.scrollWidth > target.clientWidth + 1;
      if (wide) target.tabIndex = 0; else target.removeAttribute('tabindex');
      if (wide) { target.setAttribute('role', 'group'); target.setAttribute('aria-label', words.editor.typeset.wide); } else { target.removeAttribute('role'); target.removeAttribute('aria-label'); }
    }
  });
  let shown = '';
  function show(): void {
    const statements = store.description?.statements ?? [];
    const key = statements.map(s => s.mathml).join('\n');
    if (key === shown) return;
    shown = key;
    sizes.disconnect();
    const first = statements.filter(s => leading.has(s.kind)), rest = statements.filter(s => !leading.has(s.kind));
    equations.replaceChildren(...(first.length ? first : statements).map(row).filter(r => r !== null));
    others.replaceChildren(...(first.length ? rest : []).map(row).filter(r => r !== null));
    fold.hidden = others.childElementCount === 0;
    for (const r of element.querySelectorAll('.equation')) sizes.observe(r);
  }
  store.subscribe(what => { if (what === 'description' || what === 'scene') show(); });
  return element;
}
