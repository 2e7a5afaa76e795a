/* What stands in the page before any script runs: the build fills lab/index.html with it. Stands alone, as no script needs it. */
export const html = {
  language: 'en',
  title: 'motus lab',
  description: 'Type an equation of motion, see the exact motion, and watch methods leave it or keep to it.',
  play: 'To Play', controls: 'Controls', shown: 'What is shown', motion: 'The motion',
  noscript: 'The motion is computed in this page, by a WebAssembly module that JavaScript starts: both have to be allowed here.',
  places: 'Places', menu: 'Menu', gallery: 'Gallery', closer: 'Look closer', theory: 'Theory', works: 'How it works',
  /** Around the name of the program. */
  before: 'The same C core computes here and in the program ', after: ', to the same bits. Nothing leaves this page.',
} as const;
