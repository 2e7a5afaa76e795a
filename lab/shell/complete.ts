/* What a name may become: the names that a text knows, as one types. Pure.
 *
 * Invariant: an offer begins with what is typed, ignoring capitals, and is longer; nothing is offered in a comment or inside a word.
 */
import type { Description, Vocabulary, Word } from '../protocol';

export interface Completion { readonly from: number; readonly to: number; readonly offers: readonly string[] }
export interface Known {
  readonly words: readonly Word[]; readonly vocabulary: Vocabulary | null; readonly description: Description | null; readonly methods: readonly string[];
}
const most = 8;

/** force: asked for by a key, so that one letter, or none, is enough. */
export function completion(text: string, caret: number, known: Known, force = false): Completion | null {
  const line = text.slice(text.lastIndexOf('\n', caret - 1) + 1, caret);
  if (line.includes('#') || /^[\p{L}\p{N}_]/u.test(text.slice(caret))) return null;
  const statement = line.slice(line.lastIndexOf(';') + 1);
  const method = /^\s*method\s+([\w-]*)$/.exec(statement)?.[1];
  const typed = method ?? /(?<![\p{N}.])[\p{L}_][\p{L}\p{N}\p{M}_]*'*$/u.exec(line)?.[0] ?? '';
  if (method === undefined && typed.length < (force ? 0 : 2)) return null;
  const { vocabulary, description } = known, lower = typed.toLowerCase();
  const begins = statement.slice(0, statement.length - typed.length).trim() === '';
  const own = known.words.filter(w => w.kind === 'known' && w.to !== caret).map(w => text.slice(w.from, w.to));
  const primes = (description?.variables ?? []).filter(v => v.order === 2).map(v => v.name + "'");
  const names = method !== undefined ? known.methods
    : [...own, ...primes, ...(begins ? vocabulary?.settings ?? [] : [...(vocabulary?.functions ?? []).map(f => f + '('), ...(vocabulary?.operators ?? []), ...(vocabulary?.names ?? [])])];
  const fits = [...new Set(names)].filter(name => name.toLowerCase().startsWith(lower) && name.length > typed.length);
  // A name that is complete as it stands wants nothing.
  if (!fits.length || (!force && names.includes(typed))) return null;
  return { from: caret - typed.length, to: caret, offers: fits.slice(0, most) };
}
