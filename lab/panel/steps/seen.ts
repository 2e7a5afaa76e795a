/* What of a state is looked at in one step: two places as a vector, or one number.
 *
 * Invariant: indices are those of the core's account (Trace.names); a position has the velocity at the same index, a first-order variable has none.
 */
import { nameText } from '../../figure/name';
import type { Trace } from '../../protocol';
import { words } from '../../words';

export interface Seen {
  readonly id: string; readonly label: string;
  /** As a model writes it; of two numbers the vector's name, '' where they share none. */
  readonly name: string;
  /** 2: positions; 1: first-order variables, which stand among the velocities. */
  readonly order: 1 | 2;
  /** One number against time, or two in their plane. */
  readonly indices: readonly number[]; readonly names: readonly string[];
}

const MOST = 24;
const low = (name: string): string => nameText(name.replace(/^(.*?)\.(\w+)$/, '$2'));
const owner = (name: string): string => (name.includes('.') ? name.slice(0, name.lastIndexOf('.')) : '');

/** Everything that can be looked at, planes first. called: what the example calls a body, ''. */
export function seenIn(names: Trace['names'], called: (body: string) => string = () => ''): Seen[] {
  const { x } = names, out: Seen[] = [], at = new Map(x.map((name, k) => [name, k]));
  const several = new Set(x.map(owner)).size > 1, labelOf = (name: string): string => (several && owner(name) ? `${called(owner(name)) || sub(owner(name))} ${low(name)}` : sub(low(name)));
  const pair = (i: number, k: number): void => {
    const two = [x[i]!, x[k]!], name = owner(two[0]!) === owner(two[1]!) ? owner(two[0]!) : '';
    out.push({ id: two.join('|'), label: several && name ? words.opened.of(called(name) || sub(name), words.opened.both(low(two[0]!), low(two[1]!))) : words.opened.both(sub(low(two[0]!)), sub(low(two[1]!))), name, order: 2, indices: [i, k], names: two });
  };
  x.forEach((name, i) => {
    if (out.length > MOST) return;
    for (const letter of ['y', 'z']) {
      const other = /\.x$/.test(name) ? at.get(name.replace(/x$/, letter)) : /^x[\p{L}\p{N}_]*$/u.test(name) ? at.get(letter + name.slice(1)) : undefined;
      if (other !== undefined) pair(i, other);
    }
  });
  if (out.length === 0 && x.length === 2) pair(0, 1);
  x.slice(0, MOST).forEach((name, i) => out.push({ id: name, label: labelOf(name), name, order: 2, indices: [i], names: [name] }));
  names.v.slice(x.length, x.length + MOST).forEach((name, i) => out.push({ id: name, label: sub(name), name, order: 1, indices: [x.length + i], names: [name] }));
  return out;
}

/** Letters as an equation has them, lowered digits as digits: θ₁, x₃. */
function sub(name: string): string {
  const [, word = name, digits = '', bracket = ''] = /^([^\d[]+)(\d*)(?:\[(\d+)\])?$/.exec(name) ?? [];
  return nameText(word) + (digits || bracket).replace(/\d/g, (d) => '₀₁₂₃₄₅₆₇₈₉'[Number(d)]!);
}

/** What the stage shows, by the names of its columns; else the first number. */
export function seenBy(all: readonly Seen[], stage: readonly string[]): Seen | null {
  const places = stage.filter((name) => name !== 't');
  return all.find((s) => s.names.length === 2 && s.names.every((name, k) => places[k] === name)) ?? all.find((s) => s.names.length === 1 && s.names[0] === places[0]) ?? all.find((s) => s.names.length === 1) ?? null;
}
