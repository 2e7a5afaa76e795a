/* Long questions to the worker, as panels see them: when they are asked, that they are being asked, how they are called off, and what came back.
 *
 * Invariant: at most one question of a kind is under way, and an answer is only ever shown as that to the question it belongs to: a newer state
 * makes an older answer `stale`. Cheap models are asked about as they change; dear ones when the reader says so.
 */
import { button, el as element } from '../dom';
import { looksOf } from '../figure/ink';
import { brief } from '../figure/number';
import { eventful, type ConvergeRow, type Model, type Requests } from '../protocol';
import { Refused, type Look, type Scene, type Store } from '../scene';
import { words } from '../words';

const say = words.study;

type Kind = 'converge' | 'compare';
export type Phase = 'waiting' | 'asking' | 'done' | 'failed' | 'cancelled';

/** After the last change, so that a slider being dragged does not start what the next frame calls off. */
const PAUSE = 350;
/** A study begins by itself, and is called off where it takes longer than so many milliseconds: then it waits for its button. */
const ALONE = 2000;
/** What is being asked is told after so many milliseconds. */
const TELL = 700;

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
  /** What it took, when it came to an end; and whether it was given up, which is not begun again by itself. */
  private took = 0;
  private dear = false;
  /** What the reference took where it was the page's own: most of what a long study takes. */
  private guess = 0;
  private pressed = false;
  /** What the latest question is about, but for numbers that sliders move. */
  asked = '';
  private text = '';
  private preset = '';
  private readonly listeners: (() => void)[] = [];

  constructor(private readonly store: Store, private readonly kind: K, private readonly doing: string, private readonly withStep: boolean) {}

  listen(listener: () => void): void { this.listeners.push(listener); }
  private tell(): void { for (const listener of this.listeners) listener(); }
  get label(): string { return this.doing; }
  /** It will begin by itself in a moment. */
  get coming(): boolean { return this.phase === 'waiting' && this.timer !== 0; }
  /** There is nothing to ask about. */
  get idle(): boolean { return this.ask === null || this.ask.methods.length === 0; }
  /** Nobody asked, and nothing came: then there is nothing to tell. */
  get silent(): boolean { return this.phase === 'failed' && !this.pressed && !this.answer; }
  about(scene: Scene): string { return JSON.stringify([scene.state.text, scene.looks.map((look) => look.method)]); }
  silentFor(scene: Scene): boolean { return this.silent && this.asked === this.about(scene); }
  /** What it will take, as far as that is known: "17 s", ''. */
  get price(): string {
    const seconds = (this.took || this.guess) / 1000;
    return seconds > ALONE / 1000 ? `${brief(seconds, seconds < 10 ? 1 : 2)}\u2009s` : '';
  }

  /** The state has changed; nothing happens where the question is the same. */
  want(scene: Scene): void {
    const { state } = scene;
    const model: Model = { text: state.text, set: Object.entries(state.set).map(([name, value]) => `${name}=${value}`) };
    const ask: Requests[K]['ask'] = {
      model, methods: scene.solution.tracks.filter((track) => (this.kind === 'converge' || track.tolerance === null) && track.method !== 'exact').map((track) => track.method),
      step: this.withStep && state.step !== '' ? this.store.numbers.step : null, until: state.until !== '' ? this.store.numbers.until : null,
    };
    const key = JSON.stringify(ask), { truth } = scene.solution;
    // The reference comes after the scene that is first shown.
    this.guess = truth && truth.name !== 'exact' && !truth.coarse ? truth.milliseconds : 0;
    if (key === this.key) { if (this.phase === 'waiting') this.tell(); return; }
    this.asked = this.about(scene);
    this.pressed = false;
    // The picture before an edit may stay for the moment until the next is there, but not longer; another example's may not.
    if (state.text !== this.text) {
      this.took = 0;
      this.dear = false;
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
      this.problem = '';
    } else if (!this.dear) {
      this.timer = window.setTimeout(() => { void this.start(true); }, PAUSE);
    }
    this.tell();
  }

  /** alone: nobody asked for it. */
  async start(alone = false): Promise<void> {
    const ask = this.ask, key = this.key;
    if (!ask || this.phase === 'asking' || ask.methods.length === 0) return;
    clearTimeout(this.timer);
    this.timer = 0;
    this.pressed = !alone;
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
      this.dear = this.took > ALONE;
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
    this.dear = true;
    this.phase = 'cancelled';
    this.control?.abort();
    this.control = null;
    this.tell();
  }

  /** What is said in the picture's place; '' where there is a picture. */
  message(): string {
    if (this.answer) return '';
    switch (this.phase) {
      case 'asking': return say.going(this.doing);
      case 'failed': return say.failed(this.problem);
      case 'cancelled': return say.cancelled;
      // Cheap, and begun in a moment.
      default: return this.coming ? say.going(this.doing) : say.waiting;
    }
  }
}

/* One study for all panels that show it. */
const converging = new WeakMap<Store, Study<'converge'>>();
export function convergenceStudy(store: Store): Study<'converge'> {
  let study = converging.get(store);
  if (!study) converging.set(store, study = new Study(store, 'converge', say.converge, false));
  return study;
}

/** A scene with a method, which has errors. */
export const measurable = (scene: Scene): boolean => !eventful(scene.description) && scene.solution.tracks.some((track) => track.method !== 'exact');
/** What a panel shows of it: nothing before it has a scene, as one that was never opened hears of the study too. */
export function rowsFor(study: Study<'converge'>, scene: Scene | null): readonly ConvergeRow[] {
  return scene ? study.answer?.rows ?? [] : [];
}

/** The button that begins a dear study, with what it will take; and while one is under way, what it is doing and the button that calls it off. Nothing else:
 * what comes by itself in a moment needs no word. */
export function studyBar<K extends Kind>(study: Study<K>): HTMLElement {
  const said = element('p', { role: 'status' }), clock = element('p', { 'aria-hidden': 'true' });
  const progress = element('progress', { 'aria-label': study.label });
  const act = button(say.begin(''), () => { if (study.phase === 'asking') study.cancel(); else void study.start(); });
  const bar = element('div', { class: 'study', hidden: true }, act, progress, said, clock);
  let ticking = 0, late = 0;
  function update(): void {
    const { phase, coming } = study, asking = phase === 'asking', age = asking ? performance.now() - study.since : 0;
    clearTimeout(late);
    clearInterval(ticking);
    if (asking && age < TELL) late = window.setTimeout(update, TELL - age + 1);
    bar.hidden = phase === 'done' || coming || study.idle || (asking && age < TELL);
    const text = asking ? say.going(study.label) : study.stale && !coming ? say.earlier : '';
    if (said.textContent !== text) said.textContent = text;
    const label = asking ? say.cancel : phase === 'failed' ? say.again : say.begin(study.price);
    if (act.textContent !== label) act.textContent = label;
    progress.hidden = !asking;
    const tick = (): void => { clock.textContent = `${Math.floor((performance.now() - study.since) / 1000)}\u2009s`; };
    clock.textContent = '';
    if (asking && !bar.hidden) { tick(); ticking = window.setInterval(tick, 500); }
  }
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
