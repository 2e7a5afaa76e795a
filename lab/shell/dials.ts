/* The two or three numbers of a scene that matter most, in the dock: those that the scene names, else the first that the model has; and its switch.
 *
 * Invariant: rows are rebuilt only when the model has other parameters; what a slider does not touch keeps the text that the model has (sliders.ts).
 */
import { exampleOf, stagingOf } from '../data';
import type { Parameter } from '../protocol';
import { presetState } from '../share';
import type { Dial } from '../stage/staging';
import { saidOf } from '../scenes';
import { outdated, type LiveStore } from '../state';
import { el } from '../dom';
import { presets } from './presets';
import { axes, held, partName, rowsOf, type Row } from './sliders';

const most = 3;

/** A dial's name in an address. */
const nameOf = (p: Parameter, part: number): string => partName(p, part, p.values.length);

/** What the reader calls a number of an example; undefined: by its own name. */
const labelOf = (model: string, { name, part }: Dial): string | undefined => saidOf(model)?.dials?.[part === undefined ? name : `${name}.${axes[part]}`];

/** The dials of the dock: their names in an address, and what the reader calls them. */
export function dialsOf({ description, state }: LiveStore): { readonly name: string; readonly label: string }[] {
  if (!description) return [];
  const model = presets.text(state.preset) === state.text ? state.preset : '';
  return (stagingOf(model).dials ?? usual(description.parameters)).flatMap((dial) => {
    const p = description.parameters.find((q) => q.name === dial.name), name = p ? nameOf(p, dial.part ?? 0) : '';
    return p ? [{ name, label: labelOf(model, dial) ?? name }] : [];
  });
}

/** Where a scene names none: parameters that are numbers, then initial values. */
function usual(parameters: readonly Parameter[]): Dial[] {
  const dials: Dial[] = [];
  for (const p of [...parameters.filter((q) => !q.initial), ...parameters.filter((q) => q.initial)]) {
    if (p.values.length > 3 || p.list) continue;
    p.values.forEach((_, part) => { if (dials.length < most) dials.push({ name: p.name, part }); });
  }
  return dials;
}

export function dials(store: LiveStore): HTMLElement {
  const element = el('div', { class: 'dials-more' });
  const slide = el('input', { type: 'checkbox', id: 'scene-switch', role: 'switch' }), slideName = el('span', {});
  const slideRow = el('label', { class: 'dial switch', for: 'scene-switch' }, slideName, slide, el('span', { class: 'switch-track', 'aria-hidden': 'true' }));
  let rows: Row[] = [], shown = '';

  slide.addEventListener('change', () => {
    const { state } = store, staging = stagingOf(state.preset), to = staging.switch?.to;
    if (to === undefined || presets.text(to) === undefined) return;
    // What both models have goes along: start, step, methods, and the lesson that one is in.
    store.load({ ...presetState(presets, to), set: Object.fromEntries(Object.entries(state.set).filter(([name]) => /\(/.test(name))), methods: state.methods, step: state.step, tolerance: state.tolerance, accuracy: state.accuracy, until: state.until, view: state.view, place: state.place });
  });
  function build(): void {
    const { description, state } = store;
    if (!description || store.trouble.model) return;
    const model = exampleOf(state), staging = stagingOf(model);
    const key = JSON.stringify([staging === stagingOf('') ? '' : state.preset, description.parameters.map((p) => [p.name, p.initial ? p.values : p.text, p.list])]);
    if (key === shown) return;
    shown = key;
    const focused = held(element);
    const { embed } = state, named = staging.dials ?? [], every = (): Dial[] => description.parameters.flatMap((p) => p.values.map((_, part) => named.find((d) => d.name === p.name && (d.part ?? 0) === part) ?? { name: p.name, part }));
    // Inside another page, those that the address chooses.
    const wanted = embed ? every().filter(({ name, part = 0 }) => embed.includes(nameOf(description.parameters.find((p) => p.name === name)!, part))) : staging.dials ?? usual(description.parameters);
    rows = wanted.flatMap((dial) => {
      const parameter = description.parameters.find((p) => p.name === dial.name);
      if (!parameter) return [];
      const made = rowsOf(store, parameter, state.text, () => ({ ...dial, label: labelOf(model, dial), dial: true }));
      const row = made.find((r) => r.part === (dial.part ?? 0));
      return row ? [row] : [];
    });
    const turn = staging.switch;
    slideName.textContent = (turn && saidOf(model)?.switch) ?? '';
    slide.checked = turn?.on ?? false;
    element.replaceChildren(...rows.map((r) => r.element), ...(turn && !embed ? [slideRow] : []));
    focused();
  }
  store.subscribe((what) => {
    if (what === 'description') build();
    element.inert = outdated(store);
    if (what === 'state' || what === 'description' || what === 'scene') for (const row of rows) row.refresh();
  });
  return element;
}
