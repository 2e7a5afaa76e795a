/* The stage: the picture of the motion, as large as the page gives room. The build draws the first one into the page with the same code.
 *
 * Invariant: the frame keeps still while sliders move; it moves once, afterwards, where the exact motion has left it or become small in it. Methods never
 * move it. What keeps still is drawn once a scene, what moves once a frame; nothing is drawn while it cannot be seen.
 */
import { timeName } from '../figure/name';
import { exampleOf, stagingOf } from '../data';
import { firstMoving } from '../distance';
import { button, el, milestone, say } from '../dom';
import { captioned, csv, download, downloadText, fileName, savePicture, sheetOf } from '../figure/export';
import { ink } from '../figure/ink';
import { brief } from '../figure/number';
import { canvasPen } from '../figure/pen';
import type { Ink, Pen, Table } from '../figure/types';
import { bandsOf } from '../panel/band';
import type { Panel, Scene, Store } from '../scene';
import { lecturing } from '../shell/lecture';
import { short as shortNumber } from '../shell/number';
import { words } from '../words';
import { boundsFor, pictureOf, sideOf, type Side } from './picture';
import { extentOf, suits, type Bounds } from './bounds';
import { film } from './film';
import { haste } from './haste';
import { errorsOf, furthestOf, motionOf } from './motion';
import { placeOf, type Place } from './place';
import { HOME, turned } from './plot';
import { subjects, type Subject } from './subject';
import { turnable } from './turnable';
import type { Picture } from './types';

/** Milliseconds: a ghost stays after the last change; the frame takes to move. */
const GHOST = 1200, MOVE = 300;

export interface Stage extends Panel {
  /** Chooses the view: which of the ways to look at the motion. */
  readonly choice: HTMLElement;
  save(kind: 'PNG' | 'SVG' | 'CSV'): void;
  /** Saves the motion from its start to its end as a film of so many seconds; false: cancelled, or there is nothing to see. */
  film(start: number, end: number, seconds: number, progress: (part: number) => void, signal: AbortSignal): Promise<boolean>;
  /** The names of the columns that are drawn, of the first body. */
  readonly shows: () => readonly string[];
  /** Lines up with the text that stands on the stage: its right edge, 0 where it stands above. */
  relayout(): void;
  /** Keeps the run that is seen, as A, beside all that follow; null: no longer. */
  pin(scene: Scene | null): void;
  /** These methods are computed, but not shown: what they do is to be guessed. */
  hide(methods: readonly string[]): void;
  /** A ring on a rail at the end of the exact motion: somebody's guess of where a method's ball will be; open: it can be dragged. */
  guess(guess: Guess | null): void;
  onGuess(listener: (place: GuessPlace) => void): void;
  sees(): Sees;
}
/** What the stage shows: which kind of view, and which other plot beside it. */
export interface Sees { readonly kind: Subject['kind'] | null; readonly side: Side }
export type GuessPlace = 'above' | 'on' | 'below';
export interface Guess { readonly method: string; readonly place: GuessPlace | null; readonly open: boolean }

/** A scene in which some methods are not seen. */
function without(scene: Scene, methods: readonly string[]): Scene {
  const kept = scene.solution.tracks.map((t) => !methods.includes(t.method)), of = <T>(list: readonly T[]): T[] => list.filter((_, k) => kept[k]);
  return { ...scene, looks: of(scene.looks), solution: { ...scene.solution, tracks: of(scene.solution.tracks), errors: of(scene.solution.errors) } };
}

