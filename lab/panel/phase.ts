/* The phase plane of any two columns: a position against its velocity, or whatever pair is chosen.
 *
 * Invariant: two positions have one scale, so that a circle is a circle; what is not of one kind has its own scale on each axis.
 */
import type { Panel, PanelMaker, Scene } from '../scene';
import { axes, extent } from '../figure/axes';
import { el as element } from '../dom';
import { nameExports } from '../figure/export';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { drawLegend, exactEntry, legendLayout, lookEntry, type LegendLayout } from '../figure/legend';
import { brief, primed, readable } from '../figure/number';
import { drawHeading, heading } from '../figure/cursor';
import { EXACT_WIDTH, drawPath, begin, listed, valueAt, viewOf, type View } from '../figure/track';
import { thinPath } from '../figure/thin';
import type { Figure, Frame, Ink, Pen, Table } from '../figure/types';
import { columnOf, exactAt, movable, positions, timeTable, velocityOf } from './columns';

export const phasePanel: PanelMaker = (store): Panel => {
  let scene: Scene | null = null, frame: Frame | null = null, pair: [string, string] = ['', ''], offered = '', time = 0;
  let views: [View, View] | null = null;

  const across = element('select', {}), up = element('select', {});
  const controls = [element('label', {}, 'Across', across), element('label', {}, 'Up', up)];
  for (const select of [across, up]) {
    select.addEventListener('change', () => {
      const next: [string, string] = [across.value, up.value];
      store.look({ phase: next });
      if (scene) prepare(scene, next);
    });
  }

  const at = (name: string): number => scene?.solution.columns.indexOf(name) ?? -1;
  const track = (k: number, name: string): Float64Array => scene?.solution.tracks[k]?.columns[at(name)] ?? new Float64Array(0);
  const truthOf = (name: string): Float64Array | null => {
    const column = scene?.state.view.exact ? scene.solution.truth?.columns[at(name)] : undefined;
    return column?.length ? column : null;
  };
  const truthShown = (): boolean => !!(truthOf(pair[0]) && truthOf(pair[1]));
  const truthLabel = (): string => (scene?.solution.truth?.name === 'exact' ? 'exact' : 'reference');
  const layout = (width: number): LegendLayout => legendLayout(width, [...(truthShown() ? [truthLabel()] : []), ...(scene?.looks.map((l) => l.label) ?? [])]);
  const space = (): boolean => pair.every((name) => scene && columnOf(scene, name)?.kind === 'position');

  function draw(pen: Pen, ink: Ink): void {
    if (!scene || !views) return;
    const legend = layout(pen.width), { tracks, truth } = scene.solution;
    drawLegend(pen, ink, [...(truthShown() ? [exactEntry(ink, truthLabel())] : []), ...scene.looks.map(lookEntry)], legend);
    const [x, y] = views;
    const f = frame = axes(pen, ink, { min: x.bounds[0], max: x.bounds[1], label: primed(pair[0]) }, { min: y.bounds[0], max: y.bounds[1], label: primed(pair[1]) },
      { equal: space(), region: { left: 0, top: legend.height, width: pen.width, height: pen.height - legend.height } });
    pen.clip(f.left, f.top - 2, f.width + 2, f.height + 3, () => {
      const ex = truthOf(pair[0]), ey = truthOf(pair[1]);
      if (truth && ex && ey) pen.line(thinPath(ex, ey, f.x, f.y), { colour: ink.exact, width: EXACT_WIDTH });
      tracks.forEach((_, k) => drawPath(pen, f, track(k, pair[0]), track(k, pair[1]), scene!.looks[k]!, k, tracks.length));
      const x0 = track(0, pair[0])[0] ?? NaN, y0 = track(0, pair[1])[0] ?? NaN;
      pen.mark('ring', f.x(x0), f.y(y0), 6, ink.text);
    });
  }
  /** Where each one is now. */
  function points(t: number): [number, number][] {
    if (!scene) return [];
    const all: [number, number][] = truthShown() ? [[exactAt(scene, pair[0], t), exactAt(scene, pair[1], t)]] : [];
    scene.solution.tracks.forEach(({ times }, k) => all.push([valueAt(times, track(k, pair[0]), t), valueAt(times, track(k, pair[1]), t)]));
    return all;
  }
  function overlay(pen: Pen, ink: Ink): void {
    if (!scene || !frame) return;
    const f = frame, shift = truthShown() ? 1 : 0;
    pen.clip(f.left - 7, f.top - 7, f.width + 14, f.height + 14, () => {
      points(time).forEach(([x, y], k) => {
        const look = scene!.looks[k - shift], px = f.x(x), py = f.y(y);
        // A rim of the surface's colour lifts the present point off the lines.
        pen.mark(look?.marker ?? 'circle', px, py, look ? 7 : 8, ink.surface);
        pen.mark(look?.marker ?? 'circle', px, py, look ? 5 : 6, look?.colour ?? ink.exact);
      });
    });
    drawHeading(pen, ink, f, heading(time));
  }

  function summary(): string {
    if (!scene || !views) return '';
    const leaving = [...new Set([...views[0].leaving, ...views[1].leaving])].map((k) => scene!.looks[k]?.label ?? '');
    const first = scene.solution.tracks[0], last = first ? first.times.length - 1 : -1;
    const end = last >= 0 ? `${begin(scene.looks[0]?.label ?? '')} ends at (${brief(track(0, pair[0])[last] ?? NaN, 5)}, ${brief(track(0, pair[1])[last] ?? NaN, 5)}).` : '';
    return [
      `${primed(pair[1])} against ${primed(pair[0])}, from the ring (${readable(track(0, pair[0])[0] ?? NaN, 4)}, ${readable(track(0, pair[1])[0] ?? NaN, 4)}) on.`, end,
      leaving.length ? `${begin(listed(leaving))} ${leaving.length > 1 ? 'leave' : 'leaves'} the picture.` : '',
    ].filter(Boolean).join(' ');
  }
  const table = (): Table => (scene ? timeTable(scene, [...new Set(pair)]) : { head: [], rows: [] });

  const fig: Figure = figure({ id: 'phase', title: 'Phase plane', aspect: 0.7, draw, overlay, summary, extra: (w) => layout(w).height, table, controls });

  function prepare(next: Scene, wanted: readonly [string, string] | null): void {
    scene = next;
    nameExports(next.state.preset);
    frame = null;
    const names = ['t', ...movable(next)].filter((n) => next.solution.columns.includes(n)), key = names.join('\n');
    // The first position whose velocity changes: a ball's flight forward would be a straight line.
    const moves = (name: string): boolean => {
      const column = next.solution.tracks[0]?.columns[next.solution.columns.indexOf(velocityOf(next, name) ?? '')];
      const [low, high] = extent(column ? [column] : []);
      return !!column && high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high));
    };
    const all = positions(next).slice(0, 16), x = all.find(moves) ?? all[0] ?? names[0] ?? '', v = velocityOf(next, x) ?? names.find((n) => n !== x && n !== 't') ?? x;
    pair = wanted && wanted.every((n) => names.includes(n)) ? [wanted[0], wanted[1]] : [x, v];
    if (key !== offered) {
      offered = key;
      for (const select of [across, up]) select.replaceChildren(...names.slice(0, 400).map((name) => element('option', { value: name }, primed(name))));
    }
    across.value = pair[0];
    up.value = pair[1];
    for (const control of controls) control.hidden = names.length < 2;
    const { tracks } = next.solution;
    const view = (name: string): View => viewOf(truthShown() ? truthOf(name) : null, tracks.map((_, k) => track(k, name)));
    views = [view(pair[0]), view(pair[1])];
    fig.say(!tracks.length ? 'No method is chosen. Choose one, and its path appears here.' : !pair[0] ? 'This model has nothing that moves.' : '');
    fig.redraw();
  }
  return {
    id: 'phase', title: 'Phase plane', element: fig.element,
    show: (next) => prepare(next, next.state.view.phase),
    at(t) { time = t; fig.redrawOverlay(); },
    redraw() { if (scene) scene = recoloured(scene); fig.redraw(); },
  };
};
