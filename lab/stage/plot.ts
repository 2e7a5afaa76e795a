/* From the numbers of a motion to pixels of the stage, and the axes: of a plane, of a number against time, of a phase plane, of space.
 *
 * Invariant: a plot maps straight lines to straight lines, so what lies between two rows lies between their pixels.
 */
import { scaleAlong, scaleOf } from '../figure/axes';
import { nameSpans } from '../figure/name';
import { textWidth } from '../figure/shapes';
import { grouped, minus, readable } from '../figure/number';
import type { Ink, Pen, Scale, Span } from '../figure/types';
import { words } from '../words';
import type { Bounds, Range } from './bounds';
import type { Rows } from './motion';
import type { Box } from './place';
import { velocityColumn, type Body } from './subject';
import type { Solution } from '../protocol';

/** Pixels of a row. */
export interface Way { x(row: number): number; y(row: number): number }
export interface Plot {
  /** Curves are drawn inside. */
  readonly box: Box;
  way(of: Rows, body: Body): Way;
  draw(pen: Pen, ink: Ink): void;
  /** Pixels of a unit, where both axes have the same; else null. */
  readonly unit: number | null;
  /** Where the numbers of the second axis begin; null: it has none of its own. */
  readonly numbers: number | null;
  /** Of a flat plot: pixels of the second axis. */
  readonly up: Scale | null; readonly along: Scale | null;
}
export type Style = 'ground' | 'plane' | 'time' | 'phase';
export interface Axis { readonly name: string; readonly unit: string }
const EMPTY = new Float64Array(0);
export const inside = (box: Box, x: number, y: number, more = 0): boolean => x >= box.left - more && x <= box.right + more && y >= box.top - more && y <= box.bottom + more;

/** The largest frame of these proportions in a box; at its foot and its left on the ground, in its middle else. */
function fitted(box: Box, x: Range, y: Range, ground: boolean): Box {
  const width = box.right - box.left, height = box.bottom - box.top, unit = Math.min(width / (x[1] - x[0]), height / (y[1] - y[0]));
  const w = unit * (x[1] - x[0]), h = unit * (y[1] - y[0]);
  const left = ground ? box.left : box.left + (width - w) / 2, top = ground ? box.bottom - h : box.top + (height - h) / 2;
  return { left, top, right: left + w, bottom: top + h };
}

export interface Flat { readonly bounds: Bounds; readonly box: Box; readonly equal: boolean; readonly style: Style; readonly axes: readonly [Axis, Axis]; readonly solution: Solution; readonly letters: number; readonly fine?: boolean;
  /** Where numbers beside the axis may begin. */
  readonly edge?: number }

