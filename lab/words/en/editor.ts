/* The text of a model: shell/editor.ts, repair.ts, settle.ts, typeset.ts. */
export const editor = {
  label: 'Model', names: 'Names',
  supposed: 'Chosen for you, not in the text', grey: 'Grey is chosen for you. ', take: 'Write it into the text', takeLine: 'Write this line into the text',
  /** Keys that do something now. */
  keyName: (name: string) => `Tab: ${name} · Escape: no`, keyLine: 'Tab writes the next grey line · Escape: no',
  /** Where an error is: what is seen, what is heard besides, what is seen. */
  place: (line: string, column: string): readonly [string, string, string] => [`Line ${line}`, `, column ${column}`, ': '],
  repair: { add: (text: string) => `Add ${text}`, replace: (text: string) => `Replace by ${text}`, remove: (unit: string) => `Remove the unit ${unit}`, slider: 'Make it a slider' },
  replaced: (list: readonly string[]) => `Sliders and fields replace what the text says: ${list.join(', ')}.`,
  typeset: { all: 'Everything, typeset', model: 'The model, typeset', wide: 'Formula, wider than its place' },
} as const;
