/* The step: a slider on a scale of powers whose stops halve, and the number itself as a field.
 *
 * Invariant: what the field shows is what the reader typed; what is wrong with it is said under it, and the last good picture stays. Stops belong to the
 * model, not to the state: they do not move under the reader's hand. A lesson's hold every step that it asks for. The knob stands where the step is: one
 * that is typed beyond the stops widens the range.
 */
import { data, exampleOf } from '../data';
import { grouped } from '../figure/number';
import { stagingOf } from '../stage/staging';
import { outdated, type LiveStore } from '../state';
import { button, el, icon, say } from '../dom';
import { words } from '../words';
import { compact, normal, short } from './number';

const positions = 1000, catching = 6;               // pixels within which a stop catches
/** Of its range, between two numbers under it. */
const NARROW = 12;

/** Stops, from large to small, that hold what a lesson asks for. Where it asks for more than halves, they reach no farther than it does, so that stops stand apart. */
function withAsked(halves: readonly number[], base: number, asked: readonly number[]): number[] {
  const all = [base, ...asked], largest = Math.max(...all), least = Math.min(...all), near = (a: number, b: number, by: number): boolean => Math.abs(a / b - 1) < by;
  if (asked.every((h) => near(Math.log2(base / h), Math.round(Math.log2(base / h)) || 1, 1e-9) || near(h, base, 1e-9))) {
    const from = Math.max(halves[0] ?? base, largest), to = Math.min(halves[halves.length - 1] ?? base, least);
    return Array.from({ length: Math.round(Math.log2(from / to)) + 1 }, (_, k) => from / 2 ** k);
  }
  return [...halves.filter((h) => h < largest && h > least && !all.some((a) => near(h, a, 0.2))), ...all].sort((a, b) => b - a);
}

