/* What the page is doing, where that takes long, and what stopped a motion. Invariant: long work can always be cancelled from here. */
import type { LiveStore } from '../state';
import { button, el, say } from '../dom';
import { endSaid } from '../figure/ended';
import { begin } from '../figure/track';
import { bandsOf } from '../panel/band';
import { moment, nameAt, timeUnit } from '../panel/told';
import { words } from '../words';

/** "explicit Euler stopped at t = 1.2: x is no longer finite" of each method that did not reach the end, passed a singularity, or missed the accuracy; or why nothing could be computed, or no
 * green curve. */
function stopped(store: LiveStore): string {
  const { run, model } = store.trouble;
  if (model) return store.scene ? words.trouble.last : words.trouble.model;
  if (store.trouble.step || store.trouble.tolerance || store.trouble.accuracy || store.trouble.until) return words.trouble.numbers;
  if (run) return words.trouble.hinted(run.message, run.hint);
  const { tracks = [], truth, problem } = store.scene?.solution ?? {}, whose = new Map<string, string[]>(), own = new Map<string, string>();
  tracks.forEach((track, k) => {
    const trouble = track.problem ?? track.singular ?? track.goal?.missed ?? (store.scene && track.ended?.ended ? { message: endSaid(track, timeUnit(store.scene)) } : null);
    // What begins with the program's name of the method is said with the page's.
    if (trouble?.message.startsWith(`${track.method} `)) own.set(trouble.message, trouble.message.slice(track.method.length + 1));
    if (trouble) whose.set(trouble.message, [...(whose.get(trouble.message) ?? []), store.scene?.looks[k]?.label ?? track.method]);
  });
  // Where no method comes through, why is said of them; where the errors of one are known, how far it can be known.
  const lost = tracks.flatMap(({ method }, k) => { const until = bandsOf(store).of(method)?.until ?? null; return until === null || !store.scene ? [] : [words.trouble.noGreenFrom(nameAt(store.scene, k), moment(store.scene, until))]; })[0];
  const missing = problem && !truth && tracks.some((t) => !t.problem && !t.singular) ? [lost ?? words.trouble.noGreen(problem.message.replace(/^there is no reference solution[^:]*: /, ''))] : [];
  return words.trouble.all([...[...whose].map(([message, names]) => (own.has(message) ? words.trouble.does(begin(words.panel.and(names)), own.get(message)!) : words.trouble.method(words.panel.and(names), message))), ...missing]);
}

export function status(store: LiveStore): HTMLElement {
  const line = el('span', {}, ''), cancel = button(words.trouble.cancel, () => store.cancel(), { class: 'text-button', hidden: true });
  const element = el('div', { class: 'status' }, el('p', { class: 'message', role: 'status' }, line), cancel);
  let of = '', told = '';
  const show = (): void => {
    // What is drawn already, and only made finer, is not waited for.
    const busy = store.busy && (!store.scene?.solution.truth || store.scene.state.text !== store.state.text);
    element.classList.toggle('busy', busy);
    cancel.hidden = !busy;
    // What was said of this model stays until its runs have been examined again.
    const { scene, trouble } = store, waits = scene !== null && !scene.solution.examined && scene.state.text === of && !trouble.model && !trouble.run && !trouble.step && !trouble.tolerance && !trouble.accuracy && !trouble.until;
    if (!waits) told = stopped(store);
    if (!busy) of = scene?.state.text ?? '';
    // It stays while a slider moves, as the picture gives it room where the screen is small.
    const tells = told !== '' && (!busy || scene?.state.text === store.state.text);
    element.classList.toggle('tells', tells);
    say(line, tells ? told : busy ? words.trouble.computing : '');
  };
  store.subscribe(what => { if (what !== 'state' && what !== 'view') show(); });
  bandsOf(store).listen(show);
  return element;
}
