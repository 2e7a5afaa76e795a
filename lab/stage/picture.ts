/* The picture of a motion for one size of the stage: what keeps still, and what is drawn for a time.
 *
 * Invariant: pictures of the screen, of exports and of the build are drawn by these two functions, on whatever pen. What a time shows follows from the
 * scene and that time alone.
 */
import { extent, rangeOf } from '../figure/axes';
import { endSaid } from '../figure/ended';
import { shortLabel } from '../figure/ends';
import { drawMarks } from '../figure/marks';
import { brief } from '../figure/number';
import { textWidth } from '../figure/shapes';
import type { Ink, Pen } from '../figure/types';
import type { Look, Scene } from '../scene';
import { words } from '../words';
import { allOf, extentOf, join, roomy, suits, untilGround, type Bounds, type Range } from './bounds';
import { curvesOf, pointAt, type Curve, type Exit, type Point } from './curves';
import { bodyNames, drawBodies } from './bodies';
import { floor, person, rod, spring } from './decor';
import { freePlaces } from './free';
import { bodyOf, greenName, missAt, motionOf, type Line, type Motion, type Rows } from './motion';
import { briefly, drawNames, missText, type Named } from './names';
import { trail } from './path';
import { apart, wideEnough, type Box, type Place } from './place';
import { flatPlot, inside, spacePlot, type Axis, type Plot, type Way } from './plot';
import { isDone, isOver, placeAt, valueAt } from './rows';
import { ballsPicture } from './balls';
import { shapePicture } from './shape';
import type { Staging } from './staging';
import { subjects, velocityColumn, type Subject } from './subject';
import type { Handle, Leaving, Picture, Setting } from './types';

const TO_COME_EXACT = 0.22, TO_COME = 0.25, STROBE = 0.16, EXACT_WIDTH = 4, WIDTH = 2;
const LIVE_MARKS = 400, STEPS_SEEN = 40, WALL = 180;

/** Which other plot stands beside a number against time. */
export type Side = 'phase' | 'rod' | '';
const ANGLES = new Set(['theta', 'phi', 'alpha', 'varphi', 'θ', 'φ', 'ϑ']);
export function sideOf(scene: Scene, subject: Subject, staging: Staging, place: Place): Side {
  if (subject.kind !== 'time' || !place.names || place.frame.right - place.frame.left < 600) return '';
  const positions = scene.description.variables.reduce((sum, v) => sum + (v.order === 2 ? v.count * Math.max(1, v.components) : 0), 0);
  if (positions !== 1) return '';
  if (staging.decor === 'pendulum' || ANGLES.has(subject.axes[1] ?? '')) return 'rod';
  return scene.description.time_dependent || velocityColumn(scene.solution, subject.bodies[0]!.columns[0]!) < 0 ? '' : 'phase';
}

const axisOf = (name: string, unit = ''): Axis => ({ name, unit });

/** The bounds that a scene begins with, and whether an old frame still serves it. all: every method is to be seen. */
export function boundsFor(scene: Scene, subject: Subject, staging: Staging, all: boolean, old: Bounds | null): Bounds {
  const motion = motionOf(scene, subject), time = subject.kind === 'time';
  if (all) return allOf(motion);
  const ground = staging.decor === 'throw', { ranges } = extentOf(motion, ground);
  if (old && old.length === ranges.length && suits(old, ranges, time, subject.kind === 'plane')) return old;
  const own = staging.frame && [time ? ranges[0]! : staging.frame.x ?? ranges[0]!, staging.frame.y];
  if (own && suits(own, ranges, time, !time)) return own;
  const wide = roomy(ranges, time);
  // Whoever throws stands on the ground, which is part of the picture; below it nothing is shown.
  return ground && !time ? [wide[0]!, ranges[1]![0] >= 0 ? [0, wide[1]![1]] : join(wide[1]!, [0, 0])] : wide;
}

/** In a plane of places a metre is a metre both ways, unless that would make the picture a strip. */
function equalFor(subject: Subject, staging: Staging, bounds: Bounds): boolean {
  if (subject.kind !== 'plane' || subject.unlike) return false;
  const [w, h] = bounds.map(([low, high]) => high - low) as [number, number];
  return staging.equal ?? (w <= 4 * h && h <= 4 * w);
}

