/* The small drawing beside an explanation: one step close up, or what a step does to the error, from the numbers of the run that is seen.
 *
 * Invariant: curves are computed from the scene, or by the step formula that is explained, for the very step on show.
 */
import { ink } from '../figure/ink';
import { svgPen } from '../figure/pen';
import type { Pen, Ink } from '../figure/types';
import type { Scene } from '../scene';
import type { LiveStore } from '../state';
import { svg } from '../dom';
import { words } from '../words';

const WIDTH = 250, HEIGHT = 132;
type Draw = (pen: Pen, ink: Ink, scene: Scene) => void;
const colourOf = (scene: Scene, method: string, otherwise: string): string => scene.looks.find((l) => l.method === method)?.colour ?? otherwise;

/** One step of a throw: its velocity and gravity in pixels of the drawing. */
interface Throw { readonly x0: number; readonly y0: number; readonly vx: number; readonly vy: number; readonly g: number }
const THROW: Throw = { x0: 16, y0: 118, vx: 130, vy: 104, g: 56 };
/** The way of the ball during the step, and its straight lines with the velocity of the start, the middle, the end. */
function flight(pen: Pen, ink: Ink, parts: number): number[] {
  const { x0, y0, vx, vy, g } = THROW, xy = Array.from({ length: 2 * parts + 2 }, (_, k) => { const t = (k >> 1) / parts; return k % 2 ? y0 - vy * t + g * t * t / 2 : x0 + vx * t; });
  pen.line(xy, { colour: ink.exact, width: 3 });
  return xy;
}
function along(pen: Pen, speed: number, colour: string, shape: 'circle' | 'square' | 'diamond', dash: readonly number[] = []): readonly [number, number] {
  const { x0, y0, vx, vy, g } = THROW, y = y0 - (vy - g * speed);
  pen.line([x0, y0, x0 + vx, y], { colour, width: 1.75, dash });
  pen.mark(shape, x0 + vx, y, 4.5, colour);
  return [x0 + vx, y];
}
const start = (pen: Pen, ink: Ink): void => { pen.mark('circle', THROW.x0, THROW.y0, 5, ink.text); pen.mark('circle', THROW.x0, THROW.y0, 3, ink.surface); };

