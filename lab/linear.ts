/* One step of a method on a linear equation x'' = A x + B x', y' the same: how much it makes a start grow, at a step h.
 *
 * Invariant: the growth is that of the method's own steps, made by the core on the equation written out; of a method that the equation does not admit, or
 * whose state is more than x and x' in a way that two steps do not tell, it is NaN. Modes that do not act on each other are asked for one by one.
 */
import { EigenvalueDecomposition, Matrix, SVD, inverse } from 'ml-matrix';
import type { Core } from './core';
import type { Linear } from './protocol';
import { Refused } from './scene';

/** Numbers of one state that are asked for at once: they are uncoupled, but a text has to be read. */
const ROOM = 48;
/** More numbers that act on each other are not asked for. */
const COUPLED_MAX = 8;
/** What is zero next to the largest; a matrix of modes that is worse than this is none; two steps are the square of one up to this. */
const ZERO = 1e-9, SKEW = 1e4, FORGETFUL = 1e-6;

interface Block { readonly nx: number; readonly nv: number; readonly x: Matrix; readonly v: Matrix }

/** Parts that do not act on each other: single modes where the same directions belong to both matrices; else the whole. */
export function blocksOf({ nx, nv, x, v }: Linear): Block[] {
  const byX = Matrix.from1DArray(nv, nx, [...x]), byV = Matrix.from1DArray(nv, nv, [...v]), whole = { nx, nv, x: byX, v: byV };
  if (nx !== nv || nx === 0) return [whole];
  if (nx === 1) return [whole];
  const size = Math.max(Math.sqrt(byX.norm()), byV.norm()) || 1;
  // Of a sum with weights that no model has, so that different modes have different numbers.
  const mixed = new EigenvalueDecomposition(Matrix.add(Matrix.mul(byX, 1 / (size * size)), Matrix.mul(byV, 0.6180339887 / size)));
  if (mixed.imaginaryEigenvalues.some((im) => im !== 0)) return [whole];
  const modes = mixed.eigenvectorMatrix, { condition } = new SVD(modes);
  if (!(condition < SKEW)) return [whole];
  const back = inverse(modes), k = back.mmul(byX).mmul(modes), c = back.mmul(byV).mmul(modes);
  const off = (of: Matrix, most: number): boolean => of.to2DArray().some((row, i) => row.some((value, j) => i !== j && Math.abs(value) > 1e3 * ZERO * most));
  if (off(k, size * size) || off(c, size)) return [whole];
  return Array.from({ length: nx }, (_, i) => ({ nx: 1, nv: 1, x: new Matrix([[k.get(i, i)]]), v: new Matrix([[c.get(i, i)]]) }));
}

/** The largest absolute eigenvalue; of two numbers by their formula, which rounding does not part. */
function radius(m: Matrix): number {
  if (m.rows === 1) return Math.abs(m.get(0, 0));
  if (m.rows === 2) {
    const half = (m.get(0, 0) + m.get(1, 1)) / 2, apart = (m.get(0, 0) - m.get(1, 1)) / 2, square = apart * apart + m.get(0, 1) * m.get(1, 0);
    return square < 0 ? Math.sqrt(half * half - square) : Math.abs(half) + Math.sqrt(square);
  }
  const { realEigenvalues, imaginaryEigenvalues } = new EigenvalueDecomposition(m);
  return Math.max(...realEigenvalues.map((re, i) => Math.hypot(re, imaginaryEigenvalues[i]!)));
}

/** The matrix of a step from what one and two steps make of each unit start. */
function growthOf(one: Matrix, two: Matrix): number {
  if (![...one.to1DArray(), ...two.to1DArray()].every(Number.isFinite)) return Infinity;
  if (Matrix.sub(two, one.mmul(one)).norm() <= FORGETFUL * (1 + one.norm() ** 2)) return radius(one);
  try {
    return radius(two.mmul(inverse(one)));
  } catch {
    return NaN;
  }
}

