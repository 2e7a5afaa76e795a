/* The motions of the gallery, in its order: theme, the methods each is shown with, and what its picture shows.
 *
 * Data alone: whoever teaches may add a row for a model of models/; what is said of it stands in words/. An address names a scene by its model, so
 * `model` stays. A row without a theme has no card in the gallery; another scene leads to it.
 */
import type { Section } from './scene';
import { words } from './words';
import type { SceneWords } from './words/scene';

/** Two columns of the model, as a trajectory file names them: drawn across and up. Of a shape: "i" and a family. */
export type Curve = readonly [across: string, up: string];

export interface Picture {
  /** plane: a path, in equal units. time: against t. phase: the velocity against the place. shape: a family against its index, at some times. */
  readonly view: 'plane' | 'time' | 'phase' | 'shape';
  /** One for each body that moves. */
  readonly curves: readonly Curve[];
  /** Equal units across and up in a phase plane, too. */
  readonly equal?: boolean;

  // Of the small picture in the gallery alone.
  /** Another start. */
  readonly start?: Readonly<Record<string, string>>;
  /** Its end, where the model's own is too far. */
  readonly until?: number;
  /** Methods drawn beside the exact motion, and their step where it is not the model's. */
  readonly methods?: readonly string[];
  readonly step?: number;
  /** The frame is that of the exact motion, so many times as large, and cuts the methods off; without it, it holds all that is drawn. */
  readonly frame?: number;
  /** A dashed grey line to compare with: the first curve, of that model with these numbers. */
  readonly beside?: { readonly model: string; readonly curve: Curve; readonly set?: Readonly<Record<string, string>>; readonly until?: number };
  /** Bodies at rest. */
  readonly rests?: readonly (readonly [across: number, up: number, radius: number])[];
  /** The moving bodies are drawn where they are at this time. */
  readonly at?: number;
  /** Rods from (0, 0) to these places one after the other, at that time. */
  readonly rods?: readonly Curve[];
  /** Of a shape: the first is drawn in full. */
  readonly times?: readonly number[];
  /** Of a shape: what is held fixed beyond its first and its last member. */
  readonly ends?: readonly [number, number];
}

/** The themes, in their order. */
export const themes = ['first', 'oscillators', 'events', 'sky', 'fields', 'chaos'] as const;
export type Theme = (typeof themes)[number];

export interface SceneEntry {
  readonly model: string; readonly theme: Theme | ''; readonly methods: readonly string[];
  /** Numbers of the model that this scene replaces, and its end. */
  readonly set?: Readonly<Record<string, string>>;
  readonly until?: string;
  /** The section that stands first below it. */
  readonly section?: Section;
  readonly picture: Picture;
}


