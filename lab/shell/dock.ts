/* The end of the dock: all values of the model in a sheet, the view, and the way to the pictures below. */
import type { LiveStore } from '../state';
import { button, el, icon } from '../dom';
import { eventful } from '../protocol';
import { words } from '../words';
import { endField } from './end';
import { sliders } from './sliders';

/** A link to what stands below; lessons hear that it was followed. */
function leads(label: string, href: string, what: string, ...more: Node[]): HTMLElement {
  const link = el('a', { class: 'quiet-button', href }, label, ...more);
  link.addEventListener('click', () => document.dispatchEvent(new CustomEvent('motus-opened', { detail: what })));
  return link;
}

export function dockLinks(store: LiveStore, pin: HTMLElement, view: HTMLElement): HTMLElement {
  const step = button(words.dock.oneStep, () => store.go('step'), { class: 'quiet-button', id: 'open-step' });
  // The core opens no step that events divide.
  store.subscribe((what) => {
    if (what !== 'scene' && what !== 'description') return;
    step.disabled = store.description !== null && eventful(store.description);
    step.title = step.disabled ? words.dock.divided : '';
  });
  const sheet = el('div', { id: 'all-values', class: 'sheet', popover: 'auto', role: 'group', 'aria-label': words.dock.all }, endField(store), sliders(store));
  return el('div', { class: 'links' },
    button(words.dock.all, () => {}, { class: 'quiet-button', popovertarget: 'all-values' }), sheet, pin, view,
    step, leads(words.dock.closer, '#looking', 'closer', icon('M6 9.5l6 6 6-6')));
}
