/* The end of the run, as a field. Invariant: what it shows is what the reader typed; what is wrong with it is said under it, and the last good picture stays. */
import type { LiveStore } from '../state';
import { button, el, icon, say } from '../dom';
import { words } from '../words';
import { compact, normal, short } from './number';

export function endField(store: LiveStore): HTMLElement {
  const field = el('input', { id: 'until', type: 'text', inputmode: 'text', autocomplete: 'off', spellcheck: 'false', class: 'number', 'aria-describedby': 'until-message' });
  const message = el('p', { id: 'until-message', class: 'message', role: 'status' });
  const reset = button('', () => { store.change({ until: '' }); empty = ''; field.focus(); refresh(true); }, { class: 'icon-button reset', 'aria-label': words.dock.end.reset }, icon('M5 12a7 7 0 1 1 2 5M5 18v-5h5'));
  const element = el('div', { class: 'row' }, el('label', { for: 'until' }, words.dock.end.label), el('span', {}), field, reset, message);
  let empty = '';
  const own = (): string => {
    const value = store.description?.settings.until;
    return value === null || value === undefined ? '' : short(value, 15);
  };
  function refresh(force = false): void {
    const { state, trouble } = store;
    if (force || document.activeElement !== field) { field.value = state.until || (own().length > 9 ? compact(Number(own())) : own()); empty = ''; }
    const wrong = empty || trouble.until;
    say(message, wrong);
    field.setAttribute('aria-invalid', String(wrong !== ''));
    reset.classList.toggle('shown', state.until !== '');
    reset.disabled = state.until === '';
  }
  field.addEventListener('input', () => {
    const text = normal(field.value);
    empty = text ? (text.length > 200 ? words.dock.long : '') : words.dock.end.needed(own());
    if (empty) refresh(); else store.change({ until: text === own() ? '' : text });
  });
  field.addEventListener('focus', () => { if (!store.state.until) { field.value = own(); field.select(); } });
  field.addEventListener('blur', () => refresh());
  store.subscribe((what) => { if (what !== 'view' && what !== 'busy') refresh(); });
  return element;
}
