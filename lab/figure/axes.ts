/* Axes: from numbers to pixels, with ticks that fit and labels that read as on paper.
 *
 * Invariant: whatever the bounds (equal, reversed, infinite, not positive on a logarithmic axis), there is a mapping and it is finite on what is
 * finite; the bounds asked for are kept, and only `equal` widens them.
 */
import { ticks as roundNumbers } from 'd3-array';
import { minus, raised, tenTo } from './number';
import { SIZE, spansOf, textWidth } from './shapes';
import type { AxisDefinition, Frame, Ink, Pen, Scale, Span } from './types';

export { thin, thinPath } from './thin';

/** Where the axes and their labels go: all of the pen, or a part. */
export interface Region { readonly left: number; readonly top: number; readonly width: number; readonly height: number }
export interface AxesOptions {
  readonly equal?: boolean; readonly region?: Region;
  /** Lines at the numbers that go up only, and one to stand on: for curves that go along. */
  readonly plain?: boolean;
  /** Letters along x left out: a panel above another one with the same x. */
  readonly bare?: boolean;
  /** Room kept on the left, so that panels one above the other line up; at least this. */
  readonly margin?: number;
}

/** The smallest and the largest finite number of all; [Infinity, -Infinity] where there is none. */
export function rangeOf(columns: Iterable<ArrayLike<number>>): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const column of columns) {
    for (let i = 0; i < column.length; i++) {
      const v = column[i]!;
      if (v - v !== 0) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  return [low, high];
}
/** The same; [0, 1] where there is none. */
export function extent(columns: Iterable<ArrayLike<number>>): [number, number] {
  const range = rangeOf(columns);
  return range[0] <= range[1] ? range : [0, 1];
}

/** How far above the frame the name of what goes up stands; another text may stand there on the right. */
const LABEL = 22;

/** Some room beyond both ends. */
export function padded([low, high]: readonly [number, number], share = 0.06): [number, number] {
  const room = high > low ? (high - low) * share : Math.abs(low) * 0.1 || 1;
  return [low - room, high + room];
}

function sound({ min, max, log }: AxisDefinition): [number, number] {
  let low = Number.isFinite(min) ? min : Number.isFinite(max) ? max : 0, high = Number.isFinite(max) ? max : low + 1;
  if (low > high) [low, high] = [high, low];
  if (log) {
    if (!(high > 0)) high = 1;
    if (!(low > 0)) low = high * 1e-3;
    low = Math.min(Math.max(low, 1e-300), 1e299), high = Math.min(Math.max(high, 1e-299), 1e300);
    if (high / low < 1.5) { low /= 2; high *= 2; }
    return [low, high];
  }
  // The whole range of doubles would overflow in high - low, or in its ticks; and a range below the last digit cannot be shown.
  low = Math.min(Math.max(low, -1e300), 1e300), high = Math.min(Math.max(high, -1e300), 1e300);
  const least = Math.max(64 * Number.EPSILON * Math.max(Math.abs(low), Math.abs(high)), 1e-290);
  if (!(high - low > least)) {
    const half = low || high ? Math.max(Math.abs(low) * 0.1, least) : 1, middle = (low + high) / 2;
    low = middle - half, high = middle + half;
  }
  return [low, high];
}

/** Labels that agree among themselves: as many decimals for all; past five digits a power of ten. */
function labelling(ticks: readonly number[]): (value: number) => string {
  const first = ticks[0] ?? 0, last = ticks[ticks.length - 1] ?? 0;
  const step = ticks.length > 1 ? (last - first) / (ticks.length - 1) : Math.abs(first) || 1;
  const largest = Math.max(Math.abs(first), Math.abs(last));
  // The step's last digit decides: 0.25 wants two decimals, 0.5 one. 1e-9 forgives what division left in the last bits.
  const decimalsOf = (s: number): number => {
    for (let d = 0; d < 8; d++) if (Math.abs(s * 10 ** d - Math.round(s * 10 ** d)) < 1e-9 * s * 10 ** d) return d;
    return 8;
  };
  const power = Math.floor(Math.log10(largest * (1 + 1e-12)) || 0);
  if (largest > 0 && (power >= 5 || power < -3)) {
    const unit = 10 ** power, decimals = decimalsOf(step / unit);
    return (v) => (Math.abs(v) < step / 8 ? '0' : `${minus((v / unit).toFixed(decimals))}×10${raised(power)}`);
  }
  const decimals = decimalsOf(step);
  return (v) => minus((Math.abs(v) < step / 8 ? 0 : v).toFixed(decimals));
}

export interface Built extends Scale { readonly minor: readonly number[]; readonly base: number; readonly min: number; readonly max: number }

/** from, to: pixels. count: how many ticks there is room for. */
export function scaleOf(definition: AxisDefinition, from: number, to: number, count: number): Built {
  const [min, max] = sound(definition);
  if (definition.log) {
    const low = Math.log10(min), high = Math.log10(max), per = (to - from) / (high - low);
    const map = (v: number): number => from + (Math.log10(v) - low) * per;
    const first = Math.ceil(low - 1e-9), decades = Math.floor(high + 1e-9) - first + 1;
    let ticks: number[] = [], minor: number[] = [];
    if (decades >= 2) {
      const stride = Math.max(1, Math.ceil(decades / Math.max(2, count)));
      // Multiples of the stride, so that the same powers are named whatever the bounds.
      for (let k = Math.ceil(first / stride) * stride; k < first + decades; k += stride) ticks.push(10 ** k);
      for (let k = first; k < first + decades; k++) if (stride > 1 && k % stride) minor.push(10 ** k);
    } else {
      const fine: number[] = [], coarse: number[] = [];
      for (let k = Math.floor(low); k <= high; k++) {
        for (let digit = 1; digit < 10; digit++) {
          // 2 / 10 rather than 2 · 0.1: the nearest double to what the label says.
          const v = k < 0 ? digit / 10 ** -k : digit * 10 ** k;
          if (v < min || v > max) continue;
          fine.push(v);
          if (digit === 1 || digit === 2 || digit === 5) coarse.push(v);
        }
      }
      ticks = high - low > 0.35 ? coarse : fine;
      minor = fine.filter((v) => !ticks.includes(v));
      while (ticks.length > Math.max(3, count)) ticks = ticks.filter((_, i) => i % 2 === 0);
    }
    const label = (v: number): string => {
      const power = Math.floor(Math.log10(v) + 1e-9), lead = v / 10 ** power;
      if (power >= -3 && power <= 4) return String(Number(v.toPrecision(6)));
      return Math.abs(lead - 1) < 1e-9 ? tenTo(power) : `${Number(lead.toPrecision(3))}×${tenTo(power)}`;
    };
    // All ticks in one manner: powers, unless every one of them is a short number.
    const short = ticks.every((v) => v > 0.9e-3 && v < 1.1e4);
    const powers = (v: number): string => { const k = Math.log10(v); return Math.abs(k - Math.round(k)) < 1e-9 ? tenTo(Math.round(k)) : label(v); };
    return Object.assign(map, { invert: (p: number) => 10 ** (low + (p - from) / per), ticks, minor, label: short ? label : powers, base: 0, min, max });
  }
  const per = (to - from) / (max - min);
  const map = (v: number): number => from + (v - min) * per;
  // Where all numbers begin with the same five digits, labels say what they differ by, and the axis from what.
  let base = 0;
  const largest = Math.max(Math.abs(min), Math.abs(max));
  if (max - min < 3e-5 * largest) {
    const middle = (min + max) / 2;
    for (let digits = 1; digits <= 15 && !(base >= min && base <= max); digits++) base = Number(middle.toPrecision(digits));
  }
  const inner = roundNumbers(min - base, max - base, Math.max(2, count)), name = labelling(inner);
  const ticks = inner.map((v) => base + v);
  const label = base === 0 ? name : (v: number): string => {
    // Through the list, as v − base has lost the digits that v could not hold.
    const at = ticks.indexOf(v), d = at >= 0 ? inner[at]! : v - base;
    return `${d > 0 ? '+' : ''}${name(d)}`;
  };
  return Object.assign(map, { invert: (p: number) => min + (p - from) / per, ticks, minor: [], label, base, min, max });
}

/** Fewer and fewer ticks until the labels along x leave each other room. */
export function scaleAlong(definition: AxisDefinition, left: number, right: number, apart = 80): Built {
  let scale = scaleOf(definition, left, right, Math.max(2, Math.round((right - left) / apart)));
  for (let count = scale.ticks.length - 1; count >= 1; count--) {
    let free = -Infinity, fits = true;
    for (const tick of scale.ticks) {
      const half = textWidth(scale.label(tick), SIZE) / 2, at = scale(tick);
      if (at - half < free) fits = false;
      free = at + half + 10;
    }
    if (fits) break;
    scale = scaleOf(definition, left, right, count);
  }
  return scale;
}

function named({ label, unit }: AxisDefinition, scale: Built, up: boolean): Span[] {
  const base = scale.base === 0 ? '' : ` ${scale.base < 0 ? '+' : '−'} ${String(Math.abs(Number(scale.base.toPrecision(15))))}`;
  return [...spansOf(label), ...(base ? [{ text: base }] : []), ...(up && unit ? [{ text: `, ${unit}` }] : [])];
}

export function axes(pen: Pen, ink: Ink, x: AxisDefinition, y: AxisDefinition, options: AxesOptions = {}): Frame {
  const region = options.region ?? { left: 0, top: 0, width: pen.width, height: pen.height };
  const top = region.top + (y.label.length ? 27 : 10), bottom = region.top + region.height - (options.bare ? 8 : x.label.length ? 38 : 24);
  const height = Math.max(20, bottom - top);
  const rows = Math.max(2, Math.round(height / 46));
  let bounds = { x: sound(x), y: sound(y) };
  const right = region.left + region.width - 14;
  const room = (scale: Built): number => Math.max(options.margin ?? 0, 16 + Math.max(...scale.ticks.map((v) => textWidth(scale.label(v))), 12));
  let up = scaleOf(y, bottom, top, rows);
  let left = region.left + Math.min(room(up), region.width / 2);
  if (options.equal && !x.log && !y.log) {
    const width = Math.max(20, right - left);
    const unit = Math.max((bounds.x[1] - bounds.x[0]) / width, (bounds.y[1] - bounds.y[0]) / height);
    const wide = ([low, high]: [number, number], pixels: number): [number, number] => {
      const half = unit * pixels / 2, middle = (low + high) / 2;
      return [middle - half, middle + half];
    };
    bounds = { x: wide(bounds.x, width), y: wide(bounds.y, height) };
    x = { ...x, min: bounds.x[0], max: bounds.x[1] };
    y = { ...y, min: bounds.y[0], max: bounds.y[1] };
    up = scaleOf(y, top + height, top, rows);
    left = Math.max(left, region.left + Math.min(room(up), region.width / 2));
    // Longer labels than before: once more for the narrower picture, so that a unit stays a unit.
    const narrower = Math.max(20, right - left);
    if (narrower < width) {
      const low = (x.min + x.max) / 2 - unit * narrower / 2;
      x = { ...x, min: low, max: low + unit * narrower };
    }
  } else {
    up = scaleOf(y, top + height, top, rows);
  }
  const width = Math.max(20, right - left);
  const along = scaleAlong(x, left, left + width);
  const base = top + height, end = left + width;
  const crisp = (p: number): number => Math.round(p) + 0.5;

  if (!options.plain) for (const v of up.minor) pen.line([left, crisp(up(v)), end, crisp(up(v))], { colour: ink.grid, width: 1, alpha: 0.5 });
  if (!options.plain) for (const v of along.minor) pen.line([crisp(along(v)), top, crisp(along(v)), base], { colour: ink.grid, width: 1, alpha: 0.5 });
  for (const v of up.ticks) pen.line([left, crisp(up(v)), end, crisp(up(v))], { colour: ink.grid, width: 1 });
  if (!options.plain) for (const v of along.ticks) pen.line([crisp(along(v)), top, crisp(along(v)), base], { colour: ink.grid, width: 1 });
  pen.line([...(options.plain ? [] : [crisp(left), top]), crisp(left), crisp(base), end, crisp(base)], { colour: ink.axis, width: options.plain ? 1.5 : 1 });
  for (const v of up.ticks) {
    pen.text(left - 7, up(v), up.label(v), { colour: ink.quiet, anchor: 'end', baseline: 'middle' });
  }
  if (!options.bare) {
    const last = along.ticks[along.ticks.length - 1];
    for (const v of along.ticks) {
      const at = along(v), label = along.label(v), half = textWidth(label) / 2, unit = v === last && x.unit ? `\u2009${x.unit}` : '';
      // The last number may not leave the picture; its unit stands behind it.
      const inside = Math.min(at, region.left + region.width - half - textWidth(unit) - 1) + textWidth(unit) / 2;
      if (!options.plain) pen.line([crisp(at), base, crisp(at), base + 4], { colour: ink.axis, width: 1 });
      pen.text(inside, base + 7, label + unit, { colour: ink.quiet, anchor: 'middle', baseline: 'top' });
    }
    if (x.label.length) pen.text(end, base + 24, named(x, along, false), { colour: ink.text, anchor: 'end', baseline: 'top' });
  }
  if (y.label.length) pen.text(region.left + 1, top - LABEL, named(y, up, true), { colour: options.plain ? ink.quiet : ink.text, baseline: 'top' });
  return { x: along, y: up, left, top, width, height };
}
