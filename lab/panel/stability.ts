/* Stability: where in the plane of z = hλ one step of the main method does not make a motion grow, and where the model's own hλ are.
 *
 * Invariant: the region belongs to the method alone and is asked once; the rates λ belong to the model; the step only moves the points.
 */
import { axes } from '../figure/axes';
import { figure } from '../figure/figure';
import { brief, minus } from '../figure/number';
import type { Frame, Ink, Pen } from '../figure/types';
import type { Method, Model, Spectrum } from '../protocol';
import { Refused, type Panel, type PanelMaker, type Scene } from '../scene';
import { methodTitle } from '../theory/cards';
import { heightAt, planeOf, type Plane } from './plane';

/** Times along the run at which the model is linearised; after the last change of the model, so many milliseconds later. */
const TIMES = 16, PAUSE = 120;
/** Pixels of the shading on the screen's scale. */
const MESH = 2;

interface Rate { readonly time: number; readonly re: number; readonly im: number }

const complex = (re: number, im: number): string => {
  const small = 1e-9 * Math.hypot(re, im);
  if (Math.abs(im) <= small) return brief(re, 3);
  const i = `${brief(Math.abs(im), 3)} i`;
  return Math.abs(re) <= small ? `${im < 0 ? '−' : '±'}${i}` : `${brief(re, 3)} ± ${i}`;
};
/** As many digits as tell it from 1. */
const growthText = (growth: number): string => {
  const off = Math.abs(growth - 1);
  return off > 0 && off < 1e-4 ? `1 ${growth > 1 ? '+' : '−'} ${brief(off, 2)}` : brief(growth, off < 0.01 ? 6 : 4);
};

