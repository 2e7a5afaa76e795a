/* The phase plane of any two columns: a position against its velocity, or whatever pair is chosen.
 *
 * Invariant: two positions have one scale, so that a circle is a circle; what is not of one kind has its own scale on each axis.
 */
import type { Panel, Scene, Store } from '../scene';
import { axes, extent } from '../figure/axes';
import { button, el as element } from '../dom';
import { drawEnds, endIn, endOf, endsLayout, type End, type EndsLayout } from '../figure/ends';
import { nameExports } from '../figure/export';
import { figure } from '../figure/figure';
import { bodiesOf, firstMoving } from '../distance';
import { recoloured } from '../figure/ink';
import { drawMarks, marksOf } from '../figure/marks';
import { nameSpans, nameText, timeName } from '../figure/name';
import { brief, readable } from '../figure/number';
import { EXACT_WIDTH, drawPath, begin, valueAt, viewOf, type View } from '../figure/track';
import { thinPath } from '../figure/thin';
import type { Figure, Frame, Ink, Pen, Said, Span, Table } from '../figure/types';
import { greenName } from '../stage/motion';
import type { Sees } from '../stage/stage';
import { lineOf } from '../figure/line';
import { words } from '../words';
import { columnOf, exactAt, movable, positions, states, timeTable, velocityOf } from './columns';
import { concerning } from './concern';
import { swingsOf } from './swings';
import { amount, calledOf, moment, nameAt, timeUnit, unitOf } from './told';

const say = words.panel.phase;
/** Curves are compared at so many times: those that agree share a name. */
const TIMES = 256;

