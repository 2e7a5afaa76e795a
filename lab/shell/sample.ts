/* The line of a method, as every picture draws it: colour, dash and marker. Invariant: the shapes are those of the figures' pen. */
import { svgPen } from '../figure/pen';
import type { Look } from '../scene';
import { el } from '../dom';

const width = 26, height = 14;

export function sample(look: Look): Element {
  const pen = svgPen(width, height);
  pen.line([1, height / 2, width - 1, height / 2], { colour: look.colour, width: 2, dash: look.dash });
  pen.mark(look.marker, width / 2, height / 2, 3.6, look.colour);
  const parsed = new DOMParser().parseFromString(pen.svg(), 'image/svg+xml').documentElement;
  const image = document.importNode(parsed, true);
  image.setAttribute('aria-hidden', 'true');
  image.setAttribute('class', 'sample');
  image.setAttribute('width', String(width));
  image.setAttribute('height', String(height));
  return image instanceof SVGElement ? image : el('span');
}
