/* The examples: every model of models/, as scenes.ts sorts them.
 *
 * Invariant: the list is that of the build. A model without a scene goes by its own name. Descriptions are the models' own: the sentence that their first
 * comment begins with.
 */
import { data } from '../data';
import { saidOf, sceneOf } from '../scenes';
import type { Presets } from '../share';
import { words } from '../words';
import { ownTitle } from './title';

export const presets: Presets = {
  first: 'thrown-ball',
  text: name => data.presets.find(model => model.name === name)?.text,
  methods: name => sceneOf(name)?.methods ?? [],
  set: name => sceneOf(name)?.set ?? {},
  until: name => sceneOf(name)?.until ?? '',
  section: name => sceneOf(name)?.section,
};

/** The first sentence of a model's own comment. */
export function described(text: string): string {
  const comment: string[] = [];
  for (const line of text.split('\n')) {
    const said = /^#\s?(.*)$/.exec(line)?.[1];
    if (said === undefined || (said.trim() === '' && comment.length)) break;
    comment.push(said.trim());
  }
  return /^.*?\.(?=\s|$)/s.exec(comment.join(' '))?.[0] ?? comment.join(' ');
}

/** What a text on show is called: the example's title while it is the example's. */
export const titleIn = ({ preset, text }: { readonly preset: string; readonly text: string }): string => (preset !== '' && presets.text(preset) === text ? titleOf(preset) : ownTitle(text) || words.headline.own);

export const titleOf = (name: string): string => saidOf(name)?.title ?? name;
