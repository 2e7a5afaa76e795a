/* The data table under a picture, built when it is opened.
 *
 * Invariant: at most ROWS rows, evenly taken, the first and the last among them; numbers are shown to DIGITS digits (0.15, not
 * 0.15000000000000002); the file that can be saved has all of them.
 */
import { el as element } from '../dom';
import { words } from '../words';
import { minus } from './number';
import { saidNodes } from './name';
import type { Table } from './types';

const ROWS = 200, DIGITS = 6;

/** Which rows of so many are shown. */
export function evenly(count: number, most = ROWS): number[] {
  if (count <= most) return Array.from({ length: count }, (_, i) => i);
  return Array.from({ length: most }, (_, i) => Math.round(i * (count - 1) / (most - 1)));
}

function shown(value: string | number): string {
  return typeof value === 'string' ? value : Number.isNaN(value) ? '–' : minus(String(Number(value.toPrecision(DIGITS))));
}

export function tableElement(table: Table, caption: string): HTMLElement {
  const rows = evenly(table.rows.length);
  const head = element('tr', {}, ...(table.shown ?? table.head).map((name) => element('th', { scope: 'col' }, ...saidNodes(name))));
  const body = element('tbody');
  for (const i of rows) {
    body.append(element('tr', {}, ...table.rows[i]!.map((value) => element('td', typeof value === 'number' ? {} : { class: 'words' }, shown(value)))));
  }
  const notes = [table.note ?? '', rows.length < table.rows.length ? words.figure.rows(String(rows.length), String(table.rows.length)) : ''];
  const note = words.figure.notes(notes.filter(Boolean));
  // Wide tables scroll in a box of their own, which has to be reachable with the keyboard.
  const box = element('div', { class: 'figure-table', tabindex: '0', role: 'region', 'aria-label': words.figure.table(caption) },
    element('table', {}, element('caption', {}, caption), element('thead', {}, head), body));
  return element('div', {}, box, ...(note ? [element('p', { class: 'figure-note' }, note)] : []));
}
