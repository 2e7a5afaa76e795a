/* What sliders have set goes into the text of one's own model, once the hand rests; of an example it stays beside the text, and is told there.
 *
 * Invariant: while a slider is held the text keeps still, so a drag costs no more than its picture. A number that the text computes from others stays set.
 */
import { exampleOf } from '../data';
import type { LiveStore } from '../state';
import { button, el, say } from '../dom';
import { words } from '../words';
import { tuple } from './number';
import { written } from './write';

const REST = 500;

/** The text with all that is set written into it, and what could not be written. */
function settledText(store: LiveStore): { readonly text: string; readonly set: Readonly<Record<string, string>>; readonly step: string; readonly until: string } | null {
  const { state, description } = store;
  if (!description || store.trouble.model) return null;
  let { text, step, until } = state;
  const left: Record<string, string> = {};
  for (const [name, expression] of Object.entries(state.set)) {
    const values = tuple(expression)?.parts ?? [expression];
    let next: string | null = text;
    values.forEach((value, k) => { next = next === null ? null : written(next, description, name, value, k); });
    if (next === null) left[name] = expression; else text = next;
  }
  for (const key of ['step', 'until'] as const) {
    const value = key === 'step' ? step : until, next = value ? written(text, description, key, value) : null;
    if (next === null) continue;
    text = next;
    if (key === 'step') step = ''; else until = '';
  }
  return { text, set: left, step, until };
}

/** The note under the editor: what is set beside the text. */
export function settle(store: LiveStore): HTMLElement {
  const told = el('span', {}), take = button(words.editor.take, () => write(), { class: 'text-button' });
  const note = el('p', { class: 'overrides quiet', hidden: true }, told, ' ', take);
  let timer = 0, pressed = false;
  const own = (): boolean => exampleOf(store.state) === '';
  function write(): void {
    const next = settledText(store);
    if (next && next.text !== store.state.text) store.change(next);
  }
  function rest(): void {
    window.clearTimeout(timer);
    timer = window.setTimeout(() => {
      if (pressed) { rest(); return; }
      // A lesson asks for what is set; its scene stays the example.
      if (own() && !store.state.place.includes('.')) write();
    }, REST);
  }
  for (const [kind, down] of [['pointerdown', true], ['pointerup', false], ['pointercancel', false]] as const) {
    document.addEventListener(kind, () => { pressed = down; }, { capture: true });
  }
  store.subscribe((what) => {
    if (what !== 'state' && what !== 'scene') return;
    const { set, step, until } = store.state;
    const set_ = [...Object.entries(set).map(([name, value]) => `${name} = ${value}`), ...(step ? [`step ${step}`] : []), ...(until ? [`until ${until}`] : [])];
    note.hidden = set_.length === 0 || own();
    say(told, note.hidden ? '' : words.editor.replaced(set_));
    if (set_.length && own() && what === 'scene') rest();
  });
  return note;
}
