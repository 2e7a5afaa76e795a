/* Times at which a motion is read so that straight lines between them look like the motion, however fast it is.
 *
 * Each number of the motion is a column. Between two times, Hermite's cubic through values and slopes at both ends tells how far the motion leaves
 * the straight line: the interval is divided until that is below the tolerance. What a cubic cannot tell is asked: every interval is accepted only
 * if the motion at a time inside of it is where it should be. Invariant: times are in the order of the motion, the first and the last are those of the
 * motion, and every value is one that was asked for. No time is there twice, but those of breaks: there the motion has two sides, and a gap between
 * them in what jumps.
 */
export interface Curve { readonly times: Float64Array; readonly columns: readonly Float64Array[] }

/** Where a motion jumps: times inside of it, in its order, each once; columns there before and after. */
export interface Breaks { readonly times: readonly number[]; readonly before: readonly Float64Array[]; readonly after: readonly Float64Array[] }

/** A curve with the two sides of each break among its rows, which replace a row of that time; gaps: with a row between them as well, NaN in the columns that jump. */
export function broken({ times, columns }: Curve, breaks: Breaks, gaps: boolean): Curve {
  const first = times[0] ?? 0, way = (times[times.length - 1] ?? 0) < first ? -1 : 1, rows: (readonly [row: number, side: number])[] = [];
  const on = new Set(breaks.times);
  let next = 0;
  const put = (upTo: number): void => {
    for (; next < breaks.times.length && way * breaks.times[next]! <= way * upTo; next++) rows.push([next, 1], ...(gaps ? [[next, 2] as const] : []), [next, 3]);
  };
  for (let i = 0; i < times.length; i++) {
    put(times[i]!);
    if (!on.has(times[i]!)) rows.push([i, 0]);
  }
  put(way * Infinity);
  const sides = (k: number, row: number, side: number): number => {
    const before = breaks.before[k]![row]!, after = breaks.after[k]![row]!;
    return side === 3 ? after : side === 1 || before === after ? before : NaN;
  };
  return {
    times: Float64Array.from(rows, ([row, side]) => (side ? breaks.times[row]! : times[row]!)),
    columns: columns.map((column, k) => Float64Array.from(rows, ([row, side]) => (side ? sides(k, row, side) : column[row]!))),
  };
}
/** The same curve with the gaps between equal times, of which each pair is a break. */
function gapped({ times, columns }: Curve): Curve {
  const rows: (readonly [row: number, gap: boolean])[] = [];
  times.forEach((t, i) => { if (i > 0 && times[i - 1] === t) rows.push([i, true]); rows.push([i, false]); });
  if (rows.length === times.length) return { times, columns };
  return { times: Float64Array.from(rows, ([i]) => times[i]!), columns: columns.map((column) => Float64Array.from(rows, ([i, gap]) => (gap && column[i - 1] !== column[i] ? NaN : column[i]!))) };
}

export interface Motion {
  /** The columns at times in the order of the motion. */
  ask(times: Float64Array): readonly Float64Array[];
  readonly from: number; readonly to: number;
  /** Of each column the one that is its derivative; -1: none is. */
  readonly slopes: readonly number[];
  /** Of each column: what its values may be off; smaller bends are not resolved. */
  readonly noise: readonly number[];
  readonly breaks?: Breaks;
}
export interface Limits {
  /** Of a column's extent: how far the lines may be from the motion. */
  readonly tolerance: number;
  readonly points: number;
  readonly milliseconds: number;
}

/** A third of a pixel of a picture of 4000: two columns that are drawn against each other are then within half a pixel. */
export const SEEN = 1 / 3 / 4000;

const EVEN = 512, PARTS = 8, PASSES = 100;
/* Of an interval: no oscillation whose half periods divide it evenly is at rest there. */
const INSIDE = 0.381966;
/* Of its bend: what was foretold so well is understood. */
const FORETOLD = 0.25;
/* Of the whole time: what changes within less is a jump. */
const INSTANT = 2 ** -40;
/* A column whose extent grows by so much in each of two passes is at a pole, where no number of points is enough. */
const POLE = 4;
/* A column that moves less than this part of its size is drawn by its size. */
const AT_REST = 1e-9;
const EPSILON = Number.EPSILON;

/** Fewer where times are so close that some of these would be the same. */
export function even(from: number, to: number, intervals: number): Float64Array {
  const times = Float64Array.from({ length: intervals + 1 }, (_, i) => (i === intervals ? to : from + ((to - from) * i) / intervals));
  return times.filter((t, i) => i === 0 || i === intervals || (t !== times[i - 1] && t !== to));
}

