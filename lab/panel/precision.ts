/* What does accuracy cost? The error against the number of force evaluations, from the same measurements as the order.
 *
 * Invariant: nothing is measured here; a method's line joins the points that the core has computed, and counts are read off that line (reading.ts).
 */
import type { EndsLayout } from '../figure/ends';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { brief, grouped, readable, shortened, tenTo } from '../figure/number';
import { textWidth } from '../figure/shapes';
import type { Frame, Ink, Pen } from '../figure/types';
import type { ConvergeRow } from '../protocol';
import type { Look, Panel, PanelMaker, Scene } from '../scene';
import { words } from '../words';
import { comparedDetails } from './compared';
import { drawErrors, endLabel, endOfStudy, errorEnds, errorFrame, judge, namesLayout } from './errors';
import { digitsOf, needOf, pointsOf, type Need } from './reading';
import { convergenceStudy, lookFor, measurable, rowsFor, studyBar } from './study';
import { several } from './told';

const say = words.study.precision;
/** So many comparisons in the sentence: the nearest, and the furthest. */
const COMPARED = 3;
/** To so many digits, thousands apart. */
const rounded = (n: number, digits = 2): string => (n < 1e6 ? (n < 10 ? brief(n, digits) : grouped(Number(n.toPrecision(n < 100 ? 2 : digits)))) : shortened(readable(n, digits)));

interface Cost { readonly name: string; readonly need: Need }
interface Costs { readonly digits: number; readonly costs: readonly Cost[]; readonly short: readonly string[]; readonly exact: readonly string[] }
/** What each needs for the same digits, the least first. null: nobody comes to one. */
function costsOf(rows: readonly ConvergeRow[], names: readonly string[]): Costs | null {
  const measured = rows.map((row, i) => ({ row, name: names[i]! })).filter(({ row }) => !row.exact_here && pointsOf(row).length > 0);
  const digits = digitsOf(measured.map(({ row }) => row)), exact = names.filter((_, i) => rows[i]!.exact_here);
  if (digits === null) return null;
  const costs = measured.flatMap(({ row, name }) => { const need = needOf(row, 10 ** -digits); return need ? [{ name, need }] : []; }).sort((a, b) => a.need.work - b.need.work);
  return { digits, costs, short: measured.map((m) => m.name).filter((name) => !costs.some((cost) => cost.name === name)), exact };
}

/** The answer, from the rows and the names of their methods; until: where the motion that was measured ends, ''. '' where no error was measured. */
export function accuracy(rows: readonly ConvergeRow[], names: readonly string[], until = ''): string {
  const found = costsOf(rows, names);
  if (!found) {
    const measured = names.filter((_, i) => !rows[i]!.exact_here && pointsOf(rows[i]!).length > 0);
    return measured.length ? say.none(measured) : '';
  }
  const { digits, costs: [best, ...others], short, exact } = found, rest = [...(short.length ? [say.short(short)] : []), ...(exact.length ? [say.exact(exact)] : [])];
  if (!best) return '';
  const count = rounded(best.need.work);
  if (!others.length) return say.alone(say.digits(digits), best.name, best.need.exact ? count : say.atMost(count), until, rest);
  const groups: { ratio: string; names: string[] }[] = [];
  for (const { name, need } of others) {
    // A bound below a bound bounds nothing.
    if (!best.need.exact && !need.exact) continue;
    const times = need.work / best.need.work, plain = rounded(times), ratio = times < 1.05 ? '' : best.need.exact && need.exact ? plain : best.need.exact ? say.upTo(plain) : say.atLeast(plain);
    const same = groups.find((group) => group.ratio === ratio);
    if (same) same.names.push(name); else groups.push({ ratio, names: [name] });
  }
  if (!groups.length) return say.alone(say.digits(digits), best.name, best.need.exact ? count : say.atMost(count), until, rest);
  return say.answer(say.digits(digits), best.name, (groups.length > COMPARED ? [...groups.slice(0, COMPARED - 1), groups[groups.length - 1]!] : groups).map(({ ratio, names: than }, k) => say.than(ratio, than, k === 0)), until, rest);
}

/** Whether a line of points passes through a box: at a pixel every so often. */
function crosses(xy: readonly number[], left: number, right: number, top: number, foot: number): boolean {
  for (let k = 0; k + 3 < xy.length; k += 2) {
    for (let part = 0; part <= 1; part += 1 / 16) {
      const x = xy[k]! + part * (xy[k + 2]! - xy[k]!), y = xy[k + 1]! + part * (xy[k + 3]! - xy[k + 1]!);
      if (x >= left && x <= right && y >= top && y <= foot) return true;
    }
  }
  return false;
}

