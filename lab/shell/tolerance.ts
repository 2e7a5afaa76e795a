/* The tolerance of the methods that choose their own steps, and the accuracy of the answer, which takes its place: dials on a scale of powers with a stop at each power of
 * ten (scale.ts), and the switch between the two. Invariant: a dial is there where a method is drawn that goes by it; the accuracy is reached by methods that choose their
 * steps, so where none is drawn the switch adds the one that the library chooses, and takes it away again.
 */
import { el, say } from '../dom';
import { brief, grouped, tenTo } from '../figure/number';
import { ACCURACY, AUTO, TOLERANCE, type Track } from '../protocol';
import { UNASKED } from '../scene';
import { accuracyOf, admittedMethods, kinds, type LiveStore } from '../state';
import { words } from '../words';
import { short } from './number';
import { scaleDial } from './scale';

const FIRST = 3, LAST = 14, NUMBERED = 3, FINE = 10 ** 0.1;
const stops = Array.from({ length: LAST - FIRST + 1 }, (_, k) => Number(`1e-${FIRST + k}`));
/** What both dials have. */
const powers = {
  symbol: '', fine: [1 / FINE, FINE], stops: () => stops, of: () => 'all', remark: () => '', hint: () => '', unit: () => '',
  stop: (value: number) => { const power = Math.round(Math.log10(value)); return power % NUMBERED === 0 ? tenTo(power) : ''; },
  written: (value: number, onStop: boolean) => short(Number(value.toPrecision(onStop ? 6 : 2))),
} as const;

/** Hidden, unless there is a method that goes by it. */
function shown(store: LiveStore, element: HTMLElement, there: () => boolean): HTMLElement {
  element.hidden = true;
  store.subscribe((what) => { if (what === 'description' || what === 'scene' || what === 'state') element.hidden = !there(); });
  return element;
}

export function toleranceSlider(store: LiveStore): HTMLElement {
  const say = words.dock.tolerance, track = () => store.scene?.solution.tracks.find((t) => t.tolerance !== null && !t.goal);
  const { element } = scaleDial(store, {
    ...powers, id: 'tolerance', words: words.dock.tolerance,
    own: () => store.description?.settings.tolerance ?? TOLERANCE, typed: () => store.state.tolerance, change: (tolerance) => store.change({ tolerance }),
    now: () => store.numbers.tolerance ?? store.description?.settings.tolerance ?? TOLERANCE, wrong: () => store.trouble.tolerance,
    beside: () => { const found = track(); return found ? `\u2009·\u2009${say.steps(found.total, grouped(found.total), grouped(found.refused))}` : ''; },
    spoken: (value) => { const found = track(); return say.value(short(value, 4), found ? say.steps(found.total, String(found.total), String(found.refused)) : ''); },
  });
  return shown(store, element, () => kinds(store).adaptive > 0);
}

/** That of the scene which stands for the accuracy: the first that was to reach it. */
export const goalOf = (tracks: readonly Track[]): (Track & { readonly goal: NonNullable<Track['goal']> }) | undefined => tracks.find((t): t is Track & { goal: NonNullable<Track['goal']> } => t.goal !== null);

/** "dop853, tolerance 1e-11: reached 2.1e-10", or that it was not; spoken, or to be read beside the number. */
function reachedText(store: LiveStore, named: boolean): string {
  const { tracks = [] } = store.scene?.solution ?? {}, track = goalOf(tracks), say = words.dock.accuracy;
  if (!track) return '';
  const { goal, tolerance, step } = track, write = (value: number, digits: number): string => (named ? short(value, digits) : brief(value, digits).replace(/^1×/, '')), how = tolerance === null ? say.step(write(step, 3)) : say.tolerance(write(tolerance, 2)), label = store.scene?.looks[tracks.indexOf(track)]?.label ?? track.method;
  return say.reached(named ? label : '', how, Number.isFinite(goal.reached) ? write(goal.reached, 2) : '', goal.missed === null);
}

