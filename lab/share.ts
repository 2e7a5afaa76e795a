/* The state of the page as an address and as a command line.
 *
 * Invariant: decode is total. Whatever the bytes, it answers with a state and, where they were wrong, a message; nothing in them is ever
 * evaluated, and a model reaches a shell only inside single quotes or a quoted heredoc. decode(encode(s)) is s.
 *
 * Format, version 1:  #v=1&p=PRESET&m=TEXT&s=NAME=EXPRESSION&s=…&a=METHOD,METHOD&h=STEP&r=TOLERANCE&T=UNTIL  and of the view
 *   w=time|plane|space   what the motion panel shows         q=COLUMN (repeated)  quantities of the time panel
 *   f=COLUMN f=COLUMN    axes of the phase panel              e=0  green line hidden    z=SPEED
 *   g=ACCURACY | off     of the answer, in place of a tolerance
 *   k=WHEN K=COLUMN K=COLUMN b=NUMBER,NUMBER…   section: its condition (k= alone: none), axes, and (repeated) states of other motions
 *   l=gallery | step | LESSON.PART.ANSWER   where in the page one is
 *   o=ID,ID              of older addresses, read and ignored: all panels that have an answer are there
 *   embed=1              a picture inside another page        c=step c=NUMBER     with these sliders (repeated)
 *   A=1                  a run A is pinned, and of it            Am=TEXT As=NAME=EXPRESSION Aa=METHODS Ah=STEP Ar=TOLERANCE Ag=ACCURACY AT=UNTIL
 * p stands where the text is the preset's, else m; a without p or m's default is left out, and so is all that has its default. Am is left out where A has
 * the text of the address. A pinned run that cannot be read is told; all else of its address is used.
 */
import type { Run, Section, State, View } from './scene';
import { normal, plain } from './shell/number';
import { words } from './words';

/** What the state is compared with: the models of the build and the methods each is shown with. */
export interface Presets {
  /** undefined: no such preset. */
  text(name: string): string | undefined;
  methods(name: string): readonly string[];
  /** Numbers that the preset replaces in its model, if any. */
  set?(name: string): Readonly<Record<string, string>>;
  /** Where it ends, if not where its model does; ''. */
  until?(name: string): string;
  /** The section that its scene begins with. */
  section?(name: string): Section | undefined;
  readonly first: string;
}
export interface Decoded { readonly state: State; readonly problem: string }

export const longest = 128 * 1024;                     // of a fragment, in characters
const most = { sets: 256, methods: 40, words: 200, columns: 32, starts: 64, numbers: 64 };

export const defaultView: View = { plane: 'auto', quantities: [], phase: null, exact: true, speed: 1 };

/** How an example is shown, from a view of another one. */
export function viewFor(presets: Presets, name: string, from: View = defaultView): View {
  const { section: _, ...others } = from, section = presets.section?.(name);
  return { ...others, plane: 'auto', quantities: [], phase: null, ...(section ? { section } : {}) };
}
export function presetState(presets: Presets, name: string): State {
  return { preset: name, text: presets.text(name) ?? '', set: presets.set?.(name) ?? {}, methods: presets.methods(name), step: '', tolerance: '', accuracy: '', until: presets.until?.(name) ?? '', view: viewFor(presets, name), place: '' };
}

const free = /^[A-Za-z0-9\-._~(),*]$/;

/** UTF-8 in percent codes; a lone surrogate, which has none, becomes U+FFFD. */
export function escape(text: string): string {
  let out = '';
  for (const byte of new TextEncoder().encode(text)) {
    const character = String.fromCharCode(byte);
    out += free.test(character) ? character : '%' + (byte < 16 ? '0' : '') + byte.toString(16).toUpperCase();
  }
  return out;
}

/** null: a bad percent code, or bytes that are no UTF-8. Characters that need no code but have none are taken as they are: people edit addresses. */
export function unescape(text: string): string | null {
  if (/%(?![0-9A-Fa-f]{2})/.test(text)) return null;
  const bytes: number[] = [];
  for (const part of text.split(/(%[0-9A-Fa-f]{2})/)) {
    if (part.startsWith('%')) bytes.push(Number.parseInt(part.slice(1), 16));
    else if (part) for (const byte of new TextEncoder().encode(part)) bytes.push(byte);
  }
  try {
    return new TextDecoder('utf-8', { fatal: true, ignoreBOM: true }).decode(new Uint8Array(bytes));
  } catch {
    return null;
  }
}

