/* Marks where events happened: a ring on what a curve came to, a dot on what the event left, where that is elsewhere.
 *
 * Invariant: marks stand at numbers of the table of events, never between rows; of those that would cover one another the first is drawn.
 */
import type { Events } from '../protocol';
import type { Look } from '../scene';
import type { Ink, Pen } from './types';

export interface Mark { readonly x: number; readonly y: number; /** On what the event left. */ readonly after: boolean; readonly time: number }
type Places = (sides: readonly Float64Array[], row: number) => readonly [x: number, y: number];

/* Pixels. Where more than CROWD rings follow one another so closely that they hide the curve, as most of them do then, some stay away, so that there is ROOM between them. */
const APART = 6, CROWD = 30, MOST = 0.75, ROOM = 22, RING = 4, DOT = 2.6;

/** The rows of the table in which the body `own` has part: of each body the columns, of which an event changes some; one that changes none of any body's is everybody's. */
export function partOf({ before, after }: Events, bodies: readonly (readonly number[])[], own: number): (row: number) => boolean {
  const changes = (columns: readonly number[], row: number): boolean => columns.some((c) => c >= 0 && before[c]![row] !== after[c]![row]);
  return (row) => changes(bodies[own]!, row) || !bodies.some((columns) => changes(columns, row));
}

/** place: the pixels of a row of the table, by its columns before or after; part: the rows that get a mark. */
export function marksOf(events: Events, place: Places, part: (row: number) => boolean = () => true): Mark[] {
  const marks: Mark[] = [], put = ([x, y]: readonly [number, number], row: number, after: boolean): void => {
    if (Number.isFinite(x + y)) marks.push({ x, y, after, time: events.times[row]! });
  };
  for (let row = 0; row < events.times.length; row++) {
    if (!part(row)) continue;
    const before = place(events.before, row), after = place(events.after, row);
    put(before, row, false);
    if (events.changed[row] && Math.hypot(after[0] - before[0], after[1] - before[1]) > 1) put(after, row, true);
  }
  // Those that lie nearer than APART to a kept one of the same kind would be one blot: cells of that size hold one each.
  const taken = new Set<string>();
  const kept = marks.filter(({ x, y, after }) => {
    const cell = `${after} ${Math.round(x / APART)} ${Math.round(y / APART)}`;
    return !taken.has(cell) && taken.add(cell);
  });
  const rings = kept.filter(({ after }) => !after), close = rings.slice(1).filter((mark, k) => distance(mark, rings[k]!) < ROOM);
  return rings.length > CROWD && close.length > MOST * rings.length ? [...spaced(rings), ...spaced(kept.filter(({ after }) => after))] : kept;
}

const distance = (a: Mark, b: Mark): number => Math.hypot(a.x - b.x, a.y - b.y);

/** Along the curve, with room between them. */
function spaced(marks: readonly Mark[]): Mark[] {
  let last: Mark | null = null;
  return marks.filter((mark) => {
    if (last && distance(mark, last) < ROOM) return false;
    last = mark;
    return true;
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
