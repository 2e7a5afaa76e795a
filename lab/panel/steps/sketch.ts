/* A step as a drawing: each event of a trace as points, moves and arrows in the plane of two positions, or of one position and the time.
 *
 * Invariant: one scale for all: a velocity v is drawn as the way h v it leads in one step, an acceleration a as the h² a by which it changes that way.
 * So a kick moves the tip of the velocity's arrow by an arrow, and a drift goes along it. Only numbers that the core told are drawn.
 */
import type { Trace, TraceEntry } from '../../protocol';
import { sub } from './told';

export type Role = 'move' | 'velocity' | 'acceleration' | 'helper';
export interface Point { readonly kind: 'point'; readonly at: Place; readonly style: 'state' | 'stage'; readonly label: string }
export interface Arrow {
  readonly kind: 'arrow'; readonly from: Place; readonly to: Place; readonly role: Role; readonly label: string;
  /** A slope only: as long as there is room for it. */
  readonly free?: boolean;
}
export interface Segment { readonly kind: 'line'; readonly from: Place; readonly to: Place; readonly role: Role }
export type Mark = Point | Arrow | Segment;
export type Place = readonly [number, number];

/** The plane: two positions, or one against the time. */
export interface Plane { readonly id: string; readonly label: string; readonly axes: readonly [string, string]; readonly indices: readonly number[] }

/* A slope that is not followed to its end is drawn at this share of its length. */
const SLOPE = 0.4;

/** What is drawn for each event; drawn one after another they make the step. */
export function sketch(trace: Trace, plane: Plane): Mark[][] {
  const timed = plane.indices.length === 1, [i, j] = [plane.indices[0]!, plane.indices[1] ?? 0];
  const entries = trace.entries, start = entries[0];
  if (!start) return [];
  const h = start.step;
  const stagesInAll = entries.filter(e => e.kind === 'stage').length;
  const place = (x: readonly number[], time: number): Place => timed ? [time, x[i]!] : [x[i]!, x[j]!];
  const along = (v: readonly number[], share: number): Place => timed ? [h * share, h * share * v[i]!] : [h * share * v[i]!, h * share * v[j]!];
  const pushed = (a: readonly number[], share: number): Place => timed ? [0, h * h * share * a[i]!] : [h * h * share * a[i]!, h * h * share * a[j]!];
  const plus = (p: Place, q: Place): Place => [p[0] + q[0], p[1] + q[1]];
  const from = place(start.x, start.time);
  let clock = start.time;

  return entries.map((e, k): Mark[] => {
    const before: TraceEntry = entries[k - 1] ?? start;
    switch (e.kind) {
      case 'start': {
        const arrow: Arrow = { kind: 'arrow', from, to: plus(from, along(e.v, 1)), role: 'velocity', label: 'h v' };
        return [{ kind: 'point', at: from, style: 'state', label: 'start' }, ...(stagesInAll > 0 ? [] : [arrow])];
      }
      case 'kick': {
        const at = place(e.x, clock), old = plus(at, along(before.v, 1)), tip = plus(at, along(e.v, 1));
        return [
          { kind: 'arrow', from: at, to: tip, role: 'velocity', label: 'h v' },
          { kind: 'arrow', from: old, to: tip, role: 'acceleration', label: e.coefficient === 1 ? 'h² a' : `${Number(e.coefficient.toPrecision(3))} h² a`.replace('-', '−').replace(/^0\.5 /, '½ ') },
        ];
      }
      case 'drift': {
        const at = place(before.x, clock);
        clock = e.time;
        const to = place(e.x, clock);
        return [{ kind: 'line', from: at, to, role: 'move' }, { kind: 'point', at: to, style: 'state', label: '' }];
      }
      case 'stage': {
        const at = place(e.x, e.time), share = stagesInAll === 1 ? 1 : SLOPE;
        return [
          ...(e.coefficient === 0 ? [] : [{ kind: 'line', from, to: at, role: 'helper' } as Segment]),
          { kind: 'point', at, style: 'stage', label: stagesInAll === 1 ? '' : String(e.stage) },
          { kind: 'arrow', from: at, to: plus(at, along(e.v, share)), role: 'velocity', label: stagesInAll === 1 ? 'h v' : `v${sub(e.stage)}`, free: share < 1 },
          ...(e.a ? [{ kind: 'arrow', from: at, to: plus(at, pushed(e.a, share)), role: 'acceleration', label: stagesInAll === 1 ? 'h² a' : `a${sub(e.stage)}`, free: true } as Arrow] : []),
        ];
      }
      case 'solve': return [];
      case 'taylor': case 'step': {
        const to = place(e.x, e.time + h);
        const last = e.before_x ? place(e.before_x, start.time - h) : null;
        const straight: Place = last ? [2 * from[0] - last[0], 2 * from[1] - last[1]] : plus(from, along(start.v, 1));
        return [
          ...(last ? [{ kind: 'point', at: last, style: 'stage', label: 'step before' } as Point, { kind: 'line', from: last, to: from, role: 'move' } as Segment] : []),
          { kind: 'line', from, to: straight, role: 'helper' },
          { kind: 'arrow', from: straight, to, role: 'acceleration', label: e.kind === 'taylor' ? '½ h² a' : last ? 'h² a' : 'h²/6 (4a − a₋)' },
          { kind: 'point', at: to, style: 'state', label: '' },
        ];
      }
      case 'end': {
        const at = place(e.x, e.time), whole: Segment = { kind: 'line', from, to: at, role: 'move' };
        const drifted = entries.some(s => s.kind === 'drift');
        return [
          ...(drifted ? [] : [whole]),
          { kind: 'arrow', from: at, to: plus(at, along(e.v, SLOPE)), role: 'velocity', label: '', free: true },
          { kind: 'point', at, style: 'state', label: 'end' },
        ];
      }
    }
  });
}

/** The planes in which a step can be looked at. */
export function planesOf(trace: Trace, dimension: (name: string) => string = name => name): Plane[] {
  const names = trace.names.x, out: Plane[] = [], at = new Map(names.map((n, k) => [n, k]));
  const pair = (i: number, k: number): void => { out.push({ id: `${names[i]}|${names[k]}`, label: `${names[i]} – ${names[k]}`, axes: [dimension(names[i]!), dimension(names[k]!)], indices: [i, k] }); };
  names.forEach((name, i) => {
    if (out.length > MOST) return;
    const other = (letter: string): number | undefined => /\.x$/.test(name) ? at.get(name.replace(/x$/, letter)) : /^x[\p{L}\p{N}_]*$/u.test(name) ? at.get(letter + name.slice(1)) : undefined;
    const y = other('y'), z = other('z');
    if (y !== undefined) pair(i, y);
    if (z !== undefined) pair(i, z);
  });
  if (out.length === 0 && names.length === 2) pair(0, 1);
  names.slice(0, MOST).forEach((name, i) => out.push({ id: name, label: `${name} over t`, axes: ['t', name], indices: [i] }));
  return out;
}
const MOST = 24;
