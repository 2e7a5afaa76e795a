/* The motions of the gallery, in its order: title, question, theme, the methods each is shown with, and what its picture shows.
 *
 * Data alone: whoever teaches or translates may edit the words here, and add a row for a model of models/. An address names a scene by its model, so
 * `model` stays. A row without a theme has no card in the gallery; another scene leads to it.
 */

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

export interface SceneEntry {
  readonly model: string; readonly title: string; readonly theme: string; readonly question: string;
  readonly methods: readonly string[];
  /** Numbers of the model that this scene replaces. */
  readonly set?: Readonly<Record<string, string>>;
  readonly picture: Picture;
}

/** The themes, in their order. */
export const themes = ['First steps', 'Oscillators', 'In the sky', 'Many bodies, magnetic fields', 'Chaos'] as const;

export const scenes: readonly SceneEntry[] = [
  {
    model: 'thrown-ball', title: 'A thrown ball', theme: 'First steps', question: 'Why do the two Eulers miss?',
    methods: ['explicit-euler', 'symplectic-euler', 'midpoint'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], methods: ['explicit-euler', 'symplectic-euler'], at: 2 },
  },
  {
    model: 'projectile', title: 'Notebook, first example', theme: 'First steps', question: 'Are sixty small steps enough?',
    methods: ['explicit-euler', 'symplectic-euler', 'midpoint'],
    picture: { view: 'time', curves: [['t', 'r.y']], methods: ['explicit-euler', 'symplectic-euler'] },
  },
  {
    model: 'projectile-drag', title: 'Ball in air', theme: 'First steps', question: 'Where did the symmetry go?',
    methods: ['explicit-euler', 'midpoint', 'verlet'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], until: 5.8723, beside: { model: 'projectile', curve: ['r.x', 'r.y'], set: { "r'(0)": '(30, 40)' }, until: 8.155 } },
  },
  {
    model: 'spring', title: 'Mass on a spring', theme: 'First steps', question: 'Why does the blue one stay?',
    methods: ['explicit-euler', 'symplectic-euler', 'verlet'],
    picture: { view: 'phase', curves: [['x', "x'"]], methods: ['explicit-euler', 'symplectic-euler'], equal: true, until: 12.6, step: 0.3, frame: 1.3 },
  },
  {
    model: 'damped-spring', title: 'Spring with friction', theme: 'First steps', question: 'What does each swing lose?',
    methods: ['verlet', 'explicit-euler'],
    picture: { view: 'time', curves: [['t', 'x']], until: 17 },
  },

  {
    model: 'pendulum', title: 'Pendulum', theme: 'Oscillators', question: 'Why is a wide swing slower?',
    methods: ['explicit-euler', 'velocity-verlet'],
    picture: { view: 'time', curves: [['t', 'theta']], until: 19, beside: { model: 'spring', curve: ['t', 'x'], set: { 'x(0)': '2' }, until: 19 } },
  },
  {
    model: 'resonance', title: 'Resonance', theme: 'Oscillators', question: 'How far do small pushes go?',
    methods: ['verlet', 'explicit-euler'],
    picture: { view: 'time', curves: [['t', 'x']] },
  },
  {
    model: 'driven-oscillator', title: 'Driven, not quite linear', theme: 'Oscillators', question: 'Why does it swell and fade?',
    methods: ['verlet'],
    picture: { view: 'time', curves: [['t', 'x']] },
  },
  {
    model: 'damped-cubic', title: 'Cubic spring, braked', theme: 'Oscillators', question: 'Does friction spoil Verlet?',
    methods: ['verlet'],
    picture: { view: 'phase', curves: [['x', "x'"]], until: 6 },
  },
  {
    model: 'van-der-pol', title: 'Van der Pol', theme: 'Oscillators', question: 'Why do all starts end alike?',
    methods: ['rk4', 'verlet'],
    picture: { view: 'phase', curves: [['x', "x'"]], start: { 'x(0)': '0.1' }, until: 22 },
  },

  {
    model: 'kepler', title: 'Planet', theme: 'In the sky', question: 'Does the ellipse close?',
    methods: ['symplectic-euler', 'velocity-verlet', 'kahan-li8'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], methods: ['symplectic-euler'], step: 0.0628318530717958648, until: 6.3, rests: [[0, 0, 4.5]], at: 3.1415927 },
  },
  {
    model: 'comet', title: 'Comet', theme: 'In the sky', question: 'What breaks close to the Sun?',
    methods: ['explicit-euler', 'velocity-verlet', 'kahan-li8'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], methods: ['explicit-euler'], frame: 1, rests: [[0, 0, 3.5]], at: 0 },
  },
  {
    model: 'arenstorf', title: 'Between Earth and Moon', theme: 'In the sky', question: 'How small an error loses it?',
    methods: ['gauss8'],
    picture: { view: 'plane', curves: [['x', 'y']], rests: [[-0.012277471, 0, 4.5], [0.987722529, 0, 2.5]] },
  },
  {
    model: 'outer-solar-system', title: 'Outer planets', theme: 'In the sky', question: 'Where are they in 500 years?',
    methods: ['kahan-li8', 'velocity-verlet'],
    picture: {
      view: 'plane', curves: [['r[2].x', 'r[2].y'], ['r[3].x', 'r[3].y'], ['r[4].x', 'r[4].y'], ['r[5].x', 'r[5].y'], ['r[6].x', 'r[6].y']],
      until: 90600, rests: [[0, 0, 2.5]],
    },
  },

  {
    model: 'three-body-figure-eight', title: 'Figure of eight', theme: 'Many bodies, magnetic fields', question: 'Can three bodies take turns?',
    methods: ['kahan-li6', 'velocity-verlet'],
    picture: { view: 'plane', curves: [['r[1].x', 'r[1].y'], ['r[2].x', 'r[2].y'], ['r[3].x', 'r[3].y']], until: 6.32591398 / 3, at: 0.5 },
  },
  {
    model: 'chain', title: 'Chain of springs', theme: 'Many bodies, magnetic fields', question: 'Where does the energy go?',
    methods: ['velocity-verlet'],
    picture: { view: 'shape', curves: [['i', 'x[i]']], times: [0, 12, 15, 18, 33], ends: [0, 0] },
  },

  {
    model: 'charged-particle', title: 'Charge in a magnet', theme: 'Many bodies, magnetic fields', question: 'Who keeps the circle round?',
    methods: ['explicit-euler', 'rk4', 'boris'], set: { E: '(0, 0, 0)' },
    picture: { view: 'plane', curves: [['r.x', 'r.y']], methods: ['explicit-euler'], until: 6.5 },
  },
  {
    model: 'crossed-fields', title: 'Crossed fields', theme: 'Many bodies, magnetic fields', question: 'Why does it drift sideways?',
    methods: ['explicit-euler', 'boris'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']] },
  },
  {
    model: 'penning-trap', title: 'Penning trap', theme: 'Many bodies, magnetic fields', question: 'What holds it in?',
    methods: ['boris', 'rk4'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], until: 32 },
  },

  {
    model: 'double-pendulum', title: 'Double pendulum', theme: 'Chaos', question: 'When do two starts part?',
    methods: ['gauss6', 'rk4'],
    picture: { view: 'plane', curves: [['x2', 'y2']], until: 6, at: 6, rods: [['x1', 'y1'], ['x2', 'y2']] },
  },
  {
    model: 'duffing', title: 'Duffing', theme: 'Chaos', question: 'Left or right next?',
    methods: ['verlet', 'rk4'],
    picture: { view: 'phase', curves: [['x', "x'"]], until: 70 },
  },
  {
    model: 'henon-heiles', title: 'Star in a galaxy', theme: 'Chaos', question: 'Where does order end?',
    methods: ['pefrl', 'velocity-verlet'],
    picture: { view: 'plane', curves: [['x', 'y']] },
  },
  {
    model: 'ueda', title: 'Ueda', theme: 'Chaos', question: 'Is there a pattern in it?',
    methods: ['rk4', 'verlet'],
    picture: { view: 'phase', curves: [['x', "x'"]], until: 60 },
  },

  {
    model: 'thrown-ball-air', title: 'A thrown ball, in air', theme: '', question: 'Does the air shorten the throw?',
    methods: ['explicit-euler', 'midpoint', 'verlet'],
    picture: { view: 'plane', curves: [['r.x', 'r.y']], methods: ['explicit-euler'], beside: { model: 'thrown-ball', curve: ['r.x', 'r.y'] } },
  },
];

export const sceneOf = (model: string): SceneEntry | undefined => scenes.find(scene => scene.model === model);
