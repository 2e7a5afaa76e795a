/* How far off each method is (distance.ts), against time on a logarithmic axis.
 *
 * Invariant: nothing is shown as known that is not: below the round-off of the numbers, and below the truth's own error, the picture is shaded; an
 * error of zero stands at the foot of the picture, and is called zero where it is read out.
 */
import { nameSpans, timeName } from '../figure/name';
import type { Panel, PanelMaker, Scene } from '../scene';
import { eventful, type ColumnKind } from '../protocol';
import { axes } from '../figure/axes';
import { cursor, drawReadout, heading } from '../figure/cursor';
import { el as element } from '../dom';
import { drawEnds, endIn, endOf, endsLayout, heightsIn, type EndsLayout } from '../figure/ends';
import { nameExports } from '../figure/export';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { brief, readable } from '../figure/number';
import { drawTrack, begin, rowAt } from '../figure/track';
import type { Figure, Frame, Ink, Pen, Said, Table } from '../figure/types';
import { exampleOf, stagingOf } from '../data';
import { furthestOf } from '../stage/motion';
import { words } from '../words';
import { bandsOf } from './band';
import { columnOf, positions, states, timeTable } from './columns';
import { amount, endTime, listed, moment, nameAt, several, timeUnit, unitOf } from './told';

const say = words.panel.error;
/* What an error is of: the kind of the columns, and its sign in tables. */
type Of = 'x' | 'v' | 's';
const KINDS: Readonly<Record<Of, { readonly kind: ColumnKind; readonly sign: string }>> = { x: { kind: 'position', sign: 'x' }, v: { kind: 'velocity', sign: "x'" }, s: { kind: 'first-order', sign: 's' } };
const ALL: readonly Of[] = ['x', 'v', 's'];
/** So many units of round-off are none. */
const NONE = 64;

