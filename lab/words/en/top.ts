/* The header, what stands anywhere in the page, and what is printed: shell/shell.ts, history.ts, theme.ts, toasts.ts, print.ts, embed.ts. */
export const top = {
  places: { gallery: 'Gallery', lessons: 'Lessons', equation: 'Equation' },
  /** Of the window. */
  title: (scene: string) => `${scene} · motus lab`,
  undo: 'Undo', undoKey: 'Undo (Ctrl+Z)',
  dismiss: 'Dismiss',
  /** Colours: as the system has them, light, dark; what they are, and what the button does. */
  theme: {
    auto: { now: 'Colours: automatic', change: 'Colours: automatic. Change to light' },
    light: { now: 'Colours: light', change: 'Colours: light. Change to dark' },
    dark: { now: 'Colours: dark', change: 'Colours: dark. Change to automatic' },
  },
  whole: 'Open in motus lab',
  print: {
    exact: (time: string) => `Distance from the exact motion at t = ${time}`, reference: (time: string) => `Distance from the reference at t = ${time}`,
    method: 'Method', steps: 'Steps',
    /** unit: '' where there is none. */
    step: (unit: string) => (unit ? `Step (${unit})` : 'Step'), distance: (unit: string) => (unit ? `Distance (${unit})` : 'Distance'),
    /** In place of a step. */
    tolerance: (tolerance: string) => `tolerance ${tolerance}`,
    before: 'ends before',
  },
} as const;
