/* The WebAssembly core, with types: texts and arrays go in and out of its memory here and nowhere else.
 *
 * Invariant: every block that is taken from the module's memory is given back, and no view of that memory outlives the call that made it (the memory
 * may move when it grows).
 */
import {
  WORD_KINDS, problem, type Aim, type CompareRow, type Comparison, type Convergence, type Description, type Drift, type Ended, type Estimate, type Events, type Method, type Model, type Problem, type Refusal, type TraceEntry, type Vocabulary, type Word,
} from './protocol';
import { Refused } from './scene';
import { computed } from './words';

/** The exports of core/*.c, as a module of 32-bit addresses shows them. */
interface Exports {
  readonly memory: WebAssembly.Memory;
  malloc(bytes: number): number;
  free(block: number): void;
  lab_create(): number;
  lab_destroy(lab: number): void;
  lab_open(lab: number, text: number, length: number, sets: number, count: number, whens: number, whenCount: number): number;
  lab_problem(lab: number): number;
  lab_describe(lab: number): number;
  lab_catalogue(lab: number): number;
  lab_words(text: number, length: number, out: number, room: number): number;
  lab_vocabulary(lab: number): number;
  lab_start(lab: number, method: number, step: number, tolerance: number, until: number, accuracy: number, absolute: number, bars: number): number;
  lab_singular(lab: number, method: number, step: number, tolerance: number, until: number): number;
  lab_errors(lab: number, columns: number, count: number, values: number, errors: number): number;
  lab_estimate(lab: number): number;
  lab_bar(lab: number, value: number, error: number): number;
  lab_record(lab: number, columns: number, count: number, every: number, rows: number, first: number, out: number, written: number): number;
  lab_sample(lab: number, times: number, rows: number, columns: number, count: number, out: number): number;
  lab_progress(lab: number, out: number): void;
  lab_advance(lab: number, steps: number): number;
  lab_method(lab: number): number;
  lab_choice(lab: number): number;
  lab_save(lab: number): number;
  lab_positions(lab: number): number;
  lab_velocities(lab: number): number;
  lab_jacobian(lab: number, x: number, v: number): number;
  lab_reference(lab: number, step: number, until: number, tolerance: number): number;
  lab_reference_name(lab: number): number;
  lab_reference_error(lab: number): number;
  lab_reference_at(lab: number, times: number, count: number, x: number, v: number): number;
  lab_values(lab: number, times: number, x: number, v: number, count: number, columns: number, columnCount: number, out: number): number;
  lab_event_count(lab: number): number;
  lab_events(lab: number, first: number, rows: number, columns: number, count: number, out: number): number;
  lab_event_names(lab: number, first: number, rows: number): number;
  lab_ended(lab: number): number;
  lab_start_at(lab: number, method: number, step: number, tolerance: number, until: number, x: number, v: number): number;
  lab_trace(lab: number): number;
  lab_converge(lab: number, methods: number, count: number, step: number, until: number): number;
  lab_compare(lab: number, methods: number, count: number, step: number, until: number): number;
  lab_stability(lab: number, method: number, count: number, re: number, im: number, growth: number): number;
}

export interface Progress {
  readonly time: number; readonly steps: number; readonly last: number; readonly evaluations: number; readonly done: boolean; readonly refused: number;
  /** Where steps adapt 0 and NaN; elsewhere the tolerance is NaN. */
  readonly total: number; readonly step: number; readonly tolerance: number;
  /** motus_run_statistics. */
  readonly accuracy: number; readonly reached: number; readonly trials: number;
}
export interface Rows { readonly values: Float64Array; readonly rows: number; readonly problem: Problem | null }

const WORDS_MAX = 5000;
const NaNs = (value: number | null): number => value ?? NaN;
const noMemory = problem('memory', computed.memory, computed.fewer);

export class Core {
  private readonly exports: Exports;
  private readonly encoder = new TextEncoder();
  private readonly decoder = new TextDecoder();

  constructor(module: WebAssembly.Module) {
    this.exports = new WebAssembly.Instance(module).exports as unknown as Exports;
  }

