/* The examples: every model of models/, with a short name, its place in the list, the methods it is shown with, and what to look for.
 *
 * Invariant: the list is that of the build. A model without an entry here is offered under its own name, last. Descriptions are the models' own:
 * the sentence that their first comment begins with.
 */
import models from 'virtual:presets';
import { presetState, type Presets } from '../share';
import { notes } from '../theory/presets';
import type { LiveStore } from '../state';
import { button, el, say } from '../dom';
import { ownTitle } from './title';
import type { Toasts } from './toasts';

type Note = readonly (string | { readonly to: string; readonly label: string })[];
interface Entry { readonly title: string; readonly group: string; readonly methods: readonly string[]; readonly mark?: string; readonly note?: Note }

const groups = ['Begin here', 'Oscillators', 'Pendulums', 'Orbits', 'In a field', 'Many bodies', 'More'] as const;

const entries: Readonly<Record<string, Entry>> = {
  'projectile': {
    title: 'Thrown ball', group: 'Begin here', methods: ['explicit-euler', 'symplectic-euler', 'midpoint'], mark: 'founding scene',
    note: [
      'Thrown like this, with g = 9.81 and the step 0.05, explicit Euler is after three seconds 0.7357 above the green parabola and symplectic Euler 0.7357 below it; the midpoint rule and Verlet are exact, because the ',
      'acceleration never changes. So this scene cannot tell which method is good: on ',
      { to: 'spring', label: 'the spring' }, ' they differ. Nor can it tell heavy from light: under gravity alone the mass cancels, and m changes the energy but not the path. ',
      { to: 'projectile-drag', label: 'With air drag' }, ' it matters.',
    ],
  },
  'spring': {
    title: 'Mass on a spring', group: 'Begin here', methods: ['explicit-euler', 'symplectic-euler', 'verlet'],
  },
  'projectile-drag': {
    title: 'Thrown ball with air drag', group: 'Begin here', methods: ['explicit-euler', 'midpoint', 'verlet'],
    note: ['Drag divided by mass is what slows the ball, so a heavier one flies further. No formula gives this motion; the green line is a reference, computed with its own error. Back to ',
      { to: 'projectile', label: 'the ball without air' }, '.'],
  },
  'driven-oscillator': { title: 'Driven oscillator', group: 'Oscillators', methods: ['verlet'], mark: 'founding notebook, first example' },
  'damped-cubic': { title: 'Damped cubic spring', group: 'Oscillators', methods: ['verlet'], mark: 'founding notebook, second example' },
  'damped-spring': { title: 'Damped spring', group: 'Oscillators', methods: ['verlet', 'explicit-euler'] },
  'duffing': { title: 'Duffing’s oscillator', group: 'Oscillators', methods: ['verlet', 'rk4'] },
  'van-der-pol': { title: 'Van der Pol’s oscillator', group: 'Oscillators', methods: ['rk4', 'verlet'] },
  'pendulum': { title: 'Pendulum', group: 'Pendulums', methods: ['explicit-euler', 'velocity-verlet'] },
  'double-pendulum': { title: 'Double pendulum', group: 'Pendulums', methods: ['gauss6', 'rk4'] },
  'kepler': { title: 'Planet and sun', group: 'Orbits', methods: ['kahan-li8', 'velocity-verlet', 'rk4'] },
  'three-body-figure-eight': { title: 'Three bodies in an eight', group: 'Orbits', methods: ['kahan-li6', 'velocity-verlet'] },
  'arenstorf': { title: 'Between Earth and Moon', group: 'Orbits', methods: ['gauss8'] },
  'outer-solar-system': { title: 'Outer solar system', group: 'Orbits', methods: ['kahan-li8', 'velocity-verlet'] },
  'henon-heiles': { title: 'Star in a galaxy', group: 'Orbits', methods: ['pefrl', 'velocity-verlet'] },
  'charged-particle': { title: 'Charged particle', group: 'In a field', methods: ['boris', 'rk4'] },
  'penning-trap': { title: 'Penning trap', group: 'In a field', methods: ['boris', 'rk4'] },
  'chain': { title: 'Chain of springs', group: 'Many bodies', methods: ['velocity-verlet'] },
};

const texts = new Map(models.map(model => [model.name, model.text]));
const entryOf = (name: string): Entry | undefined => (Object.hasOwn(entries, name) ? entries[name] : undefined);

export const presets: Presets = {
  first: 'projectile',
  text: name => texts.get(name),
  methods: name => entryOf(name)?.methods ?? [],
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

export const titleOf = (name: string): string => entryOf(name)?.title ?? name;

/** The picker of the header, and what it picked: title, description, note. */
export function presetPicker(store: LiveStore, toasts: Toasts): { readonly picker: HTMLElement; readonly card: HTMLElement; readonly note: HTMLElement } {
  const own = el('option', { value: '' }, 'Your own model');
  const select = el('select', { id: 'preset', 'aria-describedby': 'preset-description' });
  const sorted = groups.map(group => ({ group, names: models.map(m => m.name).filter(name => (entryOf(name)?.group ?? 'More') === group) }));
  const order = Object.keys(entries);
  for (const { group, names } of sorted) {
    if (!names.length) continue;
    names.sort((a, b) => order.indexOf(a) - order.indexOf(b));
    select.append(el('optgroup', { label: group }, ...names.map(name => {
      const mark = entryOf(name)?.mark;
      return el('option', { value: name, title: described(texts.get(name) ?? '') }, titleOf(name) + (mark ? ` · ${mark}` : ''));
    })));
  }
  const title = el('h1', { id: 'scene-title' }), mark = el('p', { class: 'mark' });
  const description = el('p', { id: 'preset-description', class: 'description' }), note = el('div', { class: 'note' });
  const revert = button('Back to the example', () => { open(store.state.preset); }, { class: 'text-button' });
  const began = document.createTextNode('');
  const edited = el('p', { class: 'edited' }, began, revert);
  const card = el('div', { class: 'scene-card' }, title, mark, description, edited);

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
    const entry = entryOf(name);
    say(title, name === '' ? ownTitle(text) || 'Your own model' : titleOf(name));
    say(mark, entry?.mark ?? '');
    mark.hidden = !entry?.mark;
    say(description, name === '' && ownTitle(text) ? '' : described(text));
    description.hidden = description.textContent === '';
    const words = (entry?.note ?? []).map(part => (typeof part === 'string' ? part : button(part.label, () => open(part.to), { class: 'text-button' })));
    const written = Object.hasOwn(notes, name) ? notes[name]?.text ?? [] : [];
    note.replaceChildren(...(words.length ? [el('p', {}, ...words)] : written.map(paragraph => el('p', {}, paragraph))));
    note.hidden = note.childElementCount === 0;
  }
  store.subscribe(what => { if (what === 'state') show(); });
  show();
  return { picker: el('div', { class: 'preset-picker' }, el('label', { for: 'preset' }, 'Example'), select), card, note };
}
