/* How far one motion is from another: the distance of each body, and of several that of the furthest.
 *
 * Invariant: the parts of a vector, and scalars named x, y and z alike, are one body, whose distance is Euclid's; any other number is a body of its own, whose
 * distance is the absolute difference.
 */
export interface Body { readonly label: string; readonly parts: readonly number[] }

/** Of the positions, by their names: r.x and r.y; r[3].x and r[3].y; x2 and y2. */
export function bodiesOf(names: readonly string[]): Body[] {
  const out = new Map<string, number[]>(), all = new Set(names);
  names.forEach((name, k) => {
    const [, letter = '', rest = ''] = /^([xyz])([\p{L}\p{N}_]*)$/u.exec(name) ?? [], place = letter && all.has(`x${rest}`) && all.has(`y${rest}`), dot = name.lastIndexOf('.');
    const label = place ? `.${rest}` : dot > 0 ? name.slice(0, dot) : name;
    out.set(label, [...out.get(label) ?? [], k]);
  });
  return [...out].map(([label, parts]) => ({ label: label.replace(/^\./, ''), parts }));
}

/** At each of so many rows; which: the number of the furthest body. */
export function distances(rows: number, bodies: readonly Body[], apart: (row: number, part: number) => number): { readonly far: Float64Array; readonly which: Float64Array } {
  const far = new Float64Array(bodies.length ? rows : 0), which = new Float64Array(far.length);
  for (let i = 0; i < far.length; i++) bodies.forEach(({ parts }, b) => {
    const size = parts.length === 1 ? Math.abs(apart(i, parts[0]!)) : Math.hypot(...parts.map((k) => apart(i, k)));
    // What is no number is furthest.
    if (!Number.isNaN(far[i]) && !(size <= far[i]!)) { far[i] = size; which[i] = b; }
  });
  return { far, which };
}

/** The first body that does not nearly rest, by how far each moves: the parts' columns over the run. */
export function firstMoving(bodies: readonly (readonly (ArrayLike<number> | undefined)[])[]): number {
  const reach = bodies.map((columns) => Math.hypot(...columns.map((column) => {
    let low = Infinity, high = -Infinity;
    for (const v of Array.from(column ?? [])) if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
    return high > low ? high - low : 0;
  }))), most = Math.max(...reach);
  return Math.max(0, reach.findIndex((r) => r > 0 && r >= most / RESTS));
}
/** One that moves so many times less than the one that moves most rests nearly. */
const RESTS = 50;
