/* The legend above a picture: each line as it is drawn, its name, and room for its present value.
 *
 * Invariant: names stand on the layer that keeps still, values on the one that moves; both ask the same layout, so they meet.
 */
import type { Look } from '../scene';
import { textWidth } from './shapes';
import type { Ink, Pen } from './types';

export interface Entry { readonly label: string; readonly colour: string; readonly width: number; readonly dash: readonly number[]; readonly marker: Look['marker'] | null }

export const exactEntry = (ink: Ink, label = 'exact'): Entry => ({ label, colour: ink.exact, width: 5, dash: [], marker: null });
export const lookEntry = (look: Look): Entry => ({ label: look.label, colour: look.colour, width: 1.75, dash: look.dash, marker: look.marker });

const ROW = 19, SAMPLE = 30, GAP = 20, LETTERS = 12;

export interface LegendLayout { readonly height: number; at(index: number): { readonly x: number; readonly y: number; readonly value: number } }

/** values: how many letters a value takes, 0 for none. */
export function legendLayout(width: number, labels: readonly string[], values = 0, left = 1): LegendLayout {
  const count = labels.length;
  const room = values ? values * 0.6 * LETTERS + 8 : 0;
  const cell = SAMPLE + Math.max(...labels.map((l) => textWidth(l, LETTERS)), 30) + room + GAP;
  const most = Math.max(1, Math.min(count, Math.floor((width - left + GAP) / cell)));
  // As many rows as that takes, but no row much shorter than the others: four lines stand as two and two, not three and one.
  const columns = Math.max(1, Math.ceil(count / Math.ceil(count / most)));
  const rows = count ? Math.ceil(count / columns) : 0;
  // Cells keep their width where there is room: a legend spread over a wide picture is hard to read along.
  return {
    height: rows * ROW + 8,
    at(index) {
      const x = left + (index % columns) * cell;
      return { x, y: Math.floor(index / columns) * ROW + ROW / 2, value: Math.min(x + cell - GAP, width) };
    },
  };
}

export function drawSample(pen: Pen, x: number, y: number, entry: Entry): void {
  pen.line([x, y, x + 24, y], { colour: entry.colour, width: entry.width, dash: entry.dash });
  if (entry.marker) pen.mark(entry.marker, x + 12, y, 3.4, entry.colour);
}

export function drawLegend(pen: Pen, ink: Ink, entries: readonly Entry[], layout: LegendLayout, top = 0): void {
  entries.forEach((entry, i) => {
    const { x, y } = layout.at(i);
    drawSample(pen, x, top + y, entry);
    pen.text(x + SAMPLE, top + y, entry.label, { colour: ink.text, size: LETTERS, baseline: 'middle' });
  });
}

export function drawValues(pen: Pen, ink: Ink, values: readonly string[], layout: LegendLayout, top = 0): void {
  values.forEach((value, i) => {
    const { y, value: right } = layout.at(i);
    pen.text(right, top + y, value, { colour: ink.quiet, size: LETTERS, baseline: 'middle', anchor: 'end' });
  });
}