export function flatPlot({ bounds, box: given, equal, style, axes: [across, upward], solution, letters, fine, edge = 0 }: Flat): Plot {
  const crisp = (p: number): number => (fine ? p : Math.round(p) + 0.5);
  const x = bounds[0]!, y = bounds[1]!;
  // Numbers stand at the left of the frame, which leaves them their room.
  const rough = scaleOf({ min: y[0], max: y[1], label: '' }, given.bottom, given.top, 4), widest = Math.max(...rough.ticks.map((v) => textWidth(rough.label(v), 12 * letters)), 0);
  const box = style === 'ground' || style === 'phase' ? given : { ...given, left: Math.min(Math.max(given.left, edge + widest + 12), given.right - 60) };
  const frame = equal ? fitted(box, x, y, style === 'ground') : box;
  const size = 12 * letters, small = frame.right - frame.left < 480, count = Math.max(2, Math.round((frame.bottom - frame.top) / ((small ? 56 : style === 'ground' ? 118 : 64) * letters)));
  const up = scaleOf({ min: y[0], max: y[1], label: '' }, frame.bottom, frame.top, count);
  const along = scaleAlong({ min: x[0], max: x[1], label: '' }, frame.left, frame.right, (small ? 48 : 110) * letters);
  const quiet = (ink: Ink) => ({ colour: ink.quiet, size });

  function ground(pen: Pen, ink: Ink): void {
    const zero = crisp(up(Math.max(0, y[0]))), last = along.ticks[along.ticks.length - 1] ?? x[1], heights = up.ticks.filter((v) => v > y[0] && up(v) > frame.top + (small ? 14 : 40));
    heights.forEach((v, k) => {
      const at = crisp(up(v));
      pen.line([frame.left + 4, at, along(last), at], { colour: ink.grid, width: 1 });
      pen.text(frame.left + 4, at - 5, up.label(v) + (k === heights.length - 1 ? ` ${upward.unit}` : ''), quiet(ink));
    });
    pen.line([0, zero, pen.width, zero], { colour: ink.axis, width: 1.5 });
    for (const v of along.ticks) {
      pen.line([along(v), zero, along(v), zero + 5], { colour: ink.axis, width: 1.5 });
      pen.text(along(v), zero + 20 * Math.sqrt(letters), along.label(v) + (v === last ? ` ${across.unit}` : ''), { ...quiet(ink), anchor: 'middle' });
    }
  }
  /** Numbers that nearly agree say by how much they differ from this one. */
  const from = (base: number): Span[] => (base === 0 ? [] : [{ text: `  ${Number.isInteger(base) ? minus(grouped(base)) : minus(String(Number(base.toPrecision(15))))} +`, size }]);
  /** Beside the numbers, above the highest of them; over the picture where the stage ends. */
  function nameUp(pen: Pen, ink: Ink, name: Span[]): void {
    const fits = frame.left - 10 - textWidth(name, 15 * letters) >= edge;
    pen.text(fits ? frame.left - 10 : edge + 4, frame.top - (fits ? 2 : 10), name, { colour: ink.text, size: 15 * letters, anchor: fits ? 'end' : 'start', baseline: 'bottom' });
  }
  function time(pen: Pen, ink: Ink): void {
    const low = Math.round(frame.bottom) + 0.5;
    for (const v of up.ticks) {
      const at = crisp(up(v));
      if (at < low - 2) pen.line([frame.left, at, frame.right, at], { colour: v === 0 ? ink.ghost : ink.grid, width: v === 0 ? 1.5 : 1 });
      pen.text(frame.left - 10, up(v), up.label(v), { ...quiet(ink), anchor: 'end', baseline: 'middle' });
    }
    pen.line([frame.left, low, frame.right, low], { colour: ink.axis, width: 1.25 });
    const last = along.ticks[along.ticks.length - 1];
    for (const v of along.ticks) {
      pen.line([crisp(along(v)), low, crisp(along(v)), low + 5], { colour: ink.axis, width: 1.25 });
      const tail: Span[] = v !== last ? [] : across.unit ? [{ text: ` ${across.unit}` }] : [{ text: ' ' }, { text: across.name, italic: true, colour: ink.text }];
      pen.text(along(v), low + 20, [{ text: along.label(v) }, ...tail], { ...quiet(ink), anchor: 'middle' });
    }
    nameUp(pen, ink, [...nameSpans(upward.name, 15 * letters), ...from(up.base)]);
    if (along.base !== 0) pen.text(frame.right, low + 36, from(along.base), { ...quiet(ink), anchor: 'end' });
  }
  function plane(pen: Pen, ink: Ink): void {
    const bare = style === 'phase';
    for (const v of up.ticks) {
      pen.line([frame.left, crisp(up(v)), frame.right, crisp(up(v))], { colour: v === 0 ? ink.ghost : ink.grid, width: v === 0 ? 1.5 : 1 });
      if (!bare) pen.text(frame.left - 8, up(v), up.label(v), { ...quiet(ink), anchor: 'end', baseline: 'middle' });
    }
    for (const v of along.ticks) {
      pen.line([crisp(along(v)), frame.top, crisp(along(v)), frame.bottom], { colour: v === 0 ? ink.ghost : ink.grid, width: v === 0 ? 1.5 : 1 });
      pen.text(along(v), frame.bottom + 19, along.label(v), { ...quiet(ink), anchor: 'middle' });
    }
    const name = (axis: Axis, base: number): Span[] => [...nameSpans(axis.name, 15 * letters), ...(axis.unit ? [{ text: ` (${axis.unit})`, size }] : []), ...from(base)];
    const along_: Span[] = bare ? [{ text: words.stage.velocity, size, colour: ink.quiet }, ...nameSpans(across.name, 15 * letters)] : name(across, along.base), letter = { colour: ink.text, size: 15 * letters };
    // Below the numbers, or behind the last of them where the stage ends.
    const last = along.ticks[along.ticks.length - 1] ?? x[1], behind = Math.max(frame.right, along(last) + textWidth(along.label(last), size) / 2) + 8;
    if (frame.bottom + 40 <= pen.height) pen.text(frame.right, frame.bottom + 36, along_, { ...letter, anchor: 'end' });
    else pen.text(Math.min(behind, pen.width - textWidth(along_, 15 * letters) - 2), frame.bottom + 19, along_, letter);
    if (!bare) nameUp(pen, ink, name(upward, up.base));
  }
  const column = (of: Rows, body: Body, k: number): ArrayLike<number> => {
    if (style === 'time') return k === 0 ? of.times : of.columns[body.columns[0]!] ?? EMPTY;
    if (style === 'phase') return of.columns[k === 0 ? velocityColumn(solution, body.columns[0]!) : body.columns[0]!] ?? EMPTY;
    return of.columns[body.columns[k]!] ?? EMPTY;
  };
  return {
    numbers: style === 'plane' ? frame.left - 8 - Math.max(0, ...up.ticks.map((v) => textWidth(up.label(v), size))) : null,
    // Curves may leave the bounds where the stage has room beside them, but not what stands below the ground or the axis.
    box: style === 'ground' ? { left: Math.max(0, frame.left - 12), top: 0, right: box.right + 500, bottom: up(Math.max(0, y[0])) } : equal && style === 'plane' ? box : frame,
    unit: equal ? (frame.right - frame.left) / (x[1] - x[0]) : null, up, along,
    way(of, body) {
      const a = column(of, body, 0), b = column(of, body, 1);
      return { x: (row) => along(a[row] ?? NaN), y: (row) => up(b[row] ?? NaN) };
    },
    draw(pen, ink) {
      if (style === 'ground') ground(pen, ink); else if (style === 'time') time(pen, ink); else plane(pen, ink);
    },
  };
}

