/* The lecture: shell/lecture.ts. */
export const lecture = {
  /** In the menu of a phone. */
  word: 'Lecture',
  open: 'Lecture: full screen, large letters (L)', openTitle: 'Lecture (L)', leave: 'Leave the lecture (L)', leaveTitle: 'Leave (L)',
  keys: 'Keys', keysLabel: 'Keys (?)',
  /** Each key, and what it does. */
  list: [['Space', 'play, pause'], ['← →', 'a step back, a step forward'], ['Home, End', 'to the start, to the end'], ['[ ]', 'half the step, twice the step'], ['1 … 9', 'a method on or off'],
    ['Page Down', 'the next part of the lesson; else play'], ['Page Up', 'the part before; else to the start'], ['?', 'these keys'], ['L, Escape', 'leave the lecture']],
} as const;
