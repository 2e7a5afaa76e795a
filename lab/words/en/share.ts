/* Sharing: shell/share-menu.ts, caption.ts. */
const copied = (what: string): string => `${what} copied.`, selected = (what: string): string => `${what} selected: press Ctrl+C or ⌘C to copy it.`;

export const share = {
  share: 'Share',
  link: { label: 'The address holds the model, its numbers and the view', copy: 'Copy link', copied: copied('Link'), selected: selected('Link') },
  command: {
    one: 'The same bits from the program', several: 'The same runs, compared by the program', copy: 'Copy as command', copied: copied('Command'), selected: selected('Command'),
  },
  frame: {
    embed: 'Embed', sliders: 'With sliders for', slider: (name: string) => `Slider for ${name}`, step: 'step', label: 'For the HTML of another page',
    copy: 'Copy frame', copied: copied('Frame'), selected: selected('Frame'),
    disk: 'This page lies on a disk, where other pages cannot reach it: let src begin with the address of a copy on a server.',
  },
  program: {
    fold: 'As a C program', label: (method: string) => `Runs ${method} and prints its last row`, copy: 'Copy as C program', copied: copied('C program'), selected: selected('C program'),
  },
  long: 'The model is too long for an address.',
  disk: 'This page lies on a disk: the link opens where the same file is. What follows the # works with any copy of the page.',
  older: 'This is the last state that could be computed; what is typed now has an error.',
  picture: 'The picture, and its numbers', save: 'Save “Motion”', saveAs: (kind: string) => `Save “Motion” as ${kind}`,
  /** Below a saved picture; step: '' where there is none. */
  /** step, tolerance: '' where no method has one. */
  caption: (step: string, tolerance: string, methods: readonly string[]) => [step && `step ${step}`, tolerance && `tolerance ${tolerance}`, methods.join(', ')].filter(Boolean).join(' · '),
  film: {
    film: 'Film', unknown: 'This browser records no WebM. Firefox, and Chrome or Edge, do.', nothing: 'There is no motion to film.', cancel: 'Cancel', cancelLabel: 'Cancel the film',
    recording: (seconds: string) => `Recording ${seconds} s …`, saved: 'The film is saved.', none: 'No film was made.', failed: 'The film could not be made.',
  },
} as const;
