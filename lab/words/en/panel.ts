/* The pictures that look closer: lab/panel/. */
export const panel = {
  leaves: (name: string) => `${name} leaves`,
  others: (count: number) => `${count} methods`,
} as const;
