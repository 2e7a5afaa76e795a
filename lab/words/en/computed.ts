/* What the page itself says of a computation: against a question to the core, in a sentence and what would be right, and what a draft is called:
 * lab/answers.ts, core.ts, client.ts, draft.ts. What the core says stays the core's. Stands alone, as the workers need no more. */
export const computed = {
  steps: (count: string, step: string, most: string) => `${count} steps of ${step} are more than a page should take (${most})`,
  nearer: 'a larger step, a nearer end, or the program motus',
  adapting: (count: string) => `${count} steps, and the end is not reached: more than a page should take`,
  slow: (seconds: string) => `this takes longer than ${seconds} seconds`,
  column: (name: string) => `there is no column ${name}`, columns: (names: readonly string[]) => `columns: ${names.join(', ')}`,
  noEnd: 'the model names no end', end: 'an end',
  points: (count: string) => `${count} points`, mostPoints: (most: string) => `at most ${most} points`,
  region: (width: string, height: string) => `a region of ${width} by ${height} points`,
  eigenvalues: (count: string) => `${count} eigenvalues are too many to look at`, most: (most: string) => `at most ${most}`,
  room: (why: string) => `the page has not enough room for this (${why})`,
  smaller: 'fewer brackets and definitions within one another, a smaller model, or the program motus',
  draft: (method: string, step: string) => `${method} at step ${step}`,
  unreachable: (kept: readonly string[]) => (kept.length ? `No motion with this ${kept.join(' and ')} passes there.` : 'No motion passes there.'),
  undrawn: 'the runs that were tried do not agree well enough to be drawn',
  memory: 'out of memory', fewer: 'a smaller model, fewer steps',
  worker: (why: string) => (why ? `the worker failed: ${why}` : 'the worker failed'), model: 'a smaller model',
} as const;
