/* Draws nothing: for who needs the places of a picture and not the picture. */
import type { Pen } from '../../figure/types';

export function blankPen(width: number, height: number): Pen {
  const nothing = (): void => undefined;
  return { width, height, line: nothing, area: nothing, mark: nothing, arrow: nothing, text: nothing, box: nothing, cells: nothing, clip: (_x, _y, _w, _h, inside) => inside() };
}
