/* The answers to the page's questions, from the core. Runs in a worker (worker.ts).
 *
 * A model may come from a stranger's address: steps, numbers and rows are bounded here, memory by the module itself.
 */
import { EigenvalueDecomposition, Matrix } from 'ml-matrix';
import type { Core } from './core';
import { STEPS_MAX, problem } from './protocol';
import type {
  Ask, Description, ErrorTrack, Model, Problem, Region, Requests, Solution, Solve, Spectrum, Trace, Track, Truth,
} from './protocol';
import { Refused } from './scene';

const NUMBERS_MAX = 4e6, NUMBERS_ENOUGH = 1e5, ROWS_ENOUGH = 1500;      // of one track: never more; beyond this fewer rows, down to so many
const COLUMNS_MAX = 256;
const TRUTH_ROWS = 1200;
const REGION_MAX = 250_000;
const EIGENVALUES_MAX = 64;

function limit(message: string, hint: string): Refused {
  return new Refused(problem('limit', message, hint));
}

/** Column c of rows that lie one after the other. */
function column(values: Float64Array, width: number, c: number): Float64Array {
  const out = new Float64Array(values.length / width);
  for (let i = 0, k = c; i < out.length; i++, k += width) out[i] = values[k] as number;
  return out;
}

/** The truth at some times, `of` the reference that told it. */
interface Known { readonly of: object | null; readonly times: Float64Array; readonly x: Float64Array; readonly v: Float64Array }

export class Answers {
  private readonly lab: number;
  private opened = '';                   // the model that is open, as a key
  private description: Description | null = null;
  private reference: { key: string; name: string; error: number } | null = null;

  private known: Known | null = null;

  constructor(private readonly core: Core) {
    this.lab = core.create();
  }

  answer<K extends Ask>(kind: K, ask: Requests[K]['ask']): Requests[K]['answer'] {
    const all: { [Q in Ask]: (ask: Requests[Q]['ask']) => Requests[Q]['answer'] } = {
      catalogue: () => this.core.catalogue(this.lab),
      describe: ({ model }) => this.open(model),
      words: ({ text }) => this.core.words(text),
      vocabulary: () => this.core.vocabulary(this.lab),
      solve: (question) => this.solve(question),
      trace: (question) => this.trace(question),
      converge: ({ model, methods, step, until }) => {
        this.open(model);
        return this.core.converge(this.lab, methods, step, until);
      },
      compare: ({ model, methods, step, until }) => {
        this.open(model);
        return this.core.compare(this.lab, methods, step, until);
      },
      region: (question) => this.region(question),
      growth: ({ method, re, im }) => this.growth(method, Float64Array.from(re), Float64Array.from(im)),
      spectrum: (question) => this.spectrum(question),
    };
    return all[kind](ask);
  }

  private open(model: Model): Description {
    const key = JSON.stringify([model.text, model.set]);
    if (key !== this.opened || !this.description) {
      this.opened = '';
      this.reference = null;
      this.core.open(this.lab, model);
      this.description = this.core.describe(this.lab);
      this.opened = key;
    }
    return this.description;
  }

  private start(method: string, step: number | null, until: number | null): void {
    this.core.start(this.lab, method, step, until);
    const { total, step: h } = this.core.progress(this.lab);
    if (total > STEPS_MAX) {
      throw limit(`${total} steps of ${h} are more than a page should take (${STEPS_MAX})`, 'a larger step, a nearer end, or the program motus');
    }
  }

  private solve(ask: Solve): Solution {
    const began = performance.now();
    const description = this.open(ask.model);
    const names = description.columns.map((c) => c.name);
    const wanted = ask.columns.length > 0 ? ask.columns : names.slice(0, COLUMNS_MAX);
    const indices = wanted.map((name) => {
      const k = names.indexOf(name);
      if (k < 0) throw limit(`there is no column ${name}`, `columns: ${names.slice(0, 12).join(', ')}`);
      return k;
    });
    const nx = this.core.positions(this.lab), nv = this.core.velocities(this.lab);
    // Errors need every position and velocity; small models are recorded whole.
    const whole = ask.truth && nx + nv <= COLUMNS_MAX;
    const states = whole ? Array.from({ length: nx + nv }, (_, k) => 1 + k) : [];
    const all = [0, ...indices, ...states];
    const tracks: Track[] = [], recorded: Float64Array[] = [];
    for (const method of ask.methods) {
      const { track, values } = this.track(method, ask, all, indices.length);
      tracks.push(track);
      recorded.push(values);
    }
    let truth: Truth | null = null, problem: Problem | null = null;
    const errors: ErrorTrack[] = [];
    if (whole && tracks.length > 0) {
      try {
        truth = this.truth(ask, wanted, indices, nx, nv, tracks);
        tracks.forEach((track, k) => errors.push(this.errors(track, recorded[k] as Float64Array, all.length, 1 + indices.length, nx, nv)));
      } catch (e) {
        if (!(e instanceof Refused)) throw e;
        problem = e.problem;
      }
    }
    return { description, columns: wanted, tracks, truth, errors, problem, milliseconds: performance.now() - began };
  }

