/* Where on the stage a note can stand: the free place nearest to where it is wanted.
 *
 * Invariant: what was put down here once is clear of all that comes after it, as long as the stage has room; where it has none, the place that covers least.
 */
import type { Box } from './place';

/** Pixels of a cell; what a covered cell costs, in pixels further away; the most that is walked along one piece of a line. */
const CELL = 6, COVERED = 60, LONGEST = 3e4;

export interface Free {
  line(xy: ArrayLike<number>, count: number): void;
  take(box: Box): void;
  /** How much of a box is covered, or lies outside; in cells. */
  covered(box: Box): number;
  /** The left and the top of a box so large, as near to these as can be. */
  put(left: number, top: number, width: number, height: number): { readonly left: number; readonly top: number };
}

/** Within: what a note may cover at all. */
export function freePlaces(within: Box): Free {
  const columns = Math.max(1, Math.ceil((within.right - within.left) / CELL)), rows = Math.max(1, Math.ceil((within.bottom - within.top) / CELL)), full = new Uint8Array(columns * rows);
  const column = (x: number): number => Math.floor((x - within.left) / CELL), row = (y: number): number => Math.floor((y - within.top) / CELL);
  const mark = (i: number, j: number): void => { if (i >= 0 && j >= 0 && i < columns && j < rows) full[i + columns * j] = 1; };
  function take({ left, right, top, bottom }: Box): void {
    for (let j = Math.max(0, row(top)); j <= Math.min(rows - 1, row(bottom)); j++) for (let i = Math.max(0, column(left)); i <= Math.min(columns - 1, column(right)); i++) mark(i, j);
  }
  return {
    take,
    covered({ left, right, top, bottom }) {
      let count = 0;
      for (let j = row(top); j <= row(bottom); j++) for (let i = column(left); i <= column(right); i++) if (i < 0 || j < 0 || i >= columns || j >= rows || full[i + columns * j]) count++;
      return count;
    },
    line(xy, count) {
      for (let k = 0; k + 1 < count; k++) {
        const x = xy[2 * k]!, y = xy[2 * k + 1]!, dx = xy[2 * k + 2]! - x, dy = xy[2 * k + 3]! - y, steps = Math.ceil(Math.min(LONGEST, Math.hypot(dx, dy)) / CELL * 1.5) || 1;
        for (let s = 0; s <= steps; s++) mark(column(x + dx * s / steps), row(y + dy * s / steps));
      }
    },
    put(left, top, width, height) {
      // sums[i, j]: covered cells above and at the left of this corner.
      const sums = new Uint32Array((columns + 1) * (rows + 1)), at = (i: number, j: number): number => sums[i + (columns + 1) * j]!;
      for (let j = 0; j < rows; j++) for (let i = 0; i < columns; i++) sums[i + 1 + (columns + 1) * (j + 1)] = full[i + columns * j]! + at(i, j + 1) + at(i + 1, j) - at(i, j);
      const wide = Math.min(columns, Math.ceil(width / CELL) + 1), high = Math.min(rows, Math.ceil(height / CELL) + 1);
      const cost = (x: number, y: number): number => {
        const i = Math.min(columns - wide, Math.max(0, column(x))), j = Math.min(rows - high, Math.max(0, row(y)));
        return COVERED * (at(i + wide, j + high) - at(i, j + high) - at(i + wide, j) + at(i, j)) + Math.hypot(x - left, y - top);
      };
      const clampX = (x: number): number => Math.max(within.left, Math.min(within.right - width, x)), clampY = (y: number): number => Math.max(within.top, Math.min(within.bottom - height, y));
      let best = { left: clampX(left), top: clampY(top) }, least = cost(best.left, best.top);
      for (let j = 0; j + high <= rows; j++) for (let i = 0; i + wide <= columns; i++) {
        const x = clampX(within.left + i * CELL), y = clampY(within.top + j * CELL), own = cost(x, y);
        if (own < least) { least = own; best = { left: x, top: y }; }
      }
      take({ left: best.left, top: best.top, right: best.left + width, bottom: best.top + height });
      return best;
    },
  };
}
