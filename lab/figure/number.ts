/* Numbers as people read them: a true minus, powers of ten as 10⁻⁶, no more digits than mean something.
 *
 * Invariant: for reading only. What is exported, or counted with, is never one of these texts.
 */
const RAISED: Readonly<Record<string, string>> = { '-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹' };

export function raised(power: number): string {
  return [...String(power)].map((c) => RAISED[c] ?? c).join('');
}

export function minus(text: string): string {
  return text.replace(/-/g, '−');
}

export function tenTo(power: number): string {
  return power === 0 ? '1' : power === 1 ? '10' : `10${raised(power)}`;
}

/** To so many significant digits; with a power of ten where that is shorter to read. */
export function readable(value: number, digits = 5): string {
  if (Number.isNaN(value)) return '–';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  if (value === 0) return '0';
  const [mantissa, exponent] = value.toExponential(digits - 1).split('e') as [string, string];
  const power = Number(exponent);
  if (power >= -3 && power < Math.max(5, digits)) return minus(value.toFixed(Math.max(0, digits - 1 - power)));
  return `${minus(mantissa.replace(/\.?0+$/, ''))}×10${raised(power)}`;
}

/** A count, thousands apart: 20 000. */
export const grouped = (n: number): string => n.toLocaleString('en').replace(/,/g, '\u2009');

/** readable() without zeros at the end: for sentences. */
export function brief(value: number, digits = 4): string {
  return shortened(readable(value, digits));
}
export const shortened = (text: string): string => text.replace(/(\.\d*?)0+($|×)/, '$1$2').replace(/\.($|×)/, '$1');
