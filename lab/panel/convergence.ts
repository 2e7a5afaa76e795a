/* Error against step on logarithmic axes: one line per method, its fitted slope with the triangle that shows it, and the certificate.
 *
 * Invariant: slopes are the core's; the line drawn is the one of that slope through the middle of the points that the core has used.
 */
import { axes, extent, padded } from '../figure/axes';
import { el as element } from '../dom';
import { figure } from '../figure/figure';
import { drawLegend, legendLayout, lookEntry } from '../figure/legend';
import { brief } from '../figure/number';
import type { Frame, Ink, Pen } from '../figure/types';
import type { ConvergePoint, ConvergeRow, Convergence } from '../protocol';
import type { Look, Panel, PanelMaker, Scene } from '../scene';
import { convergenceStudy, lookFor, rowsFor, sample, studyBar } from './study';

/** More triangles than this would hide the lines. */
const TRIANGLES = 4;
/** Errors below this are drawn at it: 0 has no logarithm. */
const FLOOR = 1e-17;
/** An error of so many sizes of the motion is an explosion; how large, tells nothing, and would press all else together. */
const CEILING = 30;

export function errorOf(point: ConvergePoint): number {
  return point.error === null || !Number.isFinite(point.error) ? NaN : Math.max(point.error, FLOOR);
}

/** Height for the legend, and for a narrow picture somewhat more: slopes are hard to see in a flat one. */
export function roomFor(width: number, looks: readonly Look[]): number {
  return looks.length ? legendLayout(width, looks.map((look) => look.label)).height + Math.max(0, 0.5 * (480 - width)) : 0;
}

/** The legend, and below it errors against what they cost, both logarithmic. */
export function errorFrame(pen: Pen, ink: Ink, looks: readonly Look[], costs: number[], label: string, errors: number[]): Frame {
  const layout = legendLayout(pen.width, looks.map((look) => look.label));
  drawLegend(pen, ink, looks.map(lookEntry), layout);
  const decades = (values: number[]): { min: number; max: number; log: true } => {
    const [low, high] = padded(extent([values.map((v) => Math.log10(v))]), 0.05);
    return { min: 10 ** low, max: 10 ** high, log: true };
  };
  return axes(pen, ink, { ...decades(costs), label }, { ...decades(errors.map((e) => Math.min(CEILING, e))), label: 'error, in sizes of the motion' },
    { region: { left: 0, top: layout.height, width: pen.width, height: pen.height - layout.height } });
}

interface Fit { readonly slope: number; readonly x: number; readonly y: number; readonly low: number; readonly high: number }
/** Through the middle of the points used, all in decades. */
function fitOf(row: ConvergeRow): Fit | null {
  const used = row.points.filter((point) => point.used && errorOf(point) > 0);
  if (row.observed === null || row.exact_here || used.length < 2) return null;
  const x = used.map((point) => Math.log10(point.step)), y = used.map((point) => Math.log10(errorOf(point)));
  const mean = (values: number[]): number => values.reduce((sum, v) => sum + v, 0) / values.length;
  return { slope: row.observed, x: mean(x), y: mean(y), low: Math.min(...x), high: Math.max(...x) };
}

function drawTriangle(pen: Pen, frame: Frame, fit: Fit, look: Look, share: number, ink: Ink): void {
  const span = fit.high - fit.low;
  const run = Math.min(1, span / 3);
  if (run < 0.15) return;
  const a = fit.low + 0.06 * span + share * (0.88 * span - run), b = a + run;
  const at = (x: number): number => frame.y(10 ** (fit.y + fit.slope * (x - fit.x)));
  const left = frame.x(10 ** a), right = frame.x(10 ** b), low = at(a), high = at(b);
  if (right - left < 14 || low - high < 8) return;
  pen.area([left, low, right, low, right, high], look.colour, 0.12);
  pen.line([left, low, right, low, right, high], { colour: look.colour, width: 1 });
  pen.text((left + right) / 2, low + 3, run === 1 ? '1' : '', { colour: ink.quiet, size: 11, anchor: 'middle', baseline: 'top' });
  pen.box(right + 2, (low + high) / 2 - 8, 30, 16, ink.surface, 0.8);
  pen.text(right + 4, (low + high) / 2, fit.slope.toFixed(2), { colour: look.colour, size: 12, bold: true, baseline: 'middle' });
}

/** What the core has found of a method, in words. */
function verdict(row: ConvergeRow): string {
  if (row.exact_here) return 'exact here: the error is round-off, and a slope has no meaning';
  if (row.observed === null) return row.certificate || 'no slope could be measured';
  const measured = row.standard_error === null ? row.observed.toFixed(2) : `${row.observed.toFixed(2)} ± ${brief(row.standard_error, 1)}`;
  return row.passed ? `order ${row.declared} confirmed, slope ${measured}` : `order ${row.declared} is declared, but the slope is ${measured} here`;
}

/** By what the errors are judged. */
export function judge(found: Convergence): string {
  const [name = '', ...rest] = found.reference.split('; ');
  const also = rest.length ? ` Taken ${rest.join('; ')}.` : '';
  if (name === 'exact') return `Errors are measured against the exact motion.${also}`;
  return `No exact motion is known, so errors are measured against ${name}, itself good to ${brief(found.reference_error, 2)}.${also}`;
}

