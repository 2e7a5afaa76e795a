/* The answers to the page's questions, from the core. Runs in a worker (worker.ts).
 *
 * A model may come from a stranger's address: steps, numbers and rows are bounded here, memory by the module itself.
 */
import { EigenvalueDecomposition, Matrix } from 'ml-matrix';
import type { Core } from './core';
import { QUANTITY, breaksOf, draft, told as toldBy } from './draft';
import { bodiesOf, distances } from './distance';
import { growthsOf } from './linear';
import { AUTO, STEPS_MAX, TOLERANCE, eventful, problem } from './protocol';
import type {
  Aim, Ask, Bars, Convergence, Description, ErrorTrack, Goal, Model, Problem, Region, Requests, Solution, Solve, Spectrum, Trace, Track, Truth,
} from './protocol';
import { brief, grouped } from './figure/number';
import { SEEN, broken, sample, type Curve, type Motion } from './sample';
import { Refused } from './scene';
import { Sections } from './sections';
import { atTolerances } from './tolerances';
import { computed } from './words';

const NUMBERS_MAX = 4e6, NUMBERS_ENOUGH = 1e5, ROWS_ENOUGH = 1500;      // of one track: never more; beyond this fewer rows, down to so many
const COLUMNS_MAX = 256;
/* Of a curve that is drawn as the exact motion; times the rows that are asked for, while they are few. Milliseconds: of a draft, and of reading a curve. */
const POINTS_MAX = 20_000, POINTS_A_ROW = 3, TRUTH_NUMBERS_MAX = 2e6, DRAFT_LIMIT = 4000, CURVE_LIMIT = { moving: 60, coarse: 600, certified: 1500 };
/* Of the curve of one run between the ends of its steps. */
const CURVED_NUMBERS_MAX = 4e5;
/* Of the tables of events that are shown and drawn, and whose times are told with their errors. */
const EVENT_NUMBERS_MAX = 4e5, EVENTS_LEAST = 16, EVENTS_TOLD = 1000;
/* Times in a row at which a reference is asked first, to see how long it takes. */
const TRIED = 16;
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

/** A run that was recorded: rows of numbers, and all of the track but its arrays. */
interface Recorded { readonly values: Float64Array; readonly track: Omit<Track, 'times' | 'columns' | 'curve'>; readonly curve: Curve | null; readonly examined: boolean }
/** How a run reaches an accuracy. */
interface Found { readonly method: string; readonly step: number | null; readonly tolerance: number | null; readonly goal: Goal }
/** A curve of the state, all positions and then all velocities, and of the quantities, for one model and end. off, coarse: of the curve; most: the number of points that it was
 *  allowed. */
interface Told {
  readonly key: string; readonly name: string; readonly error: number; readonly motion: Motion; readonly curve: Curve; readonly off: number; readonly coarse: boolean;
  readonly most: number; readonly milliseconds: number;
}

/** Without the columns of which nothing is known. */
const shownOf = ({ times, columns }: Curve, noise: readonly number[]): Curve => ({ times, columns: columns.map((column, k) => (noise[k] === Infinity ? new Float64Array(0) : column)) });

/** The truth at some times, `of` the reference that told it. */
interface Known { readonly of: object | null; readonly times: Float64Array; readonly x: Float64Array; readonly v: Float64Array }

export class Answers {
  private readonly lab: number;
  private opened = '';                   // the model that is open, as a key
  private description: Description | null = null;
  private adapting: Set<string> | null = null;
  private reference: { key: string; name: string; error: number; milliseconds: number } | null = null;

