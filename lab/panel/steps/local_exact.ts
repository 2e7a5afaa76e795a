/* The exact motion from where a step starts: what the step is measured against, its local error.
 *
 * Asked of the worker: the same model, started from the state at the start of the step, by the Gauss method of order 8 in small steps, whose error is
 * far below that of the step looked at. Where the force depends on time, and for families, the start is written into the text (`x(0) = 1` becomes `x(3.2) = 0.4`).
 * A recurrence takes two places, and no velocity: the exact motion that it is measured against goes through both. Its velocity is found by Broyden's method from the mean one.
 * Invariant: a motion that does not begin where the step begins is none; then the page says nothing of it.
 */
import type { Client, Scene } from '../../scene';
import type { Parameter, Trace } from '../../protocol';

export interface LocalExact {
  readonly times: Float64Array; readonly columns: ReadonlyMap<string, Float64Array>;
  /** The row at which the step ends. */
  readonly end: number;
}

const PARTS = 16, METHOD = 'gauss8', BEYOND = 3;
/** Velocities that are tried; how near the place before is met, in units of round-off, and in parts of the size at least. */
const TRIED = 24, MET = 16, NEAR = 1e-11;

/** A start: positions, velocities and first-order variables. */
interface Start { readonly x: readonly number[]; readonly v: readonly number[] }

