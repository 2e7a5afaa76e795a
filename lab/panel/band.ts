/* Bars of error along the runs of a scene: asked of the core in the worker of the studies, drawn as bands about the methods' lines, and told of the last numbers.
 *
 * Invariant: bars belong to the scene that was asked about; while another one is shown there are none.
 */
import { nameSpans } from '../figure/name';
import { tenTo } from '../figure/number';
import type { Frame, Pen, Span } from '../figure/types';
import type { Bars } from '../protocol';
import type { Look, Scene, Store } from '../scene';
import { words } from '../words';
import { moment, nameAt, unitOf } from './told';

/** Rows of a band; steps of a run beyond which its bars would take too long; columns; milliseconds of rest before they are asked for; pixels that can be seen. */
const ROWS = 160, STEPS = 200_000, COLUMNS = 24, REST = 350, SEEN = 0.6, ALPHA = 0.22, UNKNOWN = 0.08;

/** "1.5e-6" and "-2" as the page writes numbers. */
export const inPrint = (text: string): string => text.replace(/(\d)e(-?\d+)/g, (_, digit: string, power: string) => `${digit}×${tenTo(Number(power))}`).replace(/-/g, '−').replace(/ ± /, '\u00a0±\u00a0');

export interface Bands {
  /** This scene is shown. */
  want(scene: Scene): void;
  /** A figure that shows them, but whose own scene is asked for only while it is in sight: `scene` then. */
  inSight(figure: Element, scene: () => Scene | null): () => void;
  listen(listener: () => void): void;
  /** Of a method; null: none, or not yet. */
  of(method: string): Bars | null;
  /** "0.0478 ± 1.5×10⁻⁶" at the end; ''. */
  last(method: string, column: string): string;
  draw(pen: Pen, frame: Place, look: Look, column: string): void;
  /** The last numbers of the scene's first method, as a sentence; []: they are not known. */
  said(scene: Scene, columns: readonly string[]): Span[];
}
/** Where times and values lie. */
type Place = Pick<Frame, 'top' | 'height'> & { x(t: number): number; y(v: number): number };

/* One for all figures that show them. */
const made = new WeakMap<Store, Bands>();
export function bandsOf(store: Store): Bands {
  let bands = made.get(store);
  if (!bands) made.set(store, bands = create(store));
  return bands;
}
function create(store: Store): Bands {
  const found = new Map<string, Bars>(), listeners: (() => void)[] = [];
  let key = '', columns: readonly string[] = [], timer = 0, control: AbortController | null = null;

  async function ask(scene: Scene, mine: string, { signal }: AbortController): Promise<void> {
    const { state, solution } = scene, model = { text: state.text, set: Object.entries(state.set).map(([name, value]) => `${name}=${value}`) };
    for (const { method, step, tolerance, total, problem, singular } of solution.tracks) {
      if (method === 'exact' || problem || singular || total > STEPS) continue;
      try {
        const bars = await store.client.ask('bars', { model, method, step: tolerance === null ? step : null, tolerance, until: store.numbers.until, columns, rows: ROWS }, { lane: 'study', signal });
        if (mine !== key) return;
        found.set(method, bars);
        for (const listener of listeners) listener();
      } catch {
        // Called off, or refused: the figure does not depend on it.
        if (signal.aborted) return;
      }
    }
  }
  const last = (method: string, column: string): string => {
    const text = found.get(method)?.last[columns.indexOf(column)] ?? '';
    return text.endsWith('±?') ? '' : inPrint(text);
  };
  const bands: Bands = {
    last, listen: (listener) => { listeners.push(listener); },
    want(scene) {
      const { state, description, solution: { tracks } } = scene, now = JSON.stringify([state.text, state.set, state.until, tracks.map(({ method, step, tolerance, problem }) => [method, step, tolerance, problem === null])]);
      if (now === key) return;
      key = now;
      columns = description.columns.filter(({ kind }) => kind !== 'time' && kind !== 'exact').slice(0, COLUMNS).map(({ name }) => name);
      found.clear();
      control?.abort();
      window.clearTimeout(timer);
      const mine = control = new AbortController();
      timer = window.setTimeout(() => { void ask(scene, now, mine); }, REST);
    },
    of: (method) => found.get(method) ?? null,
    inSight(figure, scene) {
      let seen = false;
      const want = (): void => { const now = scene(); if (seen && now) bands.want(now); };
      new IntersectionObserver((entries) => { seen = entries[entries.length - 1]?.isIntersecting ?? false; want(); }).observe(figure);
      return want;
    },
    said(scene, wanted) {
      const method = scene.solution.tracks[0]?.method ?? '', until = found.get(method)?.until ?? null;
      if (until !== null) return [{ text: ` ${words.panel.time.noDigit(nameAt(scene, 0), moment(scene, until))}` }];
      const told = wanted.map((name) => ({ name, text: last(method, name) })).filter(({ text }) => text && text !== '—');
      return told.length ? [{ text: ` ${words.panel.time.bars(nameAt(scene, 0))}` }, ...told.flatMap(({ name, text }, k): Span[] => [...(k ? [{ text: ', ' }] : []), ...nameSpans(name, 15), { text: ` = ${text}${unitOf(scene, name) && `\u2009${unitOf(scene, name)}`}` }]), { text: '.' }] : [];
    },
    draw(pen, frame, look, column) {
      const bars = found.get(look.method), k = columns.indexOf(column), values = bars?.values[k], errors = bars?.bars[k];
      if (!bars || !values || !errors) return;
      // Where no digit is known it fills the picture, paler.
      const low = frame.top - frame.height, high = frame.top + 2 * frame.height, edge = (v: number): number => Math.min(high, Math.max(low, frame.y(v)));
      for (let from = 0; from < values.length;) {
        const known = Number.isFinite(errors[from]!), up: number[] = [], down: number[] = [];
        let seen = 0, i = from;
        for (; i < values.length && !Number.isNaN(errors[i]!) && Number.isFinite(errors[i]!) === known && Number.isFinite(values[i]!); i++) {
          const x = frame.x(bars.times[i]!), above = edge(values[i]! + errors[i]!), below = edge(values[i]! - errors[i]!);
          up.push(x, above);
          down.push(x, below);
          seen = Math.max(seen, Math.abs(below - above) / 2);
        }
        if (up.length > 2 && seen > SEEN) {
          const back: number[] = [];
          for (let n = down.length - 2; n >= 0; n -= 2) back.push(down[n]!, down[n + 1]!);
          pen.area([...up, ...back], look.colour, known ? ALPHA : UNKNOWN);
        }
        from = Math.max(i, from + 1);
      }
    },
  };
  return bands;
}
