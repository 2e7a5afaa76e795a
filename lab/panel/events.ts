/* What happened along the runs, and when: a line of time for each kind of event, and beneath it the table of one method's events.
 *
 * Invariant: the table has the numbers of the runs on show; a time has its error as soon as it is known, and none before. A click on a time sets the page's
 * clock to it.
 */
import type { Panel, Scene, Store } from '../scene';
import { eventful, type Track } from '../protocol';
import { scaleAlong, scaleOf } from '../figure/axes';
import { SEEK, cursor, drawReadout, heading } from '../figure/cursor';
import { button, el as element } from '../dom';
import { nameExports } from '../figure/export';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { nameSpans, nameText, saidNodes } from '../figure/name';
import { grouped, minus, readable } from '../figure/number';
import { endSaid } from '../figure/ended';
import { bold } from '../figure/ends';
import { textWidth } from '../figure/shapes';
import { begin } from '../figure/track';
import type { Figure, Frame, Ink, Pen, Said, Table } from '../figure/types';
import { words } from '../words';
import { bandsOf, inPrint } from './band';
import { movable } from './columns';
import { endTime, listed, moment, nameAt, timeUnit } from './told';

const say = words.events;
type Happened = NonNullable<Track['events']>;

/** Kinds of events that have a line; numbers of a state in a row; rows at the head and the foot of a long table. */
const KINDS = 8, NUMBERS = 6, FIRST = 10, LAST = 3, MORE = 200;
const ROW = 34, HIGH = 9, DIGITS = 6, FOOT = 42;

