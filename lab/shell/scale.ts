/* A number that goes over powers, the step or the tolerance: a slider on a scale of powers with stops, and the number itself as a field.
 *
 * Invariant: what the field shows is what the reader typed; what is wrong with it is said under it, and the last good picture stays. Stops belong to the
 * model, not to the state: they do not move under the reader's hand. The knob stands where the number is: one that is typed beyond the stops widens the
 * range.
 */
import { outdated, type Happening, type LiveStore } from '../state';
import { button, el, icon, say } from '../dom';
import { words } from '../words';
import { compact, normal, short } from './number';

const positions = 1000, catching = 6;               // pixels within which a stop catches
/** Of its range, between two numbers under it. */
const NARROW = 12;

export interface Scale {
  /** Of the elements: `id`, `id`-slider, `id`-message. */
  readonly id: string; readonly symbol: string;
  readonly words: {
    readonly label: string; readonly slider: string; readonly field: string; readonly reset: string; readonly resetTitle: string; needed(own: string): string;
  };
  /** The model's own number. */
  own(): number | null;
  /** As the reader typed it; '': the model's. */
  typed(): string;
  change(text: string): void;
  /** What it comes to. */
  now(): number | null;
  wrong(): string; remark(): string;
  /** From large to small; null: not known yet. They are asked for anew where `of` differs. */
  stops(): readonly number[] | null; of(): string;
  /** A stop under the slider. */
  stop(value: number): string;
  /** The number in as few digits as its place asks for. */
  written(value: number, onStop: boolean): string;
  /** Factors of a small step with the keys: on, and back. */
  readonly fine: readonly [number, number];
  /** Beside the label; behind the number; the same spoken. */
  hint(): string; unit(): string; beside(): string; spoken(value: number): string;
}
export interface ScaleDial { readonly element: HTMLElement; /** The stops are made anew. */ limits(): void; refresh(): void }

