/* How far an invariant strays from its first value, against time.
 *
 * Two scales. "signed" is linear about zero and logarithmic further out, on both sides: the sign is kept (a method that gains energy and one that
 * loses it part ways), and a narrow band can be seen beside a method that has gone a thousand times further. The linear part is as wide as
 * the methods need that come next to the wildest ones: what is smaller still runs along zero, else each of its changes of sign would cross the
 * picture. Where there is no such difference, all of the scale is linear. "size" is the plain logarithm of the distance: it compares methods of any
 * quality, without the sign.
 *
 * Invariant: relative to the first value where that is not zero, else absolute; and the axis says which.
 */
import type { Panel, PanelMaker, Scene } from '../scene';
import { axes, extent } from '../figure/axes';
import { cursor, drawHeading, heading } from '../figure/cursor';
import { el as element } from '../dom';
import { nameExports } from '../figure/export';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { drawLegend, drawValues, legendLayout, lookEntry, type LegendLayout } from '../figure/legend';
import { brief, readable } from '../figure/number';
import { drawTrack, begin, listed, valueAt } from '../figure/track';
import type { AxisDefinition, Figure, Frame, Ink, Pen, Table } from '../figure/types';
import { columnOf, invariants, timeTable } from './columns';

/** Beyond this a drift, relative or not, says only that the motion is lost. */
const LOST = 1e4;
const DECADES = 5;
/** So many times further is further by a class, which a linear scale would not show. */
const APART = 30;

