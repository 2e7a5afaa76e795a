/* The places of the page: gallery, lessons, the equation. */
import { button, el } from '../dom';

export interface Place { readonly label: string; readonly id: string; open(): void }
export function nav(places: readonly Place[]): { readonly element: HTMLElement; current(id: string): void } {
  const buttons = places.map(({ label, id, open }) => ({ id, control: button(label, open, { class: 'nav-button', 'data-place': id }) }));
  return {
    element: el('div', { class: 'nav' }, ...buttons.map((b) => b.control)),
    current(id) { for (const b of buttons) { if (b.id === id) b.control.setAttribute('aria-current', 'true'); else b.control.removeAttribute('aria-current'); } },
  };
}
