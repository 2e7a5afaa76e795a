/* Motions as lines: values at a time, bounds that one runaway does not spoil, the line with its markers.
 *
 * Invariant: numbers come from the rows that were computed. Between two rows the straight line is read that is drawn there; outside of them there is
 * nothing (NaN), also where a method stopped early.
 */
import type { Look } from '../scene';
import { extent, padded } from './axes';
import { thin, thinPath } from './thin';
import type { Frame, Pen } from './types';

/** The last row not after t, in the direction of the run; -1: before the first. */
export function rowAt(times: ArrayLike<number>, t: number): number {
  const n = times.length;
  if (!n) return -1;
  const way = times[n - 1]! < times[0]! ? -1 : 1;
  let low = -1, high = n;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (way * times[middle]! <= way * t) low = middle; else high = middle;
  }
  return low;
}

export function valueAt(times: ArrayLike<number>, column: ArrayLike<number>, t: number): number {
  const i = rowAt(times, t);
  if (i < 0 || !column.length) return NaN;
  if (times[i] === t) return column[i]!;
  if (i + 1 >= times.length) return NaN;
  const part = (t - times[i]!) / (times[i + 1]! - times[i]!);
  return column[i]! + part * (column[i + 1]! - column[i]!);
}

/** Bounds for a picture of `truth` and `tracks`, and which tracks run out of it. */
export interface View { readonly bounds: [number, number]; readonly leaving: readonly number[] }

export function viewOf(truth: ArrayLike<number> | null, tracks: readonly ArrayLike<number>[]): View {
  const ranges = tracks.map((t) => extent([t]));
  const sizes = ranges.map(([a, b]) => b - a);
  let [low, high] = truth?.length ? extent([truth]) : [Infinity, -Infinity];
  if (!(low <= high)) {
    // No truth: the calmest track stands for it.
    const calm = sizes.indexOf(Math.min(...sizes));
    [low, high] = ranges[calm] ?? [0, 1];
  }
  // What hardly moves (an energy that is kept) has its own size for a measure, else everybody else would be far from it.
  const size = Math.max(Math.abs(low), Math.abs(high)), least = truth?.length ? 1e-9 : 0.02;
  const range = high - low > least * size ? high - low : size || Infinity, leaving: number[] = [];
  const bounds: [number, number] = [low, high];
  ranges.forEach(([a, b], i) => {
    // Three times the range on either side is still a picture of both; beyond that, the calm motion would shrink to a line.
    const far = a < low - 3 * range || b > high + 3 * range;
    if (far) leaving.push(i);
    bounds[0] = Math.min(bounds[0], far ? Math.max(a, low - 0.5 * range) : a);
    bounds[1] = Math.max(bounds[1], far ? Math.min(b, high + 0.5 * range) : b);
  });
  return { bounds: padded(bounds), leaving };
}

export const WIDTH = 2, EXACT_WIDTH = 4;
const RADIUS = 2.6;

type Points = readonly [x: ArrayLike<number>, y: ArrayLike<number>];
/** A method's line against time; rows: how many of its rows; steps: where its steps end, if the line has other rows besides. */
export function drawTrack(pen: Pen, frame: Frame, times: ArrayLike<number>, column: ArrayLike<number>, look: Look, rows: number, steps: Points | null = null): void {
  pen.line(thin(first(times, rows), column, frame.x, frame.y), { colour: look.colour, width: WIDTH, dash: look.dash });
  drawMarkers(pen, frame, steps ?? [times, column], look, steps ? Infinity : rows);
}

export function drawPath(pen: Pen, frame: Frame, x: ArrayLike<number>, y: ArrayLike<number>, look: Look, rows: number, steps: Points | null = null): void {
  pen.line(thinPath(first(x, rows), y, frame.x, frame.y), { colour: look.colour, width: WIDTH, dash: look.dash });
  drawMarkers(pen, frame, steps ?? [x, y], look, steps ? Infinity : rows);
}
const first = (column: ArrayLike<number>, rows: number): ArrayLike<number> => (rows >= column.length ? column : Array.prototype.slice.call(column, 0, rows));

/** Where steps are few each has its marker; where they are many there is none, as the name at the end says whose line it is. */
function drawMarkers(pen: Pen, frame: Frame, [x, y]: Points, look: Look, upTo: number): void {
  if (Math.min(x.length, y.length) > frame.width / 12) return;
  const rows = Math.min(x.length, y.length, upTo);
  for (let i = 0; i < rows; i++) {
    const px = frame.x(x[i]!), py = frame.y(y[i]!);
    if (px >= frame.left - 1 && px <= frame.left + frame.width + 1 && py >= frame.top - 1 && py <= frame.top + frame.height + 1) pen.mark(look.marker, px, py, RADIUS, look.colour);
  }
}

/** With a capital: a method's name at the head of a sentence. */
export function begin(sentence: string): string {
  return sentence.slice(0, 1).toUpperCase() + sentence.slice(1);
}
