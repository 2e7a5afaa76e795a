/* Whether lines are drawn thin: a processor without a graphics card strokes a line of one pixel ten times as fast as a wider one, so that on a slow machine
 * the picture still follows the hand.
 *
 * Invariant: lines are thin only while something is being changed and pictures come too slowly; soon after the last change all is drawn in full again.
 */

/** Milliseconds between two pictures beyond which a hand feels the lag (20 in a second are 50); after which no more are expected. */
const SLOW = 40, PAUSE = 250;
/** So many slow ones in a row. */
const PATIENCE = 3;

export interface Haste {
  /** A picture is about to be drawn, at a time in milliseconds; changing: while a hand changes something. Answers whether with thin lines. */
  draws(now: number, changing: boolean): boolean;
}

/** over: called once all shall be drawn in full. */
export function haste(over: () => void, later: (act: () => void, milliseconds: number) => number = (act, ms) => window.setTimeout(act, ms), never: (timer: number) => void = clearTimeout): Haste {
  let last = -Infinity, slow = 0, thin = false, timer = 0;
  const end = (): void => { thin = false; slow = 0; over(); };
  return {
    draws(now, changing) {
      const between = now - last;
      last = now;
      slow = !changing || between > PAUSE ? 0 : between > SLOW ? slow + 1 : Math.max(0, slow - 1);
      if (slow >= PATIENCE) thin = true;
      never(timer);
      if (thin) timer = later(end, PAUSE);
      return thin;
    },
  };
}
