/* The lecture: the whole screen, large letters (later.css), and a key for all that one does while speaking.
 *
 * Invariant: no key is taken from a text field, none that comes with Ctrl, Alt or ⌘; a browser that refuses the whole screen shows the same in its window.
 */
import { SEEK } from '../figure/cursor';
import type { LiveStore } from '../state';
import { button, el, icon } from '../dom';
import { words } from '../words';
import { short } from './number';

export const lecturing = (): boolean => document.body.classList.contains('lecture');

/** The button of the header; bar: what stands on the screen meanwhile. */
export function lecture(store: LiveStore): { readonly opener: HTMLElement; readonly bar: HTMLElement } {
  const help = el('div', { id: 'keys', class: 'sheet', popover: 'auto', role: 'group', 'aria-label': words.lecture.keys }, el('h2', {}, words.lecture.keys), el('dl', {}, ...words.lecture.list.flatMap(([key, what]) => [el('dt', {}, key), el('dd', {}, what)])));
  const opener = button('', () => turn(!lecturing()), { class: 'icon-button', 'aria-label': words.lecture.open, title: words.lecture.openTitle }, icon('M3 5h18v11H3zM12 16v4M8 20h8'), el('span', { class: 'menu-word' }, words.lecture.word));
  const bar = el('div', { class: 'lecture-bar' }, button('?', () => {}, { class: 'icon-button', 'aria-label': words.lecture.keysLabel, popovertarget: 'keys' }),
    button('', () => turn(false), { class: 'icon-button', 'aria-label': words.lecture.leave, title: words.lecture.leaveTitle }, icon('M6 6l12 12M18 6L6 18')), help);
  let full = false;

  function turn(on: boolean): void {
    if (on === lecturing()) return;
    if (on && store.state.place === 'gallery') store.go('');
    document.body.classList.toggle('lecture', on);
    scrollTo(0, 0);
    if (on) {
      if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
      document.documentElement.requestFullscreen?.().then(() => { full = true; }, () => { /* The window does as well. */ });
    } else {
      if (document.fullscreenElement) void document.exitFullscreen().catch(() => { /* It was left already. */ });
      full = false;
      help.hidePopover();
      opener.focus({ preventScroll: true });
    }
  }
  // Browsers keep the Escape that leaves the whole screen to themselves.
  document.addEventListener('fullscreenchange', () => { if (full && !document.fullscreenElement) turn(false); });
  // After a click Space belongs to the motion again.
  document.addEventListener('click', (event) => { if (lecturing() && event.detail > 0 && document.activeElement instanceof HTMLButtonElement) document.activeElement.blur(); });

  function scaleStep(by: number): void {
    const { numbers: { step, start, until }, description, state } = store, own = description?.settings.step;
    // What is typed may not have been computed yet.
    const now = state.step ? Number(state.step) || step : own ?? step, h = Number(((now ?? 0) * by).toPrecision(12));
    if (!(h > 0) || (until !== null && h > Math.abs(until - start))) return;
    store.change({ step: own && Math.abs(h - own) < 1e-9 * own ? '' : short(h, 12) });
  }
  /** Through the parts of a lesson; outside of one, through the motion. */
  function page(way: 1 | -1): void {
    const parts = [...document.querySelectorAll<HTMLElement>('.in-lesson .parts button')], at = parts.findIndex((part) => part.hasAttribute('aria-current'));
    if (at >= 0) (parts[at + way] ?? (way > 0 ? document.querySelector<HTMLElement>('.lesson > .primary') : null))?.click();
    else if (way < 0) document.dispatchEvent(new CustomEvent(SEEK, { detail: store.numbers.start }));
    else document.querySelector<HTMLElement>('.transport-play:not([data-playing])')?.click();
  }
  document.addEventListener('keydown', (event) => {
    const { key, target } = event;
    if (event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey || event.isComposing) return;
    if (target instanceof HTMLElement && (target.isContentEditable || target.closest('textarea, select, input:not([type=range]):not([type=checkbox]):not([type=radio])'))) return;
    if (key === 'l' || key === 'L') turn(!lecturing());
    else if (!lecturing()) return;
    else if (key === 'Escape') { if (document.querySelector(':popover-open')) return; turn(false); }
    else if (key === '?') help.togglePopover();
    else if (key === '[' || key === ']') scaleStep(key === '[' ? 0.5 : 2);
    else if (/^[1-9]$/.test(key)) document.querySelectorAll<HTMLElement>('#methods .chips .chip')[Number(key) - 1]?.click();
    else if (key === 'PageDown' || key === 'PageUp') page(key === 'PageDown' ? 1 : -1);
    else return;
    event.preventDefault();
  });
  return { opener, bar };
}
