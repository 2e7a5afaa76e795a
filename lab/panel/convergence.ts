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
/** Shown are so many times the model's step, and so much less of it; steps that show a slope; halvings at least. */
const ABOUT = 4, SEEN = 4, OCTAVES = 5;
const orderText = (order: number): string => say.share(order);

/** What half the step leaves: "half", "0.35", "1/190". */
function shareText(slope: number, power: number | null): string {
  if (power !== null) return say.share(power);
  const left = 2 ** -slope;
  return left >= 0.1 ? brief(left, 2) : say.part(brief(Number((2 ** slope).toPrecision(2)), 4));
}

/** What a tenth of the tolerance leaves: "a tenth", "0.17". */
const leftText = (power: number): string => { const left = 10 ** -power; return Math.abs(left - 0.1) < 0.015 ? say.tenth : brief(left, 2); };

/** The answer, from the rows and the names of their methods. */
export function halfStep(rows: readonly ConvergeRow[], names: readonly string[]): string {
  const groups: { key: string; slope: number; share: string; names: string[]; unlike: string; least: boolean }[] = [], exact: string[] = [], rough: string[] = [], missing: string[] = [], chosen: string[] = [];
  rows.forEach((row, i) => {
    const name = names[i]!, found = buysOf(row);
    if (found.kind === 'tolerance') { chosen.push(say.chosen(name, leftText(found.power))); return; }
    if (found.kind !== 'share') { ({ exact, rough, missing })[found.kind].push(name); return; }
    const least = found.slope < 0.05, share = shareText(found.slope, found.power), unlike = found.passed ? '' : orderText(row.declared), key = `${least ? '' : share} ${unlike}`;
    const group = groups.find((g) => g.key === key);
    if (group) group.names.push(name); else groups.push({ key, slope: found.slope, share, names: [name], unlike, least });
  });
  const rest = [...chosen, ...(rough.length ? [say.rough(rough)] : []), ...(exact.length ? [say.exact(exact)] : []), ...(missing.length ? [say.missing(missing)] : [])];
  if (!groups.length && chosen.length) return say.onlyChosen(rest);
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
  if (row.power !== undefined) return row.power === null ? say.unchosen(name) : say.chosenPower(name, row.power.toFixed(2));
  // A slope that had no room to settle above round-off denies no order.
  if (row.observed === null || row.uncertain) return say.slopeless(name, row.certificate);
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
    return found.kind === 'share' ? say.label(name, shareText(found.slope, found.power)) : found.kind === 'tolerance' ? say.chosenLabel(name, leftText(found.power)) : found.kind === 'exact' ? say.exactLabel(name) : name;
  }));
  const layout = (width: number): EndsLayout => namesLayout(width, labels(width));
  const step = (): number => Math.abs(scene?.solution.tracks[0]?.step ?? 0);

  /** The steps of the slider's stops, and further halves and doubles as far as the picture goes; largest first. */
  function stops([most, least]: readonly [number, number]): number[] {
    const own = Math.abs(scene?.description.settings.step ?? 0) || step() || most, first = own * 2 ** Math.floor(Math.log2(most / own) + 1e-9), list: number[] = [];
    for (let h = first; h >= least * (1 - 1e-9); h /= 2) list.push(h);
    return list;
  }
  /** The steps that are shown, the largest first: those about the present one, and as many smaller ones as show each slope. */
  function shownSteps(found: readonly ConvergeRow[]): [number, number] {
    const all = found.flatMap((row) => row.points.map((point) => point.step)), own = Math.abs(scene?.description.settings.step ?? 0) || step(), h = step() || own, largest = Math.max(...all), smallest = Math.min(...all);
    const seen = found.flatMap((row) => row.points.filter((point) => point.used).sort((a, b) => b.step - a.step).slice(SEEN - 1, SEEN).map((point) => point.step));
    const most = Math.min(Math.max(largest, h < NEAR * largest ? h : 0), Math.max(ABOUT * own, h, 2 ** SEEN * Math.max(smallest, ...seen)));
    const least = Math.max(Math.min(smallest, h > smallest / NEAR ? h : Infinity), Math.min(own / ABOUT, h, most / 2 ** OCTAVES, ...seen));
    return [1.2 * most, least / 1.2];
  }

  function draw(pen: Pen, ink: Ink): void {
    const found = rows(), shown = looks();
    if (!scene || !found.some((row) => row.points.some((point) => errorOf(point) > 0))) return;
    const names = labels(pen.width), room = namesLayout(pen.width, names), h = step(), [from, to] = shownSteps(found);
    const within = found.map((row) => row.points.filter((point) => point.step <= from && point.step >= to).sort((a, b) => b.step - a.step));
    const frame = errorFrame(pen, ink, room, within.flat().map(errorOf).filter((e) => e > 0), { from, to, ticks: stops([from, to]), keep: h, label: (v) => brief(v, 3), name: say.axis });
    const lines = within.map((points) => points.flatMap((point) => { const e = errorOf(point); return e > 0 ? [frame.x(point.step), frame.y(e)] : [NaN, NaN]; }));
    pen.clip(frame.left, frame.top - 4, frame.width + 8, frame.height + 8, () => found.forEach((row, i) => {
      drawErrors(pen, shown[i]!, lines[i]!, (k) => within[i]![k]!.used || row.exact_here);
    }));
    if (h > 0) mark(pen, ink, frame, h);
    errorEnds(pen, ink, frame, room, names, shown, lines);
  }
  /** The present step. */
  function mark(pen: Pen, ink: Ink, frame: Frame, h: number): void {
    const right = frame.left + frame.width, x = frame.x(h), inside = Math.min(right, Math.max(frame.left, x)), text = words.study.here(amount(h, scene ? timeUnit(scene) : '')), foot = frame.top + frame.height;
    if (x === inside) pen.line([x, frame.top - 4, x, foot], { colour: ink.text, width: 1.5 });
    const flip = inside + 8 + textWidth(text) > right;
    pen.text(inside + (flip ? -6 : 6), frame.top - 5, text, { colour: ink.text, anchor: flip ? 'end' : 'start', baseline: 'top', halo: ink.surface });
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
      return { head: say.columns, rows: rows().flatMap((row, i) => row.points.map((point) => [names[i]!.label, point.step, point.error ?? NaN, point.evaluations, point.used ? say.yes : say.no, point.tolerance ?? NaN])) };
    },
    controls: [studyBar(study)],
  });

  function update(): void {
    fig.say(study.message());
    fig.there(!study.silent);
    fig.redraw();
  }
  study.listen(update);
  fig.say(words.study.going(study.label));

  return {
    id: 'convergence', title: say.title, element: fig.element,
    there: (next) => measurable(next) && !study.silentFor(next),
    show(next) { scene = next; study.want(next); update(); },
    at() { /* nothing here moves with the time */ },
    redraw() { if (scene) scene = recoloured(scene); update(); },
  };
};
