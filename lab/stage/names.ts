/* Who is where, and by how much it misses: names at the ends of the curves, brackets with the length of a miss.
 *
 * Invariant: a number is the length of what it stands beside: the core's error where a step ends, between steps the distance of the lines that are drawn
 * (missAt). What coincides has one label.
 */
import { minus } from '../figure/number';
import { textWidth } from '../figure/shapes';
import type { Ink, Pen, Span } from '../figure/types';
import { words } from '../words';
import { spread } from './labels';
import { apart, type Box, type Place } from './place';

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

/** The last word of a name where no other name has it ("Verlet"), else the first ("symplectic"). A number at the end stays with the first author ("Dormand 8"). */
export function briefly(name: string, all: readonly string[]): string {
  const [, author = '', order = ''] = /^(\p{L}+)\P{L}.* (\d+)$/u.exec(name) ?? [];
  if (order) return `${author} ${order}`;
  const parts = name.split(/,? /), last = parts[parts.length - 1] ?? '';
  return parts.length > 1 && all.some((other) => other !== name && other.split(/,? /).includes(last)) ? parts[0]! : last;
}

/** "exact = midpoint"; three and more are counted. From the longest to the shortest way to say it. all: every name in the picture. */
function waysOf(label: Named, ink: Ink, size: number, withMiss: boolean, all: readonly string[]): Span[][] {
  const full = namesOf(label, ink), { miss } = label, first = label.names[0];
  const brief: Span[] = [{ text: label.exact ? first?.text ?? '' : briefly(first?.text ?? '', all), colour: first?.colour, bold: true }], rest = full.slice(1);
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

const BRACKET = 58, GAP = 14, LEAST = 20, OUTSIDE = 18;

export interface Surroundings {
  /** Misses are bracketed. */
  readonly upright: boolean;
  /** How far names may reach. */
  readonly right: number;
  /** From where to where a path reaches: names stand outside of it, so that none lies on curves; null: they stand at the points. */
  readonly span: readonly [left: number, right: number] | null;
  /** Every name in the picture. */
  readonly all: readonly string[];
  /** What else is written there now. */
  readonly notes: readonly Box[];
}

/** Where the number of a miss stands between two heights, clear of the names there; null: nowhere. */
function clear(from: number, to: number, names: readonly number[], room: number): number | null {
  const marks = [from, to, ...names.filter((y) => y > Math.min(from, to) && y < Math.max(from, to))].sort((a, b) => a - b);
  let best: number | null = null, widest = 2 * room, middle = (from + to) / 2;
  if (!marks.some((y) => Math.abs(y - middle) < room)) return middle;
  for (let i = 0; i + 1 < marks.length; i++) {
    const free = marks[i + 1]! - marks[i]!;
    if (free >= widest) { widest = free; best = (marks[i]! + marks[i + 1]!) / 2; }
  }
  return best;
}

/** Draws the labels of these points; answers where letters stand. */
export function drawNames(pen: Pen, ink: Ink, place: Place, labels: readonly Named[], { upright, right, span, all, notes }: Surroundings): readonly Box[] {
  if (!labels.length) return [];
  const { scale } = place, size = (place.names ? 15 : 13) * scale, lineHeight = (place.names ? 20 : 15) * scale, box = place.frame;
  const sorted = [...labels].sort((a, b) => a.y - b.y), exact = sorted.find((l) => l.exact);
  const heights = place.names ? spread(sorted.map((l) => l.y), sorted.slice(1).map(() => lineHeight), box.top + 4, box.bottom - 8) : sorted.map((l) => l.y);
  // Brackets for the two largest misses; the number of one stands in its middle, or behind the name where there is no room.
  const missing = exact && upright ? sorted.filter((l) => l.miss && Math.abs(l.y - exact.y) >= (place.names ? LEAST : 12)).sort((a, b) => Math.abs(b.y - exact.y) - Math.abs(a.y - exact.y)).slice(0, 2) : [];
  const numbered = new Map(missing.flatMap((label): [Named, number][] => {
    const y = place.names ? clear(exact!.y, label.y, heights, 0.95 * lineHeight) : (label.y + exact!.y) / 2;
    return y === null ? [] : [[label, y]];
  }));
  const lead = !upright || !exact ? place.ball + 8 : place.names ? BRACKET * scale + GAP : missing.length ? 24 : place.ball + 8;
  const from = Math.max(...sorted.map((l) => l.x)), least = Math.min(...sorted.map((l) => l.x)), reach = (name: Span[]): number => textWidth(name, size) * 1.04;
  const ways = sorted.map((l) => waysOf(l, ink, size, !numbered.has(l), all));
  const widest = place.names ? Math.max(...ways.map((w) => reach(w[w.length - 1]!)), numbered.size ? 116 * scale : 0) : 46;
  const whole = Math.max(widest, ...ways.map((w) => reach(w[0]!)));
  // Clear of the text that stands on the stage.
  const leftmost = place.text ? place.text + 8 : box.left - 40, { way, textX } = side();
  const anchor = way < 0 ? 'end' as const : 'start' as const, base = way < 0 ? least : from, bracketX = base + way * (place.names ? BRACKET * scale : 16);
  const named = place.names && !(sorted.length > 1 && right - base < 40);

  /** The box of a text of this middle height that begins, or at the left ends, here. */
  function boxAt(x: number, y: number, wide: number, high: number): Box {
    const from = way < 0 ? x - wide : x;
    return { left: from, right: from + wide, top: y - high / 2, bottom: y + high / 2 };
  }
  /** The exact motion's name on a small stage: beside its ball, else above or below it, where it covers nothing that is written. */
  function nameSmall(label: Named, y: number): void {
    const text = label.names[0]?.text ?? '', wide = textWidth(text, 12) * 1.06, off = place.ball + 11, along = Math.max(0, Math.min(label.x + 2, right - wide));
    const places = [boxAt(textX, y, wide, 14), ...[-off, off].map((by): Box => ({ left: along, right: along + wide, top: y + by - 7, bottom: y + by + 7 }))];
    const fits = (b: Box): boolean => b.left >= 0 && b.right <= right && b.top >= 0 && b.bottom <= place.height, clearOf = (b: Box): boolean => [...notes, ...written].every((other) => apart(b, other));
    const { left, top } = places.find((b) => fits(b) && clearOf(b)) ?? places.find((b) => fits(b)) ?? places[0]!;
    pen.text(left, top + 7, [{ text, bold: true }], { colour: label.colour, size: 12, baseline: 'middle', halo: ink.surface });
  }
  /** Where names begin: outside of a path, at the nearer side that has room for all of them, or for their short forms; else beside the points, at the left where the right is too narrow. */
  function side(): { readonly way: 1 | -1; readonly textX: number } {
    if (span && !upright && place.names) {
      const after = Math.max(span[1] + OUTSIDE, from + lead), before = Math.min(span[0] - OUTSIDE, least - lead);
      const sides = from + least > span[0] + span[1] ? [1, -1] as const : [-1, 1] as const, fits = (chosen: 1 | -1, wide: number): boolean => (chosen > 0 ? after + wide <= right : before - wide > leftmost);
      const chosen = sides.find((s) => fits(s, whole)) ?? sides.find((s) => fits(s, widest));
      if (chosen) return { way: chosen, textX: chosen > 0 ? after : before };
    }
    const flipped = from + lead + widest > right && least - lead - widest > 0;
    return flipped ? { way: -1, textX: least - lead } : { way: 1, textX: from + lead };
  }

  const written: Box[] = [];
  missing.forEach((label, k) => {
    const other = missing[0]!, sameSide = k === 1 && (label.y - exact!.y) * (other.y - exact!.y) > 0;
    const x = bracketX - (sameSide ? way * 14 * scale : 0), down = label.y > exact!.y ? 1 : -1, tip = label.y - down * 2;
    written.push({ left: x - 5, right: x + 5, top: Math.min(exact!.y, tip), bottom: Math.max(exact!.y, tip) });
    pen.line([x, exact!.y + down * 5, x, tip], { colour: label.line, width: 1.75 });
    pen.line([x - 4.5, tip - down * 7, x, tip, x + 4.5, tip - down * 7], { colour: label.line, width: 1.75 });
    const middle = numbered.get(label), { text, how } = label.miss!, letters = { colour: label.colour, anchor, halo: ink.surface };
    if (middle === undefined) return;
    if (place.names) pen.text(textX, middle, [{ text, bold: true }, { text: ` ${how}` }], { ...letters, size: 16 * scale, baseline: 'middle' });
    else if (Math.abs(label.y - exact!.y) > 32) {
      // In two lines beside the end of the curve, clear of the exact motion's name.
      const first = down > 0 ? label.y - 10 : label.y + 9;
      written.push(boxAt(textX, first + 2, widest, 28));
      pen.text(textX, first, [{ text, bold: true }], { ...letters, size: 13 });
      pen.text(textX, first + 13, how, { ...letters, size: 12 });
    } else {
      written.push(boxAt(textX, label.y + down * 6, widest, 14));
      pen.text(textX, label.y, [{ text, bold: true }], { ...letters, size: 13, baseline: down > 0 ? 'top' : 'bottom' });
    }
  });
  sorted.forEach((label, k) => {
    const y = heights[k]!, start = label.x + way * (place.ball + 4), bracketed = upright && exact, end = bracketed ? bracketX + way * 5 : textX - way * 5;
    if (place.names && (bracketed || (span && way * (end - start) > 8))) {
      pen.line([start, label.y, end, Math.abs(y - label.y) > 3 ? y : label.y], { colour: label.line, width: 1, alpha: 0.55 });
    }
    if (!place.names) {
      if (label.exact && upright) nameSmall(label, y);
      return;
    }
    if (!named) return;
    const free = way < 0 ? textX - leftmost : right - textX, said = ways[k]!.find((spans) => reach(spans) <= free) ?? ways[k]![ways[k]!.length - 1]!;
    written.push(boxAt(textX, y, reach(said), size));
    pen.text(textX, y, said, { colour: label.colour, size, anchor, baseline: 'middle', halo: ink.surface });
  });
  return written;
}
