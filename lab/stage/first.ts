/* Runs when the page is built: draws the first picture as SVG, for the sizes that screens have, with the page's own core and the page's own code.
 *
 * Invariant: colours are the names of the page's custom properties, so one picture serves every theme.
 */
import { Answers } from '../answers';
import { Core } from '../core';
import { looksOf, named, inkStyle } from '../figure/ink';
import { grouped } from '../figure/number';
import { svgPen } from '../figure/svg';
import type { Scene } from '../scene';
import { saidOf } from '../scenes';
import { defaultView } from '../share';
import { html, words } from '../words';
import { boundsFor, pictureOf } from './picture';
import { placeOf } from './place';
import { HOME } from './plot';
import type { Staging } from './staging';
import { stagings } from './stagings';
import { subjects } from './subject';

export { notes } from '../words';
export { html, inkStyle, stagings, words };
const stagingOf = (name: string): Staging => stagings[name] ?? {};

/** The stage and the page that each picture is for; the style shows the one that fits best (.first-…), tablets that of the desk. */
const SIZES = [
  { name: 'desk', stage: [1280, 528], page: [1280, 800], column: 290 }, { name: 'wide', stage: [1920, 808], page: [1920, 1080], column: 520 },
  { name: 'phone', stage: [390, 374], page: [390, 844], column: 0 },
  { name: 'landscape', stage: [560, 390], page: [844, 390], column: 0 },
] as const;

export function sceneOf(module: WebAssembly.Module, preset: string, text: string, methods: readonly string[]): Scene {
  const answers = new Answers(new Core(module)), model = { text, set: [] };
  const catalogue = answers.answer('catalogue', {}), solution = answers.answer('solve', { model, methods, step: null, until: null, columns: [], rows: 6000, truth: true });
  return {
    state: { preset, text, set: {}, methods, step: '', until: '', view: defaultView, place: '' }, description: solution.description, solution, looks: looksOf(methods, catalogue, named), catalogue,
  };
}

export function firstPictures(scene: Scene): string {
  const subject = subjects(scene.description, scene.solution)[0]!, staging = stagingOf(scene.state.preset), { times } = scene.solution.tracks[0]!;
  return SIZES.map(({ name, stage: [width, height], page: [w, h], column }) => {
    const place = placeOf(width, height, column, { width: w, height: h }), bounds = boundsFor(scene, subject, staging, false, null);
    const picture = pictureOf({ scene, subject, staging, place, bounds, camera: HOME, before: null, pinned: null }), pen = svgPen(width, height, 1);
    picture.still(pen, named.ink, true);
    picture.moving(pen, named.ink, times[times.length - 1]!);
    return pen.svg().replace('<svg ', `<svg class="first first-${name}" aria-hidden="true" preserveAspectRatio="xMidYMax meet" `).replace(/id="c(\d+)"/g, `id="${name}-c$1"`).replace(/url\(#c(\d+)\)/g, `url(#${name}-c$1)`).replace(/ role="img"| font-family="[^"]*"/g, '');
  }).join('');
}

/** The equation under the title, typeset by the core. */
export const equation = (scene: Scene): string => scene.description.statements.find((s) => s.kind === 'motion')?.mathml ?? '';
/** What is said of the scene: its title, its sentence, the question that leads to a lesson. */
export function said({ state: { preset }, solution }: Scene): { readonly title: string; readonly sentence: string; readonly ask: string } {
  const { title = '', sentence = '', ask = '' } = saidOf(preset) ?? {}, total = solution.tracks[0]?.total ?? 0;
  return { title, ask, sentence: typeof sentence === 'string' ? sentence : sentence(words.headline.counted(total, grouped(total))) };
}
