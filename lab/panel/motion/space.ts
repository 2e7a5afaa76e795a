/* The backdrop of pictures of space: a box in parallel projection, seen by a camera that one can turn.
 *
 * Invariant: a unit is as long along all three axes, and turning the camera changes neither the scale nor what is inside.
 */
import type { Ink, Pen } from '../../figure/types';
import { readable } from '../../figure/number';
import type { ViewBox } from './view_box';
import type { Projection } from './lines_view';

/** Angles in radians: round the upright axis, and above the horizon. */
export interface Camera { turn: number; rise: number }
export const HOME: Readonly<Camera> = { turn: -0.65, rise: 0.45 };

export function turned(camera: Camera, turn: number, rise: number): void {
  camera.turn = (camera.turn + turn) % (2 * Math.PI);
  camera.rise = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, camera.rise + rise));
}

const EDGES: readonly (readonly [number, number])[] = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

export function spaceBackdrop(names: readonly string[], camera: Camera) {
  return (pen: Pen, ink: Ink, box: ViewBox, top: number): Projection => {
    const middle = box.ranges.map(r => (r[0] + r[1]) / 2), half = box.ranges.map(r => (r[1] - r[0]) / 2);
    const left = 10, width = pen.width - 20, height = pen.height - top - 12;
    const scale = Math.min(width, height) / 2 / (Math.hypot(...half) || 1);
    const ct = Math.cos(camera.turn), st = Math.sin(camera.turn), cr = Math.cos(camera.rise), sr = Math.sin(camera.rise);
    const cx = left + width / 2, cy = top + height / 2;
    const x = (a: number, b: number): number => cx + scale * (ct * (a - middle[0]!) - st * (b - middle[1]!));
    const y = (a: number, b: number, c: number): number => cy - scale * (cr * (c - middle[2]!) + sr * (st * (a - middle[0]!) + ct * (b - middle[1]!)));
    const depth = (a: number, b: number, c: number): number => cr * (st * a + ct * b) - sr * c;       // away from the eye

    const corner = Array.from({ length: 8 }, (_, k) => [0, 1, 2].map(d => box.ranges[d]![k >> d & 1]));
    const at = corner.map(p => [x(p[0]!, p[1]!), y(p[0]!, p[1]!, p[2]!)] as const);
    let nearest = 0;
    corner.forEach((p, k) => { if (depth(p[0]!, p[1]!, p[2]!) < depth(corner[nearest]![0]!, corner[nearest]![1]!, corner[nearest]![2]!)) nearest = k; });
    for (const [i, j] of EDGES) {
      /* The edges that meet at the corner next to the eye would run across the motion. */
      const front = i === nearest || j === nearest;
      pen.line([...at[i]!, ...at[j]!], { colour: front ? ink.grid : ink.axis, width: 1, alpha: front ? 0.5 : 0.8, dash: front ? [2, 4] : [] });
    }
    labels(pen, ink, names, box, at, cx, cy, nearest);
    return { x: (a, b) => x(a, b), y, left, top, width, height, rail: null, remark: '' };
  };
}

/* Each axis is named at the edge of the outline that is lowest, or for the upright one leftmost; with the numbers of its ends. */
function labels(pen: Pen, ink: Ink, names: readonly string[], box: ViewBox, at: readonly (readonly [number, number])[], cx: number, cy: number, nearest: number): void {
  for (let d = 0; d < 3; d++) {
    let best: readonly [number, number] | null = null, score = -Infinity;
    for (const [i, j] of EDGES) {
      if ((j ^ i) !== 1 << d || i === nearest || j === nearest) continue;
      const mx = (at[i]![0] + at[j]![0]) / 2, my = (at[i]![1] + at[j]![1]) / 2;
      const s = d === 2 ? -mx : my;
      if (s > score) { score = s; best = [i, j]; }
    }
    if (!best) continue;
    const [i, j] = best, [x0, y0] = at[i]!, [x1, y1] = at[j]!;
    if (Math.hypot(x1 - x0, y1 - y0) < 24) continue;
    const mx = (x0 + x1) / 2, my = (y0 + y1) / 2, away = Math.hypot(mx - cx, my - cy) || 1;
    const ox = (mx - cx) / away * 14, oy = (my - cy) / away * 14;
    const anchor = ox > 5 ? 'start' : ox < -5 ? 'end' : 'middle';
    pen.text(mx + ox, my + oy, names[d] ?? '', { colour: ink.text, size: 13, italic: true, anchor, baseline: 'middle' });
    for (const [px, py, value] of [[x0 + (x1 - x0) * 0.08, y0 + (y1 - y0) * 0.08, box.ranges[d]![0]], [x0 + (x1 - x0) * 0.92, y0 + (y1 - y0) * 0.92, box.ranges[d]![1]]] as const)
      pen.text(px + ox * 0.8, py + oy * 0.8, readable(value, 2), { colour: ink.quiet, size: 11, anchor, baseline: 'middle' });
  }
}
