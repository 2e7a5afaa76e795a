/* The curves of a motion in a plot, in pixels: where each lies, which coincide, where a runaway leaves.
 *
 * Invariant: a method coincides with another curve only where every step of it does, to NEAR pixels; it leaves only where it does not come back, or goes
 * far out. Markers stand at computed rows, never between them; where a line goes on between them by dense output, its rows are more than those.
 */
import { lineOf, type Rows } from '../figure/line';
import { marksOf as eventMarks, partOf, type Mark } from '../figure/marks';
import type { Line, Motion } from './motion';
import { lengthOf, path, type Path } from './path';
import type { Plot, Way } from './plot';
import { inside } from './plot';
import { placeAt } from './rows';
import type { Box } from './place';
import { numbersOf } from './subject';

const NEAR = 2;
/** The exact curve is smooth: its corners lie nearer to it than can be seen. */
const SMOOTH = 0.08;
/** Beyond so much of the frame outside of it, a method has left, also where it comes back once more. */
const FAR = 0.35;
/* Of steps that a method chooses each has its mark, so that it is seen where they are short, but for those nearer to the mark before than this. */
const APART = 7, MARKED_MOST = 2000;
/* Every step is marked while the marks can be told apart; else a few, to tell the lines apart. */
const MARKED_ROWS = 240, SPACING = 22, SPARSE = 11;
/** Beyond so many times the stage's size a line is a band, whose dashes nobody sees. */
const BAND = 5;

/** row: the first one outside; time: at which the line to it crosses the edge, there. */
export interface Exit { readonly row: number; readonly time: number; readonly x: number; readonly y: number; readonly dx: number; readonly dy: number }
/** times: of the way's rows, at some of which the marks are. */
export interface Curve {
  readonly line: Line; readonly body: number; readonly way: Way; readonly times: Float64Array; readonly path: Path; readonly marks: readonly number[]; readonly band: boolean; readonly exit: Exit | null;
  /** Where events happened, in their order. */
  readonly events: readonly Mark[];
}
export interface Curves {
  readonly exact: readonly { readonly way: Way; readonly path: Path }[];
  /** Line by line, and of each body by body. */
  readonly methods: readonly (readonly Curve[])[];
  /** Of line i: -1: it is the exact motion; else the first line it coincides with (i: itself). */
  readonly same: readonly number[];
}

export interface Point { x: number; y: number }
/** Where a way is at a time: between two rows on the straight line that is drawn there. */
export function pointAt(way: Way, times: ArrayLike<number>, time: number, out: Point = { x: 0, y: 0 }): Point {
  const at = placeAt(times, time), x = way.x(at.row), y = way.y(at.row);
  out.x = x; out.y = y;
  if (at.part > 0) { out.x = at.part === 1 ? way.x(at.row + 1) : x + at.part * (way.x(at.row + 1) - x); out.y = at.part === 1 ? way.y(at.row + 1) : y + at.part * (way.y(at.row + 1) - y); }
  return out;
}

/** Where a line from a point inside a box to one outside crosses its edge, and which part of it that is. */
function crossing(box: Box, x0: number, y0: number, x1: number, y1: number): Point & { readonly part: number } {
  let part = 1;
  const cut = (from: number, to: number, low: number, high: number): void => {
    if (to > high) part = Math.min(part, (high - from) / (to - from));
    if (to < low) part = Math.min(part, (low - from) / (to - from));
  };
  cut(x0, x1, box.left, box.right);
  cut(y0, y1, box.top, box.bottom);
  const p = Number.isFinite(part) && part >= 0 ? part : 0;
  return { x: x0 + p * (x1 - x0), y: y0 + p * (y1 - y0), part: p };
}

function exitOf(way: Way, rows: number, times: ArrayLike<number>, box: Box): Exit | null {
  const width = box.right - box.left, height = box.bottom - box.top;
  let first = -1, far = false;
  for (let i = 0; i < rows; i++) {
    const x = way.x(i), y = way.y(i);
    // A gap, where it jumps.
    if (Number.isNaN(x + y) && i > 0 && times[i] === times[i - 1]) continue;
    if (x >= box.left && x <= box.right && y >= box.top && y <= box.bottom) continue;
    if (first < 0) first = i;
    if (!(x > box.left - FAR * width && x < box.right + FAR * width && y > box.top - FAR * height && y < box.bottom + FAR * height)) { far = true; break; }
  }
  if (first < 1 || !(far || !inside(box, way.x(rows - 1), way.y(rows - 1)))) return null;
  const x0 = way.x(first - 1), y0 = way.y(first - 1), clamp = (v: number): number => Math.min(1e6, Math.max(-1e6, v));
  const x1 = clamp(way.x(first)), y1 = clamp(way.y(first));
  if (Number.isNaN(x1 + y1)) return null;
  const at = crossing(box, x0, y0, x1, y1), length = Math.hypot(x1 - x0, y1 - y0) || 1;
  return { row: first, time: times[first - 1]! + at.part * (times[first]! - times[first - 1]!), x: at.x, y: at.y, dx: (x1 - x0) / length, dy: (y1 - y0) / length };
}

