/* The motion as lines: paths in the plane or in space, or curves in time, with what moves at the present time.
 *
 * Invariant: what does not change with the time is drawn once (draw); a frame of the animation draws the part of each line that the time has reached,
 * and the points (overlay). Both read the same paths, made once for a size of the picture.
 */
import type { Ink, Pen } from '../../figure/types';
import type { Line, Motion, View } from './view';
import { drawNames } from './view';
import { brief } from '../../figure/number';
import type { Path } from './path';
import { lengthOf, path, trail } from './path';
import { isOver, placeAt, valueAt } from './rows';
import type { Cloud, ViewBox } from './view_box';
import { leavesAt, viewBox } from './view_box';
import type { Body } from './subject';
import { velocityColumn } from './subject';
import { blankPen } from './blank_pen';

/** From the numbers of the model to pixels. c is not used in flat pictures. */
export interface Projection {
  x(a: number, b: number, c: number): number;
  y(a: number, b: number, c: number): number;
  readonly left: number; readonly top: number; readonly width: number; readonly height: number;
  /** Where a curve's points slide along an edge of their own: its x. */
  readonly rail: number | null;
  readonly remark: string;
}
/** Draws the axes below the legend, `top` pixels down, and says where things lie. */
export type Backdrop = (pen: Pen, ink: Ink, box: ViewBox, top: number) => Projection;

const FAINT = 0.42, WIDTH = 1.75, EXACT = 5;
/* Beyond so many times the picture's size a line is a band: thousands of dashes, which nobody sees, would cost most of a frame. */
const BAND = 5;
/* Every step is marked while the marks can be told apart; else a few, to tell the lines apart. */
const MARKED_ROWS = 240, MARK_SPACING = 8, SPARSE = 9, LIVE_MARKS = 400;

interface Drawn { readonly line: Line; readonly body: number; readonly path: Path; readonly marks: readonly number[]; readonly band: boolean }
interface Layout { readonly projection: Projection; readonly drawn: readonly Drawn[]; readonly truth: readonly Path[] }

