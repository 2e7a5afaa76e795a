/* The frame of a picture: its name, its controls, two canvases (what keeps still, and above it what moves), a summary, a table, and export.
 *
 * Invariant: nothing is drawn while it cannot be seen, and no layer more than once a frame; PNG and SVG are made by the functions that draw the screen.
 */
import { button, el as element } from '../dom';
import { words } from '../words';
import { csv, downloadText, fileName, savePicture } from './export';
import { ink } from './ink';
import { canvasPen } from './pen';
import { tableElement } from './table';
import type { Figure, FigureDefinition, Ink, Pen } from './types';

/** A picture is not higher than this share of the window, so that it can be seen whole. */
const TALLEST = 0.8;
/** Nor lower than this, however narrow: ticks and curves need some height. */
const LEAST = 230;
let serial = 0;

export function figure(definition: FigureDefinition): Figure {
  const name = `figure-${definition.id}-${++serial}`;
  const canvas = element('canvas', { class: 'figure-still', role: 'img', 'aria-label': definition.title });
  const overlay = element('canvas', { class: 'figure-moving', 'aria-hidden': 'true' });
  const message = element('p', { class: 'figure-message', hidden: true });
  const picture = element('div', { class: 'figure-picture' }, canvas, overlay, message);
  const caption = element('figcaption', { class: 'figure-caption' });
  const data = element('details', { class: 'figure-data' }, element('summary', {}, words.frame.data));
  const save = element('div', { class: 'figure-save', role: 'group', 'aria-label': words.frame.save(definition.title) },
    ...(['PNG', 'SVG', 'CSV'] as const).map((kind) =>
      button(kind, () => write(kind), { class: 'figure-button', 'aria-label': words.frame.saveTitleAs(definition.title, kind), title: words.frame.saveAs(kind) })));
  const root = element('figure', { class: 'figure', 'aria-labelledby': name },
    element('div', { class: 'figure-head' }, element('h3', { id: name, class: 'figure-title' }, definition.title), save),
    ...(definition.controls?.length ? [element('div', { class: 'figure-controls' }, ...definition.controls)] : []),
    picture, caption, data);

  let width = 0, height = 0, scale = 1, room = 0, colours: Ink | null = null;
  let visible = false, dirty = true, asked = 0, busy = false, again = false, told = '';
  let tableTimer = 0, sentenceTimer = 0;

  const tall = (w: number): number => {
    const extra = definition.extra?.(w) ?? 0;
    return Math.round(Math.min(Math.max(LEAST, w * (definition.aspect ?? 0.62)), Math.max(LEAST, (definition.tallest ?? TALLEST) * window.innerHeight - extra)) + extra);
  };
  /** The canvases get the size of the page's picture, in the pixels of the screen. Its width is what was last observed: to ask for it would have the
   * browser lay out the page twice a frame while a slider is dragged. */
  function fit(): void {
    const w = room || picture.clientWidth;
    if (!w) return;
    const h = tall(w), s = Math.min(4, Math.max(1, window.devicePixelRatio || 1));
    if (w === width && h === height && s === scale) return;
    width = w, height = h, scale = s;
    picture.style.height = `${h}px`;
    for (const c of [canvas, overlay]) {
      c.width = Math.round(w * s);
      c.height = Math.round(h * s);
    }
  }
  function onto(target: HTMLCanvasElement, draw: (pen: Pen, ink: Ink) => void): void {
    const context = target.getContext('2d');
    if (!context || !colours) return;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, width, height);
    draw(canvasPen(context, width, height), colours);
  }
  function drawOverlay(): void {
    if (definition.overlay && !told) onto(overlay, (pen, i) => definition.overlay?.(pen, i));
  }
  function draw(): void {
    asked = 0;
    if (!visible || !dirty) return;
    if (told) { dirty = false; return; }
    fit();
    if (!width) return;
    dirty = false;
    colours = ink();
    onto(canvas, (pen, i) => definition.draw(pen, i));
    drawOverlay();
    describe();
    if (data.open) {
      // A table of hundreds of cells is not rebuilt while a slider is dragged.
      clearTimeout(tableTimer);
      tableTimer = window.setTimeout(fill, 250);
    }
  }
  function describe(): void {
    clearTimeout(sentenceTimer);
    sentenceTimer = 0;
    const sentence = told ? '' : definition.summary();
    if (caption.textContent === sentence) return;
    caption.textContent = sentence;
    canvas.setAttribute('aria-label', `${definition.title}. ${sentence}`);
  }
  function redraw(): void {
    dirty = true;
    if (visible && !asked) asked = requestAnimationFrame(draw);
    // Who listens to the page instead of scrolling it is told as well, though nothing is drawn.
    if (!visible && !sentenceTimer) sentenceTimer = window.setTimeout(describe, 300);
  }
  /** At once where this frame has not had it yet: a moving thing must not lag a frame behind its clock. */
  function redrawOverlay(): void {
    if (!visible || dirty || told) return;
    if (busy) { again = true; return; }
    busy = true;
    drawOverlay();
    requestAnimationFrame(() => {
      busy = false;
      if (again) { again = false; redrawOverlay(); }
    });
  }
  function say(text: string): void {
    if (text === told) return;
    told = text;
    message.textContent = text;
    message.hidden = !text;
    canvas.hidden = overlay.hidden = !!text;
    caption.hidden = data.hidden = save.hidden = !!text;
    // The size is found anew when the picture is back.
    if (text) { picture.style.height = ''; width = 0; }
    redraw();
  }
  function fill(): void {
    if (!data.open) return;
    while (data.lastChild && data.childNodes.length > 1) data.lastChild.remove();
    data.append(tableElement(definition.table(), definition.title));
  }
  data.addEventListener('toggle', () => {
    if (data.open) fill();
    else while (data.childNodes.length > 1) data.lastChild?.remove();
  });

  function write(kind: 'PNG' | 'SVG' | 'CSV'): void {
    if (kind === 'CSV') { downloadText(csv(definition.table()), 'text/csv', fileName(definition.id, 'csv')); return; }
    fit();
    savePicture(kind, definition.id, definition.summary(), { title: definition.title, width, height, draw(pen, now) { definition.draw(pen, now); definition.overlay?.(pen, now); } });
    // Layouts that the drawing remembers are the screen's again.
    redraw();
  }

  new ResizeObserver(() => {
    room = picture.clientWidth;
    if (room !== width || tall(room) !== height) redraw();
  }).observe(picture);
  new IntersectionObserver((entries) => {
    visible = entries[entries.length - 1]?.isIntersecting ?? false;
    if (visible && dirty) redraw();
    else if (visible) redrawOverlay();
  }, { rootMargin: '25% 0%' }).observe(picture);

  return { element: root, canvas, overlay, picture, redraw, redrawOverlay, say };
}