function marksOf(motion: Motion, line: Line, way: Way, rank: number): number[] {
  const n = line.track.times.length, bodies = motion.subject.bodies.length;
  if (line.track.tolerance !== null && line.track.every === 1 && bodies * n <= MARKED_MOST) {
    let x = Infinity, y = Infinity;
    return Array.from({ length: n }, (_, i) => i).filter((i) => {
      if (!(Math.hypot(way.x(i) - x, way.y(i) - y) >= APART) && Number.isFinite(x)) return false;
      x = way.x(i); y = way.y(i);
      return true;
    });
  }
  if (line.track.every === 1 && bodies * n <= MARKED_ROWS) {
    let length = 0;
    for (let i = 1; i < n; i++) {
      const d = Math.hypot(way.x(i) - way.x(i - 1), way.y(i) - way.y(i - 1));
      if (Number.isFinite(d)) length += Math.min(d, 50);
    }
    if (length >= SPACING * (n - 1)) return Array.from({ length: n }, (_, i) => i);
  }
  if (bodies > 1) return [];
  // Each method's marks at other places than the next one's, so that lines on top of one another show who they are.
  return Array.from({ length: SPARSE }, (_, i) => Math.round((i + (rank + 1) / (motion.lines.length + 1)) * (n - 1) / SPARSE)).filter((i) => i < n);
}

/** Where rows of `times` stand in `all`, which holds their times and others. */
function among(times: Float64Array, rows: readonly number[], all: Float64Array): number[] {
  let at = 0;
  return rows.map((row) => { while (at < all.length - 1 && all[at] !== times[row]) at++; return at; });
}

/** Whether each row of `a` lies where `b` is at its time; at an instant at which it jumps it is at two places. */
function coincide(a: Way, aTimes: ArrayLike<number>, b: Way, bTimes: ArrayLike<number>): boolean {
  const at: Point = { x: 0, y: 0 };
  for (let i = 0; i < aTimes.length; i++) {
    if (aTimes[i] === aTimes[i - 1] || aTimes[i] === aTimes[i + 1]) continue;
    pointAt(b, bTimes, aTimes[i]!, at);
    if (!(Math.abs(a.x(i) - at.x) <= NEAR && Math.abs(a.y(i) - at.y) <= NEAR)) return false;
  }
  return aTimes.length > 0;
}

export function curvesOf(motion: Motion, plot: Plot): Curves {
  const { subject, truth, lines } = motion, waysOf = (of: Rows): Way[] => subject.bodies.map((body) => plot.way(of, body));
  const exact = truth ? waysOf(truth).map((way) => ({ way, path: path(truth.times.length, way.x, way.y, SMOOTH, 0.2) })) : [];
  const size = plot.box.right - plot.box.left + plot.box.bottom - plot.box.top;
  const bodies = subject.bodies.map((body) => numbersOf(motion.scene.solution, body));
  const methods = lines.map((line, rank) => {
    const drawn = lineOf(line.track, subject.bodies.flatMap((body) => body.columns)), { times } = drawn, smooth = drawn !== line.track, ends = smooth ? waysOf(line.track) : [];
    return waysOf(drawn).map((way, body): Curve => {
      const exit = exitOf(way, times.length, times, plot.box), made = path(exit ? exit.row + 1 : times.length, way.x, way.y, ...(smooth ? [SMOOTH, 0.2] : []));
      const marks = marksOf(motion, line, ends[body] ?? way, rank);
      const { events } = line.track, sides = events && { before: plot.way({ times: events.times, columns: events.before }, subject.bodies[body]!), after: plot.way({ times: events.times, columns: events.after }, subject.bodies[body]!) };
      return { events: events && sides ? eventMarks(events, (of, row) => { const side = of === events.after ? sides.after : sides.before; return [side.x(row), side.y(row)]; }, partOf(events, bodies, body)) : [], line, body, way, times, path: made, marks: smooth ? among(line.track.times, marks, times) : marks, band: lengthOf(made) > BAND * size, exit };
    });
  });
  const same = methods.map((own, i) => {
    if (truth && own.every((c, k) => coincide(c.way, c.times, exact[k]!.way, truth.times))) return -1;
    for (let j = 0; j < i; j++) {
      const other = methods[j]!;
      if (own.every((c, k) => c.times.length === other[k]!.times.length && coincide(c.way, c.times, other[k]!.way, other[k]!.times))) return j;
    }
    return i;
  });
  return { exact, methods, same };
}
