/* What the page and its workers say to each other. Numbers are those of the core, bit for bit; arrays are one Float64Array per column.
 *
 * What comes from the core as JSON has the names that `motus --json` gives it, or else those of motus.h. */

/** A model and what replaces its parameters and initial values: "F=0.2", "x(0)=1", "r'(0)=(1, 2)", as `--set` of the program says it; and events besides its own, as `--when` does. */
export interface Model { readonly text: string; readonly set: readonly string[]; readonly when?: readonly string[] }

/** motus_error: what went wrong, where, and what would be right. line and column count from 1, in characters; 0: no place. */
export interface Problem {
  readonly kind: string; readonly message: string; readonly hint: string;
  readonly line: number; readonly column: number; readonly source: string; readonly caret: string;
  readonly time: number | null; readonly variable: string;
  /** The wrong word, at line and column; and what to write in its place. Without a word: a line to add. '': none. */
  readonly word: string; readonly instead: string;
}

export type ColumnKind = 'time' | 'position' | 'velocity' | 'first-order' | 'quantity' | 'invariant' | 'exact';
/** A number that can be looked at along a run; `variable` is the index of the variable, quantity or invariant it belongs to. */
export interface Column { readonly name: string; readonly kind: ColumnKind; readonly variable: number }

/** A state of the model: order 2 has x'' = …, order 1 is a first-order variable. components 0: scalar. */
export interface Variable { readonly name: string; readonly order: number; readonly components: number; readonly ranges: readonly (readonly [number, number])[]; readonly count: number }

/** A parameter, or an initial value "x(0)", "r'(0)": what a slider moves. values: its numbers; components 0: scalar; list: [a, b] rather than (a, b). */
export interface Parameter {
  readonly name: string; readonly components: number; readonly list: boolean; readonly values: readonly number[];
  /** As the model writes it; a slider is offered where this is a number, or a tuple of numbers. */
  readonly text: string; readonly initial: boolean;
}

/** A statement of the model typeset: one <math> element, well-formed XML. */
export interface Statement { readonly kind: string; readonly line: number; readonly mathml: string }

export interface Admission { readonly name: string; readonly admitted: boolean; readonly preserves: 'symplectic' | 'volume' | ''; readonly reason: string; readonly hint: string }

/** What the page itself has to say against something: no place in a text. */
export function problem(kind: string, message: string, hint = ''): Problem {
  return { kind, message, hint, line: 0, column: 0, source: '', caret: '', time: null, variable: '', word: '', instead: '' };
}
/** Those of a run which names none: motus_run_def. */
export const TOLERANCE = 1e-9, ACCURACY = 1e-9;
/** The method that the library chooses by the force, the end and the accuracy. */
export const AUTO = 'auto';
/** A run of more steps belongs to the program. */
export const STEPS_MAX = 1e7;

export interface Suggestion { readonly line: string; readonly why: string }

/** motus_word_kind, in its order. */
export const WORD_KINDS = ['known', 'unknown', 'number', 'comment', 'setting', 'function', 'operator', 'wrong'] as const;
export type WordKind = typeof WORD_KINDS[number];
/** A word of a text: from and to count UTF-16 units. */
export interface Word { readonly from: number; readonly to: number; readonly kind: WordKind }
/** The words of the language: functions; what begins a statement; t and pi; for, and … */
export interface Vocabulary { readonly functions: readonly string[]; readonly settings: readonly string[]; readonly names: readonly string[]; readonly operators: readonly string[] }

/** What the core understood of a model. */
export interface Description {
  readonly statements: readonly Statement[];
  readonly velocity_dependent: boolean; readonly time_dependent: boolean;
  /** The force has no abs, min, max, floor, mod, sign, if. */
  readonly smooth: boolean;
  readonly columns: readonly Column[]; readonly variables: readonly Variable[]; readonly parameters: readonly Parameter[];
  readonly settings: {
    readonly method: string; readonly step: number | null; readonly tolerance: number | null; readonly until: number | null; readonly start: number;
    /** step or until: not in the model, but the library's */ readonly suggested: boolean;
    /** absolute: the accuracy or the tolerance is. automatic: method and steps are the library's. */ readonly accuracy: number | null; readonly absolute: boolean; readonly automatic: boolean;
  };
  /** Lines that the text lacks and the core supposed, with the reason. */
  readonly suggestions: readonly Suggestion[];
  readonly has_exact: boolean;
  readonly methods: readonly Admission[];
}