export const precision: PanelMaker = (store): Panel => {
  const study = convergenceStudy(store), side = comparedDetails(store);
  let scene: Scene | null = null, nothing = '';
  const rows = (): readonly ConvergeRow[] => rowsFor(study, scene);
  const looks = (): Look[] => (scene ? lookFor(scene, rows().map((row) => row.method)) : []);
  const labels = (width: number): string[] => looks().map((look) => endLabel(width, look, (name) => name));
  const layout = (width: number): EndsLayout => namesLayout(width, labels(width));
  const answer = (): string => accuracy(rows(), looks().map((look) => look.label), study.answer ? shortEnd(endOfStudy(study.answer)) : '');
  const shortEnd = (text: string): string => (text ? brief(Number(text), 3) : '');

  function draw(pen: Pen, ink: Ink): void {
    const found = rows(), names = looks(), lines = found.map(pointsOf), points = lines.flat();
    if (!scene || !points.length) return;
    const ends = labels(pen.width), room = namesLayout(pen.width, ends), work = points.map((point) => point.work), least = Math.min(...work), most = Math.max(...work);
    const ticks = Array.from({ length: 20 }, (_, k) => 10 ** k).filter((v) => v >= least / 1.3 && v <= 1.3 * most);
    const frame = errorFrame(pen, ink, room, points.map((point) => point.error), { from: least / 1.3, to: 1.3 * most, ticks, label: (v) => (v < 1e5 ? grouped(v) : tenTo(Math.round(Math.log10(v)))), name: say.axis });
    const costs = costsOf(found, names.map((look) => look.label)), at = costs ? 10 ** -costs.digits : 0;
    const paths = lines.map((line) => line.flatMap((point) => [frame.x(point.work), frame.y(point.error)]));
    pen.clip(frame.left, frame.top - 4, frame.width + 8, frame.height + 8, () => {
      if (at > 0) pen.line([frame.left, frame.y(at), frame.left + frame.width, frame.y(at)], { colour: ink.text, width: 1, dash: [2, 3] });
      found.forEach((_, i) => drawErrors(pen, names[i]!, paths[i]!, () => true));
    });
    if (at > 0 && costs) level(pen, ink, frame, at, say.digits(costs.digits), paths);
    errorEnds(pen, ink, frame, room, ends, names, paths);
  }

  /** The name of the level, at its line, where the fewest curves pass. */
  function level(pen: Pen, ink: Ink, frame: Frame, at: number, text: string, paths: readonly (readonly number[])[]): void {
    const y = frame.y(at), wide = textWidth(text) + 12, right = frame.left + frame.width;
    const places = ([[frame.left, 1], [right - wide, -1], [frame.left, -1], [right - wide, 1]] as const).map(([x, way]) => {
      const passing = paths.filter((xy) => crosses(xy, x, x + wide, Math.min(y, y + 20 * way), Math.max(y, y + 20 * way))).length;
      return { x, way, passing };
    });
    const best = places.reduce((a, b) => (b.passing < a.passing ? b : a));
    pen.text(best.x + 6, y + 4 * best.way, text, { colour: ink.text, baseline: best.way > 0 ? 'top' : 'bottom', halo: ink.surface });
  }

  const fig = figure({
    id: 'precision', title: say.title, question: say.question, answer, aspect: 0.42, draw,
    extra: (width) => layout(width).above + (width < 480 ? 60 : 0),
    summary: () => {
      const costs = costsOf(rows(), looks().map((look) => look.label));
      const list = costs ? several(costs.costs.map(({ name, need }) => say.count(name, need.exact ? rounded(need.work, 3) : say.atMost(rounded(need.work, 3)))), 30) : '';
      return [costs ? say.counts(say.digits(costs.digits), list) : '', costs ? say.meaning(say.digits(costs.digits), tenTo(-costs.digits)) : '', study.answer ? judge(study.answer) : ''].filter(Boolean).join(' ');
    },
    table: () => {
      const names = looks();
      return { head: say.columns, rows: rows().flatMap((row, i) => row.points.map((point) => [names[i]!.label, point.evaluations, point.error ?? NaN, point.step, point.tolerance ?? NaN])) };
    },
    controls: [studyBar(study)],
  });
  fig.element.append(side.element);

  function update(): void {
    // Where all are exact there is nothing to pay; whether that changes, the order's panel finds out.
    const { answer: found } = study, now = found && !study.stale ? accuracy(found.rows, found.rows.map((row) => row.method)) : null;
    if (now !== null) nothing = now === '' ? study.asked : '';
    fig.say(study.message());
    fig.there(!study.silent && nothing === '');
    side.element.hidden = study.message() !== '';
    fig.redraw();
  }
  study.listen(update);
  fig.say(words.study.going(study.label));

  return {
    id: 'precision', title: say.title, element: fig.element,
    there: (next) => measurable(next) && !study.silentFor(next) && (nothing === '' || nothing !== study.about(next)),
    show(next) { scene = next; study.want(next); side.want(next); update(); },
    at() { /* nothing here moves with the time */ },
    redraw() { if (scene) scene = recoloured(scene); update(); side.redraw(); },
  };
};
