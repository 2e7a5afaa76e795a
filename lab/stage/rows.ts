/* Where in a track a time lies.
 *
 * Between recorded rows a position is read off the straight chord. Where rows are dense, eyes cannot tell that from the motion; where steps are
 * few, the chord is what the method knows: nothing between its points. No motion is computed here.
 */

/** The last row at or before t in the direction of the run, 0 … n - 2, and how far towards the next one t is, 0 … 1. */
export interface Place { row: number; part: number }

export function placeAt(times: ArrayLike<number>, t: number, out: Place = { row: 0, part: 0 }): Place {
  const n = times.length;
  if (n < 2) { out.row = 0; out.part = 0; return out; }
  const forward = times[n - 1]! >= times[0]!;
  let low = 0, high = n - 1;                      // times[low] <= t < times[high], in the direction of the run
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (forward ? times[middle]! <= t : times[middle]! >= t) low = middle; else high = middle;
  }
  const length = times[high]! - times[low]!;
  out.row = low;
  // A run that ends with a jump is where that left it.
  out.part = length === 0 ? 1 : Math.min(1, Math.max(0, (t - times[low]!) / length));
  return out;
}

/** part 0 and 1 give the rows themselves, also where the other one is not finite. */
export function valueAt(column: ArrayLike<number>, place: Place): number {
  const a = column[place.row] ?? NaN;
  if (place.part === 0) return a;
  const b = column[place.row + 1] ?? NaN;
  return place.part === 1 ? b : a + (b - a) * place.part;
}

/** Whether nothing of it is to come. */
export function isDone(times: ArrayLike<number>, t: number): boolean {
  const n = times.length;
  return n < 1 || (times[0]! <= times[n - 1]! ? t >= times[n - 1]! : t <= times[n - 1]!);
}

/** Whether a track that stopped early has nothing to show at t. */
export function isOver(times: ArrayLike<number>, t: number): boolean {
  const n = times.length;
  if (n < 1) return true;
  const last = times[n - 1]!;
  return times[0]! <= last ? t > last : t < last;
}