/** Whether something happens at instants of the motion: it has `when` statements. */
export const eventful = ({ statements }: Description): boolean => statements.some(({ kind }) => kind === 'event');

/** A row of the catalogue of methods. */
export interface Method {
  readonly name: string; readonly aliases: readonly string[]; readonly title: string; readonly family: string;
  readonly order: number; readonly stages: number; readonly evaluations: number;
  readonly symplectic: boolean; readonly reversible: boolean; readonly stability_limit: number;
  /** adaptive: it chooses its steps by a tolerance. by_rates: its stability follows from hλ alone, whatever the force is made of. */
  readonly adaptive: boolean; readonly by_rates: boolean;
  readonly cite: string; readonly formula: string; readonly use: string;
}

/** Rows of the table of events (motus_event_row), in their order. A name has its indices; errors: of the times, NaN where they are not known; touched, changed: 0 or 1. before: columns on
 *  arrival; after: as the action left them. */
export interface Events {
  readonly names: readonly string[]; readonly times: Float64Array; readonly errors: Float64Array; readonly counts: Float64Array; readonly touched: Float64Array; readonly changed: Float64Array;
  readonly before: readonly Float64Array[]; readonly after: readonly Float64Array[];
}
/** ended: the kind of event that ended the run before its end. accumulates: the kind whose events come closer and closer together, ''; and then `accumulated`, the limit of their times,
 *  error null: not known. significant: so many rows of the table have a digit that is known. */
export interface Ended { readonly ended: string | null; readonly accumulates: string; readonly accumulated: { readonly time: number; readonly error: number | null } | null; readonly significant: number }

/** How far every number of the answer may be off, up to the end: relative to the largest of its kind so far, or absolute. */
export interface Aim { readonly accuracy: number; readonly absolute: boolean }
/** What came of it: the largest error that any number was found to have; why that is not enough, if so; why "auto" chose the method, ''; how many runs were tried. */
export interface Goal extends Aim { readonly reached: number; readonly missed: Problem | null; readonly choice: string; readonly trials: number }

/** The motion by one method. Row i is at times[i]; columns as asked for. Every `every`-th step is kept, and the last. */
export interface Track {
  /** Of an adaptive method, whose `step` is the mean one and whose `total` are the steps that it took; else null. */
  readonly tolerance: number | null;
  /** Steps that it took back. */
  readonly refused: number;
  /** Where an accuracy was asked for: method, tolerance and step are what was found for it. */
  readonly goal: Goal | null;
  readonly method: string; readonly times: Float64Array; readonly columns: readonly Float64Array[];
  readonly step: number; readonly steps: number; readonly total: number; readonly lastStep: number; readonly evaluations: number; readonly every: number;
  /** The table of its events, with the columns that were asked for; `count` in all, of which these are the first. null: the model has none. */
  readonly events: (Events & { readonly count: number }) | null;
  /** null: it came to its end, and no events accumulate. */
  readonly ended: Ended | null;
  /** The motion between the ends of long steps, by dense output: so many times, those of the steps among them, that straight lines between them cannot be told from it. Columns as
   *  asked for, empty where they are neither the state nor quantities. An event is two rows of the same time, what it came to and what it left, and where a number jumps there is
   *  NaN between them. null: there is none, or the rows are as near. For drawing. */
  readonly curve: { readonly times: Float64Array; readonly columns: readonly Float64Array[] } | null;
  /** Why it stopped before the end: with the time and the variable. What was computed until then stands. */
  readonly problem: Problem | null;
  /** Where it passes a singularity of the force, or does not resolve the force: what follows is not the motion. */
  readonly singular: Problem | null;
}

/** The exact motion or a reference, for positions, velocities, first-order variables and quantities (other columns are empty arrays). Times lie where straight lines between them
 *  cannot be told from the motion (sample.ts), not evenly. */
export interface Truth {
  readonly name: string; readonly error: number; readonly times: Float64Array; readonly columns: readonly Float64Array[];
  /** Of the columns; `error` is that of what errors of methods are measured against. */
  readonly off: number;
  /** The columns are a draft's: they may be drawn, since what they are off cannot be seen, but are no numbers to be told. */
  readonly coarse: boolean;
  /** What it took to compute, when it was computed. */
  readonly milliseconds: number;
}

