/* What the build has packed beside the scripts: the models, the lessons, the cards of methods. Unpacked before the page starts. */
import unpacked from 'virtual:data';
import type { Lesson } from './lessons/read';
import type { Staging } from './stage/staging';
import type { Note } from './words/note';

export interface Data {
  readonly presets: readonly { readonly name: string; readonly text: string }[];
  readonly lessons: readonly Omit<Lesson, 'numbers'>[];
  /** Of the best-known methods, by name; body is XHTML with MathML, well formed. */
  readonly cards: Readonly<Record<string, { readonly title: string; readonly body: string }>>;
  readonly stagings: Readonly<Record<string, Staging>>;
  readonly notes: Readonly<Record<string, Note>>;
  /** For other values than the model's. */
  readonly movedNotes: Readonly<Record<string, Note>>;
  /** The theory, as HTML of the build's own. */
  readonly theory: string;
}
export const data: Data = { presets: [], lessons: [], cards: {}, stagings: {}, notes: {}, movedNotes: {}, theory: '' };

/** The example that this state shows unaltered, by its name; '': it has a text of its own. */
export const exampleOf = (state: { readonly preset: string; readonly text: string }): string =>
  (state.preset !== '' && data.presets.find((p) => p.name === state.preset)?.text === state.text ? state.preset : '');

const plain: Staging = {};
export const stagingOf = (name: string): Staging => (Object.hasOwn(data.stagings, name) ? data.stagings[name] ?? plain : plain);

export async function loadData(): Promise<void> {
  Object.assign(data, await unpacked());
}
