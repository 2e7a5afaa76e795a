/* The steps of several methods at the same place of their runs, and the exact motion from where each starts, asked of the core.
 *
 * Invariant: an answer is told only while it is to the latest question; a step that the core refuses is told with the reason, and does not hide the others.
 * The worker of the studies answers: the other one may be at a reference solution.
 */
import type { Trace, Track } from '../../protocol';
import { rowAt } from '../../figure/track';
import { Refused, type Client, type Scene } from '../../scene';
import { words } from '../../words';
import { localExact, type LocalExact } from './local_exact';

/** A method's step. trace null: why there is none. exact, earlier: on from its start, and back to the step before a recurrence, through both of whose places it goes. */
export interface Opened { readonly method: string; readonly index: number; readonly trace: Trace | null; readonly exact: LocalExact | null; readonly earlier: LocalExact | null; readonly why: string }
export interface Wanted { readonly scene: Scene; readonly tracks: readonly Track[]; readonly index: number }

/** Milliseconds that the exact motion is waited for before a step is shown without it. */
const PATIENCE = 200;

function untilOf({ solution, description }: Scene): number | null {
  const times = (solution.truth ?? solution.tracks.find((t) => !t.problem))?.times;
  return times?.[times.length - 1] ?? description.settings.until;
}
/** The step of a track at the place of the first one's: the same where all have one size; of a method that chooses its own, the one that contains the start of that. */
function indexOf(track: Track, { scene, index }: Wanted): number {
  const main = scene.solution.tracks[0], begin = main?.times[0] ?? 0, way = (main?.times[main.times.length - 1] ?? begin) < begin ? -1 : 1;
  if (!main || main === track || (main.tolerance === null && track.tolerance === null)) return index;
  return stepAt(track, timeOf(main, index), way);
}
/** When step `index` begins, as far as rows tell. */
export const timeOf = ({ times, step, every, tolerance }: Track, index: number): number => {
  const begin = times[0] ?? 0, last = times[times.length - 1] ?? begin;
  return tolerance === null ? begin + index * step * (last < begin ? -1 : 1) : times[Math.min(times.length - 1, Math.floor(index / every))] ?? begin;
};
/** The step of a track that a time lies in. */
export function stepAt({ times, step, steps, every, tolerance }: Track, t: number, way: number): number {
  const begin = times[0] ?? 0, row = tolerance === null ? Math.ceil(Math.abs(t - begin) / Math.abs(step) - 1e-9) - 1 : every * rowAt(times, t + way * 1e-12 * Math.abs(t - begin));
  return Math.max(0, Math.min(steps - 1, row));
}
async function traced(client: Client, wanted: Wanted, track: Track): Promise<Opened> {
  const { scene } = wanted, { method, step, tolerance } = track, index = indexOf(track, wanted), none = { method, index, trace: null, exact: null, earlier: null }, { text, set } = scene.state;
  try {
    const model = { text, set: Object.entries(set).map(([name, value]) => `${name}=${value}`) };
    const trace = await client.ask('trace', { model, method, step: tolerance === null ? step : null, tolerance, until: untilOf(scene), index }, { lane: 'study' });
    return trace.entries.length < 2 || trace.index !== index ? { ...none, why: words.opened.over } : { ...none, trace, why: '' };
  } catch (reason) {
    if (!(reason instanceof Refused)) throw reason;
    return { ...none, why: words.opened.cannot(scene.looks.find((l) => l.method === method)?.label ?? method, reason.problem.message) };
  }
}

/** wanted: what is to be shown now, null: nothing; told: it is there. */
export function asker(client: Client, wanted: () => Wanted | null, told: (steps: readonly Opened[]) => void): { ask(): void; readonly busy: () => boolean } {
  let asking = false, version = 0;
  async function work(): Promise<void> {
    for (let mine = -1; mine !== version;) {
      mine = version;
      const now = wanted();
      if (!now) return;
      const steps = await Promise.all(now.tracks.map((track) => traced(client, now, track)));
      if (mine !== version) continue;
      const late = window.setTimeout(() => { if (mine === version) told(steps); }, PATIENCE);
      const whole = await Promise.all(steps.map(async (s): Promise<Opened> => (s.trace ? { ...s, ...await localExact(client, now.scene, s.trace) } : s)));
      window.clearTimeout(late);
      if (mine === version) told(whole);
    }
  }
  return {
    busy: () => asking,
    ask() {
      version++;
      if (asking) return;
      asking = true;
      void work().catch((error: unknown) => { if (!(error instanceof DOMException)) reportError(error); }).finally(() => { asking = false; });
    },
  };
}
