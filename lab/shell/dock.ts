/* The end of the dock: all values of the model in a sheet, the view, and the way to the pictures below. */
import type { LiveStore } from '../state';
import { button, el, icon } from '../dom';
import { eventful } from '../protocol';
import { words } from '../words';
import { endField } from './end';
import { sliders } from './sliders';
import type { Toasts } from './toasts';

/** A link to what stands below; lessons hear that it was followed. */
function leads(label: string, href: string, what: string, ...more: Node[]): HTMLElement {
  const link = el('a', { class: 'quiet-button', href }, label, ...more);
  link.addEventListener('click', () => document.dispatchEvent(new CustomEvent('motus-opened', { detail: what })));
  return link;
}

export function dockLinks(store: LiveStore, toasts: Toasts, pin: HTMLElement, view: HTMLElement): HTMLElement {
  // The core opens no step that events divide. The button can still be reached, since it says why.
  const divided = (): boolean => store.description !== null && eventful(store.description);
  const step = button(words.dock.oneStep, () => { if (divided()) toasts.say(words.dock.divided); else store.go('step'); }, { class: 'quiet-button', id: 'open-step' });
  const why = el('span', { id: 'open-step-why', hidden: true }, words.dock.divided);
  store.subscribe((what) => {
    if (what !== 'scene' && what !== 'description') return;
    for (const [name, value] of [['aria-disabled', 'true'], ['aria-describedby', why.id], ['title', words.dock.divided]] as const) if (divided()) step.setAttribute(name, value); else step.removeAttribute(name);
  });
  const sheet = el('div', { id: 'all-values', class: 'sheet', popover: 'auto', role: 'group', 'aria-label': words.dock.all }, endField(store), sliders(store));
  return el('div', { class: 'links' },
    button(words.dock.all, () => {}, { class: 'quiet-button', popovertarget: 'all-values' }), sheet, pin, view,
    step, why, leads(words.dock.closer, '#looking', 'closer', icon('M6 9.5l6 6 6-6')));
}
