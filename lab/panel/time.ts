/* Positions, and any other quantity, against time: one strip for each, all with the same time.
 *
 * Invariant: every strip has its own scale, so that a method's line means one thing only; the exact line lies thick and green below the others.
 */
import type { Panel, Scene, Store } from '../scene';
import { axes, extent } from '../figure/axes';
import { cursor, drawReadout, heading } from '../figure/cursor';
import { el as element } from '../dom';
import { endSaid } from '../figure/ended';
import { drawEnds, endIn, endOf, endsLayout, heightsIn, type End, type EndsLayout } from '../figure/ends';
import { nameExports } from '../figure/export';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { drawMarks, marksOf } from '../figure/marks';
import { nameSpans, nameText, timeName } from '../figure/name';
import { brief, readable, shortened } from '../figure/number';
import { EXACT_WIDTH, drawTrack, begin, valueAt, viewOf, type View } from '../figure/track';
import { thin } from '../figure/thin';
import type { Figure, Frame, Ink, Pen, Said, Span, Table } from '../figure/types';
import { greenName } from '../stage/motion';
import type { Sees } from '../stage/stage';
import { lineOf } from '../figure/line';
import { words } from '../words';
import { bandsOf } from './band';
import { exactAt, exactText, movable, positions, states, timeTable } from './columns';
import { concerning } from './concern';
import { endTime, listed, moment, nameAt, timeUnit, unitOf } from './told';

const say = words.panel.time;
const STRIP = 130, MOST = 6, ANSWERED = 3;

