/* The section of a motion: a point of a plane whenever an event happens, for one motion after the other; a click in the plane starts the next one.
 *
 * Invariant: every point is a state that the core computed and that the event left, so a motion that starts in a point goes through the following ones. A start lies
 * on the section, where that is given by an equation, and has the energy of the motion before. Points come piece by piece; what has been computed of a motion is
 * kept while it is shown.
 */
import type { Panel, Scene, Section, Store } from '../scene';
import { Refused } from '../scene';
import { eventful, type Problem } from '../protocol';
import { axes, extent, padded } from '../figure/axes';
import { button, el as element, say as write } from '../dom';
import { nameExports } from '../figure/export';
import { figure } from '../figure/figure';
import { recoloured } from '../figure/ink';
import { nameSpans, nameText } from '../figure/name';
import { brief, grouped } from '../figure/number';
import type { Figure, Frame, Ink, Pen, Said, Span, Table } from '../figure/types';
import { words } from '../words';
import { columnOf, invariants, movable, positions, velocityOf } from './columns';
import { kindOf } from './events';
import { moment, nameAt, unitOf } from './told';

const say = words.section;
/** Points of a motion; milliseconds of one question, and of a motion in all; of rest before the first; columns that come with a point; motions that are kept. */
const POINTS = 2000, SLICE = 60, ENOUGH = 12_000, REST = 120, COLUMNS = 40, KEPT = 80;
const MODULO = ' mod 2 pi', TURN = 2 * Math.PI, NAME = 'section', DOT = 1.7, ARROWS = 40;

interface Flow {
  /** The state that it begins in: positions, then velocities and first-order variables. */
  readonly from: readonly number[];
  readonly columns: number[][];
  time: number; done: boolean; spent: number; problem: Problem | null;
}

/** A name alone. */
const isName = (when: string): boolean => /^[\p{L}_][\p{L}\p{N}_]*$/u.test(when);
/** A kind of the model's own events, which its text names or which has happened; else it is a condition, of which the core says what is wrong. */
const isKind = ({ state, solution }: Scene, when: string): boolean =>
  isName(when) && (new RegExp(`^\\s*when\\b[^#]*\\sas\\s+${when}\\s*:`, 'mu').test(state.text) || solution.tracks.some(({ events }) => events?.names.some((name) => kindOf(name) === when)));
const plainName = (name: string): string => (name.endsWith(MODULO) ? name.slice(0, -MODULO.length) : name);
const spansOf = (name: string, size: number): Span[] => [...nameSpans(plainName(name), size), ...(name.endsWith(MODULO) ? [{ text: ' mod 2π' }] : [])];
const wrapped = (name: string, value: number): number => (name.endsWith(MODULO) ? value - TURN * Math.floor(value / TURN) : value);

/** What is 0 on the section, as an expression; '': no equation gives it. */
function surfaceOf(of: Scene, when: string): string {
  const { text } = of.state, own = isKind(of, when) ? new RegExp(`^\\s*when\\s+([^:#]*?)\\s+as\\s+${when}\\s*:(?!.*\\bfor\\b)`, 'mu').exec(text)?.[1] ?? '' : when;
  const sides = own.replace(/\s+(rising|falling)\s*$/, '').split(/(?<![=<>!])=(?!=)/);
  return sides.length === 2 && !/\b(and|or|not)\b/.test(own) ? `(${sides[0]!.trim()}) - (${sides[1]!.trim()})` : '';
}

/** Hues far from their neighbours', as many as there are motions. */
const colourOf = (k: number, dark: boolean): string => `hsl(${Math.round(212 + 137.508 * k) % 360} ${dark ? '75% 68%' : '72% 38%'})`;

/** Fewer events show no section by themselves. */
const FEW = 12;
/** The section of a scene: as it is chosen, else that of the model's first kind of events. */
function sectionOf(scene: Scene): Section | null {
  if (scene.state.view.section) return scene.state.view.section;
  const events = scene.solution.tracks[0]?.events, first = events?.names[0];
  return eventful(scene.description) && first !== undefined && events!.count >= FEW && (positions(scene).length > 1 || /^\s*when\s+every\b/m.test(scene.state.text)) ? { when: kindOf(first), starts: [] } : null;
}

