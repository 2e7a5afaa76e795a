/* What one press may do about an error in the text: a change of a range of it. Pure.
 *
 * Invariant: a repair changes nothing but its range, and there is none where the text no longer has the word that is wrong.
 */
import type { Problem } from '../protocol';
import { words } from '../words';

export interface Repair { readonly label: string; readonly from: number; readonly to: number; readonly text: string }

/** From a line and a column, counted from 1 in characters, to a place in the text; the range covers the word that begins there. */
export function placeOf(text: string, problem: Problem): [number, number] | null {
  if (problem.line < 1) return null;
  const lines = text.split('\n');
  const line = lines[problem.line - 1];
  if (line === undefined) return null;
  const start = lines.slice(0, problem.line - 1).reduce((sum, l) => sum + l.length + 1, 0);
  const before = Array.from(line).slice(0, Math.max(0, problem.column - 1)).join('').length;
  const word = /^(?:[\p{L}\p{N}_]+'*|\S)/u.exec(line.slice(before))?.[0].length ?? 0;
  return [start + before, start + before + Math.max(word, 1)];
}

/** Where the statement around a place begins: its line, or that of the bracket which is open there. */
function beginning(text: string, at: number): number {
  let depth = 0, begin = 0;
  for (let i = 0, comment = false; i < at; i++) {
    const c = text.charAt(i);
    if (c === '\n') comment = false; else if (c === '#') comment = true;
    if (!comment) depth += c === '(' || c === '[' ? 1 : c === ')' || c === ']' ? -1 : 0;
    if (c === '\n' && depth <= 0) begin = i + 1;
  }
  return begin;
}

/** Lines at the end of the text. */
export function appended(text: string, lines: readonly string[]): Repair {
  const open = text === '' || text.endsWith('\n');
  return { label: '', from: text.length, to: text.length, text: (open ? '' : '\n') + lines.join('\n') + (open ? '\n' : '') };
}

const DEGREES = /^deg(rees?)?$/, UNITS = /^(m|s|kg|rad)$/;

export function repairs(text: string, problem: Problem): Repair[] {
  const place = placeOf(text, problem), { word, instead } = problem;
  if (word === '') return instead === '' ? [] : [{ ...appended(text, [instead]), label: words.editor.repair.add(instead) }];
  if (!place || !text.startsWith(word, place[0])) return [];
  const [from] = place, to = from + word.length, found: Repair[] = [];
  if (instead !== '') found.push({ label: words.editor.repair.replace(instead), from, to, text: instead });
  if (problem.kind === 'name' && !/^['′’([]/.test(text.slice(to))) {
    const line = beginning(text, from), number = /(?:^|[^\p{L}\p{N}_.])(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?[ \t]*$/u.exec(text.slice(0, from));
    // A number with its unit: angles are in radians, and a slider of 1 would make of 30 degrees 30 radians.
    if (DEGREES.test(word)) return [...found, { label: words.editor.repair.add(`${word} = pi/180`), from: line, to: line, text: `${word} = pi/180\n` }];
    if (number && UNITS.test(word)) found.push({ label: words.editor.repair.remove(word), from: from - (/[ \t]*$/.exec(text.slice(0, from))?.[0].length ?? 0), to, text: '' });
    found.push({ label: words.editor.repair.slider, from: line, to: line, text: `${word} = 1\n` });
  }
  return found;
}
