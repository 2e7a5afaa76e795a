/* What is drawn: the motion of every method and the exact one, of one subject. */
import { nameText } from '../figure/name';
import type { ErrorTrack, Track, Truth } from '../protocol';
import type { Look, Scene } from '../scene';
import { words } from '../words';
import type { Subject } from './subject';

export interface Line { readonly track: Track; readonly look: Look; /** Of solution.tracks. */ readonly index: number }
export interface Motion { readonly scene: Scene; readonly subject: Subject; readonly lines: readonly Line[]; readonly truth: Truth | null }
export type { Rows } from '../figure/line';

/** How the green curve is called: exact where a formula gives it, computed else. */
export const greenName = (scene: Scene): string => (scene.description.has_exact ? words.stage.exact : words.stage.computed);

/** How far off a method is: in its positions; where there are none, in its first-order variables. */
export const errorsOf = ({ x, s }: ErrorTrack): Float64Array => (x.length ? x : s);

/** Which of several bodies is the furthest at a row, as the example or the model calls it; of more than have names: that it is the furthest. '' for one. */
export function furthestOf({ x, which, bodies }: ErrorTrack, row: number, given?: readonly (keyof typeof words.stage.bodies)[]): string {
  const body = which[row], label = body === undefined ? undefined : bodies[body];
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
