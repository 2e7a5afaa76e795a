/* Names at the ends of curves, in the curves' colours, instead of a legend.
 *
 * Invariant: each curve is named once; curves that coincide share a name, "exact = Verlet"; no name covers another. A wide picture has them at the right of
 * its frame, at the height where the curve ends, in room that was kept free by measuring them. A narrow one has them above its frame, each behind its
 * marker, from the highest end to the lowest, and the markers stand at the ends.
 */
import type { Look, Marker } from '../scene';
import { spread } from '../stage/labels';
import { words } from '../words';
import { FAMILY, textWidth } from './shapes';
import { valueAt } from './track';
import type { Frame, Ink, Pen, Span } from './types';

/** Where a curve leaves the frame, in pixels, and in which direction. */
export interface Exit { readonly x: number; readonly y: number; readonly dx: number; readonly dy: number }
export interface End {
  readonly label: string;
  /** Of letters; the marker of the narrow form has it too. */
  readonly colour: string;
  readonly marker: Marker | null;
  /** The last point, in pixels; x absent: at the right of the frame. */
  readonly at: { readonly x?: number; readonly y: number };
  readonly exit?: Exit | null;
  /** Heights of the curve at the same places as the other curves': those that agree to two pixels share their name. Absent: it shares with none. */
  readonly heights?: ArrayLike<number>;
}
export interface EndsLayout {
  /** Room above the frame, and at its right. */
  readonly above: number; readonly right: number; readonly narrow: boolean;
}

const SIZE = 13, SMALL = 12, LINE = 18, GAP = 10, NARROW = 480, SAME = 2, PLACES = 512, ARROW = 16;
/** What axes() itself leaves at the right of a frame. */
const EDGE = 14;
/** The names may take this part of the width. */
const MOST = 0.34;

/** "midpoint" of "midpoint (RK2)", as at the curves of the stage. */
export const shortLabel = (label: string): string => label.replace(/\s*\(.*\)$/, '').replace(/^\S+–\S+–\S+/, (authors) => authors.split('–').map((name) => name.charAt(0)).join(''));
let context: CanvasRenderingContext2D | null | undefined;
/** How wide bold letters are: measured, where there is a page; else nearly. */
export function bold(text: string, size: number): number {
  context ??= typeof document === 'undefined' ? null : document.createElement('canvas').getContext('2d');
  if (!context) return 1.06 * textWidth(text, size);
  context.font = `600 ${size}px ${FAMILY}`;
  return context.measureText(text).width;
}

export function endsLayout(width: number, labels: readonly string[]): EndsLayout {
  if (!labels.length) return { above: 0, right: 0, narrow: width < NARROW };
  if (width >= NARROW) return { above: 0, right: Math.min(MOST * width, Math.max(...labels.map((l) => bold(shortLabel(l), SIZE))) + (labels.length > 1 ? bold(words.stage.equals.trimStart(), SIZE) : 0) + GAP + 4) - EDGE, narrow: false };
  let x = 0, rows = 1;
  for (const label of labels) {
    const wide = item(shortLabel(label)) + ARROW;
    if (x > 0 && x + wide > width) { rows++; x = 0; }
    x += wide + GAP;
  }
  return { above: rows * LINE + 6, right: 0, narrow: true };
}
const item = (text: string): number => 14 + bold(text, SMALL);

