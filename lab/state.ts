/* The state of the page, and what the core made of it.
 *
 * Invariant: at most one solve is under way; a newer state replaces one that waits, and no answer is shown with another state than its own. `scene` is
 * always the latest state that could be computed, and stays while the reader types something that cannot; what is wrong with the present state stands
 * beside it, in `trouble`. The picture comes first, then the exact motion as a draft (draft.ts), then the reference with the errors of all methods.
 * A state is looked at once per frame at most, so a dragged slider costs no more than the picture it makes.
 */
import { looksOf } from './figure/ink';
import { brief } from './figure/number';
import { ACCURACY, AUTO, STEPS_MAX, problem, type Aim, type Description, type Method, type Problem, type Solution } from './protocol';
import { Refused, UNASKED, type Client, type Run, type Scene, type State, type Store, type View } from './scene';
import { normal, plain, short } from './shell/number';
import { words } from './words';

export interface Trouble {
  readonly model: Problem | null;               // the text, or a replaced parameter
  readonly run: Problem | null;                 // the computation as a whole
  readonly step: string; readonly tolerance: string; readonly accuracy: string; readonly until: string; readonly methods: string;       // sentences; '' where all is well
  /** The computation goes on nevertheless. */
  readonly remark: string;
}
/** state: what the reader chose; view: how it is shown; description: the model was read; scene: computed; busy: began or ended to take long. */
export type Happening = 'state' | 'view' | 'description' | 'scene' | 'busy';

export interface LiveStore extends Store {
  readonly catalogue: readonly Method[];
  /** Of the last text that could be read, with nothing replaced: the model's own values. */
  readonly description: Description | null;
  /** That text. */
  readonly described: string | null;
  readonly trouble: Trouble;
  readonly busy: boolean;
  /** Step, tolerance, accuracy and end as numbers, of the last state that could be computed. */
  readonly numbers: { readonly step: number | null; readonly tolerance: number | null; readonly accuracy: number | null; readonly until: number | null; readonly start: number };
  /** Replace the whole state: a preset, an address. */
  load(state: State): void;
  cancel(): void;
  /** Keeps this run, as A, in the state; null: no longer. */
  pin(run: Run | null): void;
  /** A run, computed beside the present state; rejects with what is wrong. */
  beside(run: Run): Promise<Scene>;
  /** To another place of the page (State.place). */
  go(place: string): void;
  /** The theme has changed. */
  recolour(): void;
  subscribe(listener: (what: Happening) => void): () => void;
}

/* Of one motion, at most: while a slider moves, as many as a picture has pixels; then all that a picture can use. */
const rows = { moving: 1000, settled: 6000 };
/* Milliseconds. A picture that is late is finished nevertheless, or a drag would never show one; a reference that is late is not. */
const patience = { picture: 800, reference: 40, busy: 250, truth: 14, rest: 60, settled: 160 };
/** Of a relative one: motus_run_def. */
const ACCURACY_LEAST = 1e-15;
/* What is asked of the truth: nothing, a coarse one, or the reference with the errors of all methods. */
type Wanted = 'none' | 'coarse' | 'reference';
const well: Trouble = { model: null, run: null, step: '', tolerance: '', accuracy: '', until: '', methods: '', remark: '' };

/** It took too long. */
const late = (error: unknown): error is Refused => error instanceof Refused && error.problem.kind === 'limit';
const failure = (message: string): Problem => problem('page', message);