function plotsOf({ scene, subject, staging, place, bounds, camera }: Setting, side: Side): Plot[] {
  const { scale: letters } = place, { solution } = scene, units = staging.units;
  // The ground of a throw runs on below the words; nothing else does.
  const ground = staging.decor === 'throw' && subject.kind === 'plane', frame = ground ? place.frame : wideEnough({ ...place.frame, left: Math.max(place.frame.left, place.text + 9) }, place);
  if (subject.kind === 'space') return [spacePlot(bounds, frame, camera, subject.axes.map((name) => axisOf(name)), letters)];
  const common = { solution, letters, fine: place.fine, edge: place.text && place.text + 2 };
  if (subject.kind === 'time') {
    const small = !place.names, left = frame.left + (side && staging.decor === 'spring' ? 99 : small ? 18 : 52), top = frame.top + 24;
    const whole: Box = { left, top, right: small ? frame.right : place.width - 240 * letters, bottom: frame.bottom };
    const axes = [axisOf(subject.axes[0] ?? '', units?.t), axisOf(subject.axes[1] ?? '', '')] as const;
    if (!side) return [flatPlot({ ...common, bounds, box: wideEnough(whole, place), equal: false, style: 'time', axes })];
    const right = place.width - 37 * letters, width = Math.min(0.4 * (right - left), 1.05 * (frame.bottom - top), side === 'rod' ? 220 * letters : Infinity), from = right - width;
    const main = flatPlot({ ...common, bounds, box: { ...whole, right: from - (side === 'rod' ? 150 : 116) * letters }, equal: false, style: 'time', axes });
    if (side === 'rod') return [main];
    const y = bounds[1]!, box = { left: from, top, right, bottom: frame.bottom }, unit = (box.bottom - top) / (y[1] - y[0]);
    const fastest = velocityRange(scene, subject), need = 1.12 * Math.max(Math.abs(fastest[0]), Math.abs(fastest[1]), 1e-300), same = width / 2 / unit;
    const half = same >= need / 1.1 && same <= 2.2 * need ? same : need;
    const name = solution.columns[velocityColumn(solution, subject.bodies[0]!.columns[0]!)] ?? '';
    return [main, flatPlot({ ...common, bounds: [[-half, half], y], box, equal: false, style: 'phase', axes: [axisOf(name), axisOf('')] })];
  }
  const equal = equalFor(subject, staging, bounds);
  const axes = [axisOf(subject.axes[0] ?? 'x', units?.x), axisOf(subject.axes[1] ?? 'y', units?.x)] as const;
  // Misses beside an upright path need room for their words, and names beside a path that fills the frame.
  const small = !place.names, right = small ? frame.right : frame.right - (staging.upright ? 110 : subject.unlike ? 64 * letters : 0);
  const box = ground ? frame : { left: frame.left + (small ? 14 : 44), top: frame.top + 22, right, bottom: frame.bottom - (small ? 4 : 8) };
  return [flatPlot({ ...common, bounds, box: ground ? box : wideEnough(box, place), equal, style: ground ? 'ground' : 'plane', axes })];
}
function velocityRange(scene: Scene, subject: Subject): Range {
  const column = velocityColumn(scene.solution, subject.bodies[0]!.columns[0]!), { truth } = scene.solution;
  const of = truth?.columns[column]?.length ? truth.columns[column] : scene.solution.tracks[0]?.columns[column];
  let low = 0, high = 0;
  for (const v of of ?? []) { if (v < low) low = v; if (v > high && v < Infinity) high = v; }
  return [low, high];
}

