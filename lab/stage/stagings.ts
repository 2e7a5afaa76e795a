/* How each example stands on the stage. Data alone, packed beside the scripts by the build (data.ts); what is said of it stands in words/. */
import type { Staging } from './staging';

const metres = { x: 'm', t: 's', v: 'm/s' };

export const stagings: Readonly<Record<string, Staging>> = {
  'thrown-ball': {
    ask: 'too-high-too-low', decor: 'throw', frame: { x: [-0.7, 12.8], y: [0, 8] }, equal: true, units: metres, arrow: 0.29, upright: true, stops: [2, 6],
    dials: [{ name: "r'(0)", part: 1, unit: 'm/s', low: 0, high: 16 }, { name: "r'(0)", part: 0, unit: 'm/s', low: 0, high: 12 }],
    switch: { to: 'thrown-ball-air', on: false },
  },
  'thrown-ball-air': {
    ask: 'look-ahead', decor: 'throw', frame: { x: [-0.7, 12.8], y: [0, 8] }, equal: true, units: metres, arrow: 0.29, upright: true, stops: [2, 6],
    dials: [{ name: "r'(0)", part: 1, unit: 'm/s', low: 0, high: 16 }, { name: "r'(0)", part: 0, unit: 'm/s', low: 0, high: 12 },
      { name: 'm', unit: 'kg', low: 0.01, high: 2 }],
    switch: { to: 'thrown-ball', on: true },
  },
  'projectile': {
    equal: false, units: metres, arrow: 0.2, upright: true,
    dials: [{ name: 'g', part: 1, unit: 'm/s²', low: -20, high: 0 }, { name: 'm', unit: 'kg', low: 0.1, high: 10 },
      { name: "r'(0)", part: 1, unit: 'm/s', low: 0, high: 10 }],
  },
  'projectile-drag': {
    units: metres, dials: [{ name: 'm', unit: 'kg', low: 0.01, high: 2 }, { name: 'c', unit: 'kg/m', low: 0, high: 0.005 }, { name: "r'(0)", part: 1, unit: 'm/s', low: 0, high: 60 }],
  },
  'spring': {
    ask: 'energy', about: 'symplectic-euler', decor: 'spring', units: metres, frame: { y: [-1.9, 1.9] },
    dials: [{ name: 'k', unit: 'N/m', low: 0.1, high: 4 }, { name: 'm', unit: 'kg', low: 0.1, high: 4 }, { name: 'x(0)', unit: 'm', low: -2, high: 2 }],
  },
  'damped-spring': {
    dials: [{ name: 'gamma', low: 0, high: 2 }, { name: 'F', low: 0, high: 2 }, { name: 'omega', low: 0, high: 4 }],
  },
  'pendulum': {
    decor: 'pendulum',
    dials: [{ name: 'theta(0)', low: -3.14, high: 3.14 }, { name: "theta'(0)", low: -3, high: 3 }],
  },
  'resonance': {
    units: metres,
    dials: [{ name: 'F', unit: 'N', low: 0, high: 0.2 }, { name: 'k', unit: 'N/m', low: 0.1, high: 4 }],
  },
  'driven-oscillator': {
    dials: [{ name: 'F', low: 0, high: 0.2 }, { name: 'x(0)', low: -0.9, high: 0.9 }, { name: "x'(0)", low: -0.7, high: 0.7 }],
  },
  'damped-cubic': {
    dials: [{ name: 'x(0)', low: -20, high: 20 }, { name: "x'(0)", low: -50, high: 50 }],
  },
  'van-der-pol': {
    dials: [{ name: 'mu', low: 0, high: 10 }, { name: 'x(0)', low: -4, high: 4 }, { name: "x'(0)", low: -4, high: 4 }],
  },
  'bouncing-ball': {
    decor: 'floor', units: metres, frame: { y: [-0.08, 1.08] },
    dials: [{ name: 'e', low: 0.1, high: 0.99 }, { name: 'h', unit: 'm', low: 0.1, high: 2 }],
  },
  'newtons-cradle': {
    balls: 'd', dials: [{ name: 'd', low: 0.2, high: 1 }],
  },
  'billiard': {
    walls: [[0, 0, 1]],
    dials: [{ name: "r'(0)", part: 0, low: -1, high: 1 }, { name: "r'(0)", part: 1, low: -1, high: 1 }, { name: 'r(0)', part: 0, low: -0.9, high: 0.9 }],
  },
  'stick-slip': {
    dials: [{ name: 'V', low: 0.1, high: 1 }, { name: 'f', low: 0, high: 0.95 }],
  },
  'kicked-rotor': {
    dials: [{ name: 'K', low: 0, high: 6 }, { name: 'x(0)', low: 0, high: 6.28 }, { name: "x'(0)", low: 0, high: 6.28 }],
  },
  'kepler': {
    rests: [[0, 0, 10, 'sun']],
    dials: [{ name: 'e', low: 0, high: 0.95 }, { name: 'mu', low: 0.1, high: 2 }],
  },
  'comet': {
    rests: [[0, 0, 8, 'sun']], units: { x: 'au', t: 'years', v: 'au/year' },
    dials: [{ name: 'e', low: 0.5, high: 0.99 }],
  },
  'arenstorf': {
    rests: [[-0.012277471, 0, 10, 'earth'], [0.987722529, 0, 5, 'moon']],
    dials: [{ name: 'x(0)', low: 0.9, high: 1.1 }, { name: "y'(0)", low: -2.2, high: -1.8 }],
  },
  'outer-solar-system': { bodies: ['sun', 'jupiter', 'saturn', 'uranus', 'neptune', 'pluto'], units: { x: 'au', t: 'days', v: 'au/day' }, dials: [{ name: 'G', low: 2e-4, high: 4e-4 }] },
  'three-body-figure-eight': { dials: [] },
  'chain': {
    dials: [{ name: 'beta', low: 0, high: 2 }, { name: 'A', low: 0, high: 2 }, { name: 'N', low: 3, high: 64 }],
  },
  'charged-particle': {
    dials: [{ name: 'B', part: 2, low: 0, high: 5 }, { name: 'E', part: 0, low: -1, high: 1 }, { name: 'q', low: -2, high: 2 }],
  },
  'crossed-fields': {
    units: { x: 'mm', t: 'ns', v: 'mm/ns' },
    dials: [{ name: 'B', unit: 'mT', low: 0.2, high: 3 }, { name: 'E', part: 1, unit: 'V/mm', low: -2, high: 2 }],
  },
  'penning-trap': {
    dials: [{ name: 'wc', low: 3, high: 20 }, { name: 'wz', low: 0.5, high: 5 }],
  },
  'double-pendulum': {
    rods: [['x1', 'y1'], ['x2', 'y2']],
    dials: [{ name: 'θ1(0)', low: -3.14, high: 3.14 }, { name: 'θ2(0)', low: -3.14, high: 3.14 }],
  },
  'duffing': {
    dials: [{ name: 'F', low: 0, high: 1 }, { name: 'd', low: 0, high: 1 }, { name: 'x(0)', low: -2, high: 2 }],
  },
  'henon-heiles': {
    dials: [{ name: "x'(0)", low: -0.5, high: 0.5 }, { name: 'y(0)', low: -0.5, high: 0.5 }],
  },
  'ueda': {
    dials: [{ name: 'B', low: 0, high: 15 }, { name: 'k', low: 0, high: 0.5 }, { name: 'x(0)', low: -4, high: 4 }],
  },
};
