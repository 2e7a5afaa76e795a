/* The page, put together: the core, the state, the controls, the clock, the pictures. What each does stands in its own file.
 *
 * Invariant: panels that are closed cost nothing; those that are open are shown each new scene once, and told the time as it passes.
 */
import { createClient } from './client';
import { mini } from './shell/mini';
import { STEP_EVENT, transport, type Transport } from './shell/transport';
import { SEEK } from './figure/cursor';
import { captionExports, nameExports } from './figure/export';
import { convergence } from './panel/convergence';
import { driftPanel } from './panel/drift';
import { errorPanel } from './panel/error';
import { phasePanel } from './panel/phase';
import { precision } from './panel/precision';
import { stability } from './panel/stability';
import { stepsPanel } from './panel/steps';
import { timePanel } from './panel/time';
import type { Track } from './protocol';
import type { Panel, PanelMaker } from './scene';
import { startState } from './shell/address';
import { captionOf } from './shell/caption';
import { early } from './shell/early';
import { stage as makeStage } from './stage/stage';
import { stagingOf } from './stage/staging';
import { forgetful, recall, remember } from './shell/memory';
import { data, exampleOf, loadData } from './data';
import { place } from './dom';
import { failed } from './failed';
import { presetState } from './share';
import { presets } from './shell/presets';
import { printed } from './shell/print';
import { mountShell } from './shell/shell';
import { createStore, family } from './state';
import { methodCard } from './theory/cards';

/** What looks closer, in its order. */
const makers: readonly { readonly id: string; readonly title: string; readonly make: PanelMaker }[] = [
  { id: 'time', title: 'Against time', make: timePanel }, { id: 'error', title: 'Error', make: errorPanel }, { id: 'drift', title: 'Drift of an invariant', make: driftPanel },
  { id: 'phase', title: 'Phase plane', make: phasePanel }, { id: 'convergence', title: 'Convergence', make: convergence }, { id: 'precision', title: 'Work and precision', make: precision },
  { id: 'stability', title: 'Stability', make: stability },
];

/** Where the steps of a method end, the start first, for the clock to stop at: of very many steps those that are kept. */
function stepTimes({ times, step, steps, every }: Track): Float64Array {
  if (every === 1 || steps > 200_000) return times;
  const first = times[0] ?? 0, last = times[times.length - 1] ?? first, h = Math.sign(last - first) * Math.abs(step);
  return Float64Array.from({ length: steps + 1 }, (_, n) => (n === steps ? last : first + n * h));
}

/** One panel that fails is told of, and does not stop the others. */
function each(panels: Iterable<Panel>, act: (panel: Panel) => void): void {
  for (const panel of panels) {
    try { act(panel); } catch (error) { reportError(error); }
  }
}

/** Milliseconds after the first picture that nobody touched; then the motion runs once, in its own time. */
const GENTLE = 600;
/** Milliseconds after the last change, before what stands below the stage follows. */
const LATER = 120;

/** Where the text that stands on the stage ends; 0 where it stands above. */
function textEdge(): number {
  const text = place('words').getBoundingClientRect(), picture = place('stage-picture').getBoundingClientRect();
  return text.top < picture.bottom - 40 && text.bottom > picture.top + 40 && text.right < picture.right ? Math.round((text.right - picture.left) * place('stage-picture').clientWidth / picture.width) : 0;
}

