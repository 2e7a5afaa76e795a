/* What is said of each example, by the name of its model: of the numbers that belong to it see lab/scenes.ts and stage/stagings.ts. */
import type { SceneWords } from '../scene';

export const scenes: Readonly<Record<string, SceneWords>> = {
  'thrown-ball': {
    title: 'A thrown ball', question: 'Why do the two Eulers miss?',
    sentence: (steps) => `Green is how it really flies. The others are a computer’s answers, ${steps} straight steps each.`,
    dials: { "r'(0).y": 'Upwards', "r'(0).x": 'Sideways' }, switch: 'Air',
  },
  'projectile': {
    title: 'Notebook, first example', question: 'Are sixty small steps enough?',
    sentence: 'The first example of the notebook, with its numbers: after three seconds the Eulers are 0.7357 m above and below.',
    moved: 'The first example of the notebook, with other numbers.',
    dials: { 'g.y': 'Gravity', m: 'Mass', "r'(0).y": 'Upwards' },
  },
  'projectile-drag': {
    title: 'Ball in air', question: 'Where did the symmetry go?',
    sentence: 'Thrown hard, a light ball loses its speed to the air: the way up is long and flat, the way down is short and steep.',
    dials: { m: 'Mass', c: 'Drag', "r'(0).y": 'Upwards' },
    keeps: { hodograph: 'The hodograph is a number made of the horizontal velocity and the slope of the path, which gravity and this drag leave as it is.' },
  },
  'spring': {
    title: 'Mass on a spring', question: 'Why does the blue one stay?',
    sentence: 'On the left against time, on the right how fast against how far. Both share one height.',
    alone: 'How far it is, against time.',
    dials: { k: 'Stiffness', m: 'Mass', 'x(0)': 'Start' },
  },
  'damped-spring': {
    title: 'Spring with friction', question: 'What does each swing lose?',
    sentence: 'Each swing loses the same share of what is left. Give it a periodic push: it answers at the frequency of the push.',
    moved: 'With friction each free swing loses the same share of what is left; pushed, it comes to answer at the frequency of the push.',
    dials: { gamma: 'Friction', F: 'Push', omega: 'Its frequency' },
  },
  'pendulum': {
    title: 'Pendulum', question: 'Why is a wide swing slower?',
    sentence: 'Let go far from the vertical, it takes a third longer for a swing than a small one does.',
    moved: 'The wider it swings, the longer a swing takes.',
    dials: { 'theta(0)': 'Start angle', "theta'(0)": 'Start speed' },
  },
  'resonance': {
    title: 'Resonance', question: 'How far do small pushes go?',
    sentence: 'A push of a fiftieth of a newton, always at the right moment.',
    moved: 'A small push, again and again. At the right moments the swing grows with each one.',
    dials: { F: 'Push', k: 'Stiffness' },
  },
  'driven-oscillator': {
    title: 'Driven, not quite linear', question: 'Why does it swell and fade?',
    sentence: 'The second example of the notebook: a spring that softens, driven at the frequency of its small swings.',
    dials: { F: 'Drive', 'x(0)': 'Start', "x'(0)": 'Start speed' },
  },
  'damped-cubic': {
    title: 'Cubic spring, braked', question: 'Does friction spoil Verlet?',
    sentence: 'The third example of the notebook: a spring that hardens, with friction, which Verlet solves for in closed form.',
    dials: { 'x(0)': 'Start', "x'(0)": 'Start speed' },
  },
  'van-der-pol': {
    title: 'Van der Pol', question: 'Why do all starts end alike?',
    sentence: 'It feeds itself while it is small and brakes while it is large, so every start ends on one curve.',
    dials: { mu: 'Feeding', 'x(0)': 'Start', "x'(0)": 'Start speed' },
    keeps: { balance: 'The balance is the energy of the swing less the energy that the friction has supplied so far.' },
  },
  'bouncing-ball': {
    title: 'Bouncing ball', question: 'How often does it bounce?',
    sentence: 'Every bounce leaves four fifths of the speed. They come faster and faster, and then it lies still.',
    moved: 'Every bounce leaves a part of the speed. They come faster and faster, and then it lies still.',
    alone: 'How high it is, against time.',
    dials: { e: 'Speed that is left', h: 'Height' },
  },
  'newtons-cradle': {
    title: 'Newton’s cradle', question: 'Why does only the last one roll?',
    sentence: 'One ball comes, three wait in contact. The push runs through them in no time. Time runs upwards.',
    moved: 'One ball comes, three wait. The push runs from ball to ball. Time runs upwards.',
    dials: { d: 'Diameter' },
  },
  'billiard': {
    title: 'Round billiard', question: 'Where does the ball never go?',
    sentence: 'No friction, a round table: the ball flies straight and leaves the rim as it came.',
    dials: { "r'(0).x": 'Sideways', "r'(0).y": 'Upwards', 'r(0).x': 'Start' },
  },
  'stick-slip': {
    title: 'Stick and slip', question: 'Why does a string under the bow sound?',
    sentence: 'A belt carries a mass along until its spring tears it away. It slips back, and the belt takes it again.',
    dials: { V: 'Speed of the belt', f: 'Friction while it slips' },
  },
  'kicked-rotor': {
    title: 'Kicked rotor', question: 'How far do kicks carry it?',
    sentence: 'It turns freely and is kicked once in every unit of time: more or less, or the other way, as its angle says.',
    dials: { K: 'Kick', 'x(0)': 'Angle', "x'(0)": 'Speed' },
  },
  'kepler': {
    title: 'Planet', question: 'Does the ellipse close?',
    sentence: 'A planet and its sun. The ellipse should close, turn after turn.',
    dials: { e: 'Eccentricity', mu: 'Mass of the sun' },
    keeps: { angular: 'Angular is the angular momentum.', axis: 'Axis is the vector along the long axis of the ellipse, by Laplace, Runge and Lenz; its length is the eccentricity.' },
  },
  'comet': {
    title: 'Comet', question: 'What breaks close to the Sun?',
    sentence: 'Halley’s comet: seventy-five years, and close to the Sun a few days that decide.',
    moved: 'An orbit around the Sun. The longer it is, the more its days close to the Sun decide.',
    dials: { e: 'Eccentricity' },
    keeps: { angular: 'Angular is the angular momentum.', axis: 'Axis is the vector along the long axis of the ellipse, by Laplace, Runge and Lenz; its length is the eccentricity.' },
  },
  'arenstorf': {
    title: 'Between Earth and Moon', question: 'How small an error loses it?',
    sentence: 'A satellite between Earth and Moon, seen from a frame that turns with them. Its orbit closes, if it is computed well.',
    moved: 'A satellite between Earth and Moon, seen from a frame that turns with them. From another start its orbit need not close.',
    dials: { 'x(0)': 'Start', "y'(0)": 'Start speed' },
    keeps: { jacobi: 'Jacobi’s constant stands in place of the energy, as the frame turns.' },
  },
  'outer-solar-system': {
    title: 'Outer planets', question: 'Where are they in 500 years?',
    sentence: 'Jupiter, Saturn, Uranus, Neptune and Pluto, for five hundred years.',
    dials: { G: 'Gravity' },
    keeps: { angular: 'Angular is the angular momentum.' },
  },
  'three-body-figure-eight': {
    title: 'Figure of eight', question: 'Can three bodies take turns?',
    sentence: 'Three equal masses chase each other along one curve.',
    keeps: { angular: 'Angular is the angular momentum.' },
  },
  'chain': {
    title: 'Chain of springs', question: 'Where does the energy go?',
    sentence: 'A chain of springs that stiffen, started in its longest wave. Green is its shape now.',
    dials: { beta: 'Stiffening', A: 'Amplitude', N: 'Masses' },
  },
  'charged-particle': {
    title: 'Charge in a magnet', question: 'Who keeps the circle round?',
    sentence: 'A charge in a magnetic field, which turns its velocity and no more; an electric field also changes its speed.',
    dials: { 'B.z': 'Field', 'E.x': 'Electric field', q: 'Charge' },
    keeps: { momentum: 'The momentum is that of the charge, less what both fields have given it.' },
  },
  'crossed-fields': {
    title: 'Crossed fields', question: 'Why does it drift sideways?',
    sentence: 'An electron in an electric and a magnetic field at right angles: it drifts across both.',
    dials: { B: 'Magnetic field', 'E.y': 'Electric field' },
  },
  'penning-trap': {
    title: 'Penning trap', question: 'What holds it in?',
    sentence: 'A fast circle, an oscillation along the axis, and a slow circle between them.',
    moved: 'In a strong enough magnetic field: a fast circle, an oscillation along the axis, and a slow circle between them.',
    dials: { wc: 'Magnetic field', wz: 'Electric field' },
    keeps: { angular: 'Angular is the angular momentum about the axis, with the share of the magnetic field.' },
  },
  'double-pendulum': {
    title: 'Double pendulum', question: 'When do two starts part?',
    sentence: 'Green is the lower of two masses. Two starts that differ by a hair part within seconds.',
    dials: { 'θ1(0)': 'Upper angle', 'θ2(0)': 'Lower angle' },
  },
  'duffing': {
    title: 'Duffing', question: 'Left or right next?',
    sentence: 'Two valleys and a push. It hops between them, and nobody can say when.',
    moved: 'Two valleys and a push. With enough of it the mass hops between them.',
    dials: { F: 'Push', d: 'Friction', 'x(0)': 'Start' },
  },
  'henon-heiles': {
    title: 'Star in a galaxy', question: 'Where does order end?',
    sentence: 'A star in the field of its galaxy. Below an energy of 1/12 its orbit is orderly, above 1/6 it may leave.',
    dials: { "x'(0)": 'Sideways', 'y(0)': 'Start' },
  },
  'ueda': {
    title: 'Ueda', question: 'Is there a pattern in it?',
    sentence: 'A hard spring, driven. Its motion never repeats, and yet it keeps to a shape.',
    moved: 'A hard spring, driven. Its motion may never repeat, and yet keep to a shape.',
    dials: { B: 'Drive', k: 'Friction', 'x(0)': 'Start' },
  },
  'thrown-ball-air': {
    title: 'A thrown ball, in air', question: 'Does midpoint still hit?',
    sentence: 'Air slows a light ball more than a heavy one. No formula is known for this flight: green is computed with steps so small that the line would not change.',
    dials: { "r'(0).y": 'Upwards', "r'(0).x": 'Sideways', m: 'Mass' }, switch: 'Air',
  },
};
