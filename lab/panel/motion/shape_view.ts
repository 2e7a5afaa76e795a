/* A family x[i] at the present time: its shape, x over i, for each method; the shape at the start stays faintly behind it.
 *
 * Invariant: the scale of the picture holds the whole motion, so that it does not breathe while the shape moves.
 */
import type { Frame, Ink, Pen } from '../../figure/types';
import { axes } from '../../figure/axes';
import type { Motion, View } from './view';
import { drawNames } from './view';
import { isOver, placeAt, valueAt } from './rows';
import type { Cloud } from './view_box';
import { viewBox } from './view_box';
import { blankPen } from './blank_pen';

/* Beads can be told apart up to so many. */
const BEADS = 80;

type Rows = { readonly times: Float64Array; readonly columns: readonly Float64Array[] };

export function shapeView(motion: Motion): View {
  const { subject, lines, truth } = motion;
  const cells = subject.bodies[0]?.columns ?? [];
  const number = cells.map((c, k) => Number(/\[(-?\d+)/.exec(motion.scene.solution.columns[c] ?? '')?.[1] ?? k + 1));
  const first = number[0] ?? 1, last = number[number.length - 1] ?? 1;
  const cloud = (of: Rows): Cloud => [cells.map(c => of.columns[c] ?? new Float64Array(0))];
  const box = viewBox(truth ? cloud(truth) : null, lines.map(l => cloud(l.track)), 1);
  const place = { row: 0, part: 0 };
  const xy = new Float64Array(2 * cells.length);

  function shape(of: Rows, time: number, f: Frame): Float64Array {
    placeAt(of.times, time, place);
    cells.forEach((c, k) => {
      xy[2 * k] = f.x(number[k]!);
      xy[2 * k + 1] = Math.min(2e4, Math.max(-2e4, f.y(valueAt(of.columns[c] ?? xy, place))));
    });
    return xy;
  }

  function frame(pen: Pen, ink: Ink): Frame {
    const top = drawNames(pen, ink, motion);
    return axes(pen, ink, { min: first - 1, max: last + 1, label: 'i' }, { min: box.ranges[0]![0], max: box.ranges[0]![1], label: subject.axes[1] ?? '' },
      { region: { left: 0, top, width: pen.width, height: pen.height - top } });
  }
  const inside = (pen: Pen, f: Frame, draw: () => void): void => pen.clip(f.left, f.top - 1, f.width + 1, f.height + 2, draw);
  const frames = new Map<string, Frame>();
  const key = (pen: Pen): string => `${pen.width}x${pen.height}`;

  return {
    draw(pen, ink) {
      const f = frame(pen, ink), main = truth ?? lines[0]?.track;
      frames.set(key(pen), f);
      if (main) inside(pen, f, () => pen.line(shape(main, main.times[0] ?? 0, f), { colour: ink.quiet, width: 1, dash: [1, 4] }));
      if (main) pen.text(f.left + f.width - 8, f.top + 8, 'dotted: at the start', { colour: ink.quiet, size: 11, anchor: 'end', baseline: 'top' });
    },
    overlay(pen, ink, time) {
      let f = frames.get(key(pen));
      if (!f) {
        if (frames.size > 3) frames.clear();
        f = frame(blankPen(pen.width, pen.height), ink);
        frames.set(key(pen), f);
      }
      const at = f;
      inside(pen, at, () => {
        if (truth) pen.line(shape(truth, time, at), { colour: ink.exact, width: 5 });
        for (let i = lines.length - 1; i >= 0; i--) {
          const { track, look } = lines[i]!;
          if (isOver(track.times, time)) continue;
          pen.line(shape(track, time, at), { colour: look.colour, width: 1.75, dash: look.dash });
          if (cells.length <= BEADS) for (let k = 0; k < cells.length; k++) pen.mark(look.marker, xy[2 * k]!, xy[2 * k + 1]!, 3.2, look.colour);
        }
      });
    },
    remarks: () => lines.filter((_, i) => box.runaway[i]).map(l => `${l.look.label} leaves the picture`),
  };
}
