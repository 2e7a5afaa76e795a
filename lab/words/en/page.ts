/* The page as a whole: lab/main.ts, lab/failed.ts. */
export const page = {
  failed: (why: string) => `The page could not start: ${why}. It needs WebAssembly, and a browser of the last few years.`,
} as const;
