/* The error of methods that choose their steps, at one tolerance after the other, measured as the core measures the others at steps of one size (study/converge.c): against the reference at
 * INTERVALS times, the largest over these and over all numbers, each in units of how far its variable moves.
 *
 * Invariant: a run ends at each of these times, so that nothing is interpolated; no decision depends on a clock.
 */
import type { Core } from './core';
import type { ConvergeRow, Description, Method } from './protocol';
import { Refused } from './scene';

const INTERVALS = 8, FIRST = 2, LAST = 13;
/** Evaluations that one method may take for all its runs, times the numbers of the model; errors that tell a slope are below LARGE, so many times above rounding, and of
 *  so many steps: of fewer, the first ones decide, which grow until they are as long as the tolerance allows. At least so many points tell it. */
const WORK = 4e6, LARGE = 0.1, CLEAR = 30, STEPS = 4 * INTERVALS, LEAST = 3;
/** What moves less than this part of its size rests. */
const AT_REST = 1e-9;

interface Span { readonly from: number; readonly to: number }

/** How far the variable of each number moves, and the rounding in these units: study_scale. rows: the state at times, row by row. */
function unitsOf(rows: readonly (readonly number[])[], group: readonly string[]): { units: number[]; noise: number } {
  const of = (k: number) => group.flatMap((g, i) => (g === group[k] ? [i] : []));
  let noise = Number.EPSILON;
  const units = group.map((_, k) => {
    let moves = 0, size = 0;
    for (const i of of(k)) {
      const column = rows.map((row) => row[i]!), low = Math.min(...column), high = Math.max(...column);
      moves = Math.max(moves, high - low);
      size = Math.max(size, Math.abs(low), Math.abs(high));
    }
    const unit = moves > AT_REST * size ? moves : size || 1;
    noise = Math.max(noise, Number.EPSILON * size / unit);
    return unit;
  });
  return { units, noise };
}

/** The power of the tolerance with which the error falls; null: too few points tell it. */
export function powerOf(points: readonly { readonly tolerance: number; readonly error: number }[]): number | null {
  if (points.length < LEAST) return null;
  const x = points.map((p) => Math.log(p.tolerance)), y = points.map((p) => Math.log(p.error)), mean = (list: readonly number[]): number => list.reduce((a, b) => a + b, 0) / list.length;
  const mx = mean(x), my = mean(y);
  return x.reduce((sum, v, k) => sum + (v - mx) * (y[k]! - my), 0) / x.reduce((sum, v) => sum + (v - mx) ** 2, 0);
}

/** The core's reference is open, as far as the end of the span. */
export function atTolerances(core: Core, lab: number, methods: readonly string[], catalogue: readonly Method[], description: Description, { from, to }: Span, referenceError: number): ConvergeRow[] {
  const nx = core.positions(lab), nv = core.velocities(lab), columns = Array.from({ length: nx + nv }, (_, k) => 1 + k), group = description.columns.slice(1, 1 + nx + nv).map((c) => `${c.kind} ${c.variable}`);
  const times = Float64Array.from({ length: INTERVALS + 1 }, (_, k) => (k === INTERVALS ? to : from + ((to - from) * k) / INTERVALS)), { x, v } = core.referenceAt(lab, times);
  const truth = Array.from(times, (_, i) => [...x.subarray(i * nx, (i + 1) * nx), ...v.subarray(i * nv, (i + 1) * nv)]), { units, noise } = unitsOf(truth, group), least = Math.max(CLEAR * noise, 10 * referenceError);
  return methods.map((method): ConvergeRow => {
    const points: (ConvergeRow['points'][number] & { tolerance: number })[] = [];
    let work = 0;
    for (let power = FIRST; power <= LAST && work * columns.length < WORK; power++) {
      const tolerance = Number(`1e-${power}`);
      let error: number | null = 0, last = { steps: 0, evaluations: 0 };
      try {
        for (let k = 1; k <= INTERVALS; k++) {
          core.start(lab, method, null, times[k]!, tolerance);
          const row = core.sample(lab, times.subarray(k, k + 1), columns);
          row.forEach((value, i) => { error = Math.max(error!, Math.abs(value - truth[k]![i]!) / units[i]!); });
          last = core.progress(lab);
          work += last.evaluations;
        }
      } catch (e) {
        if (!(e instanceof Refused) || e.problem.kind === 'memory') throw e;
        error = null;
      }
      if (error !== null && !Number.isFinite(error)) error = null;
      if (last.steps > 0) points.push({ step: Math.abs(to - from) / last.steps, tolerance, error, evaluations: last.evaluations, used: error !== null && error < LARGE && error > least && last.steps >= STEPS });
    }
    return {
      method, declared: catalogue.find((m) => m.name === method)?.order ?? 0, observed: null, standard_error: null, exact_here: false, passed: true, uncertain: false, points, certificate: '',
      power: powerOf(points.filter((p) => p.used) as { tolerance: number; error: number }[]),
    };
  });
}
