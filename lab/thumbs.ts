/* The small pictures of the gallery, drawn when the page is built: each scene is computed by the page's module and drawn by its pen.
 *
 * Invariant: a curve is off the motion by less than a pixel, its corners are whole tenths of one, and colours are custom properties of the page.
 */
import { Answers } from './answers';
import { Core } from './core';
import { looksOf, named } from './figure/ink';
import { svgPen } from './figure/svg';
import type { Track } from './protocol';
import { scenes, type Curve, type Picture, type SceneEntry } from './scenes';

/** A moving body: the path of the picture that it runs along, how far along it is at equal times, in thousandths, and where it is drawn at rest. */
export interface Runner { readonly path: number; readonly pace: readonly number[]; readonly rest: readonly [x: number, y: number] | null }
export interface Thumb { readonly svg: string; readonly runners: readonly Runner[] }

/** In CSS pixels; the pictures' own unit is a tenth of one, so that whole numbers suffice. */
export const size = { width: 188, height: 104 };
const TENTHS = 10, MARGIN = 12, SLACK = 0.15;
const DASH = [5, 3];
const dashed = new Set(['explicit-euler']);

type Points = { readonly x: Float64Array; readonly y: Float64Array };
interface Box { left: number; right: number; bottom: number; top: number }

const record = (set: Readonly<Record<string, string>> = {}): string[] => Object.entries(set).map(([name, value]) => `${name}=${value}`);

class Studio {
  private readonly answers: Answers;
  constructor(module: WebAssembly.Module, private readonly texts: ReadonlyMap<string, string>) { this.answers = new Answers(new Core(module)); }

  /** The columns along a run. Without a method: the exact motion, or a method of order 8, in steps short enough for a picture. */
  run(model: string, set: Readonly<Record<string, string>> | undefined, columns: readonly string[], until?: number, method?: string, step?: number): Track {
    const question = { model: { text: this.texts.get(model) ?? '', set: record(set) }, columns, rows: 4001, truth: false };
    const { settings, has_exact, methods } = this.answers.answer('describe', { model: question.model });
    const end = until ?? settings.until ?? 1, span = Math.abs(end - settings.start);
    const admitted = methods.find(m => m.name === 'kahan-li8')?.admitted ? 'kahan-li8' : 'gauss8';
    const fine = Math.min(settings.step ?? span, span / 2000);
    const { tracks: [track] } = this.answers.answer('solve', { ...question, until: end, methods: [method ?? (has_exact ? 'exact' : admitted)], step: method ? step ?? null : fine, tolerance: null });
    if (!track || track.times.length < 2) throw new Error(`${model} cannot be drawn: ${track?.problem?.message ?? 'no motion'}`);
    return track;
  }
  names(model: string, family: string): string[] {
    const { columns } = this.answers.answer('describe', { model: { text: this.texts.get(model) ?? '', set: [] } });
    const [before = '', after = ''] = family.split('[i]');
    return columns.map(c => c.name).filter(name => name.startsWith(`${before}[`) && name.endsWith(`]${after}`));
  }
}

/** The columns that some curves need, each once. */
const columnsOf = (curves: readonly Curve[]): string[] => [...new Set(curves.flat())];
function points(track: Track, columns: readonly string[], [across, up]: Curve): Points {
  const column = (name: string): Float64Array => track.columns[columns.indexOf(name)] ?? new Float64Array(0);
  return { x: column(across), y: column(up) };
}

function boxOf(curves: readonly Points[], widen = 1): Box {
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (const { x, y } of curves) x.forEach((across, i) => {
    const up = y[i] ?? NaN;
    if (!Number.isFinite(across + up)) return;
    box.left = Math.min(box.left, across), box.right = Math.max(box.right, across), box.bottom = Math.min(box.bottom, up), box.top = Math.max(box.top, up);
  });
  const dx = (widen - 1) * (box.right - box.left) / 2, dy = (widen - 1) * (box.top - box.bottom) / 2;
  return { left: box.left - dx, right: box.right + dx, bottom: box.bottom - dy, top: box.top + dy };
}

