/* What panels say alike: times with their unit, and lists of what each method does.
 *
 * Invariant: a sentence tells what was computed of the scene on show, and nothing that was not.
 */
import { exampleOf, stagingOf } from '../data';
import { bodiesOf } from '../distance';
import { nameText, timeName } from '../figure/name';
import { brief } from '../figure/number';
import type { Column } from '../protocol';
import type { Scene } from '../scene';
import { words } from '../words';
import { columnOf, positions } from './columns';

const unitsOf = (scene: Scene) => stagingOf(exampleOf(scene.state)).units;
/** The unit of time, where the scene gives one; ''. */
export const timeUnit = (scene: Scene): string => unitsOf(scene)?.t ?? '';
/** The unit of a column. */
export function unitOf(scene: Scene, name: string): string {
  const units = unitsOf(scene), kind: Column['kind'] | undefined = columnOf(scene, name)?.kind;
  return !units ? '' : kind === 'time' ? units.t : kind === 'position' ? units.x : kind === 'velocity' ? units.v : '';
}
/** A column by its name; of a body that the example names, by that: r[2]'.x is "Jupiter x′". */
export function calledOf(scene: Scene, name: string): string {
  const [, body = '', prime = '', part = ''] = /^(\w+\[-?\d+\])('?)\.(\w+)$/u.exec(name) ?? [], of = bodyCalled(scene, positions(scene), body);
  return of ? `${of} ${nameText(part + prime)}` : nameText(name);
}
/** A body by the name that the example gives it; ''. */
export function bodyCalled(scene: Scene, names: readonly string[], body: string): string {
  const given = stagingOf(exampleOf(scene.state)).bodies, name = given?.[bodiesOf(names).findIndex(({ label }) => label === body)];
  return body && name ? words.stage.bodies[name] : '';
}
/** A number in a sentence, to three digits, with its unit. */
export const amount = (value: number, unit = '', digits = 3): string => `${brief(value, digits)}${unit && `\u2009${unit}`}`;
/** "20 s"; without a unit "t = 20". */
export const moment = (scene: Scene, t: number): string => (timeUnit(scene) ? amount(t, timeUnit(scene), 4) : `${nameText(timeName(scene.solution))} = ${brief(t, 4)}`);

/** Where the run would end: the last time of whoever came furthest. */
export function endTime(scene: Scene): number {
  const ends = [...scene.solution.tracks.map((t) => t.times), scene.solution.truth?.times ?? new Float64Array(0)].filter((t) => t.length);
  const start = ends[0]?.[0] ?? 0;
  return ends.map((t) => t[t.length - 1]!).reduce((a, b) => (Math.abs(b - start) > Math.abs(a - start) ? b : a), start);
}

/** A method's name in a sentence: "Kahan–Li 8" is not broken before its number. */
export const nameAt = (scene: Scene, k: number): string => (scene.looks[k]?.label ?? '').replace(/ (?=\d)/g, '\u00a0');

/** "a, b, c"; from `most` on counted. */
export const several = (parts: readonly string[], most = 6): string =>
  (parts.length > most ? [...parts.slice(0, most - 1), words.panel.more(String(parts.length - most + 1))] : parts).join(', ');
/** "a", "a and b", "a, b and 3 more". */
export const listed = (parts: readonly string[], most = 6): string => words.panel.and(parts.length > most ? [...parts.slice(0, most - 1), words.panel.more(String(parts.length - most + 1))] : parts);
