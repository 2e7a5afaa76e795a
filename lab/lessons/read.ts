/* Lessons, from the plain text that a teacher writes: doc/lessons.md says how. Read when the page is built.
 *
 * Invariant: a lesson that is returned names scenes, methods and pictures that exist, has one right choice at most and something to try; whatever is
 * wrong is said with file, line and what would be right, all of it at once.
 */
import { faults } from '../words';

/** What ticks a task off. */
export type Condition =
  | { readonly kind: 'method'; readonly method: string; readonly on: boolean }
  | { readonly kind: 'step' | 'until'; readonly value: number }
  | { readonly kind: 'set'; readonly name: string; readonly value: string }
  | { readonly kind: 'opened'; readonly place: string }
  | { readonly kind: 'scene'; readonly model: string };
export interface Task { readonly condition: Condition; readonly label: string }
export interface Choice { readonly label: string; readonly right: boolean; readonly answer: string; /** On the rail: above the exact motion, on it, below. */ readonly place: Place | null }
export type Place = (typeof places)[number];

export interface Lesson {
  readonly id: string; readonly title: string;
  readonly scene: {
    readonly model: string; readonly set: Readonly<Record<string, string>>; readonly methods: readonly string[]; readonly step: string; readonly until: string;
    readonly view: readonly ('plane' | 'time' | 'phase')[];
  };
  readonly predict: {
    readonly text: readonly string[]; readonly hide: readonly string[]; readonly choices: readonly Choice[]; readonly button: string; readonly hint: string;
    /** The guess is a ring that is dragged along this column, at the end of the motion by this method. */
    readonly rail: { readonly column: string; readonly method: string } | null;
  };
  /** measured: what is written down of each run, '' for nothing. */
  readonly attempt: { readonly text: readonly string[]; readonly tasks: readonly Task[]; readonly measured: string };
  readonly see: readonly string[];
  readonly why: { readonly title: string; readonly text: readonly string[]; readonly picture: string; readonly caption: string };
  /** The word of the link to the next lesson; '' where there is none. */
  readonly next: string;
  /** For the test alone: what the lesson says, and what the program must compute. */
  readonly numbers: readonly { readonly said: string; readonly value: string; readonly quantity: string; readonly line: number }[];
}

export interface Known { readonly models: readonly string[]; readonly methods: readonly string[] }

export const places = ['above', 'on', 'below'] as const;
/** The close-up pictures that can stand beside an explanation. */
export const pictures = ['straight', 'old-new-speed', 'middle', 'halves', 'energy', 'two-places', 'overshoot'] as const;
export const opened = ['step', 'closer'] as const;
/** What can be written down of each run: how far from the exact motion it ends. */
export const measured = ['distance'] as const;
const views = ['plane', 'time', 'phase'] as const;

/** once: at most once; many: as often as one likes. A needed key must be there. */
const keys: Readonly<Record<string, { readonly needed?: boolean; readonly many?: boolean }>> = {
  'lesson': { needed: true }, 'scene': { needed: true }, 'set': { many: true }, 'methods': { needed: true }, 'step': {}, 'until': {}, 'view': { needed: true },
  'predict': { needed: true }, 'hide': {}, 'right': {}, 'wrong': { many: true }, 'rail': {}, 'hint': {}, 'button': { needed: true },
  'try': { needed: true }, 'do': { needed: true, many: true }, 'measured': {}, 'see': { needed: true },
  'why': { needed: true }, 'picture': {}, 'caption': {}, 'next': {}, 'number': { many: true },
};

interface Field { readonly key: string; readonly line: number; readonly value: string; /** The indented lines below, as paragraphs. */ readonly below: readonly string[]; /** The first of them goes on with the value. */ readonly joined: boolean }