/** From numbers to tenths of a pixel; equal: the same unit across and up. */
function scales(box: Box, equal: boolean): (points: Points) => Float64Array {
  const width = size.width - 2 * MARGIN, height = size.height - 2 * MARGIN;
  let sx = width / (box.right - box.left), sy = height / (box.top - box.bottom);
  if (equal) sx = sy = Math.min(sx, sy);
  const cx = (box.left + box.right) / 2, cy = (box.bottom + box.top) / 2;
  return ({ x, y }) => {
    const out = new Float64Array(2 * x.length);
    x.forEach((across, i) => {
      out[2 * i] = TENTHS * (size.width / 2 + sx * (across - cx));
      out[2 * i + 1] = TENTHS * (size.height / 2 - sy * ((y[i] ?? NaN) - cy));
    });
    return out;
  };
}

/** The part of a line up to where it leaves the picture by more than a little; the lines that leave it do not come back. */
function within(xy: Float64Array): Float64Array {
  const far = 200;
  const out = xy.findIndex((value, i) => !(value > -far && value < TENTHS * (i % 2 ? size.height : size.width) + far));
  return out < 0 ? xy : xy.subarray(0, out - (out % 2) + 2);
}

/** The fewest of the points that keep the line within the slack, in whole numbers (Douglas and Peucker). */
function simplified(xy: Float64Array): number[] {
  const n = xy.length / 2, keep = new Uint8Array(n);
  keep[0] = keep[n - 1] = 1;
  const parts: [number, number][] = [[0, n - 1]];
  for (let part = parts.pop(); part; part = parts.pop()) {
    const [a, b] = part, ax = xy[2 * a]!, ay = xy[2 * a + 1]!, dx = xy[2 * b]! - ax, dy = xy[2 * b + 1]! - ay, length = Math.hypot(dx, dy);
    let worst = SLACK * TENTHS, at = -1;
    for (let i = a + 1; i < b; i++) {
      const px = xy[2 * i]! - ax, py = xy[2 * i + 1]! - ay;
      const along = length > 0 ? (px * dx + py * dy) / length : 0;
      const off = along < 0 || length === 0 ? Math.hypot(px, py) : along > length ? Math.hypot(px - dx, py - dy) : Math.abs(px * dy - py * dx) / length;
      if (off > worst) worst = off, at = i;
    }
    if (at > 0) keep[at] = 1, parts.push([a, at], [at, b]);
  }
  const out: number[] = [];
  for (let i = 0; i < n; i++) if (keep[i]) out.push(Math.round(xy[2 * i]!), Math.round(xy[2 * i + 1]!));
  return out;
}

/** The length of a line up to each of its points. */
function alongOf(xy: Float64Array): Float64Array {
  const along = new Float64Array(xy.length / 2);
  for (let i = 1; i < along.length; i++) along[i] = along[i - 1]! + Math.hypot(xy[2 * i]! - xy[2 * i - 2]!, xy[2 * i + 1]! - xy[2 * i - 1]!);
  return along;
}

/** How far along the line the body is at equal times, in thousandths; one value for each 15 pixels or so. */
function paceOf(xy: Float64Array): number[] {
  const along = alongOf(xy), last = along.length - 1, whole = along[last] || 1, count = Math.max(8, Math.min(100, Math.round(whole / 150)));
  return Array.from({ length: count + 1 }, (_, k) => Math.round(1000 * along[Math.round(k * last / count)]! / whole));
}

/** A path in whole numbers, each relative to the one before: half as long. */
function relative(svg: string): string {
  return svg.replace(/ d="(M[^"]*)"/g, (_, d: string) => {
    let x = 0, y = 0, first = true;
    const parts = [...d.matchAll(/[ML](-?\d+) (-?\d+)/g)].map(([all, a, b]) => {
      const dx = Number(a) - x, dy = Number(b) - y, move = all.startsWith('M');
      x += dx, y += dy;
      const text = `${move ? (first ? 'M' : 'm') : ''}${dx}${dy < 0 ? '' : ' '}${dy}`;
      first = false;
      return move ? `${text}l` : text;
    });
    return ` d="${parts.join(' ').replace(/l /g, 'l').replace(/ -/g, '-')}${d.endsWith('Z') ? 'z' : ''}"`;
  });
}

/** A shape: the members of a family side by side, at some times. */
function shape(studio: Studio, scene: SceneEntry, picture: Picture): Points[] {
  const names = studio.names(scene.model, picture.curves[0]?.[1] ?? ''), times = picture.times ?? [0];
  const track = studio.run(scene.model, scene.set, names, Math.max(...times, 1));
  return times.map(time => {
    const i = track.times.findIndex(t => t >= time);
    const y = names.map((_, k) => track.columns[k]?.[i] ?? NaN), [first, last] = picture.ends ?? [];
    if (first !== undefined) y.unshift(first);
    if (last !== undefined) y.push(last);
    return { x: Float64Array.from(y.keys()), y: Float64Array.from(y) };
  });
}

