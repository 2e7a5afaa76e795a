/* What leaves the page: a picture or a table as a file.
 *
 * Invariant: numbers are written with every digit they have, and a file is the same text whatever the reader's language. A text cell that a
 * spreadsheet would take for a formula gets an apostrophe; a number, however it begins, is left alone.
 */
import type { Table } from './types';

let model = 'motus';

/** The name of the model on show: exported files are called after it. */
export function nameExports(name: string): void {
  model = name || 'model';
}

/** A name that every file system takes. */
export function fileName(panel: string, extension: string): string {
  const clean = (text: string): string => text.normalize('NFC').replace(/[^\p{L}\p{N}._-]+/gu, '-').replace(/^[-.]+|[-.]+$/g, '').slice(0, 60);
  return `${clean(model) || 'motus'}-${clean(panel) || 'figure'}.${extension}`;
}

function cell(value: string | number): string {
  if (typeof value === 'number') return Number.isFinite(value) ? String(value) : Number.isNaN(value) ? '' : value > 0 ? 'inf' : '-inf';
  const safe = /^[=+\-@\t\r]/.test(value) ? `'${value}` : value;
  return /[",\r\n]/.test(safe) || safe !== value ? `"${safe.replace(/"/g, '""')}"` : safe;
}

/** RFC 4180, with one header line. Names in the header are quoted always. */
export function csv(table: Table): string {
  const lines = [table.head.map((name) => `"${(/^[=+\-@\t\r]/.test(name) ? `'${name}` : name).replace(/"/g, '""')}"`).join(',')];
  for (const row of table.rows) lines.push(row.map(cell).join(','));
  return `${lines.join('\n')}\n`;
}

export function download(content: Blob, name: string): void {
  const address = URL.createObjectURL(content);
  const anchor = document.createElement('a');
  anchor.href = address;
  anchor.download = name;
  anchor.hidden = true;
  document.body.append(anchor);
  anchor.click();
  anchor.remove();
  // Some browsers begin to read only after the click has been handled.
  setTimeout(() => URL.revokeObjectURL(address), 30_000);
}

export function downloadText(text: string, type: string, name: string): void {
  download(new Blob([text], { type: `${type};charset=utf-8` }), name);
}
