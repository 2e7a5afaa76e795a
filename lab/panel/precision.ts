/* Work and precision: the error against the number of force evaluations, from the same measurements as the convergence; below it the methods side
 * by side at the present step, as a table that can be sorted.
 *
 * Invariant: nothing is measured here; a method's line joins the points that the core has computed.
 */
import { button, el as element } from '../dom';
import { figure } from '../figure/figure';
import { brief, readable, tenTo } from '../figure/number';
import type { Ink, Pen } from '../figure/types';
import type { CompareRow, Comparison, ConvergeRow } from '../protocol';
import type { Look, Panel, PanelMaker, Scene } from '../scene';
import { errorFrame, errorOf, judge, roomFor } from './convergence';
import { convergenceStudy, lookFor, rowsFor, sample, Study, studyBar } from './study';

const whole = (n: number): string => (n < 1e6 ? String(n).replace(/\B(?=(\d{3})+$)/g, '\u202f') : readable(n, 2));

/** Points that can be drawn, cheapest first. */
function pointsOf(row: ConvergeRow): { readonly work: number; readonly error: number }[] {
  return row.points.map((point) => ({ work: point.evaluations, error: errorOf(point) }))
    .filter((point) => point.work > 0 && point.error > 0).sort((a, b) => a.work - b.work);
}

/** Evaluations that a method needs for an error: between the points on either side, along the line drawn; NaN where it has none as small. */
function workFor(row: ConvergeRow, error: number): number {
  const points = pointsOf(row);
  const k = points.findIndex((point) => point.error <= error);
  if (k <= 0) return k === 0 ? points[0]!.work : NaN;
  const a = points[k - 1]!, b = points[k]!;
  const share = Math.log(a.error / error) / Math.log(a.error / b.error);
  return Math.exp(Math.log(a.work) + share * Math.log(b.work / a.work));
}

/** The smallest power of ten that all methods reach; those that are exact here do not count. */
function level(rows: readonly ConvergeRow[]): number {
  const least = rows.filter((row) => !row.exact_here).map((row) => Math.min(...pointsOf(row).map((point) => point.error)));
  return least.length ? Math.ceil(Math.log10(Math.max(...least))) : NaN;
}

interface Column { readonly name: string; readonly about: string; readonly value: (row: CompareRow) => number | string; readonly text?: (row: CompareRow) => string }
const number = (value: number | null): number => value ?? NaN;

/** A note that all methods share is said once. */
const common = (found: Comparison): string => { const note = found.rows[0]?.note ?? ''; return found.rows.every((row) => row.note === note) ? note : ''; };

function columnsOf(found: Comparison, labels: ReadonlyMap<string, string>): Column[] {
  const invariants = found.rows.find((row) => row.invariants.length > 0)?.invariants ?? [];
  return [
    { name: 'method', about: '', value: (row) => labels.get(row.method) ?? row.method },
    { name: 'order', about: 'declared', value: (row) => row.order },
    { name: 'evaluations', about: 'of the force', value: (row) => row.evaluations, text: (row) => whole(row.evaluations) },
    ...(found.rows.some((row) => row.error_max !== null) ? [{ name: 'error', about: 'largest, of the positions', value: (row: CompareRow) => number(row.error_max) }] : []),
    ...(found.rows.some((row) => row.error_max_s !== null) ? [{ name: 'first-order error', about: 'largest, of the first-order variables', value: (row: CompareRow) => number(row.error_max_s) }] : []),
    ...invariants.map((invariant, k): Column => ({
      name: `absolute drift of ${invariant.name}`, about: 'largest, in its own units; ↗ where it grows with the time', value: (row) => number(row.invariants[k]?.max_drift ?? null),
      text: (row) => { const drift = row.invariants[k]; return drift ? `${readable(drift.max_drift, 2)}${drift.trending ? ' ↗' : ''}` : '–'; },
    })),
    { name: 'reversal', about: 'error after going back to the start', value: (row) => number(row.reversal) },
    ...(found.rows.some((row) => row.note) && !common(found) ? [{ name: 'note', about: '', value: (row: CompareRow) => row.note }] : []),
  ];
}

const cell = (column: Column, row: CompareRow): string => {
  const value = column.value(row);
  return column.text ? column.text(row) : typeof value === 'string' ? value : Number.isInteger(value) && Math.abs(value) < 1e4 ? String(value) : readable(value, 2);
};

