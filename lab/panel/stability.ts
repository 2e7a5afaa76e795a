/* How large may the step be? The largest stable step of every method for this motion's own rates, as bars; behind a switch the whole plane of hλ.
 *
 * Invariant: limits belong to the methods, rates to the motion; the step only moves the line of the run. Where the force is the same everywhere, or nothing
 * can be judged by a rate, there is a sentence and no picture.
 */
import { button } from '../dom';
import { shortLabel } from '../figure/ends';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { brief, grouped, minus } from '../figure/number';
import type { Ink, Pen } from '../figure/types';
import type { Method, Model } from '../protocol';
import { Refused, type Look, type Panel, type PanelMaker, type Scene } from '../scene';
import { words } from '../words';
import { drawBars, heightOf, type Bar } from './bars';
import { Limits, type Limit } from './limits';
import { planeOf, type Plane } from './plane';
import { PlanePicture } from './planepicture';
import { motionOf, type Motion, type Rate } from './rates';
import { amount, moment, timeUnit } from './told';

const say = words.study.stability;
/** Moments of the run at which it is linearised: fewer where that is dear, by the numbers of the state; after the last change, so many milliseconds later. */
const momentsFor = (numbers: number): number => (numbers <= 8 ? 128 : numbers <= 24 ? 32 : 16);
/** A limit that is found, not certified, is known to this part. */
const NEARLY = 2e-4;
const PAUSE = 120, PLANE = { aspect: 0.78, tallest: 0.8 };

const cardOf = (scene: Scene, name: string): Method | undefined =>
  scene.catalogue.find((m) => m.name === name || m.aliases.includes(name)) ?? scene.catalogue.find((m) => name.startsWith(`${m.name}(`) || name.startsWith(`${m.name} (`));
/** With arguments a card's fact need not hold. */
const byRates = (card: Method, name: string): boolean => card.by_rates && !name.includes('(');

/** By the catalogue where nothing has friction; by its rates where the method is a map of them; else by its own step on the motion linearised. */
export async function limitOf(limits: Limits, motion: Motion, name: string, card: Method): Promise<Limit> {
  const maps = byRates(card, name);
  if (motion.kind === 'swings') return motion.springs || maps ? limits.axis(name, card) : { kind: 'unknown' };
  return maps ? limits.steps(name, card, motion.judged) : limits.linear(name, motion.calm);
}

const complex = (re: number, im: number): string => {
  const small = 1e-9 * Math.hypot(re, im);
  if (Math.abs(im) <= small) return brief(re, 3);
  const i = `${brief(Math.abs(im), 3)} i`;
  return Math.abs(re) <= small ? `±${i}` : `${brief(re, 3)} ± ${i}`;
};
/** As many digits as tell it from 1. */
const growthText = (growth: number): string => {
  const off = Math.abs(growth - 1);
  return off > 0 && off < 1e-4 ? `1 ${growth > 1 ? '+' : '−'} ${brief(off, 2)}` : brief(growth, off < 0.01 ? 6 : 4);
};

export interface Judged { readonly name: string; readonly limit: Limit }
/** The answer: the largest step of each. scale: what a limit is divided by to be a step; written: a step with its unit; here: the run's. */
export function largestSteps(judged: readonly Judged[], scale: number, here: number, written: (h: number) => string, lead: string): string {
  const groups = new Map<string, string[]>(), of = (kind: Limit['kind']): string[] => judged.filter((j) => j.limit.kind === kind).map((j) => j.name);
  const bars = judged.flatMap((j) => (j.limit.kind === 'upTo' ? [{ name: j.name, step: j.limit.value / scale }] : [])).sort((a, b) => a.step - b.step);
  for (const { name, step } of bars) groups.set(written(step), [...groups.get(written(step)) ?? [], name]);
  const any = of('any'), never = of('never'), slow = of('slow'), unknown = of('unknown'), over = bars.filter((b) => here > b.step * (1 + NEARLY)).map((b) => b.name);
  const limits = [...groups].map(([step, names], k) => say.below(step, names, k === 0));
  const rest = [
    ...(any.length ? [say.any(any)] : []), ...(never.length || slow.length ? [[never.length ? say.never(never) : '', slow.length ? say.slow(slow, !never.length) : ''].filter(Boolean).join(', ')] : []),
    ...(unknown.length ? [say.unknown(unknown)] : []),
  ];
  return judged.length ? say.answer(`${over.length ? say.tooLarge(written(here), over) : ''}${lead}`, limits, rest) : '';
}

