/* What pictures have in common: lab/figure/cursor.ts, table.ts, track.ts. */
export const figure = {
  cursor: (title: string) => `Time in “${title}”`,
  table: (title: string) => `${title}: data table`,
  rows: (shown: string, all: string) => `${shown} of ${all} rows, evenly taken; the CSV file has them all.`,
  /** "a", "a and b", "a, b and c"; a list that goes on. */
  list: (names: readonly string[]) => (names.length < 2 ? names.join('') : `${names.slice(0, -1).join(', ')} and ${names[names.length - 1]}`),
  listMore: (names: readonly string[], more: string) => `${names.join(', ')} and ${more} more`,
  notes: (sentences: readonly string[]) => sentences.join(' '),
} as const;
