/* Sections of a motion: the states that one kind of event leaves, computed piece by piece as they are asked for, and the state through a point of their plane.
 *
 * Invariant: a run goes on where the last answer left it; where the worker has been replaced meanwhile it begins anew, and what was told already is passed over,
 * so that no point is told twice and none is left out.
 */
import { Matrix, pseudoInverse } from 'ml-matrix';
import type { Core } from './core';
import { problem, type Problem, type Requests } from './protocol';
import { Refused } from './scene';
import { computed } from './words';

/** Ends of the model's own that a section goes on for, at most; milliseconds between two looks at the clock; rows of the table at once. */
const FAR = 1e5, LOOK = 5, ROWS = 2000;
/* Of Newton's steps: how many, how near is there, and how small a difference tells a slope. */
const STEPS = 40, NEAR = 1e-12, SLOPE = 1e-6;
const SURFACE = 'surface_of_the_section';

type Filled = Requests['section']['answer'];

export class Sections {
  private lab = 0;
  private solver = 0;
  private key = '';
  private columns: readonly number[] = [];
  /** Rows of the table that have been read, and how many of them were of the kind. */
  private read = 0;
  private found = 0;
  private latest = NaN;
  private stride = 32;

  constructor(private readonly core: Core) {}

  private begin(ask: Requests['section']['ask'], key: string): void {
    const { core } = this;
    this.key = '';
    this.lab ||= core.create();
    core.open(this.lab, ask.model);
    const { columns, settings: { start, until } } = core.describe(this.lab), names = columns.map(({ name }) => name), nx = core.positions(this.lab);
    this.columns = ask.columns.map((name) => names.indexOf(name)).filter((k) => k >= 0);
    core.startAt(this.lab, ask.method, { step: ask.step, tolerance: ask.tolerance, until: start + FAR * ((until ?? start + 1) - start) }, ask.from.slice(0, nx), ask.from.slice(nx));
    this.key = key;
    this.read = this.found = 0;
    this.stride = 32;
  }

  fill(ask: Requests['section']['ask']): Filled {
    const key = JSON.stringify([ask.model, ask.method, ask.step, ask.tolerance, ask.from, ask.kind, ask.columns]), began = performance.now(), { core } = this;
    if (key !== this.key || this.found > ask.have) this.begin(ask, key);
    const columns: number[][] = this.columns.map(() => []);
    let wrong: Problem | null = null, told = 0, done = false;
    for (;;) {
      this.gather(ask, columns);
      told = columns[0]?.length ?? 0;
      done = wrong !== null || core.progress(this.lab).done;
      if (done || ask.have + told >= ask.most || performance.now() - began > ask.milliseconds) break;
      const since = performance.now();
      try {
        core.advance(this.lab, this.stride);
      } catch (e) {
        if (!(e instanceof Refused) || e.problem.kind === 'memory') throw e;
        wrong = e.problem;
      }
      if (performance.now() - since < LOOK) this.stride *= 2;
    }
    return { columns: columns.map((column) => Float64Array.from(column)), time: ask.have + told >= ask.most ? this.latest : core.progress(this.lab).time, done, problem: wrong };
  }

  private gather({ kind, have, most }: Requests['section']['ask'], columns: readonly number[][]): void {
    const { core } = this, upTo = core.eventCount(this.lab);
    while (this.read < upTo && have + (columns[0]?.length ?? 0) < most) {
      const rows = core.events(this.lab, this.columns, this.read, Math.min(ROWS, upTo - this.read));
      for (let i = 0; i < rows.times.length && have + (columns[0]?.length ?? 0) < most; i++) {
        this.read++;
        if (rows.names[i]!.replace(/\[.*$/s, '') !== kind || ++this.found <= have) continue;
        this.latest = rows.times[i]!;
        columns.forEach((column, k) => column.push(rows.after[k]![i]!));
      }
    }
  }

  /** By Newton's method, whose steps are the shortest that lead there: the state nearest to `near` in which the columns have the values, the surface is met, and what is kept has its value. */
  through({ model, near, columns, values, surface, keep }: Requests['through']['ask']): number[] {
    const { core } = this;
    this.solver ||= core.create();
    try {
      core.open(this.solver, surface ? { ...model, text: `${model.text}\n${SURFACE} = ${surface}\n` } : model);
    } catch (e) {
      if (!(e instanceof Refused) || !surface) throw e;
      return this.through({ model, near, columns, values, surface: '', keep });
    }
    const description = core.describe(this.solver), names = description.columns.map(({ name }) => name), nx = core.positions(this.solver), time = Float64Array.of(description.settings.start);
    // As many invariants as leave a solution.
    const kept = keep.slice(0, Math.max(0, near.length - columns.length - (surface ? 1 : 0))), wanted = [...columns, ...(surface ? [SURFACE] : []), ...kept.map(({ name }) => name)].map((name) => names.indexOf(name));
    const target = [...values, ...(surface ? [0] : []), ...kept.map(({ value }) => value)];
    const off = (state: readonly number[]): number[] => {
      const found = core.values(this.solver, time, { x: Float64Array.from(state.slice(0, nx)), v: Float64Array.from(state.slice(nx)) }, wanted);
      return target.map((t, k) => t - found[k]!);
    };
    const size = (list: readonly number[]): number => Math.max(...list.map((v, k) => Math.abs(v) / (1 + Math.abs(target[k]!))));
    let state = [...near], miss = off(state);
    for (let n = 0; n < STEPS && size(miss) > NEAR; n++) {
      const slopes = Matrix.zeros(target.length, state.length);
      state.forEach((value, j) => {
        const h = SLOPE * (1 + Math.abs(value)), [above, below] = [h, -h].map((d) => off(state.map((v, i) => (i === j ? v + d : v)))) as [number[], number[]];
        target.forEach((_, k) => slopes.set(k, j, (below[k]! - above[k]!) / (2 * h)));
      });
      if (slopes.to1DArray().some((slope) => !Number.isFinite(slope))) break;
      const step = pseudoInverse(slopes).mmul(Matrix.columnVector(miss)).to1DArray();
      let part = 1, next = state, far = miss;
      for (; part > 1e-3; part /= 2) {
        next = state.map((v, i) => v + part * step[i]!);
        far = off(next);
        if (size(far) < size(miss)) break;
      }
      if (!(size(far) < size(miss))) break;
      state = next;
      miss = far;
    }
    if (!(size(miss) < 1e-9)) throw new Refused(problem('page', computed.unreachable(kept.map(({ name }) => name))));
    return state;
  }
}
