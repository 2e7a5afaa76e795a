/* Undo and redo of everything that an address can hold: controls, texts, views.
 *
 * Invariant: what is undone can be done again, until something else is changed. Changes that follow each other within PAUSE, as those of a dragged slider
 * do, are one. Inside a text field the keys are the field's own.
 */
import type { State } from '../scene';
import type { LiveStore } from '../state';
import { words } from '../words';
import { button, el, icon } from '../dom';

const PAUSE = 600, MOST = 200;

export function history(store: LiveStore): HTMLElement {
  const past: State[] = [], future: State[] = [];
  let present = store.state, last = -Infinity, ours = false;
  const undoButton = button('', () => go(past, future), { class: 'icon-button', 'aria-label': words.top.undo, title: words.top.undoKey, disabled: true }, icon('M8.5 6L4 10.5 8.5 15M4.5 10.5h9.5a5 5 0 0 1 0 10H11'), el('span', { class: 'menu-word' }, words.top.undo));

  function go(from: State[], to: State[]): void {
    const state = from.pop();
    if (!state) return;
    to.push(present);
    present = state;
    last = -Infinity;
    ours = true;
    store.load(state);
    ours = false;
    show();
  }
  function show(): void {
    undoButton.disabled = past.length === 0;
  }
  store.subscribe((what) => {
    if (ours || (what !== 'state' && what !== 'view') || store.state === present) return;
    const now = performance.now();
    if (now - last > PAUSE) past.push(present);
    if (past.length > MOST) past.shift();
    last = now;
    present = store.state;
    future.length = 0;
    show();
  });
  document.addEventListener('keydown', (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.defaultPrevented) return;
    const { target } = event, key = event.key.toLowerCase();
    if (target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && /text|search/.test(target.type))) return;
    if (key === 'z' && !event.shiftKey) go(past, future);
    else if (key === 'y' || (key === 'z' && event.shiftKey)) go(future, past);
    else return;
    event.preventDefault();
  });
  return undoButton;
}
