/* What events did: panel/events.ts, shell/status.ts, stage/picture.ts. */
const plural = (name: string): string => (/[a-rt-w]$/.test(name) ? `${name}s accumulate` : `${name} accumulates`);
export const events = {
  title: 'Events',
  question: 'What happens, and when?',
  by: (name: string) => `By ${name}, `,
  once: (name: string, at: string) => `${name} happens once, at ${at}`,
  twice: (name: string, first: string, last: string) => `${name} happens twice, at ${first} and ${last}`,
  times: (name: string, count: string, first: string, last: string) => `${name} happens ${count} times, first at ${first}, last at ${last}`,
  none: 'Nothing that the events wait for happened.',
  list: (parts: readonly string[]) => `${parts.join('; ')}.`,
  /** name: of the kind of event; at: the limit of the times, with its error where that is known. */
  accumulates: (name: string, at: string) => `${plural(name)} at ${at}`,
  ended: (name: string, at: string) => `${name} ended the run at ${at}`,
  limit: 'limit',
  of: 'By', table: 'Table of events',
  head: { event: 'event', count: 'count', touched: 'touched', full: ', with its error' },
  touched: 'touched',
  seek: (name: string, at: string) => `Go to ${name} at t = ${at}`,
  more: (count: string) => `… ${count} more`,
  jumps: (before: string, after: string) => `${before} → ${after}`,
  /** Of so many rows the state is known; beyond them the two runs that the errors come from have other events. */
  known: (count: string) => `From event ${count} on no digit is known: another rounding leads to other events.`,
  first: (shown: string, all: string) => `The first ${shown} of ${all} events are kept here; the program keeps all.`,
  state: 'State on arrival → as the event left it; one number where nothing jumps. The CSV has all rows and numbers.',
  summary: (list: string) => `Marks on a line of time for each kind of event and each method: ${list}.`,
} as const;
