/* The column of a method: its picture of the step, the recipe, how far off it ends, and in folds the method's card and every part.
 *
 * Invariant: a column is of one step and of one choice of what is looked at; going through the lines changes what is strong, and moves nothing.
 */
import { button, el, say } from '../../dom';
import { csv, downloadText, fileName, savePicture } from '../../figure/export';
import { ink } from '../../figure/ink';
import { nameText } from '../../figure/name';
import { brief, grouped } from '../../figure/number';
import { svgPen } from '../../figure/pen';
import type { Refusal, Trace, TraceEntry } from '../../protocol';
import type { Look, Scene } from '../../scene';
import { sample } from '../../shell/sample';
import { methodCard } from '../../theory/cards';
import { family } from '../../state';
import { words } from '../../words';
import type { Opened } from './ask';
import { against } from './closing';
import { figure, missed, timeDecimals, timeText } from './figures';
import type { LocalExact } from './local_exact';
import { partsList, partsTable } from './parts';
import { drawStep, type Curve, type StepPicture } from './picture';
import { recipeOf, type Place, type Recipe, type Sum } from './recipe';
import type { Seen } from './seen';
import { typeset } from './typeset';

/** What a column is told with its step: what is looked at, and the units of its lengths and times, with their space. */
export interface Setting { readonly scene: Scene; readonly seen: Seen | null; readonly total: number; readonly x: string; readonly t: string }
export interface Column {
  readonly element: HTMLElement; readonly method: string;
  show(step: Opened, setting: Setting): void;
  /** Strong up to this line; -1: all. */
  walk(line: number): void;
  readonly lines: () => number;
}

const told = words.opened;
/** Pixels beside a sentence and its calculation; of a digit. */
const BESIDE = 46, DIGIT = 8.6;
/** Refused steps of up to so many times the length of the one that was taken are drawn. */
const SHOWN = 3;
const vector = (figures: readonly string[]): string => (figures.length > 1 ? `(${figures.join(', ')})` : figures[0] ?? '');
const apartOf = (a: readonly number[], b: readonly number[]): number[] => a.map((x, k) => x - b[k]!);
const bare = (label: string): string => label.replace(/ \(.*\)$/, '');

/** An angle is no height. */
const GREEK = /^\p{Script=Greek}/u;
/** Where the exact motion is when the step ends, how far off the step is, and what is said of it. */
interface Closing { readonly exact: Place | null; readonly miss: string; readonly says: string }