/** The word of a list that is nearest to a word, for a hint: about a third of its letters may differ. */
function nearest(word: string, list: readonly string[]): string {
  let best = '', least = Math.ceil(word.length / 3) + 1;
  for (const other of list) {
    let row = Array.from({ length: other.length + 1 }, (_, j) => j);
    for (let i = 1; i <= word.length; i++) {
      const next = [i];
      for (let j = 1; j <= other.length; j++) next.push(Math.min((row[j] ?? 0) + 1, (next[j - 1] ?? 0) + 1, (row[j - 1] ?? 0) + (word[i - 1] === other[j - 1] ? 0 : 1)));
      row = next;
    }
    const distance = row[other.length] ?? Infinity;
    if (distance < least) least = distance, best = other;
  }
  return best;
}

class Reader {
  readonly problems: string[] = [];
  readonly fields: Field[] = [];

  constructor(private readonly file: string, text: string, private readonly known: Known) {
    let field: { key: string; line: number; value: string; below: string[]; joined: boolean } | null = null, gap = false;
    text.replace(/^\uFEFF/, '').split(/\r\n?|\n/).forEach((raw, i) => {
      const line = i + 1, content = raw.trim();
      if (raw.startsWith('#')) return;
      if (content === '') { gap = true; return; }
      if (/^\s/.test(raw)) {
        if (!field) this.wrong(line, faults.indented, faults.exampleKey);
        else if (gap || field.below.length === 0) {
          field.joined ||= !gap;
          field.below.push(content);
        }
        else field.below.push(`${field.below.pop()} ${content}`);
      } else {
        const [, key, value] = /^([a-z]+)\s*:\s*(.*)$/.exec(raw.trimEnd()) ?? [];
        if (key === undefined || value === undefined) this.wrong(line, faults.noKey(content.slice(0, 40)), faults.lines);
        else if (!Object.hasOwn(keys, key)) this.wrong(line, faults.key(key), this.like(key, Object.keys(keys)));
        field = key === undefined || value === undefined ? null : { key, line, value, below: [], joined: false };
        if (field) this.fields.push(field);
      }
      gap = false;
    });
    for (const [key, { needed, many }] of Object.entries(keys)) {
      const found = this.all(key);
      if (needed && !found.length) this.wrong(0, faults.missing(key));
      if (!many && found[1]) this.wrong(found[1].line, faults.again(key, String(found[0]?.line)));
    }
  }

  wrong(line: number, what: string, hint = ''): void {
    this.problems.push(faults.at(this.file, line ? String(line) : '', what, hint));
  }
  like(word: string, list: readonly string[]): string {
    const near = nearest(word, list);
    return near ? faults.alike(near) : list.length <= 24 ? faults.oneOf(list) : '';
  }
  all(key: string): Field[] { return this.fields.filter(field => field.key === key); }
  one(key: string): Field { return this.all(key)[0] ?? { key, line: 0, value: '', below: [], joined: false }; }
  /** A field's text: the rest of its line and the paragraphs below. */
  text({ value, below, joined }: Field): string[] {
    if (value === '') return [...below];
    return joined ? [`${value} ${below[0]}`, ...below.slice(1)] : [value, ...below];
  }
  words(key: string): string {
    const field = this.one(key), text = this.text(field).join(' ');
    if (field.line && text === '') this.wrong(field.line, faults.empty(key));
    return text;
  }
  paragraphs(key: string): string[] {
    const field = this.one(key), text = this.text(field);
    if (field.line && text.length === 0) this.wrong(field.line, faults.empty(key));
    return text;
  }
  member(line: number, word: string, list: readonly string[], none: (word: string) => string): void {
    if (!list.includes(word)) this.wrong(line, none(word), this.like(word, list));
  }
  list(key: string, from: readonly string[], none: (word: string) => string): string[] {
    const field = this.one(key), words = this.text(field).join(' ').split(/\s*,\s*/).filter(Boolean);
    for (const word of words) this.member(field.line, word, from, none);
    return words;
  }
  number(line: number, text: string, what: string): number {
    const value = Number(text);
    if (!/^\d+(\.\d+)?$/.test(text) || !(value > 0)) this.wrong(line, faults.number(what, text), faults.exampleNumber(what));
    return value;
  }
  method(line: number, name: string): string {
    this.member(line, name, this.known.methods, faults.no.method);
    return name;
  }

