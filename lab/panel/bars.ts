/* How far each method's steps may go, as bars from zero on: one a method, with its name and its limit at the end, and a line where the run is.
 *
 * Invariant: a bar ends at the limit; a method without one has a ring at zero, or a bar that leaves the picture. What is beyond the picture has an arrow.
 */
import { scaleAlong } from '../figure/axes';
import { bold } from '../figure/ends';
import { textWidth } from '../figure/shapes';
import type { Ink, Pen } from '../figure/types';
import type { Look } from '../scene';
import { words } from '../words';
import type { Limit } from './limits';

export interface Bar { readonly look: Look; readonly limit: Limit; readonly label: string }
export interface Bars {
  readonly bars: readonly Bar[];
  /** Where the run is, and how that is written; others: where its slower swings are. */
  readonly here: number; readonly hereText: string; readonly others: readonly number[];
  readonly name: string;
}

const ROW = 30, TOP = 14, BELOW = 26, FOOT = 46, LEFT = 12, GAP = 12, THICK = 7, SIZE = 13, LEAST = 170;
/** The line of the run is in the picture up to so many times the longest bar. */
const FAR = 1.6;
export const heightOf = (count: number): number => Math.max(LEAST, TOP + ROW * count + BELOW + FOOT);

const wide = (text: string): number => bold(text, SIZE) + 2;
/** Numbers that fit into the width with the names behind the bars. */
function reach({ bars, here }: Bars, room: number): number {
  const limits = bars.map(({ limit }) => (limit.kind === 'upTo' ? limit.value : 0)), longest = Math.max(...limits, 0);
  let most = longest > 0 ? longest : here > 0 ? 2 * here : 1;
  bars.forEach(({ label }, k) => { if (limits[k]! > 0) most = Math.max(most, limits[k]! * room / Math.max(0.3 * room, room - GAP - wide(label))); });
  return here > 0 && here <= FAR * Math.max(longest, 1e-300) ? Math.max(most, 1.15 * here) : 1.04 * most;
}

export function drawBars(pen: Pen, ink: Ink, of: Bars): void {
  const room = pen.width - LEFT - 8, right = LEFT + room, foot = pen.height - FOOT, scale = scaleAlong({ min: 0, max: reach(of, room), label: '' }, LEFT, right, 150);
  const row = (foot - BELOW - TOP) / Math.max(1, of.bars.length), crisp = (p: number): number => Math.round(p) + 0.5;
  for (const tick of scale.ticks) {
    const x = scale(tick);
    pen.line([crisp(x), TOP - 8, crisp(x), foot], { colour: ink.grid, width: 1 });
    pen.text(x, foot + 7, scale.label(tick), { colour: ink.quiet, anchor: tick === 0 && x < 14 ? 'start' : 'middle', baseline: 'top' });
  }
  pen.text(right, foot + 26, of.name, { colour: ink.quiet, anchor: 'end', baseline: 'top' });
  const x0 = scale(0), at = scale(of.here), inside = of.here > 0 && at <= right;
  of.bars.forEach(({ look, limit, label }, k) => {
    const y = TOP + row * (k + 0.5), letters = { colour: look.tone, size: SIZE, bold: true, baseline: 'middle' as const, halo: ink.surface };
    // Names of methods without a bar stand behind the line of the run, where that is near.
    const free = inside && at < x0 + 90 ? at + GAP : x0 + 2 * GAP;
    if (limit.kind === 'upTo') {
      const end = scale(limit.value);
      bar(pen, x0, end, y, look.colour);
      const fits = end + GAP + wide(label) <= pen.width;
      pen.text(fits ? end + GAP : pen.width - 2, fits ? y : y - 12, label, { ...letters, anchor: fits ? 'start' : 'end' });
    } else if (limit.kind === 'any') {
      const end = right - GAP - wide(label);
      bar(pen, x0, end - 2, y, look.colour);
      pen.line([end - 8, y - 8, end, y, end - 8, y + 8], { colour: look.colour, width: 2.5 });
      pen.text(end + GAP, y, label, letters);
    } else {
      if (limit.kind !== 'unknown') pen.mark('ring', x0, y, 4, look.colour);
      pen.text(free, y, label, letters);
    }
  });
  for (const other of of.others) if (scale(other) <= right) pen.line([crisp(scale(other)), foot - 6, crisp(scale(other)), foot], { colour: ink.axis, width: 1 });
  if (!(of.here > 0)) return;
  const text = inside ? words.study.here(of.hereText) : words.study.beyond(of.hereText), flip = !inside || at + 8 + textWidth(text) > pen.width;
  if (inside) pen.line([at, TOP - 10, at, foot], { colour: ink.text, width: 1.75 });
  pen.text(inside ? at + (flip ? -6 : 6) : right, foot - 6, text, { colour: ink.text, anchor: flip ? 'end' : 'start', baseline: 'bottom', halo: ink.surface });
}

function bar(pen: Pen, from: number, to: number, y: number, colour: string): void {
  pen.line([from, y, to, y], { colour, width: THICK });
  pen.mark('circle', from, y, THICK / 2, colour);
  pen.mark('circle', to, y, THICK / 2, colour);
}
