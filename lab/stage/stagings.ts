/* How each example stands on the stage. Data alone, packed beside the scripts by the build (data.ts): whoever teaches or translates may edit the words. */
import type { Staging } from './staging';

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
    words: 'The first example of the notebook, with its numbers: after three seconds the Eulers are 0.7357 m above and below.',
    ask: { text: 'Are sixty small steps enough?', lesson: 'straight-steps' },
    equal: false, units: metres, arrow: 0.2, upright: true,
    dials: [{ name: 'g', part: 1, label: 'Gravity', unit: 'm/s²', low: -20, high: 0 }, { name: 'm', label: 'Mass', unit: 'kg', low: 0.1, high: 10 },
      { name: "r'(0)", part: 1, label: 'Upwards', unit: 'm/s', low: 0, high: 10 }],
  },
  'projectile-drag': {
    words: 'Thrown hard, a light ball goes up in a curve and comes down in a steeper one.',
    ask: { text: 'Where did the symmetry go?', lesson: 'look-ahead' },
    units: metres, dials: [{ name: 'm', label: 'Mass', unit: 'kg', low: 0.01, high: 2 }, { name: 'c', label: 'Drag', unit: 'kg/m', low: 0, high: 0.005 }, { name: "r'(0)", part: 1, label: 'Upwards', unit: 'm/s', low: 0, high: 60 }],
  },
  'spring': {
    words: 'On the left against time, on the right how fast against how far. Both share one height.',
    ask: { text: 'Who gains energy, and why?', lesson: 'energy' }, decor: 'spring', units: metres, frame: { y: [-1.9, 1.9] },
    dials: [{ name: 'k', label: 'Stiffness', unit: 'N/m', low: 0.1, high: 4 }, { name: 'm', label: 'Mass', unit: 'kg', low: 0.1, high: 4 }, { name: 'x(0)', label: 'Start', unit: 'm', low: -2, high: 2 }],
  },
  'damped-spring': {
    words: 'Each swing loses the same share of what is left. Give it a periodic push: it answers at the frequency of the push.',
    ask: { text: 'Can Verlet feel friction?', lesson: 'verlets-trick' },
    dials: [{ name: 'gamma', label: 'Friction', low: 0, high: 2 }, { name: 'F', label: 'Push', low: 0, high: 2 }, { name: 'omega', label: 'Its frequency', low: 0, high: 4 }],
  },
  'pendulum': {
    words: 'Let go far from the vertical, it takes a third longer for a swing than a small one does.', decor: 'pendulum',
    dials: [{ name: 'theta(0)', label: 'Start angle', low: -3.14, high: 3.14 }, { name: "theta'(0)", label: 'Start speed', low: -3, high: 3 }],
  },
  'resonance': {
    words: 'A push of a fiftieth of a newton, always at the right moment.', units: metres,
    dials: [{ name: 'F', label: 'Push', unit: 'N', low: 0, high: 0.2 }, { name: 'k', label: 'Stiffness', unit: 'N/m', low: 0.1, high: 4 }],
  },
  'driven-oscillator': {
    words: 'The second example of the notebook: a spring that softens, driven at the frequency of its small swings.',
    dials: [{ name: 'F', label: 'Drive', low: 0, high: 0.2 }, { name: 'x(0)', label: 'Start', low: -0.9, high: 0.9 }, { name: "x'(0)", label: 'Start speed', low: -0.7, high: 0.7 }],
  },
  'damped-cubic': {
    words: 'The third example of the notebook: a spring that hardens, with friction, which Verlet solves for in closed form.',
    ask: { text: 'Can Verlet feel friction?', lesson: 'verlets-trick' },
    dials: [{ name: 'x(0)', label: 'Start', low: -20, high: 20 }, { name: "x'(0)", label: 'Start speed', low: -50, high: 50 }],
  },
  'van-der-pol': {
    words: 'It feeds itself while it is small and brakes while it is large, so every start ends on one curve.',
    dials: [{ name: 'mu', label: 'Feeding', low: 0, high: 10 }, { name: 'x(0)', label: 'Start', low: -4, high: 4 }, { name: "x'(0)", label: 'Start speed', low: -4, high: 4 }],
  },
  'kepler': {
    words: 'A planet and its sun. The ellipse should close, turn after turn.', rests: [[0, 0, 10]],
    ask: { text: 'Who keeps the energy?', lesson: 'energy' }, dials: [{ name: 'e', label: 'Eccentricity', low: 0, high: 0.95 }, { name: 'mu', label: 'Mass of the sun', low: 0.1, high: 2 }],
  },
  'comet': {
    words: 'Halley’s comet: seventy-five years, and close to the Sun a few days that decide.', rests: [[0, 0, 8]], units: { x: 'au', t: 'years', v: 'au/year' },
    dials: [{ name: 'e', label: 'Eccentricity', low: 0.5, high: 0.99 }],
  },
  'arenstorf': {
    words: 'A satellite between Earth and Moon, seen from a frame that turns with them. Its orbit closes, if it is computed well.', rests: [[-0.012277471, 0, 10], [0.987722529, 0, 5]],
    dials: [{ name: 'x(0)', label: 'Start', low: 0.9, high: 1.1 }, { name: "y'(0)", label: 'Start speed', low: -2.2, high: -1.8 }],
  },
  'outer-solar-system': { words: 'Jupiter, Saturn, Uranus, Neptune and Pluto, for five hundred years.', units: { x: 'au', t: 'days', v: 'au/day' }, dials: [{ name: 'G', label: 'Gravity', low: 2e-4, high: 4e-4 }] },
  'three-body-figure-eight': { words: 'Three equal masses chase each other along one curve.', dials: [] },
  'chain': {
    words: 'A chain of springs that stiffen, started in its longest wave. Green is its shape now.',
    dials: [{ name: 'beta', label: 'Stiffening', low: 0, high: 2 }, { name: 'A', label: 'Amplitude', low: 0, high: 2 }, { name: 'N', label: 'Masses', low: 3, high: 64 }],
  },
  'charged-particle': {
    words: 'A charge in a magnetic field: it can only turn. Boris’ method turns the velocity by a rotation.',
    dials: [{ name: 'B', part: 2, label: 'Field', low: 0, high: 5 }, { name: 'E', part: 0, label: 'Electric field', low: -1, high: 1 }, { name: 'q', label: 'Charge', low: -2, high: 2 }],
  },
  'crossed-fields': {
    words: 'An electron in an electric and a magnetic field at right angles: it drifts across both.', units: { x: 'mm', t: 'ns', v: 'mm/ns' },
    dials: [{ name: 'B', label: 'Magnetic field', unit: 'mT', low: 0.2, high: 3 }, { name: 'E', part: 1, label: 'Electric field', unit: 'V/mm', low: -2, high: 2 }],
  },
  'penning-trap': {
    words: 'A fast circle, an oscillation along the axis, and a slow circle between them.',
    dials: [{ name: 'wc', label: 'Magnetic field', low: 3, high: 20 }, { name: 'wz', label: 'Electric field', low: 0.5, high: 5 }],
  },
  'double-pendulum': {
    words: 'Green is the lower of two masses. Two starts that differ by a hair part within seconds.', rods: [['x1', 'y1'], ['x2', 'y2']],
    dials: [{ name: 'θ1(0)', label: 'Upper angle', low: -3.14, high: 3.14 }, { name: 'θ2(0)', label: 'Lower angle', low: -3.14, high: 3.14 }],
  },
  'duffing': {
    words: 'Two valleys and a push. It hops between them, and nobody can say when.',
    dials: [{ name: 'F', label: 'Push', low: 0, high: 1 }, { name: 'd', label: 'Friction', low: 0, high: 1 }, { name: 'x(0)', label: 'Start', low: -2, high: 2 }],
  },
  'henon-heiles': {
    words: 'A star in the field of its galaxy. Below an energy of 1/12 its orbit is orderly, above 1/6 it may leave.',
    dials: [{ name: "x'(0)", label: 'Sideways', low: -0.5, high: 0.5 }, { name: 'y(0)', label: 'Start', low: -0.5, high: 0.5 }],
  },
  'ueda': {
    words: 'A hard spring, driven. Its motion never repeats, and yet it keeps to a shape.',
    dials: [{ name: 'B', label: 'Drive', low: 0, high: 15 }, { name: 'k', label: 'Friction', low: 0, high: 0.5 }, { name: 'x(0)', label: 'Start', low: -4, high: 4 }],
  },
};
