/* How an example stands on the stage: the lesson it leads to, what is drawn beside the motion, the sliders in the dock, units.
 *
 * Invariant: a model without an entry of stagings.ts is staged by what the core says of it; nothing here is needed to see a motion.
 */
/** A slider of the dock: a parameter or an initial value, `part` its component from 0; low, high: where the slider ends. */
export interface Dial { readonly name: string; readonly part?: number; readonly unit?: string; readonly low?: number; readonly high?: number }
export type BodyName = 'sun' | 'earth' | 'moon' | 'jupiter' | 'saturn' | 'uranus' | 'neptune' | 'pluto';
export type Decor = 'throw' | 'spring' | 'pendulum' | 'floor';
export interface Staging {
  /** The lesson that answers its question. */
  readonly ask?: string;
  /** The method that its question is about: while it is not shown, nothing is asked. */
  readonly about?: string;
  readonly decor?: Decor;
  /** What the frame shows, in the model's numbers; else the exact motion and some room. */
  readonly frame?: { readonly x?: readonly [number, number]; readonly y: readonly [number, number] };
  readonly equal?: boolean;
  /** Of lengths, of time, of velocities. */
  readonly units?: { readonly x: string; readonly t: string; readonly v: string };
  /** Seconds that the arrow of the initial velocity is long. */
  readonly arrow?: number;
  readonly dials?: readonly Dial[];
  /** A switch that goes to another example and keeps what both have. */
  readonly switch?: { readonly to: string; readonly on: boolean };
  /** The largest stop of the step slider, as a multiple of the model's step, and how many there are. */
  readonly stops?: readonly [largest: number, count: number];
  /** How high a number lies is told as "too high", "too low". */
  readonly upright?: boolean;
  /** Bodies at rest, with their radius in pixels, and their names. */
  readonly rests?: readonly (readonly [x: number, y: number, radius: number, name: BodyName])[];
  /** What moves, in the model's order. */
  readonly bodies?: readonly BodyName[];
  /** Walls that are circles. */
  readonly walls?: readonly (readonly [x: number, y: number, radius: number])[];
  /** A family of places on one line: balls, this parameter their diameter. */
  readonly balls?: string;
  /** Rods from (0, 0) to these places, one after the other. */
  readonly rods?: readonly (readonly [x: string, y: string])[];
}
