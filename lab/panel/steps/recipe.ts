/* One step as a recipe of at most four lines: what is done, the calculation with this step's figures, and what of it is drawn.
 *
 * Invariant: every figure is the core's, or follows from the core's by the arithmetic that the line shows; a calculation that does not give the number that
 * the core told is not written (`sum` then gives that number alone). Done with the figures as they are written it gives the last one of them, rounded: where a few digits do not,
 * there are more. Line k and what is drawn with the disc k are made here together. A step of more
 * parts than lines shows the first three and the last, and says how many there are.
 */
import type { Trace, TraceEntry } from '../../protocol';
import { words } from '../../words';
import { factor, figure, kindsOf, lettersOf, type Figure, type Kind, type Kinds, type More } from './figures';
import type { Seen } from './seen';

type Sign = '=' | '+' | '−' | '·' | '/' | '(' | ')';
/** Letters of a calculation; index: which stage. A number has one figure, a vector two; result: what the calculation comes to. */
export type Token =
  | { readonly kind: 'name'; readonly name: string; readonly index?: number; readonly power?: number }
  | { readonly kind: 'number'; readonly figures: readonly Figure[]; readonly bracket?: boolean; readonly result?: boolean; /** Letters that it may have in another step. */ readonly most?: number }
  | { readonly kind: 'sign'; readonly sign: Sign; /** A line may be broken before it. */ readonly outer?: boolean };
export type Sum = readonly Token[];

/** Against time [t, number], or in the plane. */
export type Place = readonly [number, number];
export type Mark =
  | { readonly kind: 'probe' | 'go' | 'fall'; readonly from: Place; readonly to: Place }
  /** The slope of a velocity; along: where it leads to in a whole step. */
  | { readonly kind: 'stroke'; readonly at: Place; readonly along: Place }
  | { readonly kind: 'stage' | 'state' | 'end'; readonly at: Place };
export interface Line { readonly sentence: string; readonly sums: readonly Sum[]; readonly marks: readonly Mark[]; /** Where the disc belongs: a mark of the line. */ readonly disc: Mark | null }
export interface Recipe {
  readonly lines: readonly Line[];
  /** The moves between those of the lines, without a disc. */
  readonly rest: readonly Mark[];
  readonly start: TraceEntry; readonly end: TraceEntry;
  /** A recurrence begins one step before: there. */
  readonly before: Place | null; readonly from: Place; readonly to: Place;
  /** Times between start and end at which something is done. */
  readonly stops: readonly number[];
  readonly kinds: Kinds;
  /** What a reader may ask next, in a sentence; ''. */
  readonly last: string;
}

type Vec = readonly number[];
const add = (a: Vec, b: Vec, times = 1): Vec => a.map((x, k) => x + times * (b[k] ?? NaN));
const scaled = (a: Vec, by: number): Vec => a.map((x) => by * x);
/** Up to rounding, however the core has summed. */
function close(a: Vec, b: Vec, size: number): boolean { return a.every((x, k) => Math.abs(x - b[k]!) <= 1e-9 * size + 1e-300); }

/** A whole number over 1, 2, … for weights that have one denominator; null: they have none. */
function common(weights: readonly number[]): number | null {
  return [1, 2, 3, 4, 6, 8, 12].find((d) => weights.every((w) => Math.abs(w * d - Math.round(w * d)) < 1e-12 * d)) ?? null;
}
const plainNumber = (text: string): Token => ({ kind: 'number', figures: [{ text, rounded: false, shown: text === '½' ? 0.5 : Number(text), unit: 0 }] });
const some = (weights: readonly number[] | null): boolean => weights?.some((w) => w !== 0) ?? false;

/** Decimals that may be added, the fewest first. */
const MORE: readonly More[] = Array.from({ length: 12 }, (_, k): More => [k & 3, k >> 2]).sort((a, b) => a[0] + a[1] - b[0] - b[1]);

