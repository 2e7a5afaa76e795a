/* What the page is doing, where that takes long, and what stopped a motion. Invariant: long work can always be cancelled from here. */
import type { LiveStore } from '../state';
import { button, el, say } from '../dom';

/** "explicit Euler stopped at t = 1.2: x is no longer finite" of each method that did not reach the end, or passed a singularity; or why nothing could be computed. */
function stopped(store: LiveStore): string {
  const { run, model } = store.trouble;
  if (model) return store.scene ? 'The last motion that could be read.' : 'The model has an error; see under its text.';
  if (store.trouble.step || store.trouble.until) return 'The step or the end cannot be used, as said beside them; the picture is the last one that could be computed.';
  if (run) return [run.message, run.hint].filter(Boolean).join(': ');
  return store.scene?.solution.tracks.map((track, k) => {
    const trouble = track.problem ?? track.singular;
    return trouble ? `${store.scene?.looks[k]?.label ?? track.method}: ${trouble.message}` : '';
  }).filter(Boolean).join('. ') ?? '';
}

export function status(store: LiveStore): HTMLElement {
  const words = el('span', {}, ''), cancel = button('Cancel', () => store.cancel(), { class: 'text-button', hidden: true });
  let of = '', told = '';
  const element = el('div', { class: 'status' }, el('p', { class: 'message', role: 'status' }, words), cancel);
  const show = (): void => {
    // What is drawn already, and only made finer, is not waited for.
    const busy = store.busy && (!store.scene?.solution.truth || store.scene.state.text !== store.state.text);
    element.classList.toggle('busy', busy);
    cancel.hidden = !busy;
    // What was said of this model stays until its runs have been examined again.
    const { scene, trouble } = store, waits = scene !== null && !scene.solution.examined && scene.state.text === of && !trouble.model && !trouble.run && !trouble.step && !trouble.until;
    if (!waits) told = stopped(store);
    if (!busy) of = scene?.state.text ?? '';
    say(words, busy ? 'Computing …' : told);
  };
  store.subscribe(what => { if (what !== 'state' && what !== 'view') show(); });
  return element;
}
