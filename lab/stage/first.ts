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
import { LENGTH, LENGTHS } from './fit';
import { boundsFor, pictureOf } from './picture';
import { placeOf } from './place';
import { HOME } from './plot';
import type { Staging } from './staging';
import { stagings } from './stagings';
import { subjects } from './subject';

export { movedNotes, notes } from '../words';
export { html, inkStyle, stagings, words };
const stagingOf = (name: string): Staging => stagings[name] ?? {};

/** The stage and the page that each picture is drawn for; the style shows the one of this kind of screen (.first-…), and fit.ts makes it this screen's. */
const SIZES = [
  { name: 'desk', stage: [1280, 528], page: [1280, 800], column: 290 }, { name: 'wide', stage: [1920, 808], page: [1920, 1080], column: 520 },
  { name: 'tablet', stage: [1024, 390], page: [1024, 768], column: 0 },
  { name: 'phone', stage: [390, 397], page: [390, 844], column: 0 },
  { name: 'landscape', stage: [560, 390], page: [844, 390], column: 0 },
] as const;

export function sceneOf(module: WebAssembly.Module, preset: string, text: string, methods: readonly string[]): Scene {
  const answers = new Answers(new Core(module)), model = { text, set: [] };
  const catalogue = answers.answer('catalogue', {}), solution = answers.answer('solve', { model, methods, step: null, tolerance: null, until: null, columns: [], rows: 6000, truth: true });
  return {
    state: { preset, text, set: {}, methods, step: '', tolerance: '', accuracy: '', until: '', view: defaultView, place: '' }, description: solution.description, solution, looks: looksOf(methods, catalogue, named), catalogue,
  };
}

const lengthsOf = (line: string): readonly string[] => (line.match(LENGTHS) ?? []).flatMap((lengths) => lengths.match(LENGTH) ?? []);
const formOf = (lines: readonly string[]): string => lines.map((line) => line.replace(LENGTHS, (lengths) => lengths.replace(LENGTH, '0'))).join();
/** By how much each length changes with a pixel more to the metre, '' where it does not; "|" before it: it is kept in the middle of a pixel. crisp: as it is
 * drawn; fine: where it belongs; more: the same with so many pixels more. */
function slopes(crisp: readonly string[], fine: readonly string[], more: readonly string[], pixels: number): string[] {
  return crisp.flatMap((line, k) => {
    const now = lengthsOf(fine[k]!), then = lengthsOf(more[k]!);
    return lengthsOf(line).map((drawn, i) => {
      const slope = (Number(then[i]) - Number(now[i])) / pixels;
      return Math.abs(slope) < 1e-3 ? '' : `${Math.abs(Number(drawn) - Number(now[i])) > 0.06 ? '|' : ''}${Number(slope.toFixed(3))}`;
    });
  });
}

/** Wider than any stage: the ground runs on. Larger by so little that a curve has the same corners; what is sorted by size may still change its order. */
const ENDLESS = 4000, LARGER = [1e-5, -1e-5, 2e-5, -2e-5, 5e-5, -5e-5];

export function firstPictures(scene: Scene): string {
  const subject = subjects(scene.description, scene.solution)[0]!, staging = stagingOf(scene.state.preset), { times } = scene.solution.tracks[0]!;
  const bounds = boundsFor(scene, subject, staging, false, null), [across, up] = bounds.map(([low, high]) => high - low) as [number, number];
  return SIZES.map(({ name, stage: [width, height], page: [w, h], column }) => {
    const given = placeOf(width, height, column, { width: w, height: h }), { left, top, right, bottom } = given.frame, unit = Math.min((right - left) / across, (bottom - top) / up);
    /** So many times as large, from the foot of the frame at its left. */
    const draw = (by: number, fine: boolean): string[] => {
      const frame = { left, bottom, right: left + by * (right - left), top: bottom - by * (bottom - top) }, place = { ...given, width: width + frame.right - right, frame, fine };
      const picture = pictureOf({ scene, subject, staging, place, bounds, camera: HOME, before: null, pinned: null }), pen = svgPen(ENDLESS, height, fine ? 8 : 1);
      // Nothing of this motion lies outside of the stage.
      const whole = { ...pen, clip: (_x: number, _y: number, _w: number, _h: number, inside: () => void): void => inside() };
      picture.still(whole, named.ink, true);
      picture.moving(whole, named.ink, times[times.length - 1]!);
      return pen.svg().replace(/^<svg [^>]*>|<\/svg>\n$/g, '').replace(/"M0 /g, `"M${-ENDLESS} `).split('\n');
    };
    const drawn = draw(1, false), fine = draw(1, true), by = LARGER.find((part) => formOf(draw(1 + part, true)) === formOf(fine));
    if (by === undefined || formOf(drawn) !== formOf(fine)) throw new Error(`The first picture, ${name}, cannot follow the size of its stage`);
    const of = slopes(drawn, fine, draw(1 + by, true), unit * by);
    const fit = [left, width - right, top, height - bottom, across, up, unit, height, column].map((n) => Number(n.toFixed(4)));
    return `<svg class="first first-${name}" data-fit="${fit.join(' ')}" data-slopes="${of.join(' ').trimEnd()}" viewBox="0 0 ${width} ${height}" preserveAspectRatio="xMidYMax meet" aria-hidden="true" fill="none" stroke-linejoin="round" font-size="12">${drawn.join('\n')}</svg>`;
  }).join('');
}

/** The equation under the title, typeset by the core. */
export const equation = (scene: Scene): string => scene.description.statements.find((s) => s.kind === 'motion')?.mathml ?? '';
/** What is said of the scene: its title, its sentence, the question that leads to a lesson. */
export function said({ state: { preset }, solution }: Scene): { readonly title: string; readonly sentence: string; readonly ask: string } {
  const { title = '', sentence = '', question: ask = '' } = saidOf(preset) ?? {}, total = solution.tracks[0]?.total ?? 0;
  return { title, ask, sentence: typeof sentence === 'string' ? sentence : sentence(words.headline.counted(total, grouped(total))) };
}
