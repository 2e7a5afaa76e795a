/* Which events have to do with a quantity: its curve has marks of these alone. */
import { bodiesOf } from '../distance';
import type { Events } from '../protocol';
import type { Scene } from '../scene';
import { columnOf, positions, velocityOf } from './columns';

/** The quantities of the body that this one is of, places and velocities; of what is no body's, itself. */
function siblings(scene: Scene, name: string): string[] {
  const own = columnOf(scene, name), of = (kind: string): string[] => scene.description.columns.filter((c) => c.kind === kind && c.variable === own?.variable).map((c) => c.name);
  const all = positions(scene), at = all.indexOf(own?.kind === 'velocity' ? of('position')[of('velocity').indexOf(name)] ?? '' : name);
  const parts = bodiesOf(all).find((body) => body.parts.includes(at))?.parts ?? [];
  return [name, ...parts.flatMap((k) => [all[k]!, velocityOf(scene, all[k]!) ?? all[k]!])];
}

/** The rows of the table of events that concern one of these quantities: an event that changes it or its body; one that changes no number of the state concerns all. */
export function concerning(scene: Scene, { before, after }: Events, names: readonly string[]): (row: number) => boolean {
  const at = (all: readonly string[]): number[] => all.map((name) => scene.solution.columns.indexOf(name)).filter((c) => c >= 0);
  const own = at(names.flatMap((name) => siblings(scene, name))), state = at(scene.description.columns.filter(({ kind }) => kind === 'position' || kind === 'velocity' || kind === 'first-order').map((c) => c.name));
  const changes = (columns: readonly number[], row: number): boolean => columns.some((c) => !Object.is(before[c]?.[row], after[c]?.[row]));
  return (row) => changes(own, row) || !changes(state, row);
}