/** How far one method is from the truth at each of the track's times (distance.ts): x: the distance of the positions, of several bodies that of the furthest; v: of the velocities;
 *  s: of first-order variables, the largest difference. Empty where there are none of a kind. which: of x, the body, by its number in bodies. */
export interface ErrorTrack {
  readonly method: string; readonly x: Float64Array; readonly v: Float64Array; readonly s: Float64Array; readonly which: Float64Array; readonly bodies: readonly string[];
}

export interface Solve {
  readonly model: Model; readonly methods: readonly string[];
  /** null: the model's. step: of methods of steps of one size; tolerance: of adaptive ones. */
  readonly step: number | null; readonly until: number | null; readonly tolerance: number | null;
  /** What is asked of those that `at` names, in place of a tolerance and a step. */
  readonly aim?: (Aim & { readonly at: readonly string[] }) | null;
  readonly columns: readonly string[];                              // names; [] means: all, up to a bound
  readonly rows: number;                                            // at most so many rows a track
  readonly truth: boolean;                                          // truth and errors as well: dearer where there is no exact motion
  readonly coarse?: boolean;                                        // the truth may be a coarse one, which is soon there; then without errors
  readonly unexamined?: boolean;                                    // Track.singular may stay unknown, which costs as much as the methods do
}
export interface Solution {
  readonly description: Description; readonly columns: readonly string[];
  readonly tracks: readonly Track[]; readonly truth: Truth | null; readonly errors: readonly ErrorTrack[];
  /** Of the truth, if that failed. */
  readonly problem: Problem | null;
  /** Whether Track.singular is known. */
  readonly examined: boolean;
  readonly milliseconds: number;
}

/** Bars of error along a run: at times, a column each of values and of bars. A bar is 0 where the number is exact, infinite where no digit of it is known, NaN where
 *  there is none, and then `reason` says why. */
export interface Bars {
  readonly method: string; readonly times: Float64Array; readonly values: readonly Float64Array[]; readonly bars: readonly Float64Array[]; readonly reason: string;
  /** The last values with their bars, as the program prints them. */
  readonly last: readonly string[];
  /** From this time on no digit is known; null: all along some are. */
  readonly until: number | null;
  /** Of the table of events: the time of each row with its error, as the program prints it, '' where there is none; and how many of the rows have a digit that is known. */
  readonly events: readonly string[]; readonly significant: number;
}
export interface Estimate { readonly reason: string; readonly significant_until: number | null }

/** One step opened up: motus_run_trace of include/motus.h, whose names and meanings these are. */
export interface TraceEntry {
  readonly kind: 'start' | 'kick' | 'drift' | 'stage' | 'solve' | 'taylor' | 'step' | 'end';
  readonly stage: number; readonly stages: number; readonly iterations: number;
  readonly time: number; readonly step: number; readonly coefficient: number; readonly weight: number; readonly weight_x: number;
  readonly row: readonly number[] | null; readonly row_x: readonly number[] | null;
  readonly x: readonly number[]; readonly v: readonly number[]; readonly a: readonly number[] | null;
  readonly before_x: readonly number[] | null; readonly before_a: readonly number[] | null;
  /** null: there is none, or it is not finite. */
  readonly error: number | null;
}
export type Refusal = Omit<TraceEntry, 'kind'> & { readonly kind: 'refused' };
/** refused: steps that were tried before this one; the other entries are this one's alone. */
export interface Trace { readonly refused: readonly Refusal[]; readonly method: string; readonly step: number; readonly index: number; readonly total: number; readonly entries: readonly TraceEntry[]; readonly names: { readonly x: readonly string[]; readonly v: readonly string[] } }

/** tolerance: of a method that chooses its steps; `step` is then the mean one. */
export interface ConvergePoint { readonly tolerance?: number; readonly step: number; readonly error: number | null; readonly evaluations: number; readonly used: boolean }
export interface ConvergeRow {
  readonly method: string; readonly declared: number; readonly observed: number | null; readonly standard_error: number | null;
  readonly exact_here: boolean; readonly passed: boolean; readonly points: readonly ConvergePoint[]; readonly certificate: string;
  /** It has neither passed nor failed: too few of its errors lie between the coarsest steps and round-off. */
  readonly uncertain: boolean;
  /** Of a method that chooses its steps: the power of the tolerance with which its error falls; null: it cannot be told. */
  readonly power?: number | null;
}
export interface Convergence { readonly rows: readonly ConvergeRow[]; readonly reference: string; readonly reference_error: number }

