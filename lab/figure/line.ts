/* The line of a track: the motion between the ends of its steps where that is known, else what lies straight between them. */
import type { Track } from '../protocol';

export interface Rows { readonly times: Float64Array; readonly columns: readonly Float64Array[] }

/** For pictures of these columns. */
export const lineOf = (track: Track, columns: readonly number[]): Rows => (track.curve && columns.every((c) => track.curve!.columns[c]?.length) ? track.curve : track);