async function start(): Promise<void> {
  // Before the first picture, if the page stands in another.
  document.body.classList.toggle('embedded', /[#&]embed=1(&|$)/.test(location.hash));
  const [client] = await Promise.all([createClient(), loadData()]), catchUp = early();
  const { state, problem } = startState(presets);
  if (state.embed) forgetful();
  const store = createStore(client, state);
  const motion = makeStage(store, { column: textEdge }), made = new Map<string, Panel>();
  // Those below the stage that are open; they are made when the stage is drawn.
  const open = new Set<Panel>();
  // Whether one looks closer: kept, as the browser lays the page out to answer it.
  let steps: Panel | null = null, late = 0, away = scrollY > 40;

  const small = mini(() => clock);
  const clock: Transport = transport({
    onTime: (t) => { motion.at(t); each(open, (panel) => panel.at(t)); small.at(t); },
    onPlay: (playing) => small.playing(playing),
    speed: state.view.speed,
    onSpeed: (speed) => store.look({ speed }),
  });
  const toasts = mountShell(store, motion, { replay: () => { clock.seek(store.numbers.start); if (!clock.playing()) clock.toggle(); } }, makers, () => { each([motion, ...open], (panel) => panel.redraw()); small.redraw(); });
  if (problem) toasts.say(problem);
  const touched = catchUp();
  captionExports(() => (store.scene ? captionOf(store.scene, presets) : []));
  place('stage-figure').replaceChildren(motion.element);
  place('transport').append(clock.element);
  document.addEventListener(SEEK, (event) => clock.seek((event as CustomEvent<number>).detail));
  document.addEventListener(STEP_EVENT, (event) => clock.step((event as CustomEvent<number>).detail));

  const card = place('method-card'), paper = printed();
  let carded = '', preset = state.preset, shown = false;
  // The theory's own links to examples.
  place('theory-text').addEventListener('click', ({ target }) => {
    const name = target instanceof Element ? target.closest<HTMLElement>('[data-preset]')?.dataset.preset : undefined;
    if (name === undefined || presets.text(name) === undefined) return;
    store.load(presetState(presets, name));
    place('stage').scrollIntoView();
  });

  /** On the first visit of this device the motion runs once by itself, unless somebody was quicker, or asked for less motion. */
  function gentle(): void {
    if (touched || store.state.embed || recall('seen') !== null || matchMedia('(prefers-reduced-motion: reduce)').matches) return;
    const hand = new AbortController(), { signal } = hand;
    for (const kind of ['pointerdown', 'keydown', 'wheel', 'touchstart']) document.addEventListener(kind, () => hand.abort(), { capture: true, passive: true, signal });
    window.setTimeout(() => {
      if (signal.aborted || document.hidden) return;
      hand.abort();
      remember('seen', '1');
      if (!clock.playing()) clock.toggle();
    }, GENTLE);
  }

  function showCard(): void {
    const name = family(store.scene?.solution.tracks[0]?.method ?? '');
    const method = store.catalogue.find((m) => m.name === name);
    if (name === carded || !method) return;
    carded = name;
    card.replaceChildren(methodCard(method));
  }

  /** Opens and closes panels as the view says; what they show is below()'s. */
  function arrange(): void {
    if (!steps) {
      steps = stepsPanel(store);
      place('step-view').append(steps.element);
      open.add(steps);
      // Of the build's own making.
      place('theory-text').replaceChildren(...new DOMParser().parseFromString(data.theory, 'text/html').body.childNodes);
    }
    const wanted = makers.filter(({ id }) => store.state.view.panels.includes(id)), holder = place('panels');
    for (const [id, panel] of made) {
      if (wanted.some((w) => w.id === id)) continue;
      open.delete(panel);
      panel.element.remove();
    }
    wanted.forEach(({ id, make }, k) => {
      const panel = made.get(id) ?? make(store);
      made.set(id, panel);
      if (holder.children[k] !== panel.element) holder.insertBefore(panel.element, holder.children[k] ?? null);
      open.add(panel);
    });
  }
  /** The motion first, everything below it when the page has time; at once where one looks closer. */
  function below(): void {
    window.clearTimeout(late);
    const act = (): void => {
      late = 0;
      arrange();
      const { scene } = store;
      if (scene) { paper.show(scene); each(open, (panel) => panel.show(scene)); }
      each(open, (panel) => panel.at(clock.time()));
      showCard();
    };
    if (away) act(); else late = window.setTimeout(act, LATER);
  }
  addEventListener('scroll', () => { away = scrollY > 40; if (late && away) below(); }, { passive: true });

  function show(): void {
    const scene = store.scene;
    if (!scene) return;
    const main = scene.solution.tracks[0];
    const ends = scene.solution.tracks.map(({ times }) => times[times.length - 1] ?? store.numbers.start);
    const end = store.numbers.until ?? Math.max(...ends);
    nameExports(scene.state.preset || 'model');
    motion.show(scene);
    small.show(scene);
    clock.setRange(store.numbers.start, end, main ? stepTimes(main) : [store.numbers.start, end]);
    // A scene begins with what it comes to, so that the misses are seen.
    clock.setUnit(stagingOf(exampleOf(scene.state)).units?.t ?? '');
    if (scene.state.preset !== preset || !shown) clock.seek(end);
    preset = scene.state.preset;
    if (!shown) gentle();
    shown = true;
    motion.at(clock.time());
    below();
  }
  store.subscribe((what) => {
    // A picture that is not of what is typed looks like it.
    const { model, run, step, until } = store.trouble;
    document.body.classList.toggle('stale', Boolean(model || run || step || until));
    if (what === 'scene') show();
    if (what !== 'view') return;
    clock.setSpeed(store.state.view.speed);
    const scene = store.scene;
    if (scene) motion.show(scene);
    below();
  });
}

start().catch(failed);
