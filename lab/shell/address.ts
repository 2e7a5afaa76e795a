/* The state in the address bar and in the browser's memory.
 *
 * Invariant: the address always holds the state, as data (share.ts); what the page starts with is, in this order, the address, what was left at the
 * last visit, what `motus lab` wrote into the page, the first example.
 */
import { decode, encode, longest, presetState, type Presets } from '../share';
import type { State } from '../scene';
import type { LiveStore } from '../state';
import { loadedAgain, recall, remember } from './memory';
import type { Toasts } from './toasts';

const pause = 400;                        // milliseconds: browsers refuse addresses that change too often
const keptLimit = 4 * 1024 * 1024;

const written = (): string => document.querySelector<HTMLMetaElement>('meta[name="motus-start"]')?.content ?? '';

/** A visit is remembered for the page that `motus lab` wrote: another model is another page. */
function left(): string | null {
  const kept = recall('state'), at = kept?.indexOf('\n') ?? -1;
  return kept !== null && at >= 0 && kept.slice(0, at) === written() ? kept.slice(at + 1) : null;
}

export function startState(presets: Presets): { readonly state: State; readonly problem: string } {
  if (location.hash.includes('=')) return decode(location.hash, presets);
  const before = left();
  if (before !== null) {
    const found = decode(before, presets, keptLimit);
    if (!found.problem) return found;
  }
  return written() ? decode(written(), presets) : { state: presetState(presets, presets.first), problem: '' };
}

/** The address of the state, or '' where it would be too long. */
export function addressOf(state: State, presets: Presets): string {
  const fragment = encode(state, presets);
  return fragment.length > longest ? '' : location.href.replace(/#.*$/s, '') + '#' + fragment;
}

export function followAddress(store: LiveStore, presets: Presets, toasts: Toasts): void {
  let timer = 0, known = location.href, { preset, place } = store.state;
  const { embed } = store.state;
  const write = (): void => {
    window.clearTimeout(timer);
    timer = 0;
    // A link was followed whose event is still to come: the address is the newer state.
    if (location.href !== known) { known = location.href; timer = window.setTimeout(write, pause); return; }
    remember('state', written() + '\n' + encode(store.state, presets));
    // An address of an older state would win over the memory at the next visit: rather none.
    const address = addressOf(store.state, presets) || location.href.replace(/#.*$/s, '');
    // Another example, or place, is another page of the browser's history; each change of one is not.
    const how = store.state.preset !== preset || store.state.place !== place ? 'pushState' : 'replaceState';
    ({ preset, place } = store.state);
    try { if (address !== location.href) history[how](null, '', address); } catch { /* Some viewers forbid it; the memory holds it. */ }
    known = location.href;
  };
  if (!embed) store.subscribe(what => { if ((what === 'state' || what === 'view') && !timer) timer = window.setTimeout(write, pause); });
  // The page that was opened without a state is one to come back to. One that is loaded again is the reader's own; somebody else's address leaves the
  // memory alone until the reader changes something.
  if (!embed && (loadedAgain() || !location.hash.includes('='))) write();
  window.addEventListener('pagehide', () => { if (timer) write(); });
  window.addEventListener('hashchange', () => {
    known = location.href;
    if (!location.hash.includes('=')) { if (!embed) write(); return; }          // a place in the page, none of our addresses
    const { state, problem } = decode(location.hash, presets);
    // What a page shows beside the picture is decided when it is opened.
    if (state.embed?.join('\n') !== embed?.join('\n')) { location.reload(); return; }
    window.clearTimeout(timer);
    timer = 0;
    if (problem) toasts.say(problem);
    ({ preset, place } = state);
    store.load(state);
  });
}
