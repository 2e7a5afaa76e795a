/* Draws one step: the exact motion in green, what each line of the recipe does with its disc, the end and by how much it misses.
 *
 * Invariant: the frame holds the whole step, whichever line is on show, so nothing jumps while one goes through the lines. Disc k belongs to line k.
 */
import { nameSpans } from '../../figure/name';
import { textWidth } from '../../figure/shapes';
import type { Ink, Pen, Span, Stroke } from '../../figure/types';
import type { Look } from '../../scene';
import type { Mark, Place, Recipe } from './recipe';
import type { Seen } from './seen';

export interface Curve { readonly x: ArrayLike<number>; readonly y: ArrayLike<number> }
export interface StepPicture {
  readonly recipe: Recipe; readonly seen: Seen; readonly look: Look;
  /** The exact motion: through the start of the step, and where it is when the step ends. */
  readonly green: Curve | null; readonly exact: Place | null;
  /** Where steps that were refused would have led. */
  readonly refused: readonly Place[]; readonly refusedWord: string;
  /** "0.017 too low"; ''. */
  readonly miss: string;
  /** The line up to which it is drawn; -1: all of it. */
  readonly line: number;
  /** What stands below times, those that matter most first; from the longest to the shortest way to say it. */
  readonly times: readonly { readonly at: number; readonly says: readonly string[] }[];
  readonly ends: readonly [start: string, end: string];
}

const DISC = 11, STRIP = 2.5, COMING = 0.2, REFUSED = 0.55, LOW = 30;
type Point = readonly [number, number];
interface Frame { at(place: Place): Point; along(of: Place): Point }

function frameOf({ recipe, seen, green, exact, refused }: StepPicture, width: number, height: number): Frame {
  const flat = seen.indices.length === 1, { before, from, to } = recipe;
  const xs = [from[0], to[0]], ys = [from[1], to[1]], take = ([x, y]: Place): void => { if (Number.isFinite(x + y)) { xs.push(x); ys.push(y); } };
  for (const m of [...recipe.lines.flatMap((l) => l.marks), ...recipe.rest]) {
    if ('from' in m) { take(m.from); take(m.to); }
    else if (m.kind === 'stroke') for (const way of [-0.16, 0.16]) take([m.at[0] + way * m.along[0], m.at[1] + way * m.along[1]]);
    else take(m.at);
  }
  if (before) take(before);
  if (exact) take(exact);
  for (const place of refused) take(place);
  if (green) for (let i = 0; i < green.x.length; i++) take([green.x[i]!, green.y[i]!]);
  const range = (of: number[]): [number, number] => [Math.min(...of), Math.max(...of)], [x0, x1] = range(xs), [y0, y1] = range(ys);
  const room = { left: 56, right: 60, top: 38, bottom: flat ? LOW + 24 : 44 }, w = Math.max(40, width - room.left - room.right), h = Math.max(40, height - room.top - room.bottom);
  const size = Math.max(Math.abs(y0), Math.abs(y1)), spanY = y1 - y0 > 1e-13 * size ? y1 - y0 : 0;
  if (flat) {
    const a = (before ?? from)[0], b = [to, ...refused].map(([t]) => t).reduce((p, t) => (Math.abs(t - a) > Math.abs(p - a) ? t : p)), left = (before ? 0.1 : 0.13) * width, right = (before ? 0.88 : 0.8) * width, sx = (right - left) / (b - a || 1), sy = spanY ? h / spanY : 0;
    return { at: ([t, v]) => [left + sx * (t - a), spanY ? room.top + sy * (y1 - v) : room.top + h / 2], along: ([t, v]) => [sx * t, -sy * v] };
  }
  const spanX = x1 - x0 > 1e-13 * Math.max(Math.abs(x0), Math.abs(x1)) ? x1 - x0 : 0, equal = spanX < STRIP * spanY && spanY < STRIP * spanX;
  let sx = spanX ? w / spanX : 0, sy = spanY ? h / spanY : 0;
  if (equal) sx = sy = Math.min(sx, sy);
  const left = room.left + (w - sx * spanX) / 2, top = room.top + (h - sy * spanY) / 2;
  return { at: ([x, y]) => [left + sx * (x - x0), top + sy * (y1 - y)], along: ([x, y]) => [sx * x, -sy * y] };
}