export function stepSlider(store: LiveStore): HTMLElement {
  const slider = el('input', { type: 'range', min: 0, max: positions, step: 1, id: 'step-slider', 'aria-label': words.dock.step.slider });
  const field = el('input', { id: 'step', type: 'text', inputmode: 'text', autocomplete: 'off', spellcheck: 'false', class: 'value', 'aria-label': words.dock.step.field, 'aria-describedby': 'step-message' });
  const unit = el('span', { class: 'unit' }), steps = el('span', { class: 'steps' }), suggested = el('i', { class: 'suggested' });
  const message = el('p', { id: 'step-message', class: 'message', role: 'status' });
  const stops = el('div', { class: 'stops', 'aria-hidden': 'true' });
  const reset = button('', () => { store.change({ step: '' }); slider.focus(); refresh(); }, { class: 'icon-button reset', 'aria-label': words.dock.step.reset, title: words.dock.step.resetTitle },
    icon('M5 12a7 7 0 1 1 2 5M5 18v-5h5'));
  const value = el('span', { class: 'dial-value waiting' }, reset, field, unit, steps);
  const element = el('div', { class: 'dial step' },
    el('div', { class: 'dial-head' }, el('label', { for: 'step-slider' }, words.dock.step.label, el('i', {}, 'h'), ' ', suggested), value),
    el('div', { class: 'dial-track' }, slider, stops), message);
  // The slider goes from `largest` to `least`: over all stops, and as far as a step that was typed beyond them.
  let halves: number[] = [], largest = 0, least = 0, last = '', empty = '';

  const own = (): string => {
    const value = store.description?.settings.step;
    return value === null || value === undefined ? '' : short(value, 15);
  };
  /** From the largest step, at the left, to the smallest. */
  const positionOf = (h: number): number => Math.round(positions * Math.log(largest / h) / Math.log(largest / least));
  const stepOf = (position: number): number => largest * (least / largest) ** (position / positions);
  const written = (h: number): string => short(Number(h.toPrecision(halves.some((s) => Math.abs(s - h) < 1e-9 * s) ? 6 : 2)));

  function limits(): void {
    const { settings } = store.description ?? {};
    if (!settings || settings.step === null) return;
    const [times, count] = stagingOf(exampleOf(store.state)).stops ?? [4, 5];
    const span = settings.until === null ? Infinity : Math.abs(settings.until - settings.start);
    // A lesson that begins with a step of its own has its stops about that.
    const lesson = data.lessons.find(({ id }) => store.state.place.startsWith(`${id}.`)), base = Number(lesson?.scene.step) || settings.step;
    let first = base * times;
    while (first > span && first > base) first /= 2;
    halves = withAsked(Array.from({ length: count }, (_, k) => first / 2 ** k), base, lesson?.attempt.tasks.flatMap(({ condition: c }) => (c.kind === 'step' ? [c.value] : [])) ?? []);
    largest = halves[0]!;
    least = halves[halves.length - 1]!;
    stops.replaceChildren(...halves.map((h) => el('span', {}, compact(Number(h.toPrecision(3))))));
    stops.classList.toggle('long', [...stops.children].some((stop) => (stop.textContent ?? '').length > 7));
    placed();
  }
  /** Stops at their places. The wider the range, the fewer have room for their number. */
  function placed(): void {
    const close = largest > halves[0]! || least < halves[halves.length - 1]! ? NARROW : 0;
    let before = -Infinity;
    [...stops.children].forEach((stop, k) => {
      const at = 100 * positionOf(halves[k]!) / positions;
      (stop as HTMLElement).style.left = `${at}%`;
      (stop as HTMLElement).hidden = at - before < close;
      if (!(stop as HTMLElement).hidden) before = at;
    });
  }
  function reaching(h: number): void {
    if (h <= largest && h >= least) return;
    largest = Math.max(largest, h);
    least = Math.min(least, h);
    placed();
  }
  function refresh(): void {
    const { state, trouble, numbers, description } = store;
    if (document.activeElement !== field) { field.value = state.step || (own().length > 9 ? compact(Number(own())) : own()); empty = ''; }
    const wrong = empty || trouble.step, h = numbers.step ?? description?.settings.step ?? null;
    say(message, wrong || trouble.remark);
    message.classList.toggle('mild', wrong === '');
    field.setAttribute('aria-invalid', String(wrong !== ''));
    field.style.width = `${Math.max(3, field.value.length + 0.5)}ch`;
    reset.hidden = state.step === '';
    say(suggested, description?.settings.suggested && state.step === '' ? words.dock.step.suggested : '');
    const { units } = stagingOf(exampleOf(state));
    say(unit, units ? `\u2009${units.t}` : '');
    const track = store.scene?.solution.tracks[0];
    // The value grows to the left: it is not seen before all of it is known.
    if (track || Object.values(trouble).some(Boolean)) value.classList.remove('waiting');
    say(steps, track && !wrong ? `\u2009·\u2009${words.dock.step.steps(track.total, grouped(track.total))}` : '');
    if (h === null || !halves.length) return;
    reaching(h);
    if (document.activeElement !== slider || !slider.matches(':active')) slider.value = String(positionOf(h));
    slider.setAttribute('aria-valuetext', words.dock.step.value(short(h, 4), units?.t ?? '', track ? words.dock.step.steps(track.total, String(track.total)) : ''));
    [...stops.children].forEach((stop, k) => stop.classList.toggle('on', Math.abs(halves[k]! - h) < 1e-6 * h));
  }
  const set = (h: number): void => {
    const text = written(h);
    field.value = text;
    store.change({ step: Math.abs(Number(text) - Number(own())) < 1e-12 * Number(own()) ? '' : text });
  };
  slider.addEventListener('input', () => {
    if (!halves.length) return;
    const width = slider.clientWidth || 400, position = slider.valueAsNumber, near = halves.find((h) => Math.abs(position - positionOf(h)) / positions * width <= catching);
    set(near ?? stepOf(position));
  });
  slider.addEventListener('change', () => { slider.value = String(positionOf(store.numbers.step ?? largest)); });
  slider.addEventListener('keydown', (event) => {
    const way = event.key === 'ArrowRight' || event.key === 'ArrowUp' ? 1 : event.key === 'ArrowLeft' || event.key === 'ArrowDown' ? -1 : 0;
    if (!way || event.ctrlKey || event.altKey || event.metaKey || !halves.length) return;
    event.preventDefault();
    const h = Number(field.value) || store.numbers.step || halves[0]!;
    if (event.shiftKey) { set(h * (way > 0 ? 0.99 : 1.01)); return; }
    const at = way > 0 ? halves.find((s) => s < h * (1 - 1e-9)) : [...halves].reverse().find((s) => s > h * (1 + 1e-9));
    if (at !== undefined) set(at);
    else if (way < 0 ? largest > h * (1 + 1e-9) : least < h * (1 - 1e-9)) set(way < 0 ? largest : least);
  });
  field.addEventListener('input', () => {
    const text = normal(field.value);
    empty = text ? (text.length > 200 ? words.dock.long : '') : words.dock.step.needed(own());
    if (empty) refresh(); else store.change({ step: text === own() ? '' : text });
  });
  field.addEventListener('focus', () => { if (!store.state.step) { field.value = own(); field.select(); } });
  field.addEventListener('blur', refresh);
  store.subscribe((what) => {
    const key = `${exampleOf(store.state)} ${store.description?.settings.step} ${store.description?.settings.until} ${store.state.place.split('.')[0]}`;
    if (what === 'description' && last !== key && store.description) { last = key; limits(); }
    element.inert = outdated(store);
    if (what !== 'view' && what !== 'busy') refresh();
  });
  return element;
}
