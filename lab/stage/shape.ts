/* A family x[i] at the present time: its shape, x over i, for each method; the shape at the start stays behind it.
 *
 * Invariant: the scale of the picture holds the whole motion, so that it does not breathe while the shape moves.
 */
import type { Ink, Pen } from '../figure/types';
import { greenName, type Motion, type Rows } from './motion';
import { drawNames, type Named } from './names';
import { wideEnough } from './place';
import { flatPlot } from './plot';
import { isOver, placeAt, valueAt } from './rows';
import type { Picture, Setting } from './types';

/** Beads can be told apart up to so many. */
const BEADS = 80;

export function shapePicture({ scene, subject, place, bounds, before }: Setting, motion: Motion): Picture {
  const { lines, truth } = motion, cells = subject.bodies.length === 1 ? subject.bodies[0]!.columns : subject.bodies.map((b) => b.columns[0]!);
  const number = cells.map((c, k) => Number(/\[(-?\d+)/.exec(scene.solution.columns[c] ?? '')?.[1] ?? k));
  const first = Math.min(...number), lastNumber = Math.max(...number), y = bounds[bounds.length - 1]!;
  const { frame, names } = place, plot = flatPlot({
    bounds: [[first - 1, lastNumber + 1], y], box: wideEnough({ left: frame.left + (names ? 52 : 18), top: frame.top + 24, right: names ? place.width - 210 * place.scale : frame.right + 40, bottom: frame.bottom }, place),
    equal: false, style: 'time', axes: [{ name: 'i', unit: '' }, { name: subject.axes[1] ?? '', unit: '' }], solution: scene.solution, letters: place.scale,
  });
  const xy = new Float64Array(2 * cells.length);
  function shape(of: Rows, time: number): Float64Array {
    const at = placeAt(of.times, time);
    cells.forEach((c, k) => {
      xy[2 * k] = plot.along!(number[k]!);
      xy[2 * k + 1] = Math.min(2e4, Math.max(-2e4, plot.up!(valueAt(of.columns[c]!, at))));
    });
    return xy;
  }
  const main = truth ?? lines[0]?.track, { box } = plot;
  const within = (pen: Pen, draw: () => void): void => pen.clip(box.left - 1, box.top - 6, box.right - box.left + 8, box.bottom - box.top + 12, draw);
  return {
    handle: null, end: null, leaving: [], remarks: () => [], over: () => false,
    still(pen, ink) {
      plot.draw(pen, ink);
      before?.ghost(pen, ink);
      if (main) within(pen, () => pen.line(shape(main, main.times[0] ?? 0), { colour: ink.quiet, width: 1, dash: [1, 4] }));
    },
    ghost(pen, ink) { if (main) within(pen, () => pen.line(shape(main, main.times[main.times.length - 1] ?? 0), { colour: ink.exact, width: 1.5, alpha: 0.4 })); },
    moving(pen: Pen, ink: Ink, time: number) {
      const labels: Named[] = [], right = plot.along!(lastNumber);
      within(pen, () => {
        if (truth) {
          pen.line(shape(truth, time), { colour: ink.exact, width: 4 });
          labels.push({ names: [{ text: greenName(scene), colour: ink.exact }], colour: ink.exact, line: ink.exact, x: right, y: xy[xy.length - 1]!, miss: null, exact: true });
        }
        for (let i = lines.length - 1; i >= 0; i--) {
          const { track, look } = lines[i]!;
          if (isOver(track.times, time)) continue;
          pen.line(shape(track, time), { colour: look.colour, width: 2, dash: look.dash });
          if (cells.length <= BEADS) for (let k = 0; k < cells.length; k++) pen.mark(look.marker, xy[2 * k]!, xy[2 * k + 1]!, 3.4, look.colour);
          labels.push({ names: [{ text: look.label, colour: look.tone }], colour: look.tone, line: look.colour, x: right, y: xy[xy.length - 1]!, miss: null, exact: false });
        }
      });
      drawNames(pen, ink, place, labels, { upright: false, right: place.width - 8, span: null, notes: [], all: labels.flatMap((l) => l.names.map(({ text }) => text)) });
    },
  };
}
