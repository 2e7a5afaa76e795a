/* The steps of several methods at the same place of their runs, and the exact motion from where each starts, asked of the core.
 *
 * Invariant: an answer is told only while it is to the latest question; a step that the core refuses is told with the reason, and does not hide the others.
 * The worker of the studies answers: the other one may be at a reference solution.
 */
import type { Trace, Track } from '../../protocol';
import { Refused, type Client, type Scene } from '../../scene';
import { words } from '../../words';
import { localExact, type LocalExact } from './local_exact';

/** A method's step. trace null: why there is none. exact, earlier: on from its start, and back to the step before a recurrence. */
export interface Opened { readonly method: string; readonly index: number; readonly trace: Trace | null; readonly exact: LocalExact | null; readonly earlier: LocalExact | null; readonly why: string }
export interface Wanted { readonly scene: Scene; readonly tracks: readonly Track[]; readonly index: number }

/** Milliseconds that the exact motion is waited for before a step is shown without it. */
const PATIENCE = 200;

function untilOf({ solution, description }: Scene): number | null {
  const times = (solution.truth ?? solution.tracks.find((t) => !t.problem))?.times;
  return times?.[times.length - 1] ?? description.settings.until;
}
async function traced(client: Client, { scene, index }: Wanted, { method, step }: Track): Promise<Opened> {
  const none = { method, index, trace: null, exact: null, earlier: null }, { text, set } = scene.state;
  try {
    const model = { text, set: Object.entries(set).map(([name, value]) => `${name}=${value}`) };
    const trace = await client.ask('trace', { model, method, step, until: untilOf(scene), index }, { lane: 'study' });
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
      const whole = await Promise.all(steps.map(async (s): Promise<Opened> => (s.trace ? {
        ...s, exact: await localExact(client, now.scene, s.trace), earlier: s.trace.entries.some((e) => e.before_x) ? await localExact(client, now.scene, s.trace, -1) : null,
      } : s)));
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
