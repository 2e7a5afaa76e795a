/* The exact motion from where a step starts: what the step is measured against, its local error.
 *
 * Asked of the worker: the same model, started from the state at the start of the step, by the Gauss method of order 8 in small steps, whose error is
 * far below that of the step looked at. Where the force depends on time, and for families, the start is written into the text (`x(0) = 1` becomes `x(3.2) = 0.4`).
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

/** What an initial value is at the start of a step, cell by cell (one, but for families): its components; null: they cannot be said. */
interface Initial { readonly parameter: Parameter; readonly base: string; readonly prime: string; readonly first: number; readonly cells: readonly (readonly number[])[] }
function initialOf(parameter: Parameter, { names, entries }: Trace): Initial | null {
  const parts = /^([^[\]()']+)('?)\(.*\)$/.exec(parameter.name), start = entries[0];
  if (!parts || !start) return null;
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

/** way: 1 to the end of the step and a little further; -1: back to the step before. */
export async function localExact(client: Client, of: Pick<Scene, 'description' | 'state'>, trace: Trace, way: 1 | -1 = 1): Promise<LocalExact | null> {
  const { description, state } = of, start = trace.entries[0];
  if (!start) return null;
  const initial = description.parameters.filter((p) => p.initial).map((p) => initialOf(p, trace)).filter((p) => p !== null);
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
    const columns = new Map(found.columns.map((name, k) => [name, track.columns[k]!])), begins = [...start.x, ...start.v];
    if (wanted.some((name, k) => columns.get(name)?.[0] !== begins[k])) return null;
    return { times: track.times.map((t) => t + (start.time - track.times[0]!)), columns, end: PARTS };
  };
  try {
    return await ask(way > 0 ? BEYOND : 0);
  } catch {
    return null;                                  // refused: the rest of the page does not depend on it
  }
}
