/* Colours that stay with their words while the core has not read the text again. Pure. */
import type { Word } from '../protocol';

/** The words of `before` that stand in `after` too: those in front of the change, and those behind it, moved along. */
export function shifted(words: readonly Word[], before: string, after: string): readonly Word[] {
  const most = Math.min(before.length, after.length), by = after.length - before.length;
  let head = 0, tail = 0;
  while (head < most && before.charCodeAt(head) === after.charCodeAt(head)) head++;
  while (tail < most - head && before.charCodeAt(before.length - 1 - tail) === after.charCodeAt(after.length - 1 - tail)) tail++;
  const end = before.length - tail;
  return words.flatMap(word => (word.to <= head ? [word] : word.from >= end ? [{ ...word, from: word.from + by, to: word.to + by }] : []));
}

/** A piece of a text and its class; '' for ink. */
export interface Piece { readonly text: string; readonly kind: string }
/** The whole text in pieces; `mark` is one of its own, whatever stands there. */
export function pieces(text: string, words: readonly Word[], mark: readonly [number, number] | null): Piece[] {
  const out: Piece[] = [];
  let at = 0;
  const put = (to: number, kind: string): void => { if (to > at) { out.push({ text: text.slice(at, to), kind }); at = to; } };
  const marked = (): void => { if (mark && at <= mark[0]) { put(mark[0], ''); put(mark[1], 'mark'); } };
  for (const { from, to, kind } of words) {
    if (mark && to > mark[0]) marked();
    if (from < at || to > text.length) continue;
    put(from, '');
    put(to, kind);
  }
  marked();
  put(text.length, '');
  return out;
}
