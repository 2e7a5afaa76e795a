/* How a number swings: where it turns back, and whether it does so again and again.
 *
 * Invariant: a swing is said to repeat only where it turned back at least twice at either end, and each time the same to a part of its width and its period
 * that three digits do not show.
 */
export interface Turn { readonly time: number; readonly at: number }
export interface Swings { readonly turns: readonly Turn[]; readonly repeats: { readonly low: number; readonly high: number; readonly period: number } | null }

const ALIKE = 0.002;

/** Between two rows the velocity is a straight line, the position Hermite's cubic. */
function turnBetween(times: ArrayLike<number>, x: ArrayLike<number>, v: ArrayLike<number>, i: number): Turn {
  const h = times[i + 1]! - times[i]!, s = v[i]! / (v[i]! - v[i + 1]!), way = x[i + 1]! - x[i]!;
  return { time: times[i]! + s * h, at: x[i]! + s * way + s * (1 - s) * ((1 - s) * (h * v[i]! - way) - s * (h * v[i + 1]! - way)) };
}

/** A start at rest is no turn, since nothing came to it from anywhere; but where the motion repeats, it is one of its ends. */
export function swingsOf(times: ArrayLike<number>, x: ArrayLike<number>, v: ArrayLike<number>): Swings {
  const turns: Turn[] = [], start: Turn[] = [], n = Math.min(times.length, x.length, v.length);
  for (let i = 0; i < n; i++) {
    const here = v[i]!, next = v[i + 1] ?? NaN;
    if (here === 0 && i === 0) start.push({ time: times[i]!, at: x[i]! });
    else if (here === 0 && v[i - 1]! * next < 0) turns.push({ time: times[i]!, at: x[i]! });
    else if (i + 1 < n && here * next < 0) turns.push(turnBetween(times, x, v, i));
  }
  return { turns, repeats: repeats([...start, ...turns]) };
}

function repeats(turns: readonly Turn[]): Swings['repeats'] {
  if (turns.length < 4) return null;
  const mean = (of: readonly number[]): number => of.reduce((a, b) => a + b, 0) / of.length;
  const one = mean(turns.filter((_, k) => k % 2 === 0).map((t) => t.at)), other = mean(turns.filter((_, k) => k % 2 === 1).map((t) => t.at));
  const period = mean(turns.slice(2).map((t, k) => t.time - turns[k]!.time)), width = Math.abs(one - other);
  const alike = turns.every((t, k) => Math.abs(t.at - (k % 2 ? other : one)) <= ALIKE * width && (k < 2 || Math.abs(t.time - turns[k - 2]!.time - period) <= ALIKE * Math.abs(period)));
  return alike && width > 0 ? { low: Math.min(one, other), high: Math.max(one, other), period: Math.abs(period) } : null;
}
