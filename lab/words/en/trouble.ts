/* What is wrong with the state of the page: lab/state.ts, shell/status.ts. */
/** The core's sentences, which end without a full stop. */
const ended = (sentence: string): string => (/[.!?…]$/.test(sentence) ? sentence : `${sentence}.`);

export const trouble = {
  tooLarge: (number: string) => `${number} is too large for a number.`,
  noNumber: (text: string) => `“${text}” is no number.`,
  untilStart: (time: string) => `The motion starts at ${time}: an end at the same time leaves nothing to compute.`,
  untilNothing: (time: string) => `The motion starts and ends at ${time}: there is nothing to compute.`,
  stepZero: 'With a step of zero, time would stand still: a number above 0.',
  stepBackward: 'A step is a length of time, above 0. To run backward, set an end before the start.',
  toleranceZero: 'A tolerance is an error that a step may have: a number above 0.',
  accuracyZero: 'An accuracy is an error that the answer may have: a number above 0.', accuracyRange: 'An accuracy is a part of the motion’s size: from 10⁻¹⁵ to below 1.',
  stepMany: (count: string) => `That makes ${count} steps; the page stops at 10 million. The program has no such limit.`,
  stepLong: (span: string) => `The step is longer than the whole motion: one step of ${span} is taken.`,
  noStep: 'The model names no step: type one, for example 0.01.', noUntil: 'The model names no end: type one, for example 10.',
  /** A method that is not shown: the core knows none of that name, or refuses it. */
  unknown: (name: string) => `There is no method “${name}”.`, refused: (name: string, reason: string) => `Not here: ${name} (${reason}).`,
  methods: (sentences: readonly string[]) => sentences.join(' '),
  cancelled: 'The computation was stopped. The picture is the last one that was finished.',
  computing: 'Computing …', cancel: 'Cancel',
  last: 'The last motion that could be read, with its sliders.', model: 'The model has an error; see under its text.',
  numbers: 'The step or the end cannot be used, as said beside them; the picture is the last one that could be computed.',
  /** One method that did not reach the end; all of them. */
  method: (name: string, message: string) => `${name}: ${message}`, does: (name: string, what: string) => `${name} ${what}`, all: (sentences: readonly string[]) => sentences.map(ended).join(' '),
  /** Why nothing could be computed to compare with, as the core says it. */
  noGreen: (why: string) => `There is no green curve: ${why}`,
  /** at: "t = 36.1". */
  noGreenFrom: (by: string, at: string) => `There is no green curve: no digit of ${by} is known from ${at} on`,
  /** What the core says, and what would be right, where it says that. */
  hinted: (message: string, hint: string) => ended(hint ? `${message}: ${hint}` : message),
} as const;