export const timePanel = (store: Store, stage: () => Sees): Panel => {
  const errors = bandsOf(store);
  let scene: Scene | null = null, chosen: string[] = [], views: View[] = [], frames: Frame[] = [], dropped = 0;

  // The choice of quantities: boxes to tick, in a list that opens.
  const list = element('fieldset', {}, element('legend', { class: 'unseen' }, say.quantities));
  const choiceName = element('summary', {}, say.quantities);
  const choice = element('details', { class: 'figure-choice' }, choiceName, list);
  choice.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !choice.open) return;
    choice.open = false;
    choiceName.focus();
  });
  document.addEventListener('pointerdown', (event) => {
    if (choice.open && event.target instanceof Node && !choice.contains(event.target)) choice.open = false;
  });
  let offered = '';
  function offer(names: readonly string[]): void {
    const key = names.join('\n');
    if (key !== offered) {
      offered = key;
      while (list.childNodes.length > 1) list.lastChild?.remove();
      for (const name of names.slice(0, 200)) {
        const box = element('input', { type: 'checkbox', value: name });
        box.addEventListener('change', () => {
          const next = names.filter((n) => (n === name ? box.checked : chosen.includes(n)));
          store.look({ quantities: next });
          if (scene) prepare(scene, next);
        });
        list.append(element('label', {}, box, nameText(name)));
      }
    }
    for (const box of list.querySelectorAll('input')) box.checked = chosen.includes(box.value);
  }

  const truthOf = (name: string): Float64Array | null => {
    const column = scene?.state.view.exact ? scene.solution.truth?.columns[scene.solution.columns.indexOf(name)] : undefined;
    return column?.length ? column : null;
  };
  const trackColumns = (name: string): Float64Array[] => {
    const at = scene?.solution.columns.indexOf(name) ?? -1;
    return scene?.solution.tracks.map((t) => t.columns[at] ?? new Float64Array(0)) ?? [];
  };
  const linesOf = (name: string): { times: Float64Array; values: Float64Array }[] => {
    const at = scene?.solution.columns.indexOf(name) ?? -1;
    return scene?.solution.tracks.map((t) => { const line = lineOf(t, [at]); return { times: line.times, values: line.columns[at] ?? new Float64Array(0) }; }) ?? [];
  };
  const truthShown = (): boolean => chosen.some((name) => truthOf(name));
  const labels = (): string[] => [...(truthShown() && scene ? [greenName(scene)] : []), ...(scene?.looks.map((l) => l.label) ?? [])];
  const layout = (width: number): EndsLayout => endsLayout(width, labels());

  function draw(pen: Pen, ink: Ink): void {
    if (!scene) return;
    const names = layout(pen.width), { tracks, truth } = scene.solution, unit = timeUnit(scene);
    const span: [number, number] = [tracks[0]?.times[0] ?? 0, endTime(scene)];
    const all = pen.height - names.above, last = chosen.length - 1;
    // The lowest strip has the letters of the time below it.
    const each = (all - 30) / Math.max(1, chosen.length);
    // Strips line up: the widest label of any decides.
    let margin = 0;
    const put = (quiet: boolean): void => {
      frames = chosen.map((name, i) => axes(quiet ? mute(pen) : pen, ink, { min: span[0], max: span[1], label: unit ? '' : nameSpans(timeName(scene!.solution), 13), unit },
        { min: views[i]!.bounds[0], max: views[i]!.bounds[1], label: nameSpans(name, 13), unit: unitOf(scene!, name) },
        { region: { left: 0, top: names.above + i * each, width: pen.width - names.right, height: each + (i === last ? 30 : 0) }, bare: i !== last, margin, plain: true }));
    };
    if (chosen.length > 1) {
      put(true);
      margin = Math.max(...frames.map((f) => f.left));
    }
    put(false);
    chosen.forEach((name, i) => {
      const frame = frames[i]!, ends: End[] = [], columns = trackColumns(name), lines = linesOf(name), exact = truthOf(name);
      const ended = lines.map(({ times, values }) => endIn(frame, times, values));
      pen.clip(frame.left, frame.top - 2, frame.width + 2, frame.height + 3, () => {
        if (exact && truth) pen.line(thin(truth.times, exact, frame.x, frame.y), { colour: ink.exact, width: EXACT_WIDTH });
        for (const look of scene!.looks) errors.draw(pen, frame, look, name);
        lines.forEach(({ times, values }, k) => errors.split(pen, frame, scene!.looks[k]!, (look) => drawTrack(pen, frame, times, values, look, ended[k]!.rows, [tracks[k]!.times, columns[k]!])));
        if (i === 0) errors.note(pen, ink, frame, scene!.looks);
        const at = scene!.solution.columns.indexOf(name);
        tracks.forEach(({ events }, k) => { if (events) drawMarks(pen, ink, marksOf(events, (of, row) => [frame.x(events.times[row]!), frame.y(of[at]?.[row] ?? NaN)], concerning(scene!, events, [name])), scene!.looks[k]!); });
      });
      if (exact && truth) { const end = endIn(frame, truth.times, exact); ends.push({ label: greenName(scene!), colour: ink.exact, marker: null, at: end.at, exit: end.exit, heights: heightsIn(frame, truth.times, exact) }); }
      lines.forEach(({ times, values }, k) => ends.push(endOf(scene!.looks[k]!, ended[k]!, heightsIn(frame, times, values))));
      // Above a narrow picture the names stand once.
      if (i === 0 || !names.narrow) drawEnds(pen, ink, frame, names, ends);
    });
  }

  /** The values of a quantity at a time: exact first where there is one. */
  function values(name: string, t: number): number[] {
    if (!scene) return [];
    return [...(truthShown() ? [truthOf(name) ? exactAt(scene, name, t) : NaN] : []), ...linesOf(name).map((line) => valueAt(line.times, line.values, t))];
  }
  /** The same to be read. */
  const texts = (name: string, t: number): string[] =>
    values(name, t).map((v, i) => (scene && i === 0 && truthShown() && truthOf(name) ? exactText(scene, name, t) : readable(v, 6)));
  /** The strip whose values are read out: the one under the pointer. */
  function active(): number {
    const at = line.pointer();
    if (!at) return 0;
    const i = frames.findIndex((f) => at.y < f.top + f.height + 8);
    return i < 0 ? Math.max(0, frames.length - 1) : i;
  }
  function overlay(pen: Pen, ink: Ink): void {
    if (!scene || !frames.length) return;
    const t = line.shown();
    for (const frame of frames) line.draw(pen, ink, frame);
    chosen.forEach((quantity, i) => {
      const frame = frames[i];
      if (!frame) return;
      const all = values(quantity, t), shift = truthShown() ? 1 : 0;
      pen.clip(frame.left - 6, frame.top - 6, frame.width + 12, frame.height + 12, () => {
        all.forEach((v, k) => {
          const look = scene!.looks[k - shift];
          pen.mark(look?.marker ?? 'circle', frame.x(t), frame.y(v), look ? 4 : 5, look?.colour ?? ink.exact);
        });
      });
    });
    const read = frames[active()], name = chosen[active()] ?? '', hovered = line.hovered();
    if (!read || hovered === null) return;
    const colours = [...(truthShown() ? [ink.exact] : []), ...scene.looks.map((l) => l.tone)], unit = unitOf(scene, name);
    drawReadout(pen, ink, read, hovered, heading(hovered, timeUnit(scene)), texts(name, hovered).map((text, k) => ({ text: `${labels()[k]} ${text}${unit && `\u2009${unit}`}`, colour: colours[k] ?? ink.text })));
  }

  function sentence(t: number): string {
    return `${heading(t, scene ? timeUnit(scene) : '')}. ${chosen.map((name) => `${nameText(name)}: ${texts(name, t).map((text, i) => `${labels()[i]} ${text}`).join(', ')}`).join('; ')}.`;
  }
  /** Where it is at the end: by the exact motion, else by the first method. */
  function answer(): Said {
    const track = scene?.solution.tracks[0];
    if (!scene || !track) return '';
    const first = chosen.slice(0, ANSWERED), exact = first.every((name) => truthOf(name)), end = exact ? scene.solution.truth!.times[scene.solution.truth!.times.length - 1]! : track.times[track.times.length - 1]!;
    const value = (name: string): string => (exact ? shortened(exactText(scene!, name, end, 3)).replace('≈ ', '') : brief(valueAt(track.times, trackColumns(name)[0]!, end), 3));
    const spans = first.flatMap((name, k): Span[] => [...(k ? [{ text: ', ' }] : []), ...nameSpans(name, 15), { text: ` = ${value(name)}${unitOf(scene!, name) && `\u2009${unitOf(scene!, name)}`}` }]);
    return [{ text: say.at(moment(scene, end), exact ? '' : nameAt(scene, 0)) }, ...spans, { text: !scene.solution.truth && scene.solution.problem ? say.notKnown : '.' }];
  }
  /** What the bars say of each method: its last numbers, or why there are none, or since when no digit is known. */
  function bars(): string[] {
    return scene?.solution.tracks.flatMap(({ method }, k) => {
      const found = errors.of(method), by = begin(nameAt(scene!, k)), told = chosen.map((name) => ({ name, text: errors.last(method, name) })).filter(({ text }) => text && text !== '—');
      if (!found) return [];
      if (found.reason) return [say.noBars(by, found.reason)];
      return [...(told.length ? [say.barsOf(by, listed(told.map(({ name, text }) => `${nameText(name)} = ${text}`)))] : []), ...(found.until === null ? [] : [say.noDigit(by, moment(scene!, found.until))])];
    }) ?? [];
  }
  function summary(): string {
    if (!scene) return '';
    const { tracks } = scene.solution, end = endTime(scene);
    // Of several quantities, the one in which the methods differ most.
    const spread = chosen.map((name, i) => { const v = extent([values(name, end)]); return (v[1] - v[0]) / (views[i]!.bounds[1] - views[i]!.bounds[0]); });
    const first = chosen[spread.indexOf(Math.max(...spread))] ?? chosen[0] ?? '', read = texts(first, end), final = values(first, end).flatMap((v, i) =>
      // No exact value is known of some quantities; a method without one stopped before.
      (Number.isNaN(v) && truthShown() && i === 0 ? [] : [Number.isNaN(v) ? say.before(labels()[i] ?? '') : `${labels()[i]} ${shortened(read[i] ?? '')}`]));
    const leaving = [...new Set(views.flatMap((v) => v.leaving))].map((k) => scene!.looks[k]?.label ?? ''), name = (k: number): string => begin(nameAt(scene!, k));
    return [
      say.span(listed(chosen.map(nameText)), `t = ${brief(tracks[0]?.times[0] ?? 0)}`, brief(end)), final.length ? say.end(nameText(first), listed(final, 5)) : '',
      leaving.length ? begin(words.panel.leave(leaving)) : '',
      ...tracks.flatMap((track, k) => { const end = endSaid(track, timeUnit(scene!)); return end ? [say.passing(name(k), end)] : []; }),
      ...tracks.flatMap((track, k) => (track.problem ? [track.problem.message.startsWith(`${track.method} `) ? say.does(name(k), track.problem.message.slice(track.method.length + 1)) : say.stopped(name(k), track.problem.message)] : [])), ...tracks.flatMap((track, k) => (track.singular ? [say.passing(name(k), track.singular.message)] : [])),
      ...bars(), dropped ? say.most(String(MOST), String(MOST + dropped)) : '',
    ].filter(Boolean).join(' ');
  }

  const fig: Figure = figure({
    id: 'time', title: say.title, question: say.question, answer, aspect: 0.42, draw, overlay, summary,
    extra: (width) => layout(width).above + Math.max(0, chosen.length - 1) * STRIP,
    table: (): Table => (scene ? timeTable(scene, chosen) : { head: [], rows: [] }),
    controls: [choice],
  });
  errors.listen(fig.redraw);
  const want = errors.inSight(fig.element, () => scene);
  const line = cursor({ figure: fig, title: say.title, frame: () => frames[0] ?? null, times: () => scene?.solution.tracks[0]?.times ?? [], text: sentence });

  function prepare(next: Scene, wanted: readonly string[]): void {
    scene = next;
    nameExports(next.state.preset);
    const names = movable(next), there = wanted.filter((n) => names.includes(n));
    const own = positions(next), all = there.length ? there : (own.length ? own : states(next)).slice(0, 3);
    chosen = (all.length ? all : names.slice(0, 1)).slice(0, MOST);
    dropped = Math.max(0, all.length - MOST);
    offer(names);
    choiceName.textContent = say.shown(listed(chosen.map(nameText), 4));
    choice.hidden = names.length < 2;
    views = chosen.map((name) => viewOf(truthOf(name), linesOf(name).map(({ values }) => values)));
    frames = [];
    want();
    fig.redraw();
  }
  return {
    id: 'time', title: say.title, element: fig.element,
    // The stage may show all of it already, unless quantities were chosen.
    there: (next) => next.solution.tracks.length > 0 && movable(next).length > 0 && (next.state.view.quantities.length > 0 || stage().kind !== 'time' || states(next).length > 1),
    show: (next) => prepare(next, next.state.view.quantities),
    at: (t) => line.set(t),
    redraw() { if (scene) scene = recoloured(scene); fig.redraw(); },
  };
};

/** A pen that leaves no trace: to find out how much room axes take. */
function mute(pen: Pen): Pen {
  const nothing = (): void => undefined;
  return { width: pen.width, height: pen.height, line: nothing, area: nothing, mark: nothing, arrow: nothing, text: nothing, box: nothing, cells: nothing, clip: nothing };
}
