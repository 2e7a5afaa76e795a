/* The frame that both pictures of measured errors have: errors going up, what they cost along, both logarithmic; and by what errors are judged.
 *
 * Invariant: what goes along runs from the left to the right, whether the numbers rise or fall.
 */
import { axes, extent, padded } from '../figure/axes';
import { bold, drawEnds, endsLayout, shortLabel, type End, type EndsLayout } from '../figure/ends';
import { brief } from '../figure/number';
import { textWidth } from '../figure/shapes';
import type { Frame, Ink, Pen, Scale } from '../figure/types';
import type { Convergence } from '../protocol';
import type { Look } from '../scene';
import { words } from '../words';

const say = words.study;
/** An error of so many sizes of the motion is an explosion; how large, tells nothing, and would press all else together. */
const CEILING = 30;
/** Room below for the numbers and the name of what goes along; of a name at the end, the widest part of the picture; pixels between two markers. */
const FOOT = 34, WIDEST = 0.32, APART = 13, PLACES = 32;

export interface Along {
  readonly from: number; readonly to: number;
  /** Numbers that may stand there, from left to right; as many as have room do. keep: one that does if any. */
  readonly ticks: readonly number[]; readonly keep?: number;
  label(value: number): string;
  readonly name: string;
}

function scaleOf({ from, to, label }: Along, left: number, width: number, ticks: readonly number[]): Scale {
  const a = Math.log(from), per = width / ((Math.log(to) - a) || 1);
  return Object.assign((v: number) => left + (Math.log(v) - a) * per, { invert: (p: number) => Math.exp(a + (p - left) / per), ticks, label });
}
/** Every tick, every second, … until the labels leave each other room. */
function fitting(along: Along, scale: Scale): number[] {
  const { ticks, label, keep } = along, kept = Math.max(0, ticks.findIndex((t) => keep !== undefined && Math.abs(t - keep) < 1e-6 * keep));
  for (let stride = 1; stride < ticks.length; stride++) {
    const some = ticks.filter((_, i) => (i - kept) % stride === 0);
    if (some.every((t, i) => i === 0 || scale(t) - scale(some[i - 1]!) >= (textWidth(label(t)) + textWidth(label(some[i - 1]!))) / 2 + 12)) return some;
  }
  return ticks.slice(kept, kept + 1);
}

/** Errors and costs of all that is drawn; the names that will stand at the ends. */
export function errorFrame(pen: Pen, ink: Ink, layout: EndsLayout, errors: readonly number[], along: Along): Frame {
  const [low, high] = padded(extent([errors.map((e) => Math.log10(Math.min(CEILING, e)))]), 0.05);
  const region = { left: 0, top: layout.above, width: pen.width - layout.right, height: pen.height - layout.above - FOOT };
  const made = axes(pen, ink, { min: 0, max: 1, label: '' }, { min: 10 ** low, max: 10 ** high, log: true, label: say.error }, { region, plain: true, bare: true });
  const ticks = fitting(along, scaleOf(along, made.left, made.width, [])), x = scaleOf(along, made.left, made.width, ticks), foot = made.top + made.height;
  for (const t of along.ticks) pen.line([Math.round(x(t)) + 0.5, foot, Math.round(x(t)) + 0.5, foot + 4], { colour: ink.axis, width: 1 });
  for (const t of ticks) pen.text(x(t), foot + 7, along.label(t), { colour: ink.quiet, anchor: 'middle', baseline: 'top' });
  pen.text(made.left + made.width, foot + 24, along.name, { colour: ink.quiet, anchor: 'end', baseline: 'top' });
  return { ...made, x };
}

/** A line through what was measured; markers where they have room, and where `marked` says so. */
export function drawErrors(pen: Pen, look: Look, xy: readonly number[], marked: (k: number) => boolean): void {
  pen.line(xy, { colour: look.colour, width: 2, dash: look.dash });
  let last = -Infinity;
  for (let k = 0; 2 * k < xy.length; k++) {
    const x = xy[2 * k]!;
    if (!marked(k) || !(Math.abs(x - last) >= APART)) continue;
    pen.mark(look.marker, x, xy[2 * k + 1]!, 3.2, look.colour);
    last = x;
  }
}

/** Heights of a line at places that are the same for all of a frame. */
function heightsOf(frame: Frame, xy: readonly number[]): number[] {
  return Array.from({ length: PLACES }, (_, i) => {
    const x = frame.left + frame.width * (i + 0.5) / PLACES;
    for (let k = 0; k + 3 < xy.length; k += 2) {
      const a = xy[k]!, b = xy[k + 2]!;
      if (a <= x && x <= b) return xy[k + 1]! + (xy[k + 3]! - xy[k + 1]!) * (x - a) / ((b - a) || 1);
    }
    return NaN;
  });
}

/** The names at the ends of such lines: where the last point that is in the frame lies. */
export function errorEnds(pen: Pen, ink: Ink, frame: Frame, layout: EndsLayout, labels: readonly string[], looks: readonly Look[], lines: readonly (readonly number[])[]): void {
  drawEnds(pen, ink, frame, layout, looks.flatMap((look, i): End[] => {
    const xy = lines[i]!;
    let k = xy.length - 2;
    while (k >= 0 && !Number.isFinite(xy[k]! + xy[k + 1]!)) k -= 2;
    return k < 0 ? [] : [{ label: labels[i]!, colour: look.tone, marker: look.marker, at: { x: xy[k]!, y: xy[k + 1]! }, heights: heightsOf(frame, xy) }];
  }));
}
export const namesLayout = (width: number, labels: readonly string[]): EndsLayout => endsLayout(width, labels);
/** The name and what it comes to, where that has room at the end of a curve; else the name. */
export function endLabel(width: number, look: Look, whole: (name: string) => string): string {
  const name = shortLabel(look.label), text = whole(name);
  return bold(text, 13) <= WIDEST * width || width < 480 ? text : name;
}

/** By what the errors are judged. */
export function judge(found: Convergence): string {
  const [name = '', ...rest] = found.reference.split('; ');
  return [name === 'exact' ? say.known : say.unknown(name, brief(found.reference_error, 2)), rest.length ? say.taken(rest.join('; ')) : ''].filter(Boolean).join(' ');
}
/** Where the motion that was measured ends, if before its own end; ''. */
export const endOfStudy = (found: Convergence): string => /; until (\S+), not /.exec(found.reference)?.[1] ?? '';