  condition({ line, value }: Field): Condition {
    const [, changed, to] = /^set\s+([^\s=]+)\s*=\s*(\S.*)$/.exec(value) ?? [];
    if (changed !== undefined && to !== undefined) return { kind: 'set', name: changed, value: to };
    const [kind = '', name = '', state = '', ...more] = value.split(/\s+/);
    const surplus = kind === 'method' ? more[0] : kind === 'set' ? '' : state;
    if (surplus) this.wrong(line, faults.surplus(surplus), faults.one);
    switch (kind) {
      case 'method':
        if (state !== 'on' && state !== 'off') this.wrong(line, faults.onOff, faults.exampleOn);
        return { kind, method: this.method(line, name), on: state !== 'off' };
      case 'step': case 'until': return { kind, value: this.number(line, name, kind) };
      case 'set':
        this.wrong(line, name === '' ? faults.whichSet : faults.toWhat(name), faults.exampleSet);
        return { kind, name, value: '' };
      case 'opened': this.member(line, name, opened, faults.no.opened); return { kind, place: name };
      case 'scene': this.member(line, name, this.known.models, faults.no.scene); return { kind, model: name };
      default:
        this.wrong(line, faults.condition(value), faults.conditions);
        return { kind: 'opened', place: '' };
    }
  }

  choices(): Choice[] {
    const fields = this.fields.filter(({ key }) => key === 'right' || key === 'wrong');
    const rail = this.one('rail'), listed = rail.line ? rail.value.split(/\s*,\s*/)[1]?.split(/\s+/) ?? [] : [];
    if (fields.length < 2) this.wrong(this.one('predict').line, faults.choices, faults.exampleChoice);
    if (fields.length && !this.one('right').line) this.wrong(fields[0]?.line ?? 0, faults.noneRight, faults.exampleRight);
    if (rail.line) {
      for (const word of listed) this.member(rail.line, word, places, faults.no.place);
      if (listed.length !== fields.length) this.wrong(rail.line, faults.rail(String(listed.length), String(fields.length)), faults.exampleRail);
    }
    return fields.map(({ key, line, value, below }, k) => {
      if (value === '') this.wrong(line, faults.choiceWord, faults.exampleWord);
      if (!below.length) this.wrong(line, faults.answer(value), faults.below);
      return { label: value, right: key === 'right', answer: below.join(' '), place: places.find(place => place === listed[k]) ?? null };
    });
  }

  lesson(id: string): Lesson {
    const scene = this.one('scene'), until = this.one('until'), step = this.one('step'), rail = this.one('rail'), why = this.one('why'), picture = this.one('picture'), measure = this.one('measured');
    if (measure.line) this.member(measure.line, measure.value, measured, faults.no.measured);
    if (scene.line) this.member(scene.line, scene.value, this.known.models, faults.no.scene);
    for (const { line, key, value } of [step, until]) if (line) this.number(line, value, key);
    const set: Record<string, string> = {};
    for (const { line, value } of this.all('set')) {
      const [, name, expression] = /^(.+?)\s*=\s*(.+)$/.exec(value) ?? [];
      if (name === undefined || expression === undefined) this.wrong(line, faults.sets(value), faults.exampleSets);
      else set[name] = expression;
    }
    const [, railMethod = '', railColumn = ''] = /^(\S+)\s+([^,]+?)\s*,/.exec(rail.value) ?? [];
    if (rail.line && railColumn === '') this.wrong(rail.line, faults.railSays, faults.exampleRail);
    else if (rail.line) this.method(rail.line, railMethod);
    if (picture.line) this.member(picture.line, picture.value, pictures, faults.no.picture);
    const caption = this.one('caption');
    if (caption.line && !picture.line) this.wrong(caption.line, faults.caption, faults.examplePicture);
    if (why.line && !why.below.length) this.wrong(why.line, faults.why, faults.belowTitle);
    const numbers = this.all('number').map(({ line, value }) => {
      const [, said, given, quantity] = /^(?:“([^”]+)”\s*)?(\S+)\s*=\s*(.+)$/.exec(value) ?? [];
      if (given === undefined || quantity === undefined || !Number.isFinite(Number(given))) this.wrong(line, faults.says(value), faults.exampleSays);
      return { said: said ?? given ?? '', value: given ?? '0', quantity: quantity ?? '', line };
    });
    return {
      id, title: this.words('lesson'),
      scene: {
        model: scene.value, set, methods: this.list('methods', this.known.methods, faults.no.method), step: step.value, until: until.value,
        view: this.list('view', views, faults.no.view) as Lesson['scene']['view'],
      },
      predict: {
        text: this.paragraphs('predict'), hide: this.list('hide', this.one('methods').line ? this.list('methods', this.known.methods, faults.no.method) : [], faults.no.methodHere),
        choices: this.choices(), button: this.words('button'), hint: this.words('hint'), rail: rail.line ? { method: railMethod, column: railColumn } : null,
      },
      attempt: { text: this.paragraphs('try'), tasks: this.all('do').map(field => ({ condition: this.condition(field), label: field.below.join(' ') || field.value })), measured: measure.value },
      see: this.paragraphs('see'),
      why: { title: why.value, text: why.below, picture: picture.value, caption: this.words('caption') },
      next: this.words('next'), numbers,
    };
  }
}