export function accuracySlider(store: LiveStore): HTMLElement {
  const own = (): number => store.description?.settings.accuracy ?? ACCURACY;
  const { element } = scaleDial(store, {
    ...powers, id: 'accuracy', words: words.dock.accuracy,
    own, typed: () => store.state.accuracy,
    // The model's own is said by its number where the model asks for none.
    change: (accuracy) => store.change({ accuracy: accuracy || (store.description && accuracyOf({ ...store.state, accuracy: '' }, store.description) === null ? short(own(), 6) : '') }),
    now: () => store.numbers.accuracy ?? own(), wrong: () => store.trouble.accuracy,
    beside: () => { const text = reachedText(store, false); return text && `\u2009·\u2009${text}`; },
    spoken: (value) => words.dock.accuracy.value(short(value, 4), reachedText(store, true)),
  });
  return shown(store, element, () => kinds(store).aimed > 0);
}

/** Whether an accuracy decides, or step and tolerance. */
export function accuracySwitch(store: LiveStore): HTMLElement {
  const box = el('input', { type: 'checkbox', id: 'accuracy-switch', role: 'switch' });
  const element = el('label', { class: 'dial switch accuracy-switch', for: 'accuracy-switch', title: words.dock.accuracy.title }, el('span', {}, words.dock.accuracy.by), box, el('span', { class: 'switch-track', 'aria-hidden': 'true' }));
  box.addEventListener('change', () => {
    const { state, description, catalogue, scene } = store;
    if (!description) return;
    const { methods } = admittedMethods(state, description, catalogue), given = accuracyOf({ ...state, accuracy: '' }, description) !== null;
    const choosing = (name: string): boolean => name === AUTO || catalogue.some((m) => m.adaptive && m.name === name);
    if (box.checked) store.change({ accuracy: given ? '' : short(own(), 6), methods: methods.some(choosing) ? state.methods : [AUTO, ...methods] });
    else {
      // What was found goes on with the tolerance that was found for it, if nothing else is drawn.
      const others = methods.filter((name) => name !== AUTO), found = goalOf(scene?.solution.tracks ?? []);
      store.change({ accuracy: given ? UNASKED : '', methods: others.length || !found ? others : [found.method], ...(others.length || !found || found.tolerance === null ? {} : { tolerance: short(found.tolerance, 2) }) });
    }
  });
  const own = (): number => store.description?.settings.accuracy ?? ACCURACY;
  store.subscribe((what) => { if (what === 'description' || what === 'scene' || what === 'state') box.checked = kinds(store).aimed > 0; });
  return element;
}

/** Why "auto" chose: methods by their names on the page. */
export const choiceText = ({ catalogue }: LiveStore, choice: string): string => choice.replace(/[a-z][a-z0-9-]*/g, (word) => catalogue.find((m) => m.name === word)?.title ?? word);

/** What was found for the accuracy, in sentences: above the pictures that look closer. */
export function goalNote(store: LiveStore): HTMLElement {
  const element = el('p', { class: 'goal-note', hidden: true }), texts = words.dock.accuracy, write = (value: number): string => brief(value, 2).replace(/^1×/, '');
  store.subscribe((what) => {
    if (what !== 'scene') return;
    const { tracks = [] } = store.scene?.solution ?? {}, aimed = tracks.filter((t) => t.goal);
    element.hidden = aimed.length === 0;
    say(element, aimed.map((track) => {
      const { goal, tolerance, step } = track as Track & { goal: NonNullable<Track['goal']> }, label = store.scene?.looks[tracks.indexOf(track)]?.label ?? track.method;
      const how = tolerance === null ? texts.step(write(step)) : texts.tolerance(write(tolerance));
      return texts.told(label, how, write(goal.accuracy), Number.isFinite(goal.reached) ? write(goal.reached) : '', goal.absolute, goal.missed?.message ?? '', choiceText(store, goal.choice), goal.trials);
    }).join(' '));
  });
  return element;
}