export const stability: PanelMaker = (store): Panel => {
  const limits = new Limits(store.client), picture = new PlanePicture();
  let scene: Scene | null = null, motion: Motion | null = null, motionFor = '', trouble = '', timer = 0, now = 0;
  let judged: { readonly look: Look; readonly limit: Limit }[] = [], judgedFor = '';
  let plane: Plane | null = null, planeFor = '', whole = false;
  let growth: Float64Array | null = null, growthFor = '';

  const methods = (): Look[] => scene?.looks.filter((look) => cardOf(scene!, look.method)?.order) ?? [];
  const main = (): Method | undefined => { const look = methods()[0]; return scene && look ? cardOf(scene, look.method) : undefined; };
  const step = (): number => Math.abs(scene?.solution.tracks[0]?.step ?? scene?.description.settings.step ?? 0);
  const unit = (): string => (scene ? timeUnit(scene) : '');
  /** A step, with its unit: to three digits, or to as many as tell it from the step of the run; that one as it is. */
  const plain = (h: number, digits: number): string => (h >= 1000 && h < 1e5 ? grouped(Number(h.toPrecision(digits))) : brief(h, digits));
  const united = (text: string): string => `${text}${unit() && `\u2009${unit()}`}`;
  function written(h: number): string {
    const here = step();
    if (h === here) return united(plain(h, 6));
    let digits = 3;
    while (digits < 6 && Math.abs(h - here) > NEARLY * here && plain(h, digits) === plain(here, digits)) digits++;
    return united(plain(h, digits));
  }
  const frequency = (): number => motion?.frequencies[0] ?? 0;
  /** Bars are of step times frequency, or of the step. */
  const swinging = (): boolean => motion?.kind === 'swings';
  const boris = (): boolean => main()?.name === 'boris' && motion?.springs === false;
  /** Where there is one, and something to be judged. */
  const drawable = (): boolean => (motion?.kind === 'swings' || motion?.kind === 'fades') && judged.some((j) => j.limit.kind !== 'unknown');
  /** A rate alone tells what a step of the main method does with it: as a map of hλ, without friction, or as one spring whose two rates are conjugate. */
  const told = (): boolean => {
    const card = main(), look = methods()[0];
    return !!card && !!look && !!motion && (swinging() || byRates(card, look.method) || (motion.springs && motion.calm.every(({ linear }) => linear.nv === 1) && motion.rates.every((rate) => rate.im !== 0)));
  };
  const waiting = (): boolean => !trouble && (!motion || ((motion.kind === 'swings' || motion.kind === 'fades') && judgedFor === ''));

  /* ---- asking ---- */

  /** Of the shown methods, the one whose run is nearest to the motion. */
  function follower(of: Scene): string {
    const tracks = of.solution.tracks.filter((track) => track.method !== 'exact' && !track.problem && cardOf(of, track.method));
    return (tracks.length ? tracks : of.solution.tracks).reduce((best, track) => ((cardOf(of, track.method)?.order ?? 0) > (cardOf(of, best)?.order ?? -1) ? track.method : best), '') || of.description.settings.method;
  }
  function wantRates(): void {
    if (!scene) return;
    const { state, description, solution } = scene, method = follower(scene), key = JSON.stringify([state.text, state.set, state.until, method]);
    if (key === motionFor) { void wantLimits(); return; }
    motionFor = key;
    clearTimeout(timer);
    const model: Model = { text: state.text, set: Object.entries(state.set).map(([name, value]) => `${name}=${value}`) };
    const track = solution.tracks.find((t) => t.method === method), start = description.settings.start, end = track?.times[track.times.length - 1] ?? start;
    const numbers = description.columns.filter((c) => c.kind === 'position' || c.kind === 'velocity' || c.kind === 'first-order').length, count = momentsFor(numbers);
    const ask = { model, method, step: track?.tolerance ? null : track?.step ?? description.settings.step, tolerance: track?.tolerance ?? null, until: state.until !== '' ? store.numbers.until : null };
    timer = window.setTimeout(() => { void (async () => {
      const along = Array.from({ length: count }, (_, k) => start + (end - start) * k / count);
      // Where the motion cannot be followed, its start still tells.
      for (const times of end === start ? [[start]] : [along, [start]]) {
        try {
          const found = await store.client.ask('spectrum', { ...ask, times }, { lane: 'study', key: 'spectrum' });
          if (motionFor !== key) return;
          const pure = !description.velocity_dependent && !description.variables.some((v) => v.order === 1);
          // Answers come in the order of the times, earliest first.
          motion = motionOf(found, [...times].sort((a, b) => a - b), pure, end < start ? -1 : 1);
          trouble = '';
          break;
        } catch (reason) {
          if (motionFor !== key) return;
          motion = null;
          trouble = reason instanceof Refused ? reason.problem.message : String(reason);
        }
      }
      judgedFor = growthFor = '';
      void wantLimits();
      tell();
    })(); }, PAUSE);
  }

  async function wantLimits(): Promise<void> {
    const of = motion, looks = methods(), at = scene;
    if (!of || !at || !(of.kind === 'swings' || of.kind === 'fades')) { tell(); return; }
    const key = `${motionFor} ${looks.map((look) => look.method).join()}`;
    if (key === judgedFor) { wantGrowth(); return; }
    const found: { look: Look; limit: Limit }[] = [];
    try {
      for (const look of looks) {
        const card = cardOf(at, look.method)!;
        found.push({ look, limit: await limitOf(limits, of, look.method, card) });
        if (motion !== of) return;
      }
    } catch (reason) {
      if (motion !== of) return;
      trouble = reason instanceof Refused ? reason.problem.message : String(reason);
      tell();
      return;
    }
    // Meanwhile others may have been chosen, which are asked for in their turn.
    if (methods().map((look) => look.method).join() !== looks.map((look) => look.method).join()) return;
    judged = found;
    judgedFor = key;
    wantGrowth();
    tell();
  }

  /** Growth of the main method's step, at each rate: for the plane and the numbers. */
  function wantGrowth(): void {
    const card = main(), look = methods()[0], h = step();
    if (!card || !look || !motion?.rates.length) return;
    const key = `${look.method} ${h} ${motionFor}`;
    if (key === growthFor) return;
    growthFor = key;
    const { rates } = motion;
    store.client.ask('growth', { method: look.method, re: rates.map((r) => h * r.re), im: rates.map((r) => h * r.im) }, { lane: 'quick', key: 'growth' })
      .then((answer) => { if (growthFor === key) { growth = answer; fig.redraw(); } }, () => { if (growthFor === key) growth = null; });
  }
  async function wantPlane(): Promise<void> {
    const card = main();
    if (!whole || !card || card.name === planeFor) return;
    planeFor = card.name;
    plane = null;
    try {
      const made = await planeOf(store.client, card);
      if (planeFor === card.name) plane = made;
    } catch {
      // The bars say what there is to say.
      if (planeFor === card.name) { planeFor = ''; whole = false; }
    }
    tell();
  }

  /* ---- drawing ---- */

  /** Looks have the colours of the theme. */
  function relook(): void {
    judged = judged.map((j) => ({ ...j, look: scene?.looks.find((look) => look.method === j.look.method) ?? j.look }));
  }

  function barsOf(): Bar[] {
    return judged.map(({ look, limit }) => {
      const name = shortLabel(look.label);
      const label = limit.kind === 'upTo' ? say.label(name, swinging() ? brief(limit.value, 3) : written(limit.value))
        : { any: say.anyLabel, never: say.neverLabel, slow: say.slowLabel, unknown: say.unknownLabel }[limit.kind](name);
      return { look, limit, label };
    });
  }
  const colour = (ink: Ink): string => methods()[0]?.colour ?? ink.text;
  function draw(pen: Pen, ink: Ink): void {
    if (!motion) return;
    if (whole && plane && told()) { picture.draw(pen, ink, plane, motion.rates, step(), colour(ink), main()?.stability_limit ?? plane.limit); return; }
    picture.frame = null;
    if (!drawable()) return;
    const h = step(), f = frequency();
    drawBars(pen, ink, swinging()
      ? { bars: barsOf(), here: h * f, hereText: brief(h * f, 3), others: motion.frequencies.slice(1).map((w) => h * w), name: say.axis }
      : { bars: barsOf(), here: h, hereText: united(plain(h, 3)), others: [], name: say.stepAxis });
  }

  /* ---- saying ---- */

  const fastest = (): Rate | null => motion?.fastest ?? null;
  function answer(): string {
    if (!scene) return '';
    if (trouble) return say.noRates(trouble);
    if (!motion) return '';
    if ((motion.kind === 'still' || motion.kind === 'rateless') && scene.solution.tracks.some(({ problem }) => problem)) return say.broken;
    if (motion.kind === 'still') return scene.description.smooth ? say.still : say.stillThere(String(motion.moments));
    if (motion.kind === 'rateless') return say.rateless;
    if (motion.kind === 'grows') return say.grows(amount(1 / Math.max(...motion.rates.map((r) => Math.abs(r.re))), unit(), 2));
    if (judgedFor === '') return '';
    if (boris() && judged.length === 1) return say.boris(methods()[0]!.label, brief(main()!.stability_limit, 3));
    const at = fastest(), lead = !swinging() && !motion.steady ? say.moments : !motion.steady && at ? say.fastest(moment(scene, Number(at.time.toPrecision(3)))) : swinging() && motion.frequencies.length > 1 ? say.swing : '';
    return largestSteps(judged.map(({ look, limit }) => ({ name: look.label, limit })), swinging() ? frequency() : 1, step(), written, lead);
  }
  function summary(): string {
    if (!scene || !motion || !judged.length || !drawable()) return '';
    const at = fastest(), h = step(), parts: string[] = [swinging() ? say.inside : say.insideStep];
    if (swinging() && at) parts.push(say.frequency(brief(frequency(), 4), motion.steady ? '' : moment(scene, Number(at.time.toPrecision(3))), brief(h * frequency(), 4), motion.frequencies.length > 1));
    if (!motion.steady) parts.push(say.linear(String(motion.moments)));
    if (!swinging() && judged.some(({ look }) => { const card = cardOf(scene!, look.method); return card && !byRates(card, look.method); })) parts.push(say.friction);
    if (motion.growing) parts.push(say.own);
    if (scene.solution.tracks[0]?.tolerance != null) parts.push(say.mean(scene.looks[0]?.label ?? ''));
    if (whole && plane && !plane.full) parts.push(say.axisOnly(methods()[0]!.label));
    if (boris()) parts.push(say.boris(methods()[0]!.label, brief(main()!.stability_limit, 3)));
    else parts.push(grown());
    return minus(parts.filter(Boolean).join(' '));
  }
  /** What the main method's step does to these rates. */
  function grown(): string {
    const card = main(), look = methods()[0], h = step();
    if (!card || !look || !motion || !growth || growth.length !== motion.rates.length || judged[0]?.limit.kind === 'unknown' || !told()) return '';
    const tolerance = card.symplectic ? 1e-7 : 1e-12;
    let worst = -1;
    motion.rates.forEach((rate, k) => { if (motion!.judged.includes(rate) && !Number.isNaN(growth![k]!) && (worst < 0 || growth![k]! > growth![worst]!)) worst = k; });
    if (worst < 0) return '';
    const g = growth[worst]!, z = motion.rates[worst]!, where = `hλ = ${complex(h * z.re, h * z.im)}`, name = look.label, steps = scene?.solution.tracks[0]?.total ?? 0, all = g ** steps;
    const said = g > 1 + tolerance ? [say.unstable(growthText(g), where), steps > 0 && motion.steady ? say.over(grouped(steps), Number.isFinite(all) ? brief(all, 3) : say.endless) : ''].filter(Boolean).join(' ')
      : g >= 1 - tolerance ? say.border(where) : z.re === 0 ? say.damps(name, growthText(g), where) : say.within(growthText(g), where, growthText(Math.exp(h * z.re)));
    return `${look.label}: ${said.charAt(0).toLowerCase()}${said.slice(1)}`;
  }

  const toggle = button(say.whole, () => { whole = !whole; void wantPlane(); tell(); }, { class: 'figure-button', 'aria-pressed': 'false' });
  const fig = figure({
    id: 'stability', title: say.title, question: say.question, aspect: 0, least: 0, draw, answer, summary,
    overlay(pen, ink) { if (whole && motion) picture.overlay(pen, motion.rates, step(), now, colour(ink)); },
    extra: (width) => (whole && plane ? Math.min(PLANE.aspect * width, PLANE.tallest * window.innerHeight) : heightOf(judged.length)),
    table: () => {
      const h = step();
      return {
        head: say.columns, rows: (motion?.rates ?? []).map((rate, k) => [rate.time, rate.re, rate.im, h * rate.re, h * rate.im, judged[0]?.limit.kind === 'unknown' || !told() ? NaN : growth?.[k] ?? NaN]),
        note: say.note(methods()[0]?.label ?? '', brief(h, 6)),
      };
    },
    controls: [toggle],
  });
  const foot = fig.element.querySelector<HTMLElement>('.figure-foot');

  function tell(): void {
    const seen = waiting() || drawable();
    fig.say(waiting() || (whole && !plane) ? say.waiting : '');
    // A sentence alone needs no picture, and no numbers.
    fig.picture.hidden = !seen;
    if (foot && !seen) foot.hidden = true; else if (foot && !waiting() && !(whole && !plane)) foot.hidden = false;
    toggle.hidden = !drawable() || !told();
    if (toggle.hidden) whole = false;
    toggle.textContent = whole ? say.bars : say.whole;
    toggle.setAttribute('aria-pressed', String(whole));
    fig.redraw();
  }

  tell();
  return {
    id: 'stability', title: say.title, element: fig.element,
    there: (next) => next.solution.tracks.some((track) => track.method !== 'exact'),
    show(next) {
      scene = next;
      relook();
      wantRates();
      void wantPlane();
      wantGrowth();
      tell();
    },
    at(time) { now = time; if (whole) fig.redrawOverlay(); },
    redraw() {
      if (scene) scene = recoloured(scene);
      relook();
      fig.redraw();
    },
  };
};