/** Numbers that are told with their bars. */
const BARRED = 3;
export const errorPanel: PanelMaker = (store): Panel => {
  let scene: Scene | null = null, frame: Frame | null = null, of: Of = 'x';
  let floor = 0, low = 1e-16, high = 1, zeros = false, drawn: Float64Array[] = [], leaving: number[] = [];

  const select = element('select', {});
  /* The kinds in the list, which is written anew only when they change. */
  let offered = '';
  const own = bandsOf(store);
  const control = element('label', {}, say.of, select);
  select.addEventListener('change', () => {
    of = ALL.find((value) => value === select.value) ?? 'x';
    if (scene) prepare(scene);
  });

  const errors = (k: number): Float64Array => {
    const track = scene?.solution.tracks[k];
    const row = scene?.solution.errors.find((e) => e.method === track?.method);
    return row?.[of] ?? new Float64Array(0);
  };
  const layout = (width: number): EndsLayout => endsLayout(width, scene?.looks.map((l) => l.label) ?? []);
  const unit = (): string => (scene ? unitOf(scene, scene.description.columns.find((c) => c.kind === KINDS[of].kind)?.name ?? '') : '');

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
    const names = layout(pen.width), { tracks, truth } = scene.solution;
    const region = { left: 0, top: names.above, width: pen.width - names.right, height: pen.height - names.above }, t = timeUnit(scene);
    frame = axes(pen, ink, { min: tracks[0]?.times[0] ?? 0, max: endTime(scene), label: t ? '' : nameSpans(timeName(scene.solution), 13), unit: t }, { min: low, max: high, log: true, label: say.axis[of], unit: unit() }, { region, plain: true });
    const f = frame, foot = f.top + f.height;
    const shade = (upTo: number, words: string): void => {
      if (!(upTo > low)) return;
      const y = Math.max(f.top, f.y(upTo));
      pen.box(f.left, y, f.width, foot - y, ink.quiet, 0.1);
      pen.line([f.left, y, f.left + f.width, y], { colour: ink.quiet, width: 1, dash: [2, 3] });
      if (foot - y > 18) pen.text(f.left + f.width - 6, y + 5, words, { colour: ink.quiet, size: 11, anchor: 'end', baseline: 'top' });
    };
    const own = truth?.error ?? 0;
    if (own > 3 * floor) shade(own, say.ownError);
    shade(floor, say.roundOff);
    const ends = tracks.map((track, k) => endIn(f, track.times, drawn[k]!));
    pen.clip(f.left, f.top - 2, f.width + 2, f.height + 4, () => {
      tracks.forEach((track, k) => drawTrack(pen, f, track.times, drawn[k]!, scene!.looks[k]!, ends[k]!.rows));
    });
    drawEnds(pen, ink, f, names, tracks.map((track, k) => endOf(scene!.looks[k]!, ends[k]!, heightsIn(f, track.times, drawn[k]!))));
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
    const hovered = line.hovered();
    if (hovered !== null) drawReadout(pen, ink, f, hovered, heading(hovered, timeUnit(scene)), all.map((e, k) => ({ text: `${scene!.looks[k]?.label} ${amount(e, unit())}`, colour: scene!.looks[k]?.tone ?? ink.text })));
  }

  /** What each is off at the end of the run. */
  function answer(): Said {
    if (!scene) return '';
    const { tracks, truth } = scene.solution, end = endTime(scene), at = moment(scene, end);
    const parts = tracks.map((track, k) => {
      const name = nameAt(scene!, k), all = errors(k), last = track.times.length - 1, e = all[last] ?? NaN;
      if (track.problem || !Number.isFinite(e)) {
        const lost = track.problem?.time ?? track.times[Math.max(0, all.findIndex((v) => !Number.isFinite(v)))] ?? end;
        return say.leaves(name, moment(scene!, lost));
      }
      if (e <= NONE * floor) return say.onIt(name);
      const error = scene!.solution.errors.find((row) => row.method === track.method), body = of === 'x' && error ? furthestOf(error, last, stagingOf(exampleOf(scene!.state)).bodies) : '', by = amount(e, unit());
      return e <= (truth?.error ?? 0) ? say.under(name, amount(truth!.error, unit(), 2)) : say.one(name, body ? say.ofBody(by, body) : by);
    });
    const list = several(parts), sentence = { x: say.answer, v: say.inVelocity, s: say.inFirst }[of];
    const bars = own.said(scene, (positions(scene).length ? positions(scene) : states(scene)).slice(0, BARRED));
    return parts.length ? [{ text: sentence(at, list) }, ...bars] : '';
  }
  const against = (): string => {
    const truth = scene?.solution.truth;
    if (!truth) return '';
    if (truth.name === 'exact') return say.againstExact;
    // The reference's step is long to read to its last digit.
    return say.against(truth.name.replace(/\d+\.\d{5,}(e[+-]?\d+)?/g, (n) => brief(Number(n), 4)), truth.error > 0 ? brief(truth.error, 2) : '');
  };
  function summary(): string {
    if (!scene) return '';
    const { tracks } = scene.solution;
    const worst = tracks.map((_, k) => {
      let top = 0;
      for (const e of errors(k)) if (e > top) top = e;
      return { name: nameAt(scene!, k), top };
    }).sort((a, b) => a.top - b.top);
    const said = worst.map((w) => (w.top <= 16 * floor && w.top > 0 ? say.small(w.name, brief(w.top, 2)) : say.largestOne(w.name, brief(w.top, 3))));
    return [
      said.length ? say.largest(say.kinds[of], listed(said, 5)) : '', against(), zeros ? say.zeros : '',
      leaving.length ? begin(words.panel.leave(leaving.map((k) => nameAt(scene!, k)))) : '',
    ].filter(Boolean).join(' ');
  }
  function table(): Table {
    if (!scene) return { head: [], rows: [] };
    const name = `|${KINDS[of].sign} − truth|`, made = timeTable(scene, [name], (k) => errors(k), { [name]: begin(say.axis[of]) });
    return { ...made, note: `${against()} ${made.note ?? ''}`.trim() };
  }

  const fig: Figure = figure({
    id: 'error', title: say.title, question: say.question, answer, aspect: 0.42, draw, overlay, summary, extra: (w) => layout(w).above, table, controls: [control],
  });
  own.listen(fig.redraw);
  const want = own.inSight(fig.element, () => scene);
  const line = cursor({
    figure: fig, title: say.title, frame: () => frame, times: () => scene?.solution.tracks[0]?.times ?? [],
    text: (t) => `${heading(t, scene ? timeUnit(scene) : '')}. ${values(t).map((e, k) => `${scene?.looks[k]?.label}: ${readable(e, 3)}`).join(', ')}.`,
  });

  function prepare(next: Scene): void {
    scene = next;
    nameExports(next.state.preset);
    frame = null;
    const { truth, errors: known } = next.solution, waits = !truth || !known.length;
    const there = ALL.filter((value) => known.some((e) => e[value].length));
    if (there.length && !there.includes(of)) of = there[0]!;
    if (offered !== there.join()) {
      offered = there.join();
      select.replaceChildren(...there.map((value) => element('option', { value }, say.kinds[value])));
    }
    select.value = of;
    if (!waits) measure(next);
    control.hidden = there.length < 2;
    fig.say(waits ? say.waiting : '');
    want();
    fig.redraw();
  }
  return {
    id: 'error', title: say.title, element: fig.element, show: prepare,
    // Where nothing is known to measure against, nothing is shown.
    there: ({ solution, description }) => solution.tracks.length > 0 && !solution.problem && (!eventful(description) || solution.errors.length > 0),
    at: (t) => line.set(t),
    redraw() { if (scene) scene = recoloured(scene); fig.redraw(); },
  };
};
