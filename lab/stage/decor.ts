/* What stands beside a motion, for scale or to show what moves: who throws and who catches, the spring, the pendulum's rod. */
import type { Ink, Pen } from '../figure/types';

/** A person of 1.75 m, a hand at (handX, handY); foot: the height of the ground, unit: pixels of a metre, way: 1 looks to the right. */
export function person(pen: Pen, ink: Ink, handX: number, handY: number, foot: number, unit: number, way: 1 | -1): void {
  const colour = ink.figure, hip = handX - way * 0.46 * unit, at = (dx: number, up: number): [number, number] => [hip + way * dx * unit, foot - up * unit];
  const stroke = (width: number) => ({ colour, width: width * unit });
  const [shoulderX, shoulderY] = at(0.04, 1.34);
  pen.line([...at(-0.2, 0.1), ...at(0, 0.82), ...at(0.2, 0.1)], stroke(0.13));
  pen.line([...at(0, 0.86), shoulderX, shoulderY], stroke(0.19));
  // The elbow hangs below the straight line from shoulder to hand.
  pen.line([shoulderX, shoulderY + 0.04 * unit, (shoulderX + handX) / 2 + way * 0.01 * unit, (shoulderY + handY) / 2 + 0.1 * unit, handX, handY], stroke(0.1));
  for (const [x, y] of [at(-0.2, 0.1), at(0.2, 0.1), [handX, handY]] as const) pen.mark('circle', x, y, 0.055 * unit, colour);
  pen.mark('circle', ...at(0.04, 1.64), 0.13 * unit, colour);
}

/** A spring that hangs from above down to a mass at y. */
export function spring(pen: Pen, ink: Ink, x: number, top: number, y: number): void {
  const turns = 13, first = top + 14, last = y - 22, xy = [x, top, x, first];
  for (let k = 0; k < turns; k++) xy.push(x + (k % 2 ? -11 : 11), first + (last - first) * (k + 0.5) / turns);
  xy.push(x, last, x, y - 14);
  pen.line([x - 22, top, x + 22, top], { colour: ink.axis, width: 2.5 });
  pen.line(xy, { colour: ink.axis, width: 1.5 });
}

/** A floor at this height, hatched below. */
export function floor(pen: Pen, ink: Ink, left: number, right: number, y: number): void {
  const hatch: number[] = [];
  for (let x = left + 8; x <= right; x += 10) hatch.push(x, y, x - 8, y + 8, NaN, NaN);
  pen.line([left, y, right, y], { colour: ink.axis, width: 2.5 });
  pen.line(hatch, { colour: ink.axis, width: 1 });
}

/** A rod from (x, y) at an angle from the lowest point. */
export function rod(pen: Pen, ink: Ink, x: number, y: number, length: number, angle: number): readonly [number, number] {
  const end = [x + length * Math.sin(angle), y + length * Math.cos(angle)] as const;
  pen.line([x, y, ...end], { colour: ink.quiet, width: 2 });
  pen.mark('circle', x, y, 4, ink.quiet);
  return end;
}
