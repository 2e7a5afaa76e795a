/* Bars of error along the runs of a scene: asked of the core in the worker of the studies, drawn as bands about the methods' lines, and told of the last numbers.
 *
 * Invariant: bars belong to the scene that was asked about; while another one is shown there are none.
 */
import { nameSpans } from '../figure/name';
import { tenTo } from '../figure/number';
import { textWidth } from '../figure/shapes';
import type { Frame, Ink, Pen, Span } from '../figure/types';
import type { Bars } from '../protocol';
import type { Look, Scene, Store } from '../scene';
import { words } from '../words';
import { moment, nameAt, unitOf } from './told';

/** Pixels by which a line may leave its frame; a bar of more than this part of the size of its numbers is no number to read; rows of a band; steps of a run beyond which its bars would take too long; columns; milliseconds of rest before they are asked for; pixels that can be seen. */
const MARGIN = 12, UNTOLD = 0.5, ROWS = 160, STEPS = 200_000, COLUMNS = 24, REST = 350, SEEN = 0.6, ALPHA = 0.22, UNKNOWN = 0.08;

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
  /** "0.0478 ± 1.5×10⁻⁶" at the end; '': no digit is known. */
  last(method: string, column: string): string;
  draw(pen: Pen, frame: Place, look: Look, column: string): void;
  /** Draws a line against time by `line`: whole, or in two parts, from where no digit is known dotted. */
  split(pen: Pen, area: Area, look: Look, line: (look: Look) => void): void;
  /** Says from where on, for each of these methods of whom it is so. */
  note(pen: Pen, ink: Ink, area: Area, looks: readonly Look[]): void;
  /** The last numbers of the scene's first method, as a sentence; []: they are not known. */
  said(scene: Scene, columns: readonly string[]): Span[];
}
/** Where times and values lie. */
type Place = Pick<Frame, 'top' | 'height'> & { x(t: number): number; y(v: number): number };
/** A picture against time. */
type Area = Pick<Frame, 'left' | 'top' | 'width' | 'height'> & { x(t: number): number };
/** Of a line of which no digit is known; letters of its note, and from one to the next. */
const DOTS = [1.5, 6], LETTERS = 12, LINE = 16;

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
    const k = columns.indexOf(column), bars = found.get(method), text = bars?.last[k] ?? '';
    // A bar as large as the number has been in this run leaves it no digit, though it may be near 0 now.
    const size = bars?.values[k]?.reduce((most, v) => (Math.abs(v) > most ? Math.abs(v) : most), 0) ?? 0, bar = bars?.bars[k]?.at(-1) ?? 0;
    return text.endsWith('±?') || bar > UNTOLD * size ? '' : inPrint(text);
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
      // Where a formula gives the motion the error is told itself.
      if (scene.description.has_exact) return [];
      const method = scene.solution.tracks[0]?.method ?? '', until = found.get(method)?.until ?? null;
      if (until !== null) return [{ text: ` ${words.panel.time.noDigit(nameAt(scene, 0), moment(scene, until))}` }];
      const told = wanted.map((name) => ({ name, text: last(method, name) })).filter(({ text }) => text && text !== '—');
      return told.length ? [{ text: ` ${words.panel.time.bars(nameAt(scene, 0))}` }, ...told.flatMap(({ name, text }, k): Span[] => [...(k ? [{ text: ', ' }] : []), ...nameSpans(name, 15), { text: ` = ${text}${unitOf(scene, name) && `\u2009${unitOf(scene, name)}`}` }]), { text: '.' }] : [];
    },
    split(pen, { left, top, width, height, x }, look, line) {
      const until = found.get(look.method)?.until ?? null;
      if (until === null) { line(look); return; }
      const { times } = found.get(look.method)!, at = Math.min(left + width, Math.max(left, x(until))), back = times[times.length - 1]! < times[0]!, high = [top - MARGIN, height + 2 * MARGIN] as const;
      const first = (): void => line(back ? { ...look, dash: DOTS } : look), second = (): void => line(back ? look : { ...look, dash: DOTS });
      pen.clip(left - MARGIN, high[0], at - left + MARGIN, high[1], first);
      pen.clip(at, high[0], left + width - at + MARGIN, high[1], second);
    },
    note(pen, ink, { left, top, width, x }, looks) {
      let k = 0;
      for (const { method, label, tone } of looks) {
        const until = found.get(method)?.until ?? null;
        if (until === null) continue;
        const at = x(until) + 6, room = left + width - at - 4, ways = [words.panel.time.dotted(label), words.panel.time.unknown(label), words.panel.time.unknown('')], text = ways.find((way) => textWidth(way, LETTERS) <= room) ?? ways[2]!;
        pen.text(Math.max(left + 2, Math.min(at, at + room - textWidth(text, LETTERS))), top + LETTERS + LINE * k++, text, { colour: tone, size: LETTERS, halo: ink.surface });
      }
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
