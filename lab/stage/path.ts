/* A motion as a line on the screen, with no more corners than can be seen, and the part of it that a time has reached.
 *
 * Invariant: the line is nowhere further than the tolerance from the recorded points, and its corners are recorded points; so that the whole line
 * and the part so far are the same line.
 */
export interface Path { readonly xy: Float64Array; readonly rows: Int32Array; readonly count: number }

/* Far outside the picture only the direction counts; canvases lose their precision there. */
const FAR = 2e4;
const clamp = (pixel: number): number => pixel > FAR ? FAR : pixel < -FAR ? -FAR : pixel;

/* Beyond so many corners a line is drawn with a coarser eye: it is drawn anew in every frame of an animation. */
const MANY = 1600;

export function path(count: number, x: (row: number) => number, y: (row: number) => number, tolerance = 0.3, coarsest = 1.2): Path {
  const made = simplified(count, x, y, tolerance);
  return made.count > MANY && tolerance < coarsest ? path(count, x, y, 2 * tolerance, coarsest) : made;
}

/* Opens a sleeve from the last corner and goes on while one straight line passes all points within the tolerance. */
function simplified(count: number, x: (row: number) => number, y: (row: number) => number, tolerance: number): Path {
  const xy = new Float64Array(2 * count), rows = new Int32Array(count);
  let n = 0, lastX = NaN, lastY = NaN, heldX = NaN, heldY = NaN, held = -1, heldDistance = 0;
  let wayX = 0, wayY = 0, low = 0, high = 0, open = false;
  const keep = (row: number, px: number, py: number): void => {
    xy[2 * n] = px; xy[2 * n + 1] = py; rows[n++] = row;
    lastX = px; lastY = py; held = -1; open = false; heldDistance = 0;
  };
  for (let row = 0; row < count; row++) {
    const rawX = x(row), rawY = y(row);
    if (Number.isNaN(rawX) || Number.isNaN(rawY)) {
      if (held >= 0) keep(held, heldX, heldY);
      keep(row, NaN, NaN);
      continue;
    }
    const px = clamp(rawX), py = clamp(rawY);
    if (Number.isNaN(lastX)) { keep(row, px, py); continue; }
    let dx = px - lastX, dy = py - lastY, distance = Math.hypot(dx, dy);
    if (held >= 0 && open) {
      const angle = Math.atan2(wayX * dy - wayY * dx, wayX * dx + wayY * dy);
      if (distance < heldDistance - tolerance || (distance > tolerance && (angle < low || angle > high))) {
        keep(held, heldX, heldY);
        dx = px - lastX; dy = py - lastY; distance = Math.hypot(dx, dy);
      }
    }
    if (distance > tolerance) {
      const half = Math.asin(Math.min(1, tolerance / distance));
      if (!open) { wayX = dx; wayY = dy; low = -half; high = half; open = true; }
      else {
        const angle = Math.atan2(wayX * dy - wayY * dx, wayX * dx + wayY * dy);
        low = Math.max(low, angle - half); high = Math.min(high, angle + half);
      }
    }
    held = row; heldX = px; heldY = py; heldDistance = Math.max(heldDistance, distance);
  }
  if (held >= 0) keep(held, heldX, heldY);
  return { xy, rows, count: n };
}

/** The corners of the path up to a row, then the present point; in a buffer that the next call takes again. */
let buffer = new Float64Array(4096);
export function trail(of: Path, row: number, x: number, y: number): { readonly xy: Float64Array; readonly count: number } {
  let low = 0, high = of.count;                     // rows[low - 1] <= row < rows[high]
  while (low < high) {
    const middle = (low + high) >> 1;
    if (of.rows[middle]! <= row) low = middle + 1; else high = middle;
  }
  const count = 2 * low;
  if (buffer.length < count + 2) buffer = new Float64Array(2 * (count + 2));
  buffer.set(of.xy.subarray(0, count));
  if (Number.isNaN(x) || Number.isNaN(y)) return { xy: buffer, count };
  buffer[count] = clamp(x); buffer[count + 1] = clamp(y);
  return { xy: buffer, count: count + 2 };
}

export function lengthOf({ xy, count }: Path): number {
  let sum = 0;
  for (let i = 1; i < count; i++) {
    const d = Math.hypot(xy[2 * i]! - xy[2 * i - 2]!, xy[2 * i + 1]! - xy[2 * i - 1]!);
    if (d < 1e4) sum += d;                          // neither lifted nor far outside
  }
  return sum;
}
