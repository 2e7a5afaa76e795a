/* What part of the world the stage shows, and when it may show another: the exact motion decides, methods never do.
 *
 * Invariant: bounds are finite and have a size. Without an exact motion the calmest method stands for it; of what is not finite, or runs away, the
 * middle ninety per cent count.
 */
import { rangeOf } from '../figure/axes';
import type { Motion, Rows } from './motion';

export type Range = readonly [number, number];
/** One range for each axis of the subject; of a curve in time the first is the time. */
export type Bounds = readonly Range[];

const ROOM = 0.09, KEPT = 0.4, TAIL = 0.05;

/** The middle of what is finite. */
function middleOf(columns: readonly ArrayLike<number>[]): Range {
  const all = columns.flatMap((column) => Array.from(column).filter(Number.isFinite)).sort((a, b) => a - b);
  const at = (part: number): number => all[Math.min(all.length - 1, Math.max(0, Math.round(part * (all.length - 1))))] ?? NaN;
  return [at(TAIL), at(1 - TAIL)];
}
const size = ([low, high]: Range): number => (high >= low ? high - low : 0);
export const join = (a: Range, b: Range): Range => [Math.min(a[0], b[0]), Math.max(a[1], b[1])];

/** columns[axis]: one for each body. */
export function columnsOf(motion: Motion, of: Rows): ArrayLike<number>[][] {
  const { subject } = motion;
  if (subject.kind === 'shape') return [[[0, 1]], subject.bodies.flatMap((b) => b.columns.map((c) => of.columns[c] ?? []))];
  return subject.axes.map((_, k) => subject.bodies.map((b) => (subject.kind === 'time' && k === 0 ? of.times : of.columns[b.columns[subject.kind === 'time' ? 0 : k] ?? -1] ?? [])));
}
const rangesOf = (motion: Motion, of: Rows): Range[] => columnsOf(motion, of).map(rangeOf);
const largest = (ranges: readonly Range[]): number => Math.max(0, ...ranges.map(size));

/** The rows up to the ground, where the motion comes down to it; at: its time there. */
export function untilGround(of: Rows, column: number): { readonly rows: Rows; readonly at: number | null } {
  const y = of.columns[column], { times } = of;
  if (!y || !(y[0]! >= 0)) return { rows: of, at: null };
  const below = y.findIndex((v) => v < 0);
  if (below < 1) return { rows: of, at: null };
  const part = y[below - 1]! / (y[below - 1]! - y[below]!), cut = (c: Float64Array): Float64Array => { const kept = c.slice(0, below + 1); if (below < c.length) kept[below] = c[below - 1]! + part * (c[below]! - c[below - 1]!); return kept; };
  const whole = { times: cut(times), columns: of.columns.map(cut) };
  whole.columns[column]![below] = 0;
  return { rows: whole, at: whole.times[below]! };
}

/** How far the exact motion goes, as far as the ground where there is one; without one, the calmest method; and whether that one was tamed. */
export function extentOf(motion: Motion, ground = false): { readonly ranges: readonly Range[]; readonly tamed: boolean } {
  const { lines, subject } = motion, still = subject.kind === 'time' ? 1 : 0;
  const seen = (of: Rows): Rows => (ground && subject.kind === 'plane' ? untilGround(of, subject.bodies[0]!.columns[1]!).rows : of);
  if (motion.truth) {
    const ranges = rangesOf(motion, seen(motion.truth));
    // Events may end it before a method's own, whose clock goes on.
    return { ranges: still ? [lines.reduce((all, { track }) => join(all, rangeOf([track.times])), ranges[0]!), ...ranges.slice(1)] : ranges, tamed: false };
  }
  let best: readonly Range[] | null = null, tamed = false;
  for (const { track } of lines) {
    const rows = seen(track), middles = columnsOf(motion, rows).map(middleOf);
    let ranges = rangesOf(motion, rows);
    // What grows beyond thirty times its middle hides everything that is of interest in it.
    const wild = track.problem !== null || ranges.some((r, k) => k >= still && size(middles[k]!) > 0 && size(r) > 30 * size(middles[k]!));
    if (wild) ranges = ranges.map((r, k) => (k < still ? r : middles[k]!));
    if (!best || largest(ranges.slice(still)) < largest(best.slice(still))) { best = ranges; tamed = wild; }
  }
  return { ranges: best ?? subject.axes.map((): Range => [0, 1]), tamed };
}

/** With some room, and a size also where nothing moves. */
export function roomy(ranges: readonly Range[], time: boolean): Bounds {
  const whole = Math.max(...ranges.slice(time ? 1 : 0).map(size), 0);
  return ranges.map((r, k): Range => {
    if (!(r[1] >= r[0])) return [-1, 1];
    if (time && k === 0) return r[1] > r[0] ? r : [r[0] - 1, r[1] + 1];
    const own = size(r), room = own > 1e-6 * whole && own > 0 ? ROOM * own : Math.max(0.05 * whole, Math.abs(r[0]) * 0.1, whole ? 0 : 1e-3) || 1;
    return [r[0] - room, r[1] + room];
  });
}

/** All that any method does, where it is finite. */
export function allOf(motion: Motion): Bounds {
  let ranges = extentOf(motion).ranges;
  for (const { track } of motion.lines) ranges = rangesOf(motion, track).map((r, k) => join(r, ranges[k]!));
  return roomy(ranges.map(([low, high]): Range => [Math.max(low, -1e300), Math.min(high, 1e300)]), motion.subject.kind === 'time');
}

/** Whether a picture with these bounds still shows this motion well: all of it inside, and not too small. */
export function suits(bounds: Bounds, ranges: readonly Range[], time: boolean, equal: boolean): boolean {
  const shares: number[] = [];
  for (let k = 0; k < ranges.length; k++) {
    const [low, high] = bounds[k]!, r = ranges[k]!;
    if (!(r[1] >= r[0])) continue;
    if (time && k === 0) { if (r[0] !== low || r[1] !== high) return false; continue; }
    if (r[0] < low || r[1] > high) return false;
    shares.push(size(r) / (high - low));
  }
  const filled = equal ? Math.max(...shares, 0) : Math.min(...shares, 1);
  return filled >= KEPT || shares.every((s) => s === 0);
}
