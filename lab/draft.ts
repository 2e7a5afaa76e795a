/* A draft of the exact motion: soon there, and known to be nearer to it than can be seen.
 *
 * A method of order 8 takes ever smaller steps until two runs, whose steps share hardly a time, tell the same motion to a small part of a pixel, at
 * times between their steps too. Its error is then the difference of both, many times what the last run is off. Where that takes too many steps, or where
 * the force may change so fast that steps miss it, the draft is a reference, whose steps adapt to the force, but one that need not be better than can be
 * seen. Invariant: a draft whose runs differ by more, pass a singularity, or do not resolve the force is none.
 */
import type { Core } from './core';
import { eventful, problem, type Description, type Events, type Method } from './protocol';
import { Refused } from './scene';
import { even, type Breaks, type Curve } from './sample';
import { computed } from './words';

export interface Draft {
  readonly name: string;
  /** The largest difference of the two runs, in any number of the state. */
  readonly error: number;
  /** Of each quantity what it may be off; Infinity: so much that it would be seen, as of one that is kept and moves by errors alone. */
  readonly off: readonly number[];
  /** What it tells at even times. */
  readonly begun: Curve;
  /** Where it ends, which an event may bring about; and where events let it jump. */
  readonly to: number; readonly breaks: Breaks | null;
  /** Positions, velocities and first-order variables at times in the order of the motion, one column each; then quantities. */
  ask(times: Float64Array): readonly Float64Array[];
}

/** Of a column's extent; a picture of 4000 pixels shows a twelfth of a pixel. */
const ENOUGH = 1 / 12 / 4000;
const FIRST = 200, LAST = { solving: 10_000, explicit: 60_000 }, TIMES = 512;
/* Two step counts in this ratio have no common divisor to speak of. */
const GOLDEN = (1 + Math.sqrt(5)) / 2;
/** By how much a quantity may be further off than the numbers that it follows from. */
export const QUANTITY = 100;
/** Jumps of a curve. */
const EVENTS_MOST = 4000;
/* Columns that move less than this part of their size rest. */
const AT_REST = 1e-9;