/** Where intervals go on from: OPEN: nothing is known; CHECKED: the motion inside was as foretold; DONE: the line is near enough, or nothing helps. */
const OPEN = 0, CHECKED = 1, DONE = 2;

/** The error of a straight line falls with the square of its length. */
const partsOf = (bend: number): number => Math.max(1, Math.min(PARTS, Math.ceil(Math.sqrt(bend))));

/** An interval to be divided into so many parts; 1: a time inside is asked, which becomes a point only if it is not where it should be. */
interface Wish { readonly at: number; readonly parts: number; readonly bend: number }

class Sampler {
  private times: Float64Array;
  private columns: readonly Float64Array[] = [];
  private states: Uint8Array;
  private slopes: readonly Float64Array[] = [];
  private tolerances: number[] = [];
  /** Of each column its extents, one for each pass; and where it has a pole, what is finite beside it. */
  private readonly extents: (readonly [number, number])[][];
  private readonly poles = new Map<number, readonly [number, number]>();
  private readonly began = performance.now();
  private readonly instant: number;

  constructor(private readonly motion: Motion, private readonly limits: Limits, known: Float64Array | null, begun: Curve | null) {
    this.columns = begun?.columns ?? [];
    this.times = known ?? begun?.times ?? even(motion.from, motion.to, Math.max(2, Math.min(EVEN, limits.points - 1)));
    this.extents = motion.slopes.map(() => []);
    this.states = new Uint8Array(Math.max(0, this.times.length - 1)).fill(known ? CHECKED : OPEN);
    this.instant = Math.max(INSTANT * Math.abs(motion.to - motion.from), 8 * EPSILON * Math.max(Math.abs(motion.from), Math.abs(motion.to)));
  }

  curve(): Curve {
    if (this.columns.length === 0) this.columns = this.ask(this.times);
    if (this.motion.breaks?.times.length) this.split(this.motion.breaks);
    for (let pass = 0; pass < PASSES && !this.late(); pass++) {
      this.measure();
      const wishes = this.wishes();
      if (wishes.length === 0) break;
      this.grant(wishes);
    }
    return gapped({ times: this.times, columns: this.columns });
  }

  /** Between the two sides of a break there is nothing to find. */
  private split(breaks: Breaks): void {
    const { times, columns } = broken({ times: this.times, columns: this.columns }, breaks, false);
    this.times = times;
    this.columns = columns;
    this.states = Uint8Array.from({ length: times.length - 1 }, (_, i) => (times[i] === times[i + 1] ? DONE : OPEN));
  }

  private late(): boolean { return performance.now() - this.began > this.limits.milliseconds; }

  private ask(times: Float64Array): readonly Float64Array[] {
    return times.length > 0 ? this.motion.ask(times) : this.motion.slopes.map(() => new Float64Array(0));
  }

  private measure(): void {
    this.tolerances = this.columns.map((column, k) => {
      const [low, high] = extent(column), size = Math.max(Math.abs(low), Math.abs(high));
      this.note(k, [low, high]);
      if (!(high >= low)) return Infinity;
      return Math.max(this.limits.tolerance * (high - low > AT_REST * size ? high - low : size), this.motion.noise[k] ?? 0, 64 * EPSILON * size) || Infinity;
    });
    this.slopes = this.columns.map((column, k) => this.columns[this.motion.slopes[k] ?? -1] ?? this.piecewise(column));
  }

  /** Slopes of each piece between breaks by its own values. */
  private piecewise(column: Float64Array): Float64Array {
    const out = new Float64Array(column.length), n = column.length;
    for (let from = 0, to = 1; from < n; from = to, to++) {
      while (to < n && this.times[to] !== this.times[to - 1]) to++;
      out.set(slopesOf(this.times.subarray(from, to), column.subarray(from, to)), from);
    }
    return out;
  }

  /** By how many tolerances the cubic leaves the straight line in interval i; NaN: a column is finite at one end alone. */
  private bend(i: number): number {
    const h = this.times[i + 1]! - this.times[i]!;
    let worst = 0;
    for (let k = 0; k < this.columns.length; k++) {
      const column = this.columns[k]!, slope = this.slopes[k]!, p = column[i]!, q = column[i + 1]!;
      const ends = Number(Number.isFinite(p)) + Number(Number.isFinite(q));
      if (ends === 0 || this.tolerances[k] === Infinity) continue;
      if (ends === 1) return NaN;
      const way = q - p, a = h * slope[i]! - way, b = h * slope[i + 1]! - way;
      const most = Math.max(Math.abs(3 * a - b) * 3, Math.abs(a - b) * 8, Math.abs(a - 3 * b) * 3) / 64 / this.tolerances[k]!;
      // A slope that is not finite, at a vertical tangent: the straight line is as bent as it is long.
      worst = Math.max(worst, Number.isFinite(most) ? most : Math.abs(way) / this.tolerances[k]!);
    }
    return worst;
  }