/** Angles in radians: round the upright axis, and above the horizon. */
export interface Camera { turn: number; rise: number }
export const HOME: Readonly<Camera> = { turn: -0.65, rise: 0.45 };
export function turned(camera: Camera, turn: number, rise: number): void {
  camera.turn = (camera.turn + turn) % (2 * Math.PI);
  camera.rise = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, camera.rise + rise));
}
const EDGES: readonly (readonly [number, number])[] = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

/** A box in parallel projection: a unit is as long along all three axes, and turning changes neither the scale nor what is inside. */
export function spacePlot(bounds: Bounds, box: Box, camera: Camera, axes: readonly Axis[], letters: number): Plot {
  const middle = bounds.map((r) => (r[0] + r[1]) / 2), half = bounds.map((r) => (r[1] - r[0]) / 2);
  const unit = Math.min(box.right - box.left, box.bottom - box.top) / 2 / (Math.hypot(...half) || 1) * 1.12;
  const ct = Math.cos(camera.turn), st = Math.sin(camera.turn), cr = Math.cos(camera.rise), sr = Math.sin(camera.rise);
  const cx = (box.left + box.right) / 2, cy = (box.top + box.bottom) / 2;
  const x = (a: number, b: number): number => cx + unit * (ct * (a - middle[0]!) - st * (b - middle[1]!));
  const y = (a: number, b: number, c: number): number => cy - unit * (cr * (c - middle[2]!) + sr * (st * (a - middle[0]!) + ct * (b - middle[1]!)));
  const depth = ([a, b, c]: readonly number[]): number => cr * (st * a! + ct * b!) - sr * c!;      // away from the eye
  const corners = Array.from({ length: 8 }, (_, k) => [0, 1, 2].map((d) => bounds[d]![(k >> d & 1) as 0 | 1]));
  const at = corners.map((p) => [x(p[0]!, p[1]!), y(p[0]!, p[1]!, p[2]!)] as const);
  const nearest = corners.reduce((best, p, k) => (depth(p) < depth(corners[best]!) ? k : best), 0);

  /* Each axis is named at the edge of the outline that is lowest, or for the upright one leftmost; with the numbers of its ends. */
  function name(pen: Pen, ink: Ink, d: number, taken: Box[]): void {
    let best: readonly [number, number] | null = null, score = -Infinity;
    for (const [i, j] of EDGES) {
      if ((j ^ i) !== 1 << d || i === nearest || j === nearest) continue;
      const s = d === 2 ? -(at[i]![0] + at[j]![0]) : at[i]![1] + at[j]![1];
      if (s > score) { score = s; best = [i, j]; }
    }
    if (!best) return;
    const [x0, y0] = at[best[0]]!, [x1, y1] = at[best[1]]!;
    if (Math.hypot(x1 - x0, y1 - y0) < 24) return;
    const mx = (x0 + x1) / 2, my = (y0 + y1) / 2, away = Math.hypot(mx - cx, my - cy) || 1;
    const ox = (mx - cx) / away * 14, oy = (my - cy) / away * 14, anchor = ox > 5 ? 'start' : ox < -5 ? 'end' : 'middle';
    // Within the stage, where the box is as wide as it.
    const called = nameSpans(axes[d]?.name ?? '', 15 * letters), room = textWidth(called, 15 * letters) + 2, most = pen.width - (anchor === 'start' ? room : 2);
    pen.text(Math.min(most, Math.max(anchor === 'end' ? room : 2, mx + ox)), my + oy, called, { colour: ink.text, size: 15 * letters, anchor, baseline: 'middle' });
    for (const [end, value] of [[0, bounds[d]![0]], [1, bounds[d]![1]]] as const) {
      const text = readable(value, 2), wide = textWidth(text, 12 * letters), half = 7 * letters;
      // Where two axes meet, the number of the later one moves along its own; what finds no room is left out.
      for (const inwards of [0.08, 0.16, 0.24, 0.32]) {
        const share = end ? 1 - inwards : inwards, wanted = x0 + (x1 - x0) * share + ox * 0.8, before = anchor === 'end' ? wide : anchor === 'middle' ? wide / 2 : 0, x = Math.min(pen.width - 2 - wide + before, Math.max(2 + before, wanted)), y = y0 + (y1 - y0) * share + oy * 0.8;
        const left = anchor === 'end' ? x - wide : anchor === 'middle' ? x - wide / 2 : x, own = { left: left - 3, right: left + wide + 3, top: y - half, bottom: y + half };
        if (taken.some((t) => t.left < own.right && own.left < t.right && t.top < own.bottom && own.top < t.bottom)) continue;
        taken.push(own);
        pen.text(x, y, text, { colour: ink.quiet, size: 12 * letters, anchor, baseline: 'middle' });
        break;
      }
    }
  }
  return {
    box, unit, numbers: null, up: null, along: null,
    way(of, body) {
      const [a, b, c] = body.columns.map((k) => of.columns[k] ?? EMPTY) as [Float64Array, Float64Array, Float64Array];
      return { x: (row) => x(a[row] ?? NaN, b[row] ?? NaN), y: (row) => y(a[row] ?? NaN, b[row] ?? NaN, c[row] ?? NaN) };
    },
    draw(pen, ink) {
      for (const [i, j] of EDGES) {
        // The edges that meet at the corner next to the eye would run across the motion.
        const front = i === nearest || j === nearest;
        pen.line([...at[i]!, ...at[j]!], { colour: front ? ink.grid : ink.ghost, width: 1, dash: front ? [2, 4] : [] });
      }
      const taken: Box[] = [];
      for (let d = 0; d < 3; d++) name(pen, ink, d, taken);
    },
  };
}