  /** Room for `bytes`, while `use` runs. */
  private room<T>(bytes: number, use: (at: number) => T): T {
    const at = this.exports.malloc(Math.max(bytes, 1));
    if (at === 0) throw new Refused(noMemory);
    try {
      return use(at);
    } finally {
      this.exports.free(at);
    }
  }
  /** The texts one behind the other, each ended by 0. A text that holds a 0 of its own is cut there by the core. */
  private texts<T>(list: readonly string[], use: (at: number, bytes: number) => T): T {
    const bytes = this.encoder.encode(list.map((text) => text + '\0').join(''));
    return this.room(bytes.length, (at) => {
      new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
      return use(at, bytes.length);
    });
  }
  private numbers<T>(values: ArrayLike<number>, use: (at: number) => T): T {
    return this.room(8 * values.length, (at) => {
      new Float64Array(this.exports.memory.buffer, at, values.length).set(values);
      return use(at);
    });
  }
  private copy(at: number, count: number): Float64Array {
    return new Float64Array(this.exports.memory.buffer, at, count).slice();
  }
  private string(at: number): string {
    const bytes = new Uint8Array(this.exports.memory.buffer);
    return this.decoder.decode(bytes.subarray(at, bytes.indexOf(0, at)));
  }
  private json<T>(at: number): T {
    if (at === 0) throw new Refused(noMemory);
    return JSON.parse(this.string(at)) as T;
  }
  problem(lab: number): Problem { return this.json<Problem>(this.exports.lab_problem(lab)); }
  private check(lab: number, status: number): void {
    if (status !== 0) throw new Refused(this.problem(lab));
  }
  /** A JSON answer, or the problem. */
  private answer<T>(lab: number, at: number): T {
    if (at === 0) throw new Refused(this.problem(lab));
    return this.json<T>(at);
  }

  create(): number {
    const lab = this.exports.lab_create();
    if (lab === 0) throw new Refused(noMemory);
    return lab;
  }
  destroy(lab: number): void { this.exports.lab_destroy(lab); }
  bytes(): number { return this.exports.memory.buffer.byteLength; }