  /** A velocity may be as large as it likes where the position stays. */
  private note(k: number, now: readonly [number, number]): void {
    const list = this.extents[k]!, grown = (later: readonly [number, number] | undefined, sooner: readonly [number, number] | undefined): boolean =>
      !!later && !!sooner && sooner[1] > sooner[0] && later[1] - later[0] >= POLE * (sooner[1] - sooner[0]);
    list.push(now);
    const [before, last] = list.slice(-3);
    if (!this.motion.slopes.includes(k) && !this.poles.has(k) && grown(last, before) && grown(now, last)) this.poles.set(k, last!);
  }

  private atPole(i: number): boolean {
    for (const [k, [low, high]] of this.poles) {
      const p = this.columns[k]![i]!, q = this.columns[k]![i + 1]!;
      if (p < low || p > high || q < low || q > high) return true;
    }
    return false;
  }

  private wishes(): readonly Wish[] {
    const wishes: Wish[] = [];
    for (let i = 0; i < this.states.length; i++) {
      if (this.states[i] === DONE) continue;
      const bend = this.bend(i), apart = Math.abs(this.times[i + 1]! - this.times[i]!) > this.instant, straight = bend <= 1;
      if (straight && this.states[i] === OPEN && apart) wishes.push({ at: i, parts: 1, bend });
      else if (straight || !apart || this.atPole(i)) this.states[i] = DONE;
      // Where it becomes infinite only halves lead nearer.
      else wishes.push({ at: i, parts: Number.isNaN(bend) ? 2 : partsOf(bend), bend: Number.isNaN(bend) ? 4 : bend });
    }
    return this.afford(wishes);
  }

  /** Where there is no room for all of them checks have a half of it, and the intervals that bend most another quarter: with a tolerance raised for all
   *  alike. The rest is for what the next pass knows better. */
  private afford(wishes: readonly Wish[]): readonly Wish[] {
    const room = this.limits.points - this.times.length, quarter = Math.ceil(room / 4);
    const cost = (list: readonly Wish[]): number => list.reduce((sum, { parts }) => sum + Math.max(1, parts - 1), 0);
    if (cost(wishes) <= room) return wishes;
    if (room < this.limits.points / 64) return [];
    const raised = (by: number): Wish[] => wishes.map((wish) => ({ ...wish, parts: partsOf(wish.bend / by) })).filter(({ parts }) => parts > 1);
    let low = 1, high = 2 * Math.max(1, ...wishes.map(({ bend }) => bend));
    for (let i = 0; i < 30; i++) {
      const middle = Math.sqrt(low * high);
      if (cost(raised(middle)) > quarter) low = middle; else high = middle;
    }
    let left = quarter;
    const splits = raised(low).sort((p, q) => q.bend - p.bend).filter(({ parts }) => (left -= parts - 1) >= 0);
    return [...splits, ...wishes.filter(({ parts }) => parts === 1).slice(0, room - 2 * quarter)].sort((p, q) => p.at - q.at);
  }

  /** Where in its interval, 0 … 1, the time number j of a wish lies. */
  private static part(wish: Wish, j: number): number { return wish.parts === 1 ? INSIDE : j / wish.parts; }

  private grant(wishes: readonly Wish[]): void {
    const asked: number[] = [], kept: Wish[] = [], parts: number[] = [];
    for (const wish of wishes) {
      const from = this.times[wish.at]!, h = this.times[wish.at + 1]! - from;
      for (let j = 1; j < Math.max(2, wish.parts); j++) {
        asked.push(from + Sampler.part(wish, j) * h);
        kept.push(wish);
        parts.push(Sampler.part(wish, j));
      }
    }
    const found = this.ask(Float64Array.from(asked));
    // What becomes a point, and what the pieces of its interval are then.
    const become = new Map<number, number>();
    for (let n = 0; n < asked.length; n++) {
      const wish = kept[n]!, at = wish.at;
      // A middle may lie as the ends do: where nothing else is known, halves are not taken for checked.
      if (wish.parts === 1) {
        if (this.off(at, parts[n]!, found, n, 0)) become.set(at, OPEN);
        else this.states[at] = DONE;
      } else if (become.get(at) !== OPEN) become.set(at, (wish.parts === 2 && this.states[at] === OPEN) || this.off(at, parts[n]!, found, n, Math.max(1, FORETOLD * wish.bend)) ? OPEN : CHECKED);
    }
    const points = asked.map((_, n) => n).filter((n) => become.has(kept[n]!.at));
    this.merge(points, (n) => kept[n]!.at, asked, found, become);
  }

