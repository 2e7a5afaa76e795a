/* The step: a dial on a scale of powers whose stops halve (scale.ts). Invariant: a lesson's stops hold every step that it asks for. Where no method of steps of one
 * size is drawn it is not there.
 */
import { data, exampleOf, stagingOf } from '../data';
import { grouped } from '../figure/number';
import { kinds, type LiveStore } from '../state';
import { words } from '../words';
import { compact, short } from './number';
import { scaleDial } from './scale';

/** Stops, from large to small, that hold what a lesson asks for. Where it asks for more than halves, they reach no farther than it does, so that stops stand apart. */
function withAsked(halves: readonly number[], base: number, asked: readonly number[]): number[] {
  const all = [base, ...asked], largest = Math.max(...all), least = Math.min(...all), near = (a: number, b: number, by: number): boolean => Math.abs(a / b - 1) < by;
  if (asked.every((h) => near(Math.log2(base / h), Math.round(Math.log2(base / h)) || 1, 1e-9) || near(h, base, 1e-9))) {
    const from = Math.max(halves[0] ?? base, largest), to = Math.min(halves[halves.length - 1] ?? base, least);
    return Array.from({ length: Math.round(Math.log2(from / to)) + 1 }, (_, k) => from / 2 ** k);
  }
  return [...halves.filter((h) => h < largest && h > least && !all.some((a) => near(h, a, 0.2))), ...all].sort((a, b) => b - a);
}

function stopsOf(store: LiveStore): number[] | null {
  const { settings } = store.description ?? {};
  if (!settings || settings.step === null) return null;
  const [times, count] = stagingOf(exampleOf(store.state)).stops ?? [4, 5];
  const span = settings.until === null ? Infinity : Math.abs(settings.until - settings.start);
  // A lesson that begins with a step of its own has its stops about that.
  const lesson = data.lessons.find(({ id }) => store.state.place.startsWith(`${id}.`)), base = Number(lesson?.scene.step) || settings.step;
  let first = base * times;
  while (first > span && first > base) first /= 2;
  return withAsked(Array.from({ length: count }, (_, k) => first / 2 ** k), base, lesson?.attempt.tasks.flatMap(({ condition: c }) => (c.kind === 'step' ? [c.value] : [])) ?? []);
}

export function stepSlider(store: LiveStore): HTMLElement {
  const track = () => store.scene?.solution.tracks.find((t) => t.tolerance === null && !t.goal), unit = (): string => stagingOf(exampleOf(store.state)).units?.t ?? '';
  const { element } = scaleDial(store, {
    id: 'step', symbol: 'h', words: words.dock.step, fine: [0.99, 1.01],
    own: () => store.description?.settings.step ?? null, typed: () => store.state.step, change: (step) => store.change({ step }),
    now: () => store.numbers.step ?? store.description?.settings.step ?? null,
    wrong: () => store.trouble.step, remark: () => store.trouble.remark,
    stops: () => stopsOf(store), of: () => `${exampleOf(store.state)} ${store.description?.settings.step} ${store.description?.settings.until} ${store.state.place.split('.')[0]}`,
    stop: (h) => compact(Number(h.toPrecision(3))), written: (h, onStop) => short(Number(h.toPrecision(onStop ? 6 : 2))),
    hint: () => (store.description?.settings.suggested && store.state.step === '' ? words.dock.step.suggested : ''), unit: () => (unit() ? `\u2009${unit()}` : ''),
    beside: () => { const total = track()?.total; return total === undefined ? '' : `\u2009·\u2009${words.dock.step.steps(total, grouped(total))}`; },
    spoken: (h) => { const total = track()?.total; return words.dock.step.value(short(h, 4), unit(), total === undefined ? '' : words.dock.step.steps(total, String(total))); },
  });
  store.subscribe((what) => { if (what === 'description' || what === 'scene') { const { fixed, adaptive, aimed } = kinds(store); element.hidden = fixed === 0 && adaptive + aimed > 0; } });
  return element;
}
