/* Pinning: the run that is seen stays as A while everything may be changed; what differs is told. Which run it is stands in the state, and so in the address.
 *
 * Invariant: A is a run that was computed, of the state's own `pinned`; another example lets it go. One that cannot be computed is told, and let go.
 */
import { Refused, type Run, type Scene } from '../scene';
import type { LiveStore } from '../state';
import type { Stage } from '../stage/stage';
import { button, el, say } from '../dom';
import { words } from '../words';
import { short } from './number';
import type { Toasts } from './toasts';

/** What distinguishes two states, in words. */
function differences(a: Scene, b: Scene): string {
  const own = (s: Scene, adaptive: boolean) => s.solution.tracks.find((t) => (t.tolerance !== null) === adaptive);
  const step = (s: Scene): string => short(own(s, false)?.step ?? 0, 4), tolerance = (s: Scene): string => short(own(s, true)?.tolerance ?? 0, 4), values = (s: Scene) => new Map(s.solution.description.parameters.map((p) => [p.name, p.values.map((v) => short(v, 4)).join(', ')]));
  const before = values(a), told: string[] = [];
  if (step(a) !== step(b) && own(a, false)) told.push(`h ${step(a)}`);
  if (tolerance(a) !== tolerance(b) && own(a, true)) told.push(words.dock.pin.tolerance(tolerance(a)));
  for (const [name, text] of values(b)) { const old = before.get(name); if (old !== undefined && old !== text) told.push(`${name} ${old}`); }
  return told.length ? words.dock.pin.differs(told.slice(0, 3)) : words.dock.pin.same;
}

const runOf = ({ text, set, methods, step, tolerance, accuracy, until }: Run): Run => ({ text, set, methods, step, tolerance, accuracy, until });

export function pin(store: LiveStore, stage: Stage, toasts: Toasts): HTMLElement {
  let kept: Scene | null = null, known = '';
  const label = el('span', {}, words.dock.pin.pin);
  const control = button('', () => {
    if (store.state.pinned || !store.scene) { store.pin(null); return; }
    kept = store.scene;
    store.pin(runOf(kept.state));
  }, { class: 'quiet-button', 'aria-pressed': 'false', title: words.dock.pin.title }, label);
  function show(): void {
    control.setAttribute('aria-pressed', String(kept !== null));
    say(label, kept && store.scene ? words.dock.pin.pinned(differences(kept, store.scene)) : words.dock.pin.pin);
    control.setAttribute('aria-label', kept && store.scene ? words.dock.pin.pinnedLabel(differences(kept, store.scene)) : words.dock.pin.label);
  }
  function compute(run: Run, key: string): void {
    store.beside(run).then((scene) => {
      if (known !== key) return;
      kept = scene;
      stage.pin(scene);
      show();
    }, (error: unknown) => {
      if (known !== key || !(error instanceof Refused)) return;
      toasts.say(words.dock.pin.faulty(error.problem.message.replace(/\.$/, '')));
      store.pin(null);
    });
  }
  /** The run that the state names; the present one comes first. */
  function follow(): void {
    const { pinned } = store.state, key = pinned ? JSON.stringify(runOf(pinned)) : '';
    if (key === known || (pinned && !store.scene)) return;
    known = key;
    if (kept && JSON.stringify(runOf(kept.state)) !== key) kept = null;
    stage.pin(kept);
    if (pinned && !kept) compute(pinned, key);
  }
  store.subscribe((what) => {
    if (what !== 'scene' && what !== 'state' && what !== 'view') return;
    follow();
    if (what !== 'state') show();
  });
  return control;
}