  /** Whether what was found as number n is further from the cubic of interval i than so many tolerances; 0: further than one from its straight line. */
  private off(i: number, part: number, found: readonly Float64Array[], n: number, tolerances: number): boolean {
    const h = this.times[i + 1]! - this.times[i]!;
    return found.some((column, k) => {
      const p = this.columns[k]![i]!, q = this.columns[k]![i + 1]!, way = q - p;
      if (this.tolerances[k] === Infinity || !(Number.isFinite(p) || Number.isFinite(q) || Number.isFinite(column[n]!))) return false;
      const bent = part * (1 - part) * ((1 - part) * (h * this.slopes[k]![i]! - way) - part * (h * this.slopes[k]![i + 1]! - way));
      return !(Math.abs(column[n]! - p - part * way - (tolerances > 0 ? bent : 0)) <= Math.max(1, tolerances) * this.tolerances[k]!);
    });
  }

  private merge(points: readonly number[], interval: (n: number) => number, asked: readonly number[], found: readonly Float64Array[], become: ReadonlyMap<number, number>): void {
    const count = this.times.length + points.length, times = new Float64Array(count), states = new Uint8Array(count - 1);
    const columns = this.columns.map(() => new Float64Array(count));
    let to = 0, next = 0;
    for (let i = 0; i < this.times.length; i++) {
      times[to] = this.times[i]!;
      columns.forEach((column, k) => { column[to] = this.columns[k]![i]!; });
      if (i < this.states.length) states[to] = become.get(i) ?? this.states[i]!;
      to++;
      for (; next < points.length && interval(points[next]!) === i; next++, to++) {
        const n = points[next]!;
        times[to] = asked[n]!;
        columns.forEach((column, k) => { column[to] = found[k]![n]!; });
        states[to] = become.get(i)!;
      }
    }
    this.times = times;
    this.columns = columns;
    this.states = states;
  }
}

/** The smallest and the largest finite number. */
function extent(column: Float64Array): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const value of column) {
    if (value < low && value !== -Infinity) low = value;
    if (value > high && value !== Infinity) high = value;
  }
  return [low, high];
}

/** Slopes at the times by the values alone: of the parabola through three of them, but not steeper than LIMIT times the less steep side, so that a jump
 *  on one side leaves the other as it is. A side is two intervals, because an interval whose ends lie evenly about a peak has no slope of its own. */
function slopesOf(times: Float64Array, column: Float64Array): Float64Array {
  const n = times.length, slopes = new Float64Array(n), LIMIT = 3;
  const between = (i: number): number => (column[i + 1]! - column[i]!) / (times[i + 1]! - times[i]!);
  const steeper = (i: number, j: number): number => Math.max(Math.abs(between(i)), j >= 0 && j < n - 1 ? Math.abs(between(j)) : 0);
  for (let i = 1; i < n - 1; i++) {
    const p = between(i - 1), q = between(i), before = times[i]! - times[i - 1]!, after = times[i + 1]! - times[i]!;
    const most = LIMIT * Math.min(steeper(i - 1, i - 2), steeper(i, i + 1));
    slopes[i] = Math.max(-most, Math.min(most, (p * after + q * before) / (before + after)));
  }
  if (n > 1) {
    slopes[0] = n > 2 ? 2 * between(0) - slopes[1]! : between(0);
    slopes[n - 1] = n > 2 ? 2 * between(n - 2) - slopes[n - 2]! : between(0);
  }
  return slopes;
}

/** known: times that were found for nearly the same motion; begun: what has been asked of this one, at even times; null: that is asked first. */
export function sample(motion: Motion, limits: Limits, known: Float64Array | null = null, begun: Curve | null = null): Curve {
  // Rows of another motion's breaks are not those of this one.
  const of = motion.breaks?.times.length ? null : known;
  return new Sampler(motion, limits, of, of ? null : begun).curve();
}
