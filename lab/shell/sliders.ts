/* Parameters and initial values as sliders with numbers.
 *
 * Invariant: the rows are rebuilt only when the model has other parameters; while a slider is dragged nothing but numbers changes. What a slider does
 * not touch keeps the text that the model has, so an untouched component keeps its bits.
 */
import type { Parameter } from '../protocol';
import { outdated, type LiveStore } from '../state';
import { button, el, fresh, icon, say } from '../dom';
import { nameText } from '../figure/name';
import { words } from '../words';
import { compact, normal, numberOf, short, tuple } from './number';
import { reach, widen, type Reach } from './range';

const mostRows = 40;
export interface Row { readonly element: HTMLElement; readonly part: number; refresh(): void }

export const axes = ['x', 'y', 'z'] as const;
/** How a number is called: by its parameter, and by its component where there are several. */
export function partName(parameter: Parameter, k: number, count: number): string {
  if (count === 1 && parameter.components === 0 && !parameter.list) return parameter.name;
  return parameter.list || count > 3 ? `${parameter.name}[${k + 1}]` : `${parameter.name}.${axes[k] ?? k + 1}`;
}

/** A number of things rather than a size: an upper end of an index. */
const counts = (text: string, name: string): boolean => /^[A-Za-z]\w*$/.test(name) && new RegExp(`\\.\\.[^:\\n]*\\b${name}\\b`).test(text);

/** How a row is called and how far its slider goes, where a scene says so. */
export interface Manner { readonly label?: string; readonly unit?: string; readonly low?: number; readonly high?: number; readonly dial?: boolean }

export function rowsOf(store: LiveStore, parameter: Parameter, model: string, manner: (part: number) => Manner = () => ({})): Row[] {
  const literal = tuple(parameter.text);
  const fits = literal !== null && literal.parts.length === parameter.values.length;
  // Numbers that the model computes follow its parameters; a single initial value may be moved all the same, and then stands for itself.
  if (!fits && !(parameter.initial && !parameter.list && parameter.values.length <= 3)) return [];
  const [open, close] = fits ? [literal.open, literal.close] : parameter.components > 0 ? ['(', ')'] : ['', ''];
  const values = fits ? literal.parts.map(Number) : parameter.values;
  const scale = Math.max(...values.map(Math.abs)), several = values.length > 1;
  const latest = (): readonly string[] => {
    const now = store.scene?.state.text === model ? store.scene.solution.description.parameters.find(p => p.name === parameter.name) : undefined;
    return (now?.values.length === values.length ? now.values : parameter.values).map(String);
  };
  const own = (): readonly string[] => (fits ? literal.parts : latest());
  const isSet = (): boolean => Object.hasOwn(store.state.set, parameter.name);
  const current = (): readonly string[] => {
    const parts = isSet() ? tuple(store.state.set[parameter.name] ?? '')?.parts : null;
    return parts?.length === values.length ? parts : isSet() ? latest() : own();
  };
  const write = (k: number, text: string): void => {
    const parts = current().map((part, i) => (i === k ? text : part));
    const { [parameter.name]: _, ...others } = store.state.set;
    const unchanged = fits && parts.every((part, i) => Number(part) === values[i]);
    store.change({ set: unchanged ? others : { ...others, [parameter.name]: open + parts.join(', ') + close } });
  };
  /** This component back to the model's; the others too where they were computed together. */
  const restore = (k: number): void => {
    const { [parameter.name]: _, ...others } = store.state.set;
    if (fits) write(k, literal.parts[k] as string); else store.change({ set: others });
  };

  return values.map((value, k): Row => {
    const { label, unit, low, high, dial = false } = manner(k), name = label ?? partName(parameter, k, values.length), id = fresh('parameter');
    let limits: Reach = reach(value, several ? scale : 0, parameter.initial || several, counts(model, parameter.name));
    if (low !== undefined && high !== undefined && value >= low && value <= high) limits = { low, high, step: limits.step };
    const digits = (text: string): string => (text.length <= 9 ? text : compact(Number(text)));
    const slider = el('input', { type: 'range', id, 'data-name': `${parameter.name} ${k}`, 'aria-describedby': id + '-message' });
    const field = el('input', { type: 'text', 'data-name': `${parameter.name} ${k} field`, inputmode: 'decimal', 'aria-label': words.dock.sliders.field(name), autocomplete: 'off', class: dial ? 'value' : 'number' });
    const message = el('p', { id: id + '-message', class: 'message', role: 'status' });
    const reset = button('', () => { restore(k); refresh(); slider.focus(); }, { class: 'icon-button reset', 'aria-label': words.dock.sliders.reset(name), title: words.dock.sliders.resetTitle },
      icon('M5 12a7 7 0 1 1 2 5M5 18v-5h5'));
    const caption = el('label', { for: id, title: name }, dial && !label ? nameText(name) : name);
    const element = dial ? el('div', { class: 'dial' }, el('div', { class: 'dial-head' }, caption, el('span', { class: 'dial-value' }, reset, field, el('span', { class: 'unit' }, unit ? `\u2009${unit}` : ''))),
      el('div', { class: 'dial-track' }, slider), message) : el('div', { class: 'row' }, caption, slider, field, reset, message);

    const limit = (): void => { slider.min = String(limits.low); slider.max = String(limits.high); slider.step = String(limits.step); };
    limit();
    function refresh(): void {
      const text = current()[k] ?? '', number = Number(text);
      const wider = widen(limits, number);
      if (wider !== limits) { limits = wider; limit(); }
      if (document.activeElement !== slider) slider.value = text;
      slider.setAttribute('aria-valuetext', digits(text));      // its own steps are coarser than the number
      if (document.activeElement !== field) { field.value = digits(text); say(message, ''); field.removeAttribute('aria-invalid'); }
      const changed = fits ? number !== value : isSet();
      reset.classList.toggle('shown', changed);
      reset.disabled = !changed;
      if (dial) { reset.hidden = !changed; field.style.width = `${Math.max(2, field.value.length + 0.5)}ch`; }
    }
    slider.addEventListener('input', () => {
      const text = short(slider.valueAsNumber);
      field.value = digits(text);
      slider.setAttribute('aria-valuetext', digits(text));
      write(k, text);
    });
    const commit = (): void => {
      const number = numberOf(field.value);
      const complaint = field.value.trim() === '' ? words.dock.sliders.needed(own()[k] ?? '')
        : number === null ? words.dock.sliders.number : '';
      say(message, complaint);
      if (complaint) { field.setAttribute('aria-invalid', 'true'); return; }
      field.removeAttribute('aria-invalid');
      write(k, normal(field.value));
      slider.value = String(number);
    };
    field.addEventListener('focus', () => { if (field.getAttribute('aria-invalid') !== 'true') { field.value = current()[k] ?? ''; field.select(); } });
    field.addEventListener('input', commit);
    field.addEventListener('blur', () => { if (field.getAttribute('aria-invalid') !== 'true') refresh(); });
    field.addEventListener('keydown', event => { if (event.key === 'Escape') { field.blur(); refresh(); } });
    refresh();
    return { element, part: k, refresh };
  });
}

