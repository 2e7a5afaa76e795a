/* The clock of the page: play, pause, restart, steps forward and back, a time one can drag, and how fast it goes.
 *
 * Invariant: the time follows from time stamps, never from the number of frames, so no monitor makes it faster; it never passes the end, and it
 * stops at the end exactly. Nothing moves unless asked for; nothing moves while the page is hidden.
 */
import { brief } from '../figure/number';
import { words } from '../words';

export interface TransportOptions {
  onTime(t: number): void;
  /** Times the natural speed; and what to do when the reader chooses another. */
  readonly speed?: number; onSpeed?(speed: number): void; onPlay?(playing: boolean): void;
}
export interface Transport {
  readonly element: HTMLElement; readonly play: HTMLElement;
  /** stepTimes: where the main method's steps end, for stepping; the start first. The present time is kept as far as the new range allows. */
  setRange(start: number, end: number, stepTimes: ArrayLike<number>): void;
  time(): number; playing(): boolean; toggle(): void;
  step(n: number): void; seek(t: number): void; setSpeed(speed: number): void;
  /** What stands behind the time: a unit. */
  setUnit(text: string): void;
}
/** Asks the page, from anywhere in it, that the clock stop and go so many steps forward (or back; 0: only stop): new CustomEvent(STEP_EVENT, { detail: n, bubbles: true }). */
export const STEP_EVENT = 'motus-step';

const SPEEDS: readonly (readonly [number, string])[] = [[0.25, '¼×'], [0.5, '½×'], [1, '1×'], [2, '2×'], [4, '4×'], [8, '8×']];
/* A run takes as long as it says, as if its unit were the second, if people can see that and wait for it; else about eight seconds. */
const WHOLE_RUN = 8, REAL_FROM = 1, REAL_TO = 12;
/* After a pause of the browser's own, the motion goes on from where it was, not from where it would be. */
const LONGEST_FRAME = 250;
/* For those who asked their system for less motion: so many milliseconds between one picture and the next. */
const CALM = 600;
const PARTS = 10000;
/* Ticks under the line, at most. */
const STEPS_TICKED = 40;

/** Seconds that a run of this length takes. */
export const runSeconds = (length: number): number => (length >= REAL_FROM && length <= REAL_TO ? length : WHOLE_RUN);

