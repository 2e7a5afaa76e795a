/* A draft of the exact motion: soon there, and known to be nearer to it than can be seen.
 *
 * A method of order 8 takes ever smaller steps until two runs, whose steps share hardly a time, tell the same motion to a small part of a pixel, at
 * times between their steps too. Its error is then the difference of both, many times what the last run is off. Invariant: a draft whose runs differ
 * by more, pass a singularity, or do not resolve the force is none.
 */
import type { Core } from './core';
import type { Description, Method } from './protocol';
import { Refused } from './scene';
import { even } from './sample';

export interface Draft {
  readonly name: string;
  /** The largest difference of the two runs, in any number. */
  readonly error: number;
  /** Positions, velocities and first-order variables at times in the order of the motion, one column each. */
  ask(times: Float64Array): readonly Float64Array[];
}

/** Of a column's extent; a picture of 4000 pixels shows a twelfth of a pixel. */
const ENOUGH = 1 / 12 / 4000;
const FIRST = 200, LAST = 1e6, TIMES = 700;
/* Two step counts in this ratio have no common divisor to speak of. */
const GOLDEN = (1 + Math.sqrt(5)) / 2;
/* Columns that move less than this part of their size rest. */
const AT_REST = 1e-9;

/** A Gauss method solves for its stages, which costs less than kicks that are solved for one by one; else a composition needs no solving. */
function methodOf(description: Description, catalogue: readonly Method[]): string | null {
  const admitted = (name: string): boolean => description.methods.some((m) => m.name === name && m.admitted);
  const first = description.velocity_dependent ? 'gauss8' : 'kahan-li8';
  if (admitted(first)) return first;
  const others = catalogue.filter((m) => m.family !== 'exact' && m.order >= 4 && admitted(m.name));
  return others.sort((a, b) => b.order - a.order)[0]?.name ?? null;
}

/** The largest difference of two tables, and the same in units of what is enough. */
function apart(p: readonly Float64Array[], q: readonly Float64Array[]): { error: number; seen: number } {
  let error = 0, seen = 0;
  p.forEach((column, k) => {
    const other = q[k]!;
    let low = Infinity, high = -Infinity, most = 0;
    column.forEach((value, i) => {
      low = Math.min(low, value);
      high = Math.max(high, value);
      most = Math.max(most, Math.abs(value - other[i]!));
    });
    const size = Math.max(Math.abs(low), Math.abs(high)), moves = high - low > AT_REST * size ? high - low : size;
    error = Math.max(error, most);
    if (most > 0 || Number.isNaN(most)) seen = Math.max(seen, most / (ENOUGH * moves));
  });
  return { error, seen: Number.isFinite(seen) ? seen : Infinity };
}

/** null: none in so many milliseconds. */
export function draft(core: Core, lab: number, description: Description, catalogue: readonly Method[], span: { from: number; to: number }, milliseconds: number): Draft | null {
  const method = methodOf(description, catalogue), count = core.positions(lab) + core.velocities(lab);
  const columns = Array.from({ length: count }, (_, k) => 1 + k), { from, to } = span;
  if (method === null || count === 0) return null;
  const ask = (step: number, times: Float64Array): Float64Array[] => {
    core.start(lab, method, step, to);
    const rows = core.sample(lab, times, columns);
    return columns.map((_, k) => Float64Array.from({ length: times.length }, (__, i) => rows[i * count + k]!));
  };
  const times = even(from, to, TIMES), began = performance.now();
  let last: Float64Array[] | null = null, steps = FIRST, factor = GOLDEN;
  for (; steps < LAST; steps *= factor) {
    const since = performance.now(), step = Math.abs(to - from) / steps;
    let now: Float64Array[] | null = null, seen = Infinity;
    try {
      now = ask(step, times);
      if (!now.every((column) => column.every(Number.isFinite))) now = null;
    } catch (e) {
      // A step that is too large for it: the next one is smaller.
      if (!(e instanceof Refused) || e.problem.kind === 'memory') throw e;
    }
    if (now && last) {
      const found = apart(now, last);
      seen = found.seen;
      if (seen <= 1) {
        return core.singular(lab, method, step, to) ? null : { name: `${method} at step ${Number(step.toPrecision(6))}`, error: found.error, ask: (at) => ask(step, at) };
      }
    }
    last = now;
    // Far from it the steps shrink faster; powers of the golden ratio keep the times of the steps apart.
    factor = seen > 1e3 ? GOLDEN ** 2 : GOLDEN;
    const spent = performance.now() - since;
    if (performance.now() + factor * spent - began > milliseconds) return null;
  }
  return null;
}
