/* The text of the model. A plain textarea, so that undo, selection, touch and screen readers are the browser's own; behind it a mirror of the text
 * carries the mark under what the core did not understand.
 *
 * Invariant: the textarea's value changes from outside only when another model is opened; typing is never overwritten.
 */
import type { Problem } from '../protocol';
import type { LiveStore } from '../state';
import { el, say } from '../dom';

const fewest = 6, most = 9;                    // lines shown

/** From a line and a column, counted from 1 in characters, to a place in the text; the mark covers the word that begins there. */
function placeOf(text: string, problem: Problem): [number, number] | null {
  if (problem.line < 1) return null;
  const lines = text.split('\n');
  const line = lines[problem.line - 1];
  if (line === undefined) return null;
  const start = lines.slice(0, problem.line - 1).reduce((sum, l) => sum + l.length + 1, 0);
  const before = Array.from(line).slice(0, Math.max(0, problem.column - 1)).join('').length;
  const word = /^(?:[\p{L}\p{N}_]+'*|\S)/u.exec(line.slice(before))?.[0].length ?? 0;
  return [start + before, start + before + Math.max(word, 1)];
}

/** The line where a model begins to say something: what is shown of a text that opens with a long comment. */
const firstStatement = (text: string): number => Math.max(0, text.split('\n').findIndex(line => /^\s*[^#\s]/.test(line)));

export function editor(store: LiveStore): HTMLElement {
  const area = el('textarea', {
    id: 'model-text', spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off', autocorrect: 'off', wrap: 'off', rows: fewest, 'aria-describedby': 'model-problem',
  });
  const mirror = el('pre', { class: 'mirror', 'aria-hidden': 'true' });
  const what = el('span', { class: 'what' }), hint = el('span', { class: 'hint' }), where = el('span', { class: 'where' });
  const message = el('p', { id: 'model-problem', class: 'message', role: 'status' }, where, what, hint);
  const element = el('div', { class: 'editor' }, el('label', { for: 'model-text' }, 'Model'), el('div', { class: 'editor-field' }, mirror, area), message);

  let marked: Problem | null = null;
  function mark(): void {
    const range = marked ? placeOf(area.value, marked) : null;
    mirror.replaceChildren();
    if (!range) return;
    // The last newline of a <pre> takes no room unless something follows it.
    mirror.append(area.value.slice(0, range[0]), el('mark', {}, area.value.slice(...range) || ' '), area.value.slice(range[1]) + '\n');
    follow();
  }
  function follow(): void {
    mirror.scrollTop = area.scrollTop;
    mirror.scrollLeft = area.scrollLeft;
  }
  function open(text: string): void {
    area.value = text;
    const first = firstStatement(text);
    area.rows = Math.min(most, Math.max(fewest, text.split('\n').length - first));
    requestAnimationFrame(() => {
      area.scrollTop = first * (area.scrollHeight / Math.max(1, text.split('\n').length));
      follow();
    });
  }
  area.addEventListener('scroll', follow, { passive: true });
  area.addEventListener('input', () => {
    if (marked) { marked = null; mark(); }
    store.change({ text: area.value });
  });

  function show(): void {
    const problem = store.trouble.model;
    const ours = problem && area.value === store.state.text ? problem : null;
    marked = ours;
    mark();
    area.setAttribute('aria-invalid', String(ours !== null));
    say(where, ours && ours.line > 0 ? `Line ${ours.line}, column ${ours.column}: ` : '');
    say(what, ours ? ours.message : '');
    say(hint, ours?.hint ? ours.hint : '');
    message.classList.toggle('shown', ours !== null);
  }
  store.subscribe(happening => {
    if (happening === 'state' && store.state.text !== area.value) open(store.state.text);
    if (happening === 'description' || happening === 'scene') show();
  });
  open(store.state.text);
  return element;
}
