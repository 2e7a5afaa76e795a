/* What stands around a lesson: shell/lesson.ts, closeup.ts. The lessons themselves are the texts in lessons/. */
export const lesson = {
  lessons: 'Lessons', done: 'done',
  /** Behind a task, for those who do not see its tick. */
  ticked: ' done', isTicked: (task: string) => `${task}: done`,
  /** The table of what a lesson has measured; unit: '' where there is none. */
  runs: { caption: (end: string, unit: string) => `How far off at ${end}${unit ? `, in ${unit}` : ''}`, step: 'step', none: 'on it' },
  head: (number: string, count: string) => `Lesson ${number} of ${count}`, leave: 'Leave',
  parts: { predict: 'Predict', try: 'Try', see: 'See', why: 'Why' },
  saw: 'What did you see?', why: 'Why?', next: (title: string) => `Next: ${title}`, gallery: 'Back to the gallery',
  /** In the drawings beside an explanation. */
  drawn: {
    step: 'the step', ball: 'the ball', oldSpeed: 'old speed', happens: 'what happens', newSpeed: 'new speed', half: 'half a step, look', on: 'on the ball',
    order1: 'order 1: a half', order2: 'order 2: a quarter', energy: 'energy against time', before: 'before', now: 'now', next: 'next', each: (step: string) => `each step: h = ${step}`,
  },
} as const;
