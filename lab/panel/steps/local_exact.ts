/* The exact motion from where a step starts: what the step is measured against, its local error.
 *
 * Asked of the worker: the same model, started from the state at the start of the step, by the Gauss method of order 8 in small steps, whose error is
 * far below that of the step looked at. Not to be had where the force depends on time (the model's clock starts where the model says), or
 * where initial values cannot be set one by one (families); then there is none, and the page says nothing of it.
 */
import type { Client, Scene } from '../../scene';
import type { Parameter, Trace } from '../../protocol';

export interface LocalExact { readonly times: Float64Array; readonly columns: ReadonlyMap<string, Float64Array> }

const PARTS = 16, METHOD = 'gauss8';

function settingOf(p: Parameter, trace: Trace): string | null {
  const parts = /^([^[\]()']+)('?)\(.*\)$/.exec(p.name), start = trace.entries[0];
  if (!parts || !start || p.list) return null;
  const [, base, prime] = parts;
  const number = (suffix: string): number | undefined => {
    const position = prime ? -1 : trace.names.x.indexOf(`${base}${suffix}`);
    if (position >= 0) return start.x[position];
    const velocity = trace.names.v.indexOf(`${base}${prime ?? ''}${suffix}`);
    return velocity >= 0 ? start.v[velocity] : undefined;
  };
  const suffixes = p.components === 0 ? [''] : p.components <= 3 ? ['.x', '.y', '.z'].slice(0, p.components) : Array.from({ length: p.components }, (_, k) => `[${k + 1}]`);
  const values = suffixes.map(number);
  if (!values.every(x => x !== undefined && Number.isFinite(x))) return null;
  return `${p.name}=${p.components === 0 ? values[0] : `(${values.join(', ')})`}`;
}

export async function localExact(client: Client, scene: Scene, trace: Trace): Promise<LocalExact | null> {
  const { description, state } = scene, start = trace.entries[0];
  if (!start || description.time_dependent) return null;
  const initial = description.parameters.filter(p => p.initial);
  const settings = initial.map(p => settingOf(p, trace));
  if (settings.length === 0 || settings.includes(null)) return null;
  const names = new Set(initial.map(p => p.name));
  const others = Object.entries(state.set).filter(([name]) => !names.has(name)).map(([name, value]) => `${name}=${value}`);
  const h = start.step;
  try {
    const found = await client.ask('solve', {
      model: { text: state.text, set: [...others, ...settings as string[]] }, methods: [METHOD], step: Math.abs(h) / PARTS, until: description.settings.start + h,
      columns: trace.names.x, rows: 4 * PARTS, truth: false,
    }, { lane: 'quick', key: 'local-exact' });
    const track = found.tracks[0];
    if (!track || track.problem || track.times.length < 2) return null;
    const shift = start.time - track.times[0]!;
    return { times: track.times.map(t => t + shift), columns: new Map(found.columns.map((name, k) => [name, track.columns[k]!])) };
  } catch {
    return null;                                  // refused: the rest of the page does not depend on it
  }
}
