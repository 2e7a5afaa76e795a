/* The line at the present time in a picture against time. It is a slider: arrow keys move it, a click sets it, and its value is read out as text.
 *
 * Invariant: a panel does not set the page's time. It asks, by the event SEEK on its figure, and shows what it is told by `set`.
 */
import type { Figure, Frame, Ink, Pen } from './types';
import { brief } from './number';
import { textWidth } from './shapes';
import { words } from '../words';
import { rowAt } from './track';

/** A CustomEvent<number> that bubbles: the time somebody would like to see. */
export const SEEK = 'motus-seek';

export interface CursorDefinition {
  readonly figure: Figure; readonly title: string;
  /** The frame last drawn, whose x is the time. */
  frame(): Frame | null;
  /** Times of the rows, which the keys go through. */
  times(): ArrayLike<number>;
  /** What is seen at this time, as a sentence. */
  text(time: number): string;
}
export interface Cursor {
  set(time: number): void;
  /** The time of the clock, or where the pointer is. */
  shown(): number;
  /** The time that the pointer is at; null where it is elsewhere. */
  hovered(): number | null;
  /** Where the pointer is, in pixels; null where it is elsewhere. */
  pointer(): { readonly x: number; readonly y: number } | null;
  draw(pen: Pen, ink: Ink, frame: Frame): void;
}

/** How many presses of an arrow key cross the picture at most. */
const PRESSES = 200;

export function cursor(definition: CursorDefinition): Cursor {
  const { figure } = definition, slider = figure.overlay, canvas = figure.canvas;
  let time = 0, pointer: { x: number; y: number } | null = null, timer = 0;

  slider.removeAttribute('aria-hidden');
  slider.setAttribute('role', 'slider');
  for (const name of ['aria-valuemin', 'aria-valuemax', 'aria-valuenow']) slider.setAttribute(name, '0');
  slider.setAttribute('tabindex', '0');
  slider.setAttribute('aria-label', words.figure.cursor(definition.title));

  /** Attributes are for reading, not for animation: they follow when the clock rests, or at once for the keys. */
  function tell(at = time): void {
    clearTimeout(timer);
    timer = 0;
    const times = definition.times(), n = times.length;
    const first = n ? times[0]! : 0, last = n ? times[n - 1]! : 0;
    slider.setAttribute('aria-valuemin', String(Math.min(first, last)));
    slider.setAttribute('aria-valuemax', String(Math.max(first, last)));
    slider.setAttribute('aria-valuenow', String(at));
    slider.setAttribute('aria-valuetext', definition.text(at));
  }
  function ask(to: number): void {
    time = to;
    pointer = null;
    figure.element.dispatchEvent(new CustomEvent<number>(SEEK, { detail: to, bubbles: true }));
    figure.redrawOverlay();
    tell();
  }
  function near(x: number): number | null {
    const frame = definition.frame();
    if (!frame || x < frame.left - 8 || x > frame.left + frame.width + 8) return null;
    const times = definition.times(), n = times.length;
    if (!n) return null;
    const t = frame.x.invert(Math.min(frame.left + frame.width, Math.max(frame.left, x)));
    const low = Math.min(times[0]!, times[n - 1]!), high = Math.max(times[0]!, times[n - 1]!);
    const inside = Math.min(high, Math.max(low, t));
    // Onto the nearest row where rows are wider than a pixel or two: there the numbers are the computed ones.
    const i = Math.max(0, rowAt(times, inside)), j = Math.min(n - 1, i + 1);
    const nearest = Math.abs(times[i]! - inside) <= Math.abs(times[j]! - inside) ? times[i]! : times[j]!;
    return n < 4 * frame.width || Math.abs(frame.x(nearest) - frame.x(inside)) <= 1 ? nearest : inside;
  }

  slider.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const times = definition.times(), n = times.length;
    if (!n) return;
    const jump = Math.max(1, Math.ceil(n / PRESSES)), i = Math.max(0, rowAt(times, time)), between = times[i] !== time;
    const to = event.key === 'ArrowRight' || event.key === 'ArrowUp' ? i + jump
      : event.key === 'ArrowLeft' || event.key === 'ArrowDown' ? i - (between && jump === 1 ? 0 : jump)
      : event.key === 'PageUp' ? i + Math.ceil(n / 10) : event.key === 'PageDown' ? i - Math.ceil(n / 10)
      : event.key === 'Home' ? 0 : event.key === 'End' ? n - 1 : null;
    if (to === null) return;
    event.preventDefault();
    // The page's own arrow keys step the clock as well: once is enough.
    event.stopPropagation();
    ask(times[Math.max(0, Math.min(n - 1, to))]!);
  });
  slider.addEventListener('focus', () => tell());
  canvas.addEventListener('pointermove', (event) => {
    if (event.pointerType === 'touch') return;
    pointer = { x: event.offsetX, y: event.offsetY };
    figure.redrawOverlay();
  });
  canvas.addEventListener('pointerleave', () => {
    if (!pointer) return;
    pointer = null;
    figure.redrawOverlay();
  });
  canvas.addEventListener('click', (event) => {
    const t = near(event.offsetX);
    if (t !== null) ask(t);
  });

  const hovered = (): number | null => (pointer ? near(pointer.x) : null);
  return {
    set(t) {
      time = t;
      if (!timer) timer = window.setTimeout(tell, 400);
      figure.redrawOverlay();
    },
    shown: () => hovered() ?? time,
    hovered,
    pointer: () => pointer,
    draw(pen, ink, frame) {
      const line = (t: number, colour: string, width: number, dash: number[]): void => {
        const x = frame.x(t);
        // At the edge it would look like one.
        if (!(x >= frame.left - 1 && x <= frame.left + frame.width - 2)) return;
        pen.line([x, frame.top, x, frame.top + frame.height], { colour, width, dash });
      };
      line(time, ink.axis, 1.25, []);
      const hover = hovered();
      if (hover !== null && hover !== time) line(hover, ink.quiet, 1, [3, 3]);
    },
  };
}

/** "t = 2.5 s". */
export const heading = (time: number, unit = ''): string => `t = ${brief(time, 5)}${unit && `\u2009${unit}`}`;

/** What is under the pointer, in lines beside it: the time, then each value in its curve's colour. */
export function drawReadout(pen: Pen, ink: Ink, frame: Frame, time: number, title: string, values: readonly { readonly text: string; readonly colour: string }[]): void {
  const x = frame.x(time), size = 12, line = 17, wide = Math.max(textWidth(title, size), ...values.map((v) => 1.06 * textWidth(v.text, size)));
  const left = x + 12 + wide > frame.left + frame.width, at = left ? x - 10 : x + 10, anchor = left ? 'end' as const : 'start' as const;
  pen.box(left ? at - wide - 4 : at - 4, frame.top - 2, wide + 8, line * (values.length + 1) + 4, ink.surface, 0.88);
  pen.text(at, frame.top + 2, title, { colour: ink.quiet, size, anchor, baseline: 'top' });
  values.forEach((value, k) => pen.text(at, frame.top + 2 + line * (k + 1), [{ text: value.text, bold: true }], { colour: value.colour, size, anchor, baseline: 'top' }));
}
