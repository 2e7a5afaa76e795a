/* A lesson, in the place of the words: predict, try, see, why. Lessons are data (words/en/lessons/*.txt); how far one has come stands in the address.
 *
 * Invariant: nothing is judged: a guess is answered, a task ticks itself off by what the page does, and every part can be opened at any time. A task is a
 * button that does it, so no lesson asks for a control that a small screen has no room for.
 */
import { data } from '../data';
import { SEEK } from '../figure/cursor';
import { met, type Condition, type Lesson as Full } from '../lessons/read';
import { sceneOf } from '../scenes';
import { presetState, viewFor } from '../share';
import type { Stage } from '../stage/stage';
import type { LiveStore } from '../state';
import { button, el, icon, place, say } from '../dom';
import { words } from '../words';
import { closeUp } from './closeup';
import { recall, remember } from './memory';
import { presets } from './presets';
import { runs } from './runs';

type Lesson = Omit<Full, 'numbers'>;
const parts = ['predict', 'try', 'see', 'why'] as const;
type Part = (typeof parts)[number];
/** What scrolls where there is little room, and the button below it, which never does. */
type Body = readonly [readonly Node[], HTMLElement];
interface At { readonly lesson: Lesson; readonly number: number; readonly part: Part; readonly answer: number | null }

/** "too-high-too-low.try.0"; null: no lesson. */
function read(where: string): At | null {
  const [id = '', part = '', answer] = where.split('.'), number = data.lessons.findIndex((l) => l.id === id), lesson = data.lessons[number];
  if (!lesson || !parts.some((p) => p === part)) return null;
  return { lesson, number: number + 1, part: part as Part, answer: answer !== undefined && lesson.predict.choices[Number(answer)] ? Number(answer) : null };
}

export interface Lessons { readonly element: HTMLElement; readonly list: HTMLElement; open(id: string): void; readonly here: () => boolean }

/** A number and its unit stay on one line. */
const bound = (text: string): string => text.replace(/(\d) (?=[sm]\b)/g, '$1\u00a0');