export const stability: PanelMaker = (store): Panel => {
  let scene: Scene | null = null;
  let plane: Plane | null = null, planeFor = '', trouble = '';
  let rates: Rate[] = [], times: number[] = [], ratesFor = '', ratesTrouble = '', timer = 0;
  let growth: Float64Array | null = null, growthFor = '';
  let now = 0;
  let frame: Frame | null = null;
  let shade: { key: string; cells: Uint8Array; columns: number; rows: number } | null = null;

  const method = (): Method | undefined => {
    const name = scene?.looks[0]?.method;
    return scene?.catalogue.find((m) => m.name === name || m.aliases.includes(name ?? '')) ?? scene?.catalogue.find((m) => name?.startsWith(`${m.name}(`));
  };
  const step = (): number => Math.abs(scene?.solution.tracks[0]?.step ?? scene?.description.settings.step ?? 0);
  const colour = (ink: Ink): string => scene?.looks[0]?.colour ?? ink.accent;

  /* ---- asking ---- */

  async function wantPlane(): Promise<void> {
    const m = method();
    if (!m || m.name === planeFor) return;
    planeFor = m.name;
    plane = null;
    trouble = m.family === 'exact' ? 'The exact motion takes no steps: nothing can become unstable. Choose a method to see where its steps may lie.' : '';
    say();
    if (trouble) return;
    try {
      const made = await planeOf(store.client, m);
      if (planeFor !== m.name) return;
      plane = made;
    } catch (reason) {
      if (planeFor !== m.name) return;
      planeFor = '';
      trouble = reason instanceof Refused ? [reason.problem.message, reason.problem.hint].filter(Boolean).join(': ') : 'The region could not be computed.';
    }
    say();
  }

  function wantRates(): void {
    if (!scene) return;
    const { state, description, solution } = scene;
    const key = JSON.stringify([state.text, state.set, state.until]);
    if (key === ratesFor) return;
    ratesFor = key;
    clearTimeout(timer);
    const model: Model = { text: state.text, set: Object.entries(state.set).map(([name, value]) => `${name}=${value}`) };
    const start = description.settings.start, track = solution.tracks[0], end = track?.times[track.times.length - 1] ?? description.settings.until ?? start;
    const name = track?.method ?? description.settings.method, first = track?.step ?? description.settings.step;
    timer = window.setTimeout(() => { void (async () => {
      const at = Array.from({ length: TIMES }, (_, k) => start + (end - start) * k / TIMES);
      const ask = { model, method: name, step: first, until: state.until !== '' ? store.numbers.until : null };
      let found: readonly Spectrum[] = [];
      ratesTrouble = '';
      // Where the motion cannot be followed, its start still tells.
      for (const some of end > start ? [at, [start]] : [[start]]) {
        try {
          found = await store.client.ask('spectrum', { ...ask, times: some }, { lane: 'study', key: 'spectrum' });
          break;
        } catch (reason) {
          if (ratesFor !== key) return;
          ratesTrouble = reason instanceof Refused ? reason.problem.message : 'The model could not be linearised.';
        }
      }
      if (ratesFor !== key) return;
      rates = found.flatMap((spectrum, k) => Array.from(spectrum.re, (re, i): Rate => ({ time: at[k]!, re, im: spectrum.im[i]! })));
      times = found.map((_, k) => at[k]!);
      growthFor = '';
      wantGrowth();
      say();
    })(); }, PAUSE);
  }

  /** Of the pairs λ and its conjugate, the upper one; real ones once. */
  const upper = (): Rate[] => rates.filter((rate) => rate.im >= 0);

  function wantGrowth(): void {
    const m = method(), h = step();
    if (!m || m.family === 'exact' || rates.length === 0) return;
    const key = `${m.name} ${h} ${ratesFor}`;
    if (key === growthFor) return;
    growthFor = key;
    const points = upper(), re = points.map((rate) => (Math.abs(rate.re) <= 1e-12 * Math.hypot(rate.re, rate.im) ? 0 : h * rate.re)), im = points.map((rate) => h * rate.im);
    growth = null;
    void (async () => {
      try {
        const answer = await store.client.ask('growth', { method: m.name, re, im }, { lane: 'quick', key: 'growth' });
        if (growthFor === key) growth = answer;
      } catch {
        // Called off by a newer one, or not answered: then the grid must do.
        if (growthFor === key && plane) {
          const { full, axis } = plane;
          growth = Float64Array.from(re, (x, k) => Math.exp(x === 0 ? heightAt({ ...axis, re: Float64Array.of(-1, 1) }, 0, im[k]!) : full ? heightAt(full, x, im[k]!) : NaN));
        }
      }
      if (growthFor === key) shown.redraw();
    })();
  }

  /* ---- drawing ---- */

  function shading(of: Plane, f: Frame): { cells: Uint8Array; columns: number; rows: number } {
    const columns = Math.max(1, Math.round(f.width / MESH)), rows = Math.max(1, Math.round(f.height / MESH));
    const key = `${planeFor} ${f.left} ${f.top} ${f.width} ${f.height}`;
    if (shade?.key === key) return shade;
    const cells = new Uint8Array(columns * rows);
    if (of.full) {
      for (let j = 0; j < rows; j++) {
        const im = f.y.invert(f.top + (j + 0.5) * f.height / rows);
        for (let i = 0; i < columns; i++) {
          if (heightAt(of.full, f.x.invert(f.left + (i + 0.5) * f.width / columns), im) > 0) cells[i + columns * j] = 1;
        }
      }
    }
    shade = { key, cells, columns, rows };
    return shade;
  }

  function draw(pen: Pen, ink: Ink): void {
    frame = null;
    if (!plane) return;
    const { half } = plane;
    const f = frame = axes(pen, ink, { min: -1.3 * half, max: 0.7 * half, label: 'Re hλ' }, { min: -1.08 * half, max: 1.08 * half, label: 'Im hλ' }, { equal: true });
    const px = (re: number): number => f.x(re), py = (im: number): number => f.y(im);
    pen.clip(f.left, f.top, f.width, f.height, () => {
      if (plane?.full) {
        const { cells, columns, rows } = shading(plane, f);
        pen.cells(f.left, f.top, f.width, f.height, columns, rows, cells, ['', mixed(ink.danger, 0.16)]);
        const xy = Float64Array.from(plane.border, (v, k) => (k % 2 ? py(v) : px(v)));
        pen.line(xy, { colour: ink.text, width: 1.5 });
      }
      pen.line([px(0), f.top, px(0), f.top + f.height], { colour: ink.axis, width: 1 });
      pen.line([f.left, py(0), f.left + f.width, py(0)], { colour: ink.axis, width: 1 });
      if (plane && !plane.full) drawAxis(pen, ink, f, plane);
    });
    legend(pen, ink, f);
    drawPoints(pen, ink, f);
  }

  /** A method without velocities in its force has answers on the imaginary axis only. */
  function drawAxis(pen: Pen, ink: Ink, f: Frame, of: Plane): void {
    const { axis } = of, x = f.x(0);
    const piece = (from: number, to: number, grows: boolean): void => {
      for (const sign of [1, -1]) pen.line([x, f.y(sign * from), x, f.y(sign * to)], grows ? { colour: ink.danger, width: 5, alpha: 0.6 } : { colour: ink.text, width: 5 });
    };
    let from = 0, grows = false;
    for (let j = 0; j < axis.im.length; j++) {
      const here = !(axis.growth[2 * j]! <= 1 + 1e-7), im = axis.im[j]!;
      if (here !== grows) { piece(from, im, grows); from = im; grows = here; }
    }
    piece(from, axis.im[axis.im.length - 1]!, grows);
    if (Number.isFinite(of.limit)) {
      for (const sign of [1, -1]) {
        pen.line([x - 7, f.y(sign * of.limit), x + 7, f.y(sign * of.limit)], { colour: ink.text, width: 1.5 });
        pen.text(x + 12, f.y(sign * of.limit), `${sign < 0 ? '−' : ''}${brief(method()?.stability_limit ?? of.limit, 4)} i`, { colour: ink.text, size: 12, baseline: 'middle' });
      }
    }
  }

  function legend(pen: Pen, ink: Ink, f: Frame): void {
    const put = (x: number, y: number, text: string, anchor: 'start' | 'end'): void => pen.text(x, y, text, { colour: ink.quiet, size: 11, anchor, baseline: 'top' });
    if (plane?.full) put(f.left + f.width - 6, f.top + 6, 'shaded: a step makes the motion grow', 'end');
    else {
      const x = f.left + 8, y = f.top + 12;
      pen.line([x, y, x + 18, y], { colour: ink.text, width: 5 });
      put(x + 24, y - 6, 'no growth', 'start');
      pen.line([x, y + 16, x + 18, y + 16], { colour: ink.danger, width: 5, alpha: 0.6 });
      put(x + 24, y + 10, 'growth', 'start');
    }
  }

  /** Where a point is drawn; outside of the picture, at its edge. */
  function placed(f: Frame, re: number, im: number): { readonly x: number; readonly y: number; readonly out: boolean } {
    const x = f.x(re), y = f.y(im), ox = f.x(0), oy = f.y(0), m = 7;
    const share = Math.min(1,
      x > ox ? (f.left + f.width - m - ox) / (x - ox) : x < ox ? (f.left + m - ox) / (x - ox) : 1,
      y > oy ? (f.top + f.height - m - oy) / (y - oy) : y < oy ? (f.top + m - oy) / (y - oy) : 1);
    return { x: ox + share * (x - ox), y: oy + share * (y - oy), out: share < 1 };
  }

  function drawPoints(pen: Pen, ink: Ink, f: Frame): void {
    const h = step();
    const seen = new Set<string>();
    for (const rate of rates) {
      const at = placed(f, h * rate.re, h * rate.im), key = `${Math.round(at.x)} ${Math.round(at.y)}`;
      if (seen.has(key)) continue;
      seen.add(key);
      pen.mark('ring', at.x, at.y, 3, colour(ink));
    }
  }

  /** The rates nearest to the present time. */
  function overlay(pen: Pen, ink: Ink): void {
    const f = frame;
    if (!f || times.length === 0) return;
    const h = step(), nearest = times.reduce((best, t) => (Math.abs(t - now) < Math.abs(best - now) ? t : best), times[0]!);
    for (const rate of rates) {
      if (rate.time !== nearest) continue;
      const at = placed(f, h * rate.re, h * rate.im), ox = f.x(0), oy = f.y(0);
      pen.line([ox, oy, at.x, at.y], { colour: colour(ink), width: 1, alpha: 0.6 });
      if (at.out) pen.arrow(at.x - (at.x - ox) / Math.max(1, Math.hypot(at.x - ox, at.y - oy)) * 18, at.y - (at.y - oy) / Math.max(1, Math.hypot(at.x - ox, at.y - oy)) * 18, at.x, at.y, { colour: colour(ink), width: 2 });
      else pen.mark('circle', at.x, at.y, 4.5, colour(ink));
    }
  }

  /* ---- saying ---- */

  /** A method that turns the velocity about a field, on a model that has one: no single rate tells what it does. */
  const turns = (): boolean => method()?.name === 'boris' && scene?.description.velocity_dependent === true;

  function sentence(): string {
    const m = method(), h = step();
    if (!m || !plane) return '';
    const title = scene?.looks[0]?.label ?? methodTitle(m);
    const what = plane.full ? '' : ` Only the imaginary axis, oscillation without friction, has a meaning for ${title}: its force may hold no velocity.`;
    if (turns()) {
      return `${title} turns the velocity about the field by a rotation, which is stable at any step. The axis shows its other half, oscillation in position alone, stable while hω is below ${brief(m.stability_limit, 3)}; `
        + 'the points hλ mix the two, and cannot be judged by it.';
    }
    const points = upper();
    if (points.length === 0) return `${ratesTrouble ? `No points: ${ratesTrouble}` : 'The model’s rates λ are being computed.'}${what}`;
    const largest = Math.max(...points.map((rate) => Math.hypot(rate.re, rate.im)));
    if (largest === 0) return `The force does not depend on the position: λ = 0, and every step is stable.${what}`;
    const own = points.filter((rate) => rate.re > 1e-9 * Math.hypot(rate.re, rate.im)).length;
    const parts: string[] = [];
    if (growth) {
      const tolerance = m.symplectic ? 1e-7 : 1e-12;
      let worst = -1;
      points.forEach((rate, k) => {
        const g = growth?.[k] ?? NaN;
        // λ = 0 moves evenly with every method: it says nothing.
        if (Math.hypot(rate.re, rate.im) > 1e-9 * largest && rate.re <= 1e-9 * Math.hypot(rate.re, rate.im) && !Number.isNaN(g) && (worst < 0 || g > growth![worst]!)) worst = k;
      });
      if (worst >= 0) {
        const g = growth[worst]!, z = points[worst]!, steps = scene?.solution.tracks[0]?.total ?? 0;
        const where = `hλ = ${complex(h * z.re, h * z.im)}`;
        if (g > 1 + tolerance) {
          const all = g ** steps;
          parts.push(`Largest growth per step ${growthText(g)}, at ${where}: unstable.${steps > 0 ? ` Over ${steps} steps that is a factor of ${Number.isFinite(all) ? brief(all, 3) : 'more than 10³⁰⁸'}.` : ''}`);
        } else if (g >= 1 - tolerance) parts.push(`No growth: ${where} lies on the boundary, as it should for an oscillation without friction.`);
        else if (Math.abs(z.re) <= 1e-9 * Math.hypot(z.re, z.im)) parts.push(`All points are inside. ${title} itself damps: it multiplies by ${growthText(g)} a step at ${where}, where nothing is lost in truth.`);
        else parts.push(`All points are inside; largest growth per step ${growthText(g)}, at ${where}, where the exact motion has ${growthText(Math.exp(h * z.re))}.`);
      }
      if (points.every((rate) => Math.abs(rate.re) <= 1e-9 * largest) && Number.isFinite(m.stability_limit) && m.stability_limit > 0) parts.push(`Steps below ${brief(m.stability_limit / largest, 3)} are stable.`);
    }
    if (own) parts.push('Points to the right of the axis: there the motion itself grows, whatever the method.');
    return `${parts.join(' ')}${what}`.trim();
  }

  const shown = figure({
    id: 'stability', title: 'Stability', aspect: 0.78, draw, overlay,
    summary: () => minus(sentence()),
    table: () => {
      const h = step(), points = upper();
      return {
        head: ['time', 'Re λ', 'Im λ', 'Re hλ', 'Im hλ', 'growth per step'],
        rows: points.map((rate, k) => [rate.time, rate.re, rate.im, h * rate.re, h * rate.im, turns() ? NaN : growth?.[k] ?? NaN]),
        note: `${scene?.looks[0]?.label ?? ''}, h = ${h}. Of each pair of conjugate rates the upper one is listed.`,
      };
    },
  });

  function say(): void {
    shown.say(trouble || (plane ? '' : 'Asking where the method is stable …'));
    shown.redraw();
  }

  return {
    id: 'stability', title: 'Stability', element: shown.element,
    show(next) {
      scene = next;
      void wantPlane();
      wantRates();
      wantGrowth();
      shown.redraw();
    },
    at(time) { now = time; shown.redrawOverlay(); },
    redraw() { shade = null; shown.redraw(); },
  };
};

/** A colour with that much opacity, for cells, which have none of their own. */
function mixed(colour: string, alpha: number): string {
  const hex = /^#([0-9a-f]{6})$/i.exec(colour);
  return hex ? `${colour}${Math.round(255 * alpha).toString(16).padStart(2, '0')}` : `color-mix(in srgb, ${colour} ${100 * alpha}%, transparent)`;
}