/** A list at its commas, but for those inside brackets: newmark(1/4, 1/2) is one method. */
function splitList(text: string): string[] {
  const parts: string[] = [];
  let depth = 0, part = '';
  for (const c of text) {
    if (c === '(') depth++;
    else if (c === ')') depth--;
    if (c === ',' && depth <= 0) { parts.push(part.trim()); part = ''; } else part += c;
  }
  parts.push(part.trim());
  return parts.filter(p => p !== '');
}

const same = (a: readonly string[], b: readonly string[]): boolean => a.length === b.length && a.every((x, i) => x === b[i]);

/** The fragment without its '#'. */
export function encode(state: State, presets: Presets): string {
  const out = ['v=1'];
  const put = (key: string, value: string): void => { out.push(key + '=' + escape(value)); };
  const isPreset = state.preset !== '' && presets.text(state.preset) === state.text;
  if (isPreset) put('p', state.preset); else put('m', state.text);
  for (const [name, expression] of Object.entries(state.set)) put('s', name + '=' + expression);
  const usual = isPreset ? presets.methods(state.preset) : [];
  if (!same(state.methods, usual)) put('a', state.methods.join(','));
  if (state.step) put('h', state.step);
  if (state.tolerance) put('r', state.tolerance);
  if (state.accuracy) put('g', state.accuracy);
  if (state.until) put('T', state.until);
  const view = state.view;
  if (view.plane !== defaultView.plane) put('w', view.plane);
  for (const name of view.quantities) put('q', name);
  for (const name of view.phase ?? []) put('f', name);
  if (!view.exact) put('e', '0');
  if (view.speed !== defaultView.speed) put('z', String(view.speed));
  const section = isPreset ? presets.section?.(state.preset) : undefined;
  if (JSON.stringify(view.section) !== JSON.stringify(section)) {
    put('k', view.section?.when ?? '');
    for (const name of view.section?.plane ?? []) put('K', name);
    for (const start of view.section?.starts ?? []) put('b', start.join(','));
  }
  if (state.place) put('l', state.place);
  if (state.embed) put('embed', '1');
  for (const name of state.embed ?? []) put('c', name);
  const { pinned } = state;
  if (pinned) {
    const own = pinned.text === state.text;
    put(pinKey(''), '1');
    if (!own) put(pinKey('m'), pinned.text);
    for (const [name, expression] of Object.entries(pinned.set)) put(pinKey('s'), name + '=' + expression);
    if (!same(pinned.methods, own ? usual : [])) put(pinKey('a'), pinned.methods.join(','));
    if (pinned.step) put(pinKey('h'), pinned.step);
    if (pinned.tolerance) put(pinKey('r'), pinned.tolerance);
    if (pinned.accuracy) put(pinKey('g'), pinned.accuracy);
    if (pinned.until) put(pinKey('T'), pinned.until);
  }
  return out.join('&');
}

const once = new Set(['v', 'p', 'm', 'a', 'h', 'r', 'g', 'T', 'w', 'o', 'e', 'z', 'k', 'l', 'embed']);
const several = new Set(['s', 'q', 'f', 'c', 'K', 'b']);
/** A key of the pinned run, by that of the present one. */
const pinKey = (key: string): string => `A${key}`;
const pins = { once: new Set(['', 'm', 'a', 'h', 'r', 'g', 'T'].map(pinKey)), several: new Set([pinKey('s')]) };
/** A field of the pinned run. */
const isPin = (field: string): boolean => /^A\w?(=|$)/.test(field);

/** What is wrong with an address: thrown and caught in this file only. */
class Wrong extends Error {}

/** Control characters but tab and newline: they can rule a terminal, and no model needs them. */
export const controls = /[\u0000-\u0008\u000b-\u001f\u007f-\u009f]/;
const lineControls = /[\u0000-\u001f\u007f-\u009f]/;

function word(value: string, { long, control }: { readonly long: string; readonly control: string }): string {
  if (value.length > most.words) throw new Wrong(long);
  if (lineControls.test(value)) throw new Wrong(control);
  return value;
}

function fields(parts: readonly string[], keys: { readonly once: ReadonlySet<string>; readonly several: ReadonlySet<string> }): Map<string, string[]> {
  const found = new Map<string, string[]>();
  for (const field of parts) {
    if (field === '') continue;
    const at = field.indexOf('=');
    const key = at < 0 ? field : field.slice(0, at);
    if (!keys.once.has(key) && !keys.several.has(key)) throw new Wrong(words.address.part(key.slice(0, 20)));
    const value = unescape(at < 0 ? '' : field.slice(at + 1));
    if (value === null) throw new Wrong(words.address.code);
    const values = found.get(key) ?? [];
    if (values.length && keys.once.has(key)) throw new Wrong(words.address.twice(key));
    values.push(value);
    found.set(key, values);
  }
  return found;
}

