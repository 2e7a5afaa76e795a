/* The error of each method, |x − truth|, against time on a logarithmic axis.
 *
 * Invariant: nothing is shown as known that is not: below the round-off of the numbers, and below the truth's own error, the picture is shaded; an
 * error of zero stands at the foot of the picture, and is called zero where it is read out.
 */
import type { Panel, PanelMaker, Scene } from '../scene';
import type { ColumnKind } from '../protocol';
import { axes } from '../figure/axes';
import { cursor, drawHeading, heading } from '../figure/cursor';
import { el as element } from '../dom';
import { nameExports } from '../figure/export';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { drawLegend, drawValues, legendLayout, lookEntry, type LegendLayout } from '../figure/legend';
import { brief, readable } from '../figure/number';
import { drawTrack, begin, listed, rowAt } from '../figure/track';
import type { Figure, Frame, Ink, Pen, Table } from '../figure/types';
import { columnOf, timeTable } from './columns';

/* What an error is of: the name in the list, the kind of the columns, and its sign on the axis. */
type Of = 'x' | 'v' | 's';
const KINDS: Readonly<Record<Of, { readonly name: string; readonly kind: ColumnKind; readonly sign: string }>> = {
  x: { name: 'position', kind: 'position', sign: 'x' }, v: { name: 'velocity', kind: 'velocity', sign: 'x′' }, s: { name: 'first-order variable', kind: 'first-order', sign: 's' },
};
const ALL: readonly Of[] = ['x', 'v', 's'];

