/* One step, opened: a place of its own. A column for each of the first methods: a picture of this one step, and a recipe of at most four lines.
 *
 * Invariant: the step is that of the core's account of the very run that the stage shows; a column shows one step whole, never figures of two. What is drawn is what
 * the stage draws, until the reader chooses. The clock of the page rests meanwhile, and is moved only where the reader went to another step.
 */
import { data, exampleOf, stagingOf } from '../data';
import { button, el, icon, place, say } from '../dom';
import { grouped } from '../figure/number';
import { asker, stepAt, timeOf, type Opened } from '../panel/steps/ask';
import { column, type Column } from '../panel/steps/column';
import { timeDecimals, timeText } from '../panel/steps/figures';
import { seenBy, seenIn, type Seen } from '../panel/steps/seen';
import { bodyCalled } from '../panel/told';
import type { Scene } from '../scene';
import type { LiveStore } from '../state';
import { words } from '../words';
import { lecturing } from './lecture';
import { short } from './number';
import { foot as makeFoot } from './opened-foot';
import { titleIn } from './presets';

const told = words.opened;
/** Milliseconds of a line of the recipe while playing. */
const LINE = 1200;
/** Columns that a window of this width has room for. */
const capacity = (): number => (matchMedia('(min-width: 100rem)').matches ? 3 : matchMedia('(min-width: 56.25rem)').matches ? 2 : 1);

/** The clock of the page, as far as this place needs it. */
export interface Clock { time(): number; playing(): boolean; toggle(): void; seek(t: number): void }

