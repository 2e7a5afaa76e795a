/* The controls under the motion: shell/transport.ts, step.ts, dials.ts, sliders.ts, end.ts, pin.ts, dock.ts. */
const steps = (count: number, text: string): string => `${text} ${count === 1 ? 'step' : 'steps'}`;

export const dock = {
  all: 'All values', oneStep: 'One step', divided: 'Events divide the steps of this motion: none can be opened.', closer: 'Look closer',
  /** The clock; its keys are in brackets. */
  clock: {
    group: 'Time', play: 'Play (space)', pause: 'Pause (space)', time: 'Present time', speed: 'Speed of the animation',
    back: 'One step back (left arrow)', forward: 'One step forward (right arrow)',
    value: (time: string, end: string) => `t = ${time} of ${end}`,
  },
  step: {
    /** Before the letter h. */
    label: 'Step ', slider: 'Step h', field: 'Step h, as a number', reset: 'Step: back to the model’s', resetTitle: 'Back to the model’s step', suggested: 'suggested', steps,
    /** What the slider says; unit, count (of steps): '' where they are not known. */
    value: (step: string, unit: string, count: string) => `${step}${unit ? ` ${unit}` : ''}${count ? `, ${count}` : ''}`,
    needed: (own: string) => (own ? `A step is needed; the model has ${own}.` : 'A step is needed.'),
  },
  tolerance: {
    label: 'Tolerance', slider: 'Tolerance of a step', field: 'Tolerance of a step, as a number', reset: 'Tolerance: back to the model’s', resetTitle: 'Back to the model’s tolerance',
    /** refused: how many steps were taken back; "0". */
    steps: (count: number, text: string, refused: string) => `${steps(count, text)}${refused === '0' ? '' : `, ${refused} refused`}`,
    value: (tolerance: string, count: string) => `${tolerance}${count ? `, ${count}` : ''}`,
    needed: (own: string) => `A tolerance is needed; the model has ${own}.`,
  },
  accuracy: {
    label: 'Accuracy', slider: 'Accuracy of the answer', field: 'Accuracy of the answer, as a number', reset: 'Accuracy: back to the model’s', resetTitle: 'Back to the model’s accuracy',
    by: 'Accuracy', title: 'Ask how accurate the answer is to be: method and tolerance are found for it',
    step: (step: string) => `step ${step}`, tolerance: (tolerance: string) => `tolerance ${tolerance}`,
    /** label: of the method, ''; how: its tolerance or step; reached: '' where no digit is known. */
    reached: (label: string, how: string, reached: string, holds: boolean) => `${label ? `${label}, ` : ''}${how}: ${holds ? `reached ${reached}` : reached ? `only ${reached}` : 'not reached'}`,
    /** The same in sentences; missed: why it is not reached, in the core's words, ''; why: the method was chosen, ''; trials: runs that were tried. */
    told: (label: string, how: string, wanted: string, reached: string, absolute: boolean, missed: string, why: string, trials: number) =>
      [missed ? `${label}, ${how}: ${missed}.` : `${label} with the ${how} keeps to the accuracy ${wanted}: at the ends of steps no number is off by more than ${reached}${absolute ? '' : ' of its size'}, as ${trials === 1 ? 'a run' : `the last of ${trials} runs`} with a finer one beside it tells.`, why && `It was chosen because ${why}.`].filter(Boolean).join(' '),
    value: (accuracy: string, reached: string) => `${accuracy}${reached ? `, ${reached}` : ''}`,
    needed: (own: string) => `An accuracy is needed, ${own} say.`,
  },
  end: {
    label: 'End t', reset: 'End: back to the model’s',
    needed: (own: string) => (own ? `An end is needed; the model has ${own}.` : 'An end is needed.'),
  },
  long: 'This is too long.',
  sliders: {
    parameters: 'Parameters', start: 'Start',
    field: (name: string) => `${name}, as a number`, reset: (name: string) => `${name}: back to the model’s value`, resetTitle: 'Back to the model’s value',
    many: (name: string, count: string) => `${name}: ${count} numbers`,
    needed: (own: string) => `A number, please; the model has ${own}.`, number: 'A number, please, like 0.5 or 0,5. Expressions belong in the text of the model.',
  },
  pin: {
    pin: 'Pin', title: 'Keep this run in the picture while you change things', label: 'Pin this run to compare with it',
    pinned: (what: string) => `A: ${what} ×`, pinnedLabel: (what: string) => `Pinned run A: ${what}. Let it go`,
    faulty: (why: string) => `The pinned run A could not be computed: ${why}.`,
    /** What the pinned run has that this one has not. */
    tolerance: (tolerance: string) => `tolerance ${tolerance}`, same: 'as now', differs: (what: readonly string[]) => what.join(', '),
  },
} as const;
