/* A step part by part: each event of a trace as the formula it stands for, with all digits of the numbers that it took and gave.
 *
 * Invariant: every number is one that the core told; nothing is computed anew.
 */
import { brief } from '../../figure/number';
import type { Trace, TraceEntry } from '../../protocol';
import { words } from '../../words';

export interface Formula { readonly symbols: string; readonly numbers: string }
export interface Told { readonly title: string; readonly note: string; readonly formulas: readonly Formula[] }

const told = words.opened.part;
const DIGITS = 6;
const SUBSCRIPTS = '₀₁₂₃₄₅₆₇₈₉';
export const sub = (n: number): string => String(n).replace(/\d/g, d => SUBSCRIPTS[Number(d)]!);

type Write = (value: number) => string;
const shortly: Write = value => brief(value, DIGITS);
const wholly: Write = value => String(value).replace(/-/g, '−');
/* Negative factors and terms stand in brackets, as one writes them by hand. */
const bracketed = (text: string): string => text.startsWith('−') ? `(${text})` : text;

/** 1/6 rather than 0.166667 where a coefficient is such a fraction. */
function coefficient(c: number, write: Write): string {
  for (const d of [1, 2, 3, 4, 6, 8, 12])
    if (Math.abs(c * d - Math.round(c * d)) < 1e-13 && Math.abs(c) <= 16) {
      const n = Math.round(c * d);
      return `${n < 0 ? '−' : ''}${Math.abs(n)}${d > 1 ? `/${d}` : ''}`;
    }
  return write(c);
}

/** r'.y -> r''.y */
const accelerationName = (velocity: string): string => velocity.includes("'") ? velocity.replace("'", "''") : `${velocity}'`;

function formula(symbols: string, of: (write: Write) => string): Formula {
  return { symbols, numbers: of(wholly) };
}

/* c1 y1 + c2 y2 + …, without the terms that are zero; in brackets where it is more than one term. */
function weighted(weights: readonly number[], values: readonly number[], write: Write): string {
  const terms = weights.map((c, j) => c === 0 ? '' : `${c === 1 ? '' : `${bracketed(coefficient(c, write))} · `}${bracketed(write(values[j]!))}`).filter(Boolean);
  return terms.length > 1 ? `(${terms.join(' + ')})` : terms[0] ?? '';
}
function weightedNames(weights: readonly number[], name: string): string {
  const terms = weights.map((c, j) => c === 0 ? '' : `${c === 1 ? '' : `${bracketed(coefficient(c, shortly))} `}${name}${sub(j + 1)}`).filter(Boolean);
  return terms.length > 1 || terms[0]?.includes(' ') ? `(${terms.join(' + ')})` : terms[0] ?? '';
}
/* + ½ h …, − 0.2 h …: a coefficient with its sign, as it follows another term. */
function signed(c: number): string {
  const size = coefficient(Math.abs(c), shortly);
  return `${c < 0 ? '−' : '+'} ${size === '1' ? '' : `${size} `}`;
}

/* Where a kick takes the acceleration; of an implicit kick also what solving it took. */
function kickNote(e: TraceEntry, before: TraceEntry, byVelocity: boolean): string {
  if (!byVelocity) return told.kickNote(shortly(e.time));
  const turns = e.iterations - before.iterations;
  return told.implicitNote(shortly(e.time), turns);
}

