/* What does half the step buy? The error of each method at many steps, and what half the step leaves of it, by the slope that the core has measured.
 *
 * Invariant: shares are 2 to the power of minus the core's slope; steps stand along the axis as under the step slider, halving to the right.
 */
import type { EndsLayout } from '../figure/ends';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { brief } from '../figure/number';
import { textWidth } from '../figure/shapes';
import type { Frame, Ink, Pen } from '../figure/types';
import type { ConvergeRow } from '../protocol';
import type { Look, Panel, PanelMaker, Scene } from '../scene';
import { words } from '../words';
import { drawErrors, endLabel, errorEnds, errorFrame, judge, namesLayout } from './errors';
import { buysOf, errorOf } from './reading';
import { convergenceStudy, lookFor, measurable, rowsFor, studyBar } from './study';
import { amount, timeUnit } from './told';

const say = words.study.convergence;
/** The present step is in the picture if it is no further from the measured ones than this factor. */
const NEAR = 16;
const orderText = (order: number): string => say.share(order);

/** What half the step leaves: "half", "0.35", "1/190". */
function shareText(slope: number, power: number | null): string {
  if (power !== null) return say.share(power);
  const left = 2 ** -slope;
  return left >= 0.1 ? brief(left, 2) : say.part(brief(2 ** slope, 2));
}

/** The answer, from the rows and the names of their methods. */
export function halfStep(rows: readonly ConvergeRow[], names: readonly string[]): string {
  const groups: { key: string; slope: number; share: string; names: string[]; unlike: string; least: boolean }[] = [], exact: string[] = [], rough: string[] = [], missing: string[] = [];
  rows.forEach((row, i) => {
    const name = names[i]!, found = buysOf(row);
    if (found.kind !== 'share') { ({ exact, rough, missing })[found.kind].push(name); return; }
    const least = found.slope < 0.05, share = shareText(found.slope, found.power), unlike = found.passed ? '' : orderText(row.declared), key = `${least ? '' : share} ${unlike}`;
    const group = groups.find((g) => g.key === key);
    if (group) group.names.push(name); else groups.push({ key, slope: found.slope, share, names: [name], unlike, least });
  });
  const rest = [...(rough.length ? [say.rough(rough)] : []), ...(exact.length ? [say.exact(exact)] : []), ...(missing.length ? [say.missing(missing)] : [])];
  if (!groups.length) return !rest.length ? '' : exact.length === rows.length ? say.allExact(exact) : say.noneLike(rest);
  groups.sort((a, b) => a.slope - b.slope);
  return say.answer(groups.map((g, k) => {
    const share = k === 0 && !g.least ? say.of(g.share) : g.share;
    return g.least ? say.nothing(g.names) : g.unlike ? say.unlike(share, g.names, g.unlike) : say.group(share, g.names);
  }), rest);
}

/** What the core has found of a method, in a sentence. */
function verdict(row: ConvergeRow, name: string): string {
  if (row.exact_here) return say.roundOff(name);
  if (row.observed === null) return say.slopeless(name, row.certificate);
  const slope = row.standard_error === null ? row.observed.toFixed(2) : `${row.observed.toFixed(2)} ± ${brief(row.standard_error, 1)}`;
  return row.passed ? say.confirmed(name, String(row.declared), slope) : say.denied(name, String(row.declared), slope);
}

