/* The frame of a picture: its question, the answer of this run, its controls, two canvases (what keeps still, and above it what moves), and a foot with
 * the numbers and the files.
 *
 * Invariant: nothing is drawn while it cannot be seen, and no layer more than once a frame; PNG and SVG are made by the functions that draw the screen.
 */
import { button, el as element } from '../dom';
import { words } from '../words';
import { csv, downloadText, fileName, savePicture } from './export';
import { ink } from './ink';
import { saidNodes, saidText } from './name';
import { canvasPen } from './pen';
import { tableElement } from './table';
import type { Figure, FigureDefinition, Ink, Pen, Said } from './types';

/** A picture is not higher than this share of the window, so that it can be seen whole. */
const TALLEST = 0.8;
/** Nor lower than this, however narrow: ticks and curves need some height. */
const LEAST = 230;
/** A CustomEvent that bubbles: the figure has come or gone, or is called otherwise. */
export const THERE = 'motus-there';
let serial = 0;

export function figure(definition: FigureDefinition): Figure {
  const name = `figure-${definition.id}-${++serial}`, titleNow = (): string => (typeof definition.title === 'string' ? definition.title : definition.title());
  const questionNow = (): Said => (typeof definition.question === 'function' ? definition.question() : definition.question ?? titleNow());
  const heading = element('h3', { id: name, class: 'figure-title', tabindex: '-1' }), answer = element('p', { class: 'figure-answer', hidden: true });
  const canvas = element('canvas', { class: 'figure-still', role: 'img', 'aria-label': titleNow() });
  const overlay = element('canvas', { class: 'figure-moving', 'aria-hidden': 'true' });
  const message = element('p', { class: 'figure-message', hidden: true });
  const picture = element('div', { class: 'figure-picture' }, canvas, overlay, message);
  const summary = element('p', { class: 'figure-summary' });
  const data = element('details', { class: 'figure-data' }, element('summary', {}, words.frame.numbers), summary);
  const saves = (['PNG', 'SVG', 'CSV'] as const).map((kind) => ({ kind, control: button(kind, () => write(kind), { class: 'figure-button', title: words.frame.saveAs(kind) }) }));
  const save = element('div', { class: 'figure-save', role: 'group' }, ...saves.map(({ control }) => control));
  const foot = element('div', { class: 'figure-foot' }, data, save);
  const root = element('figure', { class: 'figure', 'aria-labelledby': name, 'data-figure': definition.id },
    heading, answer, ...(definition.controls?.length ? [element('div', { class: 'figure-controls' }, ...definition.controls)] : []), picture, foot);

  let width = 0, height = 0, scale = 1, room = 0, colours: Ink | null = null;
  let visible = false, dirty = true, asked = 0, busy = false, again = false, told = '', called = '', asks = '', answers = '';
  let tableTimer = 0, sentenceTimer = 0;

  const tall = (w: number): number => {
    const extra = definition.extra?.(w) ?? 0, least = definition.least ?? LEAST;
    return Math.round(Math.min(Math.max(least, w * (definition.aspect ?? 0.62)), Math.max(least, (definition.tallest ?? TALLEST) * window.innerHeight - extra)) + extra);
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
  function put(target: Element, said: Said): void {
    target.replaceChildren(...saidNodes(said));
  }
  /** The title's places: what it names may change with the scene. */
  function call(): void {
    const title = titleNow();
    if (title === called) return;
    called = title;
    root.dataset.title = title;
    save.setAttribute('aria-label', words.frame.save(title));
    for (const { kind, control } of saves) control.setAttribute('aria-label', words.frame.saveTitleAs(title, kind));
    root.dispatchEvent(new CustomEvent(THERE, { bubbles: true }));
  }
  function describe(): void {
    clearTimeout(sentenceTimer);
    sentenceTimer = 0;
    call();
    const question = questionNow(), said = told ? '' : definition.answer?.() ?? '', sentence = told ? '' : definition.summary();
    const key = JSON.stringify(question), reply = JSON.stringify(said);
    if (key !== asks) put(heading, question);
    if (reply !== answers) put(answer, said);
    [asks, answers] = [key, reply];
    answer.hidden = saidText(said) === '';
    if (summary.textContent !== sentence) summary.textContent = sentence;
    const label = [`${saidText(question)}${/\?$/.test(saidText(question)) ? '' : '.'}`, saidText(said), sentence].filter(Boolean).join(' ');
    if (canvas.getAttribute('aria-label') !== label) canvas.setAttribute('aria-label', label);
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
    foot.hidden = !!text;
    // The size is found anew when the picture is back.
    if (text) { picture.style.height = ''; width = 0; }
    redraw();
  }
  function fill(): void {
    if (!data.open) return;
    empty();
    data.append(tableElement(definition.table(), titleNow()));
  }
  function empty(): void {
    while (data.lastChild && data.lastChild !== summary) data.lastChild.remove();
  }
  data.addEventListener('toggle', () => { if (data.open) fill(); else empty(); });

  function write(kind: 'PNG' | 'SVG' | 'CSV'): void {
    if (kind === 'CSV') { downloadText(csv(definition.table()), 'text/csv', fileName(definition.id, 'csv')); return; }
    fit();
    savePicture(kind, definition.id, [saidText(definition.answer?.() ?? ''), definition.summary()].filter(Boolean).join(' '), { title: titleNow(), width, height, draw(pen, now) { definition.draw(pen, now); definition.overlay?.(pen, now); } });
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

  put(heading, questionNow());
  asks = JSON.stringify(questionNow());
  call();
  return {
    element: root, canvas, overlay, picture, redraw, redrawOverlay, say,
    there(on) {
      if (root.hidden === !on) return;
      root.hidden = !on;
      root.dispatchEvent(new CustomEvent(THERE, { bubbles: true }));
    },
  };
}