/** Where the curve ends in this frame: its last finite point, and the first place where it leaves the frame if it does not come back. rows: how many to draw. */
export function endIn(frame: Frame, x: ArrayLike<number>, y: ArrayLike<number>): { readonly at: { x: number; y: number }; readonly exit: Exit | null; readonly rows: number } {
  const { left, top, width, height } = frame, n = Math.min(x.length, y.length), right = left + width, foot = top + height;
  const inside = (px: number, py: number): boolean => px >= left - 1 && px <= right + 1 && py >= top - 1 && py <= foot + 1;
  let last = n - 1;
  while (last >= 0 && !(Number.isFinite(x[last]!) && Number.isFinite(y[last]!))) last--;
  if (last < 0) return { at: { x: NaN, y: NaN }, exit: null, rows: 0 };
  const at = { x: frame.x(x[last]!), y: frame.y(y[last]!) };
  if (inside(at.x, at.y)) return { at, exit: null, rows: n };
  let out = 0;
  for (let before = false; out <= last; out++) {
    const now = inside(frame.x(x[out]!), frame.y(y[out]!));
    if (before && !now) break;
    before = now;
  }
  const clampX = (v: number): number => Math.min(right, Math.max(left, v)), clampY = (v: number): number => Math.min(foot, Math.max(top, v));
  if (out > last) return { at: { x: clampX(at.x), y: clampY(at.y) }, exit: null, rows: n };
  const x0 = frame.x(x[out - 1]!), y0 = frame.y(y[out - 1]!), x1 = frame.x(x[out]!), y1 = frame.y(y[out]!);
  let part = 1;
  for (const [a, b, low, high] of [[x0, x1, left, right], [y0, y1, top, foot]] as const) {
    if (b > high) part = Math.min(part, Math.max(0, (high - a) / (b - a)));
    if (b < low) part = Math.min(part, Math.max(0, (low - a) / (b - a)));
  }
  const dx = x1 - x0, dy = y1 - y0, size = Math.hypot(dx, dy) || 1;
  const exit = { x: x0 + part * dx, y: y0 + part * dy, dx: dx / size, dy: dy / size };
  return { at: { x: exit.x, y: exit.y }, exit, rows: out + 1 };
}

/** Heights of a curve against time at places that are the same for all of a frame; between its edges, where one time may be beyond a last one by a digit. */
export function heightsIn(frame: Frame, times: ArrayLike<number>, column: ArrayLike<number>): Float64Array {
  return Float64Array.from({ length: PLACES }, (_, k) => frame.y(valueAt(times, column, frame.x.invert(frame.left + frame.width * (k + 0.5) / PLACES))));
}
export const endOf = (look: Look, found: { readonly at: End['at']; readonly exit: Exit | null }, heights?: ArrayLike<number>): End =>
  ({ label: look.label, colour: look.tone, marker: look.marker, at: found.at, exit: found.exit, ...(heights ? { heights } : {}) });

interface Group { readonly members: readonly End[]; readonly y: number; readonly x: number | undefined; readonly exit: Exit | null }
function coincide(a: End, b: End): boolean {
  if (!a.heights || !b.heights || a.exit || b.exit || !(Math.abs(a.at.y - b.at.y) <= SAME)) return false;
  for (let k = 0; k < a.heights.length; k++) {
    const p = a.heights[k]!, q = b.heights[k]!;
    // Neither has a value there: the same; one has none: not.
    if (!(Math.abs(p - q) <= SAME) && (p === p || q === q)) return false;
  }
  return true;
}
function groupsOf(ends: readonly End[]): Group[] {
  const sets: End[][] = [];
  for (const end of ends) {
    if (!Number.isFinite(end.at.y)) continue;
    const set = sets.find(([first]) => first && coincide(first, end));
    if (set) set.push(end); else sets.push([end]);
  }
  return sets.map((members) => ({ members, y: members[0]!.at.y, x: members[0]!.at.x, exit: members[0]!.exit ?? null }));
}

/** One line, or two where it would be wider than the room: "exact" above "= Verlet". From the third name on they are counted, as on the stage. */
function linesOf({ members }: Group, ink: Ink, room: number): Span[][] {
  const [first, second] = members, span = (end: End): Span => ({ text: shortLabel(end.label), colour: end.colour, bold: true }), equals: Span = { text: words.stage.equals, colour: ink.quiet };
  if (!second) return [[span(first!)]];
  const others: Span = members.length === 2 ? span(second) : { text: words.stage.several(String(members.length - 1)), colour: ink.text, bold: true };
  const line = [span(first!), equals, others];
  return bold(line.map((part) => part.text).join(''), SIZE) <= room ? [line] : [[span(first!)], [{ text: words.stage.equals.trimStart(), colour: ink.quiet }, others]];
}

const HEAD = 9;
/** The head of an arrow where a curve leaves. */
function drawExit(pen: Pen, { x, y, dx, dy }: Exit, colour: string): void {
  const side = 0.55 * HEAD, bx = x - HEAD * dx, by = y - HEAD * dy;
  pen.line([bx - side * dy, by + side * dx, x, y, bx + side * dy, by - side * dx], { colour, width: 1.75 });
}

