/* What every part of the page is given: the state, what was computed for it, and how each method looks.
 *
 * Invariant: data flows one way. Controls change the state (Store.change); the store asks the worker; panels are shown the result. A panel never
 * computes a motion, and never changes another panel.
 */
import type { Ask, Description, Method, Problem, Requests, Solution } from './protocol';

/** What a run is computed from. */
export interface Run {
  readonly text: string; readonly set: Readonly<Record<string, string>>; readonly methods: readonly string[]; readonly step: string; readonly until: string; readonly tolerance: string; readonly accuracy: string;
}
/** The whole state of the page that an address can hold. Texts are as the reader typed them. */
export interface State {
  readonly preset: string;                      // a name of models/, or ''
  readonly text: string;                        // the model
  readonly set: Readonly<Record<string, string>>;      // name -> expression, in order: sliders
  readonly methods: readonly string[];          // overlaid; the first is the main one
  readonly step: string;                        // '' : the model's
  readonly until: string;
  readonly tolerance: string;                   // of the adaptive methods; '' : the model's
  readonly accuracy: string;                    // of the answer, by these methods; '' : the model's, which may have none; UNASKED: none
  readonly view: View;
  /** Where in the page one is: '' at the stage, 'gallery', 'step', or a lesson as lesson.ts writes it, 'too-high-too-low.try.0'. */
  readonly place: string;
  /** Absent: the whole page. Else the page as a picture inside another, with these sliders: 'step', and numbers as sliders.ts names them. */
  readonly embed?: readonly string[];
  /** The run A that stays beside the present one, if there is one. */
  readonly pinned?: Run;
}
/** State.accuracy, where none is asked for: step and tolerance decide. */
export const UNASKED = 'off';
export interface View {
  readonly plane: 'time' | 'plane' | 'space' | 'auto';      // what the motion panel shows: x-t, x-y, x-y-z
  readonly quantities: readonly string[];       // of the time panel; [] : the positions
  readonly phase: readonly [string, string] | null;        // of the phase panel; null: x, x'
  readonly exact: boolean;                      // green line shown
  readonly speed: number;                       // of the animation, times the natural one
  readonly section?: Section | undefined;       // absent: that of the model's first kind of events
}
/** Of the section's panel. when: a condition, "x = 0 rising", "every 2 pi", or the name of a kind of the model's own events. plane: columns, behind which "mod 2 pi" may stand. starts: other motions'
 *  states, positions and then velocities and first-order variables. */
export interface Section { readonly when: string; readonly plane?: readonly [string, string] | undefined; readonly starts: readonly (readonly number[])[] }

export type Theme = 'auto' | 'light' | 'dark';
export type Marker = 'circle' | 'square' | 'triangle' | 'diamond' | 'cross' | 'plus' | 'star' | 'down' | 'ring' | 'bar';
/** How a method is drawn, in every panel alike. colour, tone: CSS colours for the present theme, of its line and of letters about it. */
export interface Look { readonly method: string; readonly label: string; readonly colour: string; readonly tone: string; readonly dash: readonly number[]; readonly marker: Marker }

export interface Scene {
  readonly state: State; readonly description: Description; readonly solution: Solution;
  readonly looks: readonly Look[];              // parallel to solution.tracks
  readonly catalogue: readonly Method[];
}

/** Asks a worker; `lane` 'study' is for long work, which a new question of the same lane and key cancels. */
export interface Client {
  ask<K extends Ask>(kind: K, ask: Requests[K]['ask'], options?: { readonly lane?: 'quick' | 'study'; readonly key?: string; readonly signal?: AbortSignal }): Promise<Requests[K]['answer']>;
}
/** A rejected ask carries the core's problem. */
export class Refused extends Error {
  constructor(readonly problem: Problem) { super(problem.message); }
}

export interface Store {
  readonly state: State;
  readonly scene: Scene | null;                 // of the latest state that could be computed
  /** What step and end came to for it, where they were typed as an expression. */
  readonly numbers: { readonly step: number | null; readonly tolerance: number | null; readonly accuracy: number | null; readonly until: number | null; readonly start: number };
  change(part: Partial<State>): void;           // computed anew, once per frame
  look(part: Partial<View>): void;              // the view alone
  readonly client: Client;
}

/** One figure of the page. `element` is a <figure>; see figure/figure.ts. */
export interface Panel {
  readonly id: string; readonly title: string; readonly element: HTMLElement;
  /** Whether it has something to say of this scene; absent: always. Cheap, as it is asked of each scene. */
  there?(scene: Scene): boolean;
  /** A new scene; called only while the panel is near what is seen. */
  show(scene: Scene): void;
  /** The time of the animation: a cursor, a dot. Must cost less than a millisecond or two. */
  at(time: number): void;
  /** Colours have changed, or the size of the element. */
  redraw(): void;
}
export type PanelMaker = (store: Store) => Panel;