/** moving: the backdrop itself may have changed (a camera), so draw makes the paths anew. */
export function linesView(motion: Motion, backdrop: Backdrop, moving = false): View {
  const { subject, lines, truth } = motion;
  const inTime = subject.kind === 'time';
  const dimensions = subject.axes.length;
  const place = { row: 0, part: 0 };
  const layouts = new Map<string, Layout>();

  /* Coordinate k of a body along a track or the truth; the time is the first one of a curve. */
  const columnOf = (of: { readonly times: Float64Array; readonly columns: readonly Float64Array[] }, body: Body, k: number): ArrayLike<number> =>
    inTime && k === 0 ? of.times : of.columns[body.columns[inTime ? 0 : k] ?? -1] ?? EMPTY;
  const cloudOf = (of: { readonly times: Float64Array; readonly columns: readonly Float64Array[] }): Cloud =>
    Array.from({ length: dimensions }, (_, k) => subject.bodies.map(b => columnOf(of, b, k)));

  const clouds = lines.map(l => cloudOf(l.track));
  let box = viewBox(truth ? cloudOf(truth) : null, clouds, dimensions);
  if (inTime) box = { ...box, ranges: [wholeTime(motion), box.ranges[1]!] };
  const leaving = lines.map((_, i) => box.runaway[i] ? leavesAt(clouds[i]!, box.ranges) : -1);

  const pathsOf = (of: { readonly times: Float64Array; readonly columns: readonly Float64Array[] }, p: Projection): Path[] => subject.bodies.map(body => {
    const a = columnOf(of, body, 0), b = columnOf(of, body, 1), c = dimensions > 2 ? columnOf(of, body, 2) : null;
    const z = (row: number): number => c ? c[row]! : 0;
    return path(of.times.length, row => p.x(a[row]!, b[row]!, z(row)), row => p.y(a[row]!, b[row]!, z(row)));
  });

  function marksOf(line: Line, body: Body, p: Projection, rank: number): number[] {
    const n = line.track.times.length;
    const a = columnOf(line.track, body, 0), b = columnOf(line.track, body, 1), c = dimensions > 2 ? columnOf(line.track, body, 2) : null;
    if (line.track.every === 1 && n <= MARKED_ROWS && subject.bodies.length * n <= MARKED_ROWS) {
      let way = 0;
      for (let i = 1; i < n; i++) {
        const d = Math.hypot(p.x(a[i]!, b[i]!, c?.[i] ?? 0) - p.x(a[i - 1]!, b[i - 1]!, c?.[i - 1] ?? 0), p.y(a[i]!, b[i]!, c?.[i] ?? 0) - p.y(a[i - 1]!, b[i - 1]!, c?.[i - 1] ?? 0));
        if (Number.isFinite(d)) way += Math.min(d, 50);
      }
      if (way >= MARK_SPACING * (n - 1)) return Array.from({ length: n }, (_, i) => i);
    }
    if (subject.bodies.length > 1) return [];
    /* Each method's marks at other places than the next one's, so that lines on top of one another show who they are. */
    return Array.from({ length: SPARSE }, (_, i) => Math.round((i + (rank + 1) / (lines.length + 1)) * (n - 1) / SPARSE)).filter(i => i < n);
  }

  function made(pen: Pen, ink: Ink): Layout {
    const top = drawNames(pen, ink, motion);
    const projection = backdrop(pen, ink, box, top);
    const drawn: Drawn[] = [];
    lines.forEach((line, rank) => pathsOf(line.track, projection).forEach((p, body) =>
      drawn.push({ line, body, path: p, marks: marksOf(line, subject.bodies[body]!, projection, rank), band: lengthOf(p) > BAND * (pen.width + pen.height) })));
    return { projection, drawn, truth: truth ? pathsOf(truth, projection) : [] };
  }

  function layout(pen: Pen, ink: Ink): Layout {
    const key = `${pen.width}x${pen.height}`;
    let found = layouts.get(key);
    if (!found) {
      if (layouts.size > 3) layouts.clear();
      found = made(blankPen(pen.width, pen.height), ink);
      layouts.set(key, found);
    }
    return found;
  }

  const point = (of: { readonly times: Float64Array; readonly columns: readonly Float64Array[] }, body: Body, time: number, p: Projection): [number, number] => {
    placeAt(of.times, time, place);
    const a = inTime ? (place.part === 0 ? of.times[place.row]! : valueAt(of.times, place)) : valueAt(columnOf(of, body, 0), place);
    const b = valueAt(columnOf(of, body, 1), place), c = dimensions > 2 ? valueAt(columnOf(of, body, 2), place) : 0;
    return [p.x(a, b, c), p.y(a, b, c)];
  };

  function marks(pen: Pen, d: Drawn, p: Projection, upTo: number, radius: number): void {
    const body = subject.bodies[d.body]!;
    const a = columnOf(d.line.track, body, 0), b = columnOf(d.line.track, body, 1), c = dimensions > 2 ? columnOf(d.line.track, body, 2) : null;
    for (const i of d.marks) {
      if (i > upTo) break;
      const x = p.x(a[i]!, b[i]!, c?.[i] ?? 0), y = p.y(a[i]!, b[i]!, c?.[i] ?? 0);
      if (x >= p.left - 4 && x <= p.left + p.width + 4 && y >= p.top - 4 && y <= p.top + p.height + 4) pen.mark(d.line.look.marker, x, y, radius, d.line.look.colour);
    }
  }

  function initialVelocities(pen: Pen, ink: Ink, p: Projection): void {
    if (subject.bodies.length > 8) return;
    const from = truth ?? lines[0]?.track;
    if (!from) return;
    /* Of several bodies the fastest has the longest arrow. */
    const speeds: number[] = [], made: { readonly x: readonly number[]; readonly v: readonly number[] }[] = [];
    for (const body of subject.bodies) {
      const columns = body.columns.map(c => velocityColumn(motion.scene.solution, c));
      if (columns.some(c => c < 0)) continue;
      const x = Array.from({ length: dimensions }, (_, k) => columnOf(from, body, k)[0] ?? NaN);
      const v = [...(inTime ? [Math.sign((from.times[1] ?? 1) - from.times[0]!) || 1] : []), ...columns.map(c => (from.columns[c]?.[0] ?? lines[0]?.track.columns[c]?.[0]) ?? NaN)];
      made.push({ x, v });
      speeds.push(Math.hypot(...v));
    }
    const fastest = Math.max(...speeds);
    made.forEach(({ x, v }, i) => arrowAlong(pen, ink, p, x, v, box, inTime, inTime ? 1 : speeds[i]! / fastest, subject.bodies.length <= 3));
  }

  const clipped = (pen: Pen, p: Projection, inside: () => void): void => pen.clip(p.left - 1, p.top - 1, p.width + 2, p.height + 2, inside);

  function draw(pen: Pen, ink: Ink): void {
    if (moving) layouts.clear();
    const l = made(pen, ink), p = l.projection;
    layouts.set(`${pen.width}x${pen.height}`, l);
    clipped(pen, p, () => {
      for (const t of l.truth) pen.line(t.xy, { colour: ink.exact, width: EXACT }, 2 * t.count);
      for (let i = l.drawn.length - 1; i >= 0; i--) {
        const d = l.drawn[i]!;
        pen.line(d.path.xy, { colour: d.line.look.colour, width: WIDTH, dash: d.line.look.dash, alpha: FAINT }, 2 * d.path.count);
      }
      for (let i = l.drawn.length - 1; i >= 0; i--) marks(pen, l.drawn[i]!, p, Infinity, l.drawn[i]!.marks.length > 2 * SPARSE ? 2 : 3);
    });
    notes(pen, ink, p);
  }

  function notes(pen: Pen, ink: Ink, p: Projection): void {
    let y = p.top + 8;
    lines.forEach((line, i) => {
      const said = departure(line, leaving[i]!);
      if (!said) return;
      pen.text(p.left + p.width - 8, y, said, { colour: ink.quiet, size: 12, anchor: 'end', baseline: 'top' });
      y += 16;
    });
    if (p.remark) pen.text(p.left + 8, p.top + p.height - 8, p.remark, { colour: ink.quiet, size: 11, baseline: 'bottom' });
  }

  function overlay(pen: Pen, ink: Ink, time: number): void {
    const l = layout(pen, ink), p = l.projection;
    let live = 0;
    for (const d of l.drawn) live += d.marks.length;
    const ends: { readonly x: number; readonly y: number; readonly d: Drawn; readonly over: boolean }[] = [];
    clipped(pen, p, () => {
      for (let i = l.drawn.length - 1; i >= 0; i--) {
        const d = l.drawn[i]!, body = subject.bodies[d.body]!;
        const [x, y] = point(d.line.track, body, time, p);
        const reached = place.row + (place.part === 1 ? 1 : 0);
        const so = trail(d.path, reached, x, y);
        pen.line(so.xy, { colour: d.line.look.colour, width: WIDTH + 0.5, dash: d.band ? [] : d.line.look.dash }, so.count);
        if (live <= LIVE_MARKS && d.marks.length > 2 * SPARSE) marks(pen, d, p, reached, 2.8);
        ends.push({ x, y, d, over: isOver(d.line.track.times, time) });
      }
    });
    initialVelocities(pen, ink, p);
    if (p.rail !== null) pen.line([p.rail, p.top, p.rail, p.top + p.height], { colour: ink.axis, width: 1 });
    const inside = (x: number, y: number): boolean => x >= p.left - 8 && x <= p.left + p.width + 8 && y >= p.top - 8 && y <= p.top + p.height + 8;
    if (truth) subject.bodies.forEach(body => {
      const [x, y] = point(truth, body, time, p);
      if (!inside(x, y)) return;
      if (p.rail !== null) pen.line([x, y, p.rail, y], { colour: ink.exact, width: 1, alpha: 0.5 });
      for (const at of p.rail === null ? [x] : [x, p.rail]) {
        pen.mark('circle', at, y, 10, ink.surface);
        pen.mark('circle', at, y, 8.5, ink.exact);
      }
    });
    for (const { x, y, d, over } of ends) {
      if (over || !inside(x, y)) continue;
      for (const at of p.rail === null ? [x] : [x, p.rail]) {
        pen.mark('circle', at, y, 5.4, ink.surface);
        pen.mark(d.line.look.marker, at, y, 4.2, d.line.look.colour);
      }
      if (subject.bodies.length > 1 && subject.bodies.length <= 10 && d.line === lines[0])
        pen.text(x + 9, y - 8, subject.bodies[d.body]!.label, { colour: ink.quiet, size: 11, baseline: 'bottom' });
    }
  }

  return {
    draw, overlay,
    remarks: () => lines.map((line, i) => departure(line, leaving[i]!)).filter(s => s !== ''),
  };
}

