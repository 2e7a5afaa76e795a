/* What a view of the motion is, and what all views are given.
 *
 * Invariant: a view keeps no time and no state of the page; what it draws follows from its arguments.
 */
import type { Ink, Pen } from '../../figure/types';
import type { Look, Scene } from '../../scene';
import type { Track, Truth } from '../../protocol';
import type { Subject } from './subject';
import type { Entry } from '../../figure/legend';
import { drawLegend, exactEntry, legendLayout, lookEntry } from '../../figure/legend';

export interface Line { readonly track: Track; readonly look: Look }
export interface Motion { readonly scene: Scene; readonly subject: Subject; readonly lines: readonly Line[]; readonly truth: Truth | null }
export interface View {
  draw(pen: Pen, ink: Ink): void;
  overlay(pen: Pen, ink: Ink, time: number): void;
  /** Sentences about this picture: who left the frame, which scales differ. */
  remarks(): readonly string[];
}

export function motionOf(scene: Scene, subject: Subject): Motion {
  const lines: Line[] = [];
  scene.solution.tracks.forEach((track, k) => { const look = scene.looks[k]; if (look && track.times.length > 0) lines.push({ track, look }); });
  const { truth } = scene.solution;
  const seen = truth && scene.state.view.exact && truth.times.length > 1
    && subject.bodies.every(b => b.columns.every(c => (truth.columns[c]?.length ?? 0) > 0));
  return { scene, subject, lines, truth: seen ? truth : null };
}

function names(motion: Motion, ink: Ink): Entry[] {
  const entries = motion.lines.map(l => lookEntry(l.look));
  if (motion.truth) entries.unshift(exactEntry(ink, truthName(motion)));
  return entries;
}
const truthName = (motion: Motion): string => motion.scene.description.has_exact ? 'exact' : 'reference';

export function heightOfNames(motion: Motion, width: number): number {
  const labels = [...(motion.truth ? [truthName(motion)] : []), ...motion.lines.map(l => l.look.label)];
  return labels.length > 0 ? legendLayout(width, labels).height : 0;
}

/** Draws who is who above the picture and says how high that is. */
export function drawNames(pen: Pen, ink: Ink, motion: Motion): number {
  const entries = names(motion, ink);
  if (entries.length === 0) return 0;
  const layout = legendLayout(pen.width, entries.map(e => e.label));
  drawLegend(pen, ink, entries, layout);
  return layout.height;
}
