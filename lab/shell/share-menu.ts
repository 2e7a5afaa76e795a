/* Share: the address of what is seen, the frame that shows it in another page, the command and the C program that compute the same bits, the picture, the film.
 * Invariant: what is copied is shown.
 */
import type { State } from '../scene';
import { cProgram } from '../program';
import { command, type Presets } from '../share';
import { films } from '../stage/film';
import type { Stage } from '../stage/stage';
import type { LiveStore } from '../state';
import { addressOf } from './address';
import { dialsOf } from './dials';
import { snippet } from './embed';
import { titleIn } from './presets';
import { words } from '../words';
import { button, el, fresh, icon, say } from '../dom';
import { appended } from './repair';
import type { Toasts } from './toasts';
import { runSeconds } from './transport';

/** The clipboard where the page may use it; else the field is selected, for the reader to copy. */
async function copy(field: HTMLInputElement | HTMLTextAreaElement, { copied, selected }: { readonly copied: string; readonly selected: string }, toasts: Toasts): Promise<void> {
  try {
    await navigator.clipboard.writeText(field.value);
    toasts.say(copied);
  } catch {
    field.focus();
    field.select();
    toasts.say(selected);
  }
}

export function shareMenu(store: LiveStore, presets: Presets, stage: Stage, toasts: Toasts): HTMLElement {
  const id = fresh('share'), linkId = fresh('link'), commandId = fresh('command'), programId = fresh('program'), frameId = fresh('frame');
  const link = el('input', { id: linkId, readonly: true, type: 'text', spellcheck: 'false' });
  const line = el('textarea', { id: commandId, readonly: true, rows: 4, spellcheck: 'false', wrap: 'soft' });
  const source = el('textarea', { id: programId, readonly: true, rows: 8, spellcheck: 'false', wrap: 'off' });
  const commandLabel = el('label', { for: commandId });
  const remark = el('p', { class: 'quiet' }), older = el('p', { class: 'quiet' }), refusal = el('p', { class: 'message' });
  const copyLink = button(words.share.link.copy, () => { void copy(link, words.share.link, toasts); }, { class: 'primary' });
  const copyCommand = button(words.share.command.copy, () => { void copy(line, words.share.command, toasts); });
  const frame = el('textarea', { id: frameId, readonly: true, rows: 4, spellcheck: 'false' }), choices = el('fieldset', {}, el('legend', {}, words.share.frame.sliders));
  const copyFrame = button(words.share.frame.copy, () => { void copy(frame, words.share.frame, toasts); }), away = el('p', { class: 'quiet' });
  const copyProgram = button(words.share.program.copy, () => { void copy(source, words.share.program, toasts); });
  const programLabel = el('label', { for: programId });
  const film = button('WebM', () => { void shoot(); }, { class: 'figure-button', 'aria-label': words.share.saveAs('WebM') }), bar = el('progress', { hidden: true, max: 1, 'aria-label': words.share.film.film }), filmed = el('p', { class: 'quiet', role: 'status' });
  const panel = el('div', { id, class: 'popup', hidden: true, role: 'group', 'aria-label': words.share.share },
    el('label', { for: linkId }, words.share.link.label), link, copyLink, remark,
    commandLabel, line, older, copyCommand, refusal,
    el('details', { class: 'embed-fold' }, el('summary', {}, words.share.frame.embed), choices, el('label', { for: frameId }, words.share.frame.label), frame, away, copyFrame),
    el('details', {}, el('summary', {}, words.share.program.fold), programLabel, source, copyProgram),
    el('div', { class: 'figure-save', role: 'group', 'aria-label': words.share.save }, el('span', {}, words.share.picture),
      ...(['PNG', 'SVG', 'CSV'] as const).map((kind) => button(kind, () => stage.save(kind), { class: 'figure-button', 'aria-label': words.share.saveAs(kind) })), film), bar, filmed);
  const opener = button('', () => toggle(Boolean(panel.hidden)), { 'aria-expanded': 'false', 'aria-controls': id, class: 'with-icon' },
    icon('M12 15V3.5M8 7l4-4 4 4M5 11v9h14v-9'), el('span', {}, words.share.share));
  const root = el('div', { class: 'share' }, opener, panel);

  /** One run as a film, in the motion's own time; a second press gives it up. */
  let filming: AbortController | null = null;
  async function shoot(): Promise<void> {
    if (filming) { filming.abort(); return; }
    const { scene, numbers } = store, track = scene?.solution.tracks[0], end = numbers.until ?? track?.times.at(-1);
    if (!films()) { say(filmed, words.share.film.unknown); return; }
    if (!scene || end === undefined) { say(filmed, words.share.film.nothing); return; }
    filming = new AbortController();
    const seconds = runSeconds(Math.abs(end - numbers.start));
    const name = (text: string, label: string): void => { film.textContent = text; film.setAttribute('aria-label', label); };
    name(words.share.film.cancel, words.share.film.cancelLabel);
    say(filmed, words.share.film.recording(String(Math.ceil(seconds))));
    bar.value = 0;
    bar.hidden = false;
    let told: string = words.share.film.failed;
    try {
      told = await stage.film(numbers.start, end, seconds, (part) => { bar.value = part; }, filming.signal) ? words.share.film.saved : words.share.film.none;
    } catch { /* The browser's recorder gave up. */ }
    filming = null;
    bar.hidden = true;
    name('WebM', words.share.saveAs('WebM'));
    say(filmed, told);
    if (panel.hidden) toasts.say(told);
  }

  /** The program wants all lines, also those that the page supposed for what is seen. */
  function whole({ text, step, until }: State): string {
    const sized = store.scene?.solution.tracks.some((t) => t.tolerance === null && !t.goal) ?? true;
    const numbers: Readonly<Record<string, string>> = { step: step || !sized ? '' : `step ${store.numbers.step}`, until: until ? '' : `until ${store.numbers.until}` };
    const lines = (store.scene?.description.suggestions ?? []).map(s => numbers[/^(?:step|until)\b/.exec(s.line)?.[0] ?? ''] ?? s.line).filter(line => line !== '');
    return lines.length ? text + appended(text, lines).text : text;
  }
  /** The frame, with the sliders that are chosen. */
  let offered = '';
  function fillFrame(): void {
    const dials = [{ name: 'step', label: words.share.frame.step }, ...dialsOf(store)], key = JSON.stringify(dials);
    if (key !== offered) {
      offered = key;
      choices.replaceChildren(choices.firstElementChild!, ...dials.map(({ name, label }) => el('label', {}, el('input', { type: 'checkbox', value: name, checked: name === 'step', 'aria-label': words.share.frame.slider(label) }), ` ${label}`)));
    }
    const embed = [...choices.querySelectorAll('input')].filter((box) => box.checked).map((box) => box.value), address = addressOf({ ...store.state, place: '', embed }, presets);
    frame.value = address && snippet(address, titleIn(store.state));
    copyFrame.disabled = !address;
    say(away, location.protocol === 'file:' ? words.share.frame.disk : '');
  }
  choices.addEventListener('change', fillFrame);
  function fill(): void {
    fillFrame();
    const address = addressOf(store.state, presets);
    link.value = address || words.share.long;
    copyLink.disabled = !address;
    say(remark, location.protocol === 'file:' ? words.share.disk : '');
    remark.hidden = remark.textContent === '';
    // The command computes what is seen: the last state that could be computed.
    const seen = store.scene?.state ?? store.state, { model, step, tolerance, accuracy, until, run } = store.trouble;
    const tracks = store.scene?.solution.tracks ?? [], methods = tracks.length ? tracks.map((t) => t.method) : seen.methods;
    const aimed = new Map(tracks.flatMap(({ method, goal }): [string, string][] => (goal ? [[method, `${goal.accuracy}${goal.absolute ? ' absolute' : ''}`]] : [])));
    const adaptive = methods.filter((name) => !aimed.has(name) && store.catalogue.some((m) => m.adaptive && m.name === name));
    const { text, problem } = command({ ...seen, text: whole(seen) }, methods, adaptive, aimed);
    line.value = text;
    say(commandLabel, methods.length > 1 ? words.share.command.several : words.share.command.one);
    say(older, model || step || tolerance || accuracy || until || run ? words.share.older : '');
    older.hidden = older.textContent === '';
    copyCommand.disabled = problem !== '';
    const { numbers } = store, main = methods[0] ?? '', adapts = adaptive.includes(main), goal = tracks[0]?.goal ?? null;
    const made = cProgram({ text: whole(seen), set: seen.set, method: main, step: seen.step && !adapts && !goal ? numbers.step : null, tolerance: seen.tolerance && adapts ? numbers.tolerance : null, aim: goal, until: seen.until ? numbers.until : null });
    source.value = made.text || made.problem;
    copyProgram.disabled = !made.text;
    say(programLabel, words.share.program.label(store.scene?.looks[0]?.label ?? main));
    say(refusal, problem);
    refusal.hidden = problem === '';
  }
  function toggle(open: boolean): void {
    if (open) fill();
    panel.hidden = !open;
    opener.setAttribute('aria-expanded', String(open));
    if (open) copyLink.focus();
  }
  root.addEventListener('keydown', event => {
    if (event.key === 'Escape' && !panel.hidden) { toggle(false); opener.focus(); event.stopPropagation(); }
  });
  root.addEventListener('focusout', event => {
    if (event.relatedTarget instanceof Node && !root.contains(event.relatedTarget)) toggle(false);
  });
  document.addEventListener('pointerdown', event => { if (!panel.hidden && event.target instanceof Node && !root.contains(event.target)) toggle(false); });
  store.subscribe(what => { if (!panel.hidden && (what === 'state' || what === 'scene' || what === 'view')) fill(); });
  return root;
}
