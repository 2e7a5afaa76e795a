/* Step by step: one step of the main method opened up; what it does drawn, event by event, and the numbers in its formulas.
 *
 * Invariant: the step on show is the one that the time of the page lies in, or that ends at it; so going a step on shows the step just made.
 * Numbers come from the core's own account of the step. A step is asked for only when the one before has come, so a fast clock skips some.
 */
import { figure } from '../figure/figure';
import type { Table } from '../figure/types';
import { brief } from '../figure/number';
import type { Panel, Scene, Store } from '../scene';
import type { Trace, Track } from '../protocol';
import { SEEK } from '../figure/cursor';
import { STEP_EVENT } from '../shell/transport';
import type { Told } from './steps/told';
import { tell } from './steps/told';
import type { Plane } from './steps/sketch';
import { planesOf, sketch } from './steps/sketch';
import type { LocalExact } from './steps/local_exact';
import { localExact } from './steps/local_exact';
import type { Curve } from './steps/picture';
import { drawStep, keyHeight } from './steps/picture';
import { eventList } from './steps/event_list';

/* Milliseconds between one step shown and the next, while the clock runs. */
const PAUSE = 160;

export function stepsPanel(store: Store): Panel {
  let scene: Scene | null = null, trace: Trace | null = null, exact: LocalExact | null = null;
  let index = 0, time = 0, event = -1, plane: Plane | null = null, planes: readonly Plane[] = [], chosen = '';
  /* How many times the scene has changed: an answer to an older scene is not shown. */
  let age = 0, asking = false, shownKey = '';
  /* What the latest answer, or refusal, was about. */
  let toldAge = -1, toldIndex = -1;
  let visible = false, waiting = 0, lastLoad = -Infinity;

  const byVelocity = (): boolean => scene?.description.velocity_dependent === true;
  const button = (text: string, label: string, act: () => void): HTMLButtonElement => {
    const b = document.createElement('button');
    b.type = 'button';
    b.className = 'steps-button';
    b.textContent = text;
    b.setAttribute('aria-label', label);
    b.addEventListener('click', act);
    return b;
  };
  const group = (name: string, ...children: HTMLElement[]): HTMLElement => {
    const g = document.createElement('div');
    g.className = 'steps-group';
    g.setAttribute('role', 'group');
    g.setAttribute('aria-label', name);
    g.append(...children);
    return g;
  };
  const stepName = document.createElement('span');
  stepName.className = 'steps-name';
  const select = document.createElement('select');
  select.addEventListener('change', () => { chosen = select.value; choosePlane(); refresh(); });
  const view = document.createElement('label');
  view.append('view ', select);
  const first = button('⇤', 'First part of the step', () => goTo(0)), last = button('⇥', 'Last part of the step', () => goTo(lastEvent()));

  const shown = figure({
    id: 'steps', title: 'Step by step', aspect: 0.56, extra: width => keyHeight(width) + Math.max(0, Math.min(0.3 * width, 480 - width)),
    draw(pen, ink) {
      const look = scene?.looks[0];
      if (!scene || !trace || !plane || !look) return;
      drawStep(pen, ink, { marks: sketch(trace, plane), event: event < 0 ? lastEvent() : event, plane, look, local: localCurve(plane), whole: wholeCurve(plane) });
    },
    summary, table,
    controls: [
      group('Step', button('‹ step', 'One step back', () => move(-1)), stepName, button('step ›', 'One step forward', () => move(1))),
      group('Part', first, button('‹ part', 'The part before', () => goBy(-1)), button('part ›', 'The next part', () => goBy(1)), last),
      view,
    ],
  });
  const list = eventList(k => goTo(k));
  const element = document.createElement('section');
  element.className = 'stepwise';
  element.setAttribute('aria-label', 'Step by step');
  const parts = document.createElement('div');
  parts.className = 'stepwise-parts';
  parts.append(shown.element, list.element);
  element.append(parts);

  const main = (): Track | null => scene?.solution.tracks[0] ?? null;
  const lastEvent = (): number => Math.max(0, (trace?.entries.length ?? 1) - 1);

  /* The step that contains the time, or ends at it; at the start, the first. */
  function indexAt(t: number): number {
    const track = main();
    if (!track || track.times.length < 2) return 0;
    const { times } = track, forward = times[times.length - 1]! >= times[0]!;
    const steps = Math.max(1, track.steps);
    if (track.every === 1) {
      let low = 0, high = times.length - 1;       // times[low] before t (or the start), times[high] at or after it
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (forward ? times[middle]! < t : times[middle]! > t) low = middle; else high = middle;
      }
      return low;
    }
    return Math.min(steps - 1, Math.max(0, Math.ceil(Math.abs(t - times[0]!) / Math.abs(track.step) - 1e-9) - 1));
  }

  /* The clock of the page is stopped and moved to the end of the step, and moves all panels; this one among them. */
  function move(n: number): void {
    const track = main(), total = trace?.total ?? 1;
    if (!track) return;
    const k = Math.min(total - 1, Math.max(0, index + n)), last = track.times[track.times.length - 1] ?? 0;
    const end = track.every === 1 ? track.times[k + 1] ?? last : k === total - 1 ? last : track.times[0]! + (k + 1) * Math.abs(track.step) * Math.sign(last - track.times[0]!);
    element.dispatchEvent(new CustomEvent(STEP_EVENT, { detail: 0, bubbles: true }));
    element.dispatchEvent(new CustomEvent(SEEK, { detail: end, bubbles: true }));
    refresh();
  }
  function goTo(k: number): void { event = k; refresh(); }
  function goBy(n: number): void {
    const now = event < 0 ? lastEvent() : event, next = now + n;
    if (next >= 0 && next <= lastEvent()) { goTo(next); return; }
    /* Past the last event comes the next step's first one. */
    if (n > 0 && index + 1 < (trace?.total ?? 1)) { event = 0; move(1); }
    else if (n < 0 && index > 0) { event = -1; move(-1); }
  }

  /* While the clock runs, a step is looked at a few times a second, and not at all where nobody can see it. */
  function stale(): void {
    if (waiting || !visible || !scene) return;
    const due = PAUSE - (performance.now() - lastLoad);
    waiting = window.setTimeout(() => { waiting = 0; void load(); }, Math.max(0, due));
  }
  new IntersectionObserver(entries => {
    visible = entries[entries.length - 1]?.isIntersecting ?? false;
    if (toldIndex !== index || toldAge !== age) stale();
  }, { rootMargin: '20% 0%' }).observe(element);

  async function load(): Promise<void> {
    if (asking || !scene) return;
    asking = true;
    lastLoad = performance.now();
    let asked = age, wanted = index;
    try {
      for (;;) {
        const track = main(), of = scene;
        asked = age; wanted = index;
        if (!track) break;
        const { state } = of;
        const found = await store.client.ask('trace', {
          model: { text: state.text, set: Object.entries(state.set).map(([name, value]) => `${name}=${value}`) }, method: track.method,
          step: track.step, until: untilOf(of), index: wanted,
        }, { lane: 'quick', key: 'trace' });
        toldAge = asked; toldIndex = wanted;
        if (asked === age) {
          trace = found;
          exact = null;
          accept();
        }
        if (asked !== age) continue;
        /* Only where the reader stays is it worth asking for the exact motion as well. */
        await new Promise(done => { window.setTimeout(done, PAUSE); });
        if (asked !== age || wanted !== index) { if (visible) continue; break; }
        const around = await localExact(store.client, of, found);
        if (asked === age && wanted === index) { exact = around; refresh(); break; }
      }
    } catch (reason) {
      toldAge = asked; toldIndex = wanted;
      if (asked !== age) return;
      trace = null;
      shown.say(`This step cannot be shown: ${reason instanceof Error ? reason.message : 'no answer'}`);
      list.show([], 0, '');
    } finally {
      asking = false;
      if (toldAge !== age || toldIndex !== index) stale();
    }
  }

  function accept(): void {
    if (!trace) return;
    if (trace.entries.length === 0) { shown.say('The run is over: there is no step left to take.'); list.show([], 0, ''); return; }
    shown.say('');
    if (event > lastEvent()) event = lastEvent();
    planes = planesOf(trace);
    const key = planes.map(p => p.id).join();
    if (key !== shownKey) {
      shownKey = key;
      select.replaceChildren(...planes.map(p => new Option(p.label, p.id)));
      view.style.display = planes.length < 2 ? 'none' : '';
    }
    choosePlane();
    refresh();
  }
  function choosePlane(): void {
    plane = planes.find(p => p.id === chosen) ?? planes[0] ?? null;
    if (plane) select.value = plane.id;
  }

  function told(): readonly Told[] {
    if (!trace || !plane) return [];
    const { indices } = plane, of = trace;
    return of.entries.map((_, k) => tell(of, k, indices, byVelocity()));
  }

  function refresh(): void {
    if (!trace || trace.entries.length === 0) return;
    stepName.textContent = `${(trace.index + 1).toLocaleString('en')} of ${trace.total.toLocaleString('en')}`;
    list.show(told(), event < 0 ? lastEvent() : event, errorSaid());
    shown.redraw();
  }

  /* The largest difference in a position between the step's end and the exact motion from its start. */
  function localError(): number | null {
    const end = trace?.entries[lastEvent()];
    if (!trace || !exact || !end) return null;
    let largest = 0;
    for (const [k, name] of trace.names.x.entries()) {
      const column = exact.columns.get(name);
      if (column) largest = Math.max(largest, Math.abs(end.x[k]! - column[column.length - 1]!));
    }
    return largest;
  }
  function errorSaid(): string {
    const local = localError(), track = main(), errors = scene?.solution.errors.find(e => e.method === track?.method);
    const soFar = track?.every === 1 ? errors?.x[(trace?.index ?? index) + 1] : undefined;
    /* What is left of a difference between numbers of this size is rounding. */
    const size = Math.max(...(trace?.entries[0]?.x ?? [0]).map(Math.abs), ...(trace?.entries[lastEvent()]?.x ?? [0]).map(Math.abs));
    const rounding = local !== null && local <= 32 * Number.EPSILON * size;
    return [
      local === null ? '' : rounding ? 'Local error of this step: none but rounding.' : `Local error of this step: ${brief(local, 3)}, its distance from the exact motion that starts where it starts.`,
      soFar !== undefined && Number.isFinite(soFar) ? `Error after all steps up to here: ${brief(soFar, 3)}.` : '',
    ].filter(Boolean).join(' ');
  }

  function localCurve(of: Plane): Curve | null {
    if (!exact || !trace) return null;
    const column = (k: number): Float64Array | undefined => exact?.columns.get(trace?.names.x[k] ?? '');
    const y = column(of.indices[of.indices.length - 1]!), x = of.indices.length > 1 ? column(of.indices[0]!) : exact.times;
    return x && y ? { x, y } : null;
  }
  function wholeCurve(of: Plane): Curve | null {
    const truth = scene?.solution.truth;
    if (!truth || !trace || !scene?.state.view.exact) return null;
    const column = (k: number): Float64Array | undefined => truth.columns[scene?.solution.columns.indexOf(trace?.names.x[k] ?? '') ?? -1];
    const y = column(of.indices[of.indices.length - 1]!), x = of.indices.length > 1 ? column(of.indices[0]!) : truth.times;
    if (!x || !y || y.length === 0) return null;
    /* The part around this step: two steps to either side. */
    const start = trace.entries[0]!, reach = 3 * Math.abs(start.step);
    let low = 0, high = truth.times.length;
    while (low < high && Math.abs(truth.times[low]! - start.time) > reach) low++;
    while (high > low && Math.abs(truth.times[high - 1]! - start.time) > reach) high--;
    return high - low < 2 ? null : { x: x.subarray(low, high), y: y.subarray(low, high) };
  }

  function summary(): string {
    if (!trace || !scene || trace.entries.length === 0) return 'No step to show yet.';
    const start = trace.entries[0]!, end = trace.entries[lastEvent()]!, k = event < 0 ? lastEvent() : event;
    const what = plane ? tell(trace, k, plane.indices, byVelocity()) : null;
    return `Step ${trace.index + 1} of ${trace.total} by ${scene.looks[0]?.label ?? trace.method}, from t = ${brief(start.time, 6)} to ${brief(end.time, 6)}. `
      + `Part ${k + 1} of ${trace.entries.length}: ${what?.title ?? ''}.${what?.note ? ` ${what.note}` : ''} Arrows show h v and h² a: what a velocity and an acceleration do in one step.`;
  }

  function table(): Table {
    if (!trace) return { head: [], rows: [] };
    const { names } = trace;
    return {
      head: ['part', 'what', 't', ...names.x, ...names.v, ...names.v.map(n => n.includes("'") ? n.replace("'", "''") : `${n}'`)],
      rows: trace.entries.map((e, k) => [k + 1, e.kind, e.time, ...e.x, ...e.v, ...(e.a ?? names.v.map(() => NaN))]),
      note: 'Positions, velocities and accelerations after each event.',
    };
  }

  return {
    id: 'steps', title: 'Step by step', element,
    show(next) {
      const other = scene?.state.text !== next.state.text || scene?.state.methods[0] !== next.state.methods[0];
      scene = next;
      age++;
      if (other) event = -1;
      if (next.solution.tracks.length === 0) { trace = null; shown.say('Choose a method to see its steps.'); list.show([], 0, ''); return; }
      index = indexAt(time);
      stale();
    },
    at(now) {
      if (now === time) return;
      time = now;
      const wanted = indexAt(now);
      if (wanted === index) return;
      index = wanted;
      stale();
    },
    redraw() { shown.redraw(); },
  };
}

function untilOf(scene: Scene): number | null {
  const { tracks, truth } = scene.solution;
  const times = truth?.times ?? tracks.find(t => !t.problem)?.times;
  return times && times.length > 0 ? times[times.length - 1]! : scene.description.settings.until;
}