  private sections: Sections | null = null;
  private known: Known | null = null;
  /** Of the last question, by method: what is asked again with more is not computed again. */
  private recorded = new Map<string, Recorded>();
  private recordedFor = '';
  private readonly found = new Map<string, Found>();
  private readonly told: { coarse: Told | null; certified: Told | null } = { coarse: null, certified: null };

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
      bars: (question) => this.bars(question),
      trace: (question) => this.trace(question),
      converge: (question) => this.converge(question),
      compare: ({ model, methods, step, until }) => {
        this.open(model);
        return this.core.compare(this.lab, methods, step, until);
      },
      region: (question) => this.region(question),
      growth: ({ method, re, im }) => this.growth(method, Float64Array.from(re), Float64Array.from(im)),
      linear: ({ method, moments, steps }) => growthsOf(this.core, method, moments, steps),
      section: (question) => (this.sections ??= new Sections(this.core)).fill(question),
      through: (question) => (this.sections ??= new Sections(this.core)).through(question),
      spectrum: (question) => this.spectrum(question),
    };
    return all[kind](ask);
  }

  private open(model: Model): Description {
    const key = JSON.stringify([model.text, model.set]);
    if (key !== this.opened || !this.description) {
      this.opened = '';
      this.reference = this.told.coarse = this.told.certified = null;
      this.core.open(this.lab, model);
      this.description = this.core.describe(this.lab);
      this.opened = key;
    }
    return this.description;
  }

  private adaptive(method: string): boolean {
    this.adapting ??= new Set([AUTO, ...this.core.catalogue(this.lab).filter((m) => m.adaptive).map((m) => m.name)]);
    return this.adapting.has(method);
  }

  private start(method: string, { step, tolerance, until }: Pick<Solve, 'step' | 'tolerance' | 'until'>, bars = false): void {
    const adaptive = this.adaptive(method), own = tolerance ?? (method === AUTO ? this.description?.settings.tolerance ?? TOLERANCE : null);
    this.core.start(this.lab, method, adaptive ? null : step, until, adaptive ? own : null, bars);
    const { total, step: h } = this.core.progress(this.lab);
    if (total > STEPS_MAX) {
      throw limit(computed.steps(grouped(total), brief(h, 6), grouped(STEPS_MAX)), computed.nearer);
    }
  }

  private solve(ask: Solve): Solution {
    const began = performance.now();
    const description = this.open(ask.model);
    const names = description.columns.map((c) => c.name);
    const wanted = ask.columns.length > 0 ? ask.columns : names.slice(0, COLUMNS_MAX);
    const indices = wanted.map((name) => {
      const k = names.indexOf(name);
      if (k < 0) throw limit(computed.column(name), computed.columns(names.slice(0, 12)));
      return k;
    });
    const nx = this.core.positions(this.lab), nv = this.core.velocities(this.lab);
    // Errors need every position and velocity; small models are recorded whole.
    const whole = ask.truth && nx + nv <= COLUMNS_MAX;
    const all = [0, ...indices], states = Array.from({ length: whole ? nx + nv : 0 }, (_, k) => {
      if (!all.includes(1 + k)) all.push(1 + k);
      return all.indexOf(1 + k);
    });
    const runs = this.record(ask, all), tracks = runs.map((run) => this.track(run, all.length, indices.length));
    let truth: Truth | null = null, problem: Problem | null = null;
    const errors: ErrorTrack[] = [];
    if (whole) {
      try {
        truth = this.truth(ask, wanted, indices, nx, nv);
        // A coarse truth is nothing to measure by; a reference may have had to make way for one.
        const measures = truth && !(truth.coarse && (ask.coarse || eventful(description)));
        if (measures && tracks.length > 0) this.openReference(ask);
        if (measures) tracks.forEach((track, k) => errors.push(this.errors(track, runs[k]!.values, all.length, states, nx, nv)));
      } catch (e) {
        if (!(e instanceof Refused)) throw e;
        problem = e.problem;
      }
    }
    return { description, columns: wanted, tracks, truth, errors, problem, examined: !ask.unexamined, milliseconds: performance.now() - began };
  }

  /** The runs of all methods, each once: "auto" may have found one of the others. Those of the last question are kept: a picture is asked for first, then the same with the truth. */
  private record(ask: Solve, all: readonly number[]): Recorded[] {
    const key = JSON.stringify([this.opened, ask.step, ask.tolerance, ask.aim, ask.until, ask.rows, all]), runs = new Map<string, Recorded>();
    const kept = key === this.recordedFor ? this.recorded : new Map<string, Recorded>();
    let numbers = 0;
    for (const method of ask.methods) {
      const made = kept.get(method) ?? this.run(method, ask, all), found = kept.has(method) ? made : { ...made, curve: made.curve ?? this.curved(made, ask, all) };
      const run = ask.unexamined || found.examined ? found : this.examined(found, ask);
      runs.set(method, run);
      numbers += run.values.length;
    }
    // A question without methods is one for the truth alone.
    if (ask.methods.length > 0) {
      this.recorded = numbers <= NUMBERS_MAX ? runs : new Map();
      this.recordedFor = key;
    }
    const list = [...runs.values()];
    return list.filter(({ track }, k) => list.findIndex((other) => other.track.method === track.method) === k);
  }

  private run(method: string, ask: Solve, all: readonly number[]): Recorded {
    if (!ask.aim?.at.includes(method)) return this.taken(method, ask, all);
    const { method: found, step, tolerance, goal } = this.reached(method, ask.aim, ask.until), run = this.taken(found, { ...ask, step, tolerance }, all);
    return { ...run, track: { ...run.track, goal } };
  }

  /** What is found for an accuracy: a run like any other. It is searched for once. */
  private reached(method: string, aim: Aim, until: number | null): Found {
    const key = JSON.stringify([this.opened, method, aim.accuracy, aim.absolute, until]), known = this.found.get(key);
    if (known) return known;
    const { accuracy, absolute } = aim;
    let missed: Problem | null = null, reached = Infinity, choice = '', trials = 0;
    try {
      this.core.aim(this.lab, method, aim, until);
      ({ reached, trials } = this.core.progress(this.lab));
      choice = this.core.choice(this.lab);
      // At its end, where the last trial stands already, it says what it lacks.
      if (!(reached <= accuracy)) this.core.advance(this.lab, Number.MAX_SAFE_INTEGER);
    } catch (e) {
      if (!(e instanceof Refused) || e.problem.kind !== 'accuracy') throw e;
      missed = e.problem;
      // Where no accuracy can be promised at all, the picture is of a tolerance that would be tried first.
      if (trials === 0) this.start(method, { step: null, tolerance: absolute ? TOLERANCE : Math.max(1e-14, accuracy / 10), until });
    }
    const { tolerance, step } = this.core.progress(this.lab), adaptive = Number.isNaN(step);
    const found = { method: this.core.method(this.lab), step: adaptive ? null : step, tolerance: adaptive ? tolerance : null, goal: { accuracy, absolute, reached, missed, choice, trials } };
    if (this.found.size > 50) this.found.clear();
    this.found.set(key, found);
    return found;
  }

  private taken(method: string, ask: Solve, all: readonly number[]): Recorded {
    const run = this.stepped(method, ask, all);
    if (!eventful(this.description as Description)) return run;
    const ended = this.core.ended(this.lab), table = this.happened(all), { values } = run;
    const columns = all.map((_, c) => column(values, all.length, c)), curve = broken({ times: columns[0]!, columns: columns.slice(1) }, breaksOf(table), true);
    return { ...run, curve: table.times.length && run.track.tolerance === null ? curve : null, track: { ...run.track, events: table, ended: ended.ended || ended.accumulated ? ended : null } };
  }

  /** The table of events of the run as it stands, with columns `all` but the time. */
  private happened(all: readonly number[]): NonNullable<Track['events']> {
    const count = this.core.eventCount(this.lab), most = Math.max(EVENTS_LEAST, Math.floor(EVENT_NUMBERS_MAX / (2 * all.length)));
    return { ...this.core.events(this.lab, all.slice(1), 0, Math.min(count, most)), count };
  }

  private stepped(method: string, ask: Solve, all: readonly number[]): Recorded {
    this.start(method, ask);
    const { total, step, last } = this.core.progress(this.lab);
    const enough = Math.max(ROWS_ENOUGH, Math.floor(NUMBERS_ENOUGH / all.length));
    const rows = Math.max(2, Math.min(ask.rows, enough, Math.floor(NUMBERS_MAX / all.length)));
    if (this.adaptive(method)) return this.adapted(all, rows);
    const every = Math.max(1, Math.ceil(total / (rows - 1)));
    const { values, problem } = this.core.record(this.lab, all, every, rows, true);
    const now = this.core.progress(this.lab);
    return { values, curve: null, examined: false, track: { method, tolerance: null, refused: 0, goal: null, step, steps: now.steps, total, lastStep: last, evaluations: now.evaluations, every, problem, singular: null, events: null, ended: null } };
  }

  /** How many steps an adaptive method takes is known at its end: whenever the rows are full every second one goes, and from then on half as many are kept. */
  private adapted(all: readonly number[], rows: number): Recorded {
    const width = all.length, most = Math.max(3, rows | 1), values = new Float64Array(width * most);
    let every = 1, count = 0, problem: Problem | null = null;
    for (;;) {
      const found = this.core.record(this.lab, all, every, most - count, count === 0), now = this.core.progress(this.lab);
      values.set(found.values, width * count);
      count += found.rows;
      problem = found.problem;
      if (problem || now.done) break;
      if (now.steps > STEPS_MAX) throw limit(computed.adapting(grouped(now.steps)), computed.nearer);
      for (let i = 1; 2 * i < count; i++) values.copyWithin(width * i, width * 2 * i, width * (2 * i + 1));
      count = (count + 1) / 2;
      every *= 2;
    }
    const now = this.core.progress(this.lab), step = now.steps > 0 ? Math.abs(now.time - (values[0] as number)) / now.steps : 0;
    const track = { method: this.core.method(this.lab), tolerance: now.tolerance, refused: now.refused, goal: null, step, steps: now.steps, total: now.steps, lastStep: 0, evaluations: now.evaluations, every, problem, singular: null, events: null, ended: null };
    return { values: values.slice(0, width * count), curve: null, examined: false, track };
  }

  /** What is seen of a run between the ends of its steps; columns: of the core, `all` of them are recorded. */
  private curved(run: Recorded, ask: Solve, all: readonly number[]): Curve | null {
    const { values, track } = run, nx = this.core.positions(this.lab), nv = this.core.velocities(this.lab), rows = values.length / all.length;
    const columns = [...Array.from({ length: nx + nv }, (_, k) => 1 + k), ...this.quantities(nx + nv)], places = columns.map((k) => all.indexOf(k)), most = Math.floor(CURVED_NUMBERS_MAX / columns.length);
    if (track.tolerance === null || track.every > 1 || rows < 2 || 2 * rows > most || places.includes(-1)) return null;
    const times = column(values, all.length, 0), begun = { times, columns: places.map((k) => column(values, all.length, k)) };
    const { events } = track, pick = (of: readonly Float64Array[]): readonly Float64Array[] => places.map((k) => of[k - 1]!);
    const motion: Motion = {
      from: times[0]!, to: times[rows - 1]!, slopes: columns.map((_, k) => (k < nx ? nx + k : -1)), noise: columns.map(() => 0),
      ...(events ? { breaks: breaksOf({ ...events, before: pick(events.before), after: pick(events.after) }) } : {}),
      ask: (at) => {
        this.start(track.method, { step: null, tolerance: track.tolerance, until: ask.until });
        const found = this.core.sample(this.lab, at, columns);
        return columns.map((_, k) => column(found, columns.length, k));
      },
    };
    try {
      const curve = sample(motion, { tolerance: SEEN, points: Math.min(most, POINTS_A_ROW * ask.rows), milliseconds: ask.unexamined ? CURVE_LIMIT.moving : CURVE_LIMIT.coarse }, null, begun);
      return { times: curve.times, columns: all.slice(1).map((k) => (k === 0 ? curve.times : curve.columns[columns.indexOf(k)] ?? new Float64Array(0))) };
    } catch (e) {
      // Dense output may not be had: the ends of the steps are.
      if (!(e instanceof Refused) || e.problem.kind === 'memory') throw e;
      return null;
    }
  }

  private examined({ values, curve, track }: Recorded, { step, until }: Solve): Recorded {
    const singular = track.problem ? null : this.core.singular(this.lab, track.method, track.tolerance !== null ? null : track.goal ? track.step : step, until, track.tolerance);
    return { values, curve, examined: true, track: { ...track, singular } };
  }

  private track({ values, curve, track }: Recorded, width: number, count: number): Track {
    const few = (of: readonly Float64Array[]): Float64Array[] => of.slice(0, count).map((c) => c.slice()), { events } = track;
    const table = events && { ...events, times: events.times.slice(), errors: events.errors.slice(), counts: events.counts.slice(), touched: events.touched.slice(), changed: events.changed.slice(), before: few(events.before), after: few(events.after) };
    return { ...track, events: table, curve: curve && { times: curve.times.slice(), columns: curve.columns.slice(0, count).map((c) => c.slice()) }, times: column(values, width, 0), columns: Array.from({ length: count }, (_, c) => column(values, width, 1 + c)) };
  }

  /** The reference of one model and end serves every step: what a step says of it is but a hint. */
  private openReference(ask: Solve): { name: string; error: number; milliseconds: number } {
    const key = String(ask.until);
    if (this.reference?.key !== key) {
      this.reference = null;
      const began = performance.now();
      this.reference = { key, ...this.core.reference(this.lab, ask.step, ask.until), milliseconds: performance.now() - began };
    }
    return this.reference;
  }

  /** null: a coarse one is asked for, and there is none. */
  private truth(ask: Solve, names: readonly string[], indices: readonly number[], nx: number, nv: number): Truth | null {
    const { start, until } = this.span(ask), numbers = nx + nv, quantities = this.quantities(numbers);
    const slopes = Array.from({ length: numbers + quantities.length }, (_, k) => (k < nx ? nx + k : -1));
    const most = Math.max(2, Math.min(POINTS_MAX, POINTS_A_ROW * ask.rows, Math.floor(TRUTH_NUMBERS_MAX / slopes.length)));
    const key = String(ask.until), had = (told: Told | null): boolean => told?.key === key && (told.most >= most || told.curve.times.length < told.most);
    // What happens on the way is known of runs alone.
    const drafts = eventful(this.description as Description);
    let told = had(this.told.certified) ? this.told.certified : null;
    if (!told && (ask.coarse || drafts) && !this.description?.has_exact) {
      told = had(this.told.coarse) ? this.told.coarse : this.drafted(key, ask.model.text, { from: start, to: until, slopes }, quantities, most);
      this.told.coarse = told;
      if (!told) return null;
    }
    if (!told) {
      told = this.certified(key, ask, { from: start, to: until, slopes, ask: (times) => toldBy(this.core, this.lab, times, quantities) }, numbers, most, had(this.told.coarse) ? this.told.coarse : null);
      this.told.certified = told;
    }
    const { times, columns } = told.curve;
    return {
      name: told.name, error: told.error, off: told.off, coarse: told.coarse, milliseconds: told.milliseconds, times: times.slice(),
      columns: names.map((_, k) => {
        const index = indices[k] as number;
        const at = index <= numbers ? index - 1 : quantities.includes(index) ? numbers + quantities.indexOf(index) : -1;
        return index === 0 ? times.slice() : columns[at]?.slice() ?? new Float64Array(0);
      }),
    };
  }

  /** The curve of the reference; or that of the draft, where the reference would take too long to tell one, and is there for the errors alone. */
  private certified(key: string, ask: Solve, span: Omit<Motion, 'noise'>, numbers: number, most: number, before: Told | null): Told {
    const { name, error, milliseconds } = this.openReference(ask), began = performance.now(), known = before?.curve.times ?? null;
    const motion = { ...span, noise: span.slopes.map((_, k) => (k < numbers ? error : QUANTITY * error)) };
    const spent = (): number => milliseconds + performance.now() - began;
    if (before && known) {
      // Some that follow each other, at several places: those that lie apart cost the steps between them.
      const rates = [0.1, 0.3, 0.6, 0.9].map((part) => {
        const times = known.subarray(Math.floor(part * known.length), Math.floor(part * known.length) + TRIED), start = performance.now();
        motion.ask(times);
        return (performance.now() - start) / times.length;
      });
      // A pause of the machine in one or two of them is not the reference's.
      const each = rates.sort((p, q) => p - q)[1]!;
      if (each * known.length > CURVE_LIMIT.certified) {
        return { ...before, name, error, curve: shownOf(sample(before.motion, { tolerance: SEEN, points: most, milliseconds: CURVE_LIMIT.certified }, known), before.motion.noise), milliseconds: spent() };
      }
    }
    // What the draft found out of where the motion bends is so still.
    const curve = sample(motion, { tolerance: SEEN, points: most, milliseconds: CURVE_LIMIT.certified }, known);
    return { key, name, error, motion, curve, off: error, coarse: false, most, milliseconds: spent() };
  }

  private drafted(key: string, text: string, span: Omit<Motion, 'noise' | 'ask'>, quantities: readonly number[], most: number): Told | null {
    const began = performance.now();
    this.reference = null;
    const found = draft(this.core, this.lab, this.description as Description, text, quantities, this.core.catalogue(this.lab), span, DRAFT_LIMIT);
    if (!found) return null;
    const motion = { ...span, to: found.to, ...(found.breaks ? { breaks: found.breaks } : {}), noise: [...span.slopes.slice(quantities.length).map(() => 0), ...found.off], ask: (times: Float64Array) => found.ask(times) };
    const curve = shownOf(sample(motion, { tolerance: SEEN, points: most, milliseconds: CURVE_LIMIT.coarse }, null, found.begun), motion.noise);
    return { key, name: found.name, error: found.error, motion, curve, off: found.error, coarse: true, most, milliseconds: performance.now() - began };
  }

  /** Quantities that are drawn as the exact motion too, where there are not too many numbers. */
  private quantities(numbers: number): number[] {
    const all = (this.description as Description).columns.flatMap(({ kind }, index) => (kind === 'quantity' ? [index] : []));
    return all.length + numbers <= COLUMNS_MAX ? all : [];
  }

  /** When the motion starts, and when it ends. */
  private span(ask: Pick<Solve, 'until'>): { start: number; until: number } {
    const settings = (this.description as Description).settings, until = ask.until ?? settings.until;
    if (until === null) throw limit(computed.noEnd, computed.end);
    return { start: settings.start, until };
  }

  /** Methods with the same step are looked at at the same times: the truth there is asked for once. */
  private truthAt(times: Float64Array): { x: Float64Array; v: Float64Array } {
    let known = this.known;
    if (known?.of !== this.reference || known.times.length !== times.length || !known.times.every((t, i) => t === times[i])) {
      this.known = known = { of: this.reference, times: times.slice(), ...this.core.referenceAt(this.lab, times) };
    }
    return known;
  }

  /** states: where in a row of values each position and velocity stands. */
  private errors(track: Track, values: Float64Array, width: number, states: readonly number[], nx: number, nv: number): ErrorTrack {
    const rows = track.times.length, truth = this.truthAt(track.times);
    const bodies = bodiesOf((this.description as Description).columns.slice(1, 1 + nx).map((c) => c.name));
    const at = (i: number, state: number): number => values[i * width + (states[state] as number)] as number;
    const x = distances(rows, bodies, (i, k) => at(i, k) - (truth.x[i * nx + k] as number)), v = distances(rows, bodies, (i, k) => at(i, nx + k) - (truth.v[i * nv + k] as number));
    const s = distances(rows, Array.from({ length: nv - nx }, (_, k) => ({ label: '', parts: [nx + k] })), (i, k) => at(i, nx + k) - (truth.v[i * nv + k] as number));
    return { method: track.method, x: x.far, v: v.far, s: s.far, which: x.which, bodies: bodies.map((b) => b.label) };
  }

  /** Bars at rows that are as far apart as those of a run that is thinned; where steps adapt the companion lands after each of them anyway. */
  private bars(ask: Requests['bars']['ask']): Bars {
    const names = this.open(ask.model).columns.map((c) => c.name), columns = ask.columns.map((name) => names.indexOf(name)).filter((k) => k >= 0), all = [0, ...columns];
    this.start(ask.method, ask, true);
    const { total } = this.core.progress(this.lab), rows: { values: Float64Array; errors: Float64Array }[] = [];
    let every = Math.max(1, Math.ceil(total / ask.rows));
    for (;;) {
      rows.push(this.core.errors(this.lab, all));
      if (this.core.progress(this.lab).done) break;
      if (rows.length > 2 * ask.rows) {
        for (let i = 1; 2 * i < rows.length; i++) rows[i] = rows[2 * i]!;
        rows.length = (rows.length + 1) >> 1;
        every *= 2;
      }
      try {
        this.core.advance(this.lab, every);
      } catch (e) {
        if (!(e instanceof Refused) || e.problem.kind === 'memory') throw e;
        break;
      }
    }
    const { reason, significant_until: until } = this.core.estimate(this.lab), of = (k: number, which: 'values' | 'errors'): Float64Array => Float64Array.from(rows, (row) => row[which][k]!);
    const events = this.core.eventCount(this.lab), { times: at, errors: off } = this.core.events(this.lab, [], 0, Math.min(events, EVENTS_TOLD));
    return {
      events: Array.from(at, (t, k) => (Number.isNaN(off[k]) ? '' : this.core.bar(this.lab, t, off[k]!))), significant: events ? this.core.ended(this.lab).significant : 0,
      method: ask.method, times: of(0, 'values'), last: columns.map((_, k) => this.core.bar(this.lab, rows[rows.length - 1]!.values[1 + k]!, rows[rows.length - 1]!.errors[1 + k]!)), values: columns.map((_, k) => of(1 + k, 'values')), bars: columns.map((_, k) => of(1 + k, 'errors')), reason, until,
    };
  }

  private trace(ask: Requests['trace']['ask']): Trace {
    const description = this.open(ask.model);
    this.start(ask.method, ask);
    const { total } = this.core.progress(this.lab);
    const index = Math.max(0, total > 0 ? Math.min(ask.index, total - 1) : ask.index);
    if (index > 0) this.core.advance(this.lab, index);
    const all = this.core.trace(this.lab), refused = all.filter((e) => e.kind === 'refused'), entries = all.filter((e) => e.kind !== 'refused');
    const nx = this.core.positions(this.lab), nv = this.core.velocities(this.lab);
    const names = description.columns.map((c) => c.name);
    const { step } = this.core.progress(this.lab);
    return {
      method: this.core.method(this.lab), step: Number.isNaN(step) ? Math.abs(entries[0]?.step ?? 0) : step, index, total, entries, refused,
      names: { x: names.slice(1, 1 + nx), v: names.slice(1 + nx, 1 + nx + nv) },
    };
  }

  /** Those that choose their steps are measured over the same part of the motion as the others. */
  private converge({ model, methods, step, until }: Requests['converge']['ask']): Convergence {
    const description = this.open(model), choosing = methods.filter((method) => this.adaptive(method)), others = methods.filter((method) => !this.adaptive(method));
    const found = others.length ? this.core.converge(this.lab, others, step, until) : null;
    if (!choosing.length) return found ?? this.core.converge(this.lab, methods, step, until);
    const { start, until: end } = this.span({ until }), cut = Number(/; until (\S+), not /.exec(found?.reference ?? '')?.[1] ?? end);
    this.reference = null;
    const { name, error } = this.core.reference(this.lab, null, cut), rows = atTolerances(this.core, this.lab, choosing, this.core.catalogue(this.lab), description, { from: start, to: cut }, error);
    const all = [...(found?.rows ?? []), ...rows];
    return { rows: methods.flatMap((method) => all.filter((row) => row.method === method)), reference: found?.reference ?? name, reference_error: found?.reference_error ?? error };
  }

  private growth(method: string, re: Float64Array, im: Float64Array): Float64Array {
    if (re.length !== im.length || re.length > REGION_MAX) throw limit(computed.points(String(re.length)), computed.mostPoints(String(REGION_MAX)));
    return this.core.stability(this.lab, method, re, im);
  }

  private region({ method, re, im, width, height }: Requests['region']['ask']): Region {
    if (!(width > 0 && height > 0 && width * height <= REGION_MAX)) throw limit(computed.region(String(width), String(height)), computed.mostPoints(String(REGION_MAX)));
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
    if (n > EIGENVALUES_MAX) throw limit(computed.eigenvalues(String(n)), computed.most(String(EIGENVALUES_MAX)));
    this.start(ask.method, ask);
    const out: Spectrum[] = [];
    for (const time of [...ask.times].sort((a, b) => a - b)) {
      let now = this.core.progress(this.lab);
      const steps = Math.round(Math.abs(time - now.time) / Math.abs(now.step));
      if (steps > 0 && !now.done) this.core.advance(this.lab, steps);
      // Where steps adapt, the first that reaches the time.
      for (const from = now.time; Number.isNaN(now.step) && !now.done && Math.abs(now.time - from) < Math.abs(time - from); now = this.core.progress(this.lab)) this.core.advance(this.lab, 1);
      const { byX, byV } = this.core.jacobian(this.lab);
      const matrix = Matrix.zeros(n, n);
      for (let i = 0; i < nx; i++) matrix.set(i, nx + i, 1);
      for (let i = 0; i < nv; i++) {
        for (let k = 0; k < nx; k++) matrix.set(nx + i, k, byX[i * nx + k] as number);
        for (let k = 0; k < nv; k++) matrix.set(nx + i, nx + k, byV[i * nv + k] as number);
      }
      const { realEigenvalues, imaginaryEigenvalues } = new EigenvalueDecomposition(matrix);
      out.push({
        re: Float64Array.from(realEigenvalues), im: Float64Array.from(imaginaryEigenvalues), free: byX.every((d) => d === 0) && byV.every((d) => d === 0), springs: springs(byV, nx, nv), linear: { nx, nv, x: byX, v: byV },
      });
    }
    return out;
  }
}

/** The part of ∂a/∂v that belongs to the positions is symmetric up to rounding, and first-order variables neither act on them nor on each other. */
function springs(byV: Float64Array, nx: number, nv: number): boolean {
  let most = 0, off = 0;
  for (let i = 0; i < nv; i++) {
    for (let k = 0; k < nv; k++) {
      const d = byV[i * nv + k]!;
      if (k >= nx && d !== 0) return false;
      if (i >= nx || k >= nx) continue;
      most = Math.max(most, Math.abs(d));
      off = Math.max(off, Math.abs(d - byV[k * nv + i]!));
    }
  }
  return off <= 1e-12 * most;
}

/** An answer or a problem, whatever happens: nothing is thrown past here. */
export function reply(answers: Answers, id: number, kind: Ask, ask: unknown): { id: number; answer: unknown } | { id: number; problem: Problem } {
  try {
    return { id, answer: answers.answer(kind, ask as Requests[Ask]['ask'] & never) };
  } catch (e) {
    if (e instanceof Refused) return { id, problem: e.problem };
    // A trap: the stack or the memory of the module, or of the browser, was not enough.
    return { id, problem: problem('memory', computed.room(e instanceof Error ? e.message : String(e)), computed.smaller) };
  }
}
