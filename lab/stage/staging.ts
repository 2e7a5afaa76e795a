/* How each example stands on the stage: its sentence, its question, what is drawn beside the motion, the sliders in the dock, units.
 *
 * Invariant: data only. A model without an entry is staged by what the core says of it (stageOf); nothing here is needed to see a motion.
 */

/** A slider of the dock: a parameter or an initial value, `part` its component from 0; low, high: where the slider ends. */
export interface Dial { readonly name: string; readonly part?: number; readonly label: string; readonly unit?: string; readonly low?: number; readonly high?: number }
export type Decor = 'throw' | 'spring' | 'pendulum';
export interface Staging {
  /** One or two sentences under the title; {steps} becomes the number of steps. */
  readonly words: string;
  /** The question, and the lesson that answers it. */
  readonly ask?: { readonly text: string; readonly lesson: string };
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
  readonly switch?: { readonly label: string; readonly to: string; readonly on: boolean };
  /** The largest stop of the step slider, as a multiple of the model's step, and how many there are. */
  readonly stops?: readonly [largest: number, count: number];
  /** How high a number lies is told as "too high", "too low". */
  readonly upright?: boolean;
}

const metres = { x: 'm', t: 's', v: 'm/s' };

export const stagings: Readonly<Record<string, Staging>> = {
  'thrown-ball': {
    words: 'Green is how it really flies. The others are a computer’s answers, {steps} straight steps each.',
    ask: { text: 'Why do the two Eulers miss?', lesson: 'too-high-too-low' },
    decor: 'throw', frame: { x: [-0.7, 12.8], y: [0, 8] }, equal: true, units: metres, arrow: 0.29, upright: true, stops: [2, 6],
    dials: [{ name: "r'(0)", part: 1, label: 'Upwards', unit: 'm/s', low: 0, high: 16 }, { name: "r'(0)", part: 0, label: 'Sideways', unit: 'm/s', low: 0, high: 12 }],
    switch: { label: 'Air', to: 'thrown-ball-air', on: false },
  },
  'thrown-ball-air': {
    words: 'Air slows a light ball more than a heavy one. No formula is known for this flight: green is computed with steps so small that the line would not change.',
    ask: { text: 'Does midpoint still hit?', lesson: 'look-ahead' },
    decor: 'throw', frame: { x: [-0.7, 12.8], y: [0, 8] }, equal: true, units: metres, arrow: 0.29, upright: true, stops: [2, 6],
    dials: [{ name: "r'(0)", part: 1, label: 'Upwards', unit: 'm/s', low: 0, high: 16 }, { name: "r'(0)", part: 0, label: 'Sideways', unit: 'm/s', low: 0, high: 12 },
      { name: 'm', label: 'Mass', unit: 'kg', low: 0.01, high: 2 }],
    switch: { label: 'Air', to: 'thrown-ball', on: true },
  },
  'projectile': {
    words: 'The first example of the page that this one grew from, with its numbers: after three seconds the Eulers are 0.7357 above and below.',
    ask: { text: 'Are sixty small steps enough?', lesson: 'straight-steps' },
    equal: false, units: metres, arrow: 0.2, upright: true,
    dials: [{ name: 'g', part: 1, label: 'Gravity', unit: 'm/s²', low: -20, high: 0 }, { name: 'm', label: 'Mass', unit: 'kg', low: 0.1, high: 10 },
      { name: "r'(0)", part: 1, label: 'Upwards', unit: 'm/s', low: 0, high: 10 }],
  },
  'spring': {
    words: 'On the left against time, on the right how fast against how far. Both share one height.',
    ask: { text: 'Who gains energy, and why?', lesson: 'energy' }, decor: 'spring', units: metres, frame: { y: [-1.9, 1.9] },
    dials: [{ name: 'k', label: 'Stiffness', unit: 'N/m', low: 0.1, high: 4 }, { name: 'm', label: 'Mass', unit: 'kg', low: 0.1, high: 4 }],
  },
};
const plain: Staging = { words: '' };
export const stagingOf = (name: string): Staging => (Object.hasOwn(stagings, name) ? stagings[name] ?? plain : plain);