export const convergence: PanelMaker = (store): Panel => {
  const study = convergenceStudy(store);
  let scene: Scene | null = null;

  const rows = (): readonly ConvergeRow[] => rowsFor(study, scene);
  const looks = (): Look[] => (scene ? lookFor(scene, rows().map((row) => row.method)) : []);
  const labels = (width: number): string[] => looks().map((look, i) => endLabel(width, look, (name) => {
    const found = buysOf(rows()[i]!);
    return found.kind === 'share' ? say.label(name, shareText(found.slope, found.power)) : found.kind === 'exact' ? say.exactLabel(name) : name;
  }));
  const layout = (width: number): EndsLayout => namesLayout(width, labels(width));
  const step = (): number => Math.abs(scene?.solution.tracks[0]?.step ?? 0);

  /** The steps of the slider's stops, and further halves and doubles as far as the picture goes; largest first. */
  function stops(most: number, least: number): number[] {
    const own = Math.abs(scene?.description.settings.step ?? 0) || step() || most, first = own * 2 ** Math.floor(Math.log2(most / own) + 1e-9);
    const list: number[] = [];
    for (let h = first; h >= least * (1 - 1e-9); h /= 2) list.push(h);
    return list;
  }

  function draw(pen: Pen, ink: Ink): void {
    const found = rows(), shown = looks(), points = found.flatMap((row) => row.points).filter((point) => errorOf(point) > 0);
    if (!scene || !points.length) return;
    const names = labels(pen.width), room = namesLayout(pen.width, names), steps = points.map((point) => point.step), h = step();
    let most = Math.max(...steps), least = Math.min(...steps);
    if (h > most && h < NEAR * most) most = h;
    if (h > 0 && h < least && h > least / NEAR) least = h;
    const frame = errorFrame(pen, ink, room, points.map(errorOf), { from: 1.25 * most, to: least / 1.25, ticks: stops(1.2 * most, least / 1.2), keep: h, label: (v) => brief(v, 3), name: say.axis });
    const lines = found.map((row) => [...row.points].sort((a, b) => b.step - a.step).flatMap((point) => { const e = errorOf(point); return e > 0 ? [frame.x(point.step), frame.y(e)] : [NaN, NaN]; }));
    pen.clip(frame.left, frame.top - 4, frame.width + 8, frame.height + 8, () => found.forEach((row, i) => {
      const used = [...row.points].sort((a, b) => b.step - a.step).map((point) => point.used || row.exact_here);
      drawErrors(pen, shown[i]!, lines[i]!, (k) => used[k]!);
    }));
    if (h > 0) mark(pen, ink, frame, h);
    errorEnds(pen, ink, frame, room, names, shown, lines);
  }
  /** The present step. */
  function mark(pen: Pen, ink: Ink, frame: Frame, h: number): void {
    const right = frame.left + frame.width, x = frame.x(h), inside = Math.min(right, Math.max(frame.left, x)), text = words.study.here(amount(h, scene ? timeUnit(scene) : '')), foot = frame.top + frame.height;
    if (x === inside) pen.line([x, frame.top - 4, x, foot], { colour: ink.text, width: 1.5 });
    const flip = inside + 8 + textWidth(text) > right;
    pen.text(inside + (flip ? -6 : 6), foot - 5, text, { colour: ink.text, anchor: flip ? 'end' : 'start', baseline: 'bottom', halo: ink.surface });
  }

  const fig = figure({
    id: 'convergence', title: say.title, question: say.question, aspect: 0.42, draw,
    answer: () => halfStep(rows(), looks().map((look) => look.label)),
    extra: (width) => layout(width).above + (width < 480 ? 60 : 0),
    summary: () => {
      const names = looks(), found = rows();
      if (!found.length) return '';
      const left = found.some((row) => !row.exact_here && row.points.some((point) => !point.used));
      return [...found.map((row, i) => verdict(row, names[i]!.label)), found.some((row) => row.observed !== null) ? say.slope : '', left ? say.left : '', study.answer ? judge(study.answer) : ''].filter(Boolean).join(' ');
    },
    table: () => {
      const names = looks();
      return { head: say.columns, rows: rows().flatMap((row, i) => row.points.map((point) => [names[i]!.label, point.step, point.error ?? NaN, point.evaluations, point.used ? say.yes : say.no])) };
    },
    controls: [studyBar(study)],
  });

  function update(): void {
    fig.say(study.message());
    fig.there(!study.silent);
    fig.redraw();
  }
  study.listen(update);

  return {
    id: 'convergence', title: say.title, element: fig.element,
    there: (next) => measurable(next) && !study.silentFor(next),
    show(next) { scene = next; study.want(next); update(); },
    at() { /* nothing here moves with the time */ },
    redraw() { if (scene) scene = recoloured(scene); update(); },
  };
};
