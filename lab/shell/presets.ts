/* The examples: every model of models/, as scenes.ts names and sorts them.
 *
 * Invariant: the list is that of the build. A model without a scene goes by its own name. Descriptions are the models' own: the sentence that their first
 * comment begins with.
 */
import { data } from '../data';
import { sceneOf } from '../scenes';
import type { State } from '../scene';
import { stagingOf, type Staging } from '../stage/staging';
import type { Presets } from '../share';

export const presets: Presets = {
  first: 'thrown-ball',
  text: name => data.presets.find(model => model.name === name)?.text,
  methods: name => sceneOf(name)?.methods ?? [],
  set: name => sceneOf(name)?.set ?? {},
};

/** The first sentence of a model's own comment. */
export function described(text: string): string {
  const comment: string[] = [];
  for (const line of text.split('\n')) {
    const words = /^#\s?(.*)$/.exec(line)?.[1];
    if (words === undefined || (words.trim() === '' && comment.length)) break;
    comment.push(words.trim());
  }
  return /^.*?\.(?=\s|$)/s.exec(comment.join(' '))?.[0] ?? comment.join(' ');
}

export const titleOf = (name: string): string => sceneOf(name)?.title ?? name;
/** How a state stands on the stage: an example's units and frame say nothing of another text. */
export const stagingFor = ({ preset, text }: State): Staging => stagingOf(presets.text(preset) === text ? preset : '');