export function recipeOf(trace: Trace, seen: Seen, byVelocity: boolean): Recipe | null {
  for (const more of MORE) {
    const made = recipeIn(kindsOf(trace, seen, more), trace, seen, byVelocity);
    if (!made || wrongSums(made).size === 0) return made;
  }
  const made = recipeIn(kindsOf(trace, seen), trace, seen, byVelocity)!, wrong = wrongSums(made);
  return { ...made, lines: made.lines.map((line) => ({ ...line, sums: line.sums.map((sum) => (wrong.has(sum) ? resultOf(sum) : sum)) })) };
}

function recipeIn(kinds: Kinds, trace: Trace, seen: Seen, byVelocity: boolean): Recipe | null {
  const { entries } = trace, start = entries[0], end = entries[entries.length - 1];
  if (!start || !end || start === end) return null;
  const { order, indices } = seen, flat = indices.length === 1, h = start.step, told = words.opened;
  const pick = (of: readonly number[] | null): Vec => indices.map((k) => of?.[k] ?? NaN);
  const value = (e: TraceEntry): Vec => pick(order === 2 ? e.x : e.v), rate = (e: TraceEntry): Vec => pick(order === 2 ? e.v : e.a), force = (e: TraceEntry): Vec => pick(e.a);
  const place = (at: Vec, time: number): Place => (flat ? [time, at[0]!] : [at[0]!, at[1]!]);
  const stages = entries.filter((e) => e.kind === 'stage'), parts = entries.filter((e) => e.kind === 'kick' || e.kind === 'drift');
  const x0 = value(start), x1 = value(end), from = place(x0, start.time), to = place(x1, end.time);

  // --- calculations ----------------------------------------------------------------------------------------------------------------------
  const sign = (s: Sign, outer = false): Token => ({ kind: 'sign', sign: s, outer });
  const number = (v: Vec, kind: Kind, how: { bracket?: boolean; result?: boolean; keep?: boolean } = {}): Token => ({ kind: 'number', figures: v.map((n) => figure(n, kind, how.keep)), bracket: how.bracket === true && flat && v[0]! < 0, result: how.result === true, most: v.length * lettersOf(kind) + (how.bracket && flat ? 2 : 0) });
  const times = (by: number): Token => ({ kind: 'number', figures: [factor(by, kinds.factor)], bracket: false });
  const whole = seen.name || '';
  /** The name of what is looked at: a vector of two names has none of its own. */
  const named: readonly Token[] = whole ? [{ kind: 'name', name: whole }] : [sign('('), { kind: 'name', name: seen.names[0]! }, { kind: 'name', name: ',' }, { kind: 'name', name: seen.names[1]! }, sign(')')];
  const rateName = order === 2 ? 'v' : `${whole}'`;
  const one = (name: string, index?: number): Token[] => (index === undefined ? [{ kind: 'name', name }] : [{ kind: 'name', name, index }]);

  const operand = (kind: Kind): Kind => (kind === kinds.rate ? kinds.rates : kind === kinds.value || kind === kinds.between ? kinds.operand : kind);
  /** name = from + by · of + … = to; without the calculation where that does not give `to`. */
  function sum(name: readonly Token[], kind: Kind, from_: Vec, terms: readonly { readonly by: number; readonly of: Vec; readonly kind: Kind }[], to_: Vec, keep = false): Sum {
    const right = terms.reduce<Vec>((s, t) => add(s, t.of, t.by), from_), size = Math.max(...[...from_, ...to_, ...terms.flatMap((t) => scaled(t.of, t.by))].map(Math.abs));
    const result = number(to_, kind, { result: keep, keep });
    if (!close(right, to_, size)) return [...name, sign('=', true), result];
    return [...name, sign('=', true), number(from_, operand(kind)), ...terms.flatMap((t) => [sign(t.by < 0 ? '−' : '+', true), times(Math.abs(t.by)), sign('·'), number(t.of, operand(t.kind), { bracket: true })]), sign('=', true), result];
  }
  /** name = value, told by the core. */
  const is = (name: readonly Token[], kind: Kind, v: Vec): Sum => [...name, sign('=', true), number(v, kind)];
  /** name = from + h/d · (2 v₁ + v₂ + …) = to, in names where these stand in lines above, else in numbers. */
  function mean(name: readonly Token[], kind: Kind, from_: readonly { readonly tokens: readonly Token[]; readonly value: Vec }[], step: number, weights: readonly number[], of: { readonly name: string; readonly values: readonly Vec[]; readonly kind: Kind; readonly names: boolean }, to_: Vec): Sum {
    const right = weights.reduce<Vec>((s, w, k) => (w === 0 ? s : add(s, of.values[k]!, step * w)), from_.reduce<Vec>((s, f) => add(s, f.value), scaled(to_, 0)));
    const size = Math.max(...[...to_, ...from_.flatMap((f) => f.value), ...of.values.flatMap((v) => scaled(v, step))].map(Math.abs)), result = number(to_, kind, { result: true, keep: true });
    if (!close(right, to_, size)) return [...name, sign('=', true), result];
    const d = common(weights), used = weights.map((w, k) => ({ w: d === null ? w : Math.round(w * d), k })).filter(({ w }) => w !== 0), alone = used.length === 1;
    const terms = used.flatMap(({ w, k }, i) => [
      ...(i ? [sign(w < 0 ? '−' : '+')] : w < 0 && !alone ? [sign('−')] : []),
      ...(Math.abs(w) === 1 || alone ? [] : [d !== null ? plainNumber(String(Math.abs(w))) : times(Math.abs(w)), sign('·')]),
      ...(of.names ? one(of.name, k + 1) : [number(of.values[k]!, operand(of.kind), { bracket: i > 0 || alone || w !== 1 })]),
    ]);
    const by = alone ? step * (d === null ? used[0]!.w : used[0]!.w / d) : d === null ? step : step / d;
    // A sixth of a step is told as that where it has no end.
    const apart = !alone && d !== null && d > 1 && factor(by, kinds.factor).rounded, multiple: Token[] = apart ? [times(step), sign('/'), plainNumber(String(d))] : [times(by)];
    return [...name, sign('=', true), ...from_.flatMap((f, k) => [...(k ? [sign('+', true)] : []), ...f.tokens]), sign('+', true), ...multiple, sign('·'), ...(alone ? terms : [sign('('), ...terms, sign(')')]), sign('=', true), result];
  }
  const begun = { tokens: [number(x0, kinds.operand)], value: x0 };

  // --- what is drawn ---------------------------------------------------------------------------------------------------------------------
  const stroke = (at: Place, v: Vec): Mark => ({ kind: 'stroke', at, along: flat ? [h, h * v[0]!] : [h * v[0]!, h * v[1]!] });
  const go: Mark = { kind: 'go', from, to }, arrived: Mark = { kind: 'end', at: to };
  const lines: Line[] = [], rest: Mark[] = [];
  let before: Place | null = null, last = '';
  const line = (sentence: string, sums: readonly Sum[], marks: readonly Mark[], disc: Mark | null = marks[0] ?? null): void => { lines.push({ sentence, sums, marks, disc }); };
  const noun = order === 2 ? told.velocity : told.rate;

  if (parts.length) composed();
  else if (stages.length && order === 2 && !close(stages.reduce<Vec>((x, s) => add(x, rate(s), h * s.weight), x0), x1, Math.max(...[...x0, ...x1].map(Math.abs)))) springs();
  else if (stages.length) slopes();
  else if (order === 2 && entries.some((e) => e.kind === 'step' || e.kind === 'taylor')) recurrence();
  if (!lines.length) line(trace.method === 'taylor' ? told.series : trace.method.startsWith('gragg') ? told.extrapolated : told.alongside, [is(named, kinds.value, x1)], [go, arrived]);
  const stops = [...new Set([...stages.map((s) => s.time), ...parts.map((p) => p.time)])].filter((t) => Math.abs(t - start.time) > 1e-9 * Math.abs(h) && Math.abs(t - end.time) > 1e-9 * Math.abs(h));
  return { lines, rest, start, end, before, from, to, stops, kinds, last };

  /** Kicks and drifts, one after the other. */
  function composed(): void {
    const own = order === 2 ? parts : parts.filter((p) => p.kind === 'kick'), many = own.length > 4;
    let clock = start!.time, kicked = false, drifted = false;
    let previous = start!;
    // The last line comes to where the step ends: to the place, and where a kick follows to the velocity as well.
    const lastMove = own.reduce((at, p, k) => (order === 1 || p.kind === 'drift' ? k : at), -1), close_ = many ? Math.max(3, Math.min(lastMove, own.length - 1)) : own.length;
    const sums: Sum[] = [], drawn: Mark[] = [];
    own.forEach((e, k) => {
      const closing = k >= close_, moves = order === 1 || e.kind === 'drift', c = e.coefficient;
      let marks: Mark[];
      if (moves) {
        const a = place(value(previous), clock);
        clock = order === 1 ? start!.time + (h * own.slice(0, k + 1).reduce((s, p) => s + p.coefficient, 0)) : e.time;
        const b = place(value(e), clock);
        marks = [{ kind: 'go', from: a, to: b }, k === lastMove ? { kind: 'end', at: b } : { kind: 'stage', at: b }];
      } else marks = [stroke(place(value(e), clock), rate(e))];
      if (many && k >= 3 && !closing) rest.push(...(moves ? marks : []));
      else {
        const v = order === 1 ? force(e) : rate(e), written = moves ? sum(named, kinds.value, value(previous), [{ by: c * h, of: v, kind: kinds.rate }], value(e), k === lastMove)
          : sum(one(rateName), kinds.rate, rate(previous), [{ by: c * h, of: force(e), kind: kinds.force }], rate(e));
        if (closing) { sums.push(written); drawn.push(...marks); }
        else line(order === 1 ? told.go(c, !k, k > 0 && near(c, 0.5), noun) : moves ? told.go(c, !kicked, drifted && near(c, 0.5), noun) : told.kick(c, kicked && near(c, 0.5), byVelocity), [written], marks);
      }
      if (moves) drifted = true; else kicked = true;
      previous = e;
    });
    if (sums.length) line(told.andSoOn(own.length, sums.length), sums, drawn);
  }
  function near(a: number, b: number): boolean { return Math.abs(a - b) < 1e-12; }

  /** Runge-Kutta and Gauss: velocities at places that are tried, and their mean. */
  function slopes(): void {
    const solve = entries.find((e) => e.kind === 'solve'), rounds = solve?.iterations ?? 0, n = stages.length, weights = stages.map((s) => s.weight), rates = stages.map(rate);
    const tried = stages.map((s) => place(value(s), s.time)), first = stages[0]!, equal = weights.every((w) => near(w, weights[0]!));
    const speed = (s: TraceEntry, name: readonly Token[]): Sum => {
      const row = s.row ?? [], k = row.findIndex((c) => c !== 0);
      // A rate of change is what the equation says there; a velocity has come about by a force.
      if (order === 1 || k < 0 || row.filter((c) => c !== 0).length > 1) return is(name, kinds.rate, rate(s));
      return sum(name, kinds.rate, rate(start!), [{ by: row[k]! * h, of: force(stages[k]!), kind: kinds.force }], rate(s));
    };
    const reach = (s: TraceEntry, name: readonly Token[] = named): Sum => {
      const row = s.row ?? [], k = row.findIndex((c) => c !== 0);
      return k < 0 || row.filter((c) => c !== 0).length > 1 ? is(name, kinds.value, value(s)) : sum(name, kinds.value, x0, [{ by: row[k]! * h, of: rates[k]!, kind: kinds.rate }], value(s));
    };
    const all = (names: boolean): Sum => mean(named, kinds.value, [begun], h, weights, { name: rateName, values: rates, kind: kinds.rate, names }, x1);
    const tries = (k: number): Mark[] => [{ kind: 'probe', from, to: tried[k]! }, { kind: 'stage', at: tried[k]! }];
    if (n === 1 && !solve) {
      line(told.go(1, true, false, noun), [sum(named, kinds.value, x0, [{ by: h, of: rates[0]!, kind: kinds.rate }], x1, true)], [go, arrived]);
      if (order === 2) line(told.kickAfter, [sum(one(rateName), kinds.rate, rate(start!), [{ by: h, of: force(first), kind: kinds.force }], rate(end!))], [stroke(to, rate(end!))]);
      return;
    }
    // One place is tried, from the start or by solving for it.
    const probe = n === 1 ? 0 : n === 2 && !solve && !some(first.row) ? 1 : -1;
    if (probe >= 0) {
      const s = stages[probe]!, single = weights.every((w, k) => (k === probe ? near(w, 1) : w === 0));
      line(solve ? told.seek(s.coefficient, noun) : told.go(s.coefficient, true, false, noun), [reach(s)], tries(probe));
      line(solve ? told.fits(rounds, noun) : told.read(noun), [speed(s, one(rateName, single ? undefined : 2))], [stroke(tried[probe]!, rates[probe]!)]);
      line(single ? told.again : told.againWith(2, equal, noun), [all(!flat && !single)], [go, arrived]);
      if (!flat && !single) lines[1] = { ...lines[1]!, sums: [is(one(rateName, 1), kinds.rate, rates[0]!), ...lines[1]!.sums] };
      return;
    }
    const shown = n <= 4 ? n : 3, solved = stages.filter((s) => some(s.row)).length;
    stages.slice(0, shown).forEach((s, k) => {
      const row = s.row ?? [], tried_ = some(row), marks = tried_ ? [...tries(k), stroke(tried[k]!, rates[k]!)] : [stroke(tried[k]!, rates[k]!)], together = n === 4 && k === 3;
      const sentence = !tried_ ? told.atStart(noun) : !solve ? told.tryWith(s.coefficient, row.filter((c) => c !== 0).length > 1 ? -1 : row.findIndex((c) => c !== 0), noun, together)
        : solved === 1 ? told.solveOne(rounds, noun) : k === n - solved ? told.solve(solved, rounds, noun) : told.also(k, n, noun, together);
      // Of a first-order variable the equation gives the rate at a place, so the place is what is calculated.
      line(sentence, [...(order === 1 && tried_ && !solve ? [reach(s, one(whole, k + 1))] : []), solve ? is(one(rateName, k + 1), kinds.rate, rate(s)) : speed(s, one(rateName, k + 1)), ...(together ? [all(true)] : [])], [...marks, ...(together ? [go, arrived] : [])], marks[tried_ ? 1 : 0]);
    });
    if (n <= 3) line(told.againWith(n, equal, noun), [all(true)], [go, arrived]);
    else if (n > 4) line(told.andSoOnStages(n, noun), [is(named, kinds.value, x1)], [go, arrived]);
  }

  /** Places from the forces alone (Newmark). */
  function springs(): void {
    const forces = stages.map(force), rounds = entries.find((e) => e.kind === 'solve')?.iterations ?? 0;
    const pull = (at: Place, a: Vec): Mark => ({ kind: 'fall', from: at, to: flat ? [at[0], at[1] + (h * h * a[0]!) / 2] : [at[0] + (h * h * a[0]!) / 2, at[1] + (h * h * a[1]!) / 2] });
    const some_ = { name: 'a', values: forces, kind: kinds.force, names: true }, seek = stages.slice(0, 2);
    // Nyström: many forces, of which the first two are shown.
    if (stages.length > 2) {
      seek.forEach((s, k) => line(k ? told.tryForce(s.coefficient) : told.forceAtStart, [is(one('a', k + 1), kinds.force, force(s))], [pull(from, force(s))]));
      line(told.forcesInAll(stages.length), [is(named, kinds.value, x1)], [go, arrived]);
      line(told.forcesVelocity, [is(one(rateName), kinds.rate, rate(end!))], [stroke(to, rate(end!))]);
      return;
    }
    seek.forEach((s, k) => line(k ? told.seekForce(rounds) : told.forceAtStart, [is(one('a', k + 1), kinds.force, force(s))], [pull(k ? to : from, force(s))]));
    line(told.forces, [mean(named, kinds.value, [begun, { tokens: [times(h), sign('·'), number(rate(start!), kinds.rates, { bracket: true })], value: scaled(rate(start!), h) }], h * h, stages.map((s) => s.weight_x), some_, x1)], [go, arrived]);
    line(told.forcesVelocity, [mean(one(rateName), kinds.rate, [{ tokens: [number(rate(start!), kinds.rates)], value: rate(start!) }], h, stages.map((s) => s.weight), some_, rate(end!))], [stroke(to, rate(end!))]);
  }

  /** Verlet, Beeman: places, and what the force adds to going on straight. */
  function recurrence(): void {
    const e = entries.find((s) => s.kind === 'step' || s.kind === 'taylor')!, a = force(e), earlier = e.before_x ? pick(e.before_x) : null, beeman = e.kind === 'step' && !earlier;
    const straight = earlier ? add(scaled(x0, 2), earlier, -1) : add(x0, rate(start!), h), ahead = place(straight, end!.time), fallen = add(x1, straight, -1);
    if (earlier) before = place(earlier, start!.time - h);
    const dotted: Mark = { kind: 'probe', from: before ?? from, to: ahead };
    // The disc stands beyond the present place.
    line(earlier ? told.keepGoing : told.go(1, true, false, noun), [earlier ? [plainNumber('2'), sign('·'), number(x0, kinds.operand, { bracket: true }), sign('−', true), number(earlier, kinds.operand, { bracket: true }), sign('=', true), number(straight, kinds.between)]
      : sum(named, kinds.between, x0, [{ by: h, of: rate(start!), kind: kinds.rate }], straight)], [dotted, { kind: 'stage', at: ahead }], { kind: 'probe', from, to: ahead });
    const squared: Token[] = [{ kind: 'name', name: 'h', power: 2 }, { kind: 'name', name: 'a' }];
    const pull = beeman ? null : (earlier ? 1 : 0.5) * h * h, size = Math.max(...[...x0, ...x1, ...straight].map(Math.abs));
    const fall: Sum = pull !== null && close(scaled(a, pull), fallen, size) ? [...(earlier ? squared : [plainNumber('½'), ...squared]), sign('=', true), times(pull), sign('·'), number(a, kinds.force, { bracket: true }), sign('=', true), number(fallen, kinds.between)]
      : beeman && e.before_a ? beemans(a, pick(e.before_a), fallen) : is(squared, kinds.between, fallen);
    line(beeman ? told.fallBeeman : told.fall(earlier !== null && byVelocity, earlier === null), [fall], [{ kind: 'fall', from: ahead, to }]);
    line(earlier ? told.there(byVelocity) : beeman ? told.thereBeeman : told.thereFirst, [[...named, sign('=', true), number(straight, kinds.between), ...(flat && fallen[0]! < 0 ? [sign('−', true), number(scaled(fallen, -1), kinds.between)] : [sign('+', true), number(fallen, kinds.between)]), sign('=', true), number(x1, kinds.value, { result: true, keep: true })]], [arrived]);
    if (beeman && e.before_a) {
      const forces = [force(end!), a, pick(e.before_a)];
      line(told.velocityBeeman, [mean(one(rateName), kinds.rate, [{ tokens: [number(rate(start!), kinds.rates)], value: rate(start!) }], h / 6, [2, 5, -1], { name: 'a', values: forces, kind: kinds.force, names: false }, rate(end!))], [stroke(to, rate(end!))]);
    } else last = earlier ? told.twoPlaces : '';
  }
  function beemans(now: Vec, earlier: Vec, fallen: Vec): Sum {
    const by = (h * h) / 6;
    if (!close(scaled(add(scaled(now, 4), earlier, -1), by), fallen, Math.max(...[...x0, ...x1].map(Math.abs)))) return [number(fallen, kinds.between)];
    return [times(by), sign('·'), sign('('), plainNumber('4'), sign('·'), number(now, kinds.force, { bracket: true }), sign('−'), number(earlier, kinds.force, { bracket: true }), sign(')'), sign('=', true), number(fallen, kinds.between)];
  }
}

