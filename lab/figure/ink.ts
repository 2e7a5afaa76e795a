/* Colours and line styles: those of the theme, and one look per method.
 *
 * Invariant: a method looks the same in every picture and every session; no two of the ten that are compared most share a colour, a marker or a
 * dash; no method is green, which is the exact motion's. Every colour has a contrast of 3:1 or more on both themes' surfaces.
 */
import type { Look, Marker } from '../scene';
import type { Method } from '../protocol';
import type { Ink } from './types';

const LIGHT: Ink = { text: '#1C1F23', quiet: '#5B626B', grid: '#E6E8EB', axis: '#8A929C', surface: '#FFFFFF', exact: '#15803D', accent: '#1D4ED8', danger: '#B42318' };
const DARK: Ink = { text: '#E8EAED', quiet: '#A3ABB5', grid: '#2A2F36', axis: '#69717C', surface: '#14171A', exact: '#4ADE80', accent: '#8AB4F8', danger: '#F97066' };

export function isDark(): boolean {
  const chosen = document.documentElement.dataset.theme;
  return chosen === 'dark' || (chosen !== 'light' && matchMedia('(prefers-color-scheme: dark)').matches);
}

/** The colours of the present theme; asked for once a drawing, not once a line, as the browser has to settle styles for it. */
export function ink(): Ink {
  const style = getComputedStyle(document.documentElement), otherwise = isDark() ? DARK : LIGHT;
  const of = (name: keyof Ink): string => style.getPropertyValue(`--${name}`).trim() || otherwise[name];
  return {
    text: of('text'), quiet: of('quiet'), grid: of('grid'), axis: of('axis'), surface: of('surface'),
    exact: of('exact'), accent: of('accent'), danger: of('danger'),
  };
}

/** Light and dark: chosen as far apart as possible from each other and from the green, also for those who do not tell red from green. */
const COLOURS: readonly (readonly [light: string, dark: string])[] = [
  ['#D9432E', '#FF8A3D'], ['#1F4FE0', '#3F86FF'], ['#B97800', '#FFDD57'], ['#7A1FC2', '#BBA4FF'], ['#0089C7', '#4FDDF7'],
  ['#E0359E', '#F985C3'], ['#0B4A63', '#E8F1F2'], ['#7A0F35', '#F4444F'], ['#6A4A14', '#9C8A66'], ['#1A1468', '#9A6BC9'],
];
const MARKERS: readonly Marker[] = ['circle', 'square', 'diamond', 'triangle', 'cross', 'down', 'plus', 'star', 'ring', 'bar'];
const DASHES: readonly (readonly number[])[] = [
  [7, 3], [], [9, 3, 2, 3], [2, 2.5], [14, 4], [9, 3, 2, 3, 2, 3], [5, 2], [3, 4], [14, 3, 4, 3], [10, 5, 4, 5, 4, 5],
];

/** In the order in which colours are handed out: the first ten all differ. Families that are compared among themselves stand side by side. A method
 * that is not here has the looks behind these: the list is made of those whose looks must not change any more. */
const ORDER: readonly string[] = [
  'explicit-euler', 'symplectic-euler', 'midpoint', 'verlet', 'rk4', 'velocity-verlet', 'leapfrog', 'forest-ruth', 'implicit-midpoint', 'gauss4',
  'heun', 'boris', 'pefrl', 'yoshida6', 'verlet-literal', 'beeman', 'gauss6', 'ralston', 'rk3', 'yoshida8',
  'symplectic-euler-adjoint', 'kahan-li6', 'ruth3', 'suzuki4', 'mclachlan4', 'newmark', 'kahan-li8', 'blanes-moan4', 'gauss8', 'rk4-38',
  'blanes-moan6', 'blanes-moan6-14',
];

function place(method: string, catalogue: readonly Method[]): number {
  const known = ORDER.indexOf(method);
  if (known >= 0) return known;
  // A method newer than this list: behind all of it, in the catalogue's order.
  const row = catalogue.filter((m) => !ORDER.includes(m.name) && m.name !== 'exact').findIndex((m) => m.name === method);
  return ORDER.length + Math.max(0, row);
}

/** The same scene in the colours of the present theme. */
export function recoloured<S extends { readonly looks: readonly Look[]; readonly catalogue: readonly Method[] }>(scene: S): S {
  return { ...scene, looks: looksOf(scene.looks.map((l) => l.method), scene.catalogue) };
}

export function looksOf(methods: readonly string[], catalogue: readonly Method[]): Look[] {
  const dark = isDark(), exact = ink().exact;
  return methods.map((name) => {
    // newmark(1/4, 1/2) looks like newmark.
    const bare = name.replace(/\s*\(.*$/, '');
    const row = catalogue.find((m) => m.name === bare || m.aliases.includes(bare)), method = row?.name ?? bare;
    const label = (row?.title ?? bare) + name.slice(bare.length);
    if (method === 'exact') return { method: name, label, colour: exact, dash: [], marker: 'circle' };
    const k = place(method, catalogue), round = Math.floor(k / 10);
    const pair = COLOURS[k % 10]!;
    return {
      method: name, label, colour: dark ? pair[1] : pair[0],
      // Each further ten meets its colour again with another dash and another marker.
      dash: DASHES[(k + 3 * round) % 10]!, marker: MARKERS[(k + 7 * round) % 10]!,
    };
  });
}