/** What event `at` of a trace does to the numbers with these indices. byVelocity: the force depends on the velocity. */
export function tell(trace: Trace, at: number, indices: readonly number[], byVelocity: boolean): Told {
  const e = trace.entries[at]!, start = trace.entries[0]!, before = trace.entries[at - 1] ?? start;
  const h = e.step, x = (k: number): string => trace.names.x[k] ?? `x${sub(k + 1)}`, v = (k: number): string => trace.names.v[k] ?? `v${sub(k + 1)}`;
  const a = (k: number): string => accelerationName(v(k));
  const stages = trace.entries.filter(s => s.kind === 'stage');
  const each = (make: (k: number) => Formula[]): Formula[] => indices.flatMap(make);
  const state = (of: TraceEntry): Formula[] => each(k => [formula('', w => `${x(k)} = ${w(of.x[k]!)},  ${v(k)} = ${w(of.v[k]!)}`)]);

  switch (e.kind) {
    case 'start':
      return { title: told.startTitle(shortly(e.time)), note: '', formulas: state(e) };
    case 'kick':
      return {
        title: byVelocity ? told.implicitKick : told.kick, note: kickNote(e, before, byVelocity),
        formulas: each(k => [formula(`${v(k)} ← ${v(k)} ${signed(e.coefficient)}h ${a(k)}`,
          w => `${v(k)} ← ${w(before.v[k]!)} + ${bracketed(coefficient(e.coefficient, w))} · ${bracketed(w(h))} · ${bracketed(w(e.a?.[k] ?? NaN))} = ${w(e.v[k]!)}`)]),
      };
    case 'drift':
      return {
        title: told.drift, note: told.driftNote(shortly(e.time)),
        formulas: each(k => [formula(`${x(k)} ← ${x(k)} ${signed(e.coefficient)}h ${v(k)}`,
          w => `${x(k)} ← ${w(before.x[k]!)} + ${bracketed(coefficient(e.coefficient, w))} · ${bracketed(w(h))} · ${bracketed(w(e.v[k]!))} = ${w(e.x[k]!)}`)]),
      };
    case 'solve':
      return { title: told.solve, note: told.solveNote(e.iterations), formulas: [] };
    case 'stage': {
      const i = sub(e.stage), row = e.row ?? [], first = row.every(c => c === 0);
      return {
        title: told.stage(e.stage, stages.length), note: told.stageNote(shortly(e.time), e.coefficient === 0),
        formulas: each(k => [
          positionAt(e, k, `${x(k)}${i}`),
          formula(first ? '' : `${v(k)}${i} = ${v(k)}₀ + h ${weightedNames(row, a(k))}`,
            w => `${v(k)}${i} = ${first ? `${v(k)}₀ = ` : ''}${w(start.v[k]!)}${first ? '' : ` + ${bracketed(w(h))} · ${weighted(row, stages.map(s => s.a?.[k] ?? NaN), w)} = ${w(e.v[k]!)}`}`),
          formula('', w => `${a(k)}${i} = ${w(e.a?.[k] ?? NaN)}`),
        ]),
      };
    }
    case 'taylor':
      return {
        title: told.taylor, note: told.taylorNote,
        formulas: each(k => [formula(`${x(k)} ← ${x(k)} + h ${v(k)} + ½ h² ${a(k)}`,
          w => `${x(k)} ← ${w(start.x[k]!)} + ${bracketed(w(h))} · ${bracketed(w(start.v[k]!))} + 1/2 · ${bracketed(w(h))}² · ${bracketed(w(e.a?.[k] ?? NaN))} = ${w(e.x[k]!)}`)]),
      };
    case 'step':
      if (e.before_x) return {
        title: told.recurrence, note: told.recurrenceNote,
        formulas: each(k => [formula(`${x(k)} ← 2 ${x(k)} − ${x(k)}₋ + h² ${a(k)}`,
          w => `${x(k)} ← 2 · ${bracketed(w(start.x[k]!))} − ${bracketed(w(e.before_x?.[k] ?? NaN))} + ${bracketed(w(h))}² · ${bracketed(w(e.a?.[k] ?? NaN))} = ${w(e.x[k]!)}`)]),
      };
      return {
        title: told.position, note: told.positionNote,
        formulas: each(k => [formula(`${x(k)} ← ${x(k)} + h ${v(k)} + h²/6 (4 ${a(k)} − ${a(k)}₋)`,
          w => `${x(k)} ← ${w(start.x[k]!)} + ${bracketed(w(h))} · ${bracketed(w(start.v[k]!))} + ${bracketed(w(h))}²/6 · (4 · ${bracketed(w(e.a?.[k] ?? NaN))} − ${bracketed(w(e.before_a?.[k] ?? NaN))}) = ${w(e.x[k]!)}`)]),
      };
    case 'end': return { title: told.endTitle(shortly(e.time)), ...ending() };
  }

  function positionAt(s: TraceEntry, k: number, name: string): Formula {
    const row = s.row ?? [], rowX = s.row_x ?? [];
    if (row.every(c => c === 0) && rowX.every(c => c === 0) && s.coefficient === 0) return formula('', w => `${name} = ${x(k)}₀ = ${w(s.x[k]!)}`);
    if (usable(row, stages.map(q => q.v[k]!), start.x[k]!, s.x[k]!))
      return formula(`${name} = ${x(k)}₀ + h ${weightedNames(row, v(k))}`,
        w => `${name} = ${w(start.x[k]!)} + ${bracketed(w(h))} · ${weighted(row, stages.map(q => q.v[k]!), w)} = ${w(s.x[k]!)}`);
    return nystrom(name, s.coefficient, rowX, k, s.x[k]!);
  }
  /* The form with velocities, where it is the one that gives the number told; else the form with accelerations alone. */
  function usable(weights: readonly number[], values: readonly number[], from: number, to: number): boolean {
    let sum = 0, size = Math.abs(from) + Math.abs(to);
    weights.forEach((c, j) => { const term = h * c * (values[j] ?? NaN); if (c !== 0) { sum += term; size += Math.abs(term); } });
    return weights.some(c => c !== 0) && Math.abs(from + sum - to) <= 1e-9 * size;
  }
  function nystrom(name: string, node: number, weights: readonly number[], k: number, to: number): Formula {
    const some = weights.some(c => c !== 0);
    return formula(`${name} = ${x(k)}₀ + ${node === 1 ? '' : `${coefficient(node, shortly)} `}h ${v(k)}₀${some ? ` + h² ${weightedNames(weights, a(k))}` : ''}`,
      w => `${name} = ${w(start.x[k]!)} + ${bracketed(coefficient(node, w))} · ${bracketed(w(h))} · ${bracketed(w(start.v[k]!))}`
        + `${some ? ` + ${bracketed(w(h))}² · ${weighted(weights, stages.map(q => q.a?.[k] ?? NaN), w)}` : ''} = ${w(to)}`);
  }
  function ending(): { note: string; formulas: readonly Formula[] } {
    if (stages.length > 0) {
      const weights = stages.map(s => s.weight), weightsX = stages.map(s => s.weight_x);
      return {
        note: told.slopes(stages.length),
        formulas: each(k => [
          usable(weights, stages.map(s => s.v[k]!), start.x[k]!, e.x[k]!)
            ? formula(`${x(k)} ← ${x(k)}₀ + h ${weightedNames(weights, v(k))}`,
              w => `${x(k)} ← ${w(start.x[k]!)} + ${bracketed(w(h))} · ${weighted(weights, stages.map(s => s.v[k]!), w)} = ${w(e.x[k]!)}`)
            : nystrom(x(k), 1, weightsX, k, e.x[k]!),
          formula(`${v(k)} ← ${v(k)}₀ + h ${weightedNames(weights, a(k))}`,
            w => `${v(k)} ← ${w(start.v[k]!)} + ${bracketed(w(h))} · ${weighted(weights, stages.map(s => s.a?.[k] ?? NaN), w)} = ${w(e.v[k]!)}`),
        ]),
      };
    }
    if (before.kind === 'step' && !before.before_x) return {
      note: told.velocityNote,
      formulas: each(k => [formula(`${v(k)} ← ${v(k)} + h/6 (2 ${a(k)}₁ + 5 ${a(k)} − ${a(k)}₋)`,
        w => `${v(k)} ← ${w(start.v[k]!)} + ${bracketed(w(h))}/6 · (2 · ${bracketed(w(e.a?.[k] ?? NaN))} + 5 · ${bracketed(w(before.a?.[k] ?? NaN))} − ${bracketed(w(before.before_a?.[k] ?? NaN))}) = ${w(e.v[k]!)}`)]),
    };
    if (before.kind === 'step' || before.kind === 'taylor') return {
      note: told.meanNote,
      formulas: each(k => [formula(`${v(k)} = (${x(k)}₁ − ${x(k)}₀)/h + ½ h ${a(k)}₁`,
        w => `${v(k)} = ${w(before.v[k]!)} + 1/2 · ${bracketed(w(h))} · ${bracketed(w(e.a?.[k] ?? NaN))} = ${w(e.v[k]!)}`)]),
    };
    return { note: '', formulas: state(e) };
  }
}
