/* What a picture of a motion is made from, and what it is. */
import type { Ink, Pen } from '../figure/types';
import type { Bands } from '../panel/band';
import type { Scene } from '../scene';
import type { Bounds } from './bounds';
import type { Point } from './curves';
import type { Place } from './place';
import type { Camera } from './plot';
import type { Staging } from './staging';
import type { Subject } from './subject';

export interface Setting {
  readonly scene: Scene; readonly subject: Subject; readonly staging: Staging; readonly place: Place; readonly bounds: Bounds; readonly camera: Camera;
  /** A run to compare with, whose curves stay until they are let go. */
  readonly pinned: Scene | null;
  /** The picture before, whose curves stay as ghosts. */
  readonly before: Picture | null;
  /** Bars of error along the runs; absent: none are drawn. */
  readonly bars?: Bands;
}
/** A ring that sets the initial velocity: its pixels, and pixels of a unit of velocity. */
export interface Handle { readonly x: number; readonly y: number; readonly fromX: number; readonly fromY: number; readonly unit: number }
export interface Leaving { readonly name: string; readonly says: string; readonly more: string; readonly colour: string; readonly x: number; readonly y: number; readonly time: number; readonly anchor: 'start' | 'end' }
export interface Picture {
  /** finished: nothing is to come (`over`), so it need not be drawn. */
  still(pen: Pen, ink: Ink, finished?: boolean): void;
  moving(pen: Pen, ink: Ink, time: number): void;
  ghost(pen: Pen, ink: Ink): void;
  /** Whether all motions have come to their ends by then. */
  over(time: number): boolean;
  readonly handle: Handle | null;
  /** Where the exact motion ends, in pixels. */
  readonly end: Point | null;
  readonly leaving: readonly Leaving[];
  /** Sentences for those who do not see it. */
  remarks(): string[];
}
