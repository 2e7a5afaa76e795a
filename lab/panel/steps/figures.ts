/* The figures of one step: as many digits as let its calculation be followed.
 *
 * Invariant: of what changes in the step three digits or four are written, of what it is added to as many decimals; a figure that was rounded says so (`rounded`).
 * Nothing is computed with these texts.
 */
import { minus, raised, readable, shortened } from '../../figure/number';
import type { Trace } from '../../protocol';
import type { Seen } from './seen';

/** decimals, and the largest of its kind in the step: powers of ten are for kinds that are small or large as a whole. */
export interface Kind { readonly decimals: number; readonly most: number }
export interface Kinds { readonly value: Kind; readonly rate: Kind; readonly force: Kind; /** Significant digits of what multiplies. */ readonly factor: number;
  /** Of values that others are made of, and of those in between; of rates that others are made of. */ readonly operand: Kind; readonly between: Kind; readonly rates: Kind }
/** shown: the number that the text is; unit: of its last place. */
export interface Figure { readonly text: string; readonly rounded: boolean; readonly shown: number; readonly unit: number }

/** Digits that matter of what changes (a thousandth of it may be seen), and the most that a figure has. */
const CHANGE = 3, MOST = 10, COARSE = 2.5;
const power = (x: number): number => (x > 0 && Number.isFinite(x) ? Math.floor(Math.log10(x) + 1e-12) : 0);

/** Decimals more than are needed: of what a result is made of, and of results that others are made of. */
export type More = readonly [operand: number, between: number];

export function kindsOf(trace: Trace, { indices, order }: Seen, more: More = [0, 0]): Kinds {
  const { entries } = trace, start = entries[0], h = Math.abs(start?.step ?? 1);
  const largest = (of: (number | undefined)[]): number => of.reduce<number>((m, x) => (x !== undefined && Number.isFinite(x) ? Math.max(m, Math.abs(x)) : m), 0);
  const all = (pick: (e: (typeof entries)[number], k: number) => number | undefined): number => largest(entries.flatMap((e) => indices.map((k) => pick(e, k))));
  const value = (e: (typeof entries)[number] | undefined, k: number): number => (order === 2 ? e?.x[k] : e?.v[k]) ?? NaN, rate = (e: (typeof entries)[number] | undefined, k: number): number => (order === 2 ? e?.v[k] : e?.a?.[k]) ?? NaN;
  const before = all((e, k) => (order === 2 ? e.before_x?.[k] : undefined));
  const mostValue = Math.max(before, all(value)), mostRate = all(rate), mostForce = order === 2 ? all((e, k) => e.a?.[k]) : 0;
  const kind = (change: number, least: number, most: number): Kind => {
    const wanted = Math.max(change > 0 ? CHANGE - 1 - power(change / COARSE) : -Infinity, least);
    return { decimals: Math.max(0, Math.min(Number.isFinite(wanted) ? wanted : CHANGE - 1 - power(most), MOST - 1 - power(most))), most };
  };
  const moved = all((e, k) => value(e, k) - value(start, k)) || h * mostRate, way = Math.log10(h);
  const of = kind(moved > 1e-12 * mostValue ? moved : mostValue, -Infinity, mostValue);
  const turned = all((e, k) => rate(e, k) - rate(start, k)), speed = kind(turned > 1e-12 * mostRate ? turned : 0, Math.ceil(of.decimals + way - 1e-9), mostRate);
  const force = kind(mostForce, Math.ceil(Math.max(speed.decimals + way, of.decimals + 2 * way) - 1e-9), mostForce);
  // A product is as exact as the sum that it belongs to.
  const needed = Math.max(power(h * mostRate) + of.decimals, power(h * mostForce) + speed.decimals, power(h * h * mostForce) + of.decimals) + 2;
  const finer = (k: Kind, by: number): Kind => ({ ...k, decimals: Math.min(k.decimals + by, Math.max(k.decimals, MOST - 1 - power(k.most))) });
  const both = more[0] + more[1];
  return { value: of, between: finer(of, more[1]), operand: finer(of, both), rate: finer(speed, more[1]), rates: finer(speed, both), force: finer(force, both && both + 1), factor: Math.max(CHANGE, Math.min(MOST + 2, needed + both)) };
}

const apart = (text: string): string => text.replace(/^(−?)(\d{5,})/, (_, sign: string, whole: string) => sign + whole.replace(/\B(?=(\d{3})+$)/g, '\u2009'));

/** keep: zeros at the end stay, for a number that is compared. */
export function figure(value: number, { decimals, most }: Kind, keep = false): Figure {
  if (!Number.isFinite(value)) return { text: readable(value), rounded: false, shown: value, unit: 0 };
  const size = Math.abs(value);
  let p = power(size);
  if (size <= 1e-13 * most || size === 0) return { text: '0', rounded: false, shown: 0, unit: 10 ** -decimals };
  const scaled = size >= 1e5 || most < 1e-3, places = Math.min(15, Math.max(0, scaled ? decimals + p : decimals));
  // 9.999 may round up to 10, which is 1 of the next power.
  if (scaled && Math.abs(Number((value / 10 ** p).toFixed(places))) >= 10) p++;
  const fixed = scaled ? (value / 10 ** p).toFixed(places) : value.toFixed(places), rounded = Math.abs(Number(fixed) * (scaled ? 10 ** p : 1) - value) > 1e-12 * size;
  const digits = Number(fixed) === 0 ? fixed.replace('-', '') : fixed, short = rounded || keep ? digits : shortened(digits);
  return { text: apart(minus(short)) + (scaled ? `×10${raised(p)}` : ''), rounded, shown: Number(fixed) * (scaled ? 10 ** p : 1), unit: 10 ** ((scaled ? p : 0) - places) };
}

/** The most letters of a figure of its kind: sign, digits, point. */
export const lettersOf = ({ decimals, most }: Kind): number => (most < 1e-3 || most >= 1e5 ? 6 + Math.max(0, decimals + power(most)) : 2 + Math.max(0, power(most)) + (decimals ? 1 + decimals : 0));

/** A multiple of the step. */
export function factor(value: number, digits: number): Figure {
  const short = Number(value.toPrecision(digits));
  return { text: shortened(readable(value, digits)), rounded: Math.abs(short - value) > 1e-12 * Math.abs(value), shown: short, unit: 10 ** (power(Math.abs(value)) + 1 - digits) };
}

/** How far off, in two digits or in the decimals of what it is the distance of. */
export function missed(size: number, { decimals }: Kind): Figure {
  const plain = decimals >= 1 - power(size) && decimals <= 6, text = plain ? size.toFixed(decimals) : shortened(readable(size, 2)), shown = plain ? Number(text) : Number(size.toPrecision(2));
  return { text, rounded: shown !== size, shown, unit: plain ? 10 ** -decimals : 10 ** (power(shown) - 1) };
}

/** Times of a step: decimals that write it and its half exactly, or else three digits of it. */
export function timeDecimals(h: number): number {
  const size = Math.abs(h);
  for (let d = 0; d < 5; d++) if (Math.abs(size * 5 * 10 ** d / 10 - Math.round(size * 5 * 10 ** d / 10)) < 1e-7) return d;
  return Math.max(0, Math.min(9, 2 - power(size)));
}
export const timeText = (t: number, decimals: number): string => apart(minus((Math.abs(t) < 0.5 * 10 ** -decimals ? 0 : t).toFixed(decimals)));