/** A table with a button in each head; numbers first go up, a second press turns the order round. NaN stays at the end. */
function comparison(): { readonly element: HTMLElement; show(found: Comparison, looks: readonly Look[]): void } {
  let by = -1, down = false, last: { found: Comparison; looks: readonly Look[] } | null = null;
  // The sentence stands above the box that scrolls, not in it.
  const about = element('p', { class: 'figure-caption' });
  const body = element('div', { class: 'compared', tabindex: '0', role: 'region', 'aria-label': 'The methods side by side' });
  const remarks = element('ul', { class: 'remarks' });

  function show(found: Comparison, looks: readonly Look[]): void {
    last = { found, looks };
    const columns = columnsOf(found, new Map(looks.map((look) => [look.method, look.label])));
    if (by >= columns.length) by = -1;
    const chosen = columns[by];
    const rows = [...found.rows];
    if (chosen) {
      rows.sort((a, b) => {
        const x = chosen.value(a), y = chosen.value(b);
        if (typeof x === 'string' || typeof y === 'string') return String(x).localeCompare(String(y)) * (down ? -1 : 1);
        if (Number.isNaN(x) || Number.isNaN(y)) return Number(Number.isNaN(x)) - Number(Number.isNaN(y));
        return (x - y) * (down ? -1 : 1);
      });
    }
    const focused = body.contains(document.activeElement) ? columns.findIndex((_, k) => body.querySelectorAll('thead button')[k] === document.activeElement) : -1;
    const head = columns.map((column, k) => {
      const press = button(k === by ? `${column.name} ${down ? '▾' : '▴'}` : column.name, () => {
        down = by === k ? !down : false;
        by = k;
        if (last) show(last.found, last.looks);
      }, { 'aria-label': `Sort by ${column.name}`, ...(column.about ? { title: column.about } : {}) });
      return element('th', { scope: 'col', ...(k === by ? { 'aria-sort': down ? 'descending' : 'ascending' } : {}) }, press);
    });
    const lines = rows.map((row) => element('tr', {}, ...columns.map((column, k) => {
      if (k > 0) return element('td', column.name === 'note' ? { class: 'why' } : {}, cell(column, row));
      const look = looks.find((l) => l.method === row.method);
      return element('th', { scope: 'row' }, ...(look ? [sample(look)] : []), cell(column, row));
    })));
    const [name = ''] = found.reference.split('; ');
    const judged = name === 'exact' ? 'errors against the exact motion' : `errors against ${name}, itself good to ${brief(found.reference_error, 2)}`;
    const step = found.rows[0]?.step;
    about.textContent = `The methods side by side${step ? ` at the step ${brief(step, 4)}` : ''}: ${judged}.`;
    body.replaceChildren(element('table', { 'aria-label': 'The methods side by side' },
      element('thead', {}, element('tr', {}, ...head)), element('tbody', {}, ...lines)));
    if (focused >= 0) body.querySelectorAll<HTMLButtonElement>('thead button')[focused]?.focus();
    remarks.replaceChildren(...[...found.remarks, ...(common(found) ? [`For every method, ${common(found)}.`] : [])].map((remark) => element('li', {}, remark)));
  }
  return { element: element('div', {}, about, body, remarks), show };
}

export const precision: PanelMaker = (store): Panel => {
  const study = convergenceStudy(store);
  const compared = new Study(store, 'compare', 'Comparing the methods', 'Compared', true);
  let scene: Scene | null = null;
  const rows = (): readonly ConvergeRow[] => rowsFor(study, scene);
  const looks = (): Look[] => (scene ? lookFor(scene, rows().map((row) => row.method)) : []);

  function draw(pen: Pen, ink: Ink): void {
    const found = rows(), names = looks();
    if (!scene || found.length === 0) return;
    const lines = found.map(pointsOf), points = lines.flat();
    const frame = errorFrame(pen, ink, names, points.map((point) => point.work), 'evaluations of the force', points.map((point) => point.error));
    pen.clip(frame.left, frame.top, frame.width, frame.height, () => {
      const at = 10 ** level(found);
      if (found.length > 1 && at > 0) {
        pen.line([frame.left, frame.y(at), frame.left + frame.width, frame.y(at)], { colour: ink.quiet, width: 1, dash: [3, 3] });
      }
      lines.forEach((line, i) => {
        const look = names[i]!, xy = line.flatMap((point) => [frame.x(point.work), frame.y(point.error)]);
        pen.line(xy, { colour: look.colour, width: 1.75, dash: look.dash });
        for (let k = 0; k < xy.length; k += 2) pen.mark(look.marker, xy[k]!, xy[k + 1]!, 3, look.colour);
      });
    });
  }

  function sentence(): string {
    const found = rows(), names = looks();
    if (found.length === 0) return '';
    const power = level(found), exact = names.filter((_, i) => found[i]!.exact_here).map((look) => look.label);
    const parts: string[] = [];
    const needs = found.map((row, i) => ({ label: names[i]!.label, work: row.exact_here ? NaN : workFor(row, 10 ** power) })).filter((need) => need.work > 0).sort((a, b) => a.work - b.work);
    if (needs.length) parts.push(`For an error of ${tenTo(power)} of the size of the motion, ${needs.map((need) => `${need.label} needs ${whole(Number(need.work.toPrecision(2)))}`).join(', ')} evaluations of the force.`);
    if (exact.length) parts.push(`Exact here but for round-off: ${exact.join(', ')}.`);
    return parts.join(' ');
  }

  const side = comparison();
  const shown = figure({
    id: 'precision', title: 'Work and precision', aspect: 0.62, draw,
    extra: (width) => roomFor(width, looks()),
    summary: sentence,
    table: () => ({
      head: ['method', 'evaluations', 'error', 'step'],
      rows: rows().flatMap((row) => row.points.map((point) => [row.method, point.evaluations, point.error ?? NaN, point.step])),
      note: study.answer ? judge(study.answer) : '',
    }),
    controls: [studyBar(study)],
  });
  shown.element.append(studyBar(compared), side.element);

  function update(): void {
    shown.say(study.message());
    shown.redraw();
  }
  function updateTable(): void {
    const found = compared.answer;
    side.element.hidden = !found;
    if (found && scene) side.show(found, lookFor(scene, found.rows.map((row) => row.method)));
  }
  study.listen(update);
  compared.listen(updateTable);

  return {
    id: 'precision', title: 'Work and precision', element: shown.element,
    show(next) { scene = next; study.want(next); compared.want(next); update(); },
    at() { /* nothing here moves with the time */ },
    redraw() { update(); updateTable(); },
  };
};
