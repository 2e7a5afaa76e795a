/* The gallery: shell/gallery.ts, lab/scenes.ts. What is said of each scene stands in scenes.ts. */
export const gallery = {
  title: 'What shall move?',
  search: (count: string) => `Search ${count} motions`,
  none: (text: string) => `No motion here has “${text}” in its name, its question or its description.`,
  found: (count: number) => (count === 1 ? '1 motion' : `${count} motions`),
  themes: { first: 'First steps', oscillators: 'Oscillators', events: 'Bounces and kicks', sky: 'In the sky', fields: 'Many bodies, magnetic fields', chaos: 'Chaos' },
} as const;
