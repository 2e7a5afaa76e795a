/* The frame of a picture: lab/figure/figure.ts. */
export const frame = {
  numbers: 'Numbers',
  save: (title: string) => `Save “${title}”`,
  saveAs: (kind: string) => `Save as ${kind}`,
  saveTitleAs: (title: string, kind: string) => `Save “${title}” as ${kind}`,
} as const;