export const sectionPanel = (store: Store): Panel => {
  const flows = new Map<string, Flow>();
  let scene: Scene | null = null, section: Section | null = null, shown: string[] = [], pair: [string, string] = ['', ''], frame: Frame | null = null, seen = false, pumping = false, timer = 0, wrong = '', cross: { x: number; y: number } | null = null;
  let bounds: [[number, number], [number, number]] | null = null, boundsFor = '', offered = '';

  const when = element('input', { type: 'text', class: 'section-when', spellcheck: 'false', autocomplete: 'off', autocapitalize: 'off', title: say.whenTitle });
  const across = element('select', {}), up = element('select', {}), clear = button(say.clear, () => change({ starts: [] }), { class: 'figure-button' });
  const note = element('p', { class: 'figure-note section-note', role: 'status' });
  const controls = [element('label', {}, say.when, when), element('label', {}, say.across, across), element('label', {}, say.up, up), clear];
  function change(part: Partial<Section>): void {
    if (!section) return;
    section = { ...section, ...part };
    store.look({ section });
  }
  when.addEventListener('change', () => {
    const wanted = when.value.trim();
    if (wanted) { wrong = ''; change({ when: wanted, starts: section?.when === wanted ? section.starts : [] }); return; }
    refuse(say.empty);
  });
  for (const select of [across, up]) select.addEventListener('change', () => change({ plane: [across.value, up.value] }));

  /** Names of the state's numbers, in the order of the core. */
  const stateNames = (of: Scene): string[] => {
    const kind = (k: string): string[] => of.description.columns.filter((c) => c.kind === k && of.solution.columns.includes(c.name)).map((c) => c.name);
    return [...kind('position'), ...kind('velocity'), ...kind('first-order')];
  };
  const start = (of: Scene): number[] => stateNames(of).map((name) => of.solution.tracks[0]?.columns[of.solution.columns.indexOf(name)]?.[0] ?? NaN);
  /** What replaces numbers of the model, but for where its motion starts. */
  const given = (of: Scene): string[] => Object.entries(of.state.set).filter(([name]) => !name.includes('(0)')).map(([name, value]) => `${name}=${value}`);
  /** What decides whether there is such a section. */
  const asked = (of: Scene | null, now: Section | null): string => JSON.stringify([now?.when, of?.state.text, of && given(of)]);
  const model = (of: Scene, { when }: Section) => ({ text: of.state.text, set: given(of), when: isKind(of, when) ? [] : [[when, 'as', `${NAME}:`, 'record'].join(' ')] });
  const flowOf = (of: Scene, from: readonly number[]): Flow => {
    const { method, step, tolerance } = of.solution.tracks[0]!, key = JSON.stringify([model(of, section!), section!.when, method, tolerance === null ? step : tolerance, from]);
    let flow = flows.get(key);
    if (!flow) {
      if (flows.size >= KEPT) flows.delete([...flows.keys()][0]!);
      flows.set(key, flow = { from, columns: shown.map(() => []), time: NaN, done: false, spent: 0, problem: null });
    }
    return flow;
  };
  /** The scene's own motion last: it has the newest colour. */
  const all = (): Flow[] => (scene && section && !wrong ? [...section.starts.filter((s) => s.length === stateNames(scene!).length), start(scene)].map((from) => flowOf(scene!, from)) : []);
  const column = (flow: Flow, name: string): ArrayLike<number> => flow.columns[shown.indexOf(plainName(name))] ?? [];

  const condition = (): string => section?.when ?? '';
  async function pump(): Promise<void> {
    if (pumping) return;
    pumping = true;
    for (;;) {
      const of = scene, now = section, next = seen && of && now && !wrong ? [...all()].reverse().find((f) => !f.done) : undefined;
      if (!of || !now || !next) break;
      const { method, step, tolerance } = of.solution.tracks[0]!;
      try {
        const { columns, time, done, problem } = await store.client.ask('section', {
          model: model(of, now), method, step: tolerance === null ? step : null, tolerance, from: next.from, kind: isKind(of, now.when) ? now.when : NAME, columns: shown, have: next.columns[0]?.length ?? 0, most: POINTS, milliseconds: SLICE,
        }, { lane: 'study' });
        columns.forEach((values, k) => { for (const value of values) next.columns[k]!.push(value); });
        Object.assign(next, { time, problem, spent: next.spent + SLICE });
        next.done = done || (next.columns[0]?.length ?? 0) >= POINTS || next.spent >= ENOUGH;
        fig.redraw();
      } catch (error) {
        if (!(error instanceof Refused)) break;
        // An answer about a condition that has been replaced meanwhile says nothing of the new one.
        if (scene === of && condition() === now.when) refuse(isName(now.when) ? say.unknown(now.when, error.problem.message) : say.hinted(error.problem.message, error.problem.hint));
      }
    }
    pumping = false;
  }
  function soon(): void {
    window.clearTimeout(timer);
    timer = window.setTimeout(() => { void pump(); }, REST);
  }
  /** Whether a point of the plane is a state, but for what the section and the energy say. */
  const clickable = (): boolean => !!scene && pair.every((name) => stateNames(scene!).includes(plainName(name))) && plainName(pair[0]) !== plainName(pair[1]);
  function tell(text = ''): void {
    write(note, wrong || text || (clickable() ? say.hint : say.fixed));
    note.classList.toggle('message', wrong !== '');
  }

  /** There is no such section. */
  function refuse(why: string): void {
    wrong = why;
    tell();
    fig.redraw();
  }

  /** A motion through a point of the plane. */
  async function begin(x: number, y: number): Promise<void> {
    if (!scene || !section || wrong || !clickable()) return;
    const of = scene, now = section, names = stateNames(of), flowsNow = all(), wide = bounds?.map(([a, b]) => b - a) ?? [1, 1];
    // The nearest point tells what the plane does not.
    let near: number[] = start(of), least = Infinity;
    for (const flow of flowsNow) {
      const px = column(flow, pair[0]), py = column(flow, pair[1]);
      for (let i = 0; i < px.length; i++) {
        const far = Math.hypot((wrapped(pair[0], px[i]!) - x) / wide[0]!, (wrapped(pair[1], py[i]!) - y) / wide[1]!);
        if (far < least) { least = far; near = names.map((name) => column(flow, name)[i] ?? NaN); }
      }
    }
    if (!near.every(Number.isFinite)) near = start(of);
    const keep = invariants(of).map((name) => ({ name, value: of.solution.tracks[0]!.columns[of.solution.columns.indexOf(name)]![0]! }));
    const plain: readonly [string, string] = [plainName(pair[0]), plainName(pair[1])];
    try {
      const state = await store.client.ask('through', { model: { text: of.state.text, set: given(of) }, near: near.map((v, k) => { const i = plain.indexOf(names[k]!); return i < 0 ? v : wrapped(pair[i]!, v); }), columns: plain, values: [x, y], surface: surfaceOf(of, now.when), keep }, { lane: 'study' });
      if (scene !== of && scene?.state.text !== of.state.text) return;
      tell();
      // Where the click was to the last digit of it, not of the search.
      take(of, state.map((v, k) => { const i = plain.indexOf(names[k]!); return i < 0 ? v : [x, y][i]!; }));
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      tell(error.problem.message);
    }
  }
  /** The motion of the page starts there, and the one before stays in the section; where initial values cannot be set, the section alone has it. */
  function take(of: Scene, state: readonly number[]): void {
    const names = stateNames(of), set: Record<string, string> = { ...store.state.set };
    let settable = true;
    of.description.variables.forEach(({ name, order }, k) => {
      for (const [prime, kind] of order === 2 ? [['', 'position'], ["'", 'velocity']] as const : [['', 'first-order']] as const) {
        const called = `${name}${prime}(0)`, parameter = of.description.parameters.find((p) => p.initial && p.name === called), own = of.description.columns.filter((c) => c.kind === kind && c.variable === k).map((c) => state[names.indexOf(c.name)]!);
        if (!parameter || parameter.values.length !== own.length || own.some((v) => v === undefined) || (parameter.list && parameter.components > 0)) { settable = false; continue; }
        set[called] = parameter.list ? `[${own.join(', ')}]` : own.length > 1 || parameter.components > 0 ? `(${own.join(', ')})` : String(own[0]);
      }
    });
    const starts = [...(section?.starts ?? []), settable ? start(of) : [...state]];
    section = { ...section!, starts };
    if (settable) store.change({ set, view: { ...store.state.view, section } }); else store.look({ section });
  }

  function frameOf(list: readonly Flow[]): [[number, number], [number, number]] {
    const key = JSON.stringify([scene?.state.text, section?.when, pair]), of = (name: string): [number, number] => (name.endsWith(MODULO) ? [0, TURN] : extent(list.map((flow) => column(flow, name))));
    const range = pair.map(of) as [[number, number], [number, number]];
    const inside = bounds && boundsFor === key && range.every(([a, b], k) => a >= bounds![k]![0] && b <= bounds![k]![1]);
    // It moves in leaps, not with every point.
    if (!inside) { bounds = range.map((r, k) => (pair[k]!.endsWith(MODULO) ? r : padded(r, 0.15))) as [[number, number], [number, number]]; boundsFor = key; }
    return bounds!;
  }
  function draw(pen: Pen, ink: Ink): void {
    if (!scene || !section) return;
    const list = all(), [x, y] = frameOf(list), dark = parseInt(ink.surface.slice(1, 3), 16) < 128;
    const f = frame = axes(pen, ink, { min: x[0], max: x[1], label: spansOf(pair[0], 13), unit: unitOf(scene, pair[0]) }, { min: y[0], max: y[1], label: spansOf(pair[1], 13), unit: unitOf(scene, pair[1]) });
    pen.clip(f.left, f.top, f.width, f.height, () => {
      list.forEach((flow, k) => {
        const px = column(flow, pair[0]), py = column(flow, pair[1]), colour = colourOf(k, dark), size = k === list.length - 1 ? 1.15 * DOT : DOT;
        for (let i = 0; i < px.length; i++) pen.box(f.x(wrapped(pair[0], px[i]!)) - size / 2, f.y(wrapped(pair[1], py[i]!)) - size / 2, size, size, colour);
      });
      // Where the present motion started, if that is a point of the plane.
      const own = list[list.length - 1], begun = pair.map((name) => wrapped(name, own?.from[stateNames(scene!).indexOf(plainName(name))] ?? NaN));
      pen.mark('ring', f.x(begun[0]!), f.y(begun[1]!), 5, colourOf(list.length - 1, dark));
    });
  }
  function overlay(pen: Pen, ink: Ink): void {
    const f = frame;
    if (!f || !cross || !clickable()) return;
    const { x, y } = cross;
    if (x < f.left || x > f.left + f.width || y < f.top || y > f.top + f.height) return;
    pen.line([x, f.top, x, f.top + f.height], { colour: ink.axis, width: 1, dash: [2, 3] });
    pen.line([f.left, y, f.left + f.width, y], { colour: ink.axis, width: 1, dash: [2, 3] });
    const left = x > f.left + f.width / 2;
    pen.text(x + (left ? -8 : 8), y - 8, placed(f, x, y), { colour: ink.text, size: 12, anchor: left ? 'end' : 'start', halo: ink.surface });
  }
  const placed = (f: Frame, x: number, y: number): string => say.at(brief(f.x.invert(x), 3), brief(f.y.invert(y), 3));

  const count = (flow: Flow | undefined): string => { const n = flow?.columns[0]?.length ?? 0; return say.points(grouped(n), n === 1); };
  function answer(): Said {
    const list = all(), own = list[list.length - 1];
    if (!scene || !own || wrong) return '';
    const by = nameAt(scene, 0), time = moment(scene, Number(own.time.toPrecision(4)));
    if (Number.isNaN(own.time)) return '';
    if (!own.columns[0]?.length) return !own.done ? '' : own.problem ? say.failed(by, condition(), own.problem.message) : say.never(by, condition(), time);
    const others = list.length - 1;
    return `${say.answer(by, condition(), count(own), time, others === 0 ? '' : others === 1 ? say.motion : say.motions(grouped(others)))}${own.problem ? ` ${say.stopped(own.problem.message)}` : ''}`;
  }
  const summary = (): string => (scene && section ? say.summary(nameText(plainName(pair[1])), nameText(plainName(pair[0])), condition(), count(all().at(-1))) : '');
  function table(): Table {
    return { head: [say.motionOf, ...shown], rows: all().flatMap((flow, k) => Array.from({ length: flow.columns[0]?.length ?? 0 }, (_, i) => [k + 1, ...flow.columns.map((c) => c[i]!)])) };
  }

  const fig: Figure = figure({ id: 'section', title: say.title, question: say.question, answer, aspect: 0.8, draw, overlay, summary, table, controls });
  fig.picture.after(note);
  new IntersectionObserver((entries) => { seen = entries[entries.length - 1]?.isIntersecting ?? false; if (seen) soon(); }).observe(fig.element);

  // --- pointer and keys
  const { canvas, overlay: plane } = fig;
  plane.removeAttribute('aria-hidden');
  plane.setAttribute('role', 'application');
  plane.setAttribute('tabindex', '0');
  plane.setAttribute('aria-label', say.plane);
  const startAt = ({ x, y }: { readonly x: number; readonly y: number }): void => {
    const f = frame;
    if (!f || x < f.left || x > f.left + f.width || y < f.top || y > f.top + f.height) return;
    // No more digits than pixels tell.
    const digits = (scale: { invert(p: number): number }, p: number): number => { const size = Math.abs(scale.invert(p + 0.5) - scale.invert(p - 0.5)), ten = 10 ** Math.max(0, Math.ceil(-Math.log10(size || 1))); return Math.round(scale.invert(p) * ten) / ten; };
    void begin(digits(f.x, x), digits(f.y, y));
  };
  canvas.addEventListener('pointermove', (event) => { if (event.pointerType !== 'touch') { cross = { x: event.offsetX, y: event.offsetY }; fig.redrawOverlay(); } });
  canvas.addEventListener('pointerleave', () => { cross = null; fig.redrawOverlay(); });
  canvas.addEventListener('click', (event) => startAt({ x: event.offsetX, y: event.offsetY }));
  plane.addEventListener('keydown', (event) => {
    const f = frame, ways: Readonly<Record<string, readonly [number, number]>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }, way = ways[event.key];
    if (!f || event.ctrlKey || event.metaKey || event.altKey || !(way || event.key === 'Enter')) return;
    event.preventDefault();
    event.stopPropagation();
    cross ??= { x: f.left + f.width / 2, y: f.top + f.height / 2 };
    if (way) {
      const by = event.shiftKey ? 1 : Math.min(f.width, f.height) / ARROWS;
      cross = { x: Math.min(f.left + f.width, Math.max(f.left, cross.x + by * way[0])), y: Math.min(f.top + f.height, Math.max(f.top, cross.y + by * way[1])) };
      plane.setAttribute('aria-description', placed(f, cross.x, cross.y));
      fig.redrawOverlay();
    } else startAt(cross);
  });
  plane.addEventListener('blur', () => { cross = null; fig.redrawOverlay(); });

  function prepare(next: Scene): void {
    const before = asked(scene, section);
    scene = next;
    section = sectionOf(next);
    if (!section) return;
    nameExports(next.state.preset);
    // What was refused stays refused when the same model only comes with more, such as its errors: a message that goes and comes back could not be read.
    if (before !== asked(next, section)) {
      flows.clear();
      wrong = '';
    }
    const states = stateNames(next), names = movable(next).filter((n) => next.solution.columns.includes(n));
    shown = [...new Set([...states, ...names])].slice(0, Math.max(COLUMNS, states.length));
    const choices = shown.flatMap((name) => [name, ...(columnOf(next, name)?.kind === 'position' || columnOf(next, name)?.kind === 'velocity' ? [name + MODULO] : [])]);
    // Of two bodies' places the one that the section leaves free.
    const free = positions(next).filter((n) => !new RegExp(`^\\s*${n.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}\\s*=`).test(section!.when)), x = free[0] ?? shown[0] ?? '', own: [string, string] = [x, velocityOf(next, x) ?? shown.find((n) => n !== x) ?? x];
    const { plane: wanted } = section;
    pair = wanted && wanted.every((n) => choices.includes(n)) ? [wanted[0], wanted[1]] : own;
    if (choices.join('\n') !== offered) {
      offered = choices.join('\n');
      for (const select of [across, up]) select.replaceChildren(...choices.map((name) => element('option', { value: name }, name.endsWith(MODULO) ? say.modulo(nameText(plainName(name))) : nameText(name))));
    }
    across.value = pair[0];
    up.value = pair[1];
    if (document.activeElement !== when) when.value = section.when;
    clear.hidden = section.starts.length === 0;
    tell();
    fig.redraw();
    soon();
  }
  return {
    id: 'section', title: say.title, element: fig.element,
    there: (next) => next.solution.tracks.length > 0 && (next.solution.tracks[0]?.times.length ?? 0) > 0 && sectionOf(next) !== null && stateNames(next).length > 1,
    show: prepare,
    at() { /* What has been stays. */ },
    redraw() { if (scene) scene = recoloured(scene); fig.redraw(); },
  };
};
