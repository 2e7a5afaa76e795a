/* Every part of a step with all digits: a list to read, in a fold below the recipe. */
import { el } from '../../dom';
import type { Table } from '../../figure/types';
import type { Trace } from '../../protocol';
import { words } from '../../words';
import type { Seen } from './seen';
import { tell } from './told';

export function partsList(trace: Trace, seen: Seen, byVelocity: boolean): HTMLElement {
  const line = (name: string, text: string): HTMLElement | null => (text ? el('span', { class: name }, text) : null);
  return el('ol', { class: 'parts-list' }, ...trace.entries.map((e, k) => {
    const { title, note, formulas } = tell(trace, k, seen.order === 2 ? seen.indices : [], byVelocity);
    // A first-order variable has no velocity of its own, but a rate.
    const state = seen.order === 1 ? seen.indices.map((i) => ({ symbols: '', numbers: `${seen.name} = ${digits(e.v[i])}${e.a ? `,  ${seen.name}' = ${digits(e.a[i])}` : ''}` })) : [];
    return el('li', {}, line('parts-title', title), line('quiet', note), ...[...formulas, ...state].flatMap((f) => [line('quiet', f.symbols), line('parts-numbers', f.numbers)]));
  }));
}
const digits = (value: number | undefined): string => String(value).replace(/-/g, '−');

export function partsTable({ names, entries }: Trace): Table {
  return {
    head: [...words.opened.partsHead, 't', ...names.x, ...names.v, ...names.v.map((n) => (n.includes("'") ? n.replace("'", "''") : `${n}'`))],
    rows: entries.map((e, k) => [k + 1, e.kind, e.time, ...e.x, ...e.v, ...(e.a ?? names.v.map(() => NaN))]),
    note: words.opened.partsNote,
  };
}