/** "contact" of "contact[1,2]". */
export const kindOf = (name: string): string => name.replace(/\[.*$/s, '');

/** A time as the table says it: with the digits that tell it from those beside it, six at least, and none that is not known. full: with its error, where that is known. */
export function shortTime(times: ArrayLike<number>, i: number, full: string | undefined): string {
  const time = times[i]!, number = full?.split(' ')[0] ?? '', known = number.replace(/e.*$/, '').replace(/^-?0*\.?0*/, '').replace('.', '').length || 17;
  if (full && !/\d/.test(number)) return full;
  if (String(time).length <= DIGITS + 1) return minus(String(time));
  const gaps = [times[i - 1], times[i + 1]].flatMap((other) => (other === undefined || other === time ? [] : [Math.abs(other - time)]));
  const apart = gaps.length ? Math.ceil(Math.log10(Math.abs(time) / Math.min(...gaps))) + 2 : 0;
  return readable(time, Math.min(known, Math.max(DIGITS, apart), 17));
}

/** The line of time at the foot, its names of kinds at the left. */
function timeline(pen: Pen, ink: Ink, [min, max]: readonly [number, number], top: number, left: number, unit: string): Frame {
  const height = pen.height - top - FOOT, width = Math.max(20, pen.width - left - 14), foot = top + height, x = scaleAlong({ min, max, label: '' }, left, left + width), last = x.ticks[x.ticks.length - 1];
  pen.line([left, foot + 0.5, left + width, foot + 0.5], { colour: ink.axis, width: 1.5 });
  for (const tick of x.ticks) {
    pen.line([Math.round(x(tick)) + 0.5, foot, Math.round(x(tick)) + 0.5, foot + 4], { colour: ink.axis, width: 1 });
    const text = `${x.label(tick)}${tick === last && unit ? `\u2009${unit}` : ''}`;
    pen.text(Math.min(x(tick), pen.width - textWidth(text) / 2 - 1), foot + 7, text, { colour: ink.quiet, anchor: 'middle', baseline: 'top' });
  }
  if (!unit) pen.text(left + width, foot + 24, [{ text: 't', italic: true }], { colour: ink.text, anchor: 'end', baseline: 'top' });
  return { x, y: scaleOf({ min: 0, max: 1, label: '' }, foot, top, 2), left, top, width, height };
}

export const eventsPanel = (store: Store): Panel => {
  const errors = bandsOf(store);
  let scene: Scene | null = null, frame: Frame | null = null, kinds: string[] = [], which = 0, all = false;

  const select = element('select', {}), control = element('label', {}, say.of, select), holder = element('div', { class: 'events-table' });
  select.addEventListener('change', () => { which = Number(select.value); all = false; fill(); fig.redraw(); });
  const tableOf = (k: number): Happened | null => scene?.solution.tracks[k]?.events ?? null;

  /** Above the lines, where a limit has its name. */
  const head = (): number => (scene?.solution.tracks[which]?.ended?.accumulated ? 10 : 4);
  function draw(pen: Pen, ink: Ink): void {
    if (!scene || !kinds.length) return;
    const { tracks } = scene.solution, unit = timeUnit(scene), left = Math.min(0.3 * pen.width, Math.max(...kinds.map((kind) => bold(nameText(kind), 13))) + 12);
    const start = tracks[0]?.times[0] ?? 0, end = endTime(scene), span: [number, number] = start <= end ? [start, end] : [end, start];
    const f = frame = timeline(pen, ink, span, head(), left, unit), high = f.height / kinds.length;
    kinds.forEach((kind, row) => {
      const middle = f.top + (row + 0.5) * high;
      pen.text(f.left - 10, middle, nameSpans(kind, 13), { colour: ink.text, anchor: 'end', baseline: 'middle' });
      pen.line([f.left, middle, f.left + f.width, middle], { colour: ink.grid, width: 1 });
      tracks.forEach((track, k) => {
        const { events } = track, look = scene!.looks[k]!, y = middle + (k - (tracks.length - 1) / 2) * Math.min(9, (high - 6) / Math.max(1, tracks.length));
        if (!events) return;
        let last = NaN;
        events.times.forEach((t, i) => {
          const x = f.x(t);
          if (kindOf(events.names[i]!) !== kind || Math.abs(x - last) < 1) return;
          last = x;
          pen.line([x, y - HIGH / 2, x, y + HIGH / 2], { colour: look.colour, width: 1.75 });
        });
        const limit = track.ended?.accumulated;
        if (limit && track.ended?.accumulates === kind && k === which) {
          const x = f.x(limit.time);
          pen.line([x, 2, x, f.top + f.height], { colour: ink.quiet, width: 1, dash: [3, 3] });
          pen.text(x - 6, 1, say.limit, { colour: ink.quiet, size: 12, anchor: 'end', baseline: 'top' });
        }
      });
    });
  }
  /** The event nearest to a time. */
  function nearest(t: number): number {
    const times = tableOf(which)?.times ?? [];
    let best = -1;
    for (let i = 0; i < times.length; i++) if (best < 0 || Math.abs(times[i]! - t) < Math.abs(times[best]! - t)) best = i;
    return best;
  }
  const nameOf = (events: Happened, i: number): string => `${nameText(events.names[i]!)} ${grouped(events.counts[i]!)}`;
  function overlay(pen: Pen, ink: Ink): void {
    if (!scene || !frame) return;
    line.draw(pen, ink, frame);
    const t = line.hovered(), events = tableOf(which), i = t === null ? -1 : nearest(t);
    if (t !== null && events && i >= 0) drawReadout(pen, ink, frame, t, heading(t, timeUnit(scene)), [{ text: `${nameOf(events, i)}: t = ${readable(events.times[i]!, 6)}`, colour: scene.looks[which]?.tone ?? ink.text }]);
  }

  /** Of one method, kind by kind. */
  function happened(k: number): string[] {
    const events = tableOf(k);
    if (!scene || !events) return [];
    return kinds.flatMap((kind) => {
      const rows = [...events.times.keys()].filter((i) => kindOf(events.names[i]!) === kind), at = (i: number): string => moment(scene!, events.times[rows[i]!]!), name = nameText(kind);
      if (!rows.length) return [];
      return [rows.length === 1 ? say.once(name, at(0)) : rows.length === 2 ? say.twice(name, at(0), at(1)) : say.times(name, grouped(rows.length), at(0), at(rows.length - 1))];
    });
  }
  function answer(): Said {
    const track = scene?.solution.tracks[which];
    if (!scene || !track) return '';
    const told = happened(which), end = endSaid(track, timeUnit(scene));
    return `${told.length || end ? `${say.by(nameAt(scene, which))}${say.list([...told, ...(end ? [end] : [])])}` : say.none}`;
  }
  function summary(): string {
    if (!scene) return '';
    return say.summary(listed(scene.solution.tracks.flatMap((track, k) => { const told = [...happened(k), endSaid(track, timeUnit(scene!))].filter(Boolean); return told.length ? [`${begin(nameAt(scene!, k))}: ${told.join(', ')}`] : []; })));
  }
  /** As the program writes it, of all methods. */
  function table(): Table {
    if (!scene) return { head: [], rows: [] };
    const { columns, tracks } = scene.solution, kept = columns.map((_, c) => c).filter((c) => c > 0 && !columns[c]!.startsWith('exact '));
    const head = ['method', 'event', columns[0]!, 'count', 'touched', ...kept.map((c) => columns[c]!), ...kept.map((c) => `${columns[c]}.after`)];
    const rows = tracks.flatMap(({ method, events }) => (events ? [...events.times.keys()].map((i) => [method, events.names[i]!, events.times[i]!, events.counts[i]!, events.touched[i]!, ...kept.map((c) => events.before[c]![i]!), ...kept.map((c) => events.after[c]![i]!)]) : []));
    return { head, rows };
  }

  /** Beside the picture: the rows of one method. */
  function fill(): void {
    const events = tableOf(which);
    holder.replaceChildren();
    if (!scene || !events?.times.length) return;
    const now = scene, { columns } = now.solution, bars = errors.of(now.solution.tracks[which]!.method), at = movable(now).filter((name) => columns.includes(name)).map((name) => columns.indexOf(name));
    // What the events change comes first, where the digits of the table show it.
    const jumps = (c: number): boolean => events.before[c]!.some((value, i) => Math.abs(value - events.after[c]![i]!) > 10 ** -DIGITS * Math.abs(value)), changed = at.filter(jumps).slice(0, NUMBERS), others = at.filter((c) => !jumps(c)).slice(0, NUMBERS - changed.length);
    const count = events.times.length, any = events.touched.some((t) => t !== 0), time = nameSpans(columns[0]!, 13);
    const column = (said: Said, kind?: string): HTMLElement => element('th', { scope: 'col', class: kind }, ...saidNodes(said)), names = (list: readonly number[], kind?: string): HTMLElement[] => list.map((c) => column(nameSpans(columns[c]!, 13), kind));
    const head = [column(say.head.event), column(time), ...names(changed, 'words'), ...(bars ? [column([...time, { text: say.head.full }])] : []), column(say.head.count), ...(any ? [column(say.head.touched)] : []), ...names(others)];
    const row = (i: number): HTMLElement => {
      const time = events.times[i]!, full = bars?.events[i], text = full ? inPrint(full) : minus(String(time)), name = nameText(events.names[i]!);
      const go = button(shortTime(events.times, i, full), () => holder.dispatchEvent(new CustomEvent<number>(SEEK, { detail: time, bubbles: true })), { class: 'text-button', title: text, 'aria-label': say.seek(name, text) });
      const numbers = (list: readonly number[], kind?: string): HTMLElement[] => list.map((c) => { const before = readable(events.before[c]![i]!, DIGITS), after = readable(events.after[c]![i]!, DIGITS); return element('td', { class: kind }, before === after ? before : say.jumps(before, after)); });
      return element('tr', {}, element('th', { scope: 'row' }, ...saidNodes(nameSpans(events.names[i]!, 13))), element('td', {}, go), ...numbers(changed, 'words'), ...(bars ? [element('td', {}, full ? text : '')] : []), element('td', {}, grouped(events.counts[i]!)), ...(any ? [element('td', {}, events.touched[i] ? say.touched : '')] : []), ...numbers(others));
    };
    const body = element('tbody'), left = count > FIRST + LAST + 1 ? count - FIRST - LAST : 0, upTo = all ? Math.min(count, MORE) : left ? FIRST : count;
    for (let i = 0; i < upTo; i++) body.append(row(i));
    if (left && !all) {
      body.append(element('tr', {}, element('td', { class: 'words', colspan: String(head.length) }, button(say.more(grouped(left)), () => { all = true; fill(); }, { class: 'text-button' }))));
      for (let i = count - LAST; i < count; i++) body.append(row(i));
    }
    const known = bars && !bars.reason && bars.significant < events.count ? say.known(grouped(bars.significant + 1)) : '';
    const notes = [known, events.count > count ? say.first(grouped(count), grouped(events.count)) : '', say.state].filter(Boolean).join(' ');
    holder.append(element('div', { class: 'figure-table', tabindex: '0', role: 'region', 'aria-label': say.table },
      element('table', {}, element('caption', {}, say.table), element('thead', {}, element('tr', {}, ...head)), body)), element('p', { class: 'figure-note' }, notes));
  }

  const fig: Figure = figure({ id: 'events', title: say.title, question: say.question, answer, aspect: 0, least: 1, extra: () => head() + FOOT + Math.max(1, kinds.length) * ROW, draw, overlay, summary, table, controls: [control] });
  fig.picture.after(holder);
  const want = errors.inSight(fig.element, () => scene);
  const line = cursor({ figure: fig, title: say.title, frame: () => frame, times: () => scene?.solution.tracks[which]?.times ?? [], text: (t) => { const events = tableOf(which), i = nearest(t); return events && i >= 0 ? `${heading(t)}. ${nameOf(events, i)}: t = ${readable(events.times[i]!, 6)}.` : heading(t); } });
  errors.listen(() => { if (scene) fill(); });

  return {
    id: 'events', title: say.title, element: fig.element,
    there: (next) => eventful(next.description) && next.solution.tracks.some(({ events }) => (events?.count ?? 0) > 0),
    show(next) {
      scene = next;
      nameExports(next.state.preset);
      const { tracks } = next.solution;
      if (which >= tracks.length) which = 0;
      kinds = [...new Set(tracks.flatMap(({ events }) => events?.names.map(kindOf) ?? []))].slice(0, KINDS);
      select.replaceChildren(...next.looks.map(({ label }, k) => element('option', { value: String(k) }, label)));
      select.value = String(which);
      control.hidden = tracks.length < 2;
      want();
      fill();
      fig.redraw();
    },
    at: (t) => line.set(t),
    redraw() { if (scene) scene = recoloured(scene); fig.redraw(); },
  };
};
