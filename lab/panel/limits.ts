/* How large a step may be, method by method: the largest step times frequency of an oscillation without friction, or the largest step for given rates.
 *
 * Invariant: a limit is the catalogue's, which the laws certify, or found from the core's growth of one step, of methods that are no map of hλ alone on the linearised motion itself; whether a method grows slowly is read off how
 * its growth goes with the step, never off its name.
 */
import type { Method } from '../protocol';
import type { Client } from '../scene';
import type { Motion, Rate } from './rates';

export type Limit = { readonly kind: 'upTo'; readonly value: number } | { readonly kind: 'any' | 'never' | 'slow' | 'unknown' };

/** Above 1 by less is rounding. On the imaginary axis its root where two eigenvalues meet. */
const LEVEL = 1e-9, AXIS_LEVEL = 1e-7;
/** |hλ| from LEAST to MOST in so many steps, each a fixed factor; then between two of them in so many, so often. */
const LEAST = 1e-4, MOST = 1e3, COUNT = 256, FINE = 32, TWICE = 2;
/** So many rates at most, the largest first; those alike to three digits count once. */
const RATES = 48;

/** Of linearised motions: rounding, where eigenvalues of several modes meet; so many moments; a step times the largest rate, from and to, in so many; between two of them. */
const COUPLED_LEVEL = 1e-6, MOMENTS = 16, FROM = 1e-3, TO = 1e3, WAY = 97, BETWEEN = 16;

/** Growth per step above 1 goes with this power of the step, from two small ones; NaN: there is none. */
const SMALL = [0.05, 0.1] as const;
function powerOf([a, b]: ArrayLike<number> & Iterable<number>): number {
  return a! > 1 + 1e-12 && b! > 1 + 1e-12 ? Math.log2((b! - 1) / (a! - 1)) : NaN;
}

export class Limits {
  private readonly axes = new Map<string, Promise<Limit>>();
  constructor(private readonly client: Client) {}

  private growth(method: string, re: readonly number[], im: readonly number[]): Promise<Float64Array> {
    return this.client.ask('growth', { method, re, im }, { lane: 'study' });
  }

  /** Of step times frequency. name: with its arguments, if it has any; card: its row. */
  axis(name: string, card: Method): Promise<Limit> {
    const known = this.axes.get(name);
    if (known) return known;
    const made = this.findAxis(name, card);
    this.axes.set(name, made);
    // A question that was called off may be asked again.
    made.catch(() => this.axes.delete(name));
    return made;
  }
  private async findAxis(name: string, card: Method): Promise<Limit> {
    const certified = name === card.name ? card.stability_limit : await this.along(name, [{ time: 0, re: 0, im: 1 }], AXIS_LEVEL);
    if (Number.isNaN(certified)) return { kind: 'unknown' };
    if (certified === Infinity) return { kind: 'any' };
    if (certified > 0) return { kind: 'upTo', value: certified };
    // A step h that multiplies by 1 + c (hω)² grows at a rate that shrinks as the step does; with a higher power, faster.
    return { kind: powerOf(await this.growth(name, [0, 0], SMALL)) > 2.5 ? 'slow' : 'never' };
  }

  /** Of the step itself: the largest up to which no rate grows. Rates without friction are the axis', whose limit is certified. */
  async steps(name: string, card: Method, rates: readonly Rate[]): Promise<Limit> {
    const swinging = Math.max(0, ...rates.filter((rate) => rate.re === 0).map((rate) => rate.im)), axis = swinging > 0 ? await this.axis(name, card) : null;
    if (axis && axis.kind !== 'upTo' && axis.kind !== 'any') return axis;
    const found = await this.along(name, chosen(rates.filter((rate) => rate.re !== 0)), LEVEL);
    if (Number.isNaN(found)) return { kind: 'unknown' };
    const value = Math.min(found, axis?.kind === 'upTo' ? axis.value / swinging : Infinity);
    return value === Infinity ? { kind: 'any' } : value > 0 ? { kind: 'upTo', value } : { kind: 'never' };
  }