/** What stands between the signs of equality. */
function sides(sum: Sum): Token[][] {
  const out: Token[][] = [[]];
  for (const token of sum) if (token.kind === 'sign' && token.sign === '=') out.push([]); else out[out.length - 1]!.push(token);
  return out;
}
/** A calculation without its middle; of one that has no name its result. */
function resultOf(sum: Sum): Sum {
  const all = sides(sum);
  return all.length < 3 ? all[all.length - 1]! : [...all[0]!, { kind: 'sign', sign: '=', outer: true }, ...all[all.length - 1]!];
}
const nameOf = (token: Token | undefined): string => (token?.kind === 'name' ? `${token.name}${token.index ?? ''}` : '');

/** The calculations that do not give their results, done with the figures as they are written. */
function wrongSums({ lines }: Recipe): Set<Sum> {
  const names = new Map<string, Vec>(), wrong = new Set<Sum>();
  for (const sum of lines.flatMap((line) => line.sums)) {
    const all = sides(sum), [result] = all[all.length - 1]!, [name] = all[0]!, middle = all[all.length - 2] ?? [];
    if (result?.kind !== 'number') continue;
    if (all[0]!.length === 1 && nameOf(name)) names.set(nameOf(name), result.figures.map((f) => f.shown));
    if (all.length < 3 && !middle.some((t) => t.kind === 'sign' && t.sign === '·')) continue;
    const found = done(middle, names);
    if (!result.figures.every(({ shown, unit }, k) => Math.abs((found[found.length === 1 ? 0 : k] ?? NaN) - shown) <= 0.5 * unit * (1 + 1e-6) + 1e-12 * Math.abs(shown))) wrong.add(sum);
  }
  return wrong;
}
/** A calculation done; numbers of one kind of sign after the other. */
function done(tokens: readonly Token[], names: ReadonlyMap<string, Vec>): Vec {
  let at = 0;
  const sign = (s: Sign): boolean => { const token = tokens[at]; const is = token?.kind === 'sign' && token.sign === s; if (is) at++; return is; };
  const both = (a: Vec, b: Vec, act: (x: number, y: number) => number): Vec => Array.from({ length: Math.max(a.length, b.length) }, (_, k) => act(a[a.length === 1 ? 0 : k] ?? NaN, b[b.length === 1 ? 0 : k] ?? NaN));
  function one(): Vec {
    if (sign('(')) { const inside = total(); sign(')'); return inside; }
    const token = tokens[at++];
    return token?.kind === 'number' ? token.figures.map((f) => f.shown) : names.get(nameOf(token)) ?? [NaN];
  }
  function product(): Vec {
    let left = one();
    for (;;) {
      if (sign('·')) left = both(left, one(), (a, b) => a * b);
      else if (sign('/')) left = both(left, one(), (a, b) => a / b);
      else return left;
    }
  }
  function total(): Vec {
    let left = sign('−') ? product().map((x) => -x) : product();
    for (;;) {
      if (sign('+')) left = both(left, product(), (a, b) => a + b);
      else if (sign('−')) left = both(left, product(), (a, b) => a - b);
      else return left;
    }
  }
  return total();
}

/** A calculation as plain text. */
export const plain = (sum: Sum): string => sum.map((t) => {
  if (t.kind === 'sign') return t.sign === '(' || t.sign === ')' || t.sign === '/' ? t.sign : ` ${t.sign} `;
  if (t.kind === 'name') return `${t.name}${t.index ?? ''}${t.power === 2 ? '²' : ''}${t.name === ',' ? ' ' : ''}`;
  const text = t.figures.length > 1 ? `(${t.figures.map((f) => f.text).join(', ')})` : t.figures[0]!.text;
  return t.bracket ? `(${text})` : text;
}).join('');
