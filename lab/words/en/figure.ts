/* What pictures have in common: lab/figure/cursor.ts, table.ts, track.ts. */
export const figure = {
  cursor: (title: string) => `Time in “${title}”`,
  table: (title: string) => `${title}: data table`,
  rows: (shown: string, all: string) => `${shown} of ${all} rows, evenly taken; the CSV file has them all.`,
  notes: (sentences: readonly string[]) => sentences.join(' '),
} as const;
