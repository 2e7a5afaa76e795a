/* What stands below a saved picture: the title, the equation, the step and the methods, the link. Invariant: it is said of the scene that the picture shows. */
import type { Scene } from '../scene';
import type { Presets } from '../share';
import { stagingOf } from '../data';
import { words } from '../words';
import { addressOf } from './address';
import { whole } from './embed';
import { short } from './number';
import { titleIn } from './presets';

const longestLink = 400, mostLines = 3;

/** The equation as the text has it, else the first lines of the text. */
function equation({ state: { text, set }, description }: Scene): string {
  const lines = text.split('\n').map((line) => line.replace(/#.*/, '').replace(/\s+/g, ' ').trim()), moved = description.statements.filter(({ kind }) => kind === 'motion' || kind === 'first-order');
  const chosen = moved.map(({ line }) => lines[line - 1] ?? '').filter(Boolean), shown = (chosen.length ? chosen : lines.filter(Boolean)).slice(0, mostLines);
  return [shown.join(';  ') + (chosen.length > mostLines ? ' …' : ''), ...Object.entries(set).map(([name, value]) => `${name} = ${value}`)].join(';  ');
}

export function captionOf(scene: Scene, presets: Presets): string[] {
  const { state, looks, solution } = scene, track = solution.tracks.find((t) => t.tolerance === null), adapting = solution.tracks.find((t) => t.tolerance !== null), unit = stagingOf(state.preset).units?.t;
  // On a disk the link is what follows the #, which any copy of the page takes.
  const address = addressOf(whole(state), presets), link = /^https?:/.test(address) ? address : address.replace(/^[^#]*/, '');
  const step = track ? `${short(Math.abs(track.step), 6)}${unit ? `\u2009${unit}` : ''}` : '';
  return [titleIn(state), equation(scene), words.share.caption(step, adapting ? short(adapting.tolerance ?? 0, 4) : '', looks.map((l) => l.label)),
    link.length > longestLink ? `${link.slice(0, longestLink)}…` : link];
}