/** What an initial value is at the start of a step, cell by cell (one, but for families): its components; null: they cannot be said. */
interface Initial { readonly parameter: Parameter; readonly base: string; readonly prime: string; readonly first: number; readonly cells: readonly (readonly number[])[] }
function initialOf(parameter: Parameter, names: Trace['names'], start: Start): Initial | null {
  const parts = /^([^[\]()']+)('?)\(.*\)$/.exec(parameter.name);
  if (!parts) return null;
  const [, base = '', prime = ''] = parts, { components, list } = parameter;
  const number = (name: string): number => {
    const position = names.x.indexOf(name);
    if (position >= 0) return (prime ? start.v[position] : start.x[position]) ?? NaN;
    return (prime ? undefined : start.v[names.v.indexOf(name)]) ?? NaN;
  };
  const suffixes = components === 0 ? [''] : components <= 3 ? ['.x', '.y', '.z'].slice(0, components) : Array.from({ length: components }, (_, k) => `[${k + 1}]`);
  const numbers = list ? [...new Set([...names.x, ...names.v].flatMap((name) => (name.startsWith(`${base}[`) ? /^\[(-?\d+)\]/.exec(name.slice(base.length))?.[1] ?? [] : [])))] : [''];
  const cells = numbers.map((n) => suffixes.map((s) => number(`${base}${list ? `[${n}]` : ''}${s}`)));
  return cells.length > 0 && cells.every((cell) => cell.every(Number.isFinite)) ? { parameter, base, prime, first: Number(numbers[0] || 1), cells } : null;
}
const vector = (of: readonly (number | string)[], components: number): string => (components === 0 ? String(of[0]) : `(${of.join(', ')})`);

/** The text with another start: initial values are said again; an exact formula is left out, as it belongs to the old ones. */
function startingAt(text: string, initial: readonly Initial[], time: number): string {
  let out = text.replace(/^\s*(exact|from)\b.*$/gmu, '');
  initial.forEach(({ parameter: { list, components }, base, prime, first, cells }, k) => {
    const letters = base.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
    if (!list) { out = out.replace(new RegExp(`^\\s*${letters}${prime}\\s*\\([^()]*\\)\\s*=[^#\\n]*`, 'gmu'), () => `${base}${prime}(${time}) = ${vector(cells[0]!, components)} `)
      .replace(new RegExp(`(?<![\\p{L}\\p{N}_.'])${letters}${prime}\\s*\\([^()]*\\)`, 'gu'), () => `${base}${prime}(${time})`); return; }
    const numbered = `^\\s*${letters}\\s*\\[\\s*(-?\\w+)\\s*\\]\\s*${prime}\\s*\\([^()]*\\)\\s*=[^#\\n]*?`;
    const lists = cells[0]!.map((_, c) => `motusStart${k}c${c}`), said = lists.map((name, c) => `${name} = [${cells.map((cell) => cell[c]).join(', ')}]\n`).join('');
    let before = said;
    out = out.replace(new RegExp(`${numbered}(?:\\b(for\\s[^#\\n]*)|(?=#|$))`, 'gmu'), (_, index: string, range: string | undefined) => {
      const defined = before;
      before = '';
      return `${defined}${base}[${index}]${prime}(${time}) = ${vector(lists.map((name) => `${name}[${index} - ${first - 1}]`), components)} ${range ?? ''}`;
    });
  });
  return out;
}

/** On from the start of a step to its end and a little further; earlier: of a recurrence, back to the step before, else null. */
export async function localExact(client: Client, of: Pick<Scene, 'description' | 'state'>, trace: Trace): Promise<{ readonly exact: LocalExact | null; readonly earlier: LocalExact | null }> {
  const [start] = trace.entries, before = trace.entries.find((e) => e.before_x)?.before_x;
  if (!start) return { exact: null, earlier: null };
  if (!before) return { exact: await motion(client, of, trace, start, 1), earlier: null };
  const found = await through(client, of, trace, { x: start.x, v: start.v }, before);
  return found ? { exact: await motion(client, of, trace, found.from, 1), earlier: found.earlier } : { exact: null, earlier: null };
}

/** The exact motion that goes through a start's places and was at `before` a step earlier: its start, and back to there. null: none is found. */
async function through(client: Client, of: Pick<Scene, 'description' | 'state'>, trace: Trace, start: Start, before: readonly number[]): Promise<{ readonly from: Start; readonly earlier: LocalExact } | null> {
  const h = trace.entries[0]!.step, n = before.length, all = Array.from({ length: n }, (_, k) => k), size = Math.max(...start.x.map(Math.abs), ...before.map(Math.abs));
  const times = (matrix: readonly (readonly number[])[], of: readonly number[]): number[] => matrix.map((row) => row.reduce((sum, c, k) => sum + c * of[k]!, 0));
  // How the velocity follows the place before: as in free flight, and then as it has been seen to.
  let inverse: readonly (readonly number[])[] = all.map((i) => all.map((k) => (i === k ? -1 / h : 0))), v = start.v.map((value, k) => (k < n ? (start.x[k]! - before[k]!) / h : value));
  let best: { readonly from: Start; readonly earlier: LocalExact } | null = null, least = Infinity, apart: readonly number[] | null = null, step: readonly number[] = [];
  for (let tried = 0; tried < TRIED && least > MET * Number.EPSILON * size; tried++) {
    const from = { x: start.x, v }, earlier = await motion(client, of, trace, from, -1);
    if (!earlier) return null;
    const next = before.map((x, k) => earlier.columns.get(trace.names.x[k]!)![earlier.end]! - x), far = Math.max(...next.map(Math.abs));
    if (far < least) { least = far; best = { from, earlier }; }
    if (apart) {
      const turned = times(inverse, next.map((x, k) => x - apart![k]!)), norm = step.reduce((sum, s, k) => sum + s * turned[k]!, 0), along = all.map((k) => step.reduce((sum, s, i) => sum + s * inverse[i]![k]!, 0));
      // Nothing more is learnt from a change that is rounding.
      if (!(Math.abs(norm) > 0)) break;
      inverse = inverse.map((row, i) => row.map((c, k) => c + (step[i]! - turned[i]!) * along[k]! / norm));
    }
    apart = next;
    step = times(inverse, next).map((s) => -s);
    v = v.map((value, k) => (k < n ? value + step[k]! : value));
  }
  return least <= NEAR * size ? best : null;
}

async function motion(client: Client, of: Pick<Scene, 'description' | 'state'>, trace: Trace, begin: Start, way: 1 | -1): Promise<LocalExact | null> {
  const { description, state } = of, start = trace.entries[0]!;
  const initial = description.parameters.filter((p) => p.initial).map((p) => initialOf(p, trace.names, begin)).filter((p) => p !== null);
  if (initial.length === 0) return null;
  const names = new Set(initial.map((p) => p.parameter.name)), h = way * start.step;
  const others = Object.entries(state.set).filter(([name]) => !names.has(name)).map(([name, value]) => `${name}=${value}`);
  const shifted = description.time_dependent && start.time !== description.settings.start;
  const model = shifted || initial.some((p) => p.parameter.list) ? { text: startingAt(state.text, initial, shifted ? start.time : description.settings.start), set: others }
    : { text: state.text, set: [...others, ...initial.map(({ parameter: { name, components }, cells }) => `${name}=${vector(cells[0]!, components)}`)] };
  const from = shifted ? start.time : description.settings.start, wanted = [...trace.names.x, ...trace.names.v];
  const ask = async (beyond: number): Promise<LocalExact | null> => {
    const found = await client.ask('solve', { model, methods: [METHOD], step: Math.abs(h) / PARTS, tolerance: null, until: from + h * (1 + beyond / PARTS), columns: wanted, rows: 8 * PARTS, truth: false }, { lane: 'study' });
    const track = found.tracks[0];
    if (!track || track.problem || track.times.length <= PARTS || track.every !== 1) return null;
    // Where the text says its start in another way, the motion is another one.
    const columns = new Map(found.columns.map((name, k) => [name, track.columns[k]!])), begins = [...begin.x, ...begin.v];
    if (wanted.some((name, k) => columns.get(name)?.[0] !== begins[k])) return null;
    return { times: track.times.map((t) => t + (start.time - track.times[0]!)), columns, end: PARTS };
  };
  try {
    return await ask(way > 0 ? BEYOND : 0);
  } catch {
    return null;                                  // refused: the rest of the page does not depend on it
  }
}