export const phasePanel = (store: Store, stage: () => Sees): Panel => {
  let scene: Scene | null = null, frame: Frame | null = null, pair: [string, string] = ['', ''], offered = '', time = 0;
  let views: [View, View] | null = null;

  const across = element('select', {}), up = element('select', {});
  /** A section of this motion, where it has none yet. */
  const cut = button(words.section.take, () => {
    if (!scene) return;
    const own = positions(scene), one = own[0] ?? states(scene)[0] ?? '';
    store.look({ section: { when: own.length === 1 && scene.description.time_dependent ? 'every 2 pi' : `${one} = 0 rising`, starts: [] } });
    fig.element.parentElement?.querySelector('[data-figure="section"]')?.scrollIntoView();
  }, { class: 'figure-button' });
  const controls = [element('label', {}, say.across, across), element('label', {}, say.up, up), cut];
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
  const layout = (width: number): EndsLayout => endsLayout(width, [...(truthShown() && scene ? [greenName(scene)] : []), ...(scene?.looks.map((l) => l.label) ?? [])]);
  const space = (): boolean => pair.every((name) => scene && columnOf(scene, name)?.kind === 'position');

  function draw(pen: Pen, ink: Ink): void {
    if (!scene || !views) return;
    const names = layout(pen.width), { tracks, truth } = scene.solution, [x, y] = views;
    const label = (name: string): Span[] => nameSpans(name, 13);
    const f = frame = axes(pen, ink, { min: x.bounds[0], max: x.bounds[1], label: label(pair[0]), unit: unitOf(scene, pair[0]) }, { min: y.bounds[0], max: y.bounds[1], label: label(pair[1]), unit: unitOf(scene, pair[1]) },
      { equal: space(), region: { left: 0, top: names.above, width: pen.width - names.right, height: pen.height - names.above } });
    const ends: End[] = [], ex = truthOf(pair[0]), ey = truthOf(pair[1]);
    const heights = (times: ArrayLike<number>, px: ArrayLike<number>, py: ArrayLike<number>): Float64Array => {
      const from = tracks[0]?.times[0] ?? 0, to = truth?.times[truth.times.length - 1] ?? tracks[0]?.times[tracks[0].times.length - 1] ?? 0;
      return Float64Array.from({ length: 2 * TIMES }, (_, k) => { const t = from + (to - from) * ((k >> 1) + 0.5) / TIMES; return k % 2 ? f.y(valueAt(times, py, t)) : f.x(valueAt(times, px, t)); });
    };
    pen.clip(f.left, f.top - 2, f.width + 2, f.height + 3, () => {
      if (truth && ex && ey) {
        pen.line(thinPath(ex, ey, f.x, f.y), { colour: ink.exact, width: EXACT_WIDTH });
        const end = endIn(f, ex, ey);
        ends.push({ label: greenName(scene!), colour: ink.exact, marker: null, at: end.at, exit: end.exit, heights: heights(truth.times, ex, ey) });
      }
      tracks.forEach((own, k) => {
        const line = lineOf(own, pair.map(at)), [px, py] = pair.map((name) => line.columns[at(name)] ?? new Float64Array(0)) as [Float64Array, Float64Array], end = endIn(f, px, py), look = scene!.looks[k]!;
        drawPath(pen, f, px, py, look, end.rows, [track(k, pair[0]), track(k, pair[1])]);
        ends.push(endOf(look, end, heights(line.times, px, py)));
      });
      const [ax, ay] = pair.map(at) as [number, number];
      tracks.forEach(({ events }, k) => { if (events) drawMarks(pen, ink, marksOf(events, (of, row) => [f.x(pair[0] === timeName(scene!.solution) ? events.times[row]! : of[ax]?.[row] ?? NaN), f.y(pair[1] === timeName(scene!.solution) ? events.times[row]! : of[ay]?.[row] ?? NaN)], concerning(scene!, events, pair)), scene!.looks[k]!); });
      pen.mark('ring', f.x(track(0, pair[0])[0] ?? NaN), f.y(track(0, pair[1])[0] ?? NaN), 6, ink.text);
    });
    drawEnds(pen, ink, f, names, ends);
  }
  /** Where each one is now. */
  function points(t: number): [number, number][] {
    if (!scene) return [];
    const all: [number, number][] = truthShown() ? [[exactAt(scene, pair[0], t), exactAt(scene, pair[1], t)]] : [];
    for (const own of scene.solution.tracks) { const line = lineOf(own, pair.map(at)), [x, y] = pair.map((name) => valueAt(line.times, line.columns[at(name)] ?? [], t)); all.push([x!, y!]); }
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
  }

  const speedOf = (): boolean => !!scene && velocityOf(scene, pair[0]) === pair[1];
  const question = (): Said => (!pair[0] || speedOf() ? say.question : [{ text: say.pair[0] }, ...nameSpans(pair[1], 18), { text: say.pair[1] }, ...nameSpans(pair[0], 18), { text: say.pair[2] }]);
  /** Of the exact motion, or of the first method's. */
  function answer(): Said {
    if (!scene || !scene.solution.tracks.length) return '';
    const { truth, tracks } = scene.solution, exact = truthShown() && truth, line = exact || lineOf(tracks[0]!, pair.map(at)), { times } = line;
    const [x, y] = pair.map((name) => (exact ? truthOf(name) : null) ?? line.columns[at(name)] ?? new Float64Array(0)) as [Float64Array, Float64Array];
    const value = (name: string, v: number): string => amount(v, unitOf(scene!, name)), name = (of: string): Span[] => { const called = calledOf(scene!, of); return called === nameText(of) ? nameSpans(of, 15) : [{ text: called }]; };
    const head: Span[] = exact ? [] : [{ text: say.by(nameAt(scene, 0)) }], put = (...rest: Span[]): Said => [...head, ...name(pair[0]), ...rest];
    const when = (t: number): string => moment(scene!, Number(t.toPrecision(3)));
    const { turns, repeats } = speedOf() ? swingsOf(times, x, y) : { turns: [], repeats: null }, first = turns[0], last = turns[turns.length - 1];
    if (repeats) return put({ text: say.swings(value(pair[0], repeats.low), value(pair[0], repeats.high), amount(repeats.period, timeUnit(scene))) });
    if (first && last) return put({ text: say.turns(turns.length, when(first.time), when(last.time)) });
    const [a, b] = extent([x]), [c, d] = extent([y]);
    return put({ text: say.between(value(pair[0], a), value(pair[0], b)) }, ...name(pair[1]), { text: say.andBetween(value(pair[1], c), value(pair[1], d)) });
  }
  function summary(): string {
    if (!scene || !views) return '';
    const leaving = [...new Set([...views[0].leaving, ...views[1].leaving])].map((k) => scene!.looks[k]?.label ?? '');
    const first = scene.solution.tracks[0], last = first ? first.times.length - 1 : -1;
    return [
      say.from(nameText(pair[1]), nameText(pair[0]), readable(track(0, pair[0])[0] ?? NaN, 4), readable(track(0, pair[1])[0] ?? NaN, 4)),
      last >= 0 ? say.ends(begin(scene.looks[0]?.label ?? ''), brief(track(0, pair[0])[last] ?? NaN, 5), brief(track(0, pair[1])[last] ?? NaN, 5)) : '',
      leaving.length ? begin(words.panel.leave(leaving)) : '',
    ].filter(Boolean).join(' ');
  }
  const table = (): Table => (scene ? timeTable(scene, [...new Set(pair)]) : { head: [], rows: [] });

  const fig: Figure = figure({ id: 'phase', title: say.title, question, answer, aspect: 0.62, draw, overlay, summary, extra: (w) => layout(w).above, table, controls });

  function prepare(next: Scene, wanted: readonly [string, string] | null): void {
    scene = next;
    nameExports(next.state.preset);
    frame = null;
    const time = timeName(next.solution), names = [time, ...movable(next)].filter((n) => next.solution.columns.includes(n)), key = names.join('\n');
    // The first position whose velocity changes: a ball's flight forward would be a straight line.
    const moves = (name: string): boolean => {
      const column = next.solution.tracks[0]?.columns[next.solution.columns.indexOf(velocityOf(next, name) ?? '')];
      const [low, high] = extent(column ? [column] : []);
      return !!column && high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high));
    };
    const of = next.solution.truth ?? next.solution.tracks[0], bodies = bodiesOf(positions(next)).map(({ parts }) => parts.map((k) => positions(next)[k]!));
    const first = of ? firstMoving(bodies.map((names) => names.map((n) => of.columns[next.solution.columns.indexOf(n)]))) : 0;
    // One that nearly rests, as the Sun does, is not the motion.
    const all = bodies.slice(first).flat().slice(0, 16), [one, two] = states(next), x = all.find(moves) ?? all[0] ?? one ?? names[0] ?? '';
    const v = velocityOf(next, x) ?? (two && two !== x ? two : names.find((n) => n !== x && n !== time) ?? x);
    pair = wanted && wanted.every((n) => names.includes(n)) ? [wanted[0], wanted[1]] : [x, v];
    if (key !== offered) {
      offered = key;
      for (const select of [across, up]) select.replaceChildren(...names.slice(0, 400).map((name) => element('option', { value: name }, calledOf(next, name))));
    }
    across.value = pair[0];
    up.value = pair[1];
    for (const control of controls) control.hidden = names.length < 2;
    cut.hidden = names.length < 2 || states(next).length + positions(next).length < 3 && !next.description.time_dependent || next.state.view.section !== undefined;
    const { tracks } = next.solution;
    const view = (name: string): View => viewOf(truthShown() ? truthOf(name) : null, tracks.map((own) => lineOf(own, pair.map(at)).columns[at(name)] ?? []));
    views = [view(pair[0]), view(pair[1])];
    fig.redraw();
  }
  return {
    id: 'phase', title: say.title, element: fig.element,
    // Where it stands on the stage beside the motion it is not shown twice, unless its axes were chosen.
    there: (next) => next.solution.tracks.length > 0 && movable(next).length > 1 && (next.state.view.phase !== null || stage().side !== 'phase'),
    show: (next) => prepare(next, next.state.view.phase),
    at(t) { time = t; fig.redrawOverlay(); },
    redraw() { if (scene) scene = recoloured(scene); fig.redraw(); },
  };
};
