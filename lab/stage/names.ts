/* Who is where, and by how much it misses: names at the ends of the curves, brackets with the length of a miss.
 *
 * Invariant: a number is the core's error at a step that has been made; it changes when a step lands, not between. What coincides has one label.
 */
import { minus } from '../figure/number';
import { textWidth } from '../figure/shapes';
import type { Ink, Pen, Span } from '../figure/types';
import { words } from '../words';
import { spread } from './labels';
import type { Place } from './place';

/** One label: curves that coincide. */
export interface Named {
  readonly names: readonly { readonly text: string; readonly colour: string }[];
  readonly colour: string; readonly line: string;
  readonly x: number; readonly y: number;
  /** How far from the exact motion, in words; '' where that is not known, or is nothing. */
  readonly miss: { readonly size: number; readonly text: string; readonly how: string } | null;
  readonly exact: boolean;
}

/** To a hundredth of the frame or so, at least two digits and at most three that count. */
export function missText(value: number, frame: number): string {
  if (!(value > 0)) return '0';
  const power = Math.floor(Math.log10(value)), finest = Math.floor(Math.log10(frame / 500));
  const decimals = Math.min(2 - power, Math.max(-finest, 1 - power));
  if (power < -3 || power > 4) return minus(value.toExponential(1).replace(/e\+?(-?)(\d+)/, (_, sign: string, digits: string) => `×10${sign ? '⁻' : ''}${[...digits].map((d) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(d)]).join('')}`));
  return value.toFixed(Math.max(0, decimals));
}

/** "exact = midpoint"; three and more are counted. From the longest to the shortest way to say it. */
function waysOf(label: Named, ink: Ink, size: number, withMiss: boolean): Span[][] {
  const full = namesOf(label, ink), { miss } = label, first = label.names[0];
  const start = first?.text.split(/[ ,]/)[0] ?? '', brief: Span[] = [{ text: start, colour: first?.colour, bold: true }], rest = full.slice(1);
  const number: Span[] = miss && withMiss && !label.exact ? [{ text: `  ${miss.text}${miss.how ? ` ${miss.how}` : ''}`, size: size - 2 }] : [];
  return [...(number.length ? [[...full, ...number]] : []), full, ...(rest.length ? [[...brief, ...rest]] : []), brief];
}
function namesOf(label: Named, ink: Ink): Span[] {
  const [first, second] = label.names, more = label.names.length;
  if (!first) return [];
  const head: Span = { text: first.text, colour: first.colour, bold: true };
  if (more === 1) return [head];
  const equals: Span = { text: words.stage.equals, colour: ink.quiet };
  return more === 2 && second ? [head, equals, { text: second.text, colour: second.colour, bold: true }] : [head, equals, { text: words.stage.several(String(more - 1)), colour: ink.text, bold: true }];
}

const BRACKET = 58, GAP = 14, LEAST = 20;

/** Draws the labels of these points; says where the words of each begin. upright: misses are bracketed. */
export function drawNames(pen: Pen, ink: Ink, place: Place, labels: readonly Named[], upright: boolean, right: number): void {
  if (!labels.length) return;
  const { scale } = place, size = (place.names ? 15 : 13) * scale, lineHeight = (place.names ? 20 : 15) * scale, box = place.frame;
  const sorted = [...labels].sort((a, b) => a.y - b.y), exact = sorted.find((l) => l.exact);
  const missing = exact && upright ? sorted.filter((l) => l.miss && Math.abs(l.y - exact.y) >= 4).sort((a, b) => Math.abs(b.y - exact.y) - Math.abs(a.y - exact.y)).slice(0, 2) : [];
  const bracketed = missing.filter((l) => Math.abs(l.y - exact!.y) >= (place.names ? LEAST : 12));
  const lead = upright && exact ? (place.names ? BRACKET * scale : 16) + (place.names ? GAP : 8) : place.ball + 8;
  const from = Math.max(...sorted.map((l) => l.x)), reach = (name: Span[]): number => textWidth(name, size) * 1.04;
  const numberWidth = upright ? 116 * scale : 0;
  const ways = sorted.map((l) => waysOf(l, ink, size, !bracketed.includes(l)));
  const widest = place.names ? Math.max(...ways.map((w) => reach(w[w.length - 1]!)), bracketed.length ? numberWidth : 0) : 46;
  // Where the right is too narrow everything stands at the left of the points; and where they are at the left of a path, outside of it.
  const least = Math.min(...sorted.map((l) => l.x)), outward = !upright && place.names && from < (box.left + Math.min(box.right, right)) / 2 - 60 && least - lead - widest > box.left - 40;
  const flipped = outward || (from + lead + widest > right && least - lead - widest > 0);
  const way = flipped ? -1 : 1, base = flipped ? Math.min(...sorted.map((l) => l.x)) : from, anchor = flipped ? 'end' as const : 'start' as const;
  const bracketX = base + way * (place.names ? BRACKET * scale : 16), textX = base + way * lead;
  const gaps = sorted.slice(1).map(() => lineHeight);
  const heights = place.names ? spread(sorted.map((l) => l.y), gaps, box.top + 4, box.bottom - 8) : sorted.map((l) => l.y);
  const named = place.names && !(sorted.length > 1 && heights.length > 0 && right - base < 40);

  bracketed.forEach((label, k) => {
    const other = bracketed[0]!, sameSide = k === 1 && (label.y - exact!.y) * (other.y - exact!.y) > 0;
    const x = bracketX - (sameSide ? way * 14 * scale : 0), down = label.y > exact!.y ? 1 : -1, tip = label.y - down * 2;
    pen.line([x, exact!.y + down * 5, x, tip], { colour: label.line, width: 1.75 });
    pen.line([x - 4.5, tip - down * 7, x, tip, x + 4.5, tip - down * 7], { colour: label.line, width: 1.75 });
    const middle = (label.y + exact!.y) / 2, { text, how } = label.miss!, letters = { colour: label.colour, anchor, halo: ink.surface };
    if (place.names) pen.text(textX, middle, [{ text, bold: true }, { text: ` ${how}` }], { ...letters, size: 16 * scale, baseline: 'middle' });
    else if (Math.abs(label.y - exact!.y) > 30) {
      pen.text(textX, middle - 2, [{ text, bold: true }], { ...letters, size: 13 });
      pen.text(textX, middle + 12, how, { ...letters, size: 12 });
    } else pen.text(textX, label.y, [{ text, bold: true }], { ...letters, size: 13, baseline: down > 0 ? 'top' : 'bottom' });
  });
  sorted.forEach((label, k) => {
    const y = heights[k]!;
    if (place.names && upright && exact) {
      pen.line([label.x + way * (place.ball + 4), label.y, bracketX + way * 5, Math.abs(y - label.y) > 3 ? y : label.y], { colour: label.line, width: 1, alpha: 0.55 });
    }
    if (!place.names) {
      if (label.exact && upright) pen.text(textX, y, [{ text: words.stage.short, bold: true }], { colour: label.colour, size: 12, anchor, baseline: 'middle', halo: ink.surface });
      return;
    }
    if (!named) return;
    const free = flipped ? textX - box.left : right - textX;
    pen.text(textX, y, ways[k]!.find((spans) => reach(spans) <= free) ?? ways[k]![ways[k]!.length - 1]!, { colour: label.colour, size, anchor, baseline: 'middle', halo: ink.surface });
  });
}
