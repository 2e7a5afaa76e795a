/* What ended a run before its end, and where its events accumulate, in a sentence. */
import type { Track } from '../protocol';
import { words } from '../words';
import { nameText } from './name';
import { minus, readable } from './number';

/** The limit of events that accumulate, as it is known: "4.0637127688716(4)". */
export function limitText({ time, error }: { readonly time: number; readonly error: number | null }): string {
  if (error === null || !(error > 0)) return readable(time, 12);
  const digits = Math.max(0, Math.min(17, -Math.floor(Math.log10(error)))), last = Math.ceil(error * 10 ** digits);
  return minus(last > 9 ? `${time.toFixed(digits - 1)}(1)` : `${time.toFixed(digits)}(${last})`);
}

/** What ended a run, or where its events accumulate; ''. */
export function endSaid({ ended, times }: Track, unit: string): string {
  const at = 't = ', tail = unit && `\u2009${unit}`;
  if (!ended) return '';
  if (ended.accumulated) return words.events.accumulates(nameText(ended.accumulates), `${at}${limitText(ended.accumulated)}${tail}`);
  return words.events.ended(nameText(ended.ended ?? ''), `${at}${readable(times[times.length - 1] ?? NaN, 10).replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '')}${tail}`);
}