/** clock: plays the motion from its start. */
export function lessonPlace(store: LiveStore, stage: Stage, clock: { replay(): void }): Lessons {
  const element = el('div', { class: 'lesson', hidden: true }), list = el('div', { id: 'lessons', class: 'sheet', popover: 'auto', role: 'group', 'aria-label': words.lesson.lessons });
  const opened = new Set<string>(), ticked = new Set<string>(), measured = runs(), finished = new Set((recall('lessons') ?? '').split(' ').filter(Boolean));
  let shown = '', arriving = false, stale = false, toEnd = false, chosen: number | null = null, ticks: (() => void) | null = null, sketch: (() => void) | null = null;

  function fill(): void {
    list.replaceChildren(el('h2', {}, words.lesson.lessons), el('ol', { class: 'lesson-list' }, ...data.lessons.map((lesson) => el('li', {},
      button('', () => { list.hidePopover(); open(lesson.id); }, { 'aria-current': read(store.state.place)?.lesson === lesson && 'true' }, el('span', {}, lesson.title), el('small', {}, finished.has(lesson.id) ? words.lesson.done : ''))))));
  }
  list.addEventListener('beforetoggle', (event) => { if ((event as ToggleEvent).newState === 'open') fill(); });
  list.addEventListener('toggle', (event) => { if ((event as ToggleEvent).newState === 'open') (list.querySelector<HTMLElement>('[aria-current]') ?? list.querySelector('button'))?.focus(); });

  /** What a lesson begins with: its text tells of these numbers. */
  const setOf = ({ scene }: Lesson): Readonly<Record<string, string>> => ({ ...sceneOf(scene.model)?.set, ...scene.set });
  function begin(lesson: Lesson, where: string): void {
    const { scene } = lesson;
    stale = true;
    store.load({
      ...presetState(presets, scene.model), set: setOf(lesson), methods: scene.methods, step: scene.step, tolerance: '', accuracy: '', until: scene.until,
      view: { ...viewFor(presets, scene.model, store.state.view), plane: scene.view[0] === 'plane' ? 'plane' : 'auto' }, place: where,
    });
  }
  function open(id: string): void {
    const lesson = data.lessons.find((l) => l.id === id);
    if (!lesson) return;
    opened.clear();
    ticked.clear();
    measured.clear();
    arriving = true;
    begin(lesson, `${id}.predict`);
    scrollTo(0, 0);
  }
  const end = (): void => { document.dispatchEvent(new CustomEvent(SEEK, { detail: store.numbers.until ?? 0 })); };
  const to = (at: At, part: Part, answer = at.answer): void => store.go(`${at.lesson.id}.${part}${answer === null ? '' : `.${answer}`}`);

  function guessed(at: At, k: number, moved = false): void {
    chosen = k;
    element.querySelectorAll<HTMLInputElement>('input[type=radio]').forEach((radio, i) => { radio.checked = i === k; });
    element.querySelector<HTMLButtonElement>('button.primary')?.removeAttribute('disabled');
    const { rail, choices } = at.lesson.predict;
    if (rail && !moved) stage.guess({ ...rail, place: choices[k]?.place ?? null, open: true });
  }

  function predict(at: At): Body {
    const { predict: ask, title } = at.lesson, text = bound(ask.text.join(' ')), cut = /^(.*[.!]\s)?([^.!]*)$/s.exec(text);
    const rows = ask.choices.map((choice, k) => {
      const radio = el('input', { type: 'radio', name: 'guess', value: k });
      radio.addEventListener('change', () => guessed(at, k));
      return el('label', { class: 'choice' }, radio, el('span', {}, bound(choice.label)));
    });
    const go = button('', () => {
      if (chosen === null) return;
      // Somebody may have tried other numbers before the guess; the answer tells of the lesson's.
      begin(at.lesson, `${at.lesson.id}.try.${chosen}`);
      clock.replay();
    }, { class: 'primary', disabled: chosen === null }, ask.button, icon('M8 5.5l10 6.5-10 6.5z'));
    return [[el('h2', { tabindex: -1 }, title), ...(cut?.[1] ? [el('p', {}, cut[1].trim())] : []), el('fieldset', {}, el('legend', {}, cut?.[2]?.trim() ?? text), ...rows), ...(ask.hint && ask.rail ? [el('p', { class: 'quiet hint' }, ask.hint)] : [])], go];
  }
  /** Does what a task asks for. */
  function perform(condition: Condition): void {
    const { state, scene } = store, methods = scene?.state.methods ?? state.methods;
    const kept = condition.kind === 'scene' ? methods.filter((m) => presets.methods(condition.model).includes(m)) : [];
    switch (condition.kind) {
      case 'method': store.change({ methods: [...methods.filter((m) => m !== condition.method), ...(condition.on ? [condition.method] : [])] }); break;
      case 'step': store.change({ step: String(condition.value) }); break;
      case 'until': store.change({ until: String(condition.value) }); toEnd = true; break;
      case 'set': store.change({ set: { ...state.set, [condition.name]: condition.value } }); break;
      case 'scene': store.load({ ...presetState(presets, condition.model), set: sceneOf(condition.model)?.set ?? {}, methods: kept.length ? kept : methods, step: state.step, tolerance: state.tolerance, accuracy: state.accuracy, until: state.until, view: state.view, place: state.place }); break;
      case 'opened':
        if (condition.place === 'step') store.go('step');
        else { place('looking').scrollIntoView(); document.dispatchEvent(new CustomEvent('motus-opened', { detail: condition.place })); }
    }
  }
  function attempt(at: At): Node[] {
    const { attempt: task } = at.lesson, begun = { scene: { ...at.lesson.scene, set: setOf(at.lesson) } }, told = el('p', { class: 'unseen', role: 'status' });
    const items = task.tasks.map(({ label, condition }) => el('li', {}, button('', () => perform(condition), { class: 'task' }, el('span', { class: 'tick', 'aria-hidden': 'true' }), el('span', {}, bound(label)), el('span', { class: 'unseen' }))));
    ticks = () => {
      const { numbers, state, scene } = store;
      // What was computed before the lesson began has done nothing of what it asks.
      if (stale && (!scene || scene.state.text !== state.text || scene.state.step !== state.step || scene.state.until !== state.until || !scene.state.methods.every((m) => state.methods.includes(m)))) return;
      stale = false;
      const now = { model: state.preset, methods: scene?.state.methods ?? state.methods, step: numbers.step ?? 0, until: numbers.until ?? 0, set: state.set, opened };
      task.tasks.forEach(({ label, condition }, k) => {
        const key = `${at.lesson.id}.${k}`, item = items[k]!;
        if (!ticked.has(key) && met(condition, begun, now)) { ticked.add(key); say(told, words.lesson.isTicked(label)); }
        item.classList.toggle('done', ticked.has(key));
        say(item.querySelector('.unseen')!, ticked.has(key) ? words.lesson.ticked : '');
      });
    };
    ticks();
    return [...answer(at), el('p', {}, bound(task.text.join(' '))), el('ul', { class: 'tasks' }, ...items), told, ...(task.measured ? [measured.element] : [])];
  }
  const answer = (at: At): Node[] => {
    const choice = at.answer === null ? null : at.lesson.predict.choices[at.answer];
    return choice ? [el('p', { class: choice.right ? 'answer right' : 'answer' }, ...(choice.right ? [icon('M4.5 12.5l5 5L19.5 7')] : []), bound(choice.answer))] : [];
  };
  function why(at: At): Body {
    const { why: told, next } = at.lesson, following = data.lessons[at.number];
    finished.add(at.lesson.id);
    remember('lessons', [...finished].join(' '));
    const drawing = told.picture ? el('figure', { class: 'closeup' }, el('div', {}), el('figcaption', {}, bound(told.caption))) : null;
    sketch = () => drawing?.firstElementChild?.replaceChildren(...[closeUp(told.picture, store)].filter((d) => d !== null));
    sketch();
    return [[...answer(at), el('h2', {}, told.title), ...told.text.map((paragraph) => el('p', {}, bound(paragraph))), ...(drawing ? [drawing] : [])],
      following ? button('', () => open(following.id), { class: 'primary' }, words.lesson.next(next || following.title), icon('M5 12h13M12.5 6l5.5 6-5.5 6')) : button(words.lesson.gallery, () => store.go('gallery'), { class: 'primary' })];
  }

  function show(): void {
    const at = read(store.state.place);
    element.hidden = !at;
    document.body.classList.toggle('in-lesson', at !== null);
    if (at) document.body.dataset.part = at.part; else delete document.body.dataset.part;
    stage.hide(at?.part === 'predict' ? at.lesson.predict.hide : []);
    if (!at) { if (shown) stage.guess(null); shown = ''; ticks = sketch = null; return; }
    if (shown === store.state.place) return;
    const before = shown;
    shown = store.state.place;
    ticks = sketch = null;
    if (at.part === 'predict') chosen = null;
    const bar = el('ol', { class: 'parts' }, ...parts.map((part) => el('li', {}, button(words.lesson.parts[part], () => to(at, part), { 'aria-current': part === at.part && 'step', class: parts.indexOf(part) <= parts.indexOf(at.part) ? 'past' : '' }))));
    const [body, next] = at.part === 'predict' ? predict(at) : at.part === 'why' ? why(at)
      : at.part === 'try' ? [attempt(at), button(words.lesson.saw, () => to(at, 'see'), { class: 'primary' })] as const
        : [[...answer(at), el('p', {}, bound(at.lesson.see.join(' '))), ...(at.lesson.attempt.measured ? [measured.element] : [])], button(words.lesson.why, () => to(at, 'why'), { class: 'primary' })] as const;
    element.replaceChildren(el('div', { class: 'lesson-head' }, el('h1', {}, words.lesson.head(String(at.number), String(data.lessons.length))), button(words.lesson.leave, leave, { class: 'text-button' })), bar, el('div', { class: 'lesson-body' }, ...body), next);
    const { rail } = at.lesson.predict;
    // The guess stays where it was, dashed.
    if (rail) stage.guess({ ...rail, place: at.answer === null ? null : at.lesson.predict.choices[at.answer]?.place ?? null, open: at.part === 'predict' });
    else stage.guess(null);
    // What was pressed is gone; whoever goes by keys goes on from here.
    if (arriving) element.querySelector('h2')?.focus({ preventScroll: true });
    else if (before && before.split('.')[0] === at.lesson.id) element.querySelector<HTMLElement>('[aria-current=step]')?.focus({ preventScroll: true });
    arriving = false;
  }
  function leave(): void {
    store.go('');
    [...document.querySelectorAll<HTMLElement>('.ask-button, .pill')].find((e) => e.checkVisibility())?.focus({ preventScroll: true });
  }
  // A ring that is dragged chooses by where it is let go.
  stage.onGuess((where) => {
    const at = read(store.state.place), k = at?.lesson.predict.choices.findIndex((c) => c.place === where) ?? -1;
    if (at?.part === 'predict' && k >= 0) guessed(at, k, true);
  });
  document.addEventListener('motus-opened', (event) => { opened.add((event as CustomEvent<string>).detail); ticks?.(); });
  store.subscribe((what) => {
    if (what === 'view' || what === 'state') show();
    if (what !== 'scene') return;
    const at = read(store.state.place);
    if (at?.lesson.attempt.measured && store.scene) measured.note(store.scene, [Number(at.lesson.scene.step), ...at.lesson.attempt.tasks.flatMap(({ condition: c }) => (c.kind === 'step' ? [c.value] : []))]);
    ticks?.();
    sketch?.();
    if (toEnd) { toEnd = false; end(); }
  });
  // On paper a motion has come to its end.
  addEventListener('beforeprint', () => { if (read(store.state.place)) end(); });
  show();
  return { element, list, open, here: () => read(store.state.place) !== null };
}
