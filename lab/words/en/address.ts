/* What is wrong with an address, and with what is copied out of the page: lab/share.ts, lab/program.ts. */
export const address = {
  unusable: (why: string) => `The address could not be used: ${why}. Here is the first example instead.`,
  unreadable: 'it could not be read',
  version: 'it is of a version that this page does not know', noVersion: 'it does not say its version',
  long: (kilobytes: string) => `it is longer than ${kilobytes} KiB`,
  part: (part: string) => `it has a part that this page does not know, “${part}”`,
  code: 'a percent code in it is broken',
  twice: (part: string) => `it says “${part}” twice`,
  example: (name: string) => `there is no example “${name}”`, noModel: 'it holds no model', modelControl: 'the model holds a control character',
  sets: 'it sets too many parameters', setForm: 'a parameter is not written name=value',
  methods: 'it asks for too many methods', place: 'it names a place that does not exist',
  view: 'it asks for a view that does not exist', quantities: 'it asks for too many quantities', axes: 'a phase plane needs two axes',
  exact: '“e” is 0 or 1', speed: 'the speed of the animation is no number above 0',
  embed: '“embed” is 1', noEmbed: 'it chooses sliders, “c”, without “embed=1”', sliders: 'it chooses too many sliders', noSlider: 'a slider has no name',
  embedPlace: 'an embed shows the stage and no other place',
  /** Of the run A that is pinned: it alone is left out. */
  pinned: '“A” is 1', noPin: (why: string) => `The pinned run A of the address could not be used: ${why}.`,
  /** Of a text in the address: that it is too long, that it holds a control character. */
  texts: {
    quantity: { long: 'the name of a quantity is too long', control: 'the name of a quantity holds a control character' },
    parameter: { long: 'the name of a parameter is too long', control: 'the name of a parameter holds a control character' },
    value: { long: 'the value of a parameter is too long', control: 'the value of a parameter holds a control character' },
    method: { long: 'the name of a method is too long', control: 'the name of a method holds a control character' },
    slider: { long: 'the name of a slider is too long', control: 'the name of a slider holds a control character' },
    step: { long: 'the step is too long', control: 'the step holds a control character' },
    tolerance: { long: 'the tolerance is too long', control: 'the tolerance holds a control character' },
    accuracy: { long: 'the accuracy is too long', control: 'the accuracy holds a control character' },
    until: { long: 'the end is too long', control: 'the end holds a control character' },
  },
  command: 'There is no safe command: the model holds a control character.',
  program: { control: 'There is no C program: the model holds a control character.', number: 'There is no C program: the step, the tolerance, the accuracy or the end is no number.' },
} as const;