export interface Drift { readonly name: string; readonly initial: number; readonly final: number; readonly max_drift: number; readonly trend: number; readonly trending: boolean }
export interface CompareRow {
  readonly method: string; readonly order: number; readonly status: string; readonly step: number; readonly steps: number; readonly evaluations: number;
  readonly error_max: number | null; readonly error_max_v: number | null; readonly error_final: number | null; readonly error_max_s: number | null; readonly reversal: number | null;
  readonly invariants: readonly Drift[]; readonly note: string;
}
export interface Comparison { readonly rows: readonly CompareRow[]; readonly reference: string; readonly reference_error: number; readonly remarks: readonly string[] }

/** Where hλ must lie: growth[i + width j] is the growth of one step at z = re[i] + i im[j]; NaN where the method has no answer. */
export interface Region { readonly method: string; readonly re: Float64Array; readonly im: Float64Array; readonly growth: Float64Array }
/** Eigenvalues λ of the model linearised at its start (and along the run, if asked). */
export interface Spectrum {
  readonly re: Float64Array; readonly im: Float64Array;
  /** The force depends on neither position nor velocity there. */
  readonly free: boolean;
  /** Velocities enter by friction alone (∂a/∂v is symmetric), and first-order variables do not act back. */
  readonly springs: boolean;
  readonly linear: Linear;
}
/** The motion linearised: nv accelerations and rates, row by row, by nx positions and by nv velocities and first-order variables. */
export interface Linear { readonly nx: number; readonly nv: number; readonly x: Float64Array; readonly v: Float64Array }

export interface Requests {
  catalogue: { ask: Record<string, never>; answer: readonly Method[] };
  describe: { ask: { model: Model }; answer: Description };
  /** Also of a text that is no model. */
  words: { ask: { text: string }; answer: readonly Word[] };
  vocabulary: { ask: Record<string, never>; answer: Vocabulary };
  solve: { ask: Solve; answer: Solution };
  /** At most `rows` of the method's steps, and the end. */
  bars: { ask: { model: Model; method: string; step: number | null; tolerance: number | null; until: number | null; columns: readonly string[]; rows: number }; answer: Bars };
  trace: { ask: { model: Model; method: string; step: number | null; tolerance: number | null; until: number | null; index: number }; answer: Trace };
  converge: { ask: { model: Model; methods: readonly string[]; step: number | null; until: number | null }; answer: Convergence };
  compare: { ask: { model: Model; methods: readonly string[]; step: number | null; until: number | null }; answer: Comparison };
  region: { ask: { method: string; re: readonly [number, number]; im: readonly [number, number]; width: number; height: number }; answer: Region };
  /** Growth of one step at single points z = re[i] + i im[i]. */
  growth: { ask: { method: string; re: readonly number[]; im: readonly number[] }; answer: Float64Array };
  /** Growth of one step on linearised motions: [i · count + j] at step j of motion i. */
  linear: { ask: { method: string; moments: readonly Linear[]; steps: readonly (readonly number[])[] }; answer: Float64Array };
  /** States that events of a kind leave, along a run from this state (positions, then velocities and first-order variables): those behind the first `have`, up to `most` in all, as far as the milliseconds
   *  go. time: of the last of so many, or how far the run has come. done: it has ended. */
  section: {
    ask: { model: Model; method: string; step: number | null; tolerance: number | null; from: readonly number[]; kind: string; columns: readonly string[]; have: number; most: number; milliseconds: number };
    answer: { readonly columns: readonly Float64Array[]; readonly time: number; readonly done: boolean; readonly problem: Problem | null };
  };
  /** The state nearest to another one in which columns have these values, the expression `surface` is 0 ('': none is asked for), and invariants have their values. */
  through: { ask: { model: Model; near: readonly number[]; columns: readonly string[]; values: readonly number[]; surface: string; keep: readonly { readonly name: string; readonly value: number }[] }; answer: readonly number[] };
  spectrum: { ask: { model: Model; method: string; step: number | null; tolerance: number | null; until: number | null; times: readonly number[] }; answer: readonly Spectrum[] };
}
export type Ask = keyof Requests;
export interface Question<K extends Ask = Ask> { readonly id: number; readonly kind: K; readonly ask: Requests[K]['ask'] }
export type Reply = { readonly id: number; readonly answer: unknown } | { readonly id: number; readonly problem: Problem };
