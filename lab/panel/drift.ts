/* What a motion keeps, by each method against time: an energy, an angular momentum, whatever the model says is invariant.
 *
 * Two scales. "As it is" shows the values themselves, with the exact one in green; methods that go further by a class leave the frame, so that a narrow
 * band is seen beside them. "Size of the change" is the logarithm of the distance from the first value: it compares methods of any quality.
 *
 * Invariant: changes are relative to the first value where that is not zero, else absolute; and the axis says which.
 */
import type { Panel, PanelMaker, Scene } from '../scene';
import { axes, extent, padded } from '../figure/axes';
import { cursor, drawReadout, heading } from '../figure/cursor';
import { el as element } from '../dom';
import { drawEnds, endIn, endOf, endsLayout, heightsIn, type End, type EndsLayout } from '../figure/ends';
import { nameExports } from '../figure/export';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { nameSpans, nameText, timeName } from '../figure/name';
import { brief, readable } from '../figure/number';
import { EXACT_WIDTH, begin, drawTrack, valueAt } from '../figure/track';
import type { AxisDefinition, Figure, Frame, Ink, Pen, Said, Table } from '../figure/types';
import { exampleOf } from '../data';
import { saidOf } from '../scenes';
import { greenName } from '../stage/motion';
import { words } from '../words';
import { columnOf, headName, invariants, timeTable } from './columns';
import { keepingOf, type Keeping } from './keeping';
import { endTime, listed, moment, nameAt, several, timeUnit } from './told';

const say = words.panel.drift;
/** A relative change that is round-off. */
const ROUNDED = 1e-14;
/** Who has more than doubled the value, and goes so many times further than the next one, leaves the frame, which has room for so many times the next one; a next
 * one that hardly moves is not worth it. */
const APART = 30, ROOM = 10, NEXT = 1e-3;

/** 0.0256 as "2.56 %"; below a hundred-thousandth, and where there is no first value to compare with, as it is. */
const share = (value: number, relative: boolean): string => (relative && value >= 1e-5 ? `${brief(100 * value, 3)}\u2009%` : brief(value, 3));

