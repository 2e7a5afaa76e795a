/* The plane of z = hλ for one method: where a step grows, asked once and kept; the line where growth is 1, and the area beyond it.
 *
 * Invariant: growth is the core's at the points of a grid; between them log growth is linear. The plane is symmetric about the real axis, as
 * growth is that of a pair λ and its conjugate, so only the upper half is asked for.
 */
import type { Method, Region } from '../protocol';
import type { Client } from '../scene';

export interface Plane {
  readonly half: number;                        // what the picture should show at least: |Im z| up to this
  readonly full: Region | null;                 // null: the method has answers on the imaginary axis only
  readonly axis: Region;
  /** Pieces of the line growth = 1: re, im, re, im, NaN, NaN … */
  readonly border: Float64Array;
  /** The part of the imaginary axis from 0 on where a step does not grow ends here; Infinity: beyond the picture. */
  readonly limit: number;
}

/** Above 1 by less is rounding: the root of the last bit, where two rates meet. */
const LEVEL = 1e-7;
const LEFT = -2.7, RIGHT = 1.9, TALL = 1.3, WIDTH = 231, HEIGHT = 66, AXIS = 1024;
/** log of growth, with what is infinite kept finite. */
const height = (growth: number): number => (growth > 1e30 ? 69 : growth < 1e-30 ? -69 : Math.log(growth)) - LEVEL;

function halfOf(method: Method): number {
  const limit = method.stability_limit;
  if (!Number.isFinite(limit)) return 5;
  // With 1.25 and TALL the limit lies on a line of the grid, where the border has its corner.
  return Math.max(2.4, 1.25 * limit, method.by_rates && method.evaluations > 0 ? 0.9 * method.stages : 0);
}

/** log growth at z, from the grid; NaN outside. */
export function heightAt(region: Region, re: number, im: number): number {
  const y = Math.abs(im);
  const w = region.re.length, h = region.im.length, r0 = region.re[0]!, r1 = region.re[w - 1]!, i0 = region.im[0]!, i1 = region.im[h - 1]!;
  const u = (re - r0) / (r1 - r0) * (w - 1), v = (y - i0) / (i1 - i0) * (h - 1);
  if (!(u >= 0 && u <= w - 1 && v >= 0 && v <= h - 1)) return NaN;
  const i = Math.min(w - 2, Math.floor(u)), j = Math.min(h - 2, Math.floor(v)), s = u - i, t = v - j;
  const at = (a: number, b: number): number => height(region.growth[a + w * b]!);
  return (at(i, j) * (1 - s) + at(i + 1, j) * s) * (1 - t) + (at(i, j + 1) * (1 - s) + at(i + 1, j + 1) * s) * t;
}

/* Marching squares. The cases by which corners lie above: pairs of edges (0 bottom, 1 right, 2 top, 3 left) that a piece of the line joins. */
const PIECES: readonly (readonly number[])[] = [[], [3, 0], [0, 1], [3, 1], [1, 2], [3, 0, 1, 2], [0, 2], [3, 2], [2, 3], [2, 0], [0, 1, 2, 3], [2, 1], [1, 3], [1, 0], [0, 3], []];

function borderOf(region: Region): Float64Array {
  const w = region.re.length, h = region.im.length, out: number[] = [];
  const f = Float64Array.from(region.growth, height);
  for (let j = 0; j + 1 < h; j++) {
    for (let i = 0; i + 1 < w; i++) {
      const a = f[i + w * j]!, b = f[i + 1 + w * j]!, c = f[i + 1 + w * (j + 1)]!, d = f[i + w * (j + 1)]!;
      if (Number.isNaN(a + b + c + d)) continue;
      const pieces = PIECES[Number(a > 0) + 2 * Number(b > 0) + 4 * Number(c > 0) + 8 * Number(d > 0)]!;
      const x0 = region.re[i]!, x1 = region.re[i + 1]!, y0 = region.im[j]!, y1 = region.im[j + 1]!;
      const on = (p: number, q: number): number => p / (p - q);
      const edge = (e: number): [number, number] => (e === 0 ? [x0 + (x1 - x0) * on(a, b), y0] : e === 1 ? [x1, y0 + (y1 - y0) * on(b, c)]
        : e === 2 ? [x0 + (x1 - x0) * on(d, c), y1] : [x0, y0 + (y1 - y0) * on(a, d)]);
      for (let k = 0; k < pieces.length; k += 2) {
        const [px, py] = edge(pieces[k]!), [qx, qy] = edge(pieces[k + 1]!);
        out.push(px, py, qx, qy, NaN, NaN, px, -py, qx, -qy, NaN, NaN);
      }
    }
  }
  return Float64Array.from(out);
}

const kept = new Map<string, Promise<Plane>>();
/** Asked once per method. */
export function planeOf(client: Client, method: Method): Promise<Plane> {
  const known = kept.get(method.name);
  if (known) return known;
  const half = halfOf(method);
  const ask = (re: readonly [number, number], im: readonly [number, number], width: number, tall: number, key: string): Promise<Region> =>
    client.ask('region', { method: method.name, re, im, width, height: tall }, { lane: 'study', key: `region-${key}-${method.name}` });
  const made = (async (): Promise<Plane> => {
    // Two equal columns: a grid has no width of one.
    const axis = await ask([0, 0], [0, TALL * half], 2, AXIS, 'axis');
    // The imaginary axis is a column of the grid: LEFT and RIGHT are multiples of its mesh.
    const full = await ask([LEFT * half, RIGHT * half], [0, TALL * half], WIDTH, HEIGHT, 'plane');
    const w = full.re.length;
    const everywhere = full.growth.some((growth, k) => full.re[k % w] !== 0 && !Number.isNaN(growth));
    let limit = Infinity;
    for (let j = 0; j < axis.im.length && limit === Infinity; j++) if (!(axis.growth[2 * j]! <= 1 + LEVEL)) limit = j > 0 ? axis.im[j - 1]! : 0;
    return { half, full: everywhere ? full : null, axis, border: everywhere ? borderOf(full) : new Float64Array(0), limit };
  })();
  kept.set(method.name, made);
  // A question that was called off may be asked again.
  made.catch(() => { if (kept.get(method.name) === made) kept.delete(method.name); });
  return made;
}
