/* The columns of a solution, by what they are; and the table of several motions side by side.
 *
 * Invariant: a number in a table is one that was computed for that time. Where a motion has no row there, the cell is empty, never filled in.
 */
import type { Scene } from '../scene';
import type { Column } from '../protocol';
import { extent } from '../figure/axes';
import { nameSpans, timeName } from '../figure/name';
import { grouped, readable } from '../figure/number';
import { rowAt, valueAt } from '../figure/track';
import type { Said, Span, Table } from '../figure/types';
import { SEEN } from '../sample';
import { words } from '../words';

export function columnOf(scene: Scene, name: string): Column | null {
  return scene.description.columns.find((c) => c.name === name) ?? null;
}

function named(scene: Scene, keep: (column: Column) => boolean): string[] {
  const there = new Set(scene.solution.columns);
  return scene.description.columns.filter((c) => there.has(c.name) && keep(c)).map((c) => c.name);
}

/** The numbers that the motion is made of. */
export const states = (scene: Scene): string[] => named(scene, (c) => c.kind === 'position' || c.kind === 'first-order');
/** All that can be looked at against time. */
export const movable = (scene: Scene): string[] => named(scene, (c) => c.kind !== 'time' && c.kind !== 'exact');
export const positions = (scene: Scene): string[] => named(scene, (c) => c.kind === 'position');
export const invariants = (scene: Scene): string[] => named(scene, (c) => c.kind === 'invariant');

/** The velocity of a position: the column of the same variable and component. */
export function velocityOf(scene: Scene, position: string): string | null {
  const p = columnOf(scene, position);
  const family = named(scene, (c) => c.kind === 'velocity' && c.variable === p?.variable);
  const of = named(scene, (c) => c.kind === 'position' && c.variable === p?.variable);
  // In the same order: r.x, r.y and r'.x, r'.y; x[1], x[2] and x[1]', x[2]'.
  return family.length === of.length ? family[of.indexOf(position)] ?? null : family.find((n) => n.replace(/'/, '') === position) ?? null;
}

/** The exact value at a time: the core's own at a row of the run; else read off the exact line, of a position by its velocities too. */
export function exactAt(scene: Scene, name: string, t: number): number {
  return readExact(scene, name, t).value;
}

/** The same for reading: no digit is told that the line, or a draft of it, does not have. */
export function exactText(scene: Scene, name: string, t: number, digits = DIGITS): string {
  const { value, off } = readExact(scene, name, t);
  if (!(off > 0) || !Number.isFinite(value)) return readable(value, digits);
  return Math.abs(value) <= off ? '≈ 0' : readable(value, Math.max(1, Math.min(digits, Math.floor(Math.log10(Math.abs(value) / off)))));
}

const DIGITS = 6;

/** off: by how much the value may be wrong, roughly. */
export function readExact(scene: Scene, name: string, t: number): { value: number; off: number } {
  const { solution } = scene, exact = solution.columns.indexOf(`exact ${name}`);
  if (exact >= 0) {
    for (const track of solution.tracks) {
      const i = rowAt(track.times, t);
      if (i >= 0 && track.times[i] === t) return { value: track.columns[exact]?.[i] ?? NaN, off: 0 };
    }
  }
  const { truth } = solution, column = truth?.columns[solution.columns.indexOf(name)];
  if (!truth || !column?.length) return { value: NaN, off: 0 };
  const { times } = truth, i = rowAt(times, t);
  if (times[i] === t) return { value: column[i]!, off: truth.off };
  const rates = columnOf(scene, name)?.kind === 'position' ? truth.columns[solution.columns.indexOf(velocityOf(scene, name) ?? '')] : undefined;
  const [low, high] = extentOf(column);
  if (!rates?.length || i < 0 || i + 1 >= times.length) return { value: valueAt(times, column, t), off: truth.off + SEEN * (high - low) };
  // Hermite's cubic: where a straight line is off by a part p of the motion, it is off by about p².
  const h = times[i + 1]! - times[i]!, s = (t - times[i]!) / h, way = column[i + 1]! - column[i]!;
  const bent = s * (1 - s) * ((1 - s) * (h * rates[i]! - way) - s * (h * rates[i + 1]! - way));
  return { value: column[i]! + s * way + bent, off: truth.off + 10 * SEEN * SEEN * (high - low) };
}

const extents = new WeakMap<Float64Array, [number, number]>();
function extentOf(column: Float64Array): [number, number] {
  let found = extents.get(column);
  if (!found) extents.set(column, found = extent([column]));
  return found;
}

/** The times of all tracks, each once, in the direction of the run. */
function allTimes(scene: Scene): number[] {
  const lists = scene.solution.tracks.map((t) => t.times);
  const first = lists[0];
  if (!first) return [];
  if (lists.every((l) => l.length === first.length && l[l.length - 1] === first[first.length - 1] && l[1] === first[1])) return [...first];
  const way = first[first.length - 1]! < first[0]! ? -1 : 1;
  return [...new Set(lists.flatMap((l) => [...l]))].sort((a, b) => way * (a - b));
}

/** A name as the head of a column sets it. */
export const headName = (name: string): Span[] => nameSpans(name, 13);

/** One row for each time; for each of `names` the exact value where it is known there, and each method's. series: other numbers than the tracks' columns;
 * heads: how a reader sees the names, where they are no columns'. */
export function timeTable(scene: Scene, names: readonly string[], series?: (track: number, name: string) => ArrayLike<number>, heads: Readonly<Record<string, Said>> = {}): Table {
  const { solution } = scene, times = allTimes(scene), t = timeName(solution), head = [t], shown: Said[] = [headName(t)];
  const readers: ((t: number) => number)[] = [];
  const atRow = (of: ArrayLike<number>, column: ArrayLike<number>) => (t: number): number => {
    const i = rowAt(of, t);
    return i >= 0 && of[i] === t ? column[i] ?? NaN : NaN;
  };
  for (const name of names) {
    const at = solution.columns.indexOf(name), exact = solution.columns.indexOf(`exact ${name}`);
    const fine = solution.truth?.columns[at], said = heads[name] ?? headName(name), set: readonly Span[] = typeof said === 'string' ? [{ text: said }] : said;
    if (!series && exact >= 0) {
      head.push(`exact ${name}`);
      shown.push([...set, { text: `, ${words.stage.exact}` }]);
      readers.push((t) => exactAt(scene, name, t));
    } else if (!series && solution.truth && !solution.truth.coarse && fine?.length) {
      const read = atRow(solution.truth.times, fine);
      // A reference has its own times: a column of it, where it has a number for every row.
      if (times.every((t) => !Number.isNaN(read(t)))) {
        head.push(`${solution.truth.name} ${name}`);
        shown.push([...set, { text: `, ${words.stage.computed}` }]);
        readers.push(read);
      }
    }
    solution.tracks.forEach((track, k) => {
      head.push(`${name} (${track.method})`);
      shown.push([...set, { text: `, ${scene.looks[k]?.label ?? track.method}` }]);
      readers.push(atRow(track.times, series ? series(k, name) : track.columns[at] ?? []));
    });
  }
  const kept = solution.tracks.find((t) => t.every > 1);
  return { head, shown, rows: times.map((t) => [t, ...readers.map((read) => read(t))]), note: kept ? words.panel.step(grouped(kept.every)) : '' };
}
