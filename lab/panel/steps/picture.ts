/* Draws the sketch of a step: what has happened up to an event, that event strongly, and the exact motion in green.
 *
 * Invariant: the frame holds the whole step, whichever event is on show, so that nothing jumps while one goes through the events.
 */
import type { Frame, Ink, Pen } from '../../figure/types';
import { axes } from '../../figure/axes';
import { textWidth } from '../../figure/shapes';
import type { Look } from '../../scene';
import type { Mark, Plane, Place, Role } from './sketch';

export interface Curve { readonly x: ArrayLike<number>; readonly y: ArrayLike<number> }
export interface StepPicture {
  readonly marks: readonly (readonly Mark[])[]; readonly event: number; readonly plane: Plane; readonly look: Look;
  /** From the step's own start; and that of the whole run, which belongs to the picture only where it passes through. */
  readonly local: Curve | null; readonly whole: Curve | null;
}

const MARGIN = 0.12, STRIP = 2.5, ROOM = 0.3;
/* Accelerations are told from velocities by their breadth: any colour is some method's. */
const BROAD = 4;

function bounds(picture: StepPicture): { x: [number, number]; y: [number, number] } {
  let x: [number, number] = [Infinity, -Infinity], y: [number, number] = [Infinity, -Infinity];
  const take = (px: number, py: number): void => {
    if (!Number.isFinite(px) || !Number.isFinite(py)) return;
    x = [Math.min(x[0], px), Math.max(x[1], px)];
    y = [Math.min(y[0], py), Math.max(y[1], py)];
  };
  for (const m of picture.marks.flat()) {
    if (m.kind === 'point') take(...m.at);
    else if (m.kind === 'line' || !m.free) { take(...m.from); take(...m.to); }
  }
  /* Slopes are given room as far as that leaves the step itself large. */
  const w = x[1] - x[0], h = y[1] - y[0], core = { x, y };
  for (const m of picture.marks.flat())
    if (m.kind === 'arrow' && m.free)
      take(Math.min(core.x[1] + ROOM * w, Math.max(core.x[0] - ROOM * w, m.to[0])), Math.min(core.y[1] + ROOM * h, Math.max(core.y[0] - ROOM * h, m.to[1])));
  if (picture.local) for (let i = 0; i < picture.local.x.length; i++) take(picture.local.x[i]!, picture.local.y[i]!);
  const grown = ([low, high]: [number, number], other: number): [number, number] => {
    if (!(high >= low)) return [-1, 1];
    const room = high - low > 1e-12 * (Math.abs(low) + Math.abs(high)) ? MARGIN * (high - low) : 0.05 * other || Math.max(1e-12, Math.abs(low) * 1e-6);
    return [low - room, high + room];
  };
  return { x: grown(x, y[1] - y[0]), y: grown(y, picture.plane.indices.length > 1 ? x[1] - x[0] : 0) };
}

export function drawStep(pen: Pen, ink: Ink, picture: StepPicture): void {
  const { plane, look } = picture, b = bounds(picture);
  const width = b.x[1] - b.x[0], height = b.y[1] - b.y[0];
  const equal = plane.indices.length > 1 && width < STRIP * height && height < STRIP * width;
  const top = key(pen, ink, picture);
  const f = axes(pen, ink, { min: b.x[0], max: b.x[1], label: plane.axes[0] }, { min: b.y[0], max: b.y[1], label: plane.axes[1] },
    { equal, region: { left: 0, top, width: pen.width, height: pen.height - top } });
  const colour: Record<Role, string> = { move: look.colour, velocity: ink.text, acceleration: ink.quiet, helper: ink.quiet };
  const labels = new Labels(pen, f);

  pen.clip(f.left - 1, f.top - 1, f.width + 2, f.height + 2, () => {
    if (picture.whole) pen.line(pixels(picture.whole, f), { colour: ink.exact, width: picture.local ? 2 : 5, alpha: picture.local ? 0.5 : 1 });
    if (picture.local) pen.line(pixels(picture.local, f), { colour: ink.exact, width: 5 });
  });
  const green = picture.local ?? null;
  if (green && green.x.length > 0) {
    const x = f.x(green.x[green.x.length - 1]!), y = f.y(green.y[green.y.length - 1]!);
    pen.mark('circle', x, y, 9.5, ink.surface);
    pen.mark('circle', x, y, 8, ink.exact);
  }
  picture.marks.forEach((marks, k) => {
    if (k > picture.event) return;
    const now = k === picture.event, last = picture.marks.length - 1;
    for (const m of marks) {
      const faded = now || (m.kind === 'line' && m.role === 'move') || m.kind === 'point' ? 1 : 0.4;
      if (m.kind === 'line') {
        pen.line(flat(m.from, m.to, f), { colour: colour[m.role], width: m.role === 'move' ? now ? 3 : 2 : 1.25, dash: m.role === 'helper' ? [4, 4] : [], alpha: faded });
      } else if (m.kind === 'arrow') {
        const [x0, y0, farX, farY] = flat(m.from, m.to, f) as [number, number, number, number];
        const part = m.free ? fitting(x0, y0, farX, farY, f) : 1, x1 = x0 + part * (farX - x0), y1 = y0 + part * (farY - y0);
        if (Math.hypot(x1 - x0, y1 - y0) > 1) pen.arrow(x0, y0, x1, y1, { colour: colour[m.role], width: m.role === 'acceleration' ? BROAD : now ? 2.25 : 1.75, alpha: faded });
        if (m.label && (now || picture.event === last)) labels.beside(x0, y0, x1, y1, m.label, colour[m.role]);
      } else {
        const x = f.x(m.at[0]), y = f.y(m.at[1]);
        if (m.style === 'state') {
          pen.mark('circle', x, y, 6.5, ink.surface);
          pen.mark(look.marker, x, y, 5.5, look.colour);
        } else {
          pen.mark('circle', x, y, 5, ink.surface);
          pen.mark('ring', x, y, 4, now ? ink.text : ink.quiet);
        }
        if (m.label && m.style === 'stage') labels.at(x, y, m.label, ink.quiet);
      }
    }
  });
}