export const scenes: readonly SceneEntry[] = [
  {
    model: 'thrown-ball', theme: 'first',
    methods: ['explicit-euler', 'symplectic-euler', 'midpoint'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], methods: ['explicit-euler', 'symplectic-euler'], at: 2 },
  },
  {
    model: 'projectile', theme: 'first',
    methods: ['explicit-euler', 'symplectic-euler', 'midpoint'],
    picture: { view: 'time', curves: [['t', 'r.y']], methods: ['explicit-euler', 'symplectic-euler'] },
  },
  {
    model: 'projectile-drag', theme: 'first',
    methods: ['explicit-euler', 'midpoint', 'verlet'], until: '5.87',
    picture: { view: 'plane', curves: [['r.x', 'r.y']], until: 5.8723, beside: { model: 'projectile', curve: ['r.x', 'r.y'], set: { "r'(0)": '(30, 40)' }, until: 8.155 } },
  },
  {
    model: 'spring', theme: 'first',
    methods: ['explicit-euler', 'symplectic-euler', 'verlet'],
    picture: { view: 'phase', curves: [['x', "x'"]], methods: ['explicit-euler', 'symplectic-euler'], equal: true, until: 12.6, step: 0.3, frame: 1.3 },
  },
  {
    model: 'damped-spring', theme: 'first',
    methods: ['verlet', 'explicit-euler'],
    picture: { view: 'time', curves: [['t', 'x']], until: 17 },
  },

  {
    model: 'pendulum', theme: 'oscillators',
    methods: ['explicit-euler', 'velocity-verlet'],
    picture: { view: 'time', curves: [['t', 'theta']], until: 19, beside: { model: 'spring', curve: ['t', 'x'], set: { 'x(0)': '2' }, until: 19 } },
  },
  {
    model: 'resonance', theme: 'oscillators',
    methods: ['verlet', 'explicit-euler'],
    picture: { view: 'time', curves: [['t', 'x']] },
  },
  {
    model: 'driven-oscillator', theme: 'oscillators',
    methods: ['verlet'],
    picture: { view: 'time', curves: [['t', 'x']] },
  },
  {
    model: 'damped-cubic', theme: 'oscillators',
    methods: ['verlet'],
    picture: { view: 'phase', curves: [['x', "x'"]], until: 6 },
  },
  {
    model: 'van-der-pol', theme: 'oscillators',
    methods: ['rk4', 'verlet'],
    picture: { view: 'phase', curves: [['x', "x'"]], start: { 'x(0)': '0.1' }, until: 22 },
  },

  {
    model: 'bouncing-ball', theme: 'events',
    methods: ['verlet'],
    picture: { view: 'time', curves: [['t', 'y']] },
  },
  {
    model: 'newtons-cradle', theme: 'events',
    methods: ['verlet'],
    picture: { view: 'plane', curves: [['x[1]', 't'], ['x[2]', 't'], ['x[3]', 't'], ['x[4]', 't']], at: 0 },
  },
  {
    model: 'billiard', theme: 'events',
    methods: ['verlet'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], until: 40 },
  },
  {
    model: 'stick-slip', theme: 'events',
    methods: ['dop853', 'taylor'],
    picture: { view: 'phase', curves: [['x', "x'"]], until: 14 },
  },
  {
    model: 'kicked-rotor', theme: 'events',
    methods: ['verlet'],
    section: { when: 'kick', plane: ['x mod 2 pi', "x' mod 2 pi"], starts: [[3.14, 0.6], [3.14, 1.9], [0.6, 3.14], [1.3, 3.8], [3, 3.14], [4, 5.1]] },
    picture: { view: 'time', curves: [['t', 'x']], until: 40 },
  },

  {
    model: 'kepler', theme: 'sky',
    methods: ['symplectic-euler', 'velocity-verlet', 'kahan-li8'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], methods: ['symplectic-euler'], step: 0.0628318530717958648, until: 6.3, rests: [[0, 0, 4.5]], at: 3.1415927 },
  },
  {
    model: 'comet', theme: 'sky',
    methods: ['explicit-euler', 'velocity-verlet', 'kahan-li8'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], methods: ['explicit-euler'], frame: 1, rests: [[0, 0, 3.5]], at: 0 },
  },
  {
    model: 'arenstorf', theme: 'sky',
    methods: ['gauss8'],
    picture: { view: 'plane', curves: [['x', 'y']], rests: [[-0.012277471, 0, 4.5], [0.987722529, 0, 2.5]] },
  },
  {
    model: 'outer-solar-system', theme: 'sky',
    methods: ['kahan-li8', 'velocity-verlet'],
    picture: {
      view: 'plane', curves: [['r[2].x', 'r[2].y'], ['r[3].x', 'r[3].y'], ['r[4].x', 'r[4].y'], ['r[5].x', 'r[5].y'], ['r[6].x', 'r[6].y']],
      until: 90600, rests: [[0, 0, 2.5]],
    },
  },

  {
    model: 'three-body-figure-eight', theme: 'fields',
    methods: ['kahan-li6', 'velocity-verlet'],
    picture: { view: 'plane', curves: [['r[1].x', 'r[1].y'], ['r[2].x', 'r[2].y'], ['r[3].x', 'r[3].y']], until: 6.32591398 / 3, at: 0.5 },
  },
  {
    model: 'chain', theme: 'fields',
    methods: ['velocity-verlet'],
    picture: { view: 'shape', curves: [['i', 'x[i]']], times: [0, 12, 15, 18, 33], ends: [0, 0] },
  },

  {
    model: 'charged-particle', theme: 'fields',
    methods: ['explicit-euler', 'rk4', 'boris'], set: { E: '(0, 0, 0)' },
    picture: { view: 'plane', curves: [['r.x', 'r.y']], methods: ['explicit-euler'], until: 6.5 },
  },
  {
    model: 'crossed-fields', theme: 'fields',
    methods: ['explicit-euler', 'boris'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']] },
  },
  {
    model: 'penning-trap', theme: 'fields',
    methods: ['boris', 'rk4'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], until: 32 },
  },

  {
    model: 'double-pendulum', theme: 'chaos',
    methods: ['gauss6', 'rk4'],
    picture: { view: 'plane', curves: [['x2', 'y2']], until: 6, at: 6, rods: [['x1', 'y1'], ['x2', 'y2']] },
  },
  {
    model: 'duffing', theme: 'chaos',
    methods: ['verlet', 'rk4'],
    picture: { view: 'phase', curves: [['x', "x'"]], until: 70 },
  },
  {
    model: 'henon-heiles', theme: 'chaos',
    methods: ['pefrl', 'velocity-verlet'], section: { when: 'x = 0 rising', plane: ['y', "y'"], starts: [] },
    picture: { view: 'plane', curves: [['x', 'y']] },
  },
  {
    model: 'ueda', theme: 'chaos',
    methods: ['rk4', 'verlet'], section: { when: 'every 2 pi', plane: ['x', "x'"], starts: [] },
    picture: { view: 'phase', curves: [['x', "x'"]], until: 60 },
  },

  {
    model: 'thrown-ball-air', theme: '',
    methods: ['explicit-euler', 'midpoint', 'verlet'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], methods: ['explicit-euler'], beside: { model: 'thrown-ball', curve: ['r.x', 'r.y'] } },
  },
];

export const sceneOf = (model: string): SceneEntry | undefined => scenes.find(scene => scene.model === model);
/** What is said of it. */
export const saidOf = (model: string): SceneWords | undefined => (Object.hasOwn(words.scenes, model) ? words.scenes[model] : undefined);
