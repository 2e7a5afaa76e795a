/* What a motion does by itself, as far as a step must follow it: the rates λ of the motion linearised at some moments of the run, sorted by kind.
 *
 * Invariant: nothing is called constant, or free of friction, that the numbers at these moments do not bear; a rate of growth is the motion's own and asks
 * nothing of a step.
 */
import type { Linear, Spectrum } from '../protocol';

export interface Rate { readonly time: number; readonly re: number; readonly im: number }
export interface Motion {
  /** still: the force is the same everywhere. rateless: all rates are zero. swings: all that do not grow are oscillations without friction.
   * fades: some have friction. grows: none swings or fades. */
  readonly kind: 'still' | 'rateless' | 'swings' | 'fades' | 'grows';
  /** All rates, of each pair the upper one, along the direction of the run. */
  readonly rates: readonly Rate[];
  /** Those that a step must follow. */
  readonly judged: readonly Rate[];
  /** The largest of those, or else of all. */
  readonly fastest: Rate | null;
  /** The same at all moments. */
  readonly steady: boolean;
  /** Different frequencies at the fastest moment, fastest first. */
  readonly frequencies: readonly number[];
  readonly growing: boolean;
  /** A method that treats velocities in a way of its own can be judged by rates: they enter by friction alone. */
  readonly springs: boolean;
  readonly moments: number;
  /** The motion linearised where nothing grows, and something swings or fades; size: of the largest rate there; way: -1 for a run backward. */
  readonly calm: readonly { readonly linear: Linear; readonly size: number; readonly way: number }[];
}

/** Next to the largest rate, this is zero: where two eigenvalues coincide, rounding parts them by its root. Next to its own size, a part of a rate. */
const ZERO = 1e-6, PART = 1e-9;
const ALIKE = 1e-6, APART = 1e-3;

/** way: -1 for a run backward. pure: the force has no velocities and there are no first-order variables, so that λ² is an eigenvalue of ∂a/∂x. */
export function motionOf(spectra: readonly Spectrum[], times: readonly number[], pure: boolean, way = 1): Motion {
  const rates: Rate[] = [], judged: Rate[] = [], calm: Motion['calm'][number][] = [];
  const largest = Math.max(0, ...spectra.flatMap(({ re, im }) => Array.from(re, (r, i) => Math.hypot(r, im[i]!))));
  let growing = false, fading = false;
  spectra.forEach((spectrum, k) => {
    let grows = false, most = 0;
    spectrum.re.forEach((r, i) => {
      const im = spectrum.im[i]!, size = Math.hypot(r, im);
      if (im < 0) return;
      // Without velocities a rate is an oscillation or one of a pair of growth and decay.
      const swings = pure ? im > Math.abs(r) : Math.abs(r) <= PART * size, re = swings ? 0 : way * r, rate = { time: times[k]!, re, im };
      rates.push(rate);
      if (size <= ZERO * largest) return;
      if (!swings && (pure || re > 0)) { growing = grows = true; return; }
      fading ||= !swings;
      judged.push(rate);
      most = Math.max(most, size);
    });
    if (!grows && most > 0) calm.push({ linear: spectrum.linear, size: most, way });
  });
  const size = (rate: Rate): number => Math.hypot(rate.re, rate.im), fastest = (judged.length ? judged : rates).reduce<Rate | null>((best, rate) => (!best || size(rate) > size(best) * (1 + ALIKE) ? rate : best), null);
  const kind = judged.length ? (fading ? 'fades' : 'swings') : growing ? 'grows' : spectra.every((s) => s.free) ? 'still' : 'rateless';
  const at = judged.filter((rate) => rate.time === fastest?.time).map((rate) => rate.im).sort((a, b) => b - a), frequencies: number[] = [];
  for (const f of at) if (f > ZERO * largest && (!frequencies.length || frequencies[frequencies.length - 1]! - f > APART * at[0]!)) frequencies.push(f);
  return { kind, rates, judged, fastest, steady: steadyIn(spectra, largest), frequencies, growing, springs: spectra.every((s) => s.springs), moments: spectra.length, calm };
}

function steadyIn(spectra: readonly Spectrum[], largest: number): boolean {
  const sorted = spectra.map(({ re, im }) => Array.from(re, (r, i) => [r, im[i]!] as const).sort((a, b) => a[1] - b[1] || a[0] - b[0]));
  const first = sorted[0] ?? [];
  // The root of a rounding, where eigenvalues coincide.
  return sorted.every((list) => list.length === first.length && list.every(([re, im], i) => Math.hypot(re - first[i]![0], im - first[i]![1]) <= ZERO * largest));
}