  private track(method: string, ask: Solve, all: readonly number[], count: number): { track: Track; values: Float64Array } {
    this.start(method, ask.step, ask.until);
    const { total, step, last } = this.core.progress(this.lab);
    const enough = Math.max(ROWS_ENOUGH, Math.floor(NUMBERS_ENOUGH / all.length));
    const rows = Math.max(2, Math.min(ask.rows, enough, Math.floor(NUMBERS_MAX / all.length)));
    const every = Math.max(1, Math.ceil(total / (rows - 1)));
    const { values, problem } = this.core.record(this.lab, all, every, rows, true);
    const now = this.core.progress(this.lab);
    const singular = problem ? null : this.core.singular(this.lab, method, ask.step, ask.until);
    const columns = Array.from({ length: count }, (_, c) => column(values, all.length, 1 + c));
    return {
      values,
      track: {
        method, times: column(values, all.length, 0), columns, step, steps: now.steps, total, lastStep: last, evaluations: now.evaluations, every, problem, singular,
      },
    };
  }

  /** The reference of one model and end serves every step: what a step says of it is but a hint. */
  private openReference(ask: Solve): { name: string; error: number } {
    const key = String(ask.until);
    if (this.reference?.key !== key) {
      this.reference = null;
      this.reference = { key, ...this.core.reference(this.lab, ask.step, ask.until) };
    }
    return this.reference;
  }

  private truth(ask: Solve, names: readonly string[], indices: readonly number[], nx: number, nv: number, tracks: readonly Track[]): Truth {
    const { name, error } = this.openReference(ask);
    const start = tracks[0]?.times[0] ?? 0;
    const end = ask.until ?? this.description?.settings.until ?? tracks.reduce((t, track) => track.times[track.times.length - 1] ?? t, start);
    const times = Float64Array.from({ length: TRUTH_ROWS }, (_, i) => (i === TRUTH_ROWS - 1 ? end : start + ((end - start) * i) / (TRUTH_ROWS - 1)));
    const { x, v } = this.core.referenceAt(this.lab, times);
    const columns = names.map((_, k) => {
      const index = indices[k] as number;
      if (index === 0) return times;
      if (index <= nx) return column(x, nx, index - 1);
      return index <= nx + nv ? column(v, nv, index - 1 - nx) : new Float64Array(0);
    });
    return { name, error, times, columns };
  }

  /** Methods with the same step are looked at at the same times: the truth there is asked for once. */
  private truthAt(times: Float64Array): { x: Float64Array; v: Float64Array } {
    let known = this.known;
    if (known?.of !== this.reference || known.times.length !== times.length || !known.times.every((t, i) => t === times[i])) {
      this.known = known = { of: this.reference, times: times.slice(), ...this.core.referenceAt(this.lab, times) };
    }
    return known;
  }

  private errors(track: Track, values: Float64Array, width: number, first: number, nx: number, nv: number): ErrorTrack {
    const rows = track.times.length, truth = this.truthAt(track.times);
    /* Of the numbers from … to-1 of a row of `of`, which stands at column `at` in `values`. */
    const largest = (from: number, to: number, of: Float64Array, each: number, at: number): Float64Array => Float64Array.from({ length: to > from ? rows : 0 }, (_, i) => {
      let worst = 0;
      for (let k = from; k < to; k++) worst = Math.max(worst, Math.abs((values[i * width + at + k] as number) - (of[i * each + k] as number)));
      return worst;
    });
    return {
      method: track.method, x: largest(0, nx, truth.x, nx, first), v: largest(0, nx, truth.v, nv, first + nx), s: largest(nx, nv, truth.v, nv, first + nx),
    };
  }

