/* What the measured errors say: what half the step leaves of an error, and how many evaluations so many digits take.
 *
 * Invariant: numbers come from the core's points and slopes alone. A count of evaluations is read off between two measured points; where one of them is
 * missing it is a bound, and says so.
 */
import type { ConvergePoint, ConvergeRow } from '../protocol';

/** Errors below this are drawn at it: 0 has no logarithm. */
const FLOOR = 1e-17;
export const errorOf = (point: ConvergePoint): number => (point.error === null || !Number.isFinite(point.error) ? NaN : Math.max(point.error, FLOOR));

/* ---- half the step ---- */

export type Buys =
  /** Of the error: 2 to the power of -slope, which is 1/2^power where the slope is whole. passed: the declared order, or better. */
  | { readonly kind: 'share'; readonly slope: number; readonly power: number | null; readonly passed: boolean }
  /** It chooses its steps: of the error, a tenth of the tolerance leaves 10 to the power of -power. */
  | { readonly kind: 'tolerance'; readonly power: number }
  | { readonly kind: 'exact' } | { readonly kind: 'rough' } | { readonly kind: 'missing' };
/** A slope is whole within this. Half the step then leaves 2^-0.15 to 2^0.15 of what is said, a tenth more or less. */
const WHOLE = 0.15;

export function buysOf(row: ConvergeRow): Buys {
  if (row.exact_here) return { kind: 'exact' };
  if (typeof row.power === 'number') return { kind: 'tolerance', power: row.power };
  if (row.observed === null) return { kind: row.points.some((point) => errorOf(point) > 0) ? 'rough' : 'missing' };
  const near = Math.round(row.observed);
  return { kind: 'share', slope: row.observed, power: Math.abs(row.observed - near) <= WHOLE ? near : null, passed: row.passed };
}

/* ---- so many digits ---- */

export interface Point { readonly work: number; readonly error: number }
/** Points that can be drawn, cheapest first. */
export function pointsOf(row: ConvergeRow): Point[] {
  return row.points.map((point) => ({ work: point.evaluations, error: errorOf(point) })).filter((point) => point.work > 0 && point.error > 0).sort((a, b) => a.work - b.work);
}

/** exact: read off between two points; else no more than that. */
export interface Need { readonly work: number; readonly exact: boolean }
/** What it takes for the error to be `error` or less, there and with all smaller steps; null: it does not come to that. */
export function needOf(row: ConvergeRow, error: number): Need | null {
  const points = row.points.map((point) => ({ work: point.evaluations, error: errorOf(point) })).filter((point) => point.work > 0).sort((a, b) => a.work - b.work);
  let k = points.length - 1;
  while (k >= 0 && points[k]!.error <= error) k--;
  const above = points[k], under = points[k + 1];
  if (!under) return null;
  // The longest step has it already, or the next longer one ran away.
  if (!above || !(above.error > 0)) return { work: under.work, exact: false };
  const share = Math.log(above.error / error) / Math.log(above.error / under.error);
  return { work: Math.exp(Math.log(above.work) + share * Math.log(under.work / above.work)), exact: true };
}

/** Digits that readers count by, and the most that are asked for. */
const USUAL = 3, MOST = 12;
/** As near to three digits as can be said of all these rows; else of as many of them as possible. null: of none. */
export function digitsOf(rows: readonly ConvergeRow[]): number | null {
  let best: { readonly digits: number; readonly value: number } | null = null;
  for (let digits = 1; digits <= MOST; digits++) {
    const needs = rows.map((row) => needOf(row, 10 ** -digits)), reached = needs.filter((need) => need !== null);
    if (!reached.length) continue;
    // Who comes to it counts most, then between two points, then how usual.
    const value = 1e6 * reached.length + 1e3 * reached.filter((need) => need.exact).length - Math.abs(digits - USUAL) - (digits > USUAL ? 0.5 : 0);
    if (!best || value > best.value) best = { digits, value };
  }
  return best?.digits ?? null;
}