export function pictureOf(setting: Setting): Picture {
  const { scene, subject, staging, place, bounds, before } = setting;
  const motion = motionOf(scene, subject), { lines, truth } = motion;
  if (subject.kind === 'shape' && staging.balls) return ballsPicture(setting, motion, staging.balls);
  if (subject.kind === 'shape') return shapePicture(setting, motion);
  const side = sideOf(scene, subject, staging, place), plots = plotsOf(setting, side), main = plots[0]!;
  const drawn = plots.map((plot) => ({ plot, curves: curvesOf(motion, plot) })), { curves } = drawn[0]!;
  const other = setting.pinned && motionOf(setting.pinned, subjects(setting.pinned.description, setting.pinned.solution).find((s) => s.id === subject.id) ?? subject);
  const pinned = other ? plots.map((plot) => ({ plot, motion: other, curves: curvesOf(other, plot) })) : [];
  const springX = Math.max(place.frame.left, place.text + 9) + 39;
  const single = subject.bodies.length === 1, flat = main.up !== null;
  const upright = single && flat && (staging.upright === true || (subject.kind === 'time' && side === ''));
  const exactName = greenName(scene);
  const clipped = (pen: Pen, plot: Plot, draw: () => void): void => pen.clip(plot.box.left - 1, plot.box.top - 6, plot.box.right - plot.box.left + 8, plot.box.bottom - plot.box.top + 8, draw);
  const nowhere = new Set(lines.map((_, i) => i).filter((i) => curves.same[i] === -1));

  /** The points of a line where all methods and the exact motion are at a step, lowest and highest: a rung of the ladder. */
  function ladder(pen: Pen, ink: Ink, upTo: number): void {
    const first = lines[0]?.track;
    if (!staging.upright || !single || !truth || !first || first.every !== 1 || first.times.length > STEPS_SEEN * 2 || lines.length < 2) return;
    const at: Point = { x: 0, y: 0 };
    let last = -Infinity;
    for (let i = 1; i < first.times.length - 1 && first.times[i]! <= upTo; i++) {
      let low = Infinity, high = -Infinity, x = 0;
      pointAt(curves.exact[0]!.way, truth.times, first.times[i]!, at);
      low = high = at.y;
      for (const [curve] of curves.methods) {
        if (!curve || curve.times[i] !== first.times[i]) continue;
        low = Math.min(low, curve.way.y(i)); high = Math.max(high, curve.way.y(i));
        x = curve.way.x(i);
        if (Math.abs(x - at.x) > 2) return;
      }
      if (at.x - last < SPACING_LADDER || high - low < 3) continue;
      last = at.x;
      pen.line([at.x, low, at.x, high], { colour: ink.ghost, width: 1 });
    }
  }
  function strobe(pen: Pen, ink: Ink, upTo: number): void {
    const first = lines[0]?.track;
    if (!single || !truth || !first || first.every !== 1 || first.times.length > STEPS_SEEN + 2 || subject.kind !== 'plane') return;
    const at: Point = { x: 0, y: 0 };
    for (let i = 1; i < first.times.length - 1 && first.times[i]! <= upTo; i++) {
      pointAt(curves.exact[0]!.way, truth.times, first.times[i]!, at);
      pen.mark('circle', at.x, at.y, place.ball + 0.5, ink.exact, { alpha: STROBE });
    }
  }
  function marks(pen: Pen, ink: Ink, curve: Curve, upTo: number, plot: Plot): void {
    for (const i of curve.marks) {
      if (i > upTo) break;
      if (i === 0 && curve.marks.length > 12) continue;
      const x = curve.way.x(i), y = curve.way.y(i);
      if (!inside(plot.box, x, y, 4) || (curve.exit && i >= curve.exit.row)) continue;
      pen.mark(curve.line.look.marker, x, y, place.marker, curve.line.look.colour, { rim: ink.surface });
    }
  }
  function arrowhead(pen: Pen, curve: Curve, exit: Exit): void {
    const { dx, dy } = exit, s = 9, x = exit.x - 2 * dx, y = exit.y - 2 * dy;
    pen.line([x - s * dx + 0.6 * s * dy, y - s * dy - 0.6 * s * dx, x, y, x - s * dx - 0.6 * s * dy, y - s * dy + 0.6 * s * dx], { colour: curve.line.look.colour, width: 2 });
  }
  function arrow(): Handle | null {
    if (!single || subject.kind !== 'plane' || !flat) return null;
    const from = truth ?? lines[0]?.track, body = subject.bodies[0]!;
    if (!from) return null;
    const at = { x: (truth ? curves.exact[0]! : curves.methods[0]![0]!).way.x(0), y: (truth ? curves.exact[0]! : curves.methods[0]![0]!).way.y(0) };
    const v = body.columns.map((c) => { const k = velocityColumn(scene.solution, c); return scene.solution.tracks[0]?.columns[k]?.[0] ?? truth?.columns[k]?.[0] ?? NaN; });
    const speed = Math.hypot(...v);
    let unit = main.unit !== null && staging.arrow ? staging.arrow * main.unit : 0.22 * Math.min(place.width, place.height) / speed;
    // The ring stays on the stage.
    if (at.y - unit * v[1]! < 24 && v[1]! > 0) unit = Math.max(0, at.y - 24) / v[1]!;
    if (at.x + unit * v[0]! > place.width - 24 && v[0]! > 0) unit = Math.max(0, place.width - 24 - at.x) / v[0]!;
    if (at.x + unit * v[0]! < place.text + 32 && v[0]! < 0) unit = Math.max(0, at.x - place.text - 32) / -v[0]!;
    // … and above the numbers below the picture.
    const foot = main.up!(bounds[1]![0]) - 12, least = 40 / -v[1]!;
    if (!staging.arrow && v[1]! < 0 && at.y - unit * v[1]! > foot) unit = Math.max(Math.min(unit, least), (foot - at.y) / -v[1]!);
    if (!(unit * speed > 16) || !(speed > 0) || !Number.isFinite(unit)) return null;
    return { x: at.x + unit * v[0]!, y: at.y - unit * v[1]!, fromX: at.x, fromY: at.y, unit };
  }
  const handle = arrow();
  function drawArrow(pen: Pen, ink: Ink): void {
    if (!handle) return;
    const { x, y, fromX, fromY } = handle, r = place.names ? 6.5 : 5, speed = Math.hypot(x - fromX, y - fromY) / handle.unit, letters = place.scale;
    pen.line([fromX, fromY, x, y], { colour: ink.quiet, width: 1.5 });
    for (const [px, py, radius] of [[x, y, r], [fromX, fromY, r - 1.5]] as const) {
      pen.mark('circle', px, py, radius + 1, ink.text);
      pen.mark('circle', px, py, radius - 1, ink.surface);
    }
    if (!place.names) return;
    const { at, anchor } = aimed ??= besideAim(handle, speedText(speed));
    pen.text(at.x, at.y - 2, [{ text: 'v', italic: true, size: 15 * letters }, { text: '0', size: 10.5 * letters, sunk: 3 }], { colour: ink.text, anchor, halo: ink.surface });
    pen.text(at.x, at.y + 15 * letters, speedText(speed), { colour: ink.quiet, size: 12 * letters, anchor, halo: ink.surface });
  }
  const speedText = (speed: number): string => `${brief(speed, 3)}${staging.units ? `\u2009${staging.units.v}` : ''}`;
  interface Aimed { readonly at: Point; readonly anchor: 'start' | 'middle' | 'end' }
  let aimed: Aimed | null = null;
  /** Where the velocity is told: behind the ring, before it, beyond it, whichever covers least of the curves and of where names stand. */
  function besideAim({ x, y, fromX, fromY }: Handle, text: string): Aimed {
    const way = x >= fromX ? -1 : 1, side = (of: number): Aimed => ({ at: { x: x + of * 14, y }, anchor: of < 0 ? 'end' : 'start' }), letters = place.scale, wide = textWidth(text, 12 * letters);
    if (staging.arrow) return side(way);
    const beyond: Aimed = { at: { x, y: y < fromY ? y - 28 * letters : y + 24 * letters }, anchor: 'middle' }, all = [side(way), side(-way), beyond];
    const boxes = all.map(({ at, anchor }): Box => {
      const left = anchor === 'end' ? at.x - wide : anchor === 'middle' ? at.x - wide / 2 : at.x, right = left + wide;
      return { left, right, top: at.y - 14 * letters, bottom: at.y + 16 * letters };
    });
    return all[boxes.indexOf(freest(boxes))]!;
  }
  /** The first of the places that cover least of the curves, of the numbers and of where names stand. */
  function freest(places: readonly Box[]): Box {
    occupy();
    const column = names.span && place.names ? names.span[1] + 12 : Infinity, cost = (b: Box): number => free.covered(b) + Math.max(0, b.right - Math.max(b.left, column)) / 3;
    return places.reduce((best, b) => (cost(b) < cost(best) ? b : best));
  }

  /** Against time: where it is drawn. */
  const area = subject.kind === 'time' && main.along ? { left: main.box.left, top: main.box.top, width: main.box.right - main.box.left, height: main.box.bottom - main.box.top, x: main.along } : null;
  /** A method's line with its dashes; against time it is dotted where no digit is known. */
  function split(pen: Pen, plot: Plot, { line: { look }, band }: Curve, line: (dash: readonly number[]) => void): void {
    const draw = (of: Look): void => line(band && of.dash === look.dash ? [] : of.dash);
    if (area && plot === main && setting.bars) setting.bars.split(pen, area, look, draw); else draw(look);
  }

  function still(pen: Pen, ink: Ink, finished = false): void {
    if (staging.decor === 'throw' && main.up && main.along && main.unit && main.unit >= 30 && truth) {
      const last = truth.times.length - 1, { way } = curves.exact[0]!, ground = main.up(0);
      person(pen, ink, way.x(0), way.y(0), ground, main.unit, 1);
      if (way.y(last) < ground - 1.2 * main.unit && way.y(last) > ground - 2.4 * main.unit) person(pen, ink, way.x(last), way.y(last), ground, main.unit, -1);
    }
    for (const { plot } of drawn) plot.draw(pen, ink);
    if (subject.kind === 'plane' && main.along && main.up) for (const [x, y, radius, name] of staging.rests ?? []) {
      const px = main.along(x), py = main.up(y), r = radius * (place.names ? 1 : 0.7);
      pen.mark('circle', px, py, r, ink.axis, { rim: ink.surface });
      const text = words.stage.bodies[name], size = 12 * place.scale, wide = textWidth(text, size);
      const at = freest([[-1, 1], [1, 1], [-1, -1], [1, -1]].map(([across, down]) => {
        const left = px + across! * (r + 4) - (across! < 0 ? wide : 0), y = py + down! * (r + 10) + (down! < 0 ? size / 2 : 0);
        return { left, right: left + wide, top: y - 0.8 * size, bottom: y };
      }));
      pen.text(at.left, at.bottom, text, { colour: ink.quiet, size, halo: ink.surface });
    }
    const { along, up } = main;
    if (staging.decor === 'floor' && up) for (const { plot } of drawn) if (inside(plot.box, plot.box.left, up(0), 1)) floor(pen, ink, plot.box.left, plot.box.right, up(0));
    if (subject.kind === 'plane' && along && up) for (const [x, y, radius] of staging.walls ?? []) pen.line(Float64Array.from({ length: 2 * WALL + 2 }, (_, k) => (k % 2 ? up(y + radius * Math.sin(Math.PI * (k >> 1) * 2 / WALL)) : along(x + radius * Math.cos(Math.PI * (k >> 1) * 2 / WALL)))), { colour: ink.axis, width: 2.5 });
    if (subject.kind === 'time' && along && up) clipped(pen, main, () => {
      for (const { look } of lines) for (const { columns } of subject.bodies) setting.bars?.draw(pen, { x: along, y: up, top: main.box.top, height: main.box.bottom - main.box.top }, look, scene.solution.columns[columns[0]!] ?? '');
    });
    if (area) setting.bars?.note(pen, ink, area, lines.map(({ look }) => look));
    before?.ghost(pen, ink);
    drawPinned(pen, ink);
    if (finished) return;
    for (const { plot, curves: own } of drawn) {
      clipped(pen, plot, () => {
        for (const { path } of own.exact) pen.line(path.xy, { colour: ink.exact, width: EXACT_WIDTH, alpha: TO_COME_EXACT }, 2 * path.count);
        own.methods.forEach((of, i) => {
          if (nowhere.has(i)) return;
          for (const c of of) split(pen, plot, c, (dash) => pen.line(c.path.xy, { colour: c.line.look.colour, width: WIDTH, dash, alpha: TO_COME }, 2 * c.path.count));
        });
      });
    }
  }
  /** The run A: its methods in full, but thin, each with its letter. */
  function drawPinned(pen: Pen, ink: Ink): void {
    for (const { plot, motion: { truth: exact }, curves: own } of pinned) {
      clipped(pen, plot, () => {
        for (const { path } of own.exact) pen.line(path.xy, { colour: ink.exact, width: 1.5, alpha: 0.5 }, 2 * path.count);
        own.methods.forEach((of, i) => {
          for (const c of of) if (own.same[i] !== -1) pen.line(c.path.xy, { colour: c.line.look.colour, width: 1.25, alpha: 0.6 }, 2 * c.path.count);
        });
      });
      if (plot !== main) continue;
      const ends = [...own.methods.flatMap((of, i) => (own.same[i] === i ? of.map((c) => ({ c, colour: c.line.look.tone, times: c.times })) : [])).map(({ c, colour, times }) => ({ x: c.way.x(times.length - 1), y: c.way.y(times.length - 1), colour })),
        ...(exact ? own.exact.map(({ way }) => ({ x: way.x(exact.times.length - 1), y: way.y(exact.times.length - 1), colour: ink.exact })) : [])];
      for (const { x, y, colour } of ends) if (inside(plot.box, x, y, 2)) pen.text(x - 10, y - 8, 'A', { colour, size: 13, bold: true, anchor: 'end', halo: ink.surface });
    }
  }
  /** Thin, since it is drawn anew in each frame of a drag: a line of one pixel costs a tenth of a wider one. */
  function ghost(pen: Pen, ink: Ink): void {
    for (const { plot, curves: own } of drawn) {
      clipped(pen, plot, () => {
        for (const { path } of own.exact) pen.line(path.xy, { colour: ink.exact, width: 1, alpha: 0.55 }, 2 * path.count);
        own.methods.forEach((of, i) => { if (!nowhere.has(i)) for (const c of of) pen.line(c.path.xy, { colour: c.line.look.colour, width: 1, alpha: 0.55 }, 2 * c.path.count); });
      });
    }
  }

  /** A path reaches from here to there, as far as it is seen, with the numbers beside it. */
  function spanOf(): readonly [number, number] | null {
    if (subject.kind === 'time') return null;
    const { left, right } = main.box, [low, high] = rangeOf((truth ? curves.exact : curves.methods.map((of) => of[0]!)).map(({ path }) => path.xy.subarray(0, 2 * path.count).filter((_, i) => i % 2 === 0)));
    return high >= low ? [Math.min(Math.max(left, low), main.numbers ?? Infinity), Math.min(right, high)] : null;
  }
  const names = { span: spanOf(), all: [exactName, ...lines.map((l) => shortLabel(l.look.label))] };

  const present: Point = { x: 0, y: 0 };
  const last = (line: Line): number => line.track.times[line.track.times.length - 1] ?? NaN;
  const gone = (curve: Curve, time: number): boolean => (curve.exit !== null && time >= curve.exit.time) || isOver(curve.line.track.times, time);

  /** Between which points it is told how far a line is from the exact motion; null: of all bodies, whose distances the picture may shorten, or of numbers that have no common unit. */
  const between = single && flat && !subject.unlike ? (upright || subject.kind === 'time' ? subject.bodies[0]!.columns.slice(-1) : subject.bodies[0]!.columns) : null;
  function miss(line: Line, time: number): Named['miss'] {
    const far = truth && missAt(scene, line, time, between), of = scene.solution.errors[line.index];
    if (!far || !of || !Number.isFinite(far.size)) return null;
    const frame = bounds[subject.kind === 'time' ? 1 : 0]!, size = frame[1] - frame[0], unit = staging.units && single ? `\u2009${staging.units.x}` : '', body = single ? '' : bodyOf(of, far.body, staging.bodies);
    if (far.size <= 1e-12 * size) return { size: 0, text: words.stage.miss.none, how: '' };
    return { size: far.size, text: `${missText(far.size, flat && upright ? bounds[1]![1] - bounds[1]![0] : size)}${unit}`, how: upright ? (far.up > 0 ? words.stage.miss.high : words.stage.miss.low) : body ? words.stage.miss.offOf(body) : words.stage.miss.off };
  }

  /** Of the time. */
  const way = Math.sign((lines[0]?.track.times.at(-1) ?? 1) - (lines[0]?.track.times[0] ?? 0)) || 1;

  function moving(pen: Pen, ink: Ink, time: number): void {
    clipped(pen, main, () => { ladder(pen, ink, time); strobe(pen, ink, time); });
    for (const { plot, curves: own } of drawn) {
      clipped(pen, plot, () => {
        if (truth) {
          own.exact.forEach(({ path, way }) => {
            const { row, part } = placeAt(truth.times, time);
            pointAt(way, truth.times, time, present);
            const so = trail(path, part === 1 ? row + 1 : row, present.x, present.y);
            pen.line(so.xy, { colour: ink.exact, width: EXACT_WIDTH }, so.count);
          });
        }
        let live = 0;
        for (const of of own.methods) for (const c of of) live += c.marks.length;
        for (let i = own.methods.length - 1; i >= 0; i--) {
          for (const c of own.methods[i]!) {
            const { times } = c, at = placeAt(times, time), over = c.exit !== null && at.row >= c.exit.row;
            const row = over ? c.exit!.row : at.part === 1 ? at.row + 1 : at.row;
            if (over) { present.x = c.way.x(c.exit!.row); present.y = c.way.y(c.exit!.row); } else pointAt(c.way, times, time, present);
            if (!nowhere.has(i)) {
              const so = trail(c.path, row, present.x, present.y);
              split(pen, plot, c, (dash) => pen.line(so.xy, { colour: c.line.look.colour, width: WIDTH, dash }, so.count));
            }
            if (live <= LIVE_MARKS) marks(pen, ink, c, row, plot);
          }
        }
      });
      own.methods.forEach((of, i) => { if (!nowhere.has(i)) for (const c of of) if (c.exit && time >= c.exit.time) arrowhead(pen, c, c.exit); });
      clipped(pen, plot, () => { for (const of of own.methods) for (const c of of) drawMarks(pen, ink, c.events.filter((mark) => (mark.time - (c.times[0] ?? 0)) * way <= (time - (c.times[0] ?? 0)) * way && !(c.exit && (mark.time - c.exit.time) * way > 0)), c.line.look); });
    }
    drawArrow(pen, ink);
    rods(pen, ink, time);
    const labels = balls(pen, ink, time);
    const farthest = Math.max(...labels.map((l) => l.x), -Infinity);
    const right = drawn.length > 1 ? drawn[1]!.plot.box.left - 8 : place.width - (place.names ? 8 : 2);
    const letters = drawNames(pen, ink, place, labels, { upright, right: Math.max(right, farthest + 20), span: names.span, all: names.all, notes: written(time) });
    if (called.length) nameBodies(pen, ink, time, [...letters, ...written(time)]);
    if (!place.names) atCurves(pen, ink, time);
    leavers(pen, ink, time);
    drawLanding(pen, ink, time);
    beside(pen, ink, time);
  }

  /** From the origin to one place after the other, those of the exact motion or of the first method. */
  function rods(pen: Pen, ink: Ink, time: number): void {
    if (!staging.rods || subject.kind !== 'plane' || !main.along || !main.up) return;
    const indices = staging.rods.map((pair) => pair.map((name) => scene.solution.columns.indexOf(name))), of = truth && indices.flat().every((k) => truth.columns[k]?.length) ? truth : lines[0]?.track;
    if (!of || indices.flat().some((k) => k < 0)) return;
    const at = placeAt(of.times, time), value = (k: number): number => valueAt(of.columns[k]!, at);
    const xy = [main.along(0), main.up(0), ...indices.flatMap(([x, y]) => [main.along!(value(x!)), main.up!(value(y!))])];
    pen.line(xy, { colour: ink.quiet, width: 2 });
    for (let k = 0; k + 3 < xy.length; k += 2) pen.mark('circle', xy[k]!, xy[k + 1]!, k ? 6 : 4, ink.quiet, { rim: ink.surface });
  }

  const called = bodyNames(subject, staging);
  /** Beside the exact motion's bodies; without one, beside the first method's. */
  function nameBodies(pen: Pen, ink: Ink, time: number, letters: readonly Box[]): void {
    const seen = (way: Way, times: ArrayLike<number>): Point | null => {
      const at = pointAt(way, times, time);
      return Number.isFinite(at.x + at.y) && inside(main.box, at.x, at.y, 8) ? at : null;
    };
    const methods = curves.methods.flatMap((of, i) => (nowhere.has(i) ? [] : of.map((c) => (gone(c, time) ? null : seen(c.way, c.times)))));
    const exact = truth ? curves.exact.map(({ way }) => seen(way, truth.times)) : [];
    drawBodies(pen, ink, place, called, truth ? exact : methods.slice(0, called.length), [...exact, ...methods].filter((p) => p !== null), letters);
  }
  /** Where everybody is now; answers the labels that belong there. */
  function balls(pen: Pen, ink: Ink, time: number): Named[] {
    const labels: Named[] = [], groups = new Map<number, Line[]>();
    lines.forEach((line, i) => { const k = curves.same[i]!; groups.set(k, [...(groups.get(k) ?? []), line]); });
    const exactPoint: Point = { x: NaN, y: NaN };
    if (truth) pointAt(curves.exact[0]!.way, truth.times, time, exactPoint);
    for (const { plot, curves: own } of drawn) {
      // Methods first, as the exact motion's ball is larger; those that are on it stand on top.
      own.methods.forEach((of, i) => {
        if (nowhere.has(i)) return;
        for (const c of of) {
          if (gone(c, time)) continue;
          pointAt(c.way, c.times, time, present);
          if (!inside(plot.box, present.x, present.y, 8)) continue;
          const r = (single ? place.ball : place.ball * 0.62) * (c.line.look.marker === 'circle' ? 1 : 0.86);
          pen.mark(c.line.look.marker, present.x, present.y, r, c.line.look.colour, { rim: ink.surface });
        }
      });
      if (truth) own.exact.forEach(({ way }, body) => {
        pointAt(way, truth.times, time, present);
        if (!inside(plot.box, present.x, present.y, 8)) return;
        const r = single ? place.ball + 1 : place.ball * 0.8;
        pen.mark('circle', present.x, present.y, r, ink.exact, { rim: ink.surface });
        for (const i of nowhere) {
          const c = own.methods[i]![body]!;
          if (isOver(c.line.track.times, time)) continue;
          pen.mark(c.line.look.marker, present.x, present.y, 0.5 * r, c.line.look.colour, { rim: ink.surface });
        }
      });
    }
    if (drawn.length > 1 && truth) {
      const other = pointAt(drawn[1]!.curves.exact[0]!.way, truth.times, time);
      pen.line([staging.decor === 'spring' ? springX + 13 : exactPoint.x, exactPoint.y, other.x, exactPoint.y], { colour: ink.exact, width: 1, dash: [2, 3], alpha: 0.6 });
    }
    if (truth && !(landing && time > landing.time)) {
      const joined = groups.get(-1) ?? [];
      labels.push({
        names: [{ text: exactName, colour: ink.exact }, ...joined.map((l) => ({ text: shortLabel(l.look.label), colour: l.look.tone }))], colour: ink.exact, line: ink.exact,
        ...exactPoint, miss: null, exact: true,
      });
    }
    for (const [k, own] of groups) {
      if (k < 0) continue;
      const curve = curves.methods[k]![0]!;
      if (gone(curve, time)) continue;
      const at = pointAt(curve.way, curve.times, time);
      if (!Number.isFinite(at.x + at.y) || !inside(main.box, at.x, at.y, 8)) continue;
      labels.push({
        names: own.map((l) => ({ text: shortLabel(l.look.label), colour: l.look.tone })), colour: own[0]!.look.tone, line: own[0]!.look.colour, ...at,
        miss: miss(own[0]!, time), exact: false,
      });
    }
    return labels.length > 14 ? labels.slice(0, 14) : labels;
  }

  const nameBoxes = new Map<number, Box>();
  /** On a small stage: names where a curve is farthest from the exact one, outside of it. */
  function atCurves(pen: Pen, ink: Ink, time: number): void {
    if (!truth || !single || lines.length > 5) return;
    const taken: Box[] = written(time);
    curves.methods.forEach((of, i) => {
      const c = of[0]!;
      if (nowhere.has(i) || curves.same[i] !== i || c.exit) return;
      const { times } = c, n = times.length, at: Point = { x: 0, y: 0 };
      if (time < last(c.line) && time > (times[0] ?? 0)) return;
      let best = -1, most = 6;
      for (let row = Math.floor(n * 0.3); row < n * 0.62; row++) {
        pointAt(curves.exact[0]!.way, truth.times, times[row]!, at);
        // The middle of the curve is better than its end, where numbers stand.
        const d = Math.abs(c.way.y(row) - at.y) * (1 - Math.abs(row / n - 0.5));
        if (d > most && inside(main.box, c.way.x(row), c.way.y(row), -20)) { most = d; best = row; }
      }
      if (best < 0) return;
      pointAt(curves.exact[0]!.way, truth.times, times[best]!, at);
      const above = c.way.y(best) < at.y, x = c.way.x(best), half = 3.9 * shortLabel(c.line.look.label).length;
      // Clear of its own curve over the whole width of the letters.
      let y = c.way.y(best);
      for (let row = 0; row < n; row++) if (Math.abs(c.way.x(row) - x) < half + 12) y = above ? Math.min(y, c.way.y(row)) : Math.max(y, Math.min(c.way.y(row), c.way.y(best) + 20));
      y += above ? -12 : 18;
      const name = { text: c.line.look.label, letters: { colour: c.line.look.tone, size: 13, bold: true, halo: ink.surface } };
      // Where the curve lies among others: in the free place that is nearest. The build's picture follows the size of its stage, so its places are not looked for.
      if (staging.decor !== 'throw') {
        const box = nameBoxes.get(i) ?? put(x - half, y - 12, textWidth(name.text, 13) * 1.06, 15);
        nameBoxes.set(i, box);
        pen.text(box.left, box.top + 12, name.text, name.letters);
        return;
      }
      const box = { left: x - half, right: x + half, top: y - 12, bottom: y + 3 };
      if (!taken.every((t) => apart(t, box))) return;
      taken.push(box);
      pen.text(Math.max(half + 4, Math.min(place.width - half - 4, x)), y, name.text, { ...name.letters, anchor: 'middle' });
    });
  }

  /** When and where the exact motion comes down to the ground that is drawn. */
  const landing = ((): (Point & { readonly time: number }) | null => {
    if (staging.decor !== 'throw' || subject.kind !== 'plane' || !truth || !main.up || !(bounds[1]![0] >= 0)) return null;
    const { at } = untilGround(truth, subject.bodies[0]!.columns[1]!);
    return at === null ? null : { time: at, ...pointAt(curves.exact[0]!.way, truth.times, at) };
  })();
  const seconds = (time: number): string => `${brief(time, 3)}${staging.units ? `\u2009${staging.units.t}` : ''}`;
  const leaving: Leaving[] = [], leaveSize = (place.names ? 14 : 12) * place.scale;
  /** What is written where a motion comes to the ground or leaves the picture, and from when on. */
  const notes: { readonly box: Box; readonly time: number }[] = [], { frame } = place;
  const free = freePlaces({
    left: place.text + 4, right: drawn.length > 1 ? drawn[1]!.plot.box.left - 8 : side === 'rod' ? main.box.right + 100 * place.scale : place.width - 4,
    top: Math.max(0, frame.top - 8), bottom: Math.min(main.box.bottom, place.height) - 4,
  });
  /** Puts something down and answers where. */
  function put(left: number, top: number, width: number, height: number): Box {
    occupy();
    const at = free.put(left - CLEAR, top - CLEAR, width + 2 * CLEAR, height + 2 * CLEAR);
    return { left: at.left + CLEAR, right: at.left + CLEAR + width, top: at.top + CLEAR, bottom: at.top + CLEAR + height };
  }
  function note(left: number, top: number, width: number, height: number, time: number): Box {
    const box = put(left, top, width, height);
    notes.push({ box, time });
    return box;
  }
  /** All curves, and the names and numbers where those end that stay. */
  let occupied = false;
  function occupy(): void {
    if (occupied) return;
    occupied = true;
    for (const { path } of curves.exact) free.line(path.xy, path.count);
    for (const of of curves.methods) for (const { path } of of) free.line(path.xy, path.count);
    if (main.numbers !== null && main.along) free.take({ left: main.numbers, right: main.along(bounds[0]![0]), top: 0, bottom: place.height });
    if (main.numbers !== null && main.up) free.take({ left: 0, right: place.width, top: main.up(bounds[1]![0]) + 6, bottom: place.height });
    if (handle) free.line([handle.fromX, handle.fromY, handle.x, handle.y], 2);
    const ends = [...(truth && !landing ? [pointAt(curves.exact[0]!.way, truth.times, truth.times[truth.times.length - 1]!)] : []),
      ...curves.methods.flatMap(([c]) => (c && !c.exit ? [pointAt(c.way, c.times, last(c.line))] : []))];
    for (const { x, y } of ends) if (single) free.take({ left: x - place.ball, right: x + (place.names ? 200 : 76) * place.scale, top: y - 12, bottom: y + 12 });
  }
  const written = (time: number): Box[] => notes.filter((n) => time >= n.time).map((n) => n.box);
  const landed = landing && ((): { readonly text: string; readonly left: number; readonly y: number } => {
    const text = words.stage.lands(exactName, seconds(landing.time)), at = note(landing.x + place.ball + 6, landing.y - 8 - leaveSize, textWidth(text, leaveSize) * 1.06, 1.4 * leaveSize, landing.time);
    return { text, left: at.left, y: at.top + leaveSize };
  })();
  function drawLanding(pen: Pen, ink: Ink, time: number): void {
    if (!landing || !landed || time < landing.time) return;
    pen.mark('ring', landing.x, landing.y, place.ball, ink.exact);
    pen.text(landed.left, landed.y, [{ text: landed.text, bold: true }], { colour: ink.exact, size: leaveSize, halo: ink.surface });
  }
  const wideOf = (l: Pick<Leaving, 'says' | 'more'>): number => Math.max(textWidth(l.says, leaveSize) * 1.06, textWidth(l.more, leaveSize - 1));
  curves.methods.forEach((of, i) => {
    const c = of.find((curve) => curve.exit);
    if (!c?.exit || nowhere.has(i)) return;
    const { exit } = c, low = exit.y > main.box.bottom - 40, name = shortLabel(c.line.look.label);
    const grounded = staging.decor === 'throw' && main.unit !== null && exit.y > main.box.bottom - 1, said = { name, says: grounded ? words.stage.landed(place.names ? name : briefly(name, names.all)) : words.stage.leaves(name), more: told(motion, c, staging) }, wide = wideOf(said);
    // Behind the arrow, before it where the right is too narrow; below the first note stands "show all".
    const behind = exit.x + 14 + wide <= place.width - 4 || exit.x - 14 - wide < place.text + 4, high = leaveSize + (leaving.length ? (said.more ? 1.25 * leaveSize : 0) + 6 : (said.more ? 24 : 8) + (place.names ? 24 : 34));
    const at = note(behind ? exit.x + 14 : exit.x - 14 - wide, (grounded ? exit.y - 84 : low ? exit.y - 46 : exit.y + 8) - leaveSize, wide, high, exit.time), anchor = at.left + wide / 2 < exit.x ? 'end' as const : 'start' as const;
    leaving.push({ ...said, colour: c.line.look.tone, x: anchor === 'end' ? at.right : at.left, y: at.top + leaveSize, time: exit.time, anchor });
  });
  function leavers(pen: Pen, ink: Ink, time: number): void {
    for (const l of leaving) {
      if (time < l.time) continue;
      const size = leaveSize, letters = { colour: l.colour, size, anchor: l.anchor, halo: ink.surface };
      pen.text(l.x, l.y, [{ text: l.says, bold: true }], letters);
      if (l.more) pen.text(l.x, l.y + 1.25 * size, l.more, { ...letters, size: size - 1 });
    }
  }

  /** The spring, the pendulum's rod. */
  function beside(pen: Pen, ink: Ink, time: number): void {
    if (!truth && !lines.length) return;
    const curve = curves.exact[0] ?? curves.methods[0]![0]!, at = pointAt(curve.way, truth?.times ?? curves.methods[0]![0]!.times, time);
    const colour = truth ? ink.exact : lines[0]!.look.colour;
    if (side === 'phase' && staging.decor === 'spring' && Number.isFinite(at.y)) {
      const x = springX, y = Math.min(main.box.bottom, Math.max(main.box.top + 40, at.y));
      spring(pen, ink, x, place.frame.top + 12, y);
      pen.mark('circle', x, y, 1.4 * place.ball, colour, { rim: ink.surface });
    }
    if (side !== 'rod') return;
    const column = subject.bodies[0]!.columns[0]!, of = truth?.columns[column]?.length ? truth : lines[0]!.track, length = 80 * place.scale;
    const x = place.width - 118 * place.scale, y = (main.box.top + main.box.bottom) / 2 + 20, place_ = placeAt(of.times, time), values = of.columns[column]!;
    const angleAt = (t: number): number => valueAt(values, placeAt(of.times, t, place_));
    const span = Math.abs((of.times[of.times.length - 1] ?? 1) - of.times[0]!), way = Math.sign((of.times[of.times.length - 1] ?? 1) - of.times[0]!) || 1;
    for (let k = 9; k >= 1; k--) {
      const t = time - way * k * span / 110;
      if ((t - of.times[0]!) * way < 0) continue;
      const angle = angleAt(t);
      pen.mark('circle', x + length * Math.sin(angle), y + length * Math.cos(angle), place.ball * 0.95, colour, { alpha: 0.3 - 0.026 * k });
    }
    const end = rod(pen, ink, x, y, length, angleAt(time));
    pen.mark('circle', ...end, place.ball + 1.5, colour, { rim: ink.surface });
  }

  return {
    still, moving, ghost, handle, leaving,
    over: (time) => [...lines.map(({ track }) => track), ...(truth ? [truth] : [])].every(({ times }) => isDone(times, time)),
    end: truth && single ? pointAt(curves.exact[0]!.way, truth.times, truth.times[truth.times.length - 1]!) : null,
    remarks: () => [...(landing ? [words.stage.summary.ground(seconds(landing.time))] : []), ...lines.map((line) => {
      const { problem, times } = line.track;
      if (problem) {
        // What is undefined at its start stops there.
        const at = brief((times.length > 1 ? problem.time : null) ?? times[times.length - 1] ?? 0);
        if (problem.kind === 'solve') return words.stage.summary.stopsUnsolved(line.look.label, brief(times[times.length - 1] ?? 0));
        return problem.variable ? words.stage.summary.stopsAs(line.look.label, at, problem.variable) : words.stage.summary.stops(line.look.label, at);
      }
      const end = endSaid(line.track, staging.units?.t ?? '');
      if (end) return words.stage.summary.ended(line.look.label, end);
      const c = curves.methods[lines.indexOf(line)]!.find((curve) => curve.exit);
      return c?.exit ? words.stage.summary.leaves(line.look.label, brief(c.exit.time)) : '';
    })].filter(Boolean),
  };
}
/** Pixels of a ladder's rungs from one another; of a note from what it must not cover. */
const SPACING_LADDER = 8, CLEAR = 4;

