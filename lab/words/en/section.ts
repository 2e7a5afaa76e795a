/* The section of a motion: panel/section.ts. */
export const section = {
  title: 'Section',
  question: 'Where does it pass?',
  when: 'When', whenTitle: 'A condition, such as “x = 0 rising” or “every 2 pi”, or the name of an event of the model',
  across: 'Across', up: 'Up', modulo: (name: string) => `${name} mod 2π`,
  clear: 'Clear', take: 'Take a section',
  /** of: the condition; at: how far the motion has been followed. */
  answer: (by: string, of: string, points: string, at: string, motions: string) => `By ${by}, ${of}: ${points} up to ${at}${motions}.`,
  points: (count: string, one: boolean) => (one ? 'one point' : `${count} points`), motions: (count: string) => `, and those of ${count} more motions`, motion: ', and those of one more motion',
  never: (by: string, of: string, at: string) => `By ${by}, ${of} does not happen up to ${at}.`,
  /** why: what the run said. */
  failed: (by: string, of: string, why: string) => `By ${by}, there is no section for ${of}: ${why}.`,
  unknown: (name: string, why: string) => `There is no event “${name}”: ${why}.`,
  empty: 'A section needs a condition, such as “x = 0 rising”, or the name of an event.',
  hint: 'A click starts a motion there.',
  fixed: 'These axes are no numbers of the state: a click starts nothing.',
  /** Of the plane, for the keyboard. */
  plane: 'Plane of the section: arrow keys move the cross, Enter starts a motion there',
  at: (x: string, y: string) => `${x}, ${y}`,
  stopped: (why: string) => `The motion stops: ${why}.`,
  hinted: (message: string, hint: string) => (hint ? `${message}: ${hint}` : message),
  summary: (up: string, across: string, of: string, points: string) => `${up} against ${across} whenever ${of}: ${points}.`,
  motionOf: 'motion',
} as const;
