/* Balls on one line, a family x[i] of places: each a disc below, and above them where it was, time upwards.
 *
 * Invariant: discs and lines share the axis across; a disc is as wide there as a ball is.
 */
import { timeName } from '../figure/name';
import { drawMarks, marksOf, partOf } from '../figure/marks';
import type { Ink, Pen } from '../figure/types';
import { greenName, type Motion, type Rows } from './motion';
import { drawNames, type Named } from './names';
import { wideEnough } from './place';
import { flatPlot } from './plot';
import { isDone, isOver, placeAt, valueAt } from './rows';
import { numbersOf } from './subject';
import type { Picture, Setting } from './types';

/** Pixels of a unit at most; between the axis and the balls. */
const UNIT = 120, GAP = 34;

export function ballsPicture({ scene, subject, place, bounds, before }: Setting, motion: Motion, diameter: string): Picture {
  const { lines, truth } = motion, cells = subject.bodies.flatMap((b) => b.columns), main = truth ?? lines[0]?.track ?? null, { frame, names } = place;
  const size = scene.description.parameters.find(({ name }) => name === diameter)?.values[0] ?? 1;
  const x = bounds[bounds.length - 1]!, low = x[0] - size / 2, high = x[1] + size / 2, times = main?.times ?? new Float64Array([0, 1]), [from, to] = [times[0]!, times[times.length - 1]!];
  const given = { left: frame.left + (names ? 52 : 18), top: frame.top + 24, right: names ? place.width - 210 * place.scale : frame.right + 40, bottom: frame.bottom };
  const unit = Math.min(UNIT, (given.right - given.left) / (high - low), 0.3 * (given.bottom - given.top) / size), room = unit * size + GAP * place.scale;
  const box = wideEnough({ ...given, right: given.left + unit * (high - low), bottom: given.bottom - room }, place);
  const plot = flatPlot({ bounds: [[low, high], [Math.min(from, to), Math.max(from, to) + 0.06 * Math.abs(to - from)]], box, equal: false, style: 'plane', axes: [{ name: subject.axes[1] ?? '', unit: '' }, { name: timeName(scene.solution), unit: '' }], solution: scene.solution, letters: place.scale });
  const along = plot.along!, up = plot.up!, radius = Math.abs(along(size) - along(0)) / 2, middle = plot.box.bottom + GAP * place.scale + radius;
  const line = (of: Rows, cell: number, upTo: number): Float64Array => {
    const way = Math.sign(to - from) || 1, rows = [...of.times.keys()].filter((i) => (of.times[i]! - upTo) * way <= 0), at = placeAt(of.times, upTo);
    return Float64Array.from([...rows.flatMap((i) => [along(of.columns[cell]![i]!), up(of.times[i]!)]), along(valueAt(of.columns[cell]!, at)), up(Math.abs(upTo - from) < Math.abs(of.times[of.times.length - 1]! - from) ? upTo : of.times[of.times.length - 1]!)]);
  };
  // A ball has part in an event that changes how it moves.
  const parts = cells.map((cell) => numbersOf(scene.solution, { columns: [cell] }));
  const rings = lines.map(({ track: { events } }) => cells.map((cell, k) => (events ? marksOf(events, (of, row) => [along(of[cell]![row]!), up(events.times[row]!)], partOf(events, parts, k)) : [])));
  const within = (pen: Pen, draw: () => void): void => pen.clip(plot.box.left - 1, plot.box.top - 6, plot.box.right - plot.box.left + 8, plot.box.bottom - plot.box.top + 12, draw);
  return {
    handle: null, end: null, leaving: [], remarks: () => [], over: (time) => [...lines.map(({ track }) => track), ...(truth ? [truth] : [])].every((of) => isDone(of.times, time)),
    still(pen, ink, finished = false) {
      plot.draw(pen, ink);
      before?.ghost(pen, ink);
      pen.line([plot.box.left, middle + radius + 1.5, plot.box.right, middle + radius + 1.5], { colour: ink.axis, width: 2.5 });
      if (main && !finished) within(pen, () => { for (const cell of cells) pen.line(line(main, cell, to), { colour: truth ? ink.exact : lines[0]!.look.colour, width: 3, alpha: 0.22 }); });
    },
    ghost(pen, ink) { if (main) within(pen, () => { for (const cell of cells) pen.line(line(main, cell, to), { colour: ink.exact, width: 1, alpha: 0.55 }); }); },
    moving(pen: Pen, ink: Ink, time: number) {
      const labels: Named[] = [], way = Math.sign(to - from) || 1;
      within(pen, () => {
        if (truth) for (const cell of cells) pen.line(line(truth, cell, time), { colour: ink.exact, width: 3 });
        for (let i = lines.length - 1; i >= 0; i--) {
          const { track, look } = lines[i]!;
          cells.forEach((cell, k) => {
            pen.line(line(track, cell, time), { colour: look.colour, width: 1.75, dash: look.dash });
            drawMarks(pen, ink, rings[i]![k]!.filter((mark) => (mark.time - time) * way <= 0), look);
          });
        }
      });
      const now = main && placeAt(main.times, time);
      if (main && now) for (const cell of cells) pen.mark('circle', along(valueAt(main.columns[cell]!, now)), middle, radius - 0.75, truth ? ink.exact : lines[0]!.look.colour);
      for (const { track, look } of lines) {
        if (isOver(track.times, time)) continue;
        const at = placeAt(track.times, time);
        for (const cell of cells) pen.mark(look.marker, along(valueAt(track.columns[cell]!, at)), middle, Math.min(place.ball, 0.4 * radius), look.colour, { rim: ink.surface });
      }
      const last = cells[cells.length - 1]!, put = (of: Rows, text: string, tone: string, colour: string, exact: boolean): void => { labels.push({ names: [{ text, colour: tone }], colour: tone, line: colour, x: along(valueAt(of.columns[last]!, placeAt(of.times, time))) + radius, y: middle, miss: null, exact }); };
      if (truth) put(truth, greenName(scene), ink.exact, ink.exact, true);
      for (const { track, look } of lines) if (!isOver(track.times, time)) put(track, look.label, look.tone, look.colour, false);
      drawNames(pen, ink, place, labels, { upright: false, right: place.width - 8, span: null, notes: [], all: labels.flatMap((l) => l.names.map(({ text }) => text)) });
    },
  };
}
