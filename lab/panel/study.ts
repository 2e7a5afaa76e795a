/* Long questions to the worker, as panels see them: when they are asked, that they are being asked, how they are called off, and what came back.
 *
 * Invariant: at most one question of a kind is under way, and an answer is only ever shown as that to the question it belongs to: a newer state
 * makes an older answer `stale`. Cheap models are asked about as they change; dear ones when the reader says so.
 */
import { button, el as element } from '../dom';
import { looksOf } from '../figure/ink';
import { brief } from '../figure/number';
import type { ConvergeRow, Model, Requests } from '../protocol';
import { Refused, type Look, type Scene, type Store } from '../scene';

type Kind = 'converge' | 'compare';
export type Phase = 'waiting' | 'asking' | 'done' | 'failed' | 'cancelled';

/** After the last change, so that a slider being dragged does not start what the next frame calls off. */
const PAUSE = 350;
/** A study begins by itself, and is called off where it takes longer than so many milliseconds: then it waits for its button. */
const ALONE = 2000;

export class Study<K extends Kind> {
  phase: Phase = 'waiting';
  answer: Requests[K]['answer'] | null = null;
  /** The answer is to an older question. */
  stale = false;
  problem = '';
  since = 0;
  private key = '';
  private ask: Requests[K]['ask'] | null = null;
  private control: AbortController | null = null;
  private timer = 0;
  private took = 0;
  private text = '';
  private preset = '';
  private readonly listeners: (() => void)[] = [];

  constructor(private readonly store: Store, private readonly kind: K, private readonly doing: string, readonly done: string, private readonly withStep: boolean) {}

  listen(listener: () => void): void { this.listeners.push(listener); }
  private tell(): void { for (const listener of this.listeners) listener(); }
  get label(): string { return this.doing; }
  /** It will begin by itself in a moment. */
  get coming(): boolean { return this.phase === 'waiting' && this.timer !== 0; }
  /** There is nothing to ask about. */
  get idle(): boolean { return this.ask === null || this.ask.methods.length === 0; }
  get seconds(): number { return this.took / 1000; }

  /** The state has changed; nothing happens where the question is the same. */
  want(scene: Scene): void {
    const { state } = scene;
    const model: Model = { text: state.text, set: Object.entries(state.set).map(([name, value]) => `${name}=${value}`) };
    const ask: Requests[K]['ask'] = {
      model, methods: scene.solution.tracks.map((track) => track.method).filter((method) => method !== 'exact'),
      step: this.withStep && state.step !== '' ? this.store.numbers.step : null, until: state.until !== '' ? this.store.numbers.until : null,
    };
    const key = JSON.stringify(ask);
    if (key === this.key) return;
    // The picture before an edit may stay for the moment until the next is there, but not longer; another example's may not.
    if (state.text !== this.text) {
      this.took = 0;
      if (state.preset !== this.preset) this.answer = null;
    }
    this.text = state.text;
    this.preset = state.preset;
    this.key = key;
    this.ask = ask;
    this.stale = this.answer !== null;
    this.control?.abort();
    this.control = null;
    clearTimeout(this.timer);
    this.timer = 0;
    this.phase = 'waiting';
    if (ask.methods.length === 0) {
      this.phase = 'failed';
      this.answer = null;
      this.problem = 'The exact motion has no error to be measured. Choose a method beside it.';
    } else if (this.took < ALONE) {
      this.timer = window.setTimeout(() => { void this.start(true); }, PAUSE);
    }
    this.tell();
  }

  /** alone: nobody asked for it. */
  async start(alone = false): Promise<void> {
    const ask = this.ask, key = this.key;
    if (!ask || this.phase === 'asking' || ask.methods.length === 0) return;
    clearTimeout(this.timer);
    const control = new AbortController();
    this.control = control;
    this.phase = 'asking';
    this.since = performance.now();
    const limit = alone ? window.setTimeout(() => {
      if (this.control !== control) return;
      this.cancel();
      this.phase = 'waiting';
      this.tell();
    }, ALONE) : 0;
    this.tell();
    try {
      const answer = await this.store.client.ask(this.kind, ask, { lane: 'study', key: this.kind, signal: control.signal });
      if (key !== this.key || control.signal.aborted) return;
      this.answer = answer;
      this.stale = false;
      this.phase = 'done';
      this.took = performance.now() - this.since;
    } catch (reason) {
      clearTimeout(limit);
      if (key !== this.key || control.signal.aborted) return;
      this.answer = null;
      this.stale = false;
      this.phase = 'failed';
      this.problem = reason instanceof Refused ? [reason.problem.message, reason.problem.hint].filter(Boolean).join(': ')
        : reason instanceof Error ? reason.message : String(reason);
    }
    clearTimeout(limit);
    this.tell();
  }

