/* Where the exact motion is when a step ends, and by how much the step misses it, in a sentence.
 *
 * Invariant: a place is told only where its figures, and those that the step ends with, differ by the miss that is told beside them; a miss that so many digits do not show is told alone.
 */
import { words } from '../../words';
import { figure, type Figure, type Kind } from './figures';

const told = words.opened;
/** Decimals that a place may have more than the step's end. */
const MORE = 3;
const vector = (figures: readonly Figure[]): string => (figures.length > 1 ? `(${figures.map((f) => f.text).join(', ')})` : figures[0]?.text ?? '');

/** How far off, in words and in figures; text: '' where there is none. unit: of its last place. */
export interface Missed { readonly text: string; readonly shown: number; readonly unit: number }

/** ends, is: where the step ends, and the exact motion. from: of what, the motion from the start of the run, from here, or through the last two places. */
export function against(ends: readonly number[], is: readonly number[], kind: Kind, method: string, miss: Missed, from: 'start' | 'here' | 'two', known: boolean): string {
  const here = ends.map((x) => figure(x, kind, true));
  for (let more = 0; more <= (miss.text ? MORE : 0); more++) {
    const there = is.map((x) => figure(x, { ...kind, decimals: kind.decimals + more }, true)), far = Math.hypot(...there.map((f, k) => f.shown - here[k]!.shown));
    if (!miss.text || Math.abs(far - miss.shown) <= 0.5 * miss.unit * (1 + 1e-6)) return told.exact(vector(there), method, miss.text, from, known);
  }
  return told.missOnly(method, miss.text, from, known);
}
