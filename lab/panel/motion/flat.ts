/* The backdrop of flat pictures: axes of the plane, or of a number against time with a rail on which its points slide. */
import type { Ink, Pen } from '../../figure/types';
import { axes } from '../../figure/axes';
import type { ViewBox } from './view_box';
import type { Projection } from './lines_view';

/* In a plane of places a metre is a metre both ways, unless that would make the picture a strip. */
const STRIP = 4;
const RAIL = 34;

export function scalesAgree(box: ViewBox): boolean {
  const width = box.ranges[0]![1] - box.ranges[0]![0], height = box.ranges[1]![1] - box.ranges[1]![0];
  return width <= STRIP * height && height <= STRIP * width;
}

export function planeBackdrop(names: readonly string[], equal: () => boolean) {
  return (pen: Pen, ink: Ink, box: ViewBox, top: number): Projection => {
    const [x, y] = [box.ranges[0]!, box.ranges[1]!];
    const frame = axes(pen, ink, { min: x[0], max: x[1], label: names[0] ?? 'x' }, { min: y[0], max: y[1], label: names[1] ?? 'y' },
      { equal: equal(), region: { left: 0, top, width: pen.width, height: pen.height - top } });
    return {
      x: a => frame.x(a), y: (_a, b) => frame.y(b), left: frame.left, top: frame.top, width: frame.width, height: frame.height, rail: null,
      remark: equal() ? '' : `scales of ${names[0]} and ${names[1]} differ`,
    };
  };
}

export function timeBackdrop(name: string) {
  return (pen: Pen, ink: Ink, box: ViewBox, top: number): Projection => {
    const [t, y] = [box.ranges[0]!, box.ranges[1]!];
    const frame = axes(pen, ink, { min: t[0], max: t[1], label: 't' }, { min: y[0], max: y[1], label: name },
      { region: { left: 0, top, width: pen.width - RAIL, height: pen.height - top } });
    return {
      x: a => frame.x(a), y: (_a, b) => frame.y(b), left: frame.left, top: frame.top, width: frame.width, height: frame.height,
      rail: frame.left + frame.width + RAIL - 6, remark: '',
    };
  };
}