/** wide: lines that once were too long for one row stay on two, so that other figures never move them. */
export function column(method: string, wide: Set<string>): Column {
  const head = el('h2', {}), picture = el('div', { class: 'opened-picture' }), recipe = el('ol', { class: 'recipe' }), closing = el('p', { class: 'opened-closing' }), tried = el('ul', { class: 'opened-tried' }), why = el('p', { class: 'opened-why', hidden: true });
  const formula = el('details', {}, el('summary', {}, told.formula)), parts = el('details', {}, el('summary', {}, told.parts)), folds = el('div', { class: 'opened-folds' }, formula, parts);
  const element = el('article', { class: 'opened-column', 'data-method': method }, head, picture, why, tried, recipe, closing, folds);
  let step: Opened | null = null, setting: Setting | null = null, made: Recipe | null = null, drawn: StepPicture | null = null, line = -1, width = 0, height = 0;
  const byVelocity = (): boolean => setting?.scene.description.velocity_dependent === true;
  const look = (): Look => setting?.scene.looks.find((l) => l.method === method) ?? { method, label: method, colour: ink().text, tone: ink().text, dash: [], marker: 'circle' };
  const summary = (): string => told.picture(look().label, told.step(grouped((step?.index ?? 0) + 1), grouped(setting?.total ?? 1)), made?.lines.map((l, k) => `${k + 1}. ${l.sentence}`).join(' ') ?? '');

  // --- the folds ---------------------------------------------------------------------------------------------------------------------------
  function fillFormula(): void {
    const card = setting?.scene.catalogue.find((m) => m.name === family(method));
    if (formula.open && card && formula.childElementCount === 1) formula.append(methodCard(card));
  }
  function fillParts(): void {
    while (parts.childElementCount > 1) parts.lastElementChild?.remove();
    if (!parts.open || !step?.trace || !setting?.seen) return;
    const name = told.partsTitle(look().label);
    parts.append(partsList(step.trace, setting.seen, byVelocity()), el('div', { class: 'figure-save', role: 'group', 'aria-label': words.frame.save(name) },
      ...(['PNG', 'SVG', 'CSV'] as const).map((kind) => button(kind, () => save(kind, name), { class: 'figure-button', 'aria-label': words.frame.saveTitleAs(name, kind), title: words.frame.saveAs(kind) }))));
  }
  function save(kind: 'PNG' | 'SVG' | 'CSV', name: string): void {
    if (!step?.trace || !drawn) return;
    const shot = drawn;
    if (kind === 'CSV') downloadText(csv(partsTable(step.trace)), 'text/csv', fileName('step', 'csv'));
    else savePicture(kind, 'step', summary(), { title: name, width, height, draw: (pen, now) => drawStep(pen, now, { ...shot, line: -1 }) });
  }
  formula.addEventListener('toggle', fillFormula);
  parts.addEventListener('toggle', fillParts);

  // --- the step ------------------------------------------------------------------------------------------------------------------------------
  /** A motion of the core's as a curve of what is looked at. */
  function curve(of: LocalExact | null, { order, indices }: Seen): Curve | null {
    const names = order === 2 ? step?.trace?.names.x : step?.trace?.names.v, [a, b] = indices.map((k) => of?.columns.get(names?.[k] ?? ''));
    return !of || !a || (indices.length > 1 && !b) ? null : b ? { x: a, y: b } : { x: of.times, y: a };
  }
  function closingOf(r: Recipe, seen: Seen, forward: Curve | null): Closing {
    const { value, rate } = r.kinds, { indices, order } = seen, unit = setting?.x ?? '', ends = indices.map((k) => (order === 2 ? r.end.x : r.end.v)[k]!), velocity = indices.map((k) => figure(r.end.v[k]!, rate).text);
    const isVelocity = (sum: Sum): boolean => { const [name] = sum, result = sum[sum.length - 1]; return name?.kind === 'name' && name.name === 'v' && name.index === undefined && result?.kind === 'number' && result.figures.every((f, k) => f.text === velocity[k]); };
    const next = order === 2 && !r.last && !r.lines.some((l) => l.sums.some(isVelocity)) ? told.newVelocity(vector(velocity)) : r.last;
    const row = step?.exact?.end ?? -1, exact: Place | null = forward && row >= 0 && row < forward.x.length ? [forward.x[row]!, forward.y[row]!] : null;
    if (!exact) return { exact, miss: '', says: [soFar(), next].filter(Boolean).join(' ') };
    const is = indices.length > 1 ? exact : [exact[1]], apart = apartOf(ends, is), far = Math.hypot(...apart), up = apart[apart.length - 1]!, off = missed(far, value), length = `${off.text}${unit}`;
    // What is left of a difference between numbers of this size is rounding.
    const on = far <= 64 * Number.EPSILON * Math.max(...[...ends, ...is].map(Math.abs)), upright = apart.length === 1 || Math.abs(apart[0]!) <= 1e-6 * Math.abs(up);
    const miss = on ? '' : !upright ? told.off(length) : told.tooFar(length, up > 0, order === 2 && !GREEK.test(nameText(seen.names[seen.names.length - 1]!)));
    return { exact, miss, says: [against(ends, is, value, bare(look().label), { ...off, text: miss }, r.before ? 'two' : step?.index === 0 ? 'start' : 'here', setting?.scene.description.has_exact === true), next].filter(Boolean).join(' ') };
  }
  /** The error of the whole run up to here, where the step's own is not known. */
  function soFar(): string {
    const { tracks, errors } = setting!.scene.solution, at = tracks.find((t) => t.method === method), far = at?.every === 1 ? errors.find((e) => e.method === method)?.x[(step?.index ?? 0) + 1] : undefined;
    return far !== undefined && Number.isFinite(far) ? told.soFar(`${brief(far, 2)}${setting?.x ?? ''}`) : '';
  }
  function pictureOf(r: Recipe, seen: Seen): { readonly shown: StepPicture; readonly says: string } {
    const { start, end, before, stops } = r, h = start.step, decimals = timeDecimals(h), t = (at: number): string => `${timeText(at, decimals)}${setting?.t ?? ''}`;
    const forward = curve(step?.exact ?? null, seen), backward = curve(step?.earlier ?? null, seen), { exact, miss, says } = closingOf(r, seen, forward);
    const joined = (a: ArrayLike<number>, b: ArrayLike<number>): number[] => [...Array.from(a).reverse(), ...Array.from(b).slice(1)];
    const way = (what: string, at: number): StepPicture['times'][number] => ({ at, says: what ? [told.at(what, t(at)), t(at)] : [t(at)] });
    const half = start.time + h / 2, isHalf = (time: number): boolean => Math.abs(time - half) < 1e-9 * Math.abs(h), names = before ? [told.now, told.later] as const : [told.start, told.end] as const;
    const between = stops.filter((time) => isHalf(time) || (stops.length <= 3 && (time - start.time) / h > 0 && (time - start.time) / h < 1)).map((time) => way(isHalf(time) ? told.half : '', time));
    const times = [way(names[0], start.time), way(names[1], end.time), ...(before ? [way(told.earlier, before[0])] : []), ...between];
    return {
      says, shown: {
        recipe: r, seen, look: look(), exact, miss, line, times, refused: refusedOf(r, seen), refusedWord: told.refusedWord, ends: [told.at(names[0], t(start.time)), told.at(names[1], t(end.time))],
        green: forward && backward ? { x: joined(backward.x, forward.x), y: joined(backward.y, forward.y) } : forward,
      },
    };
  }
  /** Where the refused steps would have led; those that are much longer would shrink this one to a point. */
  function refusedOf({ start }: Recipe, { order, indices }: Seen): Place[] {
    return (step?.trace?.refused ?? []).filter((e) => Math.abs(e.step) <= SHOWN * Math.abs(start.step)).map((e) => {
      const values = indices.map((k) => (order === 2 ? e.x : e.v)[k] ?? NaN);
      return values.length > 1 ? [values[0]!, values[1]!] : [e.time, values[0]!];
    });
  }
  /** What was tried, and the error that refused it; last the step that was taken. */
  function triedOf(trace: Trace): string[] {
    const end = trace.entries[trace.entries.length - 1], size = (e: TraceEntry | Refusal): string => `${brief(Math.abs(e.step), 3)}${setting?.t ?? ''}`;
    if (end?.error === null || end?.error === undefined) return [];
    return [...trace.refused.map((e) => told.refused(size(e), e.error === null ? '' : brief(e.error, 2))), told.accepted(size(end), brief(end.error, 2))];
  }
  function prepare(): void {
    const seen = setting?.seen, trace = step?.trace;
    made = seen && trace ? recipeOf(trace, seen, byVelocity()) : null;
    drawn = null;
    element.dataset.step = String((step?.index ?? 0) + 1);
    why.hidden = made !== null;
    say(why, made ? '' : step?.why || told.over);
    for (const part of [picture, tried, recipe, closing, folds]) part.hidden = made === null;
    tried.replaceChildren(...(trace ? triedOf(trace) : []).map((text) => el('li', {}, text)));
    tried.hidden ||= tried.childElementCount === 0;
    head.replaceChildren(sample(look()), el('span', {}, look().label));
    if (!made || !seen) return;
    const { shown, says } = pictureOf(made, seen);
    drawn = shown;
    // A unit stays with its number.
    say(closing, says.replace(/\u2009/g, '\u2060\u2009\u2060'));
    recipe.replaceChildren(...made.lines.map(({ sentence, sums }, k) => el('li', {}, el('span', { class: 'disc' }, String(k + 1)), el('span', { class: 'sentence' }, sentence), el('span', { class: 'sums' }, ...sums.map(typeset)))));
    stack(made, `${method} ${seen.id}`);
    fillFormula();
    fillParts();
    walk(line);
  }
  /** A calculation that has no room beside its sentence, in any step, stands below it. */
  function stack({ lines }: Recipe, key: string): void {
    const room = recipe.clientWidth - BESIDE, pen = document.createElement('canvas').getContext('2d'), { fontSize, fontFamily } = getComputedStyle(recipe);
    if (room <= 0 || !pen) return;
    pen.font = `${fontSize} ${fontFamily}`;
    const items = [...recipe.children] as HTMLElement[], long = items.map((item, k) => {
      const { sentence, sums } = lines[k]!, name = `${key} ${k} ${sentence} ${room}`;
      const wider = sums.flat().reduce((n, token) => n + (token.kind === 'number' && token.most ? Math.max(0, token.most - token.figures.reduce((m, f) => m + f.text.length, token.bracket ? 2 : 0)) : 0), 0);
      if (sums.length > 1 || pen.measureText(sentence).width + (item.lastElementChild?.scrollWidth ?? 0) + DIGIT * wider > room) wide.add(name);
      return wide.has(name);
    });
    items.forEach((item, k) => item.classList.toggle('stacked', long[k]));
  }
  function walk(to: number): void {
    line = to;
    const at = to < 0 ? -1 : Math.min(to, (made?.lines.length ?? 1) - 1);
    recipe.classList.toggle('walked', at >= 0);
    recipe.querySelectorAll(':scope > li').forEach((item, k) => {
      if (k === at) item.setAttribute('aria-current', 'step'); else item.removeAttribute('aria-current');
    });
    if (!drawn || !width || !height) return;
    const pen = svgPen(width, height, 1);
    drawStep(pen, ink(), { ...drawn, line: at });
    const image = document.importNode(new DOMParser().parseFromString(pen.svg(), 'image/svg+xml').documentElement, true);
    image.setAttribute('aria-label', summary());
    picture.replaceChildren(image);
  }
  new ResizeObserver(() => {
    const { clientWidth: w, clientHeight: h } = picture;
    if (!w || !h || (w === width && h === height)) return;
    const other = w !== width;
    [width, height] = [w, h];
    if (other) prepare(); else walk(line);
  }).observe(picture);
  return { element, method, lines: () => made?.lines.length ?? 0, walk, show(next, of) { step = next; setting = of; prepare(); } };
}