const EMPTY = new Float64Array(0);

function departure(line: Line, row: number): string {
  const { problem, times } = line.track;
  if (problem) return `${line.look.label} stops at t = ${brief(problem.time ?? times[times.length - 1] ?? 0)}${problem.variable ? `: ${problem.variable} is no finite number` : ''}`;
  return row >= 0 ? `${line.look.label} first leaves the picture at t = ${brief(times[row] ?? 0)}` : '';
}

/* Methods that stopped early do not shorten the time that is shown. */
function wholeTime(motion: Motion): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const { times } of [...motion.lines.map(l => l.track), ...(motion.truth ? [motion.truth] : [])]) {
    low = Math.min(low, times[0]!, times[times.length - 1]!);
    high = Math.max(high, times[0]!, times[times.length - 1]!);
  }
  return high > low ? [low, high] : [low - 1, low + 1];
}

/* An arrow in the direction of the velocity, of a length that can be seen whatever the units; it tells the direction, and relative lengths only. */
function arrowAlong(pen: Pen, ink: Ink, p: Projection, x: readonly number[], v: readonly number[], box: ViewBox, inTime: boolean, share: number, named: boolean): void {
  const at = (k: number, s: number): number => (x[k] ?? 0) + s * (v[k] ?? 0);
  const x0 = p.x(at(0, 0), at(1, 0), at(2, 0)), y0 = p.y(at(0, 0), at(1, 0), at(2, 0));
  const size = Math.max(...box.ranges.map(r => r[1] - r[0])), speed = Math.hypot(...v);
  if (!(speed > 0) || !(size > 0) || !Number.isFinite(speed) || (inTime && v[1] === 0)) return;
  const unit = 1e-3 * size / speed;
  const dx = p.x(at(0, unit), at(1, unit), at(2, unit)) - x0, dy = p.y(at(0, unit), at(1, unit), at(2, unit)) - y0, d = Math.hypot(dx, dy);
  if (!(d > 1e-9)) return;
  const length = Math.min(80, 0.25 * Math.min(p.width, p.height)) * share;
  if (!(length > 6)) return;
  const ux = dx / d, uy = dy / d, x1 = x0 + ux * length, y1 = y0 + uy * length;
  pen.arrow(x0, y0, x1, y1, { colour: ink.surface, width: 5 });
  pen.arrow(x0, y0, x1, y1, { colour: ink.text, width: 2.25 });
  if (!named) return;
  /* Beside the tip, on the side that a force downwards leaves free. */
  const side = ux >= 0 ? 1 : -1;
  pen.text(x1 + side * uy * 14, Math.max(y1 - side * ux * 14, p.top + 9), 'v₀', { colour: ink.text, size: 14, italic: true, anchor: 'middle', baseline: 'middle' });
}
