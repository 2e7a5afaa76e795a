/* The bar above the pictures that look closer: the motion in small, its Play, links to the questions that are there, and the way back. Shown while the stage is out of sight.
 *
 * Invariant: it keeps no time of its own; it shows what the clock and the scene say.
 */
import type { Scene } from '../scene';
import { exampleOf } from '../data';
import { button, el, place, say } from '../dom';
import { extent } from '../figure/axes';
import { ink } from '../figure/ink';
import { grouped } from '../figure/number';
import { rowAt } from '../figure/track';
import { timeUnit } from '../panel/told';
import { lineOf } from '../figure/line';
import { words } from '../words';
import type { Link } from './closer';
import { short } from './number';
import { titleOf } from './presets';
import { ownTitle } from './title';
import type { Transport } from './transport';

const texts = words.panel.bar;
const WIDTH = 116, HEIGHT = 40, MARGIN = 5;

export interface Mini { show(scene: Scene): void; at(time: number): void; redraw(): void; playing(on: boolean): void; links(links: readonly Link[]): void }

export function mini(clock: () => Transport): Mini {
  const play = button('', () => clock().toggle(), { class: 'mini-play', 'aria-label': texts.play });
  const canvas = el('canvas', { class: 'mini-motion', width: 2 * WIDTH, height: 2 * HEIGHT, 'aria-hidden': 'true' });
  const title = el('b', {}), told = el('span', { class: 'quiet' });
  const back = el('a', { class: 'quiet-button', href: '#page' }, texts.back);
  const nav = el('nav', { class: 'mini-links', 'aria-label': texts.questions });
  const bar = el('div', { class: 'mini', hidden: true }, play, canvas, el('p', {}, title, ' ', told), nav, back);
  place('mini').append(bar);
  back.addEventListener('click', (event) => { event.preventDefault(); scrollTo({ top: 0 }); clock().play.focus({ preventScroll: true }); });
  // prepared: the scene whose curve is in xy.
  let scene: Scene | null = null, prepared: Scene | null = null, time = 0, xy: Float64Array = new Float64Array(0), times: ArrayLike<number> = [];

  new IntersectionObserver((entries) => {
    const away = !(entries[entries.length - 1]?.isIntersecting ?? true);
    bar.hidden = !away;
    document.documentElement.classList.toggle('closer', away);
    if (away) draw();
  }).observe(place('page'));

  /** The exact motion, or the first method's: its first two positions, or the first number against time. */
  function prepare(): void {
    prepared = scene;
    if (!scene) return;
    const { solution, description } = scene, of = solution.truth ?? (solution.tracks[0] && lineOf(solution.tracks[0], []));
    const places = description.columns.filter((c) => c.kind === 'position' || c.kind === 'first-order').map((c) => solution.columns.indexOf(c.name)).filter((k) => k >= 0 && (of?.columns[k]?.length ?? 0) > 0);
    if (!of || !places.length) { xy = new Float64Array(0); return; }
    const flat = description.variables.some((v) => v.order === 2 && v.components >= 2);
    const x = flat && places.length > 1 ? of.columns[places[0]!]! : of.times, y = of.columns[places[flat && places.length > 1 ? 1 : 0]!]!;
    const box = [...extent([x]), ...extent([y])] as const;
    const w = WIDTH - 2 * MARGIN, h = HEIGHT - 2 * MARGIN, sx = w / (box[1] - box[0] || 1), sy = h / (box[3] - box[2] || 1);
    const [kx, ky] = flat ? [Math.min(sx, sy), Math.min(sx, sy)] : [sx, sy];
    xy = new Float64Array(2 * x.length);
    for (let i = 0; i < x.length; i++) {
      xy[2 * i] = MARGIN + (w - kx * (box[1] - box[0])) / 2 + kx * (x[i]! - box[0]);
      xy[2 * i + 1] = HEIGHT - MARGIN - (h - ky * (box[3] - box[2])) / 2 - ky * (y[i]! - box[2]);
    }
    times = of.times;
  }
  function draw(): void {
    const context = canvas.getContext('2d');
    if (!context || bar.hidden) return;
    if (prepared !== scene) prepare();
    const { exact } = ink();
    context.setTransform(2, 0, 0, 2, 0, 0);
    context.clearRect(0, 0, WIDTH, HEIGHT);
    context.strokeStyle = context.fillStyle = exact;
    context.lineWidth = 2;
    context.beginPath();
    for (let i = 0; i + 1 < xy.length; i += 2) context.lineTo(xy[i]!, xy[i + 1]!);
    context.stroke();
    const row = rowAt(times, time);
    if (row < 0) return;
    context.beginPath();
    context.arc(xy[2 * row]!, xy[2 * row + 1]!, 4, 0, 2 * Math.PI);
    context.fill();
  }
  return {
    show(next) {
      scene = next;
      say(title, titleOf(exampleOf(next.state)) || ownTitle(next.state.text) || words.headline.own);
      const track = next.solution.tracks[0];
      say(told, track ? track.tolerance !== null ? texts.adapting(short(track.tolerance, 4), grouped(track.total)) : texts.steps(`${short(track.step, 4)}${timeUnit(next) && `\u2009${timeUnit(next)}`}`, grouped(track.total)) : '');
      draw();
    },
    at(now) { if (now !== time) { time = now; draw(); } },
    redraw: draw,
    playing(on) { play.classList.toggle('on', on); play.setAttribute('aria-label', on ? texts.pause : texts.play); },
    links(links) { nav.replaceChildren(...links.map((link) => button(link.title, () => link.go(), { class: 'quiet-button' }))); },
  };
}