/* What the colours mean, above the picture; the letters beside the arrows say it again. */
function key(pen: Pen, ink: Ink, picture: StepPicture): number {
  const roles = new Set<Role>(picture.marks.flat().flatMap(m => m.kind === 'point' ? [] : [m.role]));
  const items: { readonly name: string; draw(x: number, y: number): void }[] = [
    { name: picture.look.label, draw: (x, y) => { pen.line([x, y, x + 24, y], { colour: picture.look.colour, width: 3 }); pen.mark(picture.look.marker, x + 12, y, 4, picture.look.colour); } },
  ];
  if (picture.local || picture.whole) items.unshift({ name: picture.local ? 'exact, from the start of the step' : 'exact', draw: (x, y) => pen.line([x, y, x + 24, y], { colour: ink.exact, width: 5 }) });
  if (roles.has('velocity')) items.push({ name: 'velocity v', draw: (x, y) => pen.arrow(x, y, x + 24, y, { colour: ink.text, width: 2.25 }) });
  if (roles.has('acceleration')) items.push({ name: 'acceleration a', draw: (x, y) => pen.arrow(x, y, x + 24, y, { colour: ink.quiet, width: BROAD }) });
  let x = 1, y = 10;
  for (const item of items) {
    const width = 30 + textWidth(item.name) + 18;
    if (x > 1 && x + width - 18 > pen.width) { x = 1; y += 19; }
    item.draw(x, y);
    pen.text(x + 30, y, item.name, { colour: ink.text, size: 12, baseline: 'middle' });
    x += width;
  }
  return y + 15;
}
export const keyHeight = (width: number): number => width < 420 ? 82 : width < 640 ? 44 : 25;

/* What part of an arrow lies in the frame. */
function fitting(x0: number, y0: number, x1: number, y1: number, f: Frame): number {
  let part = 1;
  const limit = (from: number, to: number, low: number, high: number): void => {
    if (to > high) part = Math.min(part, (high - from) / (to - from));
    if (to < low) part = Math.min(part, (low - from) / (to - from));
  };
  limit(x0, x1, f.left + 2, f.left + f.width - 2);
  limit(y0, y1, f.top + 2, f.top + f.height - 2);
  return Math.max(0, part);
}

function pixels(curve: Curve, f: Frame): Float64Array {
  const xy = new Float64Array(2 * curve.x.length);
  for (let i = 0; i < curve.x.length; i++) { xy[2 * i] = near(f.x(curve.x[i]!)); xy[2 * i + 1] = near(f.y(curve.y[i]!)); }
  return xy;
}
const near = (pixel: number): number => Math.min(2e4, Math.max(-2e4, pixel));
const flat = (a: Place, b: Place, f: Frame): number[] => [f.x(a[0]), f.y(a[1]), f.x(b[0]), f.y(b[1])].map(near);

/* Letters find a place where no other letters stand, or stay away. */
class Labels {
  private readonly taken: { readonly x: number; readonly y: number; readonly w: number }[] = [];
  constructor(private readonly pen: Pen, private readonly frame: Frame) {}
  private readonly said = new Set<string>();
  private put(x: number, y: number, text: string, colour: string): boolean {
    const w = textWidth(text, 13) / 2 + 3, f = this.frame;
    if (x - w < f.left || x + w > f.left + f.width || y < f.top + 8 || y > f.top + f.height - 8) return false;
    if (this.taken.some(t => Math.abs(t.x - x) < t.w + w && Math.abs(t.y - y) < 16)) return false;
    this.taken.push({ x, y, w });
    this.pen.text(x, y, text, { colour, size: 13, italic: true, anchor: 'middle', baseline: 'middle' });
    return true;
  }
  /** Beside an arrow: at its middle, on one side or the other, then at its tip. */
  beside(x0: number, y0: number, x1: number, y1: number, text: string, colour: string): void {
    if (this.said.has(text)) return;
    const d = Math.hypot(x1 - x0, y1 - y0) || 1, ux = (x1 - x0) / d, uy = (y1 - y0) / d, off = 10 + Math.abs(uy) * textWidth(text, 13) / 2;
    for (const share of [0.55, 1, 0.25])
      for (const side of [1, -1])
        if (this.put(x0 + ux * d * share + side * uy * off, y0 + uy * d * share - side * ux * off, text, colour)) { this.said.add(text); return; }
  }
  at(x: number, y: number, text: string, colour: string): void {
    for (const [dx, dy] of [[0, -14], [0, 16], [16, 0], [-16, 0]] as const)
      if (this.put(x + dx * Math.max(1, textWidth(text, 13) / 20), y + dy, text, colour)) return;
  }
}