function sectionOf(found: Map<string, string[]>, usual: Section | undefined): Section | undefined {
  const when = found.get('k')?.[0], plane = found.get('K'), starts = found.get('b') ?? [];
  if (when === undefined) {
    if (plane || starts.length) throw new Wrong(words.address.noSection);
    return usual;
  }
  if (when === '') return undefined;
  word(when, words.address.texts.section);
  if (plane && plane.length !== 2) throw new Wrong(words.address.axes);
  for (const name of plane ?? []) word(name, words.address.texts.quantity);
  const states = starts.map((start) => start.split(',').map((number) => (number.trim() === '' ? NaN : Number(number))));
  if (states.length > most.starts || states.some((state) => state.length > most.numbers || !state.every(Number.isFinite))) throw new Wrong(words.address.starts);
  return { when, ...(plane ? { plane: [plane[0] as string, plane[1] as string] } : {}), starts: states };
}

function viewOf(found: Map<string, string[]>, usual: Section | undefined): View {
  const plane = found.get('w')?.[0] ?? defaultView.plane;
  if (plane !== 'auto' && plane !== 'time' && plane !== 'plane' && plane !== 'space') throw new Wrong(words.address.view);
  const quantities = found.get('q') ?? [], phase = found.get('f');
  if (quantities.length > most.columns) throw new Wrong(words.address.quantities);
  for (const name of [...quantities, ...(phase ?? [])]) word(name, words.address.texts.quantity);
  if (phase && phase.length !== 2) throw new Wrong(words.address.axes);
  const hidden = found.get('e')?.[0] ?? '1';
  if (hidden !== '0' && hidden !== '1') throw new Wrong(words.address.exact);
  const speed = found.get('z')?.[0] ?? '1';
  if (!/^\d{1,6}(\.\d{1,9})?$/.test(speed) || !(Number(speed) > 0)) throw new Wrong(words.address.speed);
  const section = sectionOf(found, usual);
  return {
    ...(section ? { section } : {}), plane, quantities, phase: phase ? [phase[0] as string, phase[1] as string] : null, exact: hidden === '1', speed: Number(speed),
  };
}

function textOf(typed: string): string {
  if (controls.test(typed)) throw new Wrong(words.address.modelControl);
  return typed;
}
/** What a run is computed from, but for its text. */
function runOf(sets: readonly string[], listed: string | undefined, usual: readonly string[], step = '', until = '', tolerance = '', accuracy = ''): Omit<Run, 'text'> {
  if (sets.length > most.sets) throw new Wrong(words.address.sets);
  const set: [string, string][] = sets.map(item => {
    const at = item.indexOf('=');
    if (at < 1 || at === item.length - 1) throw new Wrong(words.address.setForm);
    return [word(item.slice(0, at), words.address.texts.parameter), word(item.slice(at + 1), words.address.texts.value)];
  });
  const methods = listed === undefined ? usual : [...new Set(splitList(listed))];
  if (methods.length > most.methods) throw new Wrong(words.address.methods);
  for (const method of methods) word(method, words.address.texts.method);
  return { set: Object.fromEntries(set), methods, step: word(step, words.address.texts.step), until: word(until, words.address.texts.until), tolerance: word(tolerance, words.address.texts.tolerance), accuracy: word(accuracy, words.address.texts.accuracy) };
}
const lines = (text: string | undefined): string | undefined => text?.replace(/\r\n?/g, '\n');

function stateOf(parts: readonly string[], presets: Presets): State {
  const found = fields(parts, { once, several });
  const version = found.get('v')?.[0];
  if (version !== '1') throw new Wrong(version === undefined ? words.address.noVersion : words.address.version);
  const model = found.get('m')?.[0], name = found.get('p')?.[0] ?? '';
  const text = lines(model) ?? presets.text(name);
  if (text === undefined) throw new Wrong(name ? words.address.example(name.slice(0, 40)) : words.address.noModel);
  textOf(text);
  const run = runOf(found.get('s') ?? [], found.get('a')?.[0], model === undefined ? presets.methods(name) : [], found.get('h')?.[0], found.get('T')?.[0], found.get('r')?.[0], found.get('g')?.[0]);
  const place = found.get('l')?.[0] ?? '';
  if (!/^(gallery|step|[a-z0-9-]{1,40}\.(predict|try|see|why)(\.\d{1,2})?)?$/.test(place)) throw new Wrong(words.address.place);
  const inside = found.get('embed')?.[0] ?? '', sliders = found.get('c') ?? [];
  if (inside !== '1' && found.has('embed')) throw new Wrong(words.address.embed);
  if (!inside && sliders.length) throw new Wrong(words.address.noEmbed);
  if (sliders.length > most.columns) throw new Wrong(words.address.sliders);
  for (const slider of sliders) if (!word(slider, words.address.texts.slider)) throw new Wrong(words.address.noSlider);
  if (inside && place) throw new Wrong(words.address.embedPlace);
  return {
    ...(inside ? { embed: [...new Set(sliders)] } : {}),
    preset: presets.text(name) === undefined ? '' : name, text, ...run, view: viewOf(found, model === undefined ? presets.section?.(name) : undefined), place,
  };
}

