/* What moves: read off the names and shapes of a solution's columns.
 *
 * Invariant: a subject names columns of the solution by their place, so a view never looks at names again. Every model has at least one view:
 * where nothing else can be said, each number is a curve in time.
 */
import type { Column, Description, Solution, Variable } from '../protocol';
import { nameText, timeName } from '../figure/name';
import { words } from '../words';

/** One point that moves: its coordinates, as places in solution.columns. */
export interface Body { readonly label: string; readonly columns: readonly number[] }
/** One way to look at the motion. plane, space: bodies of two or three coordinates; time: one coordinate; shape: the cells of a family. */
export interface Subject { readonly id: string; readonly kind: 'plane' | 'space' | 'time' | 'shape'; readonly label: string; readonly axes: readonly string[]; readonly bodies: readonly Body[];
  /** Its axes are numbers of different kinds, so each has its own scale. */
  readonly unlike?: boolean }

/* Longer lists of choices help nobody; so many variables have their pairs in them. */
const CHOICES = 24, PAIRED = 4;

/** The column of the velocity that belongs to a position: x -> x', r.x -> r'.x, r[3].x -> r[3]'.x. */
function velocityName(name: string): readonly string[] {
  const dot = name.lastIndexOf('.');
  if (dot > 0) return [`${name.slice(0, dot)}'${name.slice(dot)}`];
  const bracket = name.lastIndexOf('[');
  return bracket > 0 ? [`${name}'`, `${name.slice(0, bracket)}'${name.slice(bracket)}`] : [`${name}'`];
}

export function velocityColumn(solution: Solution, position: number): number {
  for (const name of velocityName(solution.columns[position] ?? '')) {
    const at = solution.columns.indexOf(name);
    if (at >= 0) return at;
  }
  return -1;
}
/** The columns of a body: places, and where there are such their velocities. */
export const numbersOf = (solution: Solution, { columns }: Pick<Body, 'columns'>): number[] => columns.flatMap((c) => [c, velocityColumn(solution, c)]);

interface Place { readonly column: Column; readonly at: number }

function places(description: Description, solution: Solution, kind: Column['kind']): Place[] {
  const found: Place[] = [];
  for (const column of description.columns) {
    if (column.kind !== kind) continue;
    const at = solution.columns.indexOf(column.name);
    if (at >= 0) found.push({ column, at });
  }
  return found;
}

/** r[3].x -> r[3]; r.x -> r. */
const bodyName = (name: string): string => name.includes('.') ? name.slice(0, name.lastIndexOf('.')) : name;

function vectorBodies(of: readonly Place[], variable: Variable): Body[] {
  const bodies: Body[] = [];
  for (let k = 0; k + variable.components <= of.length; k += variable.components) {
    const part = of.slice(k, k + variable.components);
    bodies.push({ label: bodyName(part[0]!.column.name), columns: part.map(p => p.at) });
  }
  return bodies;
}

/** Scalars called x and y, x2 and y2, …: the letters that textbooks keep for places. */
function lettered(given: readonly Place[]): Body[] {
  const byName = new Map(given.map(p => [p.column.name, p.at]));
  const bodies: Body[] = [];
  for (const { column, at } of given) {
    if (!/^x[\p{L}\p{N}_]*$/u.test(column.name)) continue;
    const rest = column.name.slice(1), y = byName.get(`y${rest}`), z = byName.get(`z${rest}`);
    if (y !== undefined) bodies.push({ label: rest ? words.stage.views.mass(rest) : '', columns: z === undefined ? [at, y] : [at, y, z] });
  }
  return bodies;
}

function planes(bodies: readonly Body[], names: readonly string[]): Subject[] {
  const dimensions = Math.min(...bodies.map(b => b.columns.length));
  const same = bodies.map(b => b.columns.slice(0, dimensions));
  const of = (id: string, kind: Subject['kind'], axes: readonly number[], label: string): Subject => ({
    id, kind, label, axes: axes.map(k => names[k]!), bodies: bodies.map((b, i) => ({ label: b.label, columns: axes.map(k => same[i]![k]!) })),
  });
  const plane = (id: string, across: number, up: number): Subject => of(id, 'plane', [across, up], words.stage.views.plane(partOf(names[across]!), partOf(names[up]!)));
  // Places have the letters x and y; other numbers are told by name.
  if (dimensions < 3) return [names.some((name) => /^[xy]\b|\.[xy]$/.test(name)) ? of('plane', 'plane', [0, 1], words.stage.views.path) : plane('plane', 0, 1)];
  return [
    of('space', 'space', [0, 1, 2], words.stage.views.space),
    plane('plane', 0, 1), plane('plane-xz', 0, 2), plane('plane-yz', 1, 2),
  ];
}

