/* One step, opened: lab/shell/opened.ts, lab/panel/steps/. Numbers, names and ways come already written. */
const share = (c: number): string => {
  const size = Math.abs(c), of = [[1 / 3, 'a third'], [2 / 3, 'two thirds'], [1 / 4, 'a quarter'], [3 / 4, 'three quarters']] as const;
  return size > 1 ? `${Number(size.toPrecision(3))} steps` : size === 1 ? 'the whole step' : size === 0.5 ? 'half a step' : `${of.find(([value]) => Math.abs(value - size) < 1e-12)?.[1] ?? String(Number(size.toPrecision(3)))} of a step`;
};
/** From where the exact motion goes on. */
type From = 'start' | 'here' | 'two';
const since = (from: From): string => (from === 'two' ? ' through both places' : from === 'here' ? ' from here' : '');
const numerals = ['no', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight'], ordinals = ['first', 'second', 'third', 'fourth', 'fifth', 'sixth', 'seventh', 'eighth'];
const counted = (n: number): string => numerals[n] ?? String(n);
/** A title inside a sentence. */
const within = (title: string): string => (/^\p{Lu}(?=\p{Ll}|\s)/u.test(title) ? title.charAt(0).toLowerCase() + title.slice(1) : title);
const rounds = (n: number): string => (n === 0 ? '' : `, in ${n} round${n === 1 ? '' : 's'}`);

export const opened = {
  title: 'One step, opened',
  /** "mass on a spring, h = 0.8 s" */
  scene: (title: string, h: string) => `${within(title)}, h = ${h}`,
  /** Where the method chooses its own steps. */
  adapting: (title: string, tolerance: string) => `${within(title)}, tolerance ${tolerance}`,
  step: (n: string, total: string) => `step ${n} of ${total}`,
  stepSpoken: (n: string, total: string, from: string, to: string) => `step ${n} of ${total}, from ${from} to ${to}`,
  back: 'Back to the motion', backToLesson: 'Back to the lesson',
  before: 'The step before (left arrow)', next: 'The next step (right arrow)',
  play: 'Play (space)', pause: 'Pause (space)', line: 'Steps', methods: 'Methods', look: 'What is shown',
  walks: (lines: number) => `Play walks ${Array.from({ length: lines }, (_, k) => k + 1).join(', ')}, then on.`,
  formula: 'The formula', parts: 'Every part, with all digits', partsTitle: (method: string) => `One step by ${method}`,
  partsNote: 'Positions, velocities and accelerations after each part.', partsHead: ['part', 'what'],
  both: (a: string, b: string) => `${a} and ${b}`, of: (whole: string, parts: string) => `${whole}: ${parts}`,
  /** Of the picture, for those who do not see it. */
  picture: (method: string, step: string, list: string) => `${step} by ${method}: ${list}`,

  start: 'start', half: 'half a step', end: 'end', earlier: 'before', now: 'now', later: 'next',
  at: (what: string, time: string) => `${what}, ${time}`,
  /** height: of a place; else of an angle, or any number. */
  tooFar: (size: string, more: boolean, height: boolean) => `${size} too ${height ? (more ? 'high' : 'low') : more ? 'large' : 'small'}`, off: (size: string) => `${size} off`,
  /** known: a formula gives the motion; from: the start of the run, the start of the step, or the two places that the step takes: through these the motion goes. */
  exact: (value: string, method: string, miss: string, from: From, known: boolean) =>
    `${known ? 'Exact' : 'Computed in small steps'}${since(from)}${known ? '' : ' it'} is ${value}: ${method} is ${miss || 'on it'}.`,
  /** Where the digits of the place do not show the miss. */
  missOnly: (method: string, miss: string, from: From, known: boolean) => `Against the ${known ? 'exact motion' : 'motion computed in small steps'}${since(from)}, ${method} is ${miss}.`,
  soFar: (miss: string) => `After all steps up to here it is ${miss} off.`,
  newVelocity: (value: string) => `The velocity is now ${value}.`,
  over: 'The run is over: there is no step left to open.',
  cannot: (method: string, why: string) => `No step by ${method} can be opened here: ${why}.`,
  nobody: 'Choose a method to open its steps.',
  stale: 'The equation cannot be computed as it stands. These are steps of the last one that could.',
  broken: 'The equation cannot be computed as it stands: there is no step to open.',
  opening: 'Opening the step …',

  /** Of a method that chooses its steps: what it tried. times: the error in units of what is allowed; '': the step has no finite result. */
  refusedWord: 'refused',
  refused: (size: string, times: string) => `Tried a step of ${size}: ${times ? `the estimated error is ${times} times what the tolerance allows` : 'it has no finite result'}, so it is refused.`,
  accepted: (size: string, times: string) => `Taken: a step of ${size}, with an estimated error of ${times} of what is allowed.`,

  velocity: 'velocity', rate: 'rate of change',
  go: (c: number, first: boolean, otherHalf: boolean, noun: string) => (c < 0 ? `Go back ${share(c)}, with the ${noun} you have now.` : otherHalf ? `Go the other half, with the ${noun} you have now.` : `Go ${share(c)} with the ${first ? `${noun} you have` : `new ${noun}`}.`),
  kick: (c: number, otherHalf: boolean, mean: boolean) => `${otherHalf ? 'Let the force here act for the other half' : c === 1 ? 'Let the force change the velocity' : `Let the force act ${c < 0 ? 'backward, ' : ''}for ${share(c)}`}${mean ? ', at the mean of both velocities' : ''}.`,
  kickAfter: 'Only now let the force change it, as it was at the start.',
  andSoOn: (parts: number, last: number) => `And so on, ${parts} parts. The last${last > 1 ? ` ${counted(last)}` : ''}:`,
  andSoOnStages: (stages: number, noun: string) => `And so on: ${stages} in all. Go the whole step with their mean ${noun}.`,
  read: (noun: string) => `Read the ${noun} there.`,
  seek: (c: number, noun: string) => `Look for the place ${c === 0.5 ? 'half way' : `at ${share(c)}`} whose own ${noun} leads there.`,
  fits: (n: number, noun: string) => `The force there gives this ${noun}: both fit${rounds(n)}.`,
  again: 'Start again, and go the whole step with it.',
  againWith: (n: number, equal: boolean, noun: string) => `Start again, and go the whole step with ${equal ? `the mean ${noun}` : `${n === 2 ? 'both' : `all ${counted(n)}`}, weighed`}.`,
  atStart: (noun: string) => `Read the ${noun} at the start.`,
  /** k: with which of those above; -1: with several. together: and then all four. */
  tryWith: (c: number, k: number, noun: string, together: boolean) => `Go ${share(c)} with ${k < 0 ? 'those so far' : `the ${ordinals[k] ?? 'last'}`}${together ? '; then again, with all four, weighed' : `: the ${noun} there`}.`,
  solve: (n: number, r: number, noun: string) => `Solve for ${n === 2 ? 'both' : `all ${counted(n)}`} ${noun === 'velocity' ? 'velocities' : 'rates'} at once${rounds(r)}.`,
  solveOne: (r: number, noun: string) => `Look for the ${noun} at the end that leads there${rounds(r)}.`,
  also: (k: number, n: number, noun: string, together: boolean) => `${n === 2 ? 'The other, further on' : `The ${ordinals[k] ?? 'next'} ${noun}`}${together ? '; then the whole step, with all four, weighed' : ''}.`,
  forceAtStart: 'Read what the force does at the start.',
  seekForce: (n: number) => `Look for the force at the end that fits the place it leads to${rounds(n)}.`,
  forces: 'Go the whole step, with both forces.',
  tryForce: (c: number) => `Go ${share(c)} with the velocity and that force: what the force does there.`,
  forcesInAll: (n: number) => `And so on: ${n} in all. Go the whole step with the velocity and their mean.`,
  forcesVelocity: 'The velocity, with them as well.',
  keepGoing: 'Keep going: the same stretch once more.',
  fall: (hidden: boolean, half: boolean) => (hidden ? 'Add what the force does, with (next − before)/2h for the velocity.' : half ? 'Add what the force does from the start, where there is no step before.' : 'Add what the force does in a whole step.'),
  fallBeeman: 'Add what the force does: the one now and the one a step before.',
  there: (hidden: boolean) => `That is the new place. ${hidden ? 'Two places were enough' : 'No velocity was needed'}.`, thereFirst: 'That is the new place. From now on the last two places are enough for a step.', thereBeeman: 'That is the new place.',
  velocityBeeman: 'The velocity, with the force at the new place too.',
  twoPlaces: 'Two places and one force: that is all it remembers.',
  /** Every part of a step; times come written. */
  part: {
    startTitle: (t: string) => `Start, t = ${t}`, endTitle: (t: string) => `End, t = ${t}`,
    kick: 'Kick', implicitKick: 'Implicit kick', drift: 'Drift', solve: 'Solve', taylor: 'First step', recurrence: 'Recurrence', position: 'Position',
    stage: (k: number, n: number) => (n === 1 ? 'Slope' : `Stage ${k} of ${n}`),
    kickNote: (t: string) => `The acceleration at t = ${t} changes the velocity; the position stays.`,
    implicitNote: (t: string, turns: number) => `The acceleration at t = ${t}, taken at the mean of the velocities before and after, changes the velocity; the position stays.${turns > 0 ? ` Newton's method solved that equation in ${turns} iteration${turns === 1 ? '' : 's'}.` : ''}`,
    driftNote: (t: string) => `Free flight with this velocity, to t = ${t}.`,
    solveNote: (n: number) => `The stages depend on one another: Newton's method found them together in ${n} iteration${n === 1 ? '' : 's'}.`,
    stageNote: (t: string, start: boolean) => `At t = ${t}${start ? ', the start' : ''}: the place that is tried, and the slopes found there.`,
    taylorNote: 'There is no step before: the Taylor series of the start gives the second point.',
    recurrenceNote: 'As far again as in the step before, and the acceleration on top.',
    positionNote: 'The acceleration now and the one a step before tell how it changes.',
    slopes: (n: number) => (n === 1 ? 'The one slope, for the whole step.' : 'The slopes, each with its weight.'),
    velocityNote: 'The velocity, with the acceleration at the new place.',
    meanNote: 'The velocity at the same time as the position: the mean over the step, and half a kick by the acceleration at the new place.',
  },
  alongside: 'The method takes this number along with the motion.',
  series: 'Sum the Taylor series of the motion, over a step as long as its last terms allow.',
  extrapolated: 'Take the step in more and more parts, and read off where shorter and shorter parts lead.',
} as const;