  /** Of the step itself: the largest up to which a step of the method on the motion linearised there, frictions and all, makes nothing grow; at all moments. */
  async linear(name: string, moments: Motion['calm']): Promise<Limit> {
    const some = differing(moments), count = some.length;
    if (!count) return { kind: 'unknown' };
    const level = some.every(({ linear }) => linear.nv === 1) ? LEVEL : COUPLED_LEVEL;
    const ask = async (steps: readonly (readonly number[])[]): Promise<number[][] | null> => {
      const grown = await this.client.ask('linear', { method: name, moments: some.map(({ linear }) => linear), steps: steps.map((list, i) => list.map((h) => h * some[i]!.way)) }, { lane: 'study' });
      return grown.some((g) => Number.isNaN(g)) ? null : steps.map((list, i) => [...grown.subarray(i * list.length, (i + 1) * list.length)]);
    };
    const grids = some.map(({ size }) => Array.from({ length: WAY }, (_, k) => FROM * (TO / FROM) ** (k / (WAY - 1)) / size)), grown = await ask(grids);
    if (!grown) return { kind: 'unknown' };
    let low = 0, high = Infinity;
    grids.forEach((grid, i) => {
      const k = grown[i]!.findIndex((g) => g > 1 + level);
      if (k >= 0 && grid[k]! < high) [low, high] = [k > 0 ? grid[k - 1]! : 0, grid[k]!];
    });
    for (let again = 0; again < 3 && high < Infinity && low > 0; again++) {
      const from = low, mesh = (high - low) / BETWEEN, fine = Array.from({ length: BETWEEN }, (_, k) => from + (k + 1) * mesh), now = await ask(grids.map(() => fine));
      if (!now) return { kind: 'unknown' };
      const k = fine.findIndex((_, j) => now.some((of) => of[j]! > 1 + level));
      if (k < 0) break;
      [low, high] = [k > 0 ? fine[k - 1]! : from, fine[k]!];
    }
    return low > 0 ? { kind: 'upTo', value: (low + high) / 2 } : { kind: high === Infinity ? 'any' : 'never' };
  }

  /** The largest step up to which growth is 1 or less for all rates; Infinity; NaN: the method has no answer. */
  private async along(name: string, rates: readonly Rate[], level: number): Promise<number> {
    if (!rates.length) return Infinity;
    const sizes = rates.map((rate) => Math.hypot(rate.re, rate.im));
    const ask = async (radii: readonly (readonly number[])[]): Promise<Float64Array> => this.growth(name,
      rates.flatMap((rate, i) => radii[i]!.map((r) => r * rate.re / sizes[i]!)), rates.flatMap((rate, i) => radii[i]!.map((r) => r * rate.im / sizes[i]!)));
    const grid = Array.from({ length: COUNT }, (_, k) => LEAST * (MOST / LEAST) ** (k / (COUNT - 1))), growth = await ask(rates.map(() => grid));
    if (growth.some((g) => Number.isNaN(g))) return NaN;
    let low = 0, high = Infinity;
    rates.forEach((_, i) => {
      const k = grid.findIndex((_, j) => growth[i * COUNT + j]! > 1 + level);
      if (k < 0 || grid[k]! / sizes[i]! >= high) return;
      high = grid[k]! / sizes[i]!;
      low = k > 0 ? grid[k - 1]! / sizes[i]! : 0;
    });
    // Between the last step that none grows by, and the first: all rates together.
    for (let again = 0; again < TWICE && high < Infinity && low > 0; again++) {
      const from = low, mesh = (high - low) / FINE, fine = Array.from({ length: FINE }, (_, k) => from + (k + 1) * mesh);
      const now = await ask(sizes.map((size) => fine.map((h) => h * size)));
      const k = fine.findIndex((_, j) => rates.some((_, i) => now[i * FINE + j]! > 1 + level));
      if (k < 0) break;
      [low, high] = [k > 0 ? fine[k - 1]! : from, fine[k]!];
    }
    return low > 0 ? (low + high) / 2 : high === Infinity ? Infinity : 0;
  }
}

/** Moments that differ to three digits, those with the largest rates first, and some of the others. */
function differing(moments: Motion['calm']): Motion['calm'] {
  const seen = new Map(moments.map((moment) => [[...moment.linear.x, ...moment.linear.v].map((c) => c.toPrecision(3)).join(), moment])), sorted = [...seen.values()].sort((a, b) => b.size - a.size);
  if (sorted.length <= MOMENTS) return sorted;
  return Array.from({ length: MOMENTS }, (_, k) => sorted[Math.floor((k * (sorted.length - 1)) / (MOMENTS - 1))]!);
}

function chosen(rates: readonly Rate[]): Rate[] {
  const sorted = [...rates].sort((a, b) => Math.hypot(b.re, b.im) - Math.hypot(a.re, a.im)), seen = new Set<string>(), out: Rate[] = [];
  for (const rate of sorted) {
    const key = `${rate.re.toPrecision(3)} ${rate.im.toPrecision(3)}`;
    if (seen.has(key)) continue;
    seen.add(key);
    if (out.length < RATES) out.push(rate);
  }
  return out;
}
