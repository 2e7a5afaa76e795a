/* Fewer points for a line, seen the same: of the points that follow each other within one pixel column, the first, the lowest, the highest and the last.
 *
 * Invariant: no peak is lost, points stay in order, and a gap (NaN) stays a gap. Coordinates are kept within what a canvas can draw.
 */
import type { Scale } from './types';

/** Far outside any picture; beyond it, canvases lose precision and draw nonsense. */
const FAR = 1e5;

export function thin(x: ArrayLike<number>, y: ArrayLike<number>, fx: Scale, fy: Scale): Float64Array {
  const n = Math.min(x.length, y.length);
  const out = new Float64Array(2 * n + 2);
  let used = 0, column = NaN, count = 0;
  // Of the present column: the first is written at once; the others wait until the column is left.
  let lowX = 0, lowY = 0, lowAt = 0, highX = 0, highY = 0, highAt = 0, lastX = 0, lastY = 0;
  const put = (px: number, py: number): void => { out[used++] = px; out[used++] = py; };
  const leave = (): void => {
    if (count > 1) {
      const lowFirst = lowAt < highAt;
      if (count > 3) {
        if (lowFirst) { if (lowAt > 0) put(lowX, lowY); if (highAt < count - 1) put(highX, highY); }
        else { if (highAt > 0) put(highX, highY); if (lowAt < count - 1 && lowAt !== highAt) put(lowX, lowY); }
      } else if (count === 3) put(lowAt === 1 ? lowX : highAt === 1 ? highX : lastX, lowAt === 1 ? lowY : highAt === 1 ? highY : lastY);
      put(lastX, lastY);
    }
    count = 0;
  };
  for (let i = 0; i < n; i++) {
    let px = fx(x[i]!), py = fy(y[i]!);
    if (Number.isNaN(px) || Number.isNaN(py)) {
      leave();
      column = NaN;
      if (used && !Number.isNaN(out[used - 1]!)) put(NaN, NaN);
      continue;
    }
    px = px > FAR ? FAR : px < -FAR ? -FAR : px;
    py = py > FAR ? FAR : py < -FAR ? -FAR : py;
    const here = Math.floor(px);
    if (here !== column) {
      leave();
      column = here;
      put(px, py);
      lowX = highX = px, lowY = highY = py, lowAt = highAt = 0;
    } else {
      if (py < lowY) lowX = px, lowY = py, lowAt = count;
      if (py > highY) highX = px, highY = py, highAt = count;
    }
    lastX = px, lastY = py;
    count++;
  }
  leave();
  return out.subarray(0, used);
}

/** For curves that turn back (an orbit, a phase curve): points nearer than half a pixel to the one before are left out. */
export function thinPath(x: ArrayLike<number>, y: ArrayLike<number>, fx: Scale, fy: Scale, near = 0.5): Float64Array {
  const n = Math.min(x.length, y.length);
  const out = new Float64Array(2 * n);
  let used = 0, lastX = NaN, lastY = NaN;
  for (let i = 0; i < n; i++) {
    let px = fx(x[i]!), py = fy(y[i]!);
    if (Number.isNaN(px) || Number.isNaN(py)) {
      if (used && !Number.isNaN(lastX)) { out[used++] = NaN; out[used++] = NaN; }
      lastX = lastY = NaN;
      continue;
    }
    px = px > FAR ? FAR : px < -FAR ? -FAR : px;
    py = py > FAR ? FAR : py < -FAR ? -FAR : py;
    if (i + 1 < n && Math.abs(px - lastX) < near && Math.abs(py - lastY) < near) continue;
    out[used++] = lastX = px;
    out[used++] = lastY = py;
  }
  return out.subarray(0, used);
}
