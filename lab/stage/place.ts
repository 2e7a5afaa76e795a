/* Where things stand on the stage, for a size of it: the frame that the motion fills, room for names at its right, letters, strokes.
 *
 * Invariant: lengths are CSS pixels of the stage; the frame has a width and a height however small the stage is, and so has what stands in it: text and side
 * plots give way before the motion does.
 */
export type Mode = 'phone' | 'landscape' | 'tablet' | 'desk' | 'wide';
export interface Box { readonly left: number; readonly top: number; readonly right: number; readonly bottom: number }
export const apart = (a: Box, b: Box): boolean => a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
export interface Place {
  readonly mode: Mode; readonly width: number; readonly height: number;
  /** Where the motion is drawn; axes stand below and at its left, names at its right. */
  readonly frame: Box;
  /** Where the text that stands on the stage ends; 0 where it stands above. */
  readonly text: number;
  /** Letters, times what they are on a desk. */
  readonly scale: number;
  /** Names stand in a column at the right; else at the curves, and only numbers at the right. */
  readonly names: boolean;
  readonly marker: number; readonly ball: number;
  /** Axes lie where their numbers are, not in the middle of a pixel. */
  readonly fine?: boolean;
}

/** Pixels that a motion has at least, where the stage has them: less shows nothing. */
const LEAST = 150;
/** A box that is wide and high enough to draw in, kept within the stage where that can be. */
export function wideEnough({ left, top, right, bottom }: Box, { width, height }: { readonly width: number; readonly height: number }): Box {
  const across = Math.min(LEAST, Math.max(40, width - 40)), up = Math.min(LEAST / 2, Math.max(30, height - 40));
  const l = right - left < across ? Math.max(8, Math.min(left, width - 8 - across)) : left, t = bottom - top < up ? Math.max(8, Math.min(top, height - 8 - up)) : top;
  return { left: l, top: t, right: Math.max(right, l + across), bottom: Math.max(bottom, t + up) };
}

/** width, height: of the stage; text: the right edge of the text that stands on it, 0 where it stands above. page: the window; bare: nothing else stands
 * on the stage. */
export function placeOf(width: number, height: number, text: number, page: { readonly width: number; readonly height: number; readonly bare?: boolean }): Place {
  const landscape = page.height <= 480 && page.width > page.height && page.width >= 480;
  const mode: Mode = landscape ? 'landscape' : page.width < 768 ? 'phone' : page.width < 1280 ? 'tablet' : page.width < 1600 ? 'desk' : 'wide';
  // Text that leaves the motion too little, as a line across a low stage does, stands over it.
  const column = width - text - 66 >= LEAST ? text : 0;
  // left, top, and what is kept free at the right and below.
  const [left, top, right, below] = mode === 'phone' ? [24, height < 240 ? 24 : 8, 72, 34] : mode === 'landscape' ? (page.bare ? [24, 22, 66, 40] : [24, 66, 66, 28])
    : mode === 'tablet' ? [64, 14, 200, 40] : mode === 'desk' ? [column ? column + 9 : 64, 17, 186, 40] : [column ? column - 60 : 120, 17, 217, 44];
  const frame = wideEnough({ left, top, right: width - right, bottom: height - below }, { width, height });
  const small = mode === 'phone' || mode === 'landscape';
  return { mode, width, height, frame, text: column, scale: mode === 'wide' ? 1.2 : 1, names: !small, marker: small ? 3.6 : 4.6, ball: small ? 7.5 : mode === 'wide' ? 11 : 9 };
}