export const convergence: PanelMaker = (store): Panel => {
  const study = convergenceStudy(store);
  let scene: Scene | null = null;
  const list = element('ul', { class: 'found' });
  const note = element('p', { class: 'figure-caption' });

  const rows = (): readonly ConvergeRow[] => rowsFor(study, scene);
  const looks = (): Look[] => (scene ? lookFor(scene, rows().map((row) => row.method)) : []);

  function draw(pen: Pen, ink: Ink): void {
    const found = rows(), shown = looks();
    if (!scene || found.length === 0) return;
    const points = found.flatMap((row) => row.points);
    const frame = errorFrame(pen, ink, shown, points.map((point) => point.step), 'step h', points.map(errorOf));
    const step = scene.solution.tracks[0]?.step ?? 0;
    pen.clip(frame.left, frame.top, frame.width, frame.height, () => {
      if (step > 0) {
        // Beyond the picture it is only said.
        const x = Math.max(frame.left, Math.min(frame.left + frame.width, frame.x(step)));
        if (x === frame.x(step)) pen.line([x, frame.top, x, frame.top + frame.height], { colour: ink.accent, width: 1, dash: [3, 3] });
        const flip = x > frame.left + frame.width - 70;
        pen.text(x + (flip ? -5 : 5), frame.top + frame.height - 6, `h = ${brief(step, 3)}`, { colour: ink.accent, size: 11, anchor: flip ? 'end' : 'start', baseline: 'bottom' });
      }
      found.forEach((row, i) => {
        const look = shown[i]!, points = [...row.points].sort((a, b) => a.step - b.step);
        const xy = points.flatMap((point) => { const e = errorOf(point); return e > 0 ? [frame.x(point.step), frame.y(e)] : [NaN, NaN]; });
        pen.line(xy, { colour: look.colour, width: 1, alpha: 0.45 });
        points.forEach((point, k) => {
          const px = xy[2 * k]!, py = xy[2 * k + 1]!;
          if (py === py) pen.mark(look.marker, px, py, point.used ? 3.4 : 1.7, look.colour);
        });
        const fit = fitOf(row);
        if (!fit) return;
        const at = (x: number): [number, number] => [frame.x(10 ** x), frame.y(10 ** (fit.y + fit.slope * (x - fit.x)))];
        pen.line([...at(fit.low), ...at(fit.high)], { colour: look.colour, width: 1.75, dash: look.dash });
      });
      const sloped: { fit: Fit; look: Look }[] = [];
      found.forEach((row, i) => {
        const fit = fitOf(row);
        // One for each slope: parallel lines need no second.
        if (fit && sloped.length < TRIANGLES && !sloped.some((other) => Math.abs(other.fit.slope - fit.slope) < 0.1)) sloped.push({ fit, look: shown[i]! });
      });
      sloped.forEach(({ fit, look }, k) => drawTriangle(pen, frame, fit, look, sloped.length > 1 ? k / (sloped.length - 1) : 0.5, ink));
    });
  }

  const shown = figure({
    id: 'convergence', title: 'Convergence', aspect: 0.66, draw,
    extra: (width) => roomFor(width, looks()),
    summary: () => {
      const names = looks(), found = rows();
      if (found.length === 0) return '';
      const sloped = found.flatMap((row, i) => (row.observed === null || row.exact_here ? [] : [`${row.observed.toFixed(2)} by ${names[i]!.label}`]));
      const left = found.some((row) => !row.exact_here && row.points.some((point) => !point.used)) ? ' Small marks are left out of the fit: there round-off rules, or the step is too long.' : '';
      return sloped.length ? `As the step shrinks, the error falls with the slope ${sloped.join(', ')}.${left}` : 'Every method shown is exact here, whatever the step; what remains is round-off, which grows as steps get more.';
    },
    table: () => ({
      head: ['method', 'step', 'error', 'evaluations', 'used in the fit'],
      rows: rows().flatMap((row) => row.points.map((point) => [row.method, point.step, point.error ?? NaN, point.evaluations, point.used ? 'yes' : 'no'])),
      note: study.answer ? judge(study.answer) : '',
    }),
    controls: [studyBar(study)],
  });
  shown.element.append(list, note);

  let listed = '';
  function update(): void {
    shown.say(study.message());
    shown.redraw();
    const names = looks();
    // Once for each answer and theme, not for each frame of a slider being dragged.
    const key = JSON.stringify([study.since, study.phase, names.map((look) => look.colour)]);
    if (key === listed) return;
    listed = key;
    list.replaceChildren(...rows().map((row, i) => {
      const look = names[i]!;
      return element('li', row.passed || row.exact_here ? {} : { class: 'bad' }, sample(look), `${look.label}: ${verdict(row)}`);
    }));
    note.textContent = study.answer ? judge(study.answer) : '';
  }
  study.listen(update);

  return {
    id: 'convergence', title: 'Convergence', element: shown.element,
    show(next) { scene = next; study.want(next); update(); },
    at() { /* nothing here moves with the time */ },
    redraw: update,
  };
};
