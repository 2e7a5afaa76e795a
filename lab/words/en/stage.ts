/* The motion on the stage: lab/stage/. Names of methods and of numbers are the model's and the core's. */
const upper = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

export const stage = {
  motion: 'Motion', view: 'View', all: 'show all', exactOnly: 'show the exact motion', computedOnly: 'show the computed motion', less: 'show less',
  noPositions: 'This model has no positions to show.', noMethod: 'Choose a method to see its motion.',
  turn: 'picture that can be turned: arrow keys, Home',
  /** The ring of the initial velocity. */
  aim: 'Initial velocity: arrow keys turn it up, down, left and right',
  /** The ring of a guess: its name, where it is. */
  guess: {
    ring: 'Your guess: up and down', open: 'your guess', closed: 'you',
    above: 'above the exact motion', on: 'on the exact motion', below: 'below the exact motion',
  },
  /** Ways to look at a motion. */
  views: {
    space: 'in space', path: 'path', plane: (across: string, up: string) => `path in ${across}, ${up}`, time: (name: string) => `${name} against time`, shape: (name: string) => `shape of ${name}`,
    mass: (number: string) => `mass ${number}`,
  },
  velocity: 'velocity ',
  /** What moves, or rests, in an example. */
  bodies: { sun: 'Sun', earth: 'Earth', moon: 'Moon', jupiter: 'Jupiter', saturn: 'Saturn', uranus: 'Uranus', neptune: 'Neptune', pluto: 'Pluto' },
  /** The green curve, where a formula gives it and where it is computed. */
  exact: 'exact', computed: 'computed',
  /** Between the names of curves that coincide; how many others do. */
  equals: ' = ', several: (count: string) => `${count} methods`,
  /** How a point misses the exact motion; its number stands before. */
  miss: { none: 'on it', high: 'too high', low: 'too low', off: 'off', offOf: (body: string) => `off, ${body}`, furthest: 'the furthest', body: (number: string) => `body ${number}` },
  /** A method that leaves the picture, and how it ends. */
  leaves: (method: string) => `${method} leaves`,
  /** One that comes down to the ground, below which nothing is drawn. */
  landed: (method: string) => `${method} lands`, lands: (name: string, time: string) => `${name} lands at ${time}`,
  ends: (time: string) => `and ends at ${time}, no longer a number`, unsolved: (time: string) => `and stops at ${time}, its equation unsolved`, wide: (times: string, time: string) => `${times} times too wide at ${time}`, at: (time: string) => `at ${time}`,
  /** The motion in words, for those who do not see it. */
  summary: {
    nothing: 'Nothing to show yet.',
    shape: (name: string, from: string, to: string) => `Shape of the family ${name}, number by number, from t = ${from} to ${to}.`,
    time: (name: string, from: string, to: string) => `${name} against time, from t = ${from} to ${to}.`,
    space: (from: string, to: string) => `Path in space, from t = ${from} to ${to}.`,
    plane: (across: string, up: string, from: string, to: string) => `Path in the plane of ${across} and ${up}, from t = ${from} to ${to}.`,
    distance: (value: string, method: string, body: string) => `${value} for ${method}${body ? ` (${body})` : ''}`,
    exact: (distances: readonly string[]) => `At the end the distance from the exact motion is ${distances.join(', ')}.`,
    reference: (distances: readonly string[]) => `At the end the distance from the reference is ${distances.join(', ')}.`,
    ended: (method: string, what: string) => `${upper(method)}: ${what}.`,
    stops: (method: string, time: string) => `${upper(method)} stops at t = ${time}.`,
    stopsAs: (method: string, time: string, variable: string) => `${upper(method)} stops at t = ${time}: ${variable} is no finite number.`,
    /** time: of its last state. */
    stopsUnsolved: (method: string, time: string) => `${upper(method)} stops at t = ${time}: the implicit equation of its next step could not be solved.`,
    leaves: (method: string, time: string) => `${upper(method)} leaves the picture at t = ${time}.`,
    ground: (time: string) => `From ${time} on the motion would be below the ground, where nothing is drawn.`,
    whole: (sentences: readonly string[]) => sentences.join(' '),
  },
  /** The numbers behind the picture: the first column, the rows that no method computed. */
  table: { motion: 'motion', exact: 'exact', reference: 'reference' },
  noFilm: 'The browser could not record the motion.',
} as const;
