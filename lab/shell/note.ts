/* What to try on an example, and what to see: above the pictures that look closer.
 *
 * Invariant: what is said of an example holds for its own text only.
 */
import { data, exampleOf } from '../data';
import type { LiveStore } from '../state';
import { presetState } from '../share';
import { button, el } from '../dom';
import { presets } from './presets';

export function note(store: LiveStore): HTMLElement {
  const element = el('div', { class: 'note', hidden: true });
  let shown = '';
  store.subscribe((what) => {
    if (what !== 'state' && what !== 'scene') return;
    const name = exampleOf(store.state);
    if (name === shown) return;
    shown = name;
    const written = Object.hasOwn(data.notes, name) ? data.notes[name] ?? [] : [];
    const part = (of: string | { readonly to: string; readonly label: string }): string | Node => (typeof of === 'string' ? of
      : button(of.label, () => { store.load(presetState(presets, of.to)); scrollTo(0, 0); }, { class: 'text-button' }));
    // One paragraph, however it is written down.
    element.replaceChildren(el('p', {}, ...written.flatMap((piece, k) => [...(k ? [' '] : []), ...(typeof piece === 'string' ? [piece] : piece.map(part))])));
    element.hidden = written.length === 0;
  });
  return element;
}
