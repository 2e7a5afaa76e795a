/* What is drawn: the motion of every method and the exact one, of one subject. */
import { bodiesOf, distances } from '../distance';
import { lineOf } from '../figure/line';
import { nameText } from '../figure/name';
import { positions, readExact, states } from '../panel/columns';
import type { ErrorTrack, Track, Truth } from '../protocol';
import type { Look, Scene } from '../scene';
import { words } from '../words';
import { placeAt, valueAt } from './rows';
import type { Subject } from './subject';

export interface Line { readonly track: Track; readonly look: Look; /** Of solution.tracks. */ readonly index: number }
export interface Motion { readonly scene: Scene; readonly subject: Subject; readonly lines: readonly Line[]; readonly truth: Truth | null }
export type { Rows } from '../figure/line';

/** How the green curve is called: exact where a formula gives it, computed else. */
export const greenName = (scene: Scene): string => (scene.description.has_exact ? words.stage.exact : words.stage.computed);

/** How far off a method is: in its positions; where there are none, in its first-order variables. */
export const errorsOf = ({ x, s }: ErrorTrack): Float64Array => (x.length ? x : s);

/** How far a method is from the exact motion at a time. body: the number of the furthest; up: by how much the last of `shown` is above the exact one. */
export interface Miss { readonly size: number; readonly body: number; readonly up: number }
/** shown: the columns between whose points the distance is; null: all that the error is of. Where a step ends it is the core's error; between steps, and of a part of a body, the distance
 * of the line that is drawn. null: it is not known, or smaller than what is known of the exact motion there. */
export function missAt(scene: Scene, { track, index }: Line, time: number, shown: readonly number[] | null): Miss | null {
  const { solution } = scene, error = solution.errors[index], errors = error && errorsOf(error);
  if (!error || !errors?.length || !solution.truth) return null;
  const column = (name: string): number => solution.columns.indexOf(name), names = error.x.length ? positions(scene) : states(scene);
  const bodies = error.x.length ? bodiesOf(names) : names.map((label, k) => ({ label, parts: [k] })), parts = (body: { readonly parts: readonly number[] }): number[] => body.parts.map((k) => column(names[k]!));
  const { row, part } = placeAt(track.times, time), at = part === 1 ? row + 1 : part === 0 ? row : -1, line = lineOf(track, shown ?? names.map(column)), place = placeAt(line.times, time);
  let off = 0;
  const apart = (k: number): number => { const exact = readExact(scene, solution.columns[k]!, time); off = Math.max(off, exact.off); return valueAt(line.columns[k]!, place) - exact.value; };
  const up = shown ? apart(shown[shown.length - 1]!) : 0;
  if (at >= 0 && (!shown || (bodies.length === 1 && parts(bodies[0]!).every((k) => shown.includes(k))))) return { size: errors[at]!, body: error.which[at] ?? 0, up };
  const groups = shown ? [{ label: '', parts: shown }] : bodies.map((body) => ({ label: body.label, parts: parts(body) })), { far, which } = distances(1, groups, (_, k) => apart(k)), size = far[0] ?? NaN;
  return Number.isFinite(size) && size > RESOLVED * off ? { size, body: which[0] ?? 0, up } : null;
}
/** A distance has a digit from so many times what the exact motion may be off. */
const RESOLVED = 4;

/** Which of several bodies is the furthest at a row, as the example or the model calls it; of more than have names: that it is the furthest. '' for one. */
export const furthestOf = (error: ErrorTrack, row: number, given?: readonly (keyof typeof words.stage.bodies)[]): string => bodyOf(error, error.which[row], given);
export function bodyOf({ x, bodies }: ErrorTrack, body: number | undefined, given?: readonly (keyof typeof words.stage.bodies)[]): string {
  const label = body === undefined ? undefined : bodies[body];
  if (!x.length || bodies.length < 2 || body === undefined || label === undefined) return '';
  if (bodies.length > NAMED) return words.stage.miss.furthest;
  const name = given?.[body], number = /\[(-?\d+)\]$/.exec(label)?.[1] ?? (/^\d+$/.test(label) ? label : undefined);
  return name ? words.stage.bodies[name] : number ? words.stage.miss.body(number) : nameText(label) || words.stage.miss.furthest;
}
/** More bodies have no names. */
const NAMED = 8;

const seen = (truth: Truth, subject: Subject): boolean => truth.times.length > 1 && subject.bodies.every((b) => b.columns.every((c) => (truth.columns[c]?.length ?? 0) > 0));

export function motionOf(scene: Scene, subject: Subject): Motion {
  const lines: Line[] = [];
  scene.solution.tracks.forEach((track, index) => { const look = scene.looks[index]; if (look && track.times.length > 0) lines.push({ track, look, index }); });
  const { truth } = scene.solution;
  return { scene, subject, lines, truth: truth && scene.state.view.exact && seen(truth, subject) ? truth : null };
}