  private trace(ask: Requests['trace']['ask']): Trace {
    const description = this.open(ask.model);
    this.start(ask.method, ask.step, ask.until);
    const total = this.core.progress(this.lab).total;
    const index = Math.max(0, Math.min(ask.index, total - 1));
    if (index > 0) this.core.advance(this.lab, index);
    const entries = this.core.trace(this.lab);
    const nx = this.core.positions(this.lab), nv = this.core.velocities(this.lab);
    const names = description.columns.map((c) => c.name);
    return {
      method: this.core.method(this.lab), step: this.core.progress(this.lab).step, index, total, entries,
      names: { x: names.slice(1, 1 + nx), v: names.slice(1 + nx, 1 + nx + nv) },
    };
  }

  private growth(method: string, re: Float64Array, im: Float64Array): Float64Array {
    if (re.length !== im.length || re.length > REGION_MAX) throw limit(`${re.length} points`, `at most ${REGION_MAX} points`);
    return this.core.stability(this.lab, method, re, im);
  }

  private region({ method, re, im, width, height }: Requests['region']['ask']): Region {
    if (!(width > 0 && height > 0 && width * height <= REGION_MAX)) throw limit(`a region of ${width} by ${height} points`, `at most ${REGION_MAX} points`);
    const across = Float64Array.from({ length: width }, (_, i) => re[0] + ((re[1] - re[0]) * i) / Math.max(1, width - 1));
    const up = Float64Array.from({ length: height }, (_, j) => im[0] + ((im[1] - im[0]) * j) / Math.max(1, height - 1));
    const x = new Float64Array(width * height), y = new Float64Array(width * height);
    for (let j = 0; j < height; j++) for (let i = 0; i < width; i++) {
      x[j * width + i] = across[i] as number;
      y[j * width + i] = up[j] as number;
    }
    return { method, re: across, im: up, growth: this.growth(method, x, y) };
  }

  /** Eigenvalues of the linearised first-order system (x, v)' = [[0, I], [da/dx, da/dv]] (x, v); first-order variables are v's without an x. */
  private spectrum(ask: Requests['spectrum']['ask']): Spectrum[] {
    this.open(ask.model);
    const nx = this.core.positions(this.lab), nv = this.core.velocities(this.lab), n = nx + nv;
    if (n > EIGENVALUES_MAX) throw limit(`${n} eigenvalues are too many to look at`, `at most ${EIGENVALUES_MAX}`);
    this.start(ask.method, ask.step, ask.until);
    const out: Spectrum[] = [];
    for (const time of [...ask.times].sort((a, b) => a - b)) {
      const now = this.core.progress(this.lab);
      const steps = Math.round(Math.abs(time - now.time) / Math.abs(now.step));
      if (steps > 0 && !now.done) this.core.advance(this.lab, steps);
      const { byX, byV } = this.core.jacobian(this.lab);
      const matrix = Matrix.zeros(n, n);
      for (let i = 0; i < nx; i++) matrix.set(i, nx + i, 1);
      for (let i = 0; i < nv; i++) {
        for (let k = 0; k < nx; k++) matrix.set(nx + i, k, byX[i * nx + k] as number);
        for (let k = 0; k < nv; k++) matrix.set(nx + i, nx + k, byV[i * nv + k] as number);
      }
      const { realEigenvalues, imaginaryEigenvalues } = new EigenvalueDecomposition(matrix);
      out.push({ re: Float64Array.from(realEigenvalues), im: Float64Array.from(imaginaryEigenvalues) });
    }
    return out;
  }
}

/** An answer or a problem, whatever happens: nothing is thrown past here. */
export function reply(answers: Answers, id: number, kind: Ask, ask: unknown): { id: number; answer: unknown } | { id: number; problem: Problem } {
  try {
    return { id, answer: answers.answer(kind, ask as Requests[Ask]['ask'] & never) };
  } catch (e) {
    if (e instanceof Refused) return { id, problem: e.problem };
    // A trap: the stack or the memory of the module, or of the browser, was not enough.
    const message = `the page has not enough room for this (${e instanceof Error ? e.message : String(e)})`;
    return { id, problem: problem('memory', message, 'fewer brackets and definitions within one another, a smaller model, or the program motus') };
  }
}
