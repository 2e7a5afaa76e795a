/* Names of what moves, where several do: each beside its body, once, however many methods compute it.
 *
 * Invariant: no name lies on another one, on a body, or on letters that stand there already; one that finds no place is left out.
 */
import { nameText } from '../figure/name';
import { textWidth } from '../figure/shapes';
import type { Ink, Pen } from '../figure/types';
import { words } from '../words';
import { apart, type Box, type Place } from './place';
import type { Point } from './curves';
import type { Staging } from './staging';
import type { Subject } from './subject';

/** More would hide the motion. */
const MOST = 8;
/** How far from a body its name may stand, in pixels; beyond the first with a line to it. And in which directions, the best first. */
const REACHES = [0, 12, 26, 42, 60, 80], WAYS = [[1, 0], [-1, 0], [0, -1], [0, 1], [0.8, -0.8], [-0.8, -0.8], [0.8, 0.8], [-0.8, 0.8]] as const;

/** As the example names them; as the model does: the name of a vector, the number of one of a family. */
export function bodyNames({ kind, bodies }: Subject, staging: Staging): readonly string[] {
  if (bodies.length < 2 || bodies.length > MOST || kind === 'time' || kind === 'shape') return [];
  const given = staging.bodies?.map((name) => words.stage.bodies[name]);
  return bodies.map(({ label }, k) => given?.[k] ?? /\[(-?\d+)\]$/.exec(label)?.[1] ?? nameText(label));
}

/** at: where each body is; null: not in the picture. balls: all that is drawn of them. */
export function drawBodies(pen: Pen, ink: Ink, place: Place, names: readonly string[], at: readonly (Point | null)[], balls: readonly Point[], written: readonly Box[]): void {
  const size = (place.names ? 13 : 12) * place.scale, high = 1.1 * size, off = place.ball + 3;
  const taken: Box[] = [...written, ...balls.map(({ x, y }): Box => ({ left: x - off + 2, right: x + off - 2, top: y - off + 2, bottom: y + off - 2 }))];
  names.forEach((name, k) => {
    const from = at[k];
    if (!from) return;
    const wide = textWidth(name, size) * 1.06;
    for (const reach of REACHES) for (const [across, up] of WAYS) {
      const x = from.x + across * (off + reach + wide / 2), y = from.y + up * (off + reach + high / 2), box = { left: x - wide / 2, right: x + wide / 2, top: y - high / 2, bottom: y + high / 2 };
      if (box.left < place.text + 2 || box.right > place.width - 2 || box.top < 2 || box.bottom > place.height - 2 || !taken.every((other) => apart(box, other))) continue;
      taken.push(box);
      if (reach > 12) {
        const nearX = Math.min(box.right, Math.max(box.left, from.x)), nearY = Math.min(box.bottom, Math.max(box.top, from.y)), far = Math.hypot(nearX - from.x, nearY - from.y) || 1;
        pen.line([from.x + (nearX - from.x) * off / far, from.y + (nearY - from.y) * off / far, nearX, nearY], { colour: ink.quiet, width: 1, alpha: 0.7 });
      }
      pen.text(x, y, name, { colour: ink.text, size, anchor: 'middle', baseline: 'middle', halo: ink.surface });
      return;
    }
  });
}