/** "newmark(1/4, 1/2)" is of the family newmark. */
export const family = (name: string): string => name.replace(/\(.*$/s, '').trim();

/** The name that the catalogue has for a method which an address may call by another: yoshida4 is forest-ruth. */
export function ownName(name: string, catalogue: readonly Method[]): string {
  const called = family(name), found = catalogue.find(m => m.aliases.includes(called));
  return found ? found.name + name.slice(called.length) : name;
}

/** Whether what the core last read is another text than the one that stands there, which it cannot read: equation and sliders are not this text's. */
export const outdated = ({ trouble, described, state }: LiveStore): boolean => trouble.model !== null && described !== state.text;

/** The methods that are computed: those chosen that the model admits; none chosen: the model's own. */
export function admittedMethods(state: State, description: Description, catalogue: readonly Method[]): { methods: string[]; refused: { name: string; reason: string | null }[] } {
  const refused: { name: string; reason: string | null }[] = [];
  const methods = [...new Set(state.methods.map(name => ownName(name, catalogue)))].filter(name => {
    if (name === AUTO) return true;
    const entry = description.methods.find(m => m.name === name) ?? description.methods.find(m => m.name === family(name));
    if (!entry?.admitted) refused.push({ name, reason: entry?.reason ?? null });
    return entry?.admitted ?? false;
  });
  if (!methods.length) {
    const own = description.settings.automatic ? AUTO : description.settings.method || 'verlet';
    const admitted = (name: string): boolean => name === AUTO || description.methods.some(m => m.name === family(name) && m.admitted);
    methods.push(admitted(own) ? own : catalogue.find(m => m.order > 0 && admitted(m.name))?.name ?? own);
  }
  return { methods, refused };
}

/** The accuracy that is asked for, by the reader or else by the model; null: step and tolerance decide. */
export function accuracyOf({ accuracy }: Run, { settings }: Description): string | number | null {
  if (accuracy) return accuracy === UNASKED ? null : accuracy;
  return settings.accuracy ?? (settings.automatic && settings.tolerance === null ? ACCURACY : null);
}
const choosing = (name: string, catalogue: readonly Method[]): boolean => name === AUTO || catalogue.some((m) => m.adaptive && m.name === name);
/** Those that are to reach it: they choose their steps, or are the model's own, whose step it leaves open. */
function aimedOf(of: Run, model: Description, methods: readonly string[], catalogue: readonly Method[]): string[] {
  const { accuracy, method } = model.settings;
  return accuracyOf(of, model) === null ? [] : methods.filter((name) => choosing(name, catalogue) || (accuracy !== null && !of.step && name === method));
}
/** How many methods reach for an accuracy, how many take steps of one size, and how many choose theirs by a tolerance. */
export interface Kinds { readonly aimed: number; readonly fixed: number; readonly adaptive: number }
function kindsOf(of: Run, model: Description, methods: readonly string[], catalogue: readonly Method[]): Kinds {
  const aimed = aimedOf(of, model, methods, catalogue), others = methods.filter((name) => !aimed.includes(name)), adaptive = others.filter((name) => choosing(name, catalogue)).length;
  return { aimed: aimed.length, fixed: others.length - adaptive, adaptive };
}
/** The same of what is drawn, or would be. */
export function kinds({ state, description, catalogue }: LiveStore): Kinds {
  return description ? kindsOf(state, description, admittedMethods(state, description, catalogue).methods, catalogue) : { aimed: 0, fixed: 0, adaptive: 0 };
}
/** null: the model's. */
interface Measured { readonly step: number | null; readonly tolerance: number | null; readonly until: number | null; readonly aim: (Aim & { readonly at: readonly string[] }) | null }

export function createStore(client: Client, initial: State): LiveStore {
  let state = initial, scene: Scene | null = null, catalogue: readonly Method[] = [];
  let description: Description | null = null, described: string | null = null;
  let trouble = well, busy = false;
  let numbers: LiveStore['numbers'] = { step: null, tolerance: null, accuracy: null, until: null, start: 0 };
  let underWay = false, waiting = false, refining = false, began = 0, version = 0;
  // Milliseconds that the truth took the last time; 0: not known.
  let cost = { coarse: 0, reference: 0 };
  let running: AbortController | null = null, hurry = (): void => {};
  // The method line of the text that was read last; null: a whole state was loaded, whose own choice of methods counts.
  let ownMethod: string | null = null;
  const listeners = new Set<(what: Happening) => void>();
  const constants = new Map<string, number | string>();

  const tell = (what: Happening): void => { for (const listener of [...listeners]) listener(what); };
  const setBusy = (value: boolean): void => { if (busy !== value) { busy = value; tell('busy'); } };

  /** A constant expression as the core reads it, by the model that the program uses for the same purpose; a string: what is wrong. */
  async function constant(typed: string): Promise<number | string> {
    const text = normal(typed);
    if (plain(text)) return Number.isFinite(Number(text)) ? Number(text) : words.trouble.tooLarge(text);
    const known = constants.get(text);
    if (known !== undefined) return known;
    let answer: number | string = words.trouble.noNumber(text);
    try {
      const read = await client.ask('describe', { model: { text: "x' = 0\nx(0) = 0\nstep 1\nuntil 1", set: [`x(0)=${text}`] } });
      const initial = read.parameters.find(p => p.initial);
      if (initial?.values.length === 1 && Number.isFinite(initial.values[0])) answer = initial.values[0] as number;
    } catch (error) {
      if (error instanceof Refused) answer = words.trouble.noNumber(text);
      else throw error;
    }
    if (constants.size > 500) constants.clear();
    constants.set(text, answer);
    return answer;
  }

  /** Step, tolerance, accuracy and end of this state, with what is wrong with them. */
  async function measure(of: State, model: Description): Promise<Measured & { trouble: Pick<Trouble, 'step' | 'tolerance' | 'accuracy' | 'until' | 'remark'> }> {
    const said = { step: '', tolerance: '', accuracy: '', until: '', remark: '' }, { absolute } = model.settings, { methods } = admittedMethods(of, model, catalogue);
    const at = aimedOf(of, model, methods, catalogue), wanted = accuracyOf(of, model);
    let { step, until } = model.settings, tolerance: number | null = null, accuracy = typeof wanted === 'number' ? wanted : model.settings.accuracy ?? ACCURACY;
    if (of.until) {
      const value = await constant(of.until);
      if (typeof value === 'string') said.until = value;
      else if (value === model.settings.start) said.until = words.trouble.untilStart(short(value));
      else until = value;
    }
    if (of.step) {
      const value = await constant(of.step);
      if (typeof value === 'string') said.step = value;
      else if (value === 0) said.step = words.trouble.stepZero;
      else if (value < 0) said.step = words.trouble.stepBackward;
      else step = value;
    }
    if (of.tolerance) {
      const value = await constant(of.tolerance);
      if (typeof value === 'string') said.tolerance = value;
      else if (!(value > 0)) said.tolerance = words.trouble.toleranceZero;
      else tolerance = value;
    }
    if (typeof wanted === 'string') {
      const value = await constant(wanted);
      if (typeof value === 'string') said.accuracy = value;
      else if (!(value > 0)) said.accuracy = words.trouble.accuracyZero;
      else if (!absolute && !(value >= ACCURACY_LEAST && value < 1)) said.accuracy = words.trouble.accuracyRange;
      else accuracy = value;
    }
    if (step !== null && until !== null && !said.step && !said.until && kindsOf(of, model, methods, catalogue).fixed > 0) {
      const span = Math.abs(until - model.settings.start), steps = span / step;
      if (span === 0) {
        said.until = words.trouble.untilNothing(short(until));
      } else if (steps > STEPS_MAX) {
        // Said where it was caused.
        said[of.until && !of.step ? 'until' : 'step'] = words.trouble.stepMany(brief(steps, 2));
      } else if (step > span) said.remark = words.trouble.stepLong(short(span, 6));
    }
    return { step, tolerance, until, aim: at.length ? { accuracy, absolute, at } : null, trouble: said };
  }

  const makeScene = (of: State, solution: Solution): Scene => ({ state: of, description: solution.description, solution, looks: looksOf(solution.tracks.map(t => t.method), catalogue), catalogue });

  async function solve(of: State, methods: readonly string[], how: Measured, count: number, wanted: Wanted, unexamined = false): Promise<Solution> {
    running ??= new AbortController();
    const set = Object.entries(of.set).map(([name, expression]) => `${name}=${expression}`);
    const solution = await client.ask('solve',
      { model: { text: of.text, set }, methods, ...how, columns: [], rows: count, truth: wanted !== 'none', coarse: wanted === 'coarse', unexamined }, { lane: 'quick', signal: running.signal });
    if (solution.truth) cost = { ...cost, [wanted === 'coarse' && solution.truth.coarse ? 'coarse' : 'reference']: solution.truth.milliseconds };
    return solution;
  }

  /** null: this state cannot be computed, and trouble says why. */
  async function read(of: State): Promise<Description | null> {
    if (described === of.text && description) return description;
    try {
      description = await client.ask('describe', { model: { text: of.text, set: [] } }, { lane: 'quick', signal: running?.signal });
      described = of.text;
      cost = { coarse: 0, reference: 0 };
      return description;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      described = null;
      trouble = { ...well, model: error.problem };
      return null;
    }
  }

  async function compute(of: State): Promise<void> {
    const model = await read(of);
    if (!model) { tell('description'); return; }
    const own = model.settings.method;
    // Where a newer text waits, it is that one's method which counts.
    if (state === of) {
      if (ownMethod !== null && own && own !== ownMethod) {
        state = of = { ...of, methods: [own, ...of.methods.filter(name => name !== own)] };
        tell('state');
      }
      ownMethod = own;
    }
    // What the text no longer has is no longer set.
    const kept = Object.entries(of.set).map(([name, value]): [string, string] => [name.replace(/ /g, ''), value]).filter(([name]) => model.parameters.some(p => p.name === name));
    const set = Object.fromEntries(kept);
    const as = { ...of, set };
    if (state === of && JSON.stringify(set) !== JSON.stringify(of.set)) state = as;
    of = as;
    const measured = await measure(of, model);
    const { methods, refused } = admittedMethods(of, model, catalogue);
    trouble = { ...well, ...measured.trouble, methods: words.trouble.methods(refused.map(({ name, reason }) => (reason === null ? words.trouble.unknown(name) : words.trouble.refused(looksOf([name], catalogue)[0]?.label ?? name, reason)))) };
    tell('description');
    // A bad step or end leaves the last picture; where there is none of this model, the model's own serve.
    if ((measured.trouble.step || measured.trouble.tolerance || measured.trouble.accuracy || measured.trouble.until) && scene?.state.text === of.text) return;
    const { settings } = model;
    const asked = { step: measured.trouble.step ? settings.step : measured.step, tolerance: measured.tolerance, until: measured.trouble.until ? settings.until : measured.until, aim: measured.aim };
    const needsStep = asked.step === null && kindsOf(of, model, methods, catalogue).fixed > 0;
    if (needsStep || asked.until === null) {
      trouble = {
        ...trouble, step: trouble.step || (needsStep ? words.trouble.noStep : ''),
        until: trouble.until || (asked.until === null ? words.trouble.noUntil : ''),
      };
      tell('description');
      return;
    }
    const shown: State = { ...of, methods };
    const finish = (solution: Solution): void => {
      // How it is shown may have changed since.
      scene = makeScene({ ...shown, view: state.text === shown.text ? state.view : shown.view, pinned: state.pinned }, solution);
      numbers = { step: asked.step, tolerance: asked.tolerance, accuracy: asked.aim?.accuracy ?? null, until: asked.until, start: settings.start };
      tell('scene');
    };
    try {
      // A reference costs more than the methods: while the state still moves a coarse one stands for it, unless either has proved cheap.
      const cheap = (milliseconds: number): boolean => milliseconds > 0 && milliseconds < patience.truth;
      const atOnce = model.has_exact || cheap(cost.reference);
      const moving = scene?.state.text === of.text;
      const first = await solve(of, methods, asked, moving ? rows.moving : rows.settled, atOnce ? 'reference' : moving && cheap(cost.coarse) ? 'coarse' : 'none', moving || !atOnce);
      finish(first);
      const thinned = moving && (first.tracks.some(t => t.every > 1) || (first.truth?.times.length ?? 0) > rows.moving);
      if (first.examined) return;
      const again = moving && (atOnce || cost.reference > 0 || thinned);
      // A draft takes longer than the hand needs to its next place.
      if (moving && !atOnce && !first.truth) await settled(patience.rest);
      if (!atOnce && !first.truth && !waiting) {
        refining = true;
        // Where even a draft takes too long, the reference may still be there in time.
        const truth = await solve(of, [], asked, moving ? rows.moving : rows.settled, 'coarse').then((found) => found.truth, (error: unknown) => { if (late(error)) return null; throw error; });
        if (truth && !waiting) finish({ ...first, truth });
      }
      if (again) await settled(patience.settled);
      if (waiting) return;
      refining = true;
      try {
        finish(await solve(of, methods, asked, rows.settled, 'reference'));
      } catch (error) {
        // The picture stands; only what its errors are is not known, and why is told where they would be.
        if (!late(error) || !scene) throw error;
        const { tracks, examined } = await solve(of, methods, asked, rows.settled, 'none');
        finish({ ...scene.solution, tracks, examined, problem: error.problem });
      }
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      const inText = error.problem.line > 0 && !kept.length;
      trouble = { ...trouble, model: inText ? error.problem : null, run: inText ? null : error.problem };
      tell('description');
    }
  }

  async function beside(run: Run): Promise<Scene> {
    if (!catalogue.length) catalogue = await client.ask('catalogue', {});
    const of = { ...state, ...run }, set = Object.entries(run.set).map(([name, expression]) => `${name}=${expression}`);
    const model = await client.ask('describe', { model: { text: run.text, set: [] } });
    const { step, tolerance, until, aim, trouble: wrong } = await measure(of, model), { methods, refused } = admittedMethods(of, model, catalogue);
    const why = wrong.step || wrong.tolerance || wrong.accuracy || wrong.until || (step === null && kindsOf(of, model, methods, catalogue).fixed > 0 ? words.trouble.noStep : until === null ? words.trouble.noUntil : '') || (refused[0] ? words.trouble.unknown(refused[0].name) : '');
    if (why) throw new Refused(failure(why));
    return makeScene({ ...of, methods }, await client.ask('solve', { model: { text: run.text, set }, methods, step, tolerance, until, aim, columns: [], rows: rows.settled, truth: true, coarse: true, unexamined: true }));
  }

  async function work(): Promise<void> {
    underWay = true;
    while (waiting) {
      waiting = false;
      began = performance.now();
      running = new AbortController();
      const mine = ++version;
      setTimeout(() => { if (underWay && mine === version) setBusy(true); }, patience.busy);
      try {
        if (!catalogue.length) catalogue = await client.ask('catalogue', {});
        await compute(state);
      } catch (error) {
        if (!(running as AbortController | null)?.signal.aborted) {
          trouble = { ...trouble, run: failure(error instanceof Error ? error.message : String(error)) };
          tell('description');
        }
      }
      running = null;
      refining = false;
      // A picture is drawn before the next is begun, where computing takes no longer than a frame.
      if (waiting && performance.now() - began < 14) await frame();
    }
    underWay = false;
    setBusy(false);
  }
  /** A little while in which nothing changes, or the next change. */
  const settled = (milliseconds: number): Promise<void> => new Promise(done => { hurry = done; if (waiting) done(); else setTimeout(done, milliseconds); });
  const frame = (): Promise<void> => new Promise(done => { if (document.hidden) setTimeout(done, 0); else requestAnimationFrame(() => done()); });

  function ask(): void {
    if (waiting && !underWay) return;
    waiting = true;
    if (!underWay) queueMicrotask(() => void work());
    else {
      hurry();
      const mine = version, limit = refining ? patience.reference : patience.picture;
      setTimeout(() => { if (underWay && waiting && mine === version) running?.abort(); }, Math.max(0, began + limit - performance.now()));
    }
  }

  const store: LiveStore = {
    client,
    get state() { return state; },
    get scene() { return scene; },
    get catalogue() { return catalogue; },
    get description() { return description; },
    get described() { return described; },
    get trouble() { return trouble; },
    get busy() { return busy; },
    get numbers() { return numbers; },
    change(part: Partial<State>) { state = { ...state, ...part }; tell('state'); ask(); },
    load(next: State) { ownMethod = null; state = next; tell('state'); tell('view'); ask(); },
    pin(run: Run | null) {
      state = { ...state, pinned: run ?? undefined };
      if (scene) scene = { ...scene, state: { ...scene.state, pinned: state.pinned } };
      tell('view');
    },
    beside,
    go(place: string) { state = { ...state, place }; tell('view'); },
    look(part: Partial<View>) {
      state = { ...state, view: { ...state.view, ...part } };
      if (scene) scene = { ...scene, state: { ...scene.state, view: state.view } };
      tell('view');
    },
    cancel() {
      waiting = false;
      running?.abort();
      trouble = { ...trouble, run: failure(words.trouble.cancelled) };
      tell('description');
    },
    recolour() {
      if (scene) { scene = { ...scene, looks: looksOf(scene.looks.map(l => l.method), catalogue) }; tell('scene'); }
    },
    subscribe(listener) { listeners.add(listener); return () => { listeners.delete(listener); }; },
  };
  ask();
  return store;
}
