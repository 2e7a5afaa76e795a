/* Which panels are open. Invariant: view.panels names them, in the order in which they stand; the order is that of the page, not of the clicks. */
import type { LiveStore } from '../state';
import { button, el } from '../dom';

export interface PanelName { readonly id: string; readonly title: string }

export function panelPicker(store: LiveStore, panels: readonly PanelName[]): HTMLElement {
  const buttons = panels.map(({ id, title }) => {
    const control = button(title, () => {
      const open = new Set(store.state.view.panels);
      if (!open.delete(id)) open.add(id);
      store.look({ panels: panels.map(p => p.id).filter(p => open.has(p)) });
    }, { class: 'chip', 'aria-pressed': 'false' });
    return { id, control };
  });
  const show = (): void => { for (const { id, control } of buttons) control.setAttribute('aria-pressed', String(store.state.view.panels.includes(id))); };
  store.subscribe(what => { if (what === 'view' || what === 'state') show(); });
  show();
  return el('div', { class: 'panel-picker', role: 'group', 'aria-label': 'Panels' }, ...buttons.map(b => b.control));
}