export const errorPanel: PanelMaker = (store): Panel => {
  let scene: Scene | null = null, frame: Frame | null = null, of: Of = 'x';
  let floor = 0, low = 1e-16, high = 1, zeros = false, drawn: Float64Array[] = [], leaving: number[] = [];

  const select = element('select', {});
  /* The kinds in the list, which is written anew only when they change. */
  let offered = '';
  const control = element('label', {}, 'Error of the', select);
  select.addEventListener('change', () => {
    of = ALL.find((value) => value === select.value) ?? 'x';
    if (scene) prepare(scene);
  });

  const errors = (k: number): Float64Array => {
    const track = scene?.solution.tracks[k];
    const row = scene?.solution.errors.find((e) => e.method === track?.method);
    return row?.[of] ?? new Float64Array(0);
  };
  const layout = (width: number): LegendLayout => legendLayout(width, scene?.looks.map((l) => l.label) ?? [], 10);

  /** Bounds: from a little below what methods do to their largest error; down to the floor only if somebody comes near it. */
  function measure(next: Scene): void {
    const { truth, tracks, columns } = next.solution;
    let size = 0;
    columns.forEach((name, i) => {
      const column = columnOf(next, name);
      if (column?.kind !== KINDS[of].kind) return;
      for (const v of truth?.columns[i] ?? []) if (Math.abs(v) > size && Number.isFinite(v)) size = Math.abs(v);
    });
    floor = Number.EPSILON * (size || 1);
    let least = Infinity, most = 0;
    zeros = false;
    leaving = [];
    const cap = 1e3 * (size || 1);
    tracks.forEach((_, k) => {
      const all = errors(k), sorted: number[] = [];
      let top = 0, none = 0;
      for (let i = 0; i < all.length; i++) {
        const e = all[i]!;
        if (e > 0 && Number.isFinite(e)) { sorted.push(e); if (e > top) top = e; }
        else if (e === 0) none++;
      }
      if (top > cap) leaving.push(k);
      most = Math.max(most, Math.min(top, cap));
      // Deep dips are changes of sign, not accuracy: they need not all be in view.
      sorted.sort((a, b) => a - b);
      const typical = sorted[Math.floor(0.1 * sorted.length)];
      if (typical !== undefined) least = Math.min(least, typical);
      if (none > 1) { zeros = true; if (none > all.length / 3) least = Math.min(least, floor); }
    });
    const ground = Math.max(floor, truth?.error ?? 0);
    if (!(most > 0)) most = 1e3 * ground;
    if (least < 300 * ground) least = Math.min(least, ground) / 10;
    low = Math.max(Math.min(least / 3, most / 100), floor / 1e3);
    high = 2 * most;
    // Zero has no place on a logarithmic axis: it is drawn at the foot.
    drawn = tracks.map((_, k) => errors(k).map((e, i) => (e > 0 ? Math.max(e, low) : e === 0 && i > 0 ? low : NaN)));
  }

  function draw(pen: Pen, ink: Ink): void {
    if (!scene) return;
    const legend = layout(pen.width), { tracks, truth } = scene.solution;
    drawLegend(pen, ink, scene.looks.map(lookEntry), legend);
    const times = truth?.times ?? new Float64Array(0);
    const to = Math.max(...tracks.map((t) => t.times[t.times.length - 1] ?? 0), times[times.length - 1] ?? -Infinity);
    const from = tracks[0]?.times[0] ?? 0, back = tracks[0] && (tracks[0].times[1] ?? from) < from;
    const end = back ? Math.min(...tracks.map((t) => t.times[t.times.length - 1] ?? 0)) : to;
    const region = { left: 0, top: legend.height, width: pen.width, height: pen.height - legend.height };
    frame = axes(pen, ink, { min: from, max: end, label: 't' }, { min: low, max: high, log: true, label: `|${KINDS[of].sign} − truth|` }, { region });
    const f = frame, foot = f.top + f.height;
    const shade = (upTo: number, words: string): void => {
      if (!(upTo > low)) return;
      const y = Math.max(f.top, f.y(upTo));
      pen.box(f.left, y, f.width, foot - y, ink.quiet, 0.1);
      pen.line([f.left, y, f.left + f.width, y], { colour: ink.quiet, width: 1, dash: [2, 3] });
      if (foot - y > 18) pen.text(f.left + f.width - 6, y + 5, words, { colour: ink.quiet, size: 11, anchor: 'end', baseline: 'top' });
    };
    const own = truth?.error ?? 0;
    if (own > 3 * floor) shade(own, `below the reference’s own error`);
    shade(floor, 'round-off');
    pen.clip(f.left, f.top - 2, f.width + 2, f.height + 4, () => {
      tracks.forEach((track, k) => drawTrack(pen, f, track.times, drawn[k]!, scene!.looks[k]!, k, tracks.length));
    });
  }

  /** The error at the last row not after t: errors between rows are not known, and are not made up. */
  function values(t: number): number[] {
    return scene?.solution.tracks.map((track, k) => {
      const i = rowAt(track.times, t);
      return i < 0 || (i === track.times.length - 1 && track.times[i] !== t && track.problem) ? NaN : errors(k)[i] ?? NaN;
    }) ?? [];
  }
  function overlay(pen: Pen, ink: Ink): void {
    if (!scene || !frame) return;
    const t = line.shown(), f = frame, all = values(t);
    line.draw(pen, ink, f);
    pen.clip(f.left - 6, f.top - 6, f.width + 12, f.height + 12, () => {
      all.forEach((e, k) => {
        const look = scene!.looks[k], times = scene!.solution.tracks[k]!.times, i = rowAt(times, t);
        if (look && i >= 0) pen.mark(look.marker, f.x(times[i]!), f.y(Math.max(e, low)), 4, look.colour);
      });
    });
    drawValues(pen, ink, all.map((e) => readable(e, 3)), layout(pen.width));
    drawHeading(pen, ink, f, heading(t));
  }

  const against = (): string => {
    const truth = scene?.solution.truth;
    if (!truth) return '';
    if (truth.name === 'exact') return 'Measured against the exact motion, which is known up to round-off.';
    // The reference's step is long to read to its last digit.
    const name = truth.name.replace(/\d+\.\d{5,}(e[+-]?\d+)?/g, (n) => brief(Number(n), 4));
    return `Measured against a reference, ${name}${truth.error > 0 ? `, whose own error is about ${brief(truth.error, 2)}` : ''}.`;
  };
  function summary(): string {
    if (!scene) return '';
    const { tracks } = scene.solution;
    const worst = tracks.map((_, k) => {
      let top = 0;
      for (const e of errors(k)) if (e > top) top = e;
      return { name: scene!.looks[k]?.label ?? '', top };
    }).sort((a, b) => a.top - b.top);
    const said = worst.map((w) => `${w.name} ${w.top <= 16 * floor ? (w.top === 0 ? '0' : `${brief(w.top, 2)} (round-off)`) : brief(w.top, 3)}`);
    return [
      said.length ? `Largest error in the ${KINDS[of].name}: ${listed(said, 5)}.` : '',
      against(),
      zeros ? 'Where an error is zero to the last digit, the line runs at the foot of the picture.' : '',
      leaving.length ? `${begin(listed(leaving.map((k) => scene!.looks[k]?.label ?? '')))} ${leaving.length > 1 ? 'leave' : 'leaves'} the picture.` : '',
    ].filter(Boolean).join(' ');
  }
  function table(): Table {
    if (!scene) return { head: [], rows: [] };
    const made = timeTable(scene, [`|${KINDS[of].sign.replace('′', "'")} − truth|`], (k) => errors(k));
    return { ...made, note: `${against()} ${made.note ?? ''}`.trim() };
  }

  const fig: Figure = figure({
    id: 'error', title: 'Error', aspect: 0.5, draw, overlay, summary, extra: (w) => layout(w).height, table, controls: [control],
  });
  const line = cursor({
    figure: fig, title: 'Error', frame: () => frame, times: () => scene?.solution.tracks[0]?.times ?? [],
    text: (t) => `${heading(t)}. ${values(t).map((e, k) => `${scene?.looks[k]?.label}: ${readable(e, 3)}`).join(', ')}.`,
  });

  function prepare(next: Scene): void {
    scene = next;
    nameExports(next.state.preset);
    frame = null;
    const { truth, problem, tracks } = next.solution;
    const why = !tracks.length ? 'No method is chosen. Choose one, and its error appears here.'
      : problem ? `The error cannot be told: there is nothing exact to compare with.\n${problem.message}${problem.hint ? ` ${problem.hint}` : ''}`
      : !truth || !next.solution.errors.length ? 'This model has no exact line. A reference is computed to compare with; the error appears here when it is known.'
      : '';
    const there = ALL.filter((value) => next.solution.errors.some((e) => e[value].length));
    if (there.length && !there.includes(of)) of = there[0]!;
    if (offered !== there.join()) {
      offered = there.join();
      select.replaceChildren(...there.map((value) => element('option', { value }, KINDS[value].name)));
    }
    select.value = of;
    if (!why) measure(next);
    control.hidden = there.length < 2;
    fig.say(why);
    fig.redraw();
  }
  void store;
  return {
    id: 'error', title: 'Error', element: fig.element, show: prepare,
    at: (t) => line.set(t),
    redraw() { if (scene) scene = recoloured(scene); fig.redraw(); },
  };
};
