/* Colours and line styles: those of the theme, and one look per method.
 *
 * Invariant: a method looks the same in every picture and every session; no two of the ten that are compared most share a colour, a marker or a
 * dash, nor do the first eight that choose their steps; no two methods share all three; no method is green, which is the exact motion's. Every colour has a contrast of 3:1 or more on both themes' surfaces.
 */
import type { Look, Marker } from '../scene';
import type { Method } from '../protocol';
import type { Ink } from './types';


/** All colours of the page: the build writes them into its style (inkStyle), and pictures read them there. */
const THEMES: Readonly<Record<'light' | 'dark', Ink>> = {
  light: {
    text: '#1C1F23', quiet: '#5B626B', grid: '#E6E8EB', axis: '#7E8792', surface: '#FFFFFF', exact: '#15803D', accent: '#1D4ED8', danger: '#B42318', ghost: '#B9BFC7', figure: '#D9DDE2',
  },
  dark: {
    text: '#E8EAED', quiet: '#A3ABB5', grid: '#262B31', axis: '#69717C', surface: '#0F1214', exact: '#4ADE80', accent: '#8AB4F8', danger: '#F97066', ghost: '#4A525C', figure: '#2E353C',
  },
};
/** Of what is no picture: the dock, fields and cards, edges. */
const GROUNDS = {
  light: { dock: '#F4F5F7', card: '#FFFFFF', edge: '#D5D9DE', 'danger-ground': '#FDF1EF', number: '#8A5A00', shade: '0 10px 40px rgb(20 25 35 / 14%)' },
  dark: { dock: '#171B1F', card: '#1B2025', edge: '#343B43', 'danger-ground': '#2A1917', number: '#FFDD57', shade: '0 10px 40px rgb(0 0 0 / 55%)' },
};

function isDark(): boolean {
  // Where the system forces its colours, its ground is the page's.
  const chosen = matchMedia('(forced-colors: active)').matches ? '' : document.documentElement.dataset.theme;
  return chosen === 'dark' || (chosen !== 'light' && matchMedia('(prefers-color-scheme: dark)').matches);
}

/** Light and dark, each of a line and of letters: lines have a contrast of 3:1 or more, letters of 4.5:1. Chosen as far apart as possible from each other
 * and from the green, also for those who do not tell red from green. */
type Tones = readonly [line: string, letters: string];
const COLOURS: readonly (readonly [light: Tones, dark: Tones])[] = [
  [['#D9432E', '#B93420'], ['#FF8A3D', '#FF8A3D']], [['#1F4FE0', '#1F4FE0'], ['#3F86FF', '#6FA5FF']], [['#B97800', '#8A5A00'], ['#FFDD57', '#FFDD57']],
  [['#7A1FC2', '#7A1FC2'], ['#BBA4FF', '#BBA4FF']], [['#0089C7', '#00699A'], ['#4FDDF7', '#4FDDF7']], [['#E0359E', '#B81F7C'], ['#F985C3', '#F985C3']],
  [['#0B4A63', '#0B4A63'], ['#E8F1F2', '#E8F1F2']], [['#7A0F35', '#7A0F35'], ['#F4444F', '#F75860']], [['#6A4A14', '#6A4A14'], ['#9C8A66', '#9C8A66']],
  [['#1A1468', '#1A1468'], ['#9A6BC9', '#A67DD0']], [['#111111', '#111111'], ['#C4457F', '#DB6BA0']], [['#3D6161', '#3D6161'], ['#FFFFB6', '#FFFFB6']],
  [['#491800', '#491800'], ['#CE2418', '#F0655B']],
];

/** The custom properties of a theme; of method k the line is --m<k>, the letters --m<k>t. */
function properties(theme: 'light' | 'dark'): string {
  const own = { ...THEMES[theme], ...GROUNDS[theme] }, dark = Number(theme === 'dark');
  return [`color-scheme:${theme}`, ...Object.entries(own).map(([name, value]) => `--${name}:${value}`),
    ...COLOURS.flatMap((pair, k) => [`--m${k}:${pair[dark]![0]}`, `--m${k}t:${pair[dark]![1]}`])].join(';');
}
export function inkStyle(): string {
  const dark = properties('dark');
  return `:root{${properties('light')}}:root[data-theme="dark"]{${dark}}@media(prefers-color-scheme:dark){:root:not([data-theme="light"]){${dark}}}\n`;
}

