/* The examples: every model of models/, as scenes.ts names and sorts them, and what is said of each.
 *
 * Invariant: the list is that of the build. A model without a scene is offered under its own name, last. Descriptions are the models' own:
 * the sentence that their first comment begins with.
 */
import models from 'virtual:presets';
import { presetState, type Presets } from '../share';
import { sceneOf, scenes, themes } from '../scenes';
import { notes } from '../theory/presets';
import type { LiveStore } from '../state';
import { button, el, say } from '../dom';
import type { Toasts } from './toasts';

type Note = readonly (string | { readonly to: string; readonly label: string })[];

/** Notes that lead to another example. */
const linked: Readonly<Record<string, Note>> = {
  'projectile': [
    'Thrown like this, with g = 9.81 and the step 0.05, explicit Euler is after three seconds 0.7357 above the green parabola and symplectic Euler 0.7357 below it; the midpoint rule and Verlet are exact, because the ',
    'acceleration never changes. So this scene cannot tell which method is good: on ',
    { to: 'spring', label: 'the spring' }, ' they differ. Nor can it tell heavy from light: under gravity alone the mass cancels, and m changes the energy but not the path. ',
    { to: 'projectile-drag', label: 'With air drag' }, ' it matters.',
  ],
  'projectile-drag': ['Drag divided by mass is what slows the ball, so a heavier one flies further. No formula gives this motion; the green line is a reference, computed with its own error. Back to ',
    { to: 'projectile', label: 'the ball without air' }, '.'],
};

const texts = new Map(models.map(model => [model.name, model.text]));

export const presets: Presets = {
  first: 'thrown-ball',
  text: name => texts.get(name),
  methods: name => sceneOf(name)?.methods ?? [],
  set: name => sceneOf(name)?.set ?? {},
};

/** The first sentence of a model's own comment. */
export function described(text: string): string {
  const comment: string[] = [];
  for (const line of text.split('\n')) {
    const words = /^#\s?(.*)$/.exec(line)?.[1];
    if (words === undefined || (words.trim() === '' && comment.length)) break;
    comment.push(words.trim());
  }
  return /^.*?\.(?=\s|$)/s.exec(comment.join(' '))?.[0] ?? comment.join(' ');
}

export const titleOf = (name: string): string => sceneOf(name)?.title ?? name;

/** The picker of the header, and what it picked: title, description, note. */
export function presetPicker(store: LiveStore, toasts: Toasts): { readonly picker: HTMLElement; readonly card: HTMLElement; readonly note: HTMLElement } {
  const own = el('option', { value: '' }, 'Your own model');
  const select = el('select', { id: 'preset', 'aria-describedby': 'preset-description' });
  const option = (name: string): HTMLOptionElement => el('option', { value: name, title: described(texts.get(name) ?? '') }, titleOf(name));
  for (const theme of themes) select.append(el('optgroup', { label: theme }, ...scenes.filter(scene => scene.theme === theme).map(scene => option(scene.model))));
  select.append(el('optgroup', { label: 'More' }, ...[...texts.keys()].filter(name => !sceneOf(name)?.theme).map(option)));
  const title = el('h1', { id: 'scene-title' });
  const description = el('p', { id: 'preset-description', class: 'description' }), note = el('div', { class: 'note' });
  const revert = button('Back to the example', () => { open(store.state.preset); }, { class: 'text-button' });
  const began = document.createTextNode('');
  const edited = el('p', { class: 'edited' }, began, revert);
  const card = el('div', { class: 'scene-card' }, title, description, edited);

  function open(name: string): void {
    const before = store.state;
    const changed = texts.get(before.preset) !== before.text;
    store.load({ ...presetState(presets, name), view: { ...before.view, plane: 'auto', quantities: [], phase: null } });
    if (changed) toasts.say('Your own text was put aside.', { label: 'Bring it back', act: () => store.load(before) });
  }
  select.addEventListener('change', () => { if (select.value) open(select.value); });

  let shown = '';
  function show(): void {
    const { preset, text } = store.state, changed = texts.get(preset) !== text;
    if (preset === '' && !own.isConnected) select.prepend(own);
    if (preset !== '' && own.isConnected) own.remove();
    if (select.value !== preset) select.value = preset;
    edited.hidden = preset === '' || !changed;
    // What is said of an example holds for its own text only.
    const name = changed ? '' : preset, key = name === '' ? `${preset} ${text}` : name;
    if (key === shown) return;
    shown = key;
    began.data = preset === '' ? '' : `It began as “${titleOf(preset)}”. `;
    say(title, name === '' ? 'Your own model' : titleOf(name));
    say(description, described(text));
    description.hidden = description.textContent === '';
    const words = (Object.hasOwn(linked, name) ? linked[name] ?? [] : []).map(part => (typeof part === 'string' ? part : button(part.label, () => open(part.to), { class: 'text-button' })));
    const written = Object.hasOwn(notes, name) ? notes[name]?.text ?? [] : [];
    note.replaceChildren(...(words.length ? [el('p', {}, ...words)] : written.map(paragraph => el('p', {}, paragraph))));
    note.hidden = note.childElementCount === 0;
  }
  store.subscribe(what => { if (what === 'state') show(); });
  show();
  return { picker: el('div', { class: 'preset-picker' }, el('label', { for: 'preset' }, 'Example'), select), card, note };
}