/** r.x -> x, as a choice between views names it. */
const partOf = (name: string): string => (name.includes('[') ? name : nameText(name.replace(/^.*\./, '')));

/* One body's axes are called as the model calls them; several share the letters. */
const axisNames = (bodies: readonly Body[], solution: Solution): readonly string[] =>
  bodies.length === 1 ? bodies[0]!.columns.map(c => solution.columns[c] ?? '') : ['x', 'y', 'z'];

/** The ways to look at a motion, the most telling one first. */
export function subjects(description: Description, solution: Solution): Subject[] {
  const positions = places(description, solution, 'position');
  const out: Subject[] = [];
  const bodies: Body[] = [], families: Subject[] = [], scalars: Place[] = [];
  description.variables.forEach((variable, k) => {
    if (variable.order !== 2) return;
    const of = positions.filter(p => p.column.variable === k);
    if (of.length === 0) return;
    if (variable.components === 2 || variable.components === 3) bodies.push(...vectorBodies(of, variable));
    else if (of.length > 2 && (variable.ranges.length > 0 || variable.components > 3))
      families.push({ id: `shape-${variable.name}`, kind: 'shape', label: words.stage.views.shape(nameText(variable.name)), axes: ['i', variable.name],
        bodies: [{ label: variable.name, columns: of.map(p => p.at) }] });
    else scalars.push(...of);
  });
  if (bodies.length > 0) out.push(...planes(bodies, axisNames(bodies, solution)));
  out.push(...families);
  const named = lettered(scalars);
  if (bodies.length === 0) {
    if (named.length > 0) out.push(...planes(named, axisNames(named, solution)));
    else {
      const seen = lettered(places(description, solution, 'quantity'));
      if (seen.length > 0) out.push(...planes(seen, axisNames(seen, solution)));
      if (scalars.length === 2 || scalars.length === 3) {
        const configuration = planes([{ label: '', columns: scalars.map(p => p.at) }], scalars.map(p => p.column.name));
        out.push(...configuration.map(s => ({ ...s, id: seen.length > 0 ? `configuration-${s.id}` : s.id })));
      }
    }
  }
  out.push(...inTime(positions, solution));
  if (out.length > 0) return out;
  // Of first order: letters of places are a path first, other numbers are curves in time first.
  const first = places(description, solution, 'first-order'), paths = pathsOf(first), times = inTime(first, solution);
  if (first.length > 0) return first.every(({ column }) => /^[xyz]$|\.[xyz]$/.test(column.name)) ? [...paths, ...times] : [...times, ...paths];
  return inTime(solution.columns.flatMap((name, at) => { const column = description.columns.find((c) => c.name === name && c.kind !== 'time'); return column ? [{ column, at }] : []; }), solution);
}

const inTime = (of: readonly Place[], solution: Solution): Subject[] => of.slice(0, CHOICES).map(({ column: { name }, at }) =>
  ({ id: `time-${name}`, kind: 'time', label: words.stage.views.time(partOf(name)), axes: [timeName(solution), name], bodies: [{ label: name, columns: [at] }] }));

/** Some first-order variables against one another: all three in space, each pair in its plane. */
function pathsOf(of: readonly Place[]): Subject[] {
  if (of.length < 2 || of.length > PAIRED) return [];
  const subject = (kind: 'plane' | 'space', label: string, chosen: readonly Place[]): Subject => {
    const axes = chosen.map(({ column }) => column.name);
    return { id: [kind, ...axes].join('-'), kind, label, axes, bodies: [{ label: '', columns: chosen.map((p) => p.at) }], unlike: true };
  };
  const pairs = of.flatMap((a, i) => of.slice(i + 1).map((b) => subject('plane', words.stage.views.plane(partOf(a.column.name), partOf(b.column.name)), [a, b])));
  return of.length === 3 ? [subject('space', words.stage.views.space, of), ...pairs] : pairs;
}
