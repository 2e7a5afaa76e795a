/* How a method keeps what the motion keeps: read off its values at each step, in the plainest words that the numbers bear.
 *
 * Invariant: whatever is said holds for the run at hand. A rate is told as steady only where every step of the run was kept and each one changed the value
 * by the same share, or by the same amount, to one part in a hundred. That a method comes back is told only where the second half of the run strays no
 * further than the first and was near the first value again. All else is told by how far it has gone.
 */
import type { Track } from '../protocol';

export type Keeping =
  | { readonly kind: 'grows' | 'shrinks'; readonly rate: number }          // by this share of itself at each step
  | { readonly kind: 'adds' | 'takes'; readonly rate: number }            // by this share of the first value at each step
  | { readonly kind: 'keeps'; readonly most: number }                     // but for this
  | { readonly kind: 'back'; readonly most: number }                      // strays so far and comes back
  | { readonly kind: 'strays'; readonly most: number }                    // so far, and ends nearer
  | { readonly kind: 'higher' | 'lower'; readonly by: number }            // at the end, which is about as far as it goes
  | { readonly kind: 'times'; readonly factor: number }                   // the first value, at the end
  | { readonly kind: 'leaves'; readonly time: number };                   // is no number any more

/** Steadiness, as a part of the rate; fewer steps than this say nothing about a rate. */
const STEADY = 0.01, STEPS = 8;
/** Changes below this are told as the digits that are kept. */
const KEPT = 5e-6;
const BACK = { further: 1.1, near: 0.15, rows: 20 };

function middle(values: readonly number[]): number {
  return [...values].sort((a, b) => a - b)[values.length >> 1] ?? NaN;
}
/** The value that all of these are, to STEADY; NaN. */
function steady(values: readonly number[]): number {
  const m = middle(values);
  return Math.abs(m) > 0 && values.every((v) => Math.abs(v - m) <= STEADY * Math.abs(m)) ? m : NaN;
}

/** values: of the invariant at the track's rows; changes: from the first one, relative or not. null: nothing was computed. */
export function keepingOf(track: Track, values: ArrayLike<number>, changes: ArrayLike<number>, relative: boolean): Keeping | null {
  const n = Math.min(values.length, changes.length);
  if (n < 2) return null;
  let most = 0, finite = 0;
  for (; finite < n && Number.isFinite(changes[finite]!); finite++) most = Math.max(most, Math.abs(changes[finite]!));
  if (track.problem || finite < n) return { kind: 'leaves', time: track.problem?.time ?? track.times[Math.min(finite, n - 1)]! };
  const end = changes[n - 1]!, first = values[0]!;
  if (most < KEPT) return { kind: 'keeps', most };
  // The last step may be a shorter one.
  if (relative && track.every === 1 && n - 2 >= STEPS) {
    const shares: number[] = [], amounts: number[] = [];
    for (let i = 0; i + 2 < n; i++) { shares.push((values[i + 1]! - values[i]!) / values[i]!); amounts.push((values[i + 1]! - values[i]!) / Math.abs(first)); }
    const share = first > 0 ? steady(shares) : NaN, amount = steady(amounts);
    if (share === share) return { kind: share > 0 ? 'grows' : 'shrinks', rate: Math.abs(share) };
    if (amount === amount) return { kind: amount > 0 ? 'adds' : 'takes', rate: Math.abs(amount) };
  }
  let early = 0, late = 0, near = Infinity;
  for (let i = 0; i < n; i++) {
    const size = Math.abs(changes[i]!);
    if (2 * i < n) early = Math.max(early, size);
    else { late = Math.max(late, size); near = Math.min(near, size); }
  }
  if (n >= BACK.rows && late <= BACK.further * early && near <= BACK.near * most) return { kind: 'back', most };
  if (relative && first > 0 && end >= 1) return { kind: 'times', factor: 1 + end };
  if (most <= 1.2 * Math.abs(end)) return { kind: end > 0 ? 'higher' : 'lower', by: Math.abs(end) };
  return { kind: 'strays', most };
}
