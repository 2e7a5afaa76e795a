/* The three studies that look closer: lab/panel/{convergence,precision,stability,study}.ts. Numbers come formatted, with their units. */
const and = (parts: readonly string[]): string => (parts.length < 2 ? parts.join('') : `${parts.slice(0, -1).join(', ')} and ${parts[parts.length - 1]}`);
/** Names of methods in a sentence; those of one kind together. */
function people(names: readonly string[]): string {
  const eulers = names.filter((name) => /Euler/.test(name));
  return and(eulers.length > 1 ? ['the Eulers', ...names.filter((name) => !eulers.includes(name))] : names);
}
const SHARES = ['all', 'half', 'a quarter', 'an eighth'];
const DIGITS = ['no digit', 'one digit', 'two digits', 'three digits', 'four digits', 'five digits', 'six digits', 'seven digits', 'eight digits', 'nine digits', 'ten digits', 'eleven digits', 'twelve digits'];
const are = (names: readonly string[]): string => (names.length > 1 ? 'are' : 'is');

export const study = {
  here: (value: string) => `here: ${value}`,
  beyond: (value: string) => `here: ${value} →`,
  waiting: 'Measuring takes longer here than a moment, so it waits for you.',
  begin: (time: string) => (time ? `Measure, about ${time}` : 'Measure, more than 2\u2009s'),
  again: 'Try again',
  cancel: 'Cancel',
  cancelled: 'Cancelled.',
  failed: (why: string) => `This could not be measured: ${why}`,
  earlier: 'The picture is of an earlier state.',
  converge: 'Measuring the error at many steps',
  compare: 'Comparing the methods',
  going: (what: string) => `${what} …`,
  known: 'Errors are measured against the exact motion.',
  unknown: (name: string, off: string) => `No exact motion is known, so errors are measured against ${name}, itself good to ${off}.`,
  taken: (how: string) => `Taken ${how}.`,
  error: 'off by, in sizes of the motion',

  convergence: {
    title: 'Order',
    question: 'What does half the step buy?',
    share: (k: number) => SHARES[k] ?? `1/${2 ** k}`,
    part: (denominator: string) => `1/${denominator}`,
    of: (share: string) => (share === 'half' || share === 'all' ? `${share} the error` : `${share} of the error`),
    label: (name: string, share: string) => `${name}: ${share}`,
    exactLabel: (name: string) => `${name}: exact`,
    group: (share: string, names: readonly string[]) => `${share} for ${people(names)}`,
    unlike: (share: string, names: readonly string[], declared: string) => `${share} for ${people(names)}, where ${names.length > 1 ? 'their' : 'its'} order says ${declared}`,
    nothing: (names: readonly string[]) => `nothing for ${people(names)}`,
    rough: (names: readonly string[]) => `no steady share for ${people(names)}`,
    missing: (names: readonly string[]) => `${people(names)} could not be measured`,
    exact: (names: readonly string[]) => `${people(names)} ${are(names)} exact here`,
    answer: (groups: readonly string[], rest: readonly string[]) => `At small steps: ${[groups.join(', '), ...rest].filter(Boolean).join('; ')}.`,
    allExact: (names: readonly string[]) => `Nothing: ${people(names)} ${are(names)} exact here, at every step measured.`,
    noneLike: (rest: readonly string[]) => `That cannot be told here: ${rest.join('; ')}.`,
    axis: 'step h',
    confirmed: (name: string, order: string, slope: string) => `${name}: order ${order} confirmed, slope ${slope}.`,
    denied: (name: string, order: string, slope: string) => `${name}: order ${order} is declared, but the slope is ${slope} here.`,
    roundOff: (name: string) => `${name}: exact here, its error is round-off, and a slope has no meaning.`,
    slopeless: (name: string, why: string) => `${name}: ${why || 'no slope could be measured'}.`,
    slope: 'The slope is that of the error against the step, both logarithmic: half the step leaves 2 to the power of minus the slope.',
    left: 'Steps without a marker are left out of it: there round-off rules, or the step is too long.',
    columns: ['method', 'step', 'error', 'evaluations', 'used in the slope'],
    yes: 'yes',
    no: 'no',
  },

  precision: {
    title: 'Cost',
    question: 'What does accuracy cost?',
    digits: (n: number) => DIGITS[n] ?? `${n} digits`,
    /** ratio: "4.1", "at least 4.1", '' for as many. */
    than: (ratio: string, names: readonly string[], first: boolean) =>
      (ratio ? `${ratio} times fewer ${first ? 'evaluations ' : ''}than ${people(names)}` : `about as many ${first ? 'evaluations ' : ''}as ${people(names)}`),
    atLeast: (ratio: string) => `at least ${ratio}`,
    upTo: (ratio: string) => `up to ${ratio}`,
    answer: (digits: string, best: string, parts: readonly string[], rest: readonly string[]) => `For ${digits}, ${best} needs ${[and(parts), ...rest].join('; ')}.`,
    alone: (digits: string, name: string, count: string, until: string, rest: readonly string[]) => `For ${digits}, ${[`${name} needs ${count} evaluations of the force${until ? ` up to t = ${until}` : ''}`, ...rest].join('; ')}.`,
    atMost: (count: string) => `at most ${count}`,
    short: (names: readonly string[]) => `${people(names)} ${names.length > 1 ? 'do' : 'does'} not get so far with the steps measured`,
    exact: (names: readonly string[]) => `${people(names)} ${are(names)} exact at every step measured`,
    none: (names: readonly string[]) => `With the steps measured, ${people(names)} ${names.length > 1 ? 'do' : 'does'} not come to one digit.`,
    axis: 'evaluations of the force',
    counts: (digits: string, list: string) => `Evaluations of the force for ${digits}: ${list}.`,
    count: (name: string, number: string) => `${name} ${number}`,
    meaning: (digits: string, error: string) => `${digits.charAt(0).toUpperCase()}${digits.slice(1)}: the largest error is ${error} of the size of the motion; between two steps that were measured, read off the straight line.`,
    columns: ['method', 'evaluations', 'error', 'step'],
    side: {
      open: 'Side by side at this step',
      name: 'The methods side by side',
      columns: {
        method: 'method', order: 'order', evaluations: 'evaluations', error: 'error', first: 'first-order error', drift: (name: string) => `absolute drift of ${name}`, reversal: 'reversal', note: 'note',
      },
      about: {
        order: 'declared', evaluations: 'of the force', error: 'largest, of the positions', first: 'largest, of the first-order variables', drift: 'largest, in its own units; ↗ where it grows with the time',
        reversal: 'error after going back to the start',
      },
      sort: (column: string) => `Sort by ${column}`,
      at: (step: string) => `At the step ${step}: `,
      exact: 'errors against the exact motion.',
      reference: (name: string, off: string) => `errors against ${name}, itself good to ${off}.`,
      common: (note: string) => `For every method, ${note}.`,
    },
  },

  stability: {
    title: 'Stability',
    question: 'How large may the step be?',
    waiting: 'Asking where the methods are stable …',
    still: 'The force does not depend on the position: no step is too large.',
    stillThere: (count: string) => `At the ${count} moments looked at, the force does not depend on the position: there no step is too large.`,
    rateless: 'Nothing here swings, fades or grows at a rate of its own: no step is too large.',
    grows: (time: string) => `Nothing swings here, the motion itself grows, by the factor e in ${time}: no step runs away from it.`,
    noRates: (why: string) => `The motion could not be linearised: ${why}.`,
    /** What goes before the list of limits. */
    fastest: (at: string) => `where it is fastest, near ${at}, `,
    swing: 'for its fastest swing, ',
    tooLarge: (step: string, names: readonly string[]) => `${step} is too large for ${people(names)}: `,
    below: (step: string, names: readonly string[], first: boolean) => `${first ? 'below ' : ''}${step} for ${people(names)}`,
    any: (names: readonly string[]) => `any step for ${people(names)}`,
    never: (names: readonly string[]) => `no step is small enough for ${people(names)}`,
    slow: (names: readonly string[], alone: boolean) => `${alone ? 'no step is small enough for' : 'nor for'} ${people(names)}, though ${names.length > 1 ? 'they grow' : 'it grows'} slowly`,
    unknown: (names: readonly string[]) => `${people(names)} cannot be judged by a rate here`,
    answer: (lead: string, limits: readonly string[], rest: readonly string[]) => {
      const sentence = `${lead}${[limits.join(', '), ...rest].filter(Boolean).join('; ')}.`;
      return sentence.charAt(0).toUpperCase() + sentence.slice(1);
    },
    boris: (title: string, limit: string) => `${title} turns the velocity about the field by a rotation, which is stable at any step; a swing in the position alone is stable while step times frequency is below ${limit}.`,
    label: (name: string, limit: string) => `${name}: ${limit}`,
    neverLabel: (name: string) => `${name}: never`,
    slowLabel: (name: string) => `${name}: never, though slowly`,
    anyLabel: (name: string) => `${name}: any step`,
    unknownLabel: (name: string) => `${name}: not judged by a rate`,
    axis: 'step × frequency',
    stepAxis: 'step h',
    whole: 'The whole plane',
    bars: 'The bars',
    /** For those who do not see the bars, and above the numbers. */
    inside: 'Step times frequency must stay inside the bar, or the motion grows without end.',
    insideStep: 'The step must stay inside the bar, or the motion grows where it should swing or fade.',
    frequency: (frequency: string, at: string, here: string, several: boolean) => `Its ${at || several ? 'fastest ' : ''}frequency is ${frequency}${at ? `, near ${at}` : ''}; times the step that is ${here}.`,
    linear: (count: string) => `The frequencies are those of the motion linearised at ${count} moments of the run: where they change, the bar is what they allow at those moments, no promise for all between.`,
    own: 'Where the motion itself grows, that is no fault of a method, and is left out here.',
    friction: 'Each rate is taken as that of a single spring with friction.',
    shaded: 'shaded: a step makes the motion grow',
    noGrowth: 'no growth',
    growth: 'growth',
    unstable: (growth: string, where: string) => `Largest growth per step ${growth}, at ${where}: unstable.`,
    over: (steps: string, factor: string) => `Over ${steps} steps that is a factor of ${factor}.`,
    endless: 'more than 10³⁰⁸',
    border: (where: string) => `No growth: ${where} lies on the boundary, as it should for swinging without friction.`,
    damps: (name: string, growth: string, where: string) => `All points are inside. ${name} itself damps: it multiplies by ${growth} a step at ${where}, where nothing is lost in truth.`,
    within: (growth: string, where: string, exact: string) => `All points are inside; largest growth per step ${growth}, at ${where}, where the exact motion has ${exact}.`,
    /** The axes of the plane. */
    real: 'Re hλ', imaginary: 'Im hλ',
    columns: ['time', 'Re λ', 'Im λ', 'Re hλ', 'Im hλ', 'growth per step'],
    note: (name: string, step: string) => `Growth by ${name}, h = ${step}. Of each pair of conjugate rates the upper one is listed.`,
  },
} as const;
