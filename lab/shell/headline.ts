/* The words on the stage: the title, a sentence or two, the question that the picture asks, and the equation, which opens the editor.
 *
 * Invariant: what is said of an example holds for its own text only; of a changed text the words are its own comment's.
 */
import { grouped } from '../figure/number';
import { exampleOf, stagingOf } from '../data';
import type { LiveStore } from '../state';
import { saidOf } from '../scenes';
import { presetState, viewFor } from '../share';
import { words } from '../words';
import { button, el, icon, place, say } from '../dom';
import { editor } from './editor';
import { toNote } from './note';
import { described, presets, titleIn, titleOf } from './presets';
import { settle } from './settle';
import type { Sees } from '../stage/stage';
import type { Toasts } from './toasts';
import { math, typesetView } from './typeset';

export interface Headline { readonly element: HTMLElement; openEditor(open: boolean): void; readonly editing: () => boolean }

/** sees: what the stage shows; changed: its room is another one. */
export function headline(store: LiveStore, toasts: Toasts, sees: () => Sees, changed: () => void): Headline {
  const title = el('h1', { id: 'scene-title' }), sentence = el('p', { id: 'scene-words' }, document.getElementById('scene-words')?.textContent ?? '');
  const ask = el('p', { class: 'ask' }), pillMath = el('span', { class: 'pill-math' }, ...document.querySelectorAll('#words .pill-math > *'));
  const pill = button('', () => openEditor(true), { class: 'pill' }, pillMath, el('small', {}, words.headline.type));
  const began = document.createTextNode(''), revert = button(words.headline.back, () => { open(store.state.preset); }, { class: 'text-button' });
  const edited = el('p', { class: 'edited', hidden: true }, began, revert);
  const close = button(words.headline.close, () => openEditor(false), { class: 'text-button close' });
  const own = el('div', { class: 'own', hidden: true }, editor(store), settle(store), typesetView(store));
  const element = el('div', { class: 'words-inner' }, el('div', { class: 'words-head' }, title, close), sentence, ask, edited, pill, own);

  function open(name: string): void {
    const before = store.state, changedText = presets.text(before.preset) !== before.text;
    store.load({ ...presetState(presets, name), view: viewFor(presets, name, before.view) });
    if (changedText) toasts.say(words.headline.aside, { label: words.headline.bring, act: () => store.load(before) });
  }
  function openEditor(now: boolean): void {
    if (own.hidden !== now) return;
    own.hidden = !now;
    document.body.classList.toggle('editing', now);
    changed();
    if (!now) { pill.focus({ preventScroll: true }); return; }
    // At its top, where the title and the first lines are.
    own.querySelector('textarea')?.focus({ preventScroll: true });
    place('words').scrollTop = 0;
    place('words').scrollIntoView({ block: 'nearest' });
  }

  let shown = '', typeset = '', opened = false;
  function show(): void {
    const { preset, text } = store.state, name = exampleOf(store.state), altered = name === '';
    const steps = store.scene?.solution.tracks[0]?.total ?? 0, { set, step, until, methods } = store.state, moved = Boolean(Object.keys(set).length || step || until);
    const { ask: lesson, about: subject } = stagingOf(name), asks = subject === undefined || methods.includes(subject);
    const alone = store.scene !== null && sees().side !== 'phase', key = `${preset} ${name === '' ? text : ''} ${steps} ${moved} ${alone} ${asks}`;
    if (key === shown) return;
    shown = key;
    const said = saidOf(name), question = asks ? said?.question ?? '' : '', about = (moved ? said?.moved : undefined) ?? (alone ? said?.alone : undefined) ?? said?.sentence ?? '';
    say(title, titleIn(store.state));
    document.title = words.top.title(title.textContent ?? '');
    // Until steps are made, those of the build stand there.
    say(sentence, name === '' ? '' : (typeof about === 'string' ? about : steps ? about(words.headline.counted(steps, grouped(steps))) : sentence.textContent) || described(text));
    sentence.hidden = sentence.textContent === '';
    // A lesson answers it, or the note below.
    const answer = (): void => { if (lesson) element.dispatchEvent(new CustomEvent('lesson', { detail: lesson, bubbles: true })); else toNote(); };
    ask.replaceChildren(...(question ? [button(question, answer, { class: 'ask-button' },
      el('span', {}, question), icon(lesson ? 'M5 12h13M12.5 6l5.5 6-5.5 6' : 'M12 5v13M6 12.5l6 5.5 6-5.5'))] : []));
    edited.hidden = preset === '' || !altered;
    began.data = preset === '' ? '' : words.headline.began(titleOf(preset));
  }
  function equation(): void {
    const first = store.description?.statements.find((s) => s.kind === 'motion' || s.kind === 'first-order'), source = first?.mathml ?? '';
    if (source === typeset) return;
    typeset = source;
    const formula = source ? math(source) : null;
    pillMath.replaceChildren(...(formula ? [formula] : []));
    // A long equation is read in the editor. What is said beside it may be unseen, and does not count.
    if (formula && (pillMath.scrollWidth > pillMath.clientWidth + 1 || pillMath.getBoundingClientRect().right > pill.getBoundingClientRect().right)) pillMath.replaceChildren();
  }
  addEventListener('resize', show);
  store.subscribe((what) => {
    if (what === 'state') show();
    // After the stage, which knows what it shows.
    if (what === 'scene') queueMicrotask(show);
    // A text that could not be read from the beginning is what one has to see.
    if (store.trouble.model && !store.scene && !opened) { opened = true; pillMath.replaceChildren(); openEditor(true); }
    if (what === 'description' || what === 'scene') equation();
  });
  show();
  return { element, openEditor, editing: () => !own.hidden };
}
