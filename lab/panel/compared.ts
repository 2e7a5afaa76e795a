/* The methods side by side at the present step, as a table that can be sorted; asked for when it is opened.
 *
 * Invariant: nothing is measured here; what is shown is the core's comparison of the scene on show, or of the one before while that is measured anew, and the scene's own numbers of
 * methods that choose their steps.
 */
import { button, el as element } from '../dom';
import { recoloured } from '../figure/ink';
import { nameText } from '../figure/name';
import { brief, grouped, readable } from '../figure/number';
import type { CompareRow, Comparison } from '../protocol';
import type { Look, Scene, Store } from '../scene';
import { words } from '../words';
import { lookFor, sample, Study, studyBar } from './study';

interface Column { readonly name: string; readonly about: string; readonly value: (row: CompareRow) => number | string; readonly text?: (row: CompareRow) => string }
const say = words.study.precision.side;
const number = (value: number | null): number => value ?? NaN;
const whole = (n: number): string => (n < 1e6 ? grouped(n) : readable(n, 2));

/** A note that all methods share is said once. */
const common = (found: Comparison): string => { const note = found.rows[0]?.note ?? ''; return found.rows.every((row) => row.note === note) ? note : ''; };

function columnsOf(found: Comparison, labels: ReadonlyMap<string, string>): Column[] {
  const invariants = found.rows.find((row) => row.invariants.length > 0)?.invariants ?? [];
  return [
    { name: say.columns.method, about: '', value: (row) => labels.get(row.method) ?? row.method },
    { name: say.columns.order, about: say.about.order, value: (row) => row.order },
    { name: say.columns.evaluations, about: say.about.evaluations, value: (row) => row.evaluations, text: (row) => whole(row.evaluations) },
    ...(found.rows.some((row) => row.error_max !== null) ? [{ name: say.columns.error, about: say.about.error, value: (row: CompareRow) => number(row.error_max) }] : []),
    ...(found.rows.some((row) => row.error_max_s !== null) ? [{ name: say.columns.first, about: say.about.first, value: (row: CompareRow) => number(row.error_max_s) }] : []),
    ...invariants.map((invariant, k): Column => ({
      name: say.columns.drift(nameText(invariant.name)), about: say.about.drift, value: (row) => number(row.invariants[k]?.max_drift ?? null),
      text: (row) => { const drift = row.invariants[k]; return drift ? `${readable(drift.max_drift, 2)}${drift.trending ? ' ↗' : ''}` : '–'; },
    })),
    { name: say.columns.reversal, about: say.about.reversal, value: (row) => number(row.reversal) },
    ...(found.rows.some((row) => row.note) && !common(found) ? [{ name: say.columns.note, about: '', value: (row: CompareRow) => row.note }] : []),
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
  const body = element('div', { class: 'compared', tabindex: '0', role: 'region', 'aria-label': say.name });
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
      }, { 'aria-label': say.sort(column.name), ...(column.about ? { title: column.about } : {}) });
      return element('th', { scope: 'col', ...(k === by ? { 'aria-sort': down ? 'descending' : 'ascending' } : {}) }, press);
    });
    const lines = rows.map((row) => element('tr', {}, ...columns.map((column, k) => {
      if (k > 0) return element('td', column.name === say.columns.note ? { class: 'why' } : {}, cell(column, row));
      const look = looks.find((l) => l.method === row.method);
      return element('th', { scope: 'row' }, ...(look ? [sample(look)] : []), cell(column, row));
    })));
    const [name = ''] = found.reference.split('; ');
    const step = found.rows[0]?.step;
    about.textContent = `${step ? say.at(brief(step, 4)) : ''}${name === 'exact' ? say.exact : say.reference(name, brief(found.reference_error, 2))}`;
    body.replaceChildren(element('table', { 'aria-label': say.name },
      element('thead', {}, element('tr', {}, ...head)), element('tbody', {}, ...lines)));
    if (focused >= 0) body.querySelectorAll<HTMLButtonElement>('thead button')[focused]?.focus();
    remarks.replaceChildren(...[...found.remarks, ...(common(found) ? [say.common(common(found))] : [])].map((remark) => element('li', {}, remark)));
  }
  return { element: element('div', {}, about, body, remarks), show };
}

/** Those that choose their steps, from the scene itself: the core compares at steps of one size. */
function choosing({ solution, catalogue }: Scene): CompareRow[] {
  const most = (column: Float64Array | undefined): number | null => (column?.length ? column.reduce((a, b) => Math.max(a, b), 0) : null);
  return solution.tracks.filter((track) => track.tolerance !== null).map((track) => {
    const error = solution.errors.find((e) => e.method === track.method);
    return {
      method: track.method, order: catalogue.find((m) => m.name === track.method)?.order ?? 0, status: '', step: track.step, steps: track.total, evaluations: track.evaluations,
      error_max: most(error?.x), error_max_v: most(error?.v), error_final: error?.x[error.x.length - 1] ?? null, error_max_s: most(error?.s), reversal: null, invariants: [],
      note: track.problem?.message ?? say.chooses(brief(track.tolerance ?? 0, 2)),
    };
  });
}

export interface Compared { readonly element: HTMLElement; want(scene: Scene): void; redraw(): void }
/** The table behind a line that opens it. */
export function comparedDetails(store: Store): Compared {
  const compared = new Study(store, 'compare', words.study.compare, true), side = comparison();
  const details = element('details', { class: 'figure-more' }, element('summary', {}, say.open), studyBar(compared), side.element);
  let scene: Scene | null = null;
  function update(): void {
    const found = compared.answer;
    side.element.hidden = !found;
    if (!found || !scene) return;
    const rows = [...found.rows, ...choosing(scene)];
    side.show({ ...found, rows }, lookFor(scene, rows.map((row) => row.method)));
  }
  details.addEventListener('toggle', () => { if (details.open && scene) compared.want(scene); });
  compared.listen(update);
  return {
    element: details,
    want(next) { scene = next; if (details.open) compared.want(next); },
    redraw() { if (scene) scene = recoloured(scene); update(); },
  };
}
