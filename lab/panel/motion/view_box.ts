/* What part of the world the picture shows: the whole motion, of the truth and of every method, unless a method runs away.
 *
 * Invariant: the truth is always inside. A method that would make the others too small to be seen is named a runaway and leaves the frame.
 */

/** The columns of one motion along each axis: cloud[axis] is a list of columns (one per body). */
export type Cloud = readonly (readonly ArrayLike<number>[])[];
export interface ViewBox { readonly ranges: readonly (readonly [number, number])[]; readonly runaway: readonly boolean[] }

/* Up to so many times the size of the motion, a method's excursions are part of the picture. */
const ALLOWANCE = 6;
const MARGIN = 0.06, MARGIN_RUNAWAY = 0.2;

type Range = [number, number];

function rangeOf(columns: readonly ArrayLike<number>[]): Range {
  let low = Infinity, high = -Infinity;
  for (const column of columns)
    for (let i = 0; i < column.length; i++) {
      const value = column[i]!;
      if (value < low && value !== -Infinity) low = value;
      if (value > high && value !== Infinity) high = value;
    }
  return [low, high];
}

const size = (r: Range): number => r[1] >= r[0] ? r[1] - r[0] : 0;
const join = (a: Range, b: Range): Range => [Math.min(a[0], b[0]), Math.max(a[1], b[1])];
const largest = (ranges: readonly Range[]): number => Math.max(0, ...ranges.map(size));

export function viewBox(truth: Cloud | null, tracks: readonly Cloud[], axes: number): ViewBox {
  const boxes = tracks.map(cloud => Array.from({ length: axes }, (_, k) => rangeOf(cloud[k] ?? [])));
  const still: Range[] = Array.from({ length: axes }, () => [Infinity, -Infinity]);
  let base = truth ? Array.from({ length: axes }, (_, k) => rangeOf(truth[k] ?? [])) : still;
  if (largest(base) === 0) {
    /* Without a truth that moves, the smallest motion is the measure. */
    const moving = boxes.filter(box => largest(box) > 0).sort((a, b) => largest(a) - largest(b));
    if (moving[0]) base = moving[0].map((r, k) => join(r, base[k]!));
    else if (boxes[0]) base = boxes[0].map((r, k) => join(r, base[k]!));
  }
  const measure = largest(base);
  let ranges: Range[] = base.map(r => [r[0], r[1]]);
  const runaway = boxes.map(box => measure > 0 && box.some((r, k) => size(join(r, base[k]!)) > ALLOWANCE * Math.max(size(base[k]!), measure / 4)));
  boxes.forEach((box, i) => { if (!runaway[i]) ranges = ranges.map((r, k) => join(r, box[k]!)); });
  const margin = runaway.includes(true) ? MARGIN_RUNAWAY : MARGIN;
  const whole = largest(ranges) || 1;
  return {
    runaway,
    ranges: ranges.map(r => {
      if (!(r[1] >= r[0])) return [-1, 1];
      /* Motion along a line keeps some room across it. */
      const room = size(r) > 1e-6 * whole ? margin * size(r) : Math.max(0.05 * whole, Math.abs(r[0]) * 1e-3);
      return [r[0] - room, r[1] + room];
    }),
  };
}

/** The first row of a track that lies outside, -1 if none does. */
export function leavesAt(cloud: Cloud, ranges: ViewBox['ranges']): number {
  let first = -1;
  ranges.forEach(([low, high], k) => {
    for (const column of cloud[k] ?? [])
      for (let i = 0; i < column.length && (first < 0 || i < first); i++)
        if (!(column[i]! >= low && column[i]! <= high)) { first = i; break; }
  });
  return first;
}
