/* What to try on an example, and what to see: above the pictures that look closer. Where no lesson answers the question that the stage asks, the note does,
 * under that question.
 *
 * Invariant: what is said of an example holds for its own text only, and its numbers for its own values.
 */
import { data, exampleOf, stagingOf } from '../data';
import type { LiveStore } from '../state';
import { presetState } from '../share';
import { saidOf } from '../scenes';
import { button, el, place } from '../dom';
import { words } from '../words';
import { presets } from './presets';
import type { Note, NoteLink } from '../words/note';

/** To the answer of the question on the stage. */
export function toNote(): void {
  place('looking').scrollIntoView();
  place('scene-note').querySelector('h3')?.focus({ preventScroll: true });
}

/** A number and its unit stay on one line. */
const bound = (text: string): string => text.replace(/(\d) (?=(?:[ck]?m|mm|s|ns|au|kg|%)(?![\p{L}\d]))/gu, '$1\u00a0');

export function note(store: LiveStore): HTMLElement {
  const element = el('div', { class: 'note', hidden: true });
  let shown = '';
  store.subscribe((what) => {
    if (what !== 'state' && what !== 'scene') return;
    const name = exampleOf(store.state), moved = name !== '' && Object.keys(store.state.set).length > 0, key = `${name} ${moved}`;
    if (key === shown) return;
    shown = key;
    const of = (notes: typeof data.notes): Note => (Object.hasOwn(notes, name) ? notes[name] ?? [] : []), own = of(data.notes), written = moved && own.length ? of(data.movedNotes) : own;
    const away = moved && own.length && !written.length ? [`${words.headline.answered} `, button(words.headline.values, () => { store.change({ set: {} }); }, { class: 'text-button' })] : [];
    const follow = (of: NoteLink): void => {
      if ('to' in of) store.load(presetState(presets, of.to)); else store.change('step' in of ? { step: of.step } : { until: of.until });
      scrollTo(0, 0);
    };
    const part = (of: string | NoteLink): string | Node => (typeof of === 'string' ? bound(of) : button(bound(of.label), () => follow(of), { class: 'text-button' }));
    // One paragraph, however it is written down.
    const answers = stagingOf(name).ask ? [] : [el('h3', { tabindex: -1 }, saidOf(name)?.question ?? '')];
    element.replaceChildren(...answers, el('p', {}, ...away, ...written.flatMap((piece, k) => [...(k ? [' '] : []), ...(typeof piece === 'string' ? [bound(piece)] : piece.map(part))])));
    element.hidden = own.length === 0;
  });
  return element;
}