/** Whether the force may have peaks or jumps so narrow that no step falls into them: it is not smooth, or has a function that can do so. */
const hides = (description: Description, text: string): boolean => !description.smooth || /\b(exp|tanh|sinh|cosh|erf|atan|log|log2|log10)\b/.test(text.replace(/#.*/g, ''));

/** A Gauss method solves for its stages, which costs less than kicks that are solved for one by one; else a composition needs no solving. */
function methodOf(description: Description, catalogue: readonly Method[]): string | null {
  const admitted = (name: string): boolean => description.methods.some((m) => m.name === name && m.admitted);
  const first = description.velocity_dependent ? 'gauss8' : 'kahan-li8';
  if (admitted(first)) return first;
  const others = catalogue.filter((m) => !m.adaptive && m.order >= 4 && admitted(m.name));
  return others.sort((a, b) => b.order - a.order)[0]?.name ?? null;
}

/** The largest difference of two columns, and the same in units of what is enough. */
function apart(p: Float64Array, q: Float64Array): { error: number; seen: number } {
  let low = Infinity, high = -Infinity, error = 0;
  p.forEach((value, i) => {
    low = Math.min(low, value);
    high = Math.max(high, value);
    error = Math.max(error, Math.abs(value - q[i]!));
  });
  const size = Math.max(Math.abs(low), Math.abs(high)), moves = high - low > AT_REST * size ? high - low : size, seen = error === 0 ? 0 : error / (ENOUGH * moves);
  return { error, seen: Number.isNaN(seen) ? Infinity : seen };
}
const most = (list: readonly number[]): number => list.reduce((a, b) => Math.max(a, b), 0);
const offOf = (found: readonly { error: number; seen: number }[]): number[] => found.map(({ error, seen }) => (seen <= 1 ? error : Infinity));

/** What events changed, for a curve of these columns: of several at one instant what the first came to and the last left. */
export function breaksOf({ times, changed, before, after }: Events): Breaks {
  const rows = [...times.keys()].filter((i) => changed[i]), at = (i: number): number => times[rows[i]!]!;
  const first = [...rows.keys()].filter((i) => i === 0 || at(i) !== at(i - 1)), last = first.map((_, n) => (first[n + 1] ?? rows.length) - 1);
  return { times: first.map(at), before: before.map((column) => Float64Array.from(first, (i) => column[rows[i]!]!)), after: after.map((column) => Float64Array.from(last, (i) => column[rows[i]!]!)) };
}

/** null: none in so many steps, or milliseconds. events: at most so many are followed. */
function byRuns(core: Core, lab: number, method: string, last: number, count: number, columns: readonly number[], { from, to }: Span, milliseconds: number, events: number): Draft | null {
  /** Where events end it, and where they let it jump. */
  const followed = (step: number): { end: number; breaks: Breaks | null } => {
    if (!events) return { end: to, breaks: null };
    core.start(lab, method, step, to);
    core.advance(lab, Number.MAX_SAFE_INTEGER);
    return { end: core.progress(lab).time, breaks: breaksOf(core.events(lab, columns, 0, Math.min(events, core.eventCount(lab)))) };
  };
  const ask = (step: number, times: Float64Array): Float64Array[] => {
    core.start(lab, method, step, to);
    const rows = core.sample(lab, times, columns);
    return columns.map((_, k) => Float64Array.from({ length: times.length }, (__, i) => rows[i * columns.length + k]!));
  };
  const began = performance.now();
  let before: Float64Array[] | null = null, factor = GOLDEN;
  for (let steps = FIRST; steps < last; steps *= factor) {
    const since = performance.now(), step = Math.abs(to - from) / steps;
    let now: Float64Array[] | null = null, seen = Infinity, end = to, breaks: Breaks | null = null, times: Float64Array = new Float64Array(0);
    try {
      ({ end, breaks } = followed(step));
      times = even(from, end, TIMES);
      now = ask(step, times);
      if (!now.slice(0, count).every((column) => column.every(Number.isFinite))) now = null;
    } catch (e) {
      // A step that is too large for it: the next one is smaller.
      if (!(e instanceof Refused) || e.problem.kind === 'memory') throw e;
    }
    if (now && before && now[0]?.length === before[0]?.length) {
      const last = before, found = now.map((column, k) => apart(column, last[k]!));
      seen = most(found.slice(0, count).map((f) => f.seen));
      if (seen <= 1) {
        if (core.singular(lab, method, step, to)) return null;
        return { name: computed.draft(method, String(Number(step.toPrecision(6)))), error: most(found.slice(0, count).map((f) => f.error)), off: offOf(found.slice(count)), begun: { times, columns: now }, to: end, breaks, ask: (at) => ask(step, at) };
      }
    }
    before = now;
    // Far from it the steps shrink faster; powers of the golden ratio keep the times of the steps apart.
    factor = seen > 1e3 ? GOLDEN ** 2 : GOLDEN;
    if (performance.now() + factor * (performance.now() - since) - began > milliseconds) return null;
  }
  return null;
}

/** Its error is of the largest number; that of a smaller one may be seen, and is not known. */
function byReference(core: Core, lab: number, count: number, quantities: readonly number[], { from, to }: Span): Draft | null {
  const { name, error } = core.reference(lab, null, to, ENOUGH / 10), ask = (times: Float64Array): Float64Array[] => told(core, lab, times, quantities);
  const times = even(from, to, TIMES), columns = ask(times);
  // A quantity follows from several numbers.
  const found = columns.map((column, k) => apart(column, column.map((value) => value + (k < count ? error : QUANTITY * error))));
  return most(found.slice(0, count).map((f) => f.seen)) <= 1 ? { name, error, off: offOf(found.slice(count)), begun: { times, columns }, to, breaks: null, ask } : null;
}

/** What the reference tells at times: the state, one column for each number, then quantities. */
export function told(core: Core, lab: number, times: Float64Array, quantities: readonly number[]): Float64Array[] {
  const state = core.referenceAt(lab, times), nx = core.positions(lab), nv = core.velocities(lab), n = times.length;
  const values = quantities.length > 0 ? core.values(lab, times, state, quantities) : new Float64Array(0);
  const pick = (from: Float64Array, width: number): Float64Array[] => Array.from({ length: width }, (_, k) => Float64Array.from({ length: n }, (__, i) => from[i * width + k]!));
  return [...pick(state.x, nx), ...pick(state.v, nv), ...pick(values, quantities.length)];
}

interface Span { readonly from: number; readonly to: number }

/** text: of the model; quantities: columns. It takes the place of the run, and of the reference. */
export function draft(core: Core, lab: number, description: Description, text: string, quantities: readonly number[], catalogue: readonly Method[], span: Span, milliseconds: number): Draft | null {
  const method = methodOf(description, catalogue), count = core.positions(lab) + core.velocities(lab);
  const columns = [...Array.from({ length: count }, (_, k) => 1 + k), ...quantities];
  if (method === null || count === 0) return null;
  const last = catalogue.find((m) => m.name === method)?.evaluations ? LAST.explicit : LAST.solving;
  // No reference knows what happens on the way.
  if (eventful(description)) {
    const found = byRuns(core, lab, method, last, count, columns, span, milliseconds, EVENTS_MOST);
    if (!found) throw new Refused(problem('diverged', computed.undrawn));
    return found;
  }
  return (hides(description, text) ? null : byRuns(core, lab, method, last, count, columns, span, milliseconds, 0)) ?? byReference(core, lab, count, quantities, span);
}