/** Where colours come from: the page's style, or the names of its properties for pictures that are made before there is a page. */
export interface Paint { readonly ink: Ink; method(k: number): Tones }
const NAMES = Object.keys(THEMES.light) as (keyof Ink)[];
export const named: Paint = {
  ink: Object.fromEntries(NAMES.map((name) => [name, `var(--${name})`])) as unknown as Ink,
  method: (k) => [`var(--m${k})`, `var(--m${k}t)`],
};
/** The colours of the present theme; asked for once a drawing, not once a line, as the browser has to settle styles for it. */
export function ink(): Ink {
  const style = getComputedStyle(document.documentElement), otherwise = THEMES[isDark() ? 'dark' : 'light'];
  return Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim() || otherwise[name]])) as unknown as Ink;
}
const present = (): Paint => { const dark = Number(isDark()); return { ink: ink(), method: (k) => COLOURS[k]![dark]! }; };

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
  'blanes-moan6', 'blanes-moan6-14', 'gauss10', 'gauss12', 'gauss14', 'gauss16', 'radau15-fixed',
];
/** The same of methods that choose their steps. They are compared with the five that come first above, and have none of their colours. */
const CHOOSING = {
  order: [
    'dopri5', 'dop853', 'dep12', 'radau15', 'dep6', 'tsit5', 'verner6', 'taylor', 'bs32', 'verner8', 'dep8', 'fine5', 'verner7', 'verner9', 'dep4', 'fine4',
    'verlet-reversible', 'blanes-moan4-reversible', 'blanes-moan6-reversible', 'kahan-li8-reversible',
    'gauss8-reversible', 'gauss12-reversible', 'gragg-stormer', 'gragg',
  ],
  colours: [10, 11, 12, 5, 9, 7, 6, 8],
};

/** A method newer than its list: behind all of it, in the catalogue's order. */
function place(method: string, order: readonly string[], rows: readonly Method[]): number {
  const known = order.indexOf(method);
  return known >= 0 ? known : order.length + Math.max(0, rows.filter((m) => !order.includes(m.name) && m.order !== 0).findIndex((m) => m.name === method));
}

/** Which colour, dash and marker: each further round of the colours meets them again with another dash and another marker. */
function partsOf(method: string, catalogue: readonly Method[]): { colour: number; dash: number; marker: number } {
  const adaptive = catalogue.find((m) => m.name === method)?.adaptive ?? false, rows = catalogue.filter((m) => Boolean(m.adaptive) === adaptive);
  const k = place(method, adaptive ? CHOOSING.order : ORDER, rows), round = Math.floor(k / (adaptive ? CHOOSING.colours.length : 10));
  return adaptive ? { colour: CHOOSING.colours[k % CHOOSING.colours.length]!, dash: (k + 4 * round + 4) % 10, marker: (k + 3 * round + 2) % 10 } : { colour: k % 10, dash: (k + 3 * round) % 10, marker: (k + 7 * round) % 10 };
}

/** The same scene in the colours of the present theme. */
export function recoloured<S extends { readonly looks: readonly Look[]; readonly catalogue: readonly Method[] }>(scene: S): S {
  return { ...scene, looks: looksOf(scene.looks.map((l) => l.method), scene.catalogue) };
}

export function looksOf(methods: readonly string[], catalogue: readonly Method[], paint: Paint = present()): Look[] {
  return methods.map((name) => {
    // newmark(1/4, 1/2) looks like newmark.
    const bare = name.replace(/\s*\(.*$/, '');
    const row = catalogue.find((m) => m.name === bare || m.aliases.includes(bare)), method = row?.name ?? bare;
    const label = (row?.title ?? bare) + name.slice(bare.length);
    if (method === 'exact') return { method: name, label, colour: paint.ink.exact, tone: paint.ink.exact, dash: [], marker: 'circle' };
    const { colour, dash, marker } = partsOf(method, catalogue), [line, tone] = paint.method(colour);
    return { method: name, label, colour: line, tone, dash: DASHES[dash]!, marker: MARKERS[marker]! };
  });
}
