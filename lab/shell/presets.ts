/* The examples: every model of models/, with a short name, its place in the list, the methods it is shown with, and what to look for.
 *
 * Invariant: the list is that of the build. A model without an entry here is offered under its own name, last. Descriptions are the models' own:
 * the sentence that their first comment begins with.
 */
import models from 'virtual:presets';
import type { Presets } from '../share';

type Note = readonly (string | { readonly to: string; readonly label: string })[];
interface Entry { readonly title: string; readonly group: string; readonly methods: readonly string[]; readonly mark?: string; readonly note?: Note }

const entries: Readonly<Record<string, Entry>> = {
  'thrown-ball': { title: 'A thrown ball', group: 'Begin here', methods: ['explicit-euler', 'symplectic-euler', 'midpoint'] },
  'thrown-ball-air': { title: 'A ball in air', group: 'Begin here', methods: ['explicit-euler', 'symplectic-euler', 'midpoint'] },
  'projectile': {
    title: 'Thrown ball', group: 'Begin here', methods: ['explicit-euler', 'symplectic-euler', 'midpoint'], mark: 'founding scene',
    note: [
      'Thrown like this, with g = 9.81 and the step 0.05, explicit Euler is after three seconds 0.7357 above the green parabola and symplectic Euler 0.7357 below it; the midpoint rule and Verlet are exact, because the ',
      'acceleration never changes. So this scene cannot tell which method is good: on ',
      { to: 'spring', label: 'the spring' }, ' they differ. Nor can it tell heavy from light: under gravity alone the mass cancels, and m changes the energy but not the path. ',
      { to: 'projectile-drag', label: 'With air drag' }, ' it matters.',
    ],
  },
  'spring': {
    title: 'Mass on a spring', group: 'Begin here', methods: ['explicit-euler', 'symplectic-euler', 'verlet'],
  },
  'projectile-drag': {
    title: 'Thrown ball with air drag', group: 'Begin here', methods: ['explicit-euler', 'midpoint', 'verlet'],
    note: ['Drag divided by mass is what slows the ball, so a heavier one flies further. No formula gives this motion; the green line is a reference, computed with its own error. Back to ',
      { to: 'projectile', label: 'the ball without air' }, '.'],
  },
  'driven-oscillator': { title: 'Driven oscillator', group: 'Oscillators', methods: ['verlet'], mark: 'founding notebook, first example' },
  'damped-cubic': { title: 'Damped cubic spring', group: 'Oscillators', methods: ['verlet'], mark: 'founding notebook, second example' },
  'damped-spring': { title: 'Damped spring', group: 'Oscillators', methods: ['verlet', 'explicit-euler'] },
  'duffing': { title: 'Duffing’s oscillator', group: 'Oscillators', methods: ['verlet', 'rk4'] },
  'van-der-pol': { title: 'Van der Pol’s oscillator', group: 'Oscillators', methods: ['rk4', 'verlet'] },
  'pendulum': { title: 'Pendulum', group: 'Pendulums', methods: ['explicit-euler', 'velocity-verlet'] },
  'double-pendulum': { title: 'Double pendulum', group: 'Pendulums', methods: ['gauss6', 'rk4'] },
  'kepler': { title: 'Planet and sun', group: 'Orbits', methods: ['kahan-li8', 'velocity-verlet', 'rk4'] },
  'three-body-figure-eight': { title: 'Three bodies in an eight', group: 'Orbits', methods: ['kahan-li6', 'velocity-verlet'] },
  'arenstorf': { title: 'Between Earth and Moon', group: 'Orbits', methods: ['gauss8'] },
  'outer-solar-system': { title: 'Outer solar system', group: 'Orbits', methods: ['kahan-li8', 'velocity-verlet'] },
  'henon-heiles': { title: 'Star in a galaxy', group: 'Orbits', methods: ['pefrl', 'velocity-verlet'] },
  'charged-particle': { title: 'Charged particle', group: 'In a field', methods: ['boris', 'rk4'] },
  'penning-trap': { title: 'Penning trap', group: 'In a field', methods: ['boris', 'rk4'] },
  'chain': { title: 'Chain of springs', group: 'Many bodies', methods: ['velocity-verlet'] },
};

const texts = new Map(models.map(model => [model.name, model.text]));
const entryOf = (name: string): Entry | undefined => (Object.hasOwn(entries, name) ? entries[name] : undefined);

export const presets: Presets = {
  first: 'thrown-ball',
  text: name => texts.get(name),
  methods: name => entryOf(name)?.methods ?? [],
};

/** The first sentence of a model's own comment. */
export function described(text: string): string {
  const comment: string[] = [];
  for (const line of text.split('\n')) {
    const words = /^#\s?(.*)$/.exec(line)?.[1];
    if (words === undefined || (words.trim() === '' && comment.length)) break;
    comment.push(words.trim());
  }
  return /^.*?\.(?=\s|$)/s.exec(comment.join(' '))?.[0] ?? comment.join(' ');
}

export const titleOf = (name: string): string => entryOf(name)?.title ?? name;