export function scaleDial(store: LiveStore, scale: Scale): ScaleDial {
  const texts = scale.words, { id } = scale;
  const slider = el('input', { type: 'range', min: 0, max: positions, step: 1, id: `${id}-slider`, 'aria-label': texts.slider });
  const field = el('input', { id, type: 'text', inputmode: 'text', autocomplete: 'off', spellcheck: 'false', class: 'value', 'aria-label': texts.field, 'aria-describedby': `${id}-message` });
  const unit = el('span', { class: 'unit' }), beside = el('span', { class: 'steps' }), hint = el('i', { class: 'suggested' });
  const message = el('p', { id: `${id}-message`, class: 'message', role: 'status' });
  const marks = el('div', { class: 'stops', 'aria-hidden': 'true' });
  const reset = button('', () => { scale.change(''); slider.focus(); refresh(); }, { class: 'icon-button reset', 'aria-label': texts.reset, title: texts.resetTitle },
    icon('M5 12a7 7 0 1 1 2 5M5 18v-5h5'));
  const value = el('span', { class: 'dial-value waiting' }, reset, field, unit, beside);
  const element = el('div', { class: `dial step scale-${id}` },
    el('div', { class: 'dial-head' }, el('label', { for: `${id}-slider` }, texts.label, el('i', {}, scale.symbol), ' ', hint), value),
    el('div', { class: 'dial-track' }, slider, marks), message);
  // The slider goes from `largest` to `least`: over all stops, and as far as a number that was typed beyond them.
  let stops: readonly number[] = [], largest = 0, least = 0, empty = '', last = '';

  const own = (): string => { const value = scale.own(); return value === null ? '' : short(value, 15); };
  /** From the largest, at the left, to the smallest. */
  const positionOf = (h: number): number => Math.round(positions * Math.log(largest / h) / Math.log(largest / least));
  const at = (position: number): number => largest * (least / largest) ** (position / positions);

  function limits(): void {
    const found = scale.stops();
    if (!found) return;
    stops = found;
    largest = stops[0]!;
    least = stops[stops.length - 1]!;
    marks.replaceChildren(...stops.map((h) => el('span', {}, scale.stop(h))));
    marks.classList.toggle('long', [...marks.children].some((mark) => (mark.textContent ?? '').length > 7));
    placed();
  }
  /** Stops at their places. The wider the range, the fewer have room for their number. */
  function placed(): void {
    const close = largest > stops[0]! || least < stops[stops.length - 1]! ? NARROW : 0;
    let before = -Infinity;
    [...marks.children].forEach((mark, k) => {
      const place = 100 * positionOf(stops[k]!) / positions;
      (mark as HTMLElement).style.left = `${place}%`;
      (mark as HTMLElement).hidden = place - before < close;
      if (!(mark as HTMLElement).hidden) before = place;
    });
  }
  function reaching(h: number): void {
    if (h <= largest && h >= least) return;
    largest = Math.max(largest, h);
    least = Math.min(least, h);
    placed();
  }
  function refresh(): void {
    const { trouble } = store;
    if (document.activeElement !== field) { field.value = scale.typed() || (own().length > 9 ? compact(Number(own())) : own()); empty = ''; }
    const wrong = empty || scale.wrong(), h = scale.now();
    say(message, wrong || scale.remark());
    message.classList.toggle('mild', wrong === '');
    field.setAttribute('aria-invalid', String(wrong !== ''));
    field.style.width = `${Math.max(3, field.value.length + 0.5)}ch`;
    reset.hidden = scale.typed() === '';
    say(hint, scale.hint());
    say(unit, scale.unit());
    // The value grows to the left: it is not seen before all of it is known.
    if (store.scene || Object.values(trouble).some(Boolean)) value.classList.remove('waiting');
    say(beside, wrong ? '' : scale.beside());
    if (h === null || !stops.length) return;
    reaching(h);
    if (document.activeElement !== slider || !slider.matches(':active')) slider.value = String(positionOf(h));
    slider.setAttribute('aria-valuetext', scale.spoken(h));
    [...marks.children].forEach((mark, k) => mark.classList.toggle('on', Math.abs(stops[k]! - h) < 1e-6 * h));
  }
  const set = (h: number): void => {
    const text = scale.written(h, stops.some((s) => Math.abs(s - h) < 1e-9 * s));
    field.value = text;
    scale.change(Math.abs(Number(text) - Number(own())) < 1e-12 * Number(own()) ? '' : text);
  };
  slider.addEventListener('input', () => {
    if (!stops.length) return;
    const width = slider.clientWidth || 400, position = slider.valueAsNumber, near = stops.find((h) => Math.abs(position - positionOf(h)) / positions * width <= catching);
    set(near ?? at(position));
  });
  slider.addEventListener('change', () => { slider.value = String(positionOf(scale.now() ?? largest)); });
  slider.addEventListener('keydown', (event) => {
    const way = event.key === 'ArrowRight' || event.key === 'ArrowUp' ? 1 : event.key === 'ArrowLeft' || event.key === 'ArrowDown' ? -1 : 0;
    if (!way || event.ctrlKey || event.altKey || event.metaKey || !stops.length) return;
    event.preventDefault();
    const h = Number(field.value) || scale.now() || stops[0]!;
    if (event.shiftKey) { set(h * scale.fine[way > 0 ? 0 : 1]); return; }
    const next = way > 0 ? stops.find((s) => s < h * (1 - 1e-9)) : [...stops].reverse().find((s) => s > h * (1 + 1e-9));
    if (next !== undefined) set(next);
    else if (way < 0 ? largest > h * (1 + 1e-9) : least < h * (1 - 1e-9)) set(way < 0 ? largest : least);
  });
  field.addEventListener('input', () => {
    const text = normal(field.value);
    empty = text ? (text.length > 200 ? words.dock.long : '') : texts.needed(own());
    if (empty) refresh(); else scale.change(text === own() ? '' : text);
  });
  field.addEventListener('focus', () => { if (!scale.typed()) { field.value = own(); field.select(); } });
  field.addEventListener('blur', refresh);
  store.subscribe((what: Happening) => {
    if (what === 'description' && last !== scale.of() && store.description) { last = scale.of(); limits(); }
    element.inert = outdated(store);
    if (what !== 'view' && what !== 'busy') refresh();
  });
  return { element, limits, refresh };
}