export const driftPanel: PanelMaker = (): Panel => {
  let scene: Scene | null = null, frame: Frame | null = null, chosen = '', offered = '';
  let drifts: Float64Array[] = [], signed: Float64Array[] = [], logarithmic = false, relative = true, first = 0;
  let axis: AxisDefinition = { min: -1, max: 1, label: '' }, leaving: number[] = [];

  const select = element('select', {});
  const control = element('label', {}, 'Invariant', select);
  select.addEventListener('change', () => {
    chosen = select.value;
    if (scene) prepare(scene);
  });
  const scaleSelect = element('select', {}, element('option', { value: 'signed' }, 'signed'), element('option', { value: 'size' }, 'size, logarithmic'));
  const scaleControl = element('label', {}, 'Scale', scaleSelect);
  scaleSelect.addEventListener('change', () => {
    logarithmic = scaleSelect.value === 'size';
    if (scene) prepare(scene);
  });
  const layout = (width: number): LegendLayout => legendLayout(width, scene?.looks.map((l) => l.label) ?? [], 11);
  const axisName = (): string => (relative ? `relative change of ${chosen}` : `change of ${chosen}`);

  function measure(next: Scene): void {
    const { tracks, columns } = next.solution, at = columns.indexOf(chosen);
    const all = tracks.map((t) => t.columns[at] ?? new Float64Array(0));
    first = all.find((c) => c.length)?.[0] ?? 0;
    // A first value that is the round-off of the numbers it was made of is a zero: dividing by it would show nothing but noise.
    let size = 0;
    columns.forEach((name, i) => {
      const kind = columnOf(next, name)?.kind, value = Math.abs(tracks[0]?.columns[i]?.[0] ?? 0);
      if ((kind === 'position' || kind === 'velocity') && value > size) size = value;
    });
    relative = Math.abs(first) > 4 * Number.EPSILON * size;
    const unit = relative ? Math.abs(first) : 1;
    drifts = signed = all.map((c) => c.map((v) => (v - first) / unit));
    const reach = drifts.map((d) => { const [a, b] = extent([d]); return d.length ? Math.max(Math.abs(a), Math.abs(b)) : 0; });
    leaving = reach.flatMap((r, k) => (r > LOST ? [k] : []));
    // Those that are lost leave the picture, and the others fill it; where all are lost, it shows them getting lost.
    const kept = drifts.filter((_, k) => reach[k]! <= LOST);
    const bounds = extent(kept.length ? kept : drifts), low = Math.max(bounds[0], -LOST), high = Math.min(bounds[1], LOST);
    const largest = Math.max(Math.abs(low), Math.abs(high));
    const smallest = Math.max(Math.min(...reach.filter((r) => r > 0), largest || 1), Number.EPSILON);
    // The next group below the wildest one, if there is one that the eye can still be led to.
    const calm = Math.max(...reach.filter((r) => r < largest / APART && r > largest / 10 ** DECADES), 0);
    if (logarithmic) {
      // An exact step drifts by 0 at times: such rows, and what is below round-off, stand at the foot.
      const foot = Math.max(smallest / 30, relative ? Number.EPSILON / 4 : 0);
      drifts = drifts.map((d) => d.map((v, i) => (v === 0 && i === 0 ? NaN : Math.max(Math.abs(v), foot))));
      axis = { min: foot, max: 2 * Math.max(largest, 16 * foot), log: true, label: `size of the ${axisName()}` };
    } else if (!(largest > 0)) axis = { min: -4 * Number.EPSILON, max: 4 * Number.EPSILON, label: axisName() };
    else if (!calm) {
      const room = 0.08 * Math.max(high - low, largest);
      axis = { min: low - room, max: high + room, label: axisName() };
    } else {
      axis = { min: -1.5 * Math.max(1.2 * calm, -low), max: 1.5 * Math.max(1.2 * calm, high), linear: calm, label: axisName() };
    }
  }

  /** The drift as it is, whatever is drawn. */
  const drift = (k: number): Float64Array => (scene ? signed[k] ?? new Float64Array(0) : new Float64Array(0));

  function draw(pen: Pen, ink: Ink): void {
    if (!scene) return;
    const legend = layout(pen.width), { tracks } = scene.solution;
    drawLegend(pen, ink, scene.looks.map(lookEntry), legend);
    const from = tracks[0]?.times[0] ?? 0;
    const end = tracks.map((t) => t.times[t.times.length - 1] ?? from).reduce((a, b) => (Math.abs(b - from) > Math.abs(a - from) ? b : a), from);
    const region = { left: 0, top: legend.height, width: pen.width, height: pen.height - legend.height };
    const f = frame = axes(pen, ink, { min: from, max: end, label: 't' }, axis, { region });
    const zero = f.y(0);
    if (!axis.log) pen.line([f.left, zero, f.left + f.width, zero], { colour: ink.axis, width: 1 });
    pen.clip(f.left, f.top - 2, f.width + 2, f.height + 4, () => {
      tracks.forEach((track, k) => drawTrack(pen, f, track.times, drifts[k]!, scene!.looks[k]!, k, tracks.length));
    });
  }
  const values = (t: number): number[] => scene?.solution.tracks.map((track, k) => valueAt(track.times, drift(k), t)) ?? [];
  function overlay(pen: Pen, ink: Ink): void {
    if (!scene || !frame) return;
    const t = line.shown(), f = frame, all = values(t);
    line.draw(pen, ink, f);
    pen.clip(f.left - 6, f.top - 6, f.width + 12, f.height + 12, () => {
      all.forEach((v, k) => { const look = scene!.looks[k]; if (look) pen.mark(look.marker, f.x(t), f.y(axis.log ? Math.max(Math.abs(v), axis.min) : v), 4, look.colour); });
    });
    drawValues(pen, ink, all.map((v) => readable(v, 3)), layout(pen.width));
    drawHeading(pen, ink, f, heading(t));
  }

  function summary(): string {
    if (!scene) return '';
    const far = signed.map((d, k) => {
      const [a, b] = extent([d]);
      return { name: scene!.looks[k]?.label ?? '', top: d.length ? Math.max(Math.abs(a), Math.abs(b)) : NaN };
    }).sort((a, b) => a.top - b.top);
    const start = relative ? `${chosen} begins at ${brief(first, 6)} and should stay there.` : `${chosen} begins at 0 and should stay there; its change is shown as it is.`;
    const said = far.map((w) => `${w.name} ${w.top < 1e-14 && relative ? `${brief(w.top, 2)} (round-off)` : brief(w.top, 3)}`);
    return [
      start, said.length ? `Furthest ${relative ? 'relative ' : ''}change: ${listed(said, 5)}.` : '',
      leaving.length ? `${begin(listed(leaving.map((k) => scene!.looks[k]?.label ?? '')))} ${leaving.length > 1 ? 'leave' : 'leaves'} the picture.` : '',
      axis.linear ? `The scale is linear within ±${brief(axis.linear, 2)}, logarithmic beyond.` : '',
    ].filter(Boolean).join(' ');
  }
  const table = (): Table => (scene ? timeTable(scene, [axisName()], drift) : { head: [], rows: [] });

  const fig: Figure = figure({
    id: 'drift', title: 'Drift of an invariant', aspect: 0.5, draw, overlay, summary, extra: (w) => layout(w).height, table, controls: [control, scaleControl],
  });
  const line = cursor({
    figure: fig, title: 'Drift of an invariant', frame: () => frame, times: () => scene?.solution.tracks[0]?.times ?? [],
    text: (t) => `${heading(t)}. ${values(t).map((v, k) => `${scene?.looks[k]?.label}: ${readable(v, 3)}`).join(', ')}.`,
  });

  function prepare(next: Scene): void {
    scene = next;
    nameExports(next.state.preset);
    frame = null;
    const names = invariants(next), key = names.join('\n');
    if (!names.includes(chosen)) chosen = names[0] ?? '';
    if (key !== offered) {
      offered = key;
      select.replaceChildren(...names.map((name) => element('option', { value: name }, name)));
    }
    select.value = chosen;
    control.hidden = names.length < 2;
    const declared = next.description.columns.some((c) => c.kind === 'invariant');
    const why = !next.solution.tracks.length ? 'No method is chosen. Choose one, and its drift appears here.'
      : !names.length ? (declared ? 'The invariants of this model were not computed along the run.'
        : 'This model states no invariant.\nA line such as “invariant energy = x\'^2/2 + x^2/2” names something that the motion should keep, and its drift is drawn here.')
      : '';
    if (!why) measure(next);
    fig.say(why);
    fig.redraw();
  }
  return {
    id: 'drift', title: 'Drift of an invariant', element: fig.element, show: prepare,
    at: (t) => line.set(t),
    redraw() { if (scene) scene = recoloured(scene); fig.redraw(); },
  };
};
