/* What a lesson has measured: a row a step, and how far from the exact motion each method ended.
 *
 * Invariant: all rows are of one motion, to one end; where that changes, the rows of before are gone. Only the steps that the lesson asks for are written
 * down, so that a slider on its way leaves nothing.
 */
import { exampleOf, stagingOf } from '../data';
import { brief } from '../figure/number';
import type { Scene } from '../scene';
import { missText } from '../stage/names';
import { el } from '../dom';
import { words } from '../words';

interface Column { readonly method: string; readonly label: string; readonly tone: string }

export interface Runs { readonly element: HTMLElement; note(scene: Scene, asked: readonly number[]): void; clear(): void }

export function runs(): Runs {
  const caption = el('caption'), head = el('tr'), body = el('tbody'), element = el('table', { class: 'runs', hidden: true }, caption, el('thead', {}, head), body);
  const ends = new Map<number, Map<string, string>>();
  let columns: Column[] = [], of = '';

  function clear(): void { ends.clear(); columns = []; element.hidden = true; }
  function note({ state, solution: { tracks, errors }, looks }: Scene, asked: readonly number[]): void {
    const track = tracks[0], end = track?.times[track.times.length - 1] ?? 0, now = JSON.stringify([state.text, state.set, state.until]);
    if (now !== of) { clear(); of = now; }
    const step = asked.find((h) => Math.abs(h - (track?.step ?? 0)) < 1e-9 * h);
    if (!track || step === undefined) return;
    const { units, frame } = stagingOf(exampleOf(state)), size = frame?.y ? frame.y[1] - frame.y[0] : 1, row = ends.get(step) ?? new Map<string, string>();
    for (const { method, x } of errors) {
      const off = x[x.length - 1], look = looks.find((l) => l.method === method);
      if (off === undefined || !look || tracks.find((t) => t.method === method)?.problem) continue;
      row.set(method, off < 1e-12 * size ? words.lesson.runs.none : missText(off, size));
      if (!columns.some((c) => c.method === method)) columns.push({ method, label: look.label, tone: look.tone });
    }
    if (!row.size) return;
    ends.set(step, row);
    element.hidden = false;
    caption.textContent = words.lesson.runs.caption(`${brief(end)}${units ? `\u2009${units.t}` : ''}`, units?.x ?? '');
    head.replaceChildren(...[el('th', { scope: 'col' }, words.lesson.runs.step), ...columns.map(({ label, tone }) => { const cell = el('th', { scope: 'col' }, label); cell.style.color = tone; return cell; })]);
    body.replaceChildren(...[...ends].sort(([a], [b]) => b - a).map(([h, row]) => el('tr', {}, el('th', { scope: 'row' }, brief(h)), ...columns.map(({ method }) => el('td', {}, row.get(method) ?? '')))));
  }
  return { element, note, clear };
}
