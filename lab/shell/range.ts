/* How far a slider reaches about the model's own value. Invariant: low < high, the value lies between them, and a step is a round number. */
export interface Reach { readonly low: number; readonly high: number; readonly step: number }

/** 1, 2, 2.5 or 5 times a power of ten, not below x. */
export function round(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x));
  const lead = x / power;
  return Number(((lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 2.5 ? 2.5 : lead <= 5 ? 5 : 10) * power).toPrecision(3));
}

/** value: the model's. scale: the largest of the vector it belongs to. signed: a direction or a place, which may as well be negative. */
export function reach(value: number, scale: number, signed: boolean, count: boolean): Reach {
  if (count) return { low: 1, high: Math.max(4, 4 * Math.round(Math.abs(value))), step: 1 };
  const size = round(2 * Math.max(Math.abs(value), signed ? scale / 2 : 0) || 2);
  const low = value > 0 && !signed ? 0 : -size;
  const span = size - low;
  return { low, high: size, step: Number((10 ** Math.floor(Math.log10(span / 400))).toPrecision(1)) };
}

/** A reach that holds this value as well. */
export function widen(old: Reach, value: number): Reach {
  if (value >= old.low && value <= old.high) return old;
  return value > old.high ? { ...old, high: round(value) } : { ...old, low: -round(-value) };
}

/** 5 places on a scale of powers: between low and high a slider of so many positions, and back. */
export const logPosition = (value: number, low: number, high: number, positions: number): number => Math.round((positions * Math.log(value / low)) / Math.log(high / low));
export const logValue = (position: number, low: number, high: number, positions: number): number => Number((low * (high / low) ** (position / positions)).toPrecision(2));