/** The run that is pinned beside a state, if there is one. */
function pinOf(parts: readonly string[], state: State, presets: Presets): Run | undefined {
  if (!parts.length) return undefined;
  const found = fields(parts, pins), text = lines(found.get(pinKey('m'))?.[0]);
  if (found.get(pinKey(''))?.[0] !== '1') throw new Wrong(words.address.pinned);
  const usual = text === undefined && presets.text(state.preset) === state.text ? presets.methods(state.preset) : [];
  return { text: textOf(text ?? state.text), ...runOf(found.get(pinKey('s')) ?? [], found.get(pinKey('a'))?.[0], usual, found.get(pinKey('h'))?.[0], found.get(pinKey('T'))?.[0], found.get(pinKey('r'))?.[0], found.get(pinKey('g'))?.[0]) };
}

/** The state of a fragment, with or without its '#'; where it is wrong, the first preset and a sentence that says why. */
export function decode(fragment: string, presets: Presets, limit = longest): Decoded {
  const whole = fragment.replace(/^#/, ''), why = (wrong: unknown): string => (wrong instanceof Wrong ? wrong.message : words.address.unreadable);
  try {
    if (whole.length > limit) throw new Wrong(words.address.long(String(limit / 1024)));
    const parts = whole.split('&'), state = stateOf(parts.filter(part => !isPin(part)), presets);
    try {
      const pinned = pinOf(parts.filter(isPin), state, presets);
      return { state: pinned ? { ...state, pinned } : state, problem: '' };
    } catch (wrong) {
      return { state, problem: words.address.noPin(why(wrong)) };
    }
  } catch (wrong) {
    return { state: presetState(presets, presets.first), problem: words.address.unusable(why(wrong)) };
  }
}

/** One word of a POSIX shell. */
export function quote(text: string): string {
  return /^[A-Za-z0-9_./,:=+-]+$/.test(text) ? text : "'" + text.replace(/'/g, "'\\''") + "'";
}

/** A line that the text does not hold, to end a heredoc. */
function delimiter(text: string): string {
  let end = 'MOTUS_END';
  for (let n = 2; text.includes(end); n++) end = `MOTUS_END_${n}`;
  return end;
}

export interface Command { readonly text: string; readonly problem: string }

/** A number as the program reads it, whatever the reader's decimal sign; an expression as it is. */
const number = (typed: string): string => (!lineControls.test(typed) && plain(normal(typed)) ? normal(typed) : typed);

/** The command that computes the same bits wherever motus is installed: the model comes with it. methods: those in use, resolved; state.methods may be empty. adaptive:
 * of them those that choose their own steps; aimed: those that reach for an accuracy, as the program reads it. What compares knows steps of one size, so where there are
 * others every method is a run of its own. */
export function command(state: State, methods: readonly string[], adaptive: readonly string[] = [], aimed: ReadonlyMap<string, string> = new Map()): Command {
  if (methods.length > 1 && adaptive.length + aimed.size) {
    const runs = methods.map((method) => command(state, [method], adaptive.filter((name) => name === method), new Map([...aimed].filter(([name]) => name === method))));
    return { text: runs.map((run) => run.text).join('\n'), problem: runs[0]!.problem };
  }
  const line = methods.length > 1 ? ['motus', 'compare', '-', '--methods', methods.join(',')] : ['motus', 'run', '-'];
  if (methods.length === 1) line.push('--method', methods[0]!);
  const goal = aimed.get(methods[0] ?? '');
  if (goal !== undefined) line.push('--accuracy', goal);
  else if (state.step && !adaptive.length) line.push('--step', number(state.step));
  else if (state.tolerance && adaptive.length) line.push('--tolerance', number(state.tolerance));
  if (state.until) line.push('--until', number(state.until));
  for (const [name, expression] of Object.entries(state.set)) line.push('--set', `${name}=${expression}`);
  const text = state.text.endsWith('\n') || state.text === '' ? state.text : state.text + '\n';
  if (line.some(w => lineControls.test(w)) || controls.test(text)) return { text: '', problem: words.address.command };
  const end = delimiter(text);
  return { text: `${line.map(quote).join(' ')} <<'${end}'\n${text}${end}\n`, problem: '' };
}