/** Draws the names of these curves; after the curves. */
export function drawEnds(pen: Pen, ink: Ink, frame: Frame, layout: EndsLayout, ends: readonly End[]): void {
  const groups = groupsOf(ends);
  for (const { exit, members } of groups) if (exit) drawExit(pen, exit, members[0]!.colour);
  if (layout.narrow) drawAbove(pen, ink, frame, groups); else drawBeside(pen, ink, frame, layout, groups);
}

function drawAbove(pen: Pen, ink: Ink, frame: Frame, groups: readonly Group[]): void {
  let x = 1, y = LINE / 2;
  for (const { members, exit, x: endX = frame.left + frame.width, y: endY } of [...groups].sort((a, b) => a.y - b.y)) {
    const [first] = members, names = [...members];
    if (!exit && first?.marker) pen.mark(first.marker, endX, Math.min(frame.top + frame.height, Math.max(frame.top, endY)), 4, first.colour, { rim: ink.surface });
    names.forEach((end, k) => {
      const text = shortLabel(end.label), wide = item(text) + (end.exit ? ARROW : 0) + (k > 0 ? 12 : 0);
      if (x > 1 && x + wide > pen.width) { x = 1; y += LINE; }
      let at = x;
      if (k > 0) { pen.text(at, y, words.stage.equals.trim(), { colour: ink.quiet, size: SMALL, baseline: 'middle' }); at += 12; }
      if (end.marker) pen.mark(end.marker, at + 5, y, 3.6, end.colour); else pen.line([at, y, at + 10, y], { colour: end.colour, width: 4 });
      pen.text(at + 14, y, text + (end.exit ? '\u2009↗' : ''), { colour: end.colour, size: SMALL, bold: true, baseline: 'middle' });
      x += wide + (k + 1 < names.length ? 6 : GAP);
    });
  }
}

function drawBeside(pen: Pen, ink: Ink, frame: Frame, layout: EndsLayout, groups: readonly Group[]): void {
  const right = frame.left + frame.width, foot = frame.top + frame.height, letters = { size: SIZE, baseline: 'middle' as const, halo: ink.surface };
  const column: Group[] = [];
  // Those that leave are named where they do, the later ones nearer to the edge, as the earlier ones' names cross their curves else.
  const taken: { readonly from: number; readonly to: number; readonly y: number }[] = [];
  for (const group of [...groups].sort((a, b) => (b.exit?.x ?? 0) - (a.exit?.x ?? 0))) {
    const { exit, members } = group, text = words.stage.leaves(shortLabel(members[0]!.label)), wide = bold(text, SIZE);
    if (!exit) { column.push(group); continue; }
    const after = exit.x + 12 + wide <= right, before = exit.x - 14 - wide >= frame.left;
    if (!after && !before) { column.push(group); continue; }
    const from = after ? exit.x + 12 : exit.x - 14 - wide, to = from + wide, way = exit.y > (frame.top + foot) / 2 ? -1 : 1;
    let y = Math.min(foot - 8, Math.max(frame.top + 8, exit.y));
    while (taken.some((t) => t.from < to + 8 && t.to > from - 8 && Math.abs(t.y - y) < LINE) && y + way * LINE > frame.top && y + way * LINE < foot) y += way * LINE;
    taken.push({ from, to, y });
    pen.text(from, y, [{ text, bold: true }], { ...letters, colour: members[0]!.colour });
  }
  column.sort((a, b) => a.y - b.y);
  const room = layout.right + EDGE - GAP, lines = column.map((group) => linesOf(group, ink, room));
  const total = lines.reduce((sum, l) => sum + l.length, 0), line = Math.min(LINE, (frame.height + 16) / Math.max(1, total));
  const gaps = lines.slice(1).map((l, k) => line * (l.length + lines[k]!.length) / 2);
  const heights = spread(column.map((g) => Math.min(foot, Math.max(frame.top, g.y))), gaps, frame.top + 2, foot - 4);
  column.forEach((group, k) => {
    const y = heights[k]!, { x = right, y: end, members } = group, height = Math.min(foot, Math.max(frame.top, end));
    if (Math.abs(y - height) > 6 || x < right - 6) pen.line([x + 3, height, right + GAP - 3, y], { colour: members[0]!.colour, width: 1, alpha: 0.5 });
    lines[k]!.forEach((spans, i, all) => pen.text(right + GAP, y + line * (i - (all.length - 1) / 2), spans, { ...letters, colour: members[0]!.colour }));
  });
}
