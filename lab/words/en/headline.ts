/* The words on the stage: shell/headline.ts, presets.ts. */
const numbers = ['no', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight', 'nine', 'ten', 'eleven', 'twelve'];

export const headline = {
  own: 'Your own equation', type: 'Type your own', close: 'Close',
  began: (title: string) => `It began as “${title}”. `, back: 'Back to the example',
  /** In the place of a note whose numbers are those of other values. */
  answered: 'The answer has numbers of the example’s own values, which have been changed.', values: 'Back to its values',
  aside: 'Your own text was put aside.', bring: 'Bring it back',
  /** Up to twelve in words. */
  counted: (count: number, text: string) => numbers[count] ?? text,
} as const;
