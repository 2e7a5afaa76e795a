/* A number that a slider chose, written into the text of the model. Pure.
 *
 * Invariant: all but the number stays byte for byte: blanks, comments, line ends, other components. Where the text computes the number from others,
 * nothing is written, since the formula would be lost.
 */
import type { Description } from '../protocol';
import { short } from './number';

/** A statement of the text: bytes [from, to) without its comment and the blanks around it. */
interface Piece { readonly from: number; readonly to: number }

/** Statements end at ; and at line ends outside brackets; comments are no part of them. */
function statements(text: string): Piece[] {
  const out: Piece[] = [];
  let from = 0, to = 0, depth = 0;
  const end = (next: number): void => {
    const lead = /^\s*/.exec(text.slice(from, to))?.[0].length ?? 0, inner = text.slice(from + lead, to).trimEnd();
    if (inner) out.push({ from: from + lead, to: from + lead + inner.length });
    from = to = next;
  };
  for (let i = 0; i < text.length; i++) {
    const c = text.charAt(i);
    if (c === '#') {
      // A comment within brackets would have to be kept in the middle of a number: such a statement is left alone.
      const stop = text.indexOf('\n', i);
      if (depth === 0) end(stop < 0 ? text.length : stop);
      i = (stop < 0 ? text.length : stop) - 1;
      continue;
    }
    if ((c === '\n' || c === ';') && depth <= 0) { end(i + 1); depth = 0; continue; }
    depth += c === '(' || c === '[' ? 1 : c === ')' || c === ']' ? -1 : 0;
    to = i + 1;
  }
  end(text.length);
  return out;
}

/** A number, or numbers alone combined: 2, -0.5e3, 1/3, 2 pi. */
const constant = (text: string): boolean => /\d|\bpi\b|π/.test(text) && /^(?:pi|π|\d+(?:\.\d+)?(?:[eE][+-]?\d+)?|[-+−*/^()\s·×])+$/.test(text);

/** The ranges of the parts between commas of a tuple or list; null: it is none. */
function parts(text: string, from: number, to: number): Piece[] | null {
  const inside = text.slice(from, to);
  if (!/^\(.*\)$|^\[.*\]$/s.test(inside)) return null;
  const out: Piece[] = [];
  let depth = 0, begin = from + 1;
  for (let i = from + 1; i < to; i++) {
    const c = text.charAt(i);
    if ((c === ',' && depth === 0) || i === to - 1) {
      const lead = /^\s*/.exec(text.slice(begin, i))?.[0].length ?? 0, part = text.slice(begin + lead, i).trimEnd();
      out.push({ from: begin + lead, to: begin + lead + part.length });
      begin = i + 1;
    } else depth += c === '(' || c === '[' ? 1 : c === ')' || c === ']' ? -1 : 0;
    if (depth < 0) return null;
  }
  return out;
}

const quoted = (text: string): string => text.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
const settings = new Set(['step', 'until', 'method']);

/** What stands behind the name on the left of its statement; null: there is no such statement. */
function side(text: string, name: string): Piece | null {
  const initial = /^(.*?)('*)\(.*\)$/.exec(name);
  const left = settings.has(name) ? `${name}\\s+`
    : initial ? `${quoted(initial[1] ?? '')}\\s*${(initial[2] ?? '').replace(/'/g, "['′’]")}\\s*\\([^()]*\\)\\s*=\\s*` : `${quoted(name)}\\s*=\\s*`;
  const begins = new RegExp(`^${left}`, 'u');
  for (const { from, to } of statements(text)) {
    const match = begins.exec(text.slice(from, to));
    if (match) return { from: from + match[0].length, to };
  }
  return null;
}

function replaced(text: string, at: Piece, by: string): string | null {
  return constant(text.slice(at.from, at.to)) ? text.slice(0, at.from) + by + text.slice(at.to) : null;
}

/** A line that the description suggests, with another value: then it is no longer a suggestion. */
function added(text: string, description: Description, name: string, by: string, component: number): string | null {
  const head = new RegExp(`^${quoted(name)}\\s*(?:=|\\s)`, 'u');
  const line = name === 'method' ? `method ${by}` : description.suggestions.find(s => head.test(s.line))?.line;
  if (line === undefined || / for /.test(line)) return null;
  const full = name === 'method' ? line : withNumber(line, name, by, component);
  if (full === null) return null;
  const end = text.includes('\r\n') ? '\r\n' : '\n';
  return text === '' || text.endsWith('\n') ? text + full + end : text + end + full;
}

function withNumber(text: string, name: string, by: string, component: number): string | null {
  const at = side(text, name);
  if (!at) return null;
  if (name === 'method') return text.slice(0, at.from) + by + text.slice(at.to);
  const several = settings.has(name) ? null : parts(text, at.from, at.to);
  if (several && several.length > 1) {
    const one = several[component];
    return one ? replaced(text, one, by) : null;
  }
  return component === 0 ? replaced(text, at, by) : null;
}

/** The text with another number for the parameter or initial value `name`, as the description calls it ("k", "x(0)", "r'(0)"), component by component
 *  from 0; or for "step", "until", "method". null: the text computes it, or has no place for it. */
export function written(text: string, description: Description, name: string, value: number | string, component = 0): string | null {
  const by = typeof value === 'number' ? (Number.isFinite(value) ? short(value) : '') : value.trim();
  if (by === '' || /[\n;#]/.test(by)) return null;
  return side(text, name) ? withNumber(text, name, by, component) : added(text, description, name, by, component);
}

/** Whether a text is another model, not a change of the one before: no line of it is left. What was set for that one says nothing of this one. */
export function another(before: string, after: string): boolean {
  const lines = new Set(before.split('\n').map((line) => line.trim()).filter(Boolean));
  return !after.split('\n').some((line) => lines.has(line.trim()));
}