/** How a runaway ends: by how much too wide it swings, or when it left. */
function told(motion: Motion, curve: Curve, staging: Staging): string {
  const { track } = curve.line, { truth } = motion, unit = staging.units ? `\u2009${staging.units.t}` : '';
  const end = track.times[track.times.length - 1] ?? 0;
  if (track.problem?.kind === 'solve') return words.stage.unsolved(`${brief(end, 3)}${unit}`);
  if (track.problem) return words.stage.ends(`${brief(track.problem.time ?? end, 3)}${unit}`);
  if (motion.subject.kind === 'time' && truth) {
    const times = wider(motion, curve, truth);
    if (Number.isFinite(times) && times >= 1.5) return words.stage.wide(brief(times, 2), `${brief(end, 3)}${unit}`);
  }
  return words.stage.at(`${brief(curve.exit!.time, 3)}${unit}`);
}
/** How many times as wide as the exact motion a method swings at the end; NaN where the exact one does not swing. */
function wider(motion: Motion, curve: Curve, truth: Rows): number {
  const column = motion.subject.bodies[curve.body]!.columns[0]!, exact = truth.columns[column], { track } = curve.line;
  if (!exact?.length) return NaN;
  const [low, high] = extent([exact]), middle = (low + high) / 2, passes: number[] = [];
  for (let i = 1; i < exact.length; i++) if ((exact[i - 1]! < middle) !== (exact[i]! < middle)) passes.push(truth.times[i]!);
  if (passes.length < 4) return NaN;
  // A whole swing, the last one.
  const first = passes[2]!, since = passes[passes.length - 3]!, way = Math.sign(truth.times[truth.times.length - 1]! - truth.times[0]!) || 1;
  const widest = (of: Rows, early = false): number => { let most = 0; of.times.forEach((t, i) => { if (early ? (t - first) * way <= 0 : (t - since) * way >= 0) most = Math.max(most, Math.abs(of.columns[column]![i]! - middle)); }); return most; };
  const own = widest(track), swing = widest(truth), speed = velocityColumn(motion.scene.solution, column);
  if (Math.abs(swing - widest(truth, true)) > 0.02 * swing || speed < 0) return own / swing;
  // Where swings stay as wide as they are, a method's width is known between its turning points too: from the ellipse of place and velocity that it is on.
  const part = (k: number): number => {
    const of = truth.columns[k], values = track.columns[k];
    if (!of?.length || !values?.length) return NaN;
    const [least, most] = extent([of]);
    return ((values[values.length - 1]! - (least + most) / 2) / ((most - least) / 2)) ** 2;
  };
  const ellipse = Math.sqrt(part(column) + part(speed));
  return Number.isFinite(ellipse) ? ellipse : own / swing;
}
