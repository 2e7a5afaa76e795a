/* Positions, and any other quantity, against time: one strip for each, all with the same time.
 *
 * Invariant: every strip has its own scale, so that a method's line means one thing only; the exact line lies thick and green below the others.
 */
import type { Panel, PanelMaker, Scene } from '../scene';
import { axes, extent } from '../figure/axes';
import { cursor, drawHeading, heading } from '../figure/cursor';
import { el as element } from '../dom';
import { nameExports } from '../figure/export';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { drawLegend, drawValues, exactEntry, legendLayout, lookEntry, type Entry, type LegendLayout } from '../figure/legend';
import { brief, primed, readable, shortened } from '../figure/number';
import { EXACT_WIDTH, drawTrack, begin, listed, valueAt, viewOf, type View } from '../figure/track';
import { thin } from '../figure/thin';
import type { Figure, Frame, Ink, Pen, Table } from '../figure/types';
import { exactAt, exactText, movable, positions, timeTable } from './columns';

const STRIP = 140, MOST = 6, LETTERS = 11;

export const timePanel: PanelMaker = (store): Panel => {
  let scene: Scene | null = null, chosen: string[] = [], views: View[] = [], frames: Frame[] = [], dropped = 0;

  // The choice of quantities: boxes to tick, in a list that opens.
  const list = element('fieldset', {}, element('legend', { class: 'visually-hidden' }, 'Quantities shown'));
  const choiceName = element('summary', {}, 'Quantities');
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
        list.append(element('label', {}, box, primed(name)));
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
  const truthShown = (): boolean => chosen.some((name) => truthOf(name));
  const truthLabel = (): string => (scene?.solution.truth?.name === 'exact' ? 'exact' : 'reference');
  const labels = (): string[] => [...(truthShown() ? [truthLabel()] : []), ...(scene?.looks.map((l) => l.label) ?? [])];
  const layout = (width: number): LegendLayout => legendLayout(width, labels(), LETTERS);

  function draw(pen: Pen, ink: Ink): void {
    if (!scene) return;
    const legend = layout(pen.width);
    const entries: Entry[] = [...(truthShown() ? [exactEntry(ink, truthLabel())] : []), ...scene.looks.map(lookEntry)];
    drawLegend(pen, ink, entries, legend);
    const { tracks, truth } = scene.solution;
    const span: [number, number] = [tracks[0]?.times[0] ?? 0, endOf(scene)];
    const all = pen.height - legend.height, last = chosen.length - 1;
    // The lowest strip has the letters of the time below it.
    const each = (all - 30) / Math.max(1, chosen.length);
    // Strips line up: the widest label of any decides.
    let margin = 0;
    const put = (quiet: boolean): void => {
      frames = chosen.map((name, i) => axes(quiet ? mute(pen) : pen, ink, { min: span[0], max: span[1], label: 't' },
        { min: views[i]!.bounds[0], max: views[i]!.bounds[1], label: primed(name) },
        { region: { left: 0, top: legend.height + i * each, width: pen.width, height: each + (i === last ? 30 : 0) }, bare: i !== last, margin }));
    };
    if (chosen.length > 1) {
      put(true);
      margin = Math.max(...frames.map((f) => f.left));
    }
    put(false);
    chosen.forEach((name, i) => {
      const frame = frames[i]!;
      pen.clip(frame.left, frame.top - 2, frame.width + 2, frame.height + 3, () => {
        const exact = truthOf(name);
        if (exact && truth) pen.line(thin(truth.times, exact, frame.x, frame.y), { colour: ink.exact, width: EXACT_WIDTH });
        const columns = trackColumns(name);
        tracks.forEach((track, k) => drawTrack(pen, frame, track.times, columns[k]!, scene!.looks[k]!, k, tracks.length));
      });
    });
  }

  /** The values of a quantity at a time: exact first where there is one. */
  function values(name: string, t: number): number[] {
    if (!scene) return [];
    const columns = trackColumns(name);
    return [
      ...(truthShown() ? [truthOf(name) ? exactAt(scene, name, t) : NaN] : []),
      ...scene.solution.tracks.map((track, k) => valueAt(track.times, columns[k]!, t)),
    ];
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
    const t = line.shown(), legend = layout(pen.width), name = chosen[active()] ?? '';
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
    // Which strip the values are of: the time stands at its head.
    const read = frames[active()];
    if (read) drawHeading(pen, ink, read, chosen.length > 1 ? `${primed(name)} at ${heading(t)}` : heading(t));
    drawValues(pen, ink, texts(name, t), legend);
  }

  function sentence(t: number): string {
    return `${heading(t)}. ${chosen.map((name) => `${primed(name)}: ${texts(name, t).map((text, i) => `${labels()[i]} ${text}`).join(', ')}`).join('; ')}.`;
  }
  function summary(): string {
    if (!scene) return '';
    const { tracks } = scene.solution, end = endOf(scene);
    // Of several quantities, the one in which the methods differ most.
    const spread = chosen.map((name, i) => { const v = extent([values(name, end)]); return (v[1] - v[0]) / (views[i]!.bounds[1] - views[i]!.bounds[0]); });
    const first = chosen[spread.indexOf(Math.max(...spread))] ?? chosen[0] ?? '', read = texts(first, end), final = values(first, end).flatMap((v, i) =>
      // No exact value is known of some quantities; a method without one stopped before.
      (Number.isNaN(v) && truthShown() && i === 0 ? [] : [Number.isNaN(v) ? `${labels()[i]} stopped before` : `${labels()[i]} ${shortened(read[i] ?? '')}`]));
    const leaving = [...new Set(views.flatMap((v) => v.leaving))].map((k) => scene!.looks[k]?.label ?? '');
    const stopped = tracks.flatMap((track, k) => (track.problem ? [`${begin(scene!.looks[k]?.label ?? '')} stopped: ${track.problem.message}.`] : []));
    const passing = tracks.flatMap((track, k) => (track.singular ? [`${begin(scene!.looks[k]?.label ?? '')}: ${track.singular.message}.`] : []));
    return [
      `${listed(chosen.map(primed))} from t = ${brief(tracks[0]?.times[0] ?? 0)} to ${brief(end)}.`,
      final.length ? `At the end, ${primed(first)}: ${listed(final, 5)}.` : '',
      leaving.length ? `${begin(listed(leaving))} ${leaving.length > 1 ? 'leave' : 'leaves'} the picture.` : '',
      ...stopped, ...passing, dropped ? `${MOST} of ${MOST + dropped} chosen quantities are shown.` : '',
    ].filter(Boolean).join(' ');
  }

  const fig: Figure = figure({
    id: 'time', title: 'Against time', aspect: 0.46, draw, overlay, summary,
    extra: (width) => layout(width).height + Math.max(0, chosen.length - 1) * STRIP,
    table: (): Table => (scene ? timeTable(scene, chosen) : { head: [], rows: [] }),
    controls: [choice],
  });
  const line = cursor({ figure: fig, title: 'Against time', frame: () => frames[0] ?? null, times: () => scene?.solution.tracks[0]?.times ?? [], text: sentence });

  function prepare(next: Scene, wanted: readonly string[]): void {
    scene = next;
    nameExports(next.state.preset);
    const names = movable(next), there = wanted.filter((n) => names.includes(n));
    const all = there.length ? there : positions(next).slice(0, 3);
    chosen = (all.length ? all : names.slice(0, 1)).slice(0, MOST);
    dropped = Math.max(0, all.length - MOST);
    offer(names);
    choiceName.textContent = `Quantities: ${listed(chosen.map(primed), 4)}`;
    choice.hidden = names.length < 2;
    views = chosen.map((name) => viewOf(truthOf(name), trackColumns(name)));
    frames = [];
    fig.say(!next.solution.tracks.length ? 'No method is chosen. Choose one, and its motion appears here.' : !chosen.length ? 'This model has nothing that moves.' : '');
    fig.redraw();
  }
  return {
    id: 'time', title: 'Against time', element: fig.element,
    show: (next) => prepare(next, next.state.view.quantities),
    at: (t) => line.set(t),
    redraw() { if (scene) scene = recoloured(scene); fig.redraw(); },
  };
};

/** Where the run would end: the last time of whoever came furthest. */
function endOf(scene: Scene): number {
  const ends = [...scene.solution.tracks.map((t) => t.times), scene.solution.truth?.times ?? new Float64Array(0)].filter((t) => t.length);
  const start = ends[0]?.[0] ?? 0;
  return ends.map((t) => t[t.length - 1]!).reduce((a, b) => (Math.abs(b - start) > Math.abs(a - start) ? b : a), start);
}

/** A pen that leaves no trace: to find out how much room axes take. */
function mute(pen: Pen): Pen {
  const nothing = (): void => undefined;
  return { width: pen.width, height: pen.height, line: nothing, area: nothing, mark: nothing, arrow: nothing, text: nothing, box: nothing, cells: nothing, clip: nothing };
}
