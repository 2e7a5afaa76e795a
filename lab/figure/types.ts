/* What a figure is made of: a pen that draws on a canvas or writes SVG, colours of the theme, and a frame with name, summary, table and export.
 *
 * Invariant: a figure is drawn by one function, whatever it is drawn on; so what is exported is what is seen.
 */
import type { Marker } from '../scene';

export interface Stroke { readonly colour: string; readonly width: number; readonly dash?: readonly number[]; readonly alpha?: number }
export interface Lettering {
  readonly colour: string; readonly size?: number; readonly anchor?: 'start' | 'middle' | 'end';
  readonly baseline?: 'top' | 'middle' | 'bottom' | 'alphabetic'; readonly bold?: boolean; readonly italic?: boolean; readonly turn?: number;   // turn: degrees
  /** Colour of a rim about the letters, so that lines behind them do not make them hard to read. */
  readonly halo?: string;
}
/** A part of a text in a manner of its own; what is left out is the whole text's. */
export interface Span { readonly text: string; readonly colour?: string; readonly bold?: boolean; readonly italic?: boolean; readonly size?: number; readonly sunk?: number }   // sunk: pixels below the line
/** Lengths are CSS pixels; the origin is top left. */
export interface Pen {
  readonly width: number; readonly height: number;
  /** x0, y0, x1, y1, …; a NaN lifts the pen. count: numbers of xy to use. */
  line(xy: ArrayLike<number>, stroke: Stroke, count?: number): void;
  area(xy: ArrayLike<number>, fill: string, alpha?: number, count?: number): void;
  /** rim: the colour of an edge of 1.5 pixels about it, so that it stands off the lines behind. */
  mark(shape: Marker, x: number, y: number, radius: number, colour: string, how?: { readonly alpha?: number; readonly rim?: string }): void;
  arrow(x0: number, y0: number, x1: number, y1: number, stroke: Stroke): void;
  text(x: number, y: number, text: string | readonly Span[], lettering: Lettering): void;
  box(x: number, y: number, width: number, height: number, fill: string, alpha?: number): void;
  /** A grid of cells, row by row from the top, coloured by colours[cells[i]]; '' is left free. One image, not a thousand boxes. */
  cells(x: number, y: number, width: number, height: number, columns: number, rows: number, cells: Uint8Array, colours: readonly string[]): void;
  clip(x: number, y: number, width: number, height: number, inside: () => void): void;
}

/** The colours of the present theme, as CSS colours. ghost, figure: of what is there for comparison only. */
export type InkName = 'text' | 'quiet' | 'grid' | 'axis' | 'surface' | 'exact' | 'accent' | 'danger' | 'ghost' | 'figure';
export type Ink = Readonly<Record<InkName, string>>;

/** A sentence; with names of a model in it as spans, which stand as an equation sets them. */
export type Said = string | readonly Span[];
/** head: as a file has it; shown: as a reader sees it, where that differs. */
export interface Table { readonly head: readonly string[]; readonly shown?: readonly Said[]; readonly rows: readonly (readonly (string | number)[])[]; readonly note?: string }

export interface FigureDefinition {
  /** title: the short name, for saved files, the data table, links to the figure. */
  readonly id: string; readonly title: string | (() => string);
  /** What the picture answers: its heading. Absent: the title. */
  readonly question?: Said | (() => Said);
  /** The answer of this run in one sentence; '': none. Asked for once a scene, not once a frame. */
  answer?(): Said;
  /** Height over width where the page leaves the choice; height is bounded by the page. */
  readonly aspect?: number;
  /** Nor lower than this, in pixels; absent: what curves need. */
  readonly least?: number;
  draw(pen: Pen, ink: Ink): void;
  /** What moves with the time: on a layer of its own, above. */
  overlay?(pen: Pen, ink: Ink): void;
  /** Never higher than this part of the window. */
  readonly tallest?: number;
  /** Height beyond the aspect's, in pixels: a legend, more than one panel. */
  extra?(width: number): number;
  /** All that is seen, in sentences: for those who do not see it, and above the numbers. */
  summary(): string;
  table(): Table;
  /** Controls of the figure's own, above the picture. */
  readonly controls?: readonly HTMLElement[];
}
export interface Figure {
  readonly element: HTMLElement; readonly canvas: HTMLCanvasElement;
  /** The layer that moves, above the canvas; it takes no pointer. */
  readonly overlay: HTMLCanvasElement; readonly picture: HTMLElement;
  redraw(): void; redrawOverlay(): void;
  /** Why there is nothing to see yet, in the picture's place; '' brings the picture back. */
  say(message: string): void;
  /** Whether the figure is on the page: one that has no answer is not. Tells it by the event THERE. */
  there(on: boolean): void;
}

export interface AxisDefinition {
  readonly min: number; readonly max: number; readonly log?: boolean; readonly label: Said;
  /** Set behind the last number along, and behind the name of what goes up. */
  readonly unit?: string;
}
/** A mapping from numbers to pixels. */
export interface Scale { (value: number): number; invert(pixel: number): number; readonly ticks: readonly number[]; label(value: number): string }
export interface Frame { readonly x: Scale; readonly y: Scale; readonly left: number; readonly top: number; readonly width: number; readonly height: number }
