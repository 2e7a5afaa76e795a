/* What looks closer: the questions below the stage, each with its answer and its picture.
 *
 * Invariant: nothing is made before somebody scrolls to it; a panel is shown a scene once, and only when it is near what is seen. A panel that has nothing
 * to say of a scene is not there.
 */
import { place } from '../dom';
import { THERE } from '../figure/figure';
import { convergence } from '../panel/convergence';
import { driftPanel } from '../panel/drift';
import { errorPanel } from '../panel/error';
import { eventsPanel } from '../panel/events';
import { phasePanel } from '../panel/phase';
import { precision } from '../panel/precision';
import { sectionPanel } from '../panel/section';
import { stability } from '../panel/stability';
import { timePanel } from '../panel/time';
import type { Panel, Scene, Store } from '../scene';
import type { Sees } from '../stage/stage';

export interface Closer {
  /** A new scene, or the same one in another view. */
  show(scene: Scene): void;
  at(time: number): void;
  redraw(): void;
}
/** A question that is there: its short name, and the way to it. */
export interface Link { readonly title: string; go(): void }

/** Milliseconds after the last change of the window's size. */
const RESIZED = 200;

/** One panel that fails is told of, and does not stop the others. */
function guarded(act: () => void): void {
  try { act(); } catch (error) { reportError(error); }
}

/** stage: what it shows already; links: told whenever a question comes or goes. */
export function closer(store: Store, stage: () => Sees, links: (links: readonly Link[]) => void): Closer {
  const panels: Panel[] = [], near = new Set<Panel>(), section = place('looking'), holder = place('panels');
  // Which of the scenes, counted, each was shown.
  const had = new Map<Panel, number>();
  let scene: Scene | null = null, count = 0, time = 0, told = '';

  function tell(): void {
    const there = panels.filter((panel) => !panel.element.hidden), key = there.map((panel) => panel.title).join('\n');
    if (key === told) return;
    told = key;
    links(there.map((panel) => ({
      title: panel.title,
      go() { panel.element.scrollIntoView(); panel.element.querySelector<HTMLElement>('h3')?.focus({ preventScroll: true }); },
    })));
  }
  function bring(panel: Panel): void {
    if (!scene || panel.element.hidden || had.get(panel) === count) return;
    had.set(panel, count);
    const now = scene;
    guarded(() => { panel.show(now); panel.at(time); });
  }
  function arrange(): void {
    if (!scene || !panels.length) return;
    const now = scene;
    for (const panel of panels) guarded(() => { if (panel.there) panel.element.hidden = !panel.there(now); });
    for (const panel of near) bring(panel);
    tell();
  }
  const approach = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const panel = panels.find((p) => p.element === target);
      if (!panel) continue;
      if (isIntersecting) { near.add(panel); bring(panel); } else near.delete(panel);
    }
    tell();
  }, { rootMargin: '50% 0%' });
  function make(): void {
    panels.push(sectionPanel(store), eventsPanel(store), errorPanel(store), driftPanel(store), timePanel(store, stage), phasePanel(store, stage), convergence(store), precision(store), stability(store));
    for (const panel of panels) {
      panel.element.hidden = panel.there !== undefined;
      holder.append(panel.element);
      approach.observe(panel.element);
    }
    holder.addEventListener(THERE, tell);
    arrange();
  }
  const first = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    first.disconnect();
    make();
    // Where the first screen ends is not yet in sight.
  }, { rootMargin: '0px 0px -1px' });
  first.observe(section);
  // What the stage shows beside the motion depends on its width; it is drawn anew first.
  let resized = 0;
  addEventListener('resize', () => { window.clearTimeout(resized); resized = window.setTimeout(arrange, RESIZED); });

  return {
    show(next) { scene = next; count++; arrange(); },
    at(now) {
      time = now;
      for (const panel of near) if (had.get(panel) === count) guarded(() => panel.at(now));
    },
    redraw() { for (const panel of panels) if (had.has(panel)) guarded(() => panel.redraw()); },
  };
}
