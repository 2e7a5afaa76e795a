/* The text of the model. A plain textarea, so that undo, selection, touch and screen readers are the browser's own. Its letters are transparent: over it
 * lies a mirror with the same text in colours, the numbers of the lines, and the mark under what the core did not understand; below the text stand, in
 * grey, the lines that it lacks and the core supposed.
 *
 * Invariant: the textarea's value changes from outside only when another model is opened, or a slider writes a number; typing is never overwritten. What
 * the editor itself writes it writes as if it were typed, so that it can be undone. Whole lines are shown.
 */
import type { Problem, Vocabulary, Word } from '../protocol';
import { kinds as drawn, type LiveStore } from '../state';
import { button, el, say } from '../dom';
import { words } from '../words';
import { completion, type Completion } from './complete';
import { appended, placeOf, repairs, type Repair } from './repair';
import { pieces, shifted } from './kinds';
import { another } from './write';

const fewest = 6, most = 20;                   // lines shown
/* Milliseconds without typing, until an error is told. One that is gone is gone at once. */
const patience = 600;

/** The line where a model begins to say something: what is shown of a long text that opens with a long comment. */
const firstStatement = (text: string): number => Math.max(0, text.split('\n').findIndex(line => /^\s*[^#\s]/.test(line)));
const linesOf = (text: string): number => text.split('\n').length;

export function editor(store: LiveStore): HTMLElement {
  const area = el('textarea', {
    id: 'model-text', spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off', autocorrect: 'off', wrap: 'off', rows: fewest,
    'aria-describedby': 'model-problem model-keys', 'aria-autocomplete': 'list', 'aria-haspopup': 'listbox', 'aria-controls': 'model-names',
  });
  const mirror = el('pre', { class: 'mirror', 'aria-hidden': 'true' }), numbers = el('pre', { class: 'numbers', 'aria-hidden': 'true' });
  const supposed = el('ul', { class: 'supposed', 'aria-label': words.editor.supposed });
  const field = el('div', { class: 'editor-field' }, el('div', { class: 'editor-text' }, area, mirror, numbers), supposed);
  const names = el('ul', { id: 'model-names', class: 'names', role: 'listbox', 'aria-label': words.editor.names, hidden: true });
  const take = el('p', { class: 'take' }, words.editor.grey, button(words.editor.take, () => takeAll(), { class: 'text-button', id: 'model-take' }));
  const keys = el('p', { id: 'model-keys', class: 'keys' });
  const column = el('span', { class: 'unseen' }), where = el('span', { class: 'where' }), line = document.createTextNode(''), after = document.createTextNode('');
  const what = el('span', { class: 'what' }), hint = el('span', { class: 'hint' });
  where.append(line, column, after);
  const message = el('p', { id: 'model-problem', class: 'message', role: 'status' }, where, what, hint), mend = el('div', { class: 'mend' });
  const problem = el('div', { class: 'problem' }, message, mend);
  const element = el('div', { class: 'editor' }, el('label', { for: 'model-text' }, words.editor.label), field, names, el('div', { class: 'below' }, take, keys), problem);

  let told: { problem: Problem; text: string } | null = null, timer = 0, typed = -Infinity;
  let kinds: readonly Word[] = [], worded = '', asked = '', vocabulary: Vocabulary | null = null;
  let offers: Completion | null = null, active = -1, offering = false, held = 0, counted = 0, shownLines = '';

  // ---- the mirror

  function draw(): void {
    const text = area.value;
    const mark = told && told.text === text ? placeOf(text, told.problem) : null;
    // At the end of a line there is nothing to underline but a blank.
    const blank = mark !== null && (text.slice(...mark).trim() === '');
    mirror.replaceChildren(...pieces(text, kinds, mark).map(piece => (piece.kind === 'mark' ? el('mark', {}, blank ? ' ' + piece.text.slice(1) : piece.text)
      : piece.kind === '' || piece.kind === 'operator' ? piece.text : el('span', { class: piece.kind }, piece.text))), '\n');
    const count = linesOf(text);
    if (counted !== count) say(numbers, Array.from({ length: count }, (_, k) => `${k + 1}\n`).join(''));
    counted = count;
    field.style.setProperty('--digits', String(Math.max(2, String(count).length)));
    follow();
  }
  function follow(): void {
    mirror.scrollTop = numbers.scrollTop = area.scrollTop;
    mirror.scrollLeft = area.scrollLeft;
  }
  /** As many lines as the text has, and room for those that are supposed, also while they are not shown. */
  function size(): void {
    const lines = Math.min(most, linesOf(area.value)), below = supposed.childElementCount;
    if (below) held = Math.max(fewest, lines + below);
    field.style.setProperty('--rows', String(below ? lines : Math.max(lines, Math.min(held, lines + 3), fewest)));
    // Where lines are longer than the field a scroll bar takes its own height.
    field.style.setProperty('--bar', `${area.offsetHeight - area.clientHeight}px`);
  }
  function colour(): void {
    const text = area.value;
    kinds = shifted(kinds, worded, text);
    worded = text;
    draw();
    if (asked === text) return;
    asked = text;
    store.client.ask('words', { text }, { key: 'words' }).then(found => {
      if (area.value !== text) return;
      kinds = found;
      draw();
    }, () => { asked = ''; });
  }
  store.client.ask('vocabulary', {}).then(found => { vocabulary = found; }, () => {});

  // ---- writing, as if it were typed

  function write({ from, to, text }: Repair): void {
    area.focus({ preventScroll: true });
    area.setSelectionRange(from, to);
    // The one way into the browser's own history of changes; where there is none, the change is made without it.
    if (!document.execCommand('insertText', false, text)) {
      area.setRangeText(text, from, to, 'end');
      area.dispatchEvent(new Event('input', { bubbles: true }));
    }
  }
  /** The suggestions, if they are of the text that stands here. */
  const suggestions = (): readonly { line: string; why: string }[] => (store.trouble.model === null && store.described === area.value ? usable() : []);
  /** A step is only for methods that take steps of one size. */
  const usable = (): readonly { line: string; why: string }[] => (store.description?.suggestions ?? []).filter(({ line }) => drawn(store).fixed > 0 || !/^step\b/.test(line));
  function takeAll(): void {
    const lines = suggestions().map(s => s.line);
    if (lines.length) write(appended(area.value, lines));
  }
  function takeOne(wanted: string): void {
    if (suggestions().some(s => s.line === wanted)) write(appended(area.value, [wanted]));
  }

  function suppose(): void {
    const list = told ? [] : store.trouble.model === null ? usable() : null;
    if (list === null) return;                 // while an error is not told yet, the lines stay
    if (!told && !list.length) held = 0;
    const key = JSON.stringify(list);
    if (key !== shownLines) {
      shownLines = key;
      supposed.replaceChildren(...list.map(s => el('li', {}, button('', () => takeOne(s.line), { tabindex: -1, title: words.editor.takeLine },
        el('span', { class: 'line' }, s.line), el('span', { class: 'why' }, s.why)))));
    }
    take.classList.toggle('shown', list.length > 0);
    size();
    offer();
  }

  // ---- names, as one types

  function close(): void {
    offers = null;
    active = -1;
    names.hidden = true;
    area.removeAttribute('aria-activedescendant');
    tellKeys();
  }
  /** Below the word, wherever the text is scrolled to. */
  function place(at: number): void {
    const range = document.createRange(), walk = document.createTreeWalker(mirror, NodeFilter.SHOW_TEXT);
    for (let seen = 0, node = walk.nextNode(); node; node = walk.nextNode()) {
      const length = node.nodeValue?.length ?? 0;
      if (seen + length > at) { range.setStart(node, at - seen); range.setEnd(node, at - seen + 1); break; }
      seen += length;
    }
    const word = range.getBoundingClientRect(), home = element.getBoundingClientRect();
    // Very large screens enlarge the page: distances on the screen are not those of the style.
    const large = home.width / element.offsetWidth || 1;
    names.style.top = `${(word.bottom - home.top) / large + 2}px`;
    names.style.left = `${Math.max(0, Math.min((word.left - home.left) / large, element.offsetWidth - names.offsetWidth))}px`;
  }
  function complete(force = false): void {
    const caret = area.selectionStart;
    const methods = store.catalogue.map(m => m.name);
    offers = area.selectionEnd === caret ? completion(area.value, caret, { words: kinds, vocabulary, description: store.description, methods }, force) : null;
    if (!offers) { close(); return; }
    active = -1;
    area.removeAttribute('aria-activedescendant');
    names.replaceChildren(...offers.offers.map((name, k) => {
      const option = el('li', { id: `model-name-${k}`, role: 'option', 'aria-selected': 'false' }, name);
      option.addEventListener('pointerdown', event => { event.preventDefault(); choose(k); });
      return option;
    }));
    names.hidden = false;
    place(offers.from);
    tellKeys();
  }
  function move(by: number): void {
    const count = offers?.offers.length ?? 0;
    active = active < 0 ? (by > 0 ? 0 : count - 1) : (active + by + count) % count;
    [...names.children].forEach((option, k) => option.setAttribute('aria-selected', String(k === active)));
    names.children[active]?.scrollIntoView({ block: 'nearest' });
    area.setAttribute('aria-activedescendant', `model-name-${active}`);
  }
  function choose(k: number): void {
    const name = offers?.offers[k];
    if (offers && name !== undefined) write({ label: '', from: offers.from, to: offers.to, text: name });
    close();
  }

  /** The first grey line is offered to Tab where one has typed, at the end of the text. */
  function offer(): void {
    const end = area.value.length;
    const now = offering && document.activeElement === area && area.selectionStart === end && area.selectionEnd === end && suggestions().length > 0;
    field.classList.toggle('offered', now);
    tellKeys();
  }
  function tellKeys(): void {
    const first = offers?.offers[Math.max(0, active)];
    say(keys, first !== undefined ? words.editor.keyName(first) : field.classList.contains('offered') ? words.editor.keyLine : '');
  }

  area.addEventListener('keydown', event => {
    if (event.isComposing || event.ctrlKey || event.metaKey || event.altKey) {
      if (event.ctrlKey && event.key === ' ') { event.preventDefault(); complete(true); }
      return;
    }
    const offered = field.classList.contains('offered');
    const act = offers && !event.shiftKey ? { ArrowDown: () => move(1), ArrowUp: () => move(-1), Tab: () => choose(Math.max(0, active)), Escape: close, Enter: active < 0 ? undefined : () => choose(active) }[event.key]
      : offered && event.key === 'Tab' && !event.shiftKey ? () => { const next = suggestions()[0]; if (next) takeOne(next.line); }
      : offered && event.key === 'Escape' ? () => { offering = false; offer(); } : undefined;
    if (!act) { if (offers && /^(?:Enter|Home|End|Page)|^Arrow/.test(event.key)) close(); return; }
    event.preventDefault();
    event.stopPropagation();
    act();
  });
  area.addEventListener('input', event => {
    typed = performance.now();
    offering = true;
    colour();
    size();
    store.change({ text: area.value, ...(another(store.state.text, area.value) ? { set: {}, step: '', until: '', pinned: undefined } : {}) });
    if (event instanceof InputEvent && event.inputType === 'insertText' && (event.data?.length ?? 0) <= 1 || offers) complete(); else close();
    offer();
    if (timer) wait();
  });
  area.addEventListener('scroll', () => { follow(); close(); }, { passive: true });
  area.addEventListener('blur', () => { offering = false; close(); offer(); });
  document.addEventListener('selectionchange', () => { if (document.activeElement === area) { offer(); if (offers && area.selectionStart !== offers.to) close(); } });
  field.addEventListener('pointerdown', event => {
    if (event.target !== field && event.target !== supposed) return;
    event.preventDefault();
    area.focus();
    area.setSelectionRange(area.value.length, area.value.length);
  });
  new ResizeObserver(size).observe(field);

  // ---- what is wrong

  function tell(now: Problem | null): void {
    window.clearTimeout(timer);
    timer = 0;
    told = now && { problem: now, text: area.value };
    area.setAttribute('aria-invalid', String(now !== null));
    field.classList.toggle('wrong', now !== null);
    problem.classList.toggle('shown', now !== null);
    const placed = now !== null && now.line > 0, asks = now !== null && /^did you mean/.test(now.hint);
    const [seen, heard, colon] = placed ? words.editor.place(String(now.line), String(now.column)) : ['', '', ''];
    line.data = seen;
    say(column, heard);
    after.data = colon;
    what.replaceChildren(...(now ? coded(now.message + (asks ? '. ' : ''), now.word) : []));
    hint.classList.toggle('next', !asks);
    hint.replaceChildren(...(now ? coded(asks ? `D${now.hint.slice(1)}` : now.hint, now.instead) : []));
    const text = area.value;
    mend.replaceChildren(...(now ? repairs(text, now) : []).map(repair => button(repair.label, () => { if (area.value === text) write(repair); })));
    draw();
    suppose();
  }
  /** A sentence with a name of the text in it. */
  const coded = (sentence: string, name: string): (Node | string)[] => {
    const at = name === '' ? -1 : sentence.search(new RegExp(`(?<![\\p{L}\\p{N}_])${name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}(?![\\p{L}\\p{N}_])`, 'u'));
    return at < 0 ? [sentence] : [sentence.slice(0, at), el('code', {}, name), sentence.slice(at + name.length)];
  };
  function wait(): void {
    window.clearTimeout(timer);
    timer = window.setTimeout(show, Math.max(0, typed + patience - performance.now()));
  }
  function show(): void {
    const now = store.trouble.model !== null && store.state.text === area.value ? store.trouble.model : null;
    if (now === null && store.trouble.model !== null) return;
    if (now && performance.now() < typed + patience) wait();
    else if (now !== told?.problem || (now && told?.text !== area.value)) tell(now);
    else suppose();
  }

  function open(text: string): void {
    const small = linesOf(text) === linesOf(area.value) && text !== '' && area.value !== '', at = area.scrollTop, from = area.selectionStart, to = area.selectionEnd;
    area.value = text;
    if (small) area.setSelectionRange(from, to); else { area.setSelectionRange(0, 0); held = 0; typed = -Infinity; }
    colour();
    size();
    const first = linesOf(text) > most ? firstStatement(text) : 0;
    requestAnimationFrame(() => {
      area.scrollTop = small ? at : first * (area.scrollHeight / Math.max(1, linesOf(text)));
      follow();
      size();
    });
  }
  store.subscribe(happening => {
    if (happening === 'state' && store.state.text !== area.value) open(store.state.text);
    if (happening === 'description' || happening === 'scene') show();
  });
  open(store.state.text);
  return element;
}
