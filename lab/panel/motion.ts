/* The motion: what moves, the exact motion and every method's, at the present time. The first thing a reader looks at.
 *
 * Invariant: the whole motion stays in view; only what is at the present time is drawn in a frame of the animation.
 */
import { figure } from '../figure/figure';
import type { FigureDefinition, Table } from '../figure/types';
import { brief } from '../figure/number';
import type { Panel, Scene, Store } from '../scene';
import type { Subject } from './motion/subject';
import { subjects } from './motion/subject';
import type { View } from './motion/view';
import { heightOfNames, motionOf } from './motion/view';
import { linesView } from './motion/lines_view';
import { planeBackdrop, scalesAgree, timeBackdrop } from './motion/flat';
import { viewBox } from './motion/view_box';
import { HOME, spaceBackdrop, turned } from './motion/space';
import { shapeView } from './motion/shape_view';
import { turnable } from './motion/turnable';

export function motionPanel(store: Store): Panel {
  let scene: Scene | null = null, view: View | null = null, subject: Subject | null = null, choices: readonly Subject[] = [];
  let time = 0, chosen = '';
  /* null: as the motion's proportions suggest. */
  let equalAsked: boolean | null = null;
  const camera = { ...HOME };

  const plane = document.createElement('select');
  plane.addEventListener('change', () => {
    chosen = plane.value;
    const kind = choices.find(s => s.id === chosen)?.kind;
    equalAsked = null;
    if (scene) show(scene);
    /* The address remembers the kind of view; which of several planes is a matter of the moment. */
    if (kind) store.look({ plane: kind === 'shape' ? 'auto' : kind });
  });
  const planeLabel = labelled('view', plane);

  const equal = document.createElement('input');
  equal.type = 'checkbox';
  equal.addEventListener('change', () => { equalAsked = equal.checked; if (scene) show(scene); });
  const equalLabel = labelled('equal scales', equal, true);

  const definition: FigureDefinition = {
    id: 'motion', title: 'Motion', aspect: 0.56, tallest: 0.58,
    /* The names stand above the picture, not in its place; and a narrow page gives a picture that is higher than wide. */
    extra: width => namesHeight(width) + Math.max(0, Math.min(0.5 * width, 640 - width)) + (subject?.kind === 'space' ? 0.1 * width : 0),
    draw: (pen, ink) => view?.draw(pen, ink),
    overlay: (pen, ink) => view?.overlay(pen, ink, time),
    summary, table,
    controls: [planeLabel, equalLabel],
  };
  const shown = figure(definition);
  const turning = turnable(shown.canvas, (turn, rise) => {
    if (turn === null) Object.assign(camera, HOME); else turned(camera, turn, rise);
    shown.redraw();
    shown.redrawOverlay();
  });

  function namesHeight(width: number): number {
    return scene && subject ? heightOfNames(motionOf(scene, subject), width) : 0;
  }

  function pick(): Subject | null {
    const wanted = store.state.view.plane;
    return choices.find(s => s.id === chosen) ?? choices.find(s => wanted !== 'auto' && s.kind === wanted) ?? choices[0] ?? null;
  }

  function offer(): void {
    const same = plane.options.length === choices.length && choices.every((s, i) => plane.options[i]?.value === s.id && plane.options[i]?.text === s.label);
    if (!same) plane.replaceChildren(...choices.map(s => new Option(s.label, s.id)));
    if (subject) plane.value = subject.id;
    planeLabel.style.display = choices.length < 2 ? 'none' : '';
    equalLabel.style.display = subject?.kind !== 'plane' ? 'none' : '';
  }

  function show(next: Scene): void {
    if (scene && scene.state.preset !== next.state.preset) { chosen = ''; equalAsked = null; Object.assign(camera, HOME); }
    scene = next;
    choices = subjects(next.description, next.solution);
    subject = pick();
    offer();
    view = subject ? viewOf(next, subject) : null;
    turning.enable(subject?.kind === 'space');
    shown.say(!view ? 'This model has no positions to show.' : next.solution.tracks.length === 0 && !next.solution.truth ? 'Choose a method to see its motion.' : '');
    shown.redraw();
    shown.redrawOverlay();
  }

  function viewOf(of: Scene, what: Subject): View {
    const motion = motionOf(of, what);
    if (what.kind === 'shape') return shapeView(motion);
    if (what.kind === 'space') return linesView(motion, spaceBackdrop(what.axes, camera), true);
    if (what.kind === 'time') return linesView(motion, timeBackdrop(what.axes[1] ?? ''));
    const cloud = (from: { readonly columns: readonly Float64Array[] }) => [0, 1].map(k => what.bodies.map(b => from.columns[b.columns[k]!] ?? new Float64Array(0)));
    const box = viewBox(motion.truth ? cloud(motion.truth) : null, motion.lines.map(l => cloud(l.track)), 2);
    const together = equalAsked ?? scalesAgree(box);
    equal.checked = together;
    return linesView(motion, planeBackdrop(what.axes, () => together));
  }

  function summary(): string {
    if (!scene || !subject || !view) return 'Nothing to show yet.';
    const { solution, looks } = scene;
    const times = solution.truth?.times ?? solution.tracks[0]?.times ?? new Float64Array([0]);
    const from = times[0] ?? 0, to = times[times.length - 1] ?? 0;
    const seen = subject.kind === 'shape' ? `Shape of the family ${subject.bodies[0]?.label ?? ''}, number by number`
      : subject.kind === 'time' ? `${subject.axes[1] ?? ''} over time`
        : subject.kind === 'space' ? `Path in space` : `Path in the plane of ${subject.axes[0]} and ${subject.axes[1]}`;
    const errors = solution.errors.map(e => ({ name: looks.find(l => l.method === e.method)?.label ?? e.method, last: e.x[e.x.length - 1] ?? NaN }))
      .filter(e => Number.isFinite(e.last));
    const told = errors.length === 0 ? '' : ` At the end the distance from the ${scene.description.has_exact ? 'exact motion' : 'reference'} is ${errors.map(e => `${brief(e.last, 3)} for ${e.name}`).join(', ')}.`;
    const remarks = view.remarks().map(r => ` ${r.charAt(0).toUpperCase()}${r.slice(1)}.`).join('');
    return `${seen}, from t = ${brief(from)} to ${brief(to)}.${told}${remarks}`;
  }

  function table(): Table {
    if (!scene || !subject) return { head: [], rows: [] };
    const { solution, looks } = scene, columns = subject.bodies.flatMap(b => b.columns);
    const head = ['motion', 't', ...columns.map(c => solution.columns[c] ?? '')];
    const rows: (string | number)[][] = [];
    const add = (name: string, of: { readonly times: Float64Array; readonly columns: readonly Float64Array[] }): void =>
      of.times.forEach((t, i) => rows.push([name, t, ...columns.map(c => of.columns[c]?.[i] ?? NaN)]));
    solution.tracks.forEach((track, k) => add(looks[k]?.label ?? track.method, track));
    if (solution.truth && !solution.truth.coarse && columns.every(c => (solution.truth?.columns[c]?.length ?? 0) > 0)) add(scene.description.has_exact ? 'exact' : 'reference', solution.truth);
    return { head, rows };
  }

  return {
    id: 'motion', title: 'Motion', element: shown.element, show,
    at(now) { if (now !== time) { time = now; shown.redrawOverlay(); } },
    redraw() { shown.redraw(); shown.redrawOverlay(); },
  };
}

function labelled(text: string, control: HTMLElement, after = false): HTMLLabelElement {
  const label = document.createElement('label');
  const words = document.createElement('span');
  words.textContent = text;
  label.append(...(after ? [control, words] : [words, control]));
  return label;
}
