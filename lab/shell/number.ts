/* Numbers as people type them, and as the language writes them. Invariant: what comes out is a number of the language, with a point. */

/** "0,5", "−3", ".5", "5." as the language has them; expressions are left alone but for typographic minus signs. */
export function normal(typed: string): string {
  let text = typed.trim().replace(/[\u2212\u2013]/g, '-').replace(/\u00d7\s*10\^?/g, 'e').replace(/[\u00a0\u202f\u2009]/g, ' ');
  if (/^[+-]?\d*,\d+(e[+-]?\d+)?$/i.test(text)) text = text.replace(',', '.');
  if (/^[+-]?\d*\.?\d*(e[+-]?\d+)?$/i.test(text) && /\d/.test(text)) {
    text = text.replace(/^\+/, '').replace(/^(-?)\./, '$10.').replace(/\.(?=e|$)/i, '');
  }
  return text;
}

/** A number of the language, with a sign; no expression. */
export const plain = (text: string): boolean => /^-?\d+(\.\d+)?(e[+-]?\d+)?$/i.test(text);

/** null: no number, or one too large for a double. */
export function numberOf(typed: string): number | null {
  const text = normal(typed);
  const value = plain(text) ? Number(text) : Number.NaN;
  return Number.isFinite(value) ? value : null;
}

/** Short, but no digit lost that a slider or a reader has set. */
export function short(value: number, digits = 12): string {
  return String(Number(value.toPrecision(digits)));
}

/** For a narrow field that is not being edited: six digits, with a power of ten where that is shorter. */
export function compact(value: number): string {
  const plainly = short(value, 6);
  return plainly.length <= 9 ? plainly : Number(value.toPrecision(5)).toExponential().replace('e+', 'e');
}

/** "(0, -9.81)", "[1, 2]" or "3" taken apart; null: not all are plain numbers. */
export function tuple(text: string): { readonly open: string; readonly close: string; readonly parts: readonly string[] } | null {
  const trimmed = text.trim();
  const inside = /^\((.*)\)$|^\[(.*)\]$/s.exec(trimmed);
  const open = inside ? trimmed.charAt(0) : '', close = inside ? trimmed.charAt(trimmed.length - 1) : '';
  const parts = (inside ? inside[1] ?? inside[2] ?? '' : trimmed).split(',').map(normal);
  if (!parts.every(plain) || (!inside && parts.length > 1)) return null;
  return { open, close, parts };
}