  cancel(): void {
    if (this.phase !== 'asking') return;
    // What takes long enough to be called off is not begun again by itself.
    this.took = Math.max(this.took, performance.now() - this.since, ALONE);
    this.phase = 'cancelled';
    this.control?.abort();
    this.control = null;
    this.tell();
  }

  /** What is said in the picture's place; '' where there is a picture. */
  message(): string {
    if (this.answer) return '';
    switch (this.phase) {
      case 'asking': return `${this.doing} …`;
      case 'failed': return this.idle ? this.problem : `This could not be computed: ${this.problem}`;
      case 'cancelled': return 'Cancelled. Press “Compute” to begin again.';
      // Cheap, and begun in a moment.
      default: return this.coming ? `${this.doing} …` : 'This takes a while for this model. Press “Compute” to begin.';
    }
  }
}

/* One study for all panels that show it. */
const converging = new WeakMap<Store, Study<'converge'>>();
export function convergenceStudy(store: Store): Study<'converge'> {
  let study = converging.get(store);
  if (!study) converging.set(store, study = new Study(store, 'converge', 'Measuring the error at many steps', 'Measured', false));
  return study;
}

/** What a panel shows of it: nothing before it has a scene, as one that was never opened hears of the study too. */
export function rowsFor(study: Study<'converge'>, scene: Scene | null): readonly ConvergeRow[] {
  return scene ? study.answer?.rows ?? [] : [];
}

/** What it is doing, and the button that begins it or calls it off. */
export function studyBar<K extends Kind>(study: Study<K>): HTMLElement {
  const said = element('p', { role: 'status' });
  const clock = element('p', { 'aria-hidden': 'true' });
  const progress = element('progress', { 'aria-label': study.label, hidden: true });
  const act = button('Compute', () => { if (study.phase === 'asking') study.cancel(); else void study.start(); });
  const bar = element('div', { class: 'study' }, act, progress, said, clock);
  let ticking = 0;
  const update = (): void => {
    const asking = study.phase === 'asking', { phase, coming } = study;
    // There is always something in the bar: it must not come and go under a slider being dragged.
    const text = asking || coming ? `${study.label} …` : phase === 'cancelled' ? 'Cancelled.' : phase === 'failed' ? 'Not computed.'
      : phase === 'done' ? `${study.done} in ${brief(Math.max(0.01, study.seconds), 2)} s.` : study.stale ? 'The picture is of an earlier state.' : 'Not yet computed.';
    if (said.textContent !== text) said.textContent = text;
    const label = asking ? 'Cancel' : phase === 'failed' ? 'Try again' : 'Compute';
    if (act.textContent !== label) act.textContent = label;
    act.hidden = phase === 'done' || coming || study.idle;
    progress.hidden = !asking;
    clearInterval(ticking);
    clock.textContent = '';
    if (asking) {
      ticking = window.setInterval(() => {
        const seconds = (performance.now() - study.since) / 1000;
        clock.textContent = seconds > 1 ? `${Math.floor(seconds)} s` : '';
      }, 500);
    }
  };
  study.listen(update);
  update();
  return bar;
}

/** The look of each method asked for, in the order given; as in every other panel. */
export function lookFor(scene: Scene, methods: readonly string[]): Look[] {
  const made = looksOf(methods, scene.catalogue);
  return methods.map((method, i) => scene.looks.find((look) => look.method === method) ?? made[i]!);
}

const SVG = 'http://www.w3.org/2000/svg';
/** A piece of the method's line, for a list outside the picture. */
export function sample(look: Look): SVGElement {
  const svg = document.createElementNS(SVG, 'svg'), line = document.createElementNS(SVG, 'line');
  const set = (e: SVGElement, attributes: Readonly<Record<string, string>>): void => { for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v); };
  set(svg, { viewBox: '0 0 24 12', 'aria-hidden': 'true' });
  set(line, { x1: '0', y1: '6', x2: '24', y2: '6', stroke: look.colour, 'stroke-width': '2', 'stroke-dasharray': look.dash.join(' ') });
  svg.append(line);
  return svg;
}