export function stage(store: Store, room: { column(): number }): Stage {
  const bars = bandsOf(store);
  const still = el('canvas', { class: 'stage-still', role: 'img' }), moving = el('canvas', { class: 'stage-moving', 'aria-hidden': 'true' });
  const aim = button('', () => {}, { class: 'stage-aim', role: 'slider', hidden: true });
  const all = button(words.stage.all, () => { showAll = !showAll; bounds = null; refresh(true); }, { class: 'stage-all', hidden: true });
  const message = el('p', { class: 'stage-message', hidden: true });
  const caption = el('figcaption', { class: 'unseen' });
  const holder = document.getElementById('stage-picture') ?? el('div', { id: 'stage-picture' });
  const ring = button('', () => {}, { class: 'stage-aim stage-ring', role: 'slider', hidden: true, 'aria-label': words.stage.guess.ring });
  holder.append(still, moving, aim, ring, all, message);
  // The build's picture is of the first scene; another one is not to begin with it.
  if (store.state.preset !== holder.dataset.scene || store.state.place) holder.querySelectorAll(':scope > svg').forEach((svg) => svg.remove());
  const element = el('figure', { class: 'stage-figure', 'aria-labelledby': 'motion-title' }, el('h2', { id: 'motion-title', class: 'unseen' }, words.stage.motion), holder, caption);

  let scene: Scene | null = null, subject: Subject | null = null, choices: readonly Subject[] = [], chosen = '', showAll = false;
  let picture: Picture | null = null, ghost: Picture | null = null, bounds: Bounds | null = null, place: Place | null = null, frameKey = '';
  let time = 0, asked = 0, colours: Ink | null = null, scale = 1, ghostTimer = 0, moveFrame = 0, sentence = 0, dirty = false, pressed = false, visible = true;
  const camera = { ...HOME };
  let pinned: Scene | null = null, hidden: readonly string[] = [], guess: Guess | null = null, guessAt: number | null = null, guessed: (place: GuessPlace) => void = () => {};
  const calm = matchMedia('(prefers-reduced-motion: reduce)');

  // --- the views ---------------------------------------------------------------------------------------------------------------------
  const select = el('select', { id: 'stage-view', 'aria-label': words.stage.view });
  const choice = el('label', { class: 'view-choice' }, el('span', {}, words.stage.view), select);
  select.addEventListener('change', () => {
    chosen = select.value;
    const kind = choices.find((s) => s.id === chosen)?.kind;
    bounds = null;
    showAll = false;
    // The address remembers the kind of view; which of several planes is a matter of the moment.
    if (kind) store.look({ plane: kind === 'shape' ? 'auto' : kind });
    if (scene) show(scene);
  });
  function pick(): Subject | null {
    const wanted = store.state.view.plane;
    return choices.find((s) => s.id === chosen) ?? choices.find((s) => wanted !== 'auto' && s.kind === wanted) ?? choices[0] ?? null;
  }
  function offer(): void {
    const same = select.options.length === choices.length && choices.every((s, i) => select.options[i]?.value === s.id && select.options[i]?.text === s.label);
    if (!same) select.replaceChildren(...choices.map((s) => new Option(s.label, s.id)));
    if (subject) select.value = subject.id;
    choice.hidden = choices.length < 2;
  }

  // --- drawing -----------------------------------------------------------------------------------------------------------------------
  const enlarged = (): number => Number((holder.getBoundingClientRect().width / (holder.clientWidth || 1)).toFixed(3)) || 1;
  const placeFor = (width: number, height: number): Place => (lecturing() ? placeOf(width, height, 0, { width: width < 560 ? 700 : 1000, height: 1000 }) : placeOf(width, height, room.column(), { width: innerWidth, height: innerHeight, bare: store.state.embed !== undefined }));
  function fit(): boolean {
    const width = holder.clientWidth, height = holder.clientHeight;
    if (!width || !height) return false;
    // In a lecture, and on a very large screen, the style enlarges the stage: its pixels are the layout's, of which it has fewer.
    const s = Math.min(4, Math.max(1, devicePixelRatio || 1) * enlarged());
    const next = placeFor(width, height);
    if (!place || JSON.stringify(next) !== JSON.stringify(place) || s !== scale) { place = next; ghost = null; picture = null; }
    scale = s;
    for (const canvas of [still, moving]) {
      const w = Math.round(width * s), h = Math.round(height * s);
      if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
    }
    return true;
  }
  function onto(canvas: HTMLCanvasElement, draw: (pen: Pen, ink: Ink) => void): void {
    const context = canvas.getContext('2d');
    if (!context || !place || !colours) return;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, place.width, place.height);
    draw(canvasPen(context, place.width, place.height, thin ? 1 / scale : Infinity), colours);
  }
  function make(of: Bounds): void {
    if (!scene || !subject || !place) return;
    const seen = hidden.length ? without(scene, hidden) : scene;
    picture = pictureOf({ scene: seen, subject, staging: staging(), place, bounds: of, camera, before: ghost, pinned, bars });
  }
  const staging = () => stagingOf(scene ? exampleOf(scene.state) : '');
  function draw(): void {
    asked = 0;
    if (!dirty || !visible || !scene || !fit() || !subject) return;
    dirty = false;
    colours = ink();
    bounds ??= boundsFor(scene, subject, staging(), showAll, null);
    if (!picture) make(bounds);
    if (!picture) return;
    finished = picture.over(time);
    thin = hurried.draws(performance.now(), !!ghost);
    onto(still, (pen, i) => picture!.still(pen, i, finished));
    drawMoving();
    // The build's picture has done its work.
    holder.querySelectorAll(':scope > svg').forEach((svg) => svg.remove());
    attach();
    milestone('first-motion');
    if (scene.solution.truth) milestone('exact-motion');
    if (!sentence) sentence = window.setTimeout(describe, 150);
  }
  let busy = false, again = false, finished = false, thin = false;
  const hurried = haste(() => refresh());
  function drawMoving(): void {
    if (picture) onto(moving, (pen, i) => { picture!.moving(pen, i, time); drawGuess(pen, i); });
  }
  /** Pixels of the ring: where it was dragged to, or where the chosen answer lies. */
  const OFF = 0.15;
  function ringAt(): { readonly x: number; readonly y: number; readonly exact: number } | null {
    const end = picture?.end;
    if (!guess || !end || !place || (guess.place === null && guessAt === null && !guess.open)) return null;
    const height = place.frame.bottom - place.frame.top, by = guess.place === 'above' ? -OFF : guess.place === 'below' ? OFF : guess.place === null ? -OFF : 0;
    return { x: end.x, y: Math.min(place.frame.bottom - 4, guessAt ?? end.y + by * height), exact: end.y };
  }
  function drawGuess(pen: Pen, i: Ink): void {
    const at = ringAt(), look = scene?.looks.find((l) => l.method === guess?.method);
    if (!at || !guess || !place) return;
    const colour = guess.open ? look?.tone ?? i.text : i.quiet, r = place.ball + 3;
    if (guess.open) pen.line([at.x, Math.max(20, at.exact - 250), at.x, place.frame.bottom], { colour: i.axis, width: 1.25, dash: [2, 3] });
    pen.mark('circle', at.x, at.y, r, i.surface, { alpha: guess.open ? 1 : 0.6 });
    pen.line(Array.from({ length: 66 }, (_, k) => (k % 2 ? at.y : at.x) + r * (k % 2 ? Math.sin : Math.cos)(Math.PI * (k >> 1) / 16)), { colour, width: guess.open ? 2 : 1.5, dash: [3, 3] });
    if (guess.open) for (const way of [-1, 1]) pen.line([at.x - 4, at.y + way * (r + 5), at.x, at.y + way * (r + 9), at.x + 4, at.y + way * (r + 5)], { colour: i.quiet, width: 1.5 });
    // Numbers stand at the right; on a small stage the guess gives way to them.
    const left = !place.names, size = (left ? 12 : 14) * place.scale;
    pen.text(at.x + (left ? -1 : 1) * (r + 8), at.y, guess.open ? words.stage.guess.open : words.stage.guess.closed, { colour, size, bold: guess.open, baseline: 'middle', anchor: left ? 'end' : 'start', halo: i.surface });
  }
  /** At once where this frame has not had it yet: a moving thing must not lag a frame behind its clock. */
  function redrawMoving(): void {
    if (dirty || !visible) return;
    if (busy) { again = true; return; }
    busy = true;
    drawMoving();
    requestAnimationFrame(() => { busy = false; if (again) { again = false; redrawMoving(); } });
  }
  function refresh(anew = false): void {
    if (anew) picture = null;
    dirty = true;
    element.setAttribute('aria-busy', 'true');
    if (!asked) asked = requestAnimationFrame(draw);
  }
  bars.listen(() => { if (subject?.kind === 'time') refresh(); });
  /** The frame goes to where it belongs, once. */
  function settle(): void {
    if (!scene || !subject || !bounds || showAll || bounds.length !== subject.axes.length) return;
    const { ranges } = extentOf(motionOf(scene, subject), staging().decor === 'throw'), inTime = subject.kind === 'time';
    if (suits(bounds, ranges, inTime, subject.kind === 'plane')) return;
    const from = bounds, to = boundsFor(scene, subject, staging(), false, null), began = performance.now();
    cancelAnimationFrame(moveFrame);
    const step = (now: number): void => {
      const part = calm.matches ? 1 : Math.min(1, Math.max(0, (now - began) / MOVE)), eased = 1 - (1 - part) ** 3;
      bounds = from.map(([a, b], k): readonly [number, number] => [a + eased * (to[k]![0] - a), b + eased * (to[k]![1] - b)]);
      if (part === 1) bounds = to;
      refresh(true);
      if (part < 1) moveFrame = requestAnimationFrame(step);
    };
    ghost = null;
    moveFrame = requestAnimationFrame(step);
  }
  function endGhost(): void {
    if (pressed) { ghostTimer = window.setTimeout(endGhost, 300); return; }
    ghostTimer = 0;
    ghost = null;
    refresh(true);
    settle();
  }
  document.addEventListener('pointerdown', ({ target }) => { pressed = target === aim || (target instanceof HTMLInputElement && target.type === 'range'); }, { capture: true });
  for (const kind of ['pointerup', 'pointercancel']) document.addEventListener(kind, () => { pressed = false; }, { capture: true });

  function show(next: Scene): void {
    const key = `${next.state.preset}`, other = key !== frameKey;
    if (other) { chosen = ''; showAll = false; Object.assign(camera, HOME); bounds = null; ghost = null; cancelAnimationFrame(moveFrame); }
    frameKey = key;
    const before = scene, old = subject;
    scene = next;
    choices = subjects(next.description, next.solution);
    subject = pick();
    document.body.dataset.decor = staging().decor ?? '';
    offer();
    if (subject?.kind === 'time') bars.want(next);
    turning.enable(subject?.kind === 'space');
    if (subject?.id !== old?.id || (bounds && bounds.length !== subject?.axes.length)) { bounds = null; ghost = null; cancelAnimationFrame(moveFrame); }
    // What moved: the curve of before stays for a while. A finer answer to the same question is no change.
    const changed = before && !other && subject && (JSON.stringify(before.state.set) !== JSON.stringify(next.state.set) || before.state.step !== next.state.step);
    if (changed && bounds) {
      if (!ghost) ghost = picture;
      clearTimeout(ghostTimer);
      ghostTimer = window.setTimeout(endGhost, GHOST);
    } else if (bounds && subject && before && !other && !ghost) {
      const until = next.state.until !== before.state.until, { ranges } = extentOf(motionOf(next, subject), staging().decor === 'throw');
      if (until || next.state.text !== before.state.text || !before.solution.truth) {
        if (!suits(bounds, ranges, subject.kind === 'time', subject.kind === 'plane')) bounds = showAll ? null : boundsFor(next, subject, staging(), false, null);
      }
    }
    const told = !subject ? words.stage.noPositions : next.solution.tracks.length === 0 && !next.solution.truth ? words.stage.noMethod : '';
    message.textContent = told;
    message.hidden = !told;
    still.hidden = moving.hidden = !!told;
    refresh(true);
  }

  // --- what one takes hold of ---------------------------------------------------------------------------------------------------------
  const turning = turnable(still, (turn, rise) => {
    if (turn === null) Object.assign(camera, HOME); else turned(camera, turn, rise);
    refresh(true);
  });
  let dragged: { readonly x: number; readonly y: number } | null = null;
  function attach(): void {
    drag();
    const handle = picture?.handle, settable = handle && scene && subject ? velocity() : null;
    aim.hidden = !settable;
    if (handle && settable) {
      aim.style.transform = `translate(${handle.x - 22}px, ${handle.y - 22}px)`;
      aim.setAttribute('aria-label', words.stage.aim);
      aim.setAttribute('aria-valuetext', `${settable.values.map((v) => shortNumber(v, 4)).join(', ')}`);
      aim.setAttribute('aria-valuenow', String(Math.hypot(...settable.values)));
    }
    const at_ = ringAt();
    ring.hidden = !guess?.open || !at_;
    if (at_) ring.style.transform = `translate(${at_.x - 22}px, ${at_.y - 22}px)`;
    if (at_ && place) ring.setAttribute('aria-valuenow', String(Math.round(at_.exact - at_.y)));
    const leaving = picture?.leaving[0];
    all.hidden = !leaving && !showAll;
    say(all, !showAll ? words.stage.all : !scene?.solution.truth ? words.stage.less : scene.description.has_exact ? words.stage.exactOnly : words.stage.computedOnly);
    const at = leaving ?? { x: (place?.width ?? 0) - 160, y: 24, anchor: 'start' as const, more: '' };
    all.style.left = leaving ? `${at.anchor === 'end' ? at.x - 62 : at.x}px` : 'auto';
    all.style.right = leaving ? 'auto' : '24px';
    all.style.top = `${leaving ? at.y + (at.more ? 24 : 8) : 12}px`;
  }
  /** The initial velocity as a parameter that a slider may set: its name and two numbers. */
  function velocity(): { readonly name: string; readonly values: readonly number[] } | null {
    const body = subject?.bodies[0], name = body ? scene?.solution.columns[body.columns[0]!] : undefined, of = name?.replace(/\.\w+$/, '');
    const parameter = scene?.solution.description.parameters.find((p) => p.initial && p.name === `${of}'(0)` && p.values.length === 2);
    return parameter && subject?.bodies.length === 1 ? { name: parameter.name, values: parameter.values } : null;
  }
  const round = (v: number): string => shortNumber(Number(v.toFixed(Math.max(0, 2 - Math.floor(Math.log10(Math.max(Math.abs(v), 1e-3)))))), 4);
  function throwAt(vx: number, vy: number): void {
    const of = velocity();
    if (of && Number.isFinite(vx + vy)) store.change({ set: { ...store.state.set, [of.name]: `(${round(vx)}, ${round(vy)})` } });
  }
  /** Where on the stage, in its own pixels. */
  const pointed = ({ clientX, clientY }: PointerEvent): { readonly x: number; readonly y: number } => {
    const box = holder.getBoundingClientRect(), large = enlarged();
    return { x: (clientX - box.left) / large, y: (clientY - box.top) / large };
  };
  /** To where the pointer is; while no picture stands, as soon as there is one: its last place must not be lost. */
  function drag(): void {
    const handle = picture?.handle;
    if (!dragged || !handle) return;
    const { x, y } = dragged;
    dragged = null;
    throwAt((x - handle.fromX) / handle.unit, -(y - handle.fromY) / handle.unit);
  }
  aim.addEventListener('pointerdown', (event) => {
    if (!event.isPrimary || event.button !== 0) return;
    aim.setPointerCapture(event.pointerId);
    event.preventDefault();
    aim.focus({ preventScroll: true });
  });
  aim.addEventListener('pointermove', (event) => {
    if (!aim.hasPointerCapture(event.pointerId)) return;
    dragged = pointed(event);
    drag();
  });
  aim.addEventListener('keydown', (event) => {
    const of = velocity(), by = event.shiftKey ? 0.01 : 0.05;
    if (!of || event.ctrlKey || event.altKey || event.metaKey) return;
    const [vx, vy] = of.values as [number, number], step = by * Math.hypot(vx, vy);
    switch (event.key) {
      case 'ArrowLeft': throwAt(vx - step, vy); break;
      case 'ArrowRight': throwAt(vx + step, vy); break;
      case 'ArrowUp': throwAt(vx, vy + step); break;
      case 'ArrowDown': throwAt(vx, vy - step); break;
      default: return;
    }
    event.preventDefault();
  });

  const putRing = (y: number): void => {
    const end = picture?.end;
    if (!end || !place || !guess?.open) return;
    guessAt = Math.min(place.frame.bottom - 4, Math.max(20, y));
    const off = guessAt - end.y, where: GuessPlace = Math.abs(off) <= 9 ? 'on' : off < 0 ? 'above' : 'below';
    guess = { ...guess, place: where };
    ring.setAttribute('aria-valuetext', words.stage.guess[where]);
    guessed(where);
    redrawMoving();
    attach();
  };
  ring.addEventListener('pointerdown', (event) => { if (event.isPrimary && event.button === 0) { ring.setPointerCapture(event.pointerId); event.preventDefault(); ring.focus({ preventScroll: true }); } });
  ring.addEventListener('pointermove', (event) => { if (ring.hasPointerCapture(event.pointerId)) putRing(pointed(event).y); });
  ring.addEventListener('keydown', (event) => {
    const at = ringAt();
    if (!at || (event.key !== 'ArrowUp' && event.key !== 'ArrowDown')) return;
    event.preventDefault();
    putRing(at.y + (event.key === 'ArrowUp' ? -8 : 8));
  });

  // --- words, numbers, files -----------------------------------------------------------------------------------------------------------
  function describe(): void {
    sentence = 0;
    const told = summary();
    say(caption, told);
    still.setAttribute('aria-label', told);
    element.setAttribute('aria-busy', String(dirty));
  }
  function summary(): string {
    if (!scene || !subject || !picture) return words.stage.summary.nothing;
    const { solution, looks } = scene, times = solution.truth?.times ?? solution.tracks[0]?.times ?? new Float64Array([0]);
    const [across = '', up = ''] = subject.axes, from = brief(times[0] ?? 0), to = brief(times[times.length - 1] ?? 0);
    const seen = subject.kind === 'shape' ? words.stage.summary.shape(subject.bodies[0]?.label ?? '', from, to) : subject.kind === 'time' ? words.stage.summary.time(up, from, to)
      : subject.kind === 'space' ? words.stage.summary.space(from, to) : words.stage.summary.plane(across, up, from, to);
    // One that stopped has no place at the end; the remarks tell when it stopped.
    const errors = solution.errors.filter((e) => !solution.tracks.find((t) => t.method === e.method)?.problem).map((e) => ({ name: looks.find((l) => l.method === e.method)?.label ?? e.method, last: errorsOf(e).at(-1) ?? NaN, body: furthestOf(e, e.x.length - 1, staging().bodies) })).filter((e) => Number.isFinite(e.last));
    const distances = errors.map((e) => words.stage.summary.distance(brief(e.last, 3), e.name, e.body));
    const told = distances.length === 0 ? [] : [scene.description.has_exact ? words.stage.summary.exact(distances) : words.stage.summary.reference(distances)];
    return words.stage.summary.whole([seen, ...told, ...picture.remarks()]);
  }
  function table(): Table {
    if (!scene || !subject) return { head: [], rows: [] };
    const { solution, looks } = scene, columns = subject.bodies.flatMap((b) => b.columns), head = [words.stage.table.motion, timeName(solution), ...columns.map((c) => solution.columns[c] ?? '')];
    const rows: (string | number)[][] = [];
    const add = (name: string, of: { readonly times: Float64Array; readonly columns: readonly Float64Array[] }): void => of.times.forEach((t, i) => rows.push([name, t, ...columns.map((c) => of.columns[c]?.[i] ?? NaN)]));
    solution.tracks.forEach((track, k) => add(looks[k]?.label ?? track.method, track));
    if (solution.truth && !solution.truth.coarse && columns.every((c) => (solution.truth?.columns[c]?.length ?? 0) > 0)) add(scene.description.has_exact ? words.stage.table.exact : words.stage.table.reference, solution.truth);
    return { head, rows };
  }
  function save(kind: 'PNG' | 'SVG' | 'CSV'): void {
    if (kind === 'CSV') { downloadText(csv(table()), 'text/csv', fileName('motion', 'csv')); return; }
    if (!picture || !place) return;
    const { width, height } = place, of = picture;
    savePicture(kind, 'motion', summary(), { title: words.stage.motion, width, height, draw(pen, now) { of.still(pen, now); of.moving(pen, now, time); } });
  }

  async function record(start: number, end: number, seconds: number, progress: (part: number) => void, signal: AbortSignal): Promise<boolean> {
    if (!picture || !place) return false;
    const { width, height } = place, of = picture, now = ink(), name = fileName('motion', 'webm'), s = Math.min(2, 1920 / width);
    // What keeps still is drawn once, with the words below; sizes are even, as encoders want them.
    const still = sheetOf(captioned({ title: words.stage.motion, width, height, draw: (pen) => of.still(pen, now) }), s);
    const sheet = el('canvas', { width: still.width & ~1, height: still.height & ~1 }), context = sheet.getContext('2d');
    if (!context) return false;
    const pen = canvasPen(context, width, height);
    const content = await film(sheet, seconds, (part) => {
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.drawImage(still, 0, 0);
      context.setTransform(s, 0, 0, s, 0, 0);
      of.moving(pen, now, part === 1 ? end : start + part * (end - start));
      progress(part);
    }, signal);
    if (content) download(content, name);
    return content !== null;
  }

  new ResizeObserver(() => refresh()).observe(holder);
  new IntersectionObserver((entries) => {
    visible = entries[entries.length - 1]?.isIntersecting ?? false;
    if (visible) { if (dirty) refresh(); else redrawMoving(); }
  }).observe(holder);

  return {
    id: 'motion', title: words.stage.motion, element, choice, show, save, film: record,
    at(now) {
      if (now === time) return;
      time = now;
      // What is to come is drawn with what keeps still, unless nothing is.
      if (picture && picture.over(now) !== finished) { dirty = true; draw(); } else redrawMoving();
    },
    redraw() { refresh(true); },
    relayout() { if (scene) refresh(); },
    shows: () => {
      const bodies = subject?.bodies ?? [], of = scene?.solution.truth ?? scene?.solution.tracks[0];
      return (bodies[of ? firstMoving(bodies.map((b) => b.columns.map((k) => of.columns[k]))) : 0]?.columns ?? []).map((k) => scene?.solution.columns[k] ?? '');
    },
    pin(of) { pinned = of; refresh(true); },
    hide(methods) { if (methods.join() !== hidden.join()) { hidden = methods; refresh(true); } },
    guess(next) {
      if (next?.method !== guess?.method || next?.place !== guess?.place) guessAt = next && guess && !next.open && guess.open ? guessAt : null;
      guess = next;
      if (picture) { redrawMoving(); attach(); }
    },
    onGuess(listener) { guessed = listener; },
    // As it would be drawn now: while it is out of sight it is not.
    sees: () => ({ kind: subject?.kind ?? null, side: scene && subject ? sideOf(scene, subject, staging(), placeFor(holder.clientWidth, holder.clientHeight)) : '' }),
  };
}