export function transport(options: TransportOptions): Transport {
  let start = 0, end = 1, steps: ArrayLike<number> = [0, 1], now = 0, speed = options.speed ?? 1;
  let running = false, frame = 0, stamp = NaN, owed = 0, decimals = 2;
  const calm = matchMedia('(prefers-reduced-motion: reduce)');

  const element = make('div', 'transport');
  element.setAttribute('role', 'group');
  element.setAttribute('aria-label', words.dock.clock.group);
  const play = iconButton(PLAY, words.dock.clock.play, () => toggle());
  play.classList.add('transport-play');

  const scrub = make('input', 'transport-scrub');
  scrub.type = 'range'; scrub.min = '0'; scrub.max = String(PARTS); scrub.step = '1'; scrub.value = '0';
  scrub.setAttribute('aria-label', words.dock.clock.time);
  scrub.addEventListener('input', () => { const part = Number(scrub.value) / PARTS; seek(part === 1 ? end : start + (end - start) * part); });
  const line = make('div', 'transport-line'), ticks = make('div', 'transport-ticks');
  line.append(scrub, ticks);

  const clock = make('span', 'transport-time'), present = make('span', 'transport-now'), unit = make('span', 'transport-unit');
  clock.append(present, unit);

  const select = make('select', 'transport-select');
  select.setAttribute('aria-label', words.dock.clock.speed);
  for (const [value, text] of SPEEDS) select.append(new Option(text, String(value)));
  select.addEventListener('change', () => { speed = Number(select.value); options.onSpeed?.(speed); });
  element.append(play, iconButton(BACK, words.dock.clock.back, () => step(-1)), iconButton(FORWARD, words.dock.clock.forward, () => step(1)), line, clock, select);

  const forwards = (): boolean => end >= start;
  const clamped = (t: number): number => forwards() ? Math.min(end, Math.max(start, t)) : Math.max(end, Math.min(start, t));
  /* Units of the model's time in a second. */
  function rate(): number {
    const length = Math.abs(end - start);
    return length / runSeconds(length) * speed;
  }
  function written(t: number): string {
    return Math.abs(t) < 1e6 && decimals <= 6 ? t.toFixed(decimals).replace('-', '−') : brief(t, 6);
  }
  function tell(): void {
    const text = written(now), part = String(end === start ? PARTS : Math.round(PARTS * (now - start) / (end - start)));
    present.textContent = text;
    if (scrub.value !== part) scrub.value = part;
    scrub.style.setProperty('--part', `${Number(part) / PARTS * 100}%`);
    scrub.setAttribute('aria-valuetext', words.dock.clock.value(`${text}${unit.textContent}`, written(end)));
    options.onTime(now);
  }
  function set(t: number): void { now = clamped(t); tell(); }

  function setRunning(on: boolean): void {
    if (on === running) return;
    running = on;
    play.replaceChildren(icon(on ? PAUSE : PLAY));
    name(play, on ? words.dock.clock.pause : words.dock.clock.play);
    play.toggleAttribute('data-playing', on);
    stamp = NaN; owed = 0;
    cancelAnimationFrame(frame);
    if (on) frame = requestAnimationFrame(tick);
    options.onPlay?.(on);
  }
  function tick(at: number): void {
    frame = requestAnimationFrame(tick);
    owed += Number.isNaN(stamp) ? 0 : Math.min(LONGEST_FRAME, Math.max(0, at - stamp));
    stamp = at;
    if (owed === 0 || (calm.matches && owed < CALM)) return;
    const way = owed / 1000 * rate();
    owed = 0;
    set(now + (forwards() ? way : -way));
    if (now === end) setRunning(false);
  }
  function toggle(): void {
    if (running) { setRunning(false); return; }
    if (now === end) set(start);
    setRunning(true);
  }
  function seek(t: number): void {
    if (!Number.isFinite(t)) return;
    owed = 0;
    set(t);
    if (running && now === end) setRunning(false);
  }
  /* From between two steps, one step forward goes to the end of this step, one back to its beginning. */
  function step(n: number): void {
    setRunning(false);
    const count = steps.length;
    if (count === 0 || n === 0) return;
    const before = (t: number): boolean => forwards() ? t < now : t > now;
    let low = 0, high = count;                    // steps[low - 1] is before now, steps[low] is not
    while (low < high) {
      const middle = (low + high) >> 1;
      if (before(steps[middle]!)) low = middle + 1; else high = middle;
    }
    const on = low < count && steps[low] === now;
    const to = n < 0 || on ? low + n : low - 1 + n;
    set(steps[Math.min(count - 1, Math.max(0, to))]!);
  }

  document.addEventListener('visibilitychange', () => { if (document.hidden) setRunning(false); });
  document.addEventListener('keydown', event => {
    if (event.defaultPrevented || event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
    if (event.target !== scrub && isTheirs(event.target, event.key)) return;
    switch (event.key) {
      case ' ': if (!event.repeat) toggle(); break;
      case 'ArrowRight': step(1); break;
      case 'ArrowLeft': step(-1); break;
      case 'Home': seek(start); break;
      case 'End': seek(end); break;
      default: return;
    }
    event.preventDefault();
  });

  /** A tick where each step ends, while ticks can be told apart. */
  function mark(): void {
    const count = steps.length - 1;
    if (count < 1 || count > STEPS_TICKED) { ticks.replaceChildren(); return; }
    while (ticks.childElementCount > count + 1) ticks.lastElementChild?.remove();
    while (ticks.childElementCount < count + 1) ticks.append(make('i', ''));
    for (let i = 0; i <= count; i++) (ticks.children[i] as HTMLElement).style.left = `${100 * (steps[i]! - start) / (end - start || 1)}%`;
  }

  select.value = String(speed);
  tell();
  return {
    element, play, time: () => now, playing: () => running, toggle, step, seek,
    setUnit(text) { unit.textContent = text ? `\u2009${text}` : ''; },
    setSpeed(wanted) { if (wanted > 0) { speed = wanted; select.value = String(speed); } },
    setRange(from, to, stepTimes) {
      start = from; end = to; steps = stepTimes;
      decimals = decimalsFor(Math.abs(end - start), steps.length > 1 ? Math.abs(steps[1]! - steps[0]!) : 0);
      mark();
      /* A clock whose digits come and go would push its neighbours about. */
      present.style.minWidth = `${Math.max(written(end).length, written(start).length)}ch`;
      set(now);
    },
  };
}

/* As many decimals as tell one step from the next, but no more than tell a thousandth of the run. */
function decimalsFor(length: number, step: number): number {
  if (!(length > 0)) return 2;
  const thousandth = Math.ceil(3 - Math.log10(length) - 1e-9);
  let own = 0;
  while (own < thousandth && Math.abs(step * 10 ** own - Math.round(step * 10 ** own)) > 1e-6) own++;
  return Math.max(0, Math.min(thousandth, Math.max(own, thousandth - 1)));
}

/** Whether a key means something to the control that has the focus: then it is not the clock's. */
function isTheirs(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.isContentEditable || target.closest('textarea, select, [role="listbox"], [role="menu"], [role="slider"], [role="tablist"], dialog')) return true;
  if (target instanceof HTMLInputElement) return target.type === 'range' ? key !== ' ' : target.type === 'checkbox' ? key === ' ' : true;
  if (key === ' ') return target.closest('button, summary, a[href], [role="button"], label') !== null;
  /* Boxes that scroll, such as tables and the list of events, are moved by the keys. */
  return target.getAttribute('role') === 'region' && target.tabIndex >= 0;
}

/* The icons, as outlines in a square of 24: drawn, so that every system shows the same. */
const PLAY = 'M7 4.5v15l12.5-7.5z', PAUSE = 'M7.5 5.5h3v13h-3zM13.5 5.5h3v13h-3z',
  BACK = 'M14.2 5.2 15.4 6.4 9.8 12l5.6 5.6-1.2 1.2L7.4 12z', FORWARD = 'M9.8 5.2 8.6 6.4 14.2 12l-5.6 5.6 1.2 1.2L16.6 12z';

function make<K extends keyof HTMLElementTagNameMap>(tag: K, name: string): HTMLElementTagNameMap[K] {
  const e = document.createElement(tag);
  e.className = name;
  return e;
}

function name(b: HTMLElement, label: string): void {
  b.setAttribute('aria-label', label);
  b.title = label;
}

function iconButton(outline: string, label: string, act: () => void): HTMLButtonElement {
  const b = make('button', 'transport-button');
  b.type = 'button';
  b.append(icon(outline));
  name(b, label);
  b.addEventListener('click', act);
  return b;
}

function icon(outline: string): SVGSVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 24 24');
  svg.setAttribute('aria-hidden', 'true');
  svg.setAttribute('class', 'transport-icon');
  const shape = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  shape.setAttribute('d', outline);
  shape.setAttribute('fill', 'currentColor');
  svg.append(shape);
  return svg;
}