/** shows: the columns of the solution that the stage draws, of its first body that does not rest. */
export function openedPlace(store: LiveStore, clock: Clock, shows: () => readonly string[]): { show(scene: Scene): void; redraw(): void } {
  const root = place('opened');
  let scene: Scene | null = null, seen: Seen | null = null, steps: readonly Opened[] = [], columns: Column[] = [];
  let index = 0, total = 1, line = -1, chosen = '', aside: readonly string[] = [], wide = new Set<string>();
  let here = false, from = '', moved = false, timer = 0, opener: Element | null = null;

  const step = (way: 1 | -1, name: string, outline: string): HTMLButtonElement => button('', () => go(index + way), { class: 'icon-button', 'aria-label': name, title: name }, icon(outline));
  const title = el('h1', { id: 'opened-title', tabindex: -1 }, told.title), about = el('p', { class: 'opened-about' }), counter = el('p', { class: 'opened-step', role: 'status' });
  const earlier = step(-1, told.before, 'M14.5 5.5L8 12l6.5 6.5'), later = step(1, told.next, 'M9.5 5.5L16 12l-6.5 6.5');
  const choice = el('select', { class: 'opened-choice', 'aria-label': told.look, hidden: true }), back = button('', () => leave(), { class: 'quiet-button' });
  const note = el('p', { class: 'message mild', role: 'status' }), grid = el('div', { class: 'opened-columns' }), foot = makeFoot({ play: () => run(!timer), go: (to) => go(to), press });
  root.append(el('div', { class: 'opened-head' }, title, about, choice, el('div', { class: 'opened-nav' }, earlier, counter, later), back), note, grid, foot.element);
  choice.addEventListener('change', () => { chosen = choice.value; render(); });

  const { ask, busy } = asker(store.client, () => (scene && here ? { scene, index, tracks: scene.solution.tracks.filter((t) => !aside.includes(t.method)).slice(0, capacity()) } : null), (found) => {
    steps = found;
    total = Math.max(1, ...found.map((s) => s.trace?.total || scene?.solution.tracks.find((t) => t.method === s.method && t.method === scene?.solution.tracks[0]?.method)?.total || 0));
    render();
  });

  // --- where in the run -------------------------------------------------------------------------------------------------------------------
  /** The step that contains the time, or ends at it. From where the motion begins, or has ended, one begins with the first. */
  function indexAt(t: number): number {
    const track = scene?.solution.tracks[0], begin = track?.times[0], last = track?.times[track.times.length - 1];
    if (!track || begin === undefined || t === last || t === begin) return 0;
    return stepAt(track, t, (last ?? begin) < begin ? -1 : 1);
  }
  function go(to: number, at = -1): void {
    const next = Math.max(0, Math.min(total - 1, to));
    if (at < 0) run(false);
    line = at;
    if (next === index) { walk(); return; }
    index = next;
    moved = true;
    tell();
    ask();
  }
  const lines = (): number => Math.max(1, ...columns.map((c) => c.lines()));
  function walk(): void { for (const c of columns) c.walk(line); }
  /** A line on or back. Past the last one Play goes to the next step, and a key shows all of this one. */
  function on(way: 1 | -1): void {
    const next = line < 0 ? (way > 0 ? 0 : lines() - 2) : Math.max(0, line + way);
    if (next >= lines() && timer && index + 1 < total) { go(index + 1, 0); return; }
    line = next < lines() ? next : -1;
    if (line < 0) run(false);
    walk();
  }
  function run(going: boolean): void {
    window.clearInterval(timer);
    timer = going ? window.setInterval(() => { if (document.hidden) run(false); else if (!busy()) on(1); }, LINE) : 0;
    foot.playing(going);
    if (!going) return;
    if (index === total - 1 && line < 0) go(0, 0); else if (line < 0) on(1);
  }

  // --- what is shown ---------------------------------------------------------------------------------------------------------------------
  function tell(): void {
    const track = scene?.solution.tracks[0], units = scene ? stagingOf(exampleOf(scene.state)).units : undefined, unit = units ? `\u2009${units.t}` : '';
    const h = track ? track.step : 1, decimals = timeDecimals(h), t = (k: number): string => timeText(track ? timeOf(track, k) : 0, decimals) + unit;
    say(about, scene && track ? (track.tolerance === null ? told.scene(titleIn(scene.state), short(track.step, 4) + unit) : told.adapting(titleIn(scene.state), short(track.tolerance, 4))) : '');
    say(counter, told.step(grouped(index + 1), grouped(total)));
    counter.style.minWidth = `${0.56 * told.step(grouped(total), grouped(total)).length}em`;
    earlier.disabled = index === 0;
    later.disabled = index >= total - 1;
    foot.at(index, total, told.stepSpoken(grouped(index + 1), grouped(total), t(index), t(index + 1)));
    say(back, from ? told.backToLesson : told.back);
    const wrong = store.trouble.model ?? store.trouble.run;
    say(note, scene && !track ? told.nobody : !wrong ? '' : scene ? told.stale : told.broken);
    if (wrong && !scene) grid.replaceChildren();
  }
  function render(): void {
    if (!scene || !here) return;
    const names = steps.find((s) => s.trace)?.trace?.names, all = names ? seenIn(names, (body) => bodyCalled(scene!, names.x, body)) : [], units = stagingOf(exampleOf(scene.state)).units;
    seen = all.find((s) => s.id === chosen) ?? seenBy(all, shows());
    if (choice.options.length !== all.length || all.some((s, k) => choice.options[k]?.value !== s.id)) choice.replaceChildren(...all.map((s) => new Option(s.label, s.id)));
    choice.hidden = all.length < 2;
    choice.value = seen?.id ?? '';
    const methods = steps.map((s) => s.method);
    if (methods.join() !== columns.map((c) => c.method).join()) {
      columns = methods.map((method) => columns.find((c) => c.method === method) ?? column(method, wide));
      grid.replaceChildren(...columns.map((c) => c.element));
      grid.style.setProperty('--columns', String(Math.max(1, columns.length)));
    }
    const setting = { scene, seen, total, x: units ? `\u2009${units.x}` : '', t: units ? `\u2009${units.t}` : '' };
    columns.forEach((c, k) => c.show(steps[k]!, setting));
    line = Math.min(line, lines() - 1);
    walk();
    tell();
    foot.walks(lines());
    foot.methods(scene.looks, methods);
  }
  /** A method gets a column, or gives it back. Those with one are the scene's first, the very first is its main method. */
  function press(method: string): void {
    const all = scene?.solution.tracks.map((t) => t.method) ?? [], now = columns.map((c) => c.method), most = capacity();
    const next = now.includes(method) ? now.filter((m) => m !== method) : [...now.slice(Math.max(0, now.length + 1 - most)), method];
    if (next.length === 0) return;
    aside = next.length < most ? all.filter((m) => !next.includes(m)) : [];
    run(false);
    line = -1;
    const order = [...next, ...all.filter((m) => !next.includes(m))];
    if (order.join() === all.join()) ask(); else store.change({ methods: order });
  }
  // A finger that goes sideways brings the next method, where one has room; the row of methods goes round.
  let down: readonly [number, number] | null = null;
  grid.addEventListener('pointerdown', ({ pointerType, clientX, clientY }) => { down = pointerType === 'mouse' ? null : [clientX, clientY]; });
  grid.addEventListener('pointerup', ({ clientX, clientY }) => {
    const all = scene?.solution.tracks.map((t) => t.method) ?? [], dx = down ? clientX - down[0] : 0;
    if (!down || capacity() > 1 || all.length < 2 || Math.abs(dx) < 48 || Math.abs(dx) < 2 * Math.abs(clientY - down[1])) return;
    aside = [];
    line = -1;
    store.change({ methods: dx < 0 ? [...all.slice(1), all[0]!] : [all[all.length - 1]!, ...all.slice(0, -1)] });
  });

  // --- coming and going ------------------------------------------------------------------------------------------------------------------
  function leave(): void { store.go(from); }
  function come(): void {
    opener = document.activeElement;
    if (clock.playing()) clock.toggle();
    [index, line, moved, chosen, aside, steps, wide] = [indexAt(clock.time()), -1, false, '', [], [], new Set<string>()];
    total = scene?.solution.tracks[0]?.total ?? 1;
    // Lessons hear of it.
    document.dispatchEvent(new CustomEvent('motus-opened', { detail: 'step' }));
    grid.replaceChildren(el('p', { class: 'quiet' }, told.opening));
    tell();
    scrollTo(0, 0);
    title.focus({ preventScroll: true });
    ask();
  }
  function gone(): void {
    run(false);
    const entries = steps.find((s) => s.trace)?.trace?.entries;
    if (moved && entries?.length) clock.seek(entries[entries.length - 1]!.time);
    columns = [];
    grid.replaceChildren();
    scrollTo(0, 0);
    if (opener instanceof HTMLElement && opener.isConnected && opener.checkVisibility()) opener.focus({ preventScroll: true });
  }
  let before = '';
  function arrive(): void {
    const now = store.state.place, there = now === 'step';
    // A lesson is where one goes back to; other places are left for good.
    if (there && before !== 'step') from = data.lessons.some((l) => before.startsWith(`${l.id}.`)) ? before : '';
    before = now;
    if (there === here) return;
    here = there;
    document.body.classList.toggle('in-step', there);
    root.hidden = !there;
    if (there) come(); else gone();
  }
  store.subscribe((what) => {
    if (what === 'view' || what === 'state') arrive();
    if (here && what === 'description') tell();
  });
  // Before the clock of the page hears of them.
  document.addEventListener('keydown', (event) => {
    if (!here || event.defaultPrevented || event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
    const { key, target } = event, at = target instanceof Element ? target : null;
    if (document.querySelector(':popover-open') || at?.closest('textarea, select, input:not([type=range])')) return;
    switch (key) {
      case 'Escape': leave(); break;
      case ' ':
        if (at?.closest('button, summary, a[href], label')) return;
        if (!event.repeat) run(!timer);
        break;
      case 'ArrowLeft': case 'ArrowRight': go(index + (key === 'ArrowRight' ? 1 : -1)); break;
      case 'ArrowUp': case 'ArrowDown': run(false); on(key === 'ArrowDown' ? 1 : -1); break;
      case 'PageUp': case 'PageDown':
        if (!lecturing()) return;
        run(false);
        on(key === 'PageDown' ? 1 : -1);
        break;
      case 'Home': case 'End': go(key === 'Home' ? 0 : total - 1); break;
      default: return;
    }
    event.preventDefault();
  }, { capture: true });
  let room = capacity();
  addEventListener('resize', () => { if (room !== capacity()) { room = capacity(); aside = []; ask(); } });
  arrive();

  return {
    show(next) {
      const other = scene?.state.text !== next.state.text || scene.state.step !== next.state.step || scene.state.tolerance !== next.state.tolerance, first = scene === null;
      scene = next;
      if (other) { aside = []; line = -1; }
      if (first) index = indexAt(clock.time());
      const { tracks } = next.solution;
      index = Math.min(index, Math.max(0, (tracks[0]?.total ?? 1) - 1));
      if (!here) return;
      total = tracks[0]?.total ?? 1;
      tell();
      if (tracks.length) ask(); else { steps = []; render(); }
    },
    redraw: render,
  };
}
