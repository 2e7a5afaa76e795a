/* What leaves the page: a picture or a table as a file.
 *
 * Invariant: numbers are written with every digit they have, and a file is the same text whatever the reader's language. A text cell that a
 * spreadsheet would take for a formula gets an apostrophe; a number, however it begins, is left alone. Every picture that is saved says below what it is of.
 */
import { words } from '../words';
import { ink } from './ink';
import { canvasPen, svgPen } from './pen';
import { textWidth } from './shapes';
import type { Ink, Pen, Table } from './types';

let model = 'motus';

/** The name of the model on show: exported files are called after it. */
export function nameExports(name: string): void {
  model = name || 'model';
}

let told = (): readonly string[] => [];
/** What stands below saved pictures: the title first; the last line, the link, may be shortened. */
export function captionExports(lines: () => readonly string[]): void {
  told = lines;
}

export interface Shot { readonly title: string; readonly width: number; readonly height: number; draw(pen: Pen, ink: Ink): void }
const LINE = 18, EDGE = 14, LETTERS = 12;
/** A text that fits, cut where it does not. */
function cut(text: string, room: number, bold = false): string {
  const width = (of: string): number => textWidth(of, LETTERS) * (bold ? 1.06 : 1);
  if (width(text) <= room) return text;
  let low = 0, high = text.length;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (width(text.slice(0, middle)) <= room - LETTERS) low = middle; else high = middle - 1;
  }
  return `${text.slice(0, low).replace(/[\ud800-\udbff]$/, '')}…`;
}
/** The picture with the strip below that says what it is of. */
export function captioned({ title, width, height, draw }: Shot): Shot {
  const [first = '', ...rest] = told(), lines = [title === first || title === words.stage.motion ? first : `${title} · ${first}`, ...rest].filter(Boolean);
  return {
    title, width, height: height + lines.length * LINE + EDGE,
    draw(pen, now) {
      // A picture fills what it is given.
      draw({ ...pen, height }, now);
      pen.line([EDGE, height + 0.5, width - EDGE, height + 0.5], { colour: now.grid, width: 1 });
      lines.forEach((line, k) => pen.text(EDGE, height + LINE * (k + 1), cut(line, width - 2 * EDGE, k === 0), { colour: k ? now.quiet : now.text, size: LETTERS, bold: k === 0 }));
    },
  };
}
/** Onto a canvas of its own, so many pixels to the length, on the page's ground. */
export function sheetOf({ width, height, draw }: Shot, scale: number): HTMLCanvasElement {
  const sheet = document.createElement('canvas'), now = ink();
  sheet.width = Math.round(width * scale);
  sheet.height = Math.round(height * scale);
  const context = sheet.getContext('2d');
  if (context) {
    context.scale(scale, scale);
    context.fillStyle = now.surface;
    context.fillRect(0, 0, width, height);
    draw(canvasPen(context, width, height), now);
  }
  return sheet;
}
const PNG_SCALE = 2;
/** summary: for those who do not see it. */
export function savePicture(kind: 'PNG' | 'SVG', panel: string, summary: string, shot: Shot): void {
  const whole = captioned(shot), file = fileName(panel, kind.toLowerCase());
  if (kind === 'SVG') {
    const pen = svgPen(whole.width, whole.height), now = ink();
    whole.draw(pen, now);
    downloadText(pen.svg(shot.title, summary, now.surface), 'image/svg+xml', file);
  } else sheetOf(whole, PNG_SCALE).toBlob((blob) => { if (blob) download(blob, file); }, 'image/png');
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
