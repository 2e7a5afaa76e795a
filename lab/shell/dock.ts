/* The end of the dock: all values of the model in a sheet, the view, and the way to the pictures below. */
import type { LiveStore } from '../state';
import { button, el, icon } from '../dom';
import { endField } from './end';
import { sliders } from './sliders';

export function dockLinks(store: LiveStore, pin: HTMLElement, view: HTMLElement): HTMLElement {
  const sheet = el('div', { id: 'all-values', class: 'sheet', popover: 'auto', role: 'group', 'aria-label': 'All values' }, endField(store), sliders(store));
  return el('div', { class: 'links' },
    button('All values', () => {}, { class: 'quiet-button', popovertarget: 'all-values' }), sheet, pin, view,
    el('a', { class: 'quiet-button', href: '#looking' }, 'Look closer', icon('M6 9.5l6 6 6-6')));
}