const drawings: Readonly<Record<string, Draw>> = {
  'straight': (pen, i, scene) => {
    flight(pen, i, 24);
    const [x, y] = along(pen, 0, colourOf(scene, 'explicit-euler', i.text), 'circle', [7, 3]);
    pen.text(x + 9, y, words.lesson.drawn.step, { colour: i.text, baseline: 'middle' });
    pen.text(x + 9, THROW.y0 - THROW.vy + THROW.g / 2, words.lesson.drawn.ball, { colour: i.exact, baseline: 'middle' });
    start(pen, i);
  },
  'old-new-speed': (pen, i, scene) => {
    const colours = ['explicit-euler', 'symplectic-euler'].map((m) => colourOf(scene, m, i.text)) as [string, string];
    const [x, high] = along(pen, 0, colours[0], 'circle', [7, 3]), [, middle] = along(pen, 0.5, i.exact, 'circle'), [, low] = along(pen, 1, colours[1], 'square');
    for (const [y, label, colour] of [[high, words.lesson.drawn.oldSpeed, colours[0]], [middle, words.lesson.drawn.happens, i.exact], [low, words.lesson.drawn.newSpeed, colours[1]]] as const) pen.text(x + 9, y, label, { colour, baseline: 'middle' });
    start(pen, i);
  },
  'middle': (pen, i, scene) => {
    const { x0, y0, vx, vy } = THROW, colour = colourOf(scene, 'midpoint', i.text);
    flight(pen, i, 24);
    pen.line([x0, y0, x0 + vx / 2, y0 - vy / 2], { colour: i.quiet, width: 1.25, dash: [2, 3] });
    pen.mark('ring', x0 + vx / 2, y0 - vy / 2, 4, colour);
    // Below the lines, which rise from here.
    pen.text(x0 + vx / 2 + 8, y0 - vy / 2 + 30, words.lesson.drawn.half, { colour: i.quiet });
    const [x, y] = along(pen, 0.5, colour, 'diamond', [9, 3, 2, 3]);
    pen.text(x + 9, y, words.lesson.drawn.on, { colour, baseline: 'middle' });
    start(pen, i);
  },
  'halves': (pen, i, scene) => {
    // Errors of order one and two at a step, a half, a quarter of it.
    for (const [k, order, method, label] of [[0, 1, 'symplectic-euler', words.lesson.drawn.order1], [1, 2, 'verlet', words.lesson.drawn.order2]] as const) {
      const left = 16 + 122 * k, colour = colourOf(scene, method, i.text);
      for (let n = 0; n < 4; n++) pen.box(left + 24 * n, 104 - 88 * 2 ** (-order * n), 16, 88 * 2 ** (-order * n), colour);
      pen.line([left - 4, 104.5, left + 96, 104.5], { colour: i.axis, width: 1 });
      pen.text(left, 122, label, { colour: i.quiet });
    }
  },
  'energy': (pen, i, scene) => {
    const h = scene.solution.tracks[0]?.step ?? 0.16, steps = 60;
    const run = (next: (x: number, v: number) => [number, number]): number[] => {
      let [x, v] = [1, 0];
      return Array.from({ length: steps + 1 }, (_, n) => { if (n) [x, v] = next(x, v); return [16 + 180 * n / steps, 96 - 60 * (x * x + v * v - 1)]; }).flat();
    };
    pen.line([16, 96, 196, 96], { colour: i.exact, width: 3 });
    pen.clip(0, 6, WIDTH, HEIGHT, () => pen.line(run((x, v) => [x + h * v, v - h * x]), { colour: colourOf(scene, 'explicit-euler', i.text), width: 1.75, dash: [7, 3] }));
    pen.line(run((x, v) => { const w = v - h * x; return [x + h * w, w]; }), { colour: colourOf(scene, 'symplectic-euler', i.text), width: 1.75 });
    pen.text(16, 122, words.lesson.drawn.energy, { colour: i.quiet });
  },
  'two-places': (pen, i, scene) => {
    const at = (t: number): readonly [number, number] => [24 + 90 * t, 26 + 24 * t * t], colour = colourOf(scene, 'verlet', i.text), [b, n, x] = [at(0), at(1), at(2)];
    pen.line(Array.from({ length: 50 }, (_, k) => at((k >> 1) / 12)[k % 2 as 0 | 1]), { colour: i.exact, width: 3 });
    pen.line([...b, 2 * n[0] - b[0], 2 * n[1] - b[1]], { colour: i.quiet, width: 1.25, dash: [2, 3] });
    pen.arrow(2 * n[0] - b[0], 2 * n[1] - b[1], x[0], x[1] - 4, { colour, width: 2 });
    pen.line([...b, ...x], { colour, width: 1.25 });
    for (const [[px, py], label] of [[b, words.lesson.drawn.before], [n, words.lesson.drawn.now], [x, words.lesson.drawn.next]] as const) { pen.mark('circle', px, py, 4.5, i.text); pen.text(px, py - 10, label, { colour: i.quiet, anchor: 'middle' }); }
  },
  'overshoot': (pen, i, scene) => {
    const h = scene.solution.tracks[0]?.step ?? 2.1, colour = colourOf(scene, 'verlet', i.text), x = [1, 1 - h * h / 2];
    while (x.length < 7) x.push((2 - h * h) * x[x.length - 1]! - x[x.length - 2]!);
    const size = Math.max(...x.map(Math.abs)), xy = x.flatMap((v, n) => [20 + 34 * n, 66 - 48 * v / size]);
    pen.line([10, 66, 236, 66], { colour: i.exact, width: 2 });
    pen.line(xy, { colour, width: 1.5, dash: [2, 2.5] });
    x.forEach((_, n) => pen.mark('triangle', xy[2 * n]!, xy[2 * n + 1]!, 4.5, colour));
    pen.text(20, 126, words.lesson.drawn.each(String(Number(h.toPrecision(3)))), { colour: i.quiet });
  },
};

export function closeUp(name: string, store: LiveStore): SVGElement | null {
  const draw = Object.hasOwn(drawings, name) ? drawings[name] : undefined, { scene } = store;
  if (!draw || !scene) return null;
  const pen = svgPen(WIDTH, HEIGHT, 1);
  draw(pen, ink(), scene);
  const parsed = document.importNode(new DOMParser().parseFromString(pen.svg(), 'image/svg+xml').documentElement, true);
  return parsed instanceof SVGElement ? parsed : svg('svg');
}
