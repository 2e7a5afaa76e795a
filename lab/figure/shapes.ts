/* What both pens share: the outlines of markers, the head of an arrow, the place of letters, runs of cells.
 *
 * Invariant: told once, so that a canvas and an SVG show the same.
 */
import type { Marker } from '../scene';
import type { Lettering, Span } from './types';

export const FAMILY = 'system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "Helvetica Neue", Arial, sans-serif';
export const SIZE = 12;

/** A closed outline to be filled, or strokes: corners about the origin, for radius 1. */
type Outline = { readonly closed: boolean; readonly parts: readonly (readonly number[])[] } | 'disc' | 'ring';

function polygon(corners: number, turn: number, radius = 1, inner = 0): number[] {
  const xy: number[] = [];
  const n = inner ? 2 * corners : corners;
  for (let k = 0; k < n; k++) {
    const r = inner && k % 2 ? inner : radius, angle = turn + 2 * Math.PI * k / n;
    xy.push(r * Math.cos(angle), r * Math.sin(angle));
  }
  return xy;
}

const UP = -Math.PI / 2;
export const OUTLINES: Readonly<Record<Marker, Outline>> = {
  circle: 'disc', ring: 'ring',
  square: { closed: true, parts: [polygon(4, Math.PI / 4, 1.25)] },
  diamond: { closed: true, parts: [polygon(4, 0, 1.35)] },
  triangle: { closed: true, parts: [polygon(3, UP, 1.35)] },
  down: { closed: true, parts: [polygon(3, -UP, 1.35)] },
  star: { closed: true, parts: [polygon(5, UP, 1.55, 0.62)] },
  cross: { closed: false, parts: [[-0.9, -0.9, 0.9, 0.9], [-0.9, 0.9, 0.9, -0.9]] },
  plus: { closed: false, parts: [[-1.2, 0, 1.2, 0], [0, -1.2, 0, 1.2]] },
  bar: { closed: false, parts: [[0, -1.35, 0, 1.35]] },
};
/** Markers of strokes, and the ring, are drawn this wide for radius 1. */
export const STROKE = 0.55;

/** The head of an arrow from (x0, y0) to (x1, y1): three corners, and where the shaft ends. Null: too short to point anywhere. */
export function head(x0: number, y0: number, x1: number, y1: number, width: number): { tip: number[]; shaft: [number, number] } | null {
  const dx = x1 - x0, dy = y1 - y0, length = Math.hypot(dx, dy);
  if (!(length > 0.5)) return null;
  const size = Math.min(5 + 2 * width, 0.6 * length), ux = dx / length, uy = dy / length;
  const bx = x1 - size * ux, by = y1 - size * uy, half = 0.42 * size;
  return { tip: [x1, y1, bx - half * uy, by + half * ux, bx + half * uy, by - half * ux], shaft: [x1 - 0.7 * size * ux, y1 - 0.7 * size * uy] };
}

export function finite(...values: number[]): boolean {
  return values.every(Number.isFinite);
}

/** Runs of equal cells in each row. */
export function runs(columns: number, rows: number, cells: Uint8Array, run: (i: number, j: number, n: number, value: number) => void): void {
  for (let j = 0; j < rows; j++) {
    for (let i = 0; i < columns;) {
      const value = cells[i + columns * j] ?? 0;
      let n = 1;
      while (i + n < columns && cells[i + n + columns * j] === value) n++;
      run(i, j, n, value);
      i += n;
    }
  }
}

/** The rim of letters that have one, in pixels: half of it lies outside of them. */
export const HALO = 5;
/** The rim of a marker that has one. */
export const RIM = 1.5;
export const spansOf = (text: string | readonly Span[]): readonly Span[] => (typeof text === 'string' ? [{ text }] : text);

export function shift(lettering: Lettering): number {
  const size = lettering.size ?? SIZE;
  switch (lettering.baseline) {
    case 'top': return 0.8 * size;
    case 'middle': return 0.35 * size;
    case 'bottom': return -0.22 * size;
    default: return 0;
  }
}

/** How wide a text will be, nearly: a pen that writes SVG cannot measure, and both must place alike. */
export function textWidth(text: string | readonly Span[], size = SIZE): number {
  if (typeof text !== 'string') return text.reduce((sum, span) => sum + textWidth(span.text, span.size ?? size) * (span.bold ? 1.06 : 1), 0);
  let em = 0;
  for (const c of text) em += (WIDTHS.find(([letters]) => letters.test(c)) ?? LAST)[1];
  return em * size;
}

const WIDTHS: readonly (readonly [letters: RegExp, em: number])[] = [
  [/[iljtfr]/, 0.36], [/[mw]/, 0.86], [/[0-9a-z]/, 0.58], [/[ .,:;'|]/, 0.3], [/[⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺]/, 0.4],
];
const LAST = [/./, 0.68] as const;
