/* The places of the page: gallery, lessons, the equation; on phones the first of them, and all else behind a button. */
import { button, place } from '../dom';

export interface Spot { readonly label: string; readonly id: string; open(): void }
export function nav(places: readonly Spot[]): { current(id: string): void } {
  const buttons = places.map(({ label, id, open }) => ({ id, control: button(label, open, { class: 'nav-button', 'data-place': id }) }));
  // The first place is always in sight; the others are in the menu where there is no room for them.
  place('nav').append(...buttons.slice(0, 1).map((b) => b.control));
  place('nav-more').append(...buttons.slice(1).map((b) => b.control));
  const opener = place('menu-button'), menu = place('menu');
  const toggle = (open: boolean): void => { menu.classList.toggle('open', open); opener.setAttribute('aria-expanded', String(open)); };
  opener.addEventListener('click', () => toggle(!menu.classList.contains('open')));
  // What was chosen is under it.
  place('nav-more').addEventListener('click', () => toggle(false));
  menu.addEventListener('keydown', (event) => { if (event.key === 'Escape' && menu.classList.contains('open')) { toggle(false); opener.focus(); } });
  document.addEventListener('pointerdown', ({ target }) => { if (target instanceof Node && !menu.contains(target) && !opener.contains(target)) toggle(false); });
  return {
    current(id) { for (const b of buttons) { if (b.id === id) b.control.setAttribute('aria-current', 'true'); else b.control.removeAttribute('aria-current'); } },
  };
}
