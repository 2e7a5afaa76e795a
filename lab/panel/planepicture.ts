/* The plane of hλ of one method, drawn: where a step grows, and where the model's own hλ are.
 *
 * Invariant: the region belongs to the method alone; the rates λ belong to the model; the step only moves the points. What is outside of the picture stands
 * at its edge.
 */
import { axes } from '../figure/axes';
import { brief } from '../figure/number';
import type { Frame, Ink, Pen } from '../figure/types';
import { words } from '../words';
import { heightAt, type Plane } from './plane';
import type { Rate } from './rates';

const say = words.study.stability;
/** Pixels of the shading on the screen's scale. */
const MESH = 2, EDGE = 7;

/** A colour with that much opacity, for cells, which have none of their own. */
function mixed(colour: string, alpha: number): string {
  const hex = /^#([0-9a-f]{6})$/i.exec(colour);
  return hex ? `${colour}${Math.round(255 * alpha).toString(16).padStart(2, '0')}` : `color-mix(in srgb, ${colour} ${100 * alpha}%, transparent)`;
}

/** Where a point is drawn; outside of the picture, at its edge. */
function placed(f: Frame, re: number, im: number): { readonly x: number; readonly y: number; readonly out: boolean } {
  const x = f.x(re), y = f.y(im), ox = f.x(0), oy = f.y(0), m = EDGE;
  const share = Math.min(1,
    x > ox ? (f.left + f.width - m - ox) / (x - ox) : x < ox ? (f.left + m - ox) / (x - ox) : 1,
    y > oy ? (f.top + f.height - m - oy) / (y - oy) : y < oy ? (f.top + m - oy) / (y - oy) : 1);
  return { x: ox + share * (x - ox), y: oy + share * (y - oy), out: share < 1 };
}
/** Both of each pair. */
const pairs = (rates: readonly Rate[]): Rate[] => rates.flatMap((rate) => (rate.im > 0 ? [rate, { ...rate, im: -rate.im }] : [rate]));

export class PlanePicture {
  frame: Frame | null = null;
  private shade: { readonly of: Plane; readonly key: string; readonly cells: Uint8Array; readonly columns: number; readonly rows: number } | null = null;

  /** limit: of step times frequency, as the catalogue has it. */
  draw(pen: Pen, ink: Ink, plane: Plane, rates: readonly Rate[], h: number, colour: string, limit: number): void {
    const { half, full } = plane;
    const f = this.frame = axes(pen, ink, { min: -1.3 * half, max: 0.7 * half, label: say.across }, { min: -1.08 * half, max: 1.08 * half, label: say.up }, { equal: true });
    const px = (re: number): number => f.x(re), py = (im: number): number => f.y(im);
    pen.clip(f.left, f.top, f.width, f.height, () => {
      if (full) {
        const { cells, columns, rows } = this.shading(plane, f);
        pen.cells(f.left, f.top, f.width, f.height, columns, rows, cells, ['', mixed(ink.danger, 0.16)]);
        pen.line(Float64Array.from(plane.border, (v, k) => (k % 2 ? py(v) : px(v))), { colour: ink.text, width: 1.5 });
      }
      pen.line([px(0), f.top, px(0), f.top + f.height], { colour: ink.axis, width: 1 });
      pen.line([f.left, py(0), f.left + f.width, py(0)], { colour: ink.axis, width: 1 });
      if (!full) drawAxis(pen, ink, f, plane, limit);
    });
    told(pen, ink, f, full !== null);
    const seen = new Set<string>();
    for (const rate of pairs(rates)) {
      const at = placed(f, h * rate.re, h * rate.im), key = `${Math.round(at.x)} ${Math.round(at.y)}`;
      if (seen.has(key)) continue;
      seen.add(key);
      pen.mark('ring', at.x, at.y, 3, colour);
    }
  }

  /** The rates nearest to the present time. */
  overlay(pen: Pen, rates: readonly Rate[], h: number, now: number, colour: string): void {
    const f = this.frame, first = rates[0];
    if (!f || !first) return;
    const nearest = rates.reduce((best, { time }) => (Math.abs(time - now) < Math.abs(best - now) ? time : best), first.time), ox = f.x(0), oy = f.y(0);
    for (const rate of pairs(rates)) {
      if (rate.time !== nearest) continue;
      const at = placed(f, h * rate.re, h * rate.im), size = Math.max(1, Math.hypot(at.x - ox, at.y - oy));
      pen.line([ox, oy, at.x, at.y], { colour, width: 1, alpha: 0.6 });
      if (at.out) pen.arrow(at.x - (at.x - ox) / size * 18, at.y - (at.y - oy) / size * 18, at.x, at.y, { colour, width: 2 });
      else pen.mark('circle', at.x, at.y, 4.5, colour);
    }
  }

  private shading(of: Plane, f: Frame): { cells: Uint8Array; columns: number; rows: number } {
    const columns = Math.max(1, Math.round(f.width / MESH)), rows = Math.max(1, Math.round(f.height / MESH)), key = `${f.left} ${f.top} ${f.width} ${f.height}`;
    if (this.shade?.key === key && this.shade.of === of) return this.shade;
    const cells = new Uint8Array(columns * rows);
    if (of.full) {
      for (let j = 0; j < rows; j++) {
        const im = f.y.invert(f.top + (j + 0.5) * f.height / rows);
        for (let i = 0; i < columns; i++) if (heightAt(of.full, f.x.invert(f.left + (i + 0.5) * f.width / columns), im) > 0) cells[i + columns * j] = 1;
      }
    }
    this.shade = { of, key, cells, columns, rows };
    return this.shade;
  }
}

/** A method without velocities in its force has answers on the imaginary axis only. */
function drawAxis(pen: Pen, ink: Ink, f: Frame, of: Plane, limit: number): void {
  const { axis } = of, x = f.x(0);
  const piece = (from: number, to: number, grows: boolean): void => {
    for (const sign of [1, -1]) pen.line([x, f.y(sign * from), x, f.y(sign * to)], grows ? { colour: ink.danger, width: 5, alpha: 0.6 } : { colour: ink.text, width: 5 });
  };
  let from = 0, grows = false;
  for (let j = 0; j < axis.im.length; j++) {
    const here = !(axis.growth[2 * j]! <= 1 + 1e-7), im = axis.im[j]!;
    if (here !== grows) { piece(from, im, grows); from = im; grows = here; }
  }
  piece(from, axis.im[axis.im.length - 1]!, grows);
  if (!Number.isFinite(of.limit)) return;
  for (const sign of [1, -1]) {
    pen.line([x - 7, f.y(sign * of.limit), x + 7, f.y(sign * of.limit)], { colour: ink.text, width: 1.5 });
    pen.text(x + 12, f.y(sign * of.limit), `${sign < 0 ? '−' : ''}${brief(limit, 4)} i`, { colour: ink.text, size: 12, baseline: 'middle' });
  }
}

function told(pen: Pen, ink: Ink, f: Frame, full: boolean): void {
  const put = (x: number, y: number, text: string, anchor: 'start' | 'end'): void => pen.text(x, y, text, { colour: ink.quiet, size: 12, anchor, baseline: 'top' });
  if (full) { put(f.left + f.width - 6, f.top + 6, say.shaded, 'end'); return; }
  const x = f.left + 8, y = f.top + 12;
  pen.line([x, y, x + 18, y], { colour: ink.text, width: 5 });
  put(x + 24, y - 6, say.noGrowth, 'start');
  pen.line([x, y + 18, x + 18, y + 18], { colour: ink.danger, width: 5, alpha: 0.6 });
  put(x + 24, y + 12, say.growth, 'start');
}
