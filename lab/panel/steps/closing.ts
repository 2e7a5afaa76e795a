/* Where the exact motion is when a step ends, and by how much the step misses it, in a sentence.
 *
 * Invariant: a place is told only where its figures differ from those that the step ends with; a miss that these digits do not show is told alone.
 */
import { words } from '../../words';
import { figure, type Kind } from './figures';

const told = words.opened;
const vector = (figures: readonly string[]): string => (figures.length > 1 ? `(${figures.join(', ')})` : figures[0] ?? '');

/** ends, is: where the step ends, and the exact motion; miss: in words, '' where there is none. */
export function against(ends: readonly number[], is: readonly number[], kind: Kind, method: string, miss: string, first: boolean, known: boolean): string {
  const there = is.map((x) => figure(x, kind, true).text), here = ends.map((x) => figure(x, kind, true).text);
  return miss && there.every((text, k) => text === here[k]) ? told.missOnly(method, miss, first, known) : told.exact(vector(there), method, miss, first, known);
}