/** What is drawn already, so that discs and words find free places. */
class Taken {
  private readonly points: Point[] = [];
  private readonly boxes: (readonly [x: number, y: number, halfWidth: number, halfHeight: number])[] = [];
  line(a: Point, b: Point): void {
    const n = Math.min(200, Math.ceil(Math.hypot(b[0] - a[0], b[1] - a[1]) / 7));
    for (let k = 0; k <= n; k++) this.points.push([a[0] + (b[0] - a[0]) * k / Math.max(1, n), a[1] + (b[1] - a[1]) * k / Math.max(1, n)]);
  }
  box(x: number, y: number, w: number, h: number): void { this.boxes.push([x, y, w, h]); }
  /** How free the place is for something so large, up to some pixels. */
  free(x: number, y: number, w: number, h: number): number {
    let least = 16;
    for (const [px, py] of this.points) least = Math.min(least, Math.hypot(Math.max(0, Math.abs(px - x) - w), Math.max(0, Math.abs(py - y) - h)));
    for (const [bx, by, bw, bh] of this.boxes) { const gap = Math.max(Math.abs(bx - x) - bw - w, Math.abs(by - y) - bh - h); least = Math.min(least, gap < 0 ? 4 * gap : gap); }
    return least;
  }
}

export function drawStep(pen: Pen, ink: Ink, picture: StepPicture): void {
  const { recipe, seen, look, green, exact, line } = picture, { before, from, to } = recipe, flat = seen.indices.length === 1;
  const f = frameOf(picture, pen.width, pen.height), taken = new Taken(), base = pen.height - LOW;
  const start = f.at(from), end = f.at(to), inside = (x: number, y: number, w: number, h: number): boolean => x - w > 2 && x + w < pen.width - 2 && y - h > 2 && y + h < (flat ? base : pen.height) - 2;

  if (flat) {
    const spots = picture.times.map(({ at, says }) => ({ x: f.at([at, from[1]])[0], says })), written: [number, number][] = [];
    for (const { x } of spots) pen.line([Math.round(x) + 0.5, 8, Math.round(x) + 0.5, base], { colour: ink.grid, width: 1 });
    // The first ones matter most.
    for (const { x, says } of spots) {
      const way = says.find((text) => { const half = textWidth(text, 13) / 2; return x - half > 0 && x + half < pen.width && written.every(([low, high]) => x + half + 6 < low || x - half - 6 > high); });
      if (way === undefined) continue;
      written.push([x - textWidth(way, 13) / 2, x + textWidth(way, 13) / 2]);
      pen.text(x, base + 16, way, { colour: ink.quiet, size: 13, anchor: 'middle', baseline: 'middle' });
    }
  }
  const upward: Span[] = nameSpans(seen.names[flat ? 0 : 1]!, 14);
  pen.text(2, 13, upward, { colour: ink.quiet, size: 14, baseline: 'middle' });
  if (!flat) pen.text(pen.width - 6, pen.height - 10, nameSpans(seen.names[0]!, 14), { colour: ink.quiet, size: 14, anchor: 'end', baseline: 'middle' });

  const draw = (m: Mark, alpha: number, now: boolean): void => {
    if ('from' in m) {
      const a = f.at(m.from), b = f.at(m.to), xy = [...a, ...b].map(near);
      const stroke: Stroke = m.kind === 'probe' ? { colour: ink.quiet, width: now ? 2.5 : 2, dash: [3, 3], alpha } : { colour: look.colour, width: m.kind === 'fall' || now ? 3 : 2, dash: m.kind === 'go' ? look.dash : [], alpha };
      if (m.kind === 'fall') { if (Math.hypot(b[0] - a[0], b[1] - a[1]) > 5) pen.arrow(xy[0]!, xy[1]!, xy[2]!, xy[3]!, stroke); } else pen.line(xy, stroke);
    } else if (m.kind === 'stroke') {
      const reach = reachOf(m);
      if (reach) pen.line([...reach[0], ...reach[1]].map(near), { colour: look.colour, width: now ? 4.5 : 3.5, alpha });
    } else if (m.kind === 'end') return;
    else {
      const [x, y] = f.at(m.at);
      pen.mark('circle', x, y, 6.5, ink.surface);
      pen.mark('ring', x, y, 5.2, look.colour, { alpha });
    }
  };
  /** Both ends of a velocity's stroke, as long as can be seen and as there is room for. */
  function reachOf(m: Extract<Mark, { kind: 'stroke' }>): readonly [Point, Point] | null {
    const [x, y] = f.at(m.at), [dx, dy] = f.along(m.along), length = Math.hypot(dx, dy);
    if (!(length > 0.5)) return null;
    const half = Math.min(70, Math.max(22, 0.16 * length)) / length;
    return [[x - half * dx, y - half * dy], [x + half * dx, y + half * dy]];
  }
  const occupy = (m: Mark): void => {
    if ('from' in m) taken.line(f.at(m.from), f.at(m.to));
    else if (m.kind === 'stroke') { const reach = reachOf(m); if (reach) taken.line(...reach); } else { const p = f.at(m.at); taken.box(p[0], p[1], 5, 5); }
  };

  for (const m of recipe.rest) { draw(m, line < 0 ? 0.4 : COMING, false); occupy(m); }
  if (green) {
    const xy = Array.from({ length: 2 * green.x.length }, (_, i) => near(f.at([green.x[i >> 1]!, green.y[i >> 1]!])[i % 2 as 0 | 1]));
    pen.line(xy, { colour: ink.exact, width: 4 });
    for (let i = 0; i + 3 < xy.length; i += 2) taken.line([xy[i]!, xy[i + 1]!], [xy[i + 2]!, xy[i + 3]!]);
  }
  for (const place of picture.refused) {
    const p = f.at(place);
    pen.line([...start, ...p].map(near), { colour: look.colour, width: 1.5, dash: [4, 4], alpha: REFUSED });
    pen.mark('cross', near(p[0]), near(p[1]), 6, look.colour, { alpha: REFUSED });
    taken.box(p[0], p[1], 8, 8);
  }
  recipe.lines.forEach(({ marks }, k) => { for (const m of marks) { draw(m, line >= 0 && k > line ? COMING : 1, k === line); occupy(m); } });
  const arrives = recipe.lines.findIndex((l) => l.marks.some((m) => m.kind === 'end')), there = line < 0 || arrives < 0 || arrives <= line;
  for (const p of [before ? f.at(before) : null, start]) if (p) { pen.mark('circle', p[0], p[1], 7, ink.surface); pen.mark('ring', p[0], p[1], 6, ink.text); taken.box(p[0], p[1], 8, 8); }
  const right = exact ? f.at(exact) : null;
  if (right) { pen.mark('circle', right[0], right[1], 8.5, ink.exact, { rim: ink.surface }); taken.box(right[0], right[1], 8, 8); }
  if (right && there && Math.hypot(right[0] - end[0], right[1] - end[1]) > 22) pen.line([...right, ...end].map(near), { colour: look.colour, width: 1.75, dash: [2, 3] });
  pen.mark(look.marker, end[0], end[1], 6.5, look.colour, { rim: ink.surface, alpha: there ? 1 : COMING });
  taken.box(end[0], end[1], 8, 8);

  // --- words and discs -------------------------------------------------------------------------------------------------------------------
  const say = (text: string, at: Point, colour: string, bold: boolean): void => {
    const w = textWidth(text, 13.5) * (bold ? 1.06 : 1) / 2, h = 8, places: Point[] = [];
    for (const off of [14, 24, 36]) places.push([at[0] - w - off, at[1] + off], [at[0] - w - off, at[1]], [at[0] + w + off, at[1]], [at[0], at[1] + off + 6], [at[0] + w + off, at[1] - off], [at[0] + w + off, at[1] + off], [at[0], at[1] - off - 6], [at[0] - w - off, at[1] - off]);
    const found = best(places, w, h);
    if (!found) return;
    taken.box(found[0], found[1], w, h);
    pen.text(found[0], found[1], text, { colour, size: 13.5, bold, anchor: 'middle', baseline: 'middle', halo: ink.surface });
  };
  if (picture.miss && there) say(picture.miss, end, look.tone, true);
  recipe.lines.forEach(({ disc }, k) => {
    if (!disc || (line >= 0 && k > line)) return;
    const places: Point[] = [];
    if ('from' in disc) {
      const a = f.at(disc.from), b = f.at(disc.to), d = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1, ux = (b[0] - a[0]) / d, uy = (b[1] - a[1]) / d;
      for (const share of [0.5, 0.4, 0.6, 0.3, 0.7]) for (const off of [20, -20, 28, -28]) places.push([a[0] + share * (b[0] - a[0]) + off * uy, a[1] + share * (b[1] - a[1]) - off * ux]);
    } else {
      const [x, y] = f.at(disc.at);
      for (const off of [22, 30, 40]) for (let turn = 0; turn < 12; turn++) places.push([x + off * Math.cos(turn * Math.PI / 6 - Math.PI / 3), y + off * Math.sin(turn * Math.PI / 6 - Math.PI / 3)]);
    }
    const [x, y] = best(places, DISC, DISC) ?? f.at('from' in disc ? disc.to : disc.at);
    taken.box(x, y, DISC, DISC);
    pen.mark('circle', x, y, DISC, ink.text, { rim: ink.surface });
    pen.text(x, y, String(k + 1), { colour: ink.surface, size: 13, bold: true, anchor: 'middle', baseline: 'middle' });
  });
  for (const place of picture.refused) say(picture.refusedWord, f.at(place), ink.quiet, false);
  if (!flat) { say(picture.ends[0], start, ink.quiet, false); say(picture.ends[1], end, ink.quiet, false); }

  /** The freest of some places, the first ones rather; null: none lies inside. */
  function best(places: readonly Point[], w: number, h: number): Point | null {
    let found: Point | null = null, most = -Infinity;
    places.forEach((p, k) => {
      const free = inside(p[0], p[1], w, h) ? Math.min(taken.free(p[0], p[1], w, h), 8) - 0.15 * k : -Infinity;
      if (free > most) { most = free; found = p; }
    });
    return found;
  }
}
const near = (pixel: number): number => Math.min(2e4, Math.max(-2e4, pixel));