/** Which control has the focus, by its name; the answer gives it back to its successor. */
export function held(within: HTMLElement): () => void {
  const control = document.activeElement, name = control instanceof HTMLInputElement && within.contains(control) ? control.dataset.name : undefined;
  return () => { if (name !== undefined && document.activeElement !== control) within.querySelector<HTMLElement>(`[data-name="${CSS.escape(name)}"]`)?.focus({ preventScroll: true }); };
}

export function sliders(store: LiveStore): HTMLElement {
  const parameters = el('div', { class: 'rows' }), initial = el('div', { class: 'rows' });
  const first = el('fieldset', {}, el('legend', {}, words.dock.sliders.parameters), parameters), second = el('fieldset', {}, el('legend', {}, words.dock.sliders.start), initial);
  const problem = el('p', { class: 'message', role: 'status' });
  const element = el('div', { class: 'sliders' }, first, second, problem);
  let rows: Row[] = [], shown = '';
  function build(): void {
    const description = store.description;
    if (!description || store.trouble.model) return;
    const key = JSON.stringify(description.parameters.map(p => [p.name, p.initial ? p.values : p.text, p.list]));
    if (key === shown) return;
    shown = key;
    const focused = held(element);
    rows = [];
    parameters.replaceChildren();
    initial.replaceChildren();
    for (const parameter of description.parameters) {
      const own = rowsOf(store, parameter, store.state.text).slice(0, mostRows);
      if (!own.length || rows.length > mostRows) continue;
      rows.push(...own);
      const target = parameter.initial ? initial : parameters, elements = own.map(row => row.element);
      // A long list would push everything else out of sight.
      target.append(...(own.length > 3 ? [el('details', {}, el('summary', {}, words.dock.sliders.many(parameter.name, String(own.length))), el('div', { class: 'rows' }, ...elements))] : elements));
    }
    first.hidden = parameters.childElementCount === 0;
    second.hidden = initial.childElementCount === 0;
    focused();
  }
  store.subscribe(what => {
    if (what === 'description') build();
    for (const set of [first, second]) set.inert = outdated(store);
    if (what === 'state' || what === 'description' || what === 'scene') for (const row of rows) row.refresh();
    if (what === 'description' || what === 'scene') say(problem, store.trouble.run ? words.trouble.hinted(store.trouble.run.message, store.trouble.run.hint) : '');
  });
  return element;
}