export const driftPanel: PanelMaker = (): Panel => {
  let scene: Scene | null = null, frame: Frame | null = null, chosen = '', offered = '';
  let values: Float64Array[] = [], changes: Float64Array[] = [], drawn: Float64Array[] = [], logarithmic = false, relative = true, first = 0;
  let axis: AxisDefinition = { min: -1, max: 1, label: '' };

  const select = element('select', {});
  const control = element('label', {}, say.invariant, select);
  select.addEventListener('change', () => {
    chosen = select.value;
    if (scene) prepare(scene);
  });
  const scaleSelect = element('select', {}, element('option', { value: 'linear' }, say.linear), element('option', { value: 'log' }, say.log));
  scaleSelect.addEventListener('change', () => {
    logarithmic = scaleSelect.value === 'log';
    if (scene) prepare(scene);
  });
  const named = (): string[] => [...(logarithmic ? [] : [scene ? greenName(scene) : '']), ...(scene?.looks.map((l) => l.label) ?? [])];
  const layout = (width: number): EndsLayout => endsLayout(width, named());
  const axisName = (): string => (relative ? say.axis.relative : say.axis.plain);

  function measure(next: Scene): void {
    const { tracks, columns } = next.solution, at = columns.indexOf(chosen);
    values = tracks.map((t) => t.columns[at] ?? new Float64Array(0));
    first = values.find((c) => c.length)?.[0] ?? 0;
    // A first value that is the round-off of the numbers it was made of is a zero: dividing by it would show nothing but noise.
    let size = 0;
    columns.forEach((name, i) => {
      const kind = columnOf(next, name)?.kind, value = Math.abs(tracks[0]?.columns[i]?.[0] ?? 0);
      if ((kind === 'position' || kind === 'velocity') && value > size) size = value;
    });
    relative = Math.abs(first) > 4 * Number.EPSILON * size;
    const unit = relative ? Math.abs(first) : 1;
    changes = values.map((c) => c.map((v) => (v - first) / unit));
    const reach = changes.map((d) => { const [a, b] = extent([d]); return d.length ? Math.max(Math.abs(a), Math.abs(b)) : 0; });
    const sorted = [...reach].sort((a, b) => b - a), largest = sorted[0] ?? 0;
    let kept = largest;
    for (let k = 0; k + 1 < sorted.length; k++) {
      const [far, next] = [sorted[k]!, sorted[k + 1]!];
      if (!(far > APART * next && next > NEXT * (relative ? 1 : far) && (!relative || far > 1))) break;
      kept = ROOM * next;
    }
    if (logarithmic) {
      const smallest = Math.max(Math.min(...reach.filter((r) => r > 0), largest || 1), Number.EPSILON);
      // An exact step changes it by 0 at times: such rows, and what is below round-off, stand at the foot.
      const foot = Math.max(smallest / 30, relative ? Number.EPSILON / 4 : 0);
      drawn = changes.map((d) => d.map((v, i) => (v === 0 && i === 0 ? NaN : Math.max(Math.abs(v), foot))));
      axis = { min: foot, max: 2 * Math.max(Math.min(largest, 1e300), 16 * foot), log: true, label: [{ text: axisName() }, ...nameSpans(chosen, 12)] };
    } else {
      drawn = values;
      const [low, high] = extent(changes), way = (v: number): number => first + unit * Math.max(-kept, Math.min(kept, v));
      const [least, most] = largest > 0 ? padded([way(low), way(high)], 0.08) : [first - 4 * Number.EPSILON * unit, first + 4 * Number.EPSILON * unit];
      axis = { min: least, max: most, label: nameSpans(chosen, 13) };
    }
  }

  function draw(pen: Pen, ink: Ink): void {
    if (!scene) return;
    const names = layout(pen.width), { tracks } = scene.solution, t = timeUnit(scene);
    const region = { left: 0, top: names.above, width: pen.width - names.right, height: pen.height - names.above };
    const f = frame = axes(pen, ink, { min: tracks[0]?.times[0] ?? 0, max: endTime(scene), label: t ? '' : nameSpans(timeName(scene.solution), 13), unit: t }, axis, { region, plain: true });
    const ends = tracks.map((track, k) => endIn(f, track.times, drawn[k]!)), level = f.y(first);
    if (!axis.log) pen.line([f.left, level, f.left + f.width, level], { colour: ink.exact, width: EXACT_WIDTH });
    pen.clip(f.left, f.top - 2, f.width + 2, f.height + 4, () => {
      tracks.forEach((track, k) => drawTrack(pen, f, track.times, drawn[k]!, scene!.looks[k]!, ends[k]!.rows));
    });
    const exact: End[] = axis.log ? [] : [{ label: greenName(scene), colour: ink.exact, marker: null, at: { y: level }, heights: heightsIn(f, [f.x.invert(f.left), f.x.invert(f.left + f.width)], [first, first]) }];
    drawEnds(pen, ink, f, names, [...exact, ...tracks.map((track, k) => endOf(scene!.looks[k]!, ends[k]!, heightsIn(f, track.times, drawn[k]!)))]);
  }
  const at = (t: number, of: readonly Float64Array[]): number[] => scene?.solution.tracks.map((track, k) => valueAt(track.times, of[k] ?? [], t)) ?? [];
  function overlay(pen: Pen, ink: Ink): void {
    if (!scene || !frame) return;
    const t = line.shown(), f = frame;
    line.draw(pen, ink, f);
    pen.clip(f.left - 6, f.top - 6, f.width + 12, f.height + 12, () => {
      at(t, drawn).forEach((v, k) => { const look = scene!.looks[k]; if (look) pen.mark(look.marker, f.x(t), f.y(v), 4, look.colour); });
    });
    const hovered = line.hovered();
    if (hovered !== null) drawReadout(pen, ink, f, hovered, heading(hovered, timeUnit(scene)), at(hovered, axis.log ? changes : values).map((v, k) => ({ text: `${scene!.looks[k]?.label} ${brief(v, axis.log ? 3 : 5)}`, colour: scene!.looks[k]?.tone ?? ink.text })));
  }

  const isEnergy = (): boolean => chosen === 'energy';
  const question = (): Said => (isEnergy() || !chosen ? say.question : [{ text: say.ask }, ...nameSpans(chosen, 18), { text: say.askEnd }]);
  /** A change as a percentage, or as a number that says of what. */
  const changed = (size: number): string => (relative && size < 1e-5 ? say.ofFirst(share(size, relative)) : share(size, relative));
  /** What the name of an invariant stands for; ''. */
  function meaning(): string {
    const keeps = scene ? saidOf(exampleOf(scene.state))?.keeps : undefined, name = chosen.replace(/[.[].*$/, '');
    return keeps && Object.hasOwn(keeps, name) ? `${keeps[name]!} ` : '';
  }
  /** What a method does with it, and the number that goes with that. */
  function numberOf(kept: Keeping): string {
    switch (kept.kind) {
      case 'grows': case 'shrinks': case 'adds': case 'takes': return share(kept.rate, true);
      case 'keeps': return kept.most <= ROUNDED ? say.rounding : brief(kept.most, 2);
      case 'back': case 'strays': return changed(kept.most);
      case 'higher': case 'lower': return changed(kept.by);
      case 'times': return brief(kept.factor, 3);
      default: return moment(scene!, kept.time);
    }
  }
  function answer(): string {
    if (!scene) return '';
    const { tracks } = scene.solution, kinds = new Map<Keeping['kind'], string[]>();
    tracks.forEach((track, k) => {
      const kept = keepingOf(track, values[k] ?? [], changes[k] ?? [], relative), name = nameAt(scene!, k);
      if (!kept) return;
      const said = kinds.get(kept.kind), number = numberOf(kept);
      if (said) said.push(kept.kind === 'keeps' ? say.alsoKeeps(name, number) : say.also(kept.kind, name, number)); else kinds.set(kept.kind, [say[kept.kind](name, number)]);
    });
    return kinds.size ? `${meaning()}${begin(say.join([...kinds.values()].map((parts) => several(parts, 5))))}` : '';
  }
  function summary(): string {
    if (!scene) return '';
    const name = nameText(chosen), far = changes.map((d, k) => {
      const [a, b] = extent([d]);
      return { name: nameAt(scene!, k), top: d.length ? Math.max(Math.abs(a), Math.abs(b)) : NaN };
    }).sort((a, b) => a.top - b.top);
    const said = far.map((w) => (w.top < 1e-14 && w.top > 0 && relative ? words.panel.error.small(w.name, brief(w.top, 2)) : words.panel.error.largestOne(w.name, brief(w.top, 3))));
    return [begin(relative ? say.begins(name, brief(first, 6)) : say.zero(name)), said.length ? say.furthest(relative, listed(said, 5)) : ''].filter(Boolean).join(' ');
  }
  const table = (): Table => {
    const name = `${axisName()}${chosen}`;
    return scene ? timeTable(scene, [name], (k) => changes[k] ?? new Float64Array(0), { [name]: [{ text: begin(axisName()) }, ...headName(chosen)] }) : { head: [], rows: [] };
  };

  const fig: Figure = figure({
    id: 'drift', title: () => (isEnergy() || !chosen ? say.energy : say.title), question, answer, aspect: 0.42, draw, overlay, summary, extra: (w) => layout(w).above, table,
    controls: [control, element('label', {}, say.scale, scaleSelect)],
  });
  const line = cursor({
    figure: fig, title: say.title, frame: () => frame, times: () => scene?.solution.tracks[0]?.times ?? [],
    text: (t) => `${heading(t, scene ? timeUnit(scene) : '')}. ${at(t, changes).map((v, k) => `${scene?.looks[k]?.label}: ${readable(v, 3)}`).join(', ')}.`,
  });

  function prepare(next: Scene): void {
    scene = next;
    nameExports(next.state.preset);
    frame = null;
    const all = invariants(next).slice(0, 200);
    if (!all.includes(chosen)) chosen = all[0] ?? '';
    if (offered !== all.join('\n')) {
      offered = all.join('\n');
      select.replaceChildren(...all.map((name) => element('option', { value: name }, nameText(name))));
    }
    select.value = chosen;
    control.hidden = all.length < 2;
    measure(next);
    fig.redraw();
  }
  return {
    id: 'drift', get title() { return isEnergy() || !chosen ? say.energy : say.title; }, element: fig.element, show: prepare,
    there: (next) => next.solution.tracks.length > 0 && invariants(next).length > 0,
    at: (t) => line.set(t),
    redraw() { if (scene) scene = recoloured(scene); fig.redraw(); },
  };
};
