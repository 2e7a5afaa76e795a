/* Short messages, spoken as well as shown. Invariant: none is the only place where something is said for good; each goes by itself, but waits
 * while the reader points at it or is inside it.
 */
import { button, el } from '../dom';
import { words } from '../words';

export interface Toasts { say(message: string, action?: { readonly label: string; act(): void }): void }

/** region: an element with role=status. */
export function createToasts(region: HTMLElement): Toasts {
  return {
    say(message, action) {
      while (region.childElementCount > 2) region.firstElementChild?.remove();
      const toast = el('div', { class: 'toast' }, el('span', {}, message));
      const close = (): void => { toast.remove(); };
      if (action) toast.append(button(action.label, () => { close(); action.act(); }, { class: 'text-button' }));
      toast.append(button('', close, { class: 'icon-button', 'aria-label': words.top.dismiss }, '×'));
      let timer = 0;
      const start = (): void => { window.clearTimeout(timer); timer = window.setTimeout(close, action ? 12000 : 6000); };
      const stay = (): void => { window.clearTimeout(timer); };
      toast.addEventListener('pointerenter', stay);
      toast.addEventListener('focusin', stay);
      toast.addEventListener('pointerleave', start);
      toast.addEventListener('focusout', start);
      region.append(toast);
      start();
    },
  };
}