function draw(studio: Studio, scene: SceneEntry): Thumb {
  const { picture } = scene, { curves } = picture, set = { ...scene.set, ...picture.start }, still = picture.view === 'shape';
  const columns = columnsOf([...curves, ...(picture.rods ?? [])]);
  const track = still ? null : studio.run(scene.model, set, columns, picture.until);
  const exact = track ? curves.map(curve => points(track, columns, curve)) : shape(studio, scene, picture);
  const others = (picture.methods ?? []).map(method => {
    const drawn = studio.run(scene.model, set, columns, picture.until, method, picture.step);
    return { method, lines: curves.map(curve => points(drawn, columns, curve)) };
  });
  const { beside } = picture;
  const aside = beside ? [points(studio.run(beside.model, beside.set, columnsOf([beside.curve]), beside.until), columnsOf([beside.curve]), beside.curve)] : [];
  const rests = (picture.rests ?? []).map(([x, y]) => ({ x: Float64Array.of(x), y: Float64Array.of(y) }));
  const now = track ? Math.max(0, track.times.findIndex(t => t >= (picture.at ?? 0) - 1e-9)) : 0;
  const rods = track && picture.rods ? [{
    x: Float64Array.of(0, ...picture.rods.map(rod => points(track, columns, rod).x[now] ?? NaN)), y: Float64Array.of(0, ...picture.rods.map(rod => points(track, columns, rod).y[now] ?? NaN)),
  }] : [];
  const framed = picture.frame ? exact : [...exact, ...others.flatMap(o => o.lines), ...aside];
  const to = scales(boxOf([...framed, ...rests, ...rods], picture.frame), picture.view === 'plane' || picture.equal === true);

  const pen = svgPen(TENTHS * size.width, TENTHS * size.height);
  let paths = 0;
  const line = (xy: Float64Array, colour: string, width: number, dash?: readonly number[], alpha?: number): void => {
    pen.line(simplified(within(xy)), { colour, width: TENTHS * width, dash: dash?.map(d => TENTHS * d), alpha });
    paths++;
  };
  for (const points of aside) line(to(points), 'var(--ghost, var(--axis))', 1.4, DASH);
  for (const { method, lines } of others) for (const points of lines) line(to(points), looksOf([method], [], named)[0]!.colour, 1.4, dashed.has(method) ? DASH : undefined);
  const drawn = exact.map(to), most = Math.max(...drawn.map(xy => alongOf(xy).at(-1) ?? 0)) / TENTHS;
  // A long line fills the picture: thinner, or it is a patch.
  const width = most > 1500 ? 1.1 : most > 700 || curves.length > 3 ? 1.5 : 2, later = still ? { alpha: 0.5, width: 1.2 } : { width };
  const runners: Runner[] = [];
  drawn.forEach((xy, k) => {
    if (!still) runners.push({ path: paths, pace: paceOf(xy), rest: picture.at === undefined ? null : [Math.round(xy[2 * now]!), Math.round(xy[2 * now + 1]!)] });
    line(xy, 'var(--exact)', k ? later.width : width, undefined, k ? later.alpha : undefined);
  });
  for (const points of rods) line(to(points), 'var(--quiet)', 2);
  (picture.rests ?? []).forEach(([, , radius], k) => {
    const [x = 0, y = 0] = to(rests[k]!);
    pen.mark('circle', Math.round(x), Math.round(y), TENTHS * radius, 'var(--quiet)');
  });
  const inside = pen.svg().replace(/^<svg[^>]*>/, '').replace(/<\/svg>\s*$/, '').replace(/\n/g, '').replaceAll(' stroke-linejoin="round"', '').replaceAll(' fill="none"', '');
  return { svg: relative(inside), runners };
}

export function thumbnails(module: WebAssembly.Module, models: readonly { readonly name: string; readonly text: string }[]): Record<string, Thumb> {
  const studio = new Studio(module, new Map(models.map(({ name, text }) => [name, text])));
  return Object.fromEntries(scenes.map(scene => [scene.model, draw(studio, scene)]));
}
