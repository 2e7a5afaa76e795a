/* Marks where events happened: a ring on what a curve came to, a dot on what the event left, where that is elsewhere.
 *
 * Invariant: marks stand at numbers of the table of events, never between rows; of those that would cover one another the first is drawn.
 */
import type { Events } from '../protocol';
import type { Look } from '../scene';
import type { Ink, Pen } from './types';

export interface Mark { readonly x: number; readonly y: number; /** On what the event left. */ readonly after: boolean; readonly time: number }
type Places = (sides: readonly Float64Array[], row: number) => readonly [x: number, y: number];

const APART = 6, RING = 4, DOT = 2.6;

/** place: the pixels of a row of the table, by its columns before or after. */
export function marksOf(events: Events, place: Places): Mark[] {
  const marks: Mark[] = [], put = (of: readonly Float64Array[], row: number, after: boolean): void => {
    const [x, y] = place(of, row);
    if (Number.isFinite(x + y)) marks.push({ x, y, after, time: events.times[row]! });
  };
  for (let row = 0; row < events.times.length; row++) {
    put(events.before, row, false);
    const [x0, y0] = place(events.before, row), [x1, y1] = place(events.after, row);
    if (events.changed[row] && Math.hypot(x1 - x0, y1 - y0) > 1) put(events.after, row, true);
  }
  // Those that lie nearer than APART to a kept one of the same kind would be one blot: cells of that size hold one each.
  const taken = new Set<string>();
  return marks.filter(({ x, y, after }) => {
    const cell = `${after} ${Math.round(x / APART)} ${Math.round(y / APART)}`;
    return !taken.has(cell) && taken.add(cell);
  });
}

export function drawMarks(pen: Pen, ink: Ink, marks: readonly Mark[], look: Look): void {
  for (const { x, y, after } of marks) {
    if (after) pen.mark('circle', x, y, DOT, look.colour, { rim: ink.surface });
    else {
      pen.mark('circle', x, y, RING, ink.surface);
      pen.mark('ring', x, y, RING - 0.5, look.colour);
    }
  }
}
