/* The page, put together: the core, the state, the controls, the clock, the pictures. What each does stands in its own file.
 *
 * Invariant: a panel costs nothing before it comes near what is seen; then it is shown each new scene once, and told the time as it passes.
 */
import { createClient } from './client';
import { mini } from './shell/mini';
import { STEP_EVENT, transport, type Transport } from './shell/transport';
import { SEEK } from './figure/cursor';
import { captionExports, nameExports } from './figure/export';
import type { Track } from './protocol';
import type { Scene } from './scene';
import { startState } from './shell/address';
import { captionOf } from './shell/caption';
import { closer } from './shell/closer';
import { early } from './shell/early';
import { stage as makeStage } from './stage/stage';
import { forgetful, loadedAgain, recall, remember } from './shell/memory';
import { data, exampleOf, loadData, stagingOf } from './data';
import { place } from './dom';
import { failed } from './failed';
import { presetState } from './share';
import { presets } from './shell/presets';
import { printed } from './shell/print';
import { mountShell } from './shell/shell';
import { openedPlace } from './shell/opened';
import { createStore, outdated } from './state';

/** Where the steps of a method end, the start first, for the clock to stop at: of very many steps those that are kept. */
function stepTimes({ times, step, steps, every, tolerance }: Track): Float64Array {
  if (every === 1 || tolerance !== null || steps > 200_000) return times;
  const first = times[0] ?? 0, last = times[times.length - 1] ?? first, h = Math.sign(last - first) * Math.abs(step);
  return Float64Array.from({ length: steps + 1 }, (_, n) => (n === steps ? last : first + n * h));
}

/** What moves, as it is typeset: where it changes, the motion is another one. */
const equationOf = ({ description: { statements } }: Scene): string => statements.filter(({ kind }) => kind === 'motion' || kind === 'first-order').map(({ mathml }) => mathml).join();

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
  const motion = makeStage(store, { column: textEdge });
  // Whether one looks closer: kept, as the browser lays the page out to answer it.
  let late = 0, told = false, away = scrollY > 40;

  const small = mini(() => clock), closely = closer(store, () => motion.sees(), (links) => small.links(links));
  const clock: Transport = transport({
    onTime: (t) => { motion.at(t); closely.at(t); small.at(t); },
    onPlay: (playing) => small.playing(playing),
    speed: state.view.speed,
    onSpeed: (speed) => store.look({ speed }),
  });
  const opened = openedPlace(store, clock, motion.shows);
  const toasts = mountShell(store, motion, { replay: () => { clock.seek(store.numbers.start); if (!clock.playing()) clock.toggle(); } }, () => { motion.redraw(); closely.redraw(); small.redraw(); opened.redraw(); });
  if (problem) toasts.say(problem);
  const touched = catchUp();
  captionExports(() => (store.scene ? captionOf(store.scene, presets) : []));
  place('stage-figure').replaceChildren(motion.element);
  place('transport').append(clock.element);
  document.addEventListener(SEEK, (event) => clock.seek((event as CustomEvent<number>).detail));
  document.addEventListener(STEP_EVENT, (event) => clock.step((event as CustomEvent<number>).detail));

  const paper = printed();
  let preset = state.preset, equation = '', shown = false;
  // The theory's own links to examples.
  place('theory-text').addEventListener('click', ({ target }) => {
    const name = target instanceof Element ? target.closest<HTMLElement>('[data-preset]')?.dataset.preset : undefined;
    if (name === undefined || presets.text(name) === undefined) return;
    store.load(presetState(presets, name));
    place('stage').scrollIntoView();
  });

  /** On the first visit of this device the motion runs once by itself, unless somebody was quicker, or asked for less motion. */
  function gentle(): void {
    if (touched || store.state.embed || loadedAgain() || recall('seen') !== null || matchMedia('(prefers-reduced-motion: reduce)').matches) return;
    const hand = new AbortController(), { signal } = hand;
    for (const kind of ['pointerdown', 'keydown', 'wheel', 'touchstart']) document.addEventListener(kind, () => hand.abort(), { capture: true, passive: true, signal });
    window.setTimeout(() => {
      if (signal.aborted || document.hidden) return;
      hand.abort();
      remember('seen', '1');
      if (!clock.playing()) clock.toggle();
    }, GENTLE);
  }

  function theory(): void {
    if (told) return;
    told = true;
    // Of the build's own making.
    place('theory-text').replaceChildren(...new DOMParser().parseFromString(data.theory, 'text/html').body.childNodes);
  }
  /** The motion first, everything below it when the page has time; at once where one looks closer. */
  function below(): void {
    window.clearTimeout(late);
    const act = (): void => {
      late = 0;
      theory();
      const { scene } = store;
      if (scene) { paper.show(scene); closely.show(scene); }
    };
    if (away) act(); else late = window.setTimeout(act, LATER);
  }
  addEventListener('scroll', () => { away = scrollY > 40; if (late && away) below(); }, { passive: true });

  function show(): void {
    const scene = store.scene;
    if (!scene) return;
    const main = scene.solution.tracks[0];
    const ends = scene.solution.tracks.map(({ times }) => times[times.length - 1] ?? store.numbers.start);
    const { start, until } = store.numbers, { tracks, truth, examined } = scene.solution;
    // Where every method broke off and there is no green curve, or events ended all, nothing is to be seen later.
    const broken = examined && !truth && tracks.length > 0 && tracks.every(({ problem }) => problem), stopped = tracks.length > 0 && tracks.every(({ ended }) => ended?.ended), over = broken || stopped, furthest = ends.reduce((a, b) => (Math.abs(b - start) > Math.abs(a - start) ? b : a), start);
    const end = over ? furthest : until ?? Math.max(...ends);
    nameExports(scene.state.preset || 'model');
    motion.show(scene);
    small.show(scene);
    opened.show(scene);
    clock.setRange(store.numbers.start, end, main ? stepTimes(main) : [store.numbers.start, end]);
    // A scene, or another equation, begins with what it comes to, so that the misses are seen.
    clock.setUnit(stagingOf(exampleOf(scene.state)).units?.t ?? '');
    if (scene.state.preset !== preset || equationOf(scene) !== equation || !shown) clock.seek(end);
    preset = scene.state.preset;
    equation = equationOf(scene);
    if (!shown) gentle();
    shown = true;
    motion.at(clock.time());
    below();
  }
  store.subscribe((what) => {
    // A picture that is not of what is typed looks like it.
    const { model, run, step, tolerance, accuracy, until } = store.trouble;
    document.body.classList.toggle('stale', Boolean(model || run || step || tolerance || accuracy || until));
    document.body.classList.toggle('outdated', outdated(store));
    if (what === 'scene') show();
    if (what !== 'view') return;
    clock.setSpeed(store.state.view.speed);
    const scene = store.scene;
    if (scene) motion.show(scene);
    below();
  });
}

start().catch(failed);
