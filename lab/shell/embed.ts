/* The page inside another page: the picture, Play, the time, the sliders that the address chooses, and a link to the whole page.
 * Invariant: it writes nothing into the browser's memory or the address, and nothing moves by itself.
 */
import { el } from '../dom';
import { words } from '../words';
import type { State } from '../scene';
import type { Presets } from '../share';
import type { LiveStore } from '../state';
import { escape } from '../figure/svg';
import { addressOf } from './address';

/** The state as the whole page shows it. */
export const whole = ({ embed: _, ...state }: State): State => state;

export function embedded(store: LiveStore, presets: Presets): HTMLElement {
  const link = el('a', { class: 'embed-link', target: '_blank', rel: 'noopener' }, words.top.whole);
  document.body.classList.add('embedded');
  document.body.classList.toggle('embed-step', Boolean(store.state.embed?.includes('step')));
  const fill = (): void => { link.href = addressOf(whole(store.state), presets) || location.href.replace(/#.*$/s, ''); };
  store.subscribe((what) => { if (what === 'state' || what === 'view') fill(); });
  fill();
  return link;
}

/** What to write into another page. */
export const snippet = (address: string, title: string): string => `<iframe src="${escape(address).replaceAll('&#38;', '&amp;')}" title="${escape(title)}" width="720" height="480" loading="lazy"></iframe>`;