const text = (value: number): string => `(${Object.is(value, -0) ? 0 : value})`;
/** The equation of one block at step h, with the time in steps, from each unit start; first: the number of its first name. */
function written({ nx, nv, x, v }: Block, h: number, first: number): string {
  const n = nx + nv, lines: string[] = [];
  for (let start = 0; start < n; start++) {
    const name = (i: number): string => `q${first + start * nv + i}`, rate = (i: number): string => (i < nx ? `${name(i)}'` : name(i));
    for (let i = 0; i < nv; i++) {
      // x'' takes h² of ∂a/∂x and h of ∂a/∂v; of first-order variables, and by them, once h less or more.
      const power = i < nx ? 1 : 0, terms: string[] = [];
      for (let k = 0; k < nx; k++) if (x.get(i, k)) terms.push(`${text(h ** (power + 1) * x.get(i, k))} ${name(k)}`);
      for (let k = 0; k < nv; k++) if (v.get(i, k)) terms.push(`${text(h ** (power + (k < nx ? 0 : 1)) * v.get(i, k))} ${rate(k)}`);
      lines.push(`${name(i)}${i < nx ? "''" : "'"} = ${terms.join(' + ') || '0'}`);
      if (i < nx) lines.push(`${name(i)}(0) = ${start === i ? 1 : 0}`, `${name(i)}'(0) = ${start === nx + i ? 1 : 0}`);
      else lines.push(`${name(i)}(0) = ${start === nx + i ? 1 : 0}`);
    }
  }
  return lines.join('\n');
}

interface Case { readonly block: Block; readonly h: number; readonly at: number }
/** Makes two steps of all cases at once; their growths into out, the largest of those with one place. */
function walk(core: Core, method: string, cases: readonly Case[], out: Float64Array): void {
  const lab = core.create();
  try {
    let first = 0;
    const texts = cases.map(({ block, h }) => { const at = first; first += (block.nx + block.nv) * block.nv; return written(block, h, at); });
    core.open(lab, { text: `${texts.join('\n')}\nstep 1\nuntil 2\n`, set: [] });
    core.start(lab, method, 1, 2);
    const names = core.describe(lab).columns.map((c) => c.name), place = new Map(names.map((name, k) => [name, k])), all = names.map((_, k) => k);
    const { values, rows } = core.record(lab, all, 1, 3, true), value = (row: number, name: string): number => (row < rows ? values[row * all.length + (place.get(name) ?? -1)] ?? NaN : Infinity);
    first = 0;
    for (const { block: { nx, nv }, at } of cases) {
      const n = nx + nv, begin = first;
      const after = (row: number): Matrix => new Matrix(Array.from({ length: n }, (_, i) => Array.from({ length: n }, (_, start) => {
        const id = begin + start * nv + (i < nx ? i : i - nx);
        return value(row, i >= nx && i - nx < nx ? `q${id}'` : `q${id}`);
      })));
      const now = growthOf(after(1), after(2));
      out[at] = Number.isNaN(now) || Number.isNaN(out[at]!) ? NaN : Math.max(out[at]!, now);
      first += n * nv;
    }
  } catch (reason) {
    if (!(reason instanceof Refused) || reason.problem.kind === 'memory') throw reason;
    for (const { at } of cases) out[at] = NaN;
  } finally {
    core.destroy(lab);
  }
}

/** growth[i · steps + j]: of moment i at its step j. */
export function growthsOf(core: Core, method: string, moments: readonly Linear[], steps: readonly (readonly number[])[]): Float64Array {
  const width = steps[0]?.length ?? 0, out = new Float64Array(moments.length * width);
  const waiting: Case[] = [];
  let room = 0;
  const make = (): void => { if (waiting.length) walk(core, method, waiting, out); waiting.length = room = 0; };
  moments.forEach((moment, i) => {
    const blocks = blocksOf(moment);
    steps[i]!.forEach((h, j) => {
      for (const block of blocks) {
        const n = block.nx + block.nv;
        if (n > COUPLED_MAX) { out[i * width + j] = NaN; continue; }
        if (room > 0 && room + n * block.nv > ROOM) make();
        waiting.push({ block, h, at: i * width + j });
        room += n * block.nv;
      }
    });
  });
  make();
  return out;
}