/** One lesson; its file is named NUMBER-ID.txt. Throws an Error that says all that is wrong with it. */
export function readLesson(file: string, text: string, known: Known): Lesson {
  const reader = new Reader(file, text, known), id = /^(?:.*\/)?\d+-([a-z0-9-]+)\.txt$/.exec(file)?.[1];
  if (id === undefined) reader.wrong(0, faults.file, faults.exampleFile);
  const lesson = reader.lesson(id ?? '');
  if (reader.problems.length) throw new Error([...new Set(reader.problems)].join('\n'));
  return lesson;
}

const numberOf = (file: string): number => Number(/(\d+)-[^/]*$/.exec(file)?.[1] ?? Infinity);

/** All lessons, in the order of their numbers. */
export function readLessons(files: readonly { readonly name: string; readonly text: string }[], known: Known): Lesson[] {
  const problems: string[] = [], lessons: Lesson[] = [];
  for (const { name, text } of [...files].sort((a, b) => numberOf(a.name) - numberOf(b.name))) {
    try {
      const lesson = readLesson(name, text, known);
      if (lessons.some(({ id }) => id === lesson.id)) problems.push(faults.at(name, '', faults.address(lesson.id), ''));
      lessons.push(lesson);
    } catch (e) {
      problems.push(e instanceof Error ? e.message : String(e));
    }
  }
  if (problems.length) throw new Error(problems.join('\n'));
  return lessons;
}

/** What the page has done, as far as tasks ask for it. */
export interface Done {
  readonly model: string; readonly methods: readonly string[]; readonly step: number; readonly until: number; readonly set: Readonly<Record<string, string>>; readonly opened: ReadonlySet<string>;
}

/** Whether two texts set a number differently: 0.0 is 0. */
const differ = (a: string | undefined, b: string | undefined): boolean => a !== b && (a === undefined || b === undefined || Number.isNaN(Number(a)) || Number(a) !== Number(b));

/** Whether a task is done now. Numbers may be off by a hundredth of themselves: a slider was dragged. A number that is no longer set has the model's own value. */
export function met(condition: Condition, lesson: Pick<Lesson, 'scene'>, done: Done): boolean {
  const near = (a: number, b: number): boolean => Math.abs(a - b) <= 0.01 * b;
  switch (condition.kind) {
    case 'method': return done.methods.includes(condition.method) === condition.on;
    case 'step': return near(done.step, condition.value);
    case 'until': return near(done.until, condition.value);
    case 'set': return differ(done.set[condition.name], lesson.scene.set[condition.name]);
    case 'opened': return done.opened.has(condition.place);
    case 'scene': return done.model === condition.model;
  }
}
