/* Pinning: the run that is seen stays as A while everything may be changed; what differs is told.
 *
 * Invariant: A is a run that was computed; another example lets it go.
 */
import type { Scene } from '../scene';
import type { LiveStore } from '../state';
import type { Stage } from '../stage/stage';
import { button, el, say } from '../dom';
import { words } from '../words';
import { short } from './number';

/** What distinguishes two states, in words. */
function differences(a: Scene, b: Scene): string {
  const step = (s: Scene): string => short(s.solution.tracks[0]?.step ?? 0, 4), values = (s: Scene) => new Map(s.solution.description.parameters.map((p) => [p.name, p.values.map((v) => short(v, 4)).join(', ')]));
  const before = values(a), told: string[] = [];
  if (step(a) !== step(b)) told.push(`h ${step(a)}`);
  for (const [name, text] of values(b)) { const old = before.get(name); if (old !== undefined && old !== text) told.push(`${name} ${old}`); }
  return told.length ? words.dock.pin.differs(told.slice(0, 3)) : words.dock.pin.same;
}

export function pin(store: LiveStore, stage: Stage): HTMLElement {
  let kept: Scene | null = null;
  const label = el('span', {}, words.dock.pin.pin);
  const control = button('', () => { kept = kept ? null : store.scene; stage.pin(kept); show(); }, { class: 'quiet-button', 'aria-pressed': 'false', title: words.dock.pin.title }, label);
  function show(): void {
    control.setAttribute('aria-pressed', String(kept !== null));
    say(label, kept && store.scene ? words.dock.pin.pinned(differences(kept, store.scene)) : words.dock.pin.pin);
    control.setAttribute('aria-label', kept && store.scene ? words.dock.pin.pinnedLabel(differences(kept, store.scene)) : words.dock.pin.label);
  }
  store.subscribe((what) => {
    if (what !== 'scene') return;
    if (kept && kept.state.preset !== store.scene?.state.preset) { kept = null; stage.pin(null); }
    show();
  });
  return control;
}