  catalogue(lab: number): Method[] {
    type Raw = Omit<Method, 'stability_limit'> & { stability_limit: number | null };
    const { methods } = this.json<{ methods: Raw[] }>(this.exports.lab_catalogue(lab));
    return methods.map((row) => ({ ...row, stability_limit: row.stability_limit ?? Infinity }));
  }
  open(lab: number, model: Model): void {
    this.texts([model.text], (text, length) => this.texts(model.set, (sets) => {
      this.texts(model.when ?? [], (whens) => this.check(lab, this.exports.lab_open(lab, text, length - 1, sets, model.set.length, whens, model.when?.length ?? 0)));
    }));
  }
  describe(lab: number): Description {
    return this.json<Description>(this.exports.lab_describe(lab));
  }
  vocabulary(lab: number): Vocabulary { return this.json<Vocabulary>(this.exports.lab_vocabulary(lab)); }
  /** At most WORDS_MAX of them: a longer text keeps the colour of ink from there on. */
  words(text: string): Word[] {
    return this.texts([text], (at, bytes) => this.room(12 * WORDS_MAX, (out) => {
      const count = this.exports.lab_words(at, bytes - 1, out, WORDS_MAX);
      const found = new Uint32Array(this.exports.memory.buffer, out, 3 * count).slice(), utf8 = new Uint8Array(this.exports.memory.buffer, at, bytes);
      // From bytes to UTF-16 units, of which a character of four bytes has two.
      let byte = 0, unit = 0;
      const unitAt = (end: number): number => {
        for (; byte < end; byte++) {
          const c = utf8[byte] ?? 0;
          if ((c & 0xC0) !== 0x80) unit += c >= 0xF0 ? 2 : 1;
        }
        return unit;
      };
      return Array.from({ length: count }, (_, k) => ({ from: unitAt(found[3 * k] ?? 0), to: unitAt(found[3 * k + 1] ?? 0), kind: WORD_KINDS[found[3 * k + 2] ?? 0] ?? 'wrong' }));
    }));
  }
  /** step: of a method of steps of one size, tolerance: of an adaptive one; else null. bars: errors are to be told. */
  start(lab: number, method: string, step: number | null, until: number | null, tolerance: number | null = null, bars = false): void {
    this.texts([method], (at) => this.check(lab, this.exports.lab_start(lab, at, NaNs(step), NaNs(tolerance), NaNs(until), NaN, 0, bars ? 1 : 0)));
  }
  /** A run whose tolerance, or step, is found so that the answer is as accurate as is asked for. method: may be "auto". */
  aim(lab: number, method: string, { accuracy, absolute }: Aim, until: number | null): void {
    this.texts([method], (at) => this.check(lab, this.exports.lab_start(lab, at, NaN, NaN, NaNs(until), accuracy, absolute ? 1 : 0, 0)));
  }
  /** Why "auto" chose its method; else ''. */
  choice(lab: number): string { return this.string(this.exports.lab_choice(lab)); }
  /** Where such a run passes a singularity of the force, or does not resolve the force, so that what follows is not the motion; null: nowhere, as far as it was examined. */
  singular(lab: number, method: string, step: number | null, until: number | null, tolerance: number | null = null): Problem | null {
    const found = this.texts([method], (at) => (this.exports.lab_singular(lab, at, NaNs(step), NaNs(tolerance), NaNs(until)) === 0 ? null : this.problem(lab)));
    if (found?.kind === 'memory') throw new Refused(found);
    return found?.kind === 'singular' || found?.kind === 'unresolved' ? found : null;
  }
  /** Rows of columns, one after the other, every `every` steps; the first row is the present state if `first`. */
  record(lab: number, columns: readonly number[], every: number, rows: number, first: boolean): Rows {
    return this.room(4 * columns.length + 8, (list) => this.room(8 * columns.length * rows, (out) => {
      new Uint32Array(this.exports.memory.buffer, list, columns.length).set(columns);
      const count = list + 4 * columns.length;
      const status = this.exports.lab_record(lab, list, columns.length, every, rows, first ? 1 : 0, out, count);
      const written = new DataView(this.exports.memory.buffer).getUint32(count, true);
      return { values: this.copy(out, written * columns.length), rows: written, problem: status === 0 ? null : this.problem(lab) };
    }));
  }
  /** The columns at times in the order of the run, row by row, by the method's dense output. */
  sample(lab: number, times: Float64Array, columns: readonly number[]): Float64Array {
    const count = columns.length;
    return this.numbers(times, (at) => this.room(4 * count, (list) => this.room(8 * count * times.length, (out) => {
      new Uint32Array(this.exports.memory.buffer, list, count).set(columns);
      this.check(lab, this.exports.lab_sample(lab, at, times.length, list, count, out));
      return this.copy(out, count * times.length);
    })));
  }
  /** The numbers of columns where the run stands, and their bars: 0 exact, infinite no digit known, NaN none. */
  errors(lab: number, columns: readonly number[]): { values: Float64Array; errors: Float64Array } {
    const count = columns.length;
    return this.room(4 * count, (list) => this.room(16 * count, (out) => {
      new Uint32Array(this.exports.memory.buffer, list, count).set(columns);
      this.check(lab, this.exports.lab_errors(lab, list, count, out, out + 8 * count));
      return { values: this.copy(out, count), errors: this.copy(out + 8 * count, count) };
    }));
  }
  /** "0.0477824 ± 1.5e-6", as the program prints it. */
  bar(lab: number, value: number, error: number): string { return this.string(this.exports.lab_bar(lab, value, error)); }
  estimate(lab: number): Estimate { return this.answer<Estimate>(lab, this.exports.lab_estimate(lab)); }
  progress(lab: number): Progress {
    return this.room(96, (at) => {
      this.exports.lab_progress(lab, at);
      const [time = 0, steps = 0, total = 0, step = 0, last = 0, evaluations = 0, done = 0, refused = 0, tolerance = NaN, accuracy = NaN, reached = NaN, trials = 0] = this.copy(at, 12);
      return { time, steps, total, step, last, evaluations, done: done !== 0, refused, tolerance, accuracy, reached, trials };
    });
  }
  advance(lab: number, steps: number): void { this.check(lab, this.exports.lab_advance(lab, steps)); }
  method(lab: number): string { return this.string(this.exports.lab_method(lab)); }
  save(lab: number): string {
    const at = this.exports.lab_save(lab);
    if (at === 0) throw new Refused(this.problem(lab));
    return this.string(at);
  }
  positions(lab: number): number { return this.exports.lab_positions(lab); }
  velocities(lab: number): number { return this.exports.lab_velocities(lab); }
  /** Row by row: derivatives of each acceleration by the positions, and by the velocities. */
  jacobian(lab: number): { byX: Float64Array; byV: Float64Array } {
    const nx = this.positions(lab), nv = this.velocities(lab);
    return this.room(8 * nv * nx, (x) => this.room(8 * nv * nv, (v) => {
      this.check(lab, this.exports.lab_jacobian(lab, x, v));
      return { byX: this.copy(x, nv * nx), byV: this.copy(v, nv * nv) };
    }));
  }
  /** tolerance: an error that need not be improved, of how far the motion moves. */
  reference(lab: number, step: number | null, until: number | null, tolerance = 0): { name: string; error: number } {
    this.check(lab, this.exports.lab_reference(lab, NaNs(step), NaNs(until), tolerance));
    return { name: this.string(this.exports.lab_reference_name(lab)), error: this.exports.lab_reference_error(lab) };
  }
  /** Row by row. */
  referenceAt(lab: number, times: Float64Array): { x: Float64Array; v: Float64Array } {
    const nx = this.positions(lab), nv = this.velocities(lab), n = times.length;
    return this.numbers(times, (at) => this.room(8 * n * nx, (x) => this.room(8 * n * nv, (v) => {
      this.check(lab, this.exports.lab_reference_at(lab, at, n, x, v));
      return { x: this.copy(x, n * nx), v: this.copy(v, n * nv) };
    })));
  }
  /** The columns at states, row by row, as referenceAt tells them. */
  values(lab: number, times: Float64Array, { x, v }: { x: Float64Array; v: Float64Array }, columns: readonly number[]): Float64Array {
    const count = columns.length, n = times.length;
    return this.numbers(times, (t) => this.numbers(x, (xs) => this.numbers(v, (vs) => this.room(4 * count, (list) => this.room(8 * n * count, (out) => {
      new Uint32Array(this.exports.memory.buffer, list, count).set(columns);
      this.check(lab, this.exports.lab_values(lab, t, xs, vs, n, list, count, out));
      return this.copy(out, n * count);
    })))));
  }
  /** A run from a state that the page chose, at the model's start. */
  startAt(lab: number, method: string, { step, tolerance, until }: { readonly step: number | null; readonly tolerance: number | null; readonly until: number | null }, x: ArrayLike<number>, v: ArrayLike<number>): void {
    this.texts([method], (at) => this.numbers(x, (xs) => this.numbers(v, (vs) => this.check(lab, this.exports.lab_start_at(lab, at, NaNs(step), NaNs(tolerance), NaNs(until), xs, vs)))));
  }
  /** How many rows the table of the run's events has so far. */
  eventCount(lab: number): number { return this.exports.lab_event_count(lab); }
  /** Rows of that table from `first` on, with these columns. */
  events(lab: number, columns: readonly number[], first: number, rows: number): Events {
    const count = columns.length, wide = 5 + 2 * count;
    const values = this.room(4 * count, (list) => this.room(8 * wide * rows, (out) => {
      new Uint32Array(this.exports.memory.buffer, list, count).set(columns);
      this.check(lab, this.exports.lab_events(lab, first, rows, list, count, out));
      return this.copy(out, wide * rows);
    }));
    const of = (k: number): Float64Array => Float64Array.from({ length: rows }, (_, i) => values[i * wide + k]!);
    return {
      names: this.answer<{ names: string[] }>(lab, this.exports.lab_event_names(lab, first, rows)).names, times: of(0), errors: of(1), counts: of(2), touched: of(3), changed: of(4),
      before: columns.map((_, k) => of(5 + k)), after: columns.map((_, k) => of(5 + count + k)),
    };
  }
  /** What ended the run, and where its events accumulate. */
  ended(lab: number): Ended { return this.answer<Ended>(lab, this.exports.lab_ended(lab)); }
  trace(lab: number): (TraceEntry | Refusal)[] { return this.answer<{ entries: (TraceEntry | Refusal)[] }>(lab, this.exports.lab_trace(lab)).entries; }
  converge(lab: number, methods: readonly string[], step: number | null, until: number | null): Convergence {
    return this.texts(methods, (at) => this.answer<Convergence>(lab, this.exports.lab_converge(lab, at, methods.length, NaNs(step), NaNs(until))));
  }
  compare(lab: number, methods: readonly string[], step: number | null, until: number | null): Comparison {
    type Row = Omit<CompareRow, 'invariants'> & { invariants: Record<string, Omit<Drift, 'name'>> };
    type Raw = Omit<Comparison, 'rows'> & { rows: Row[] };
    const raw = this.texts(methods, (at) => this.answer<Raw>(lab, this.exports.lab_compare(lab, at, methods.length, NaNs(step), NaNs(until))));
    return { ...raw, rows: raw.rows.map((row) => ({ ...row, invariants: Object.entries(row.invariants).map(([name, drift]) => ({ name, ...drift })) })) };
  }
  stability(lab: number, method: string, re: Float64Array, im: Float64Array): Float64Array {
    return this.texts([method], (name) => this.numbers(re, (x) => this.numbers(im, (y) => this.room(8 * re.length, (out) => {
      this.check(lab, this.exports.lab_stability(lab, name, re.length, x, y, out));
      return this.copy(out, re.length);
    }))));
  }
}
