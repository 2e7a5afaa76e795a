/* What is said of one example; which they are, see en/scenes.ts. */
export interface SceneWords {
  readonly title: string;
  /** What the gallery and the stage ask: a lesson answers it, or the first sentence of its note (en/notes.ts). */
  readonly question: string;
  /** One or two sentences under the title; steps: how many the first method takes. */
  readonly sentence: string | ((steps: string) => string);
  /** The same where numbers of the scene are not its own any more; absent: what is said holds for all numbers. */
  readonly moved?: string;
  /** Where the stage has no room for the phase plane beside the motion; absent: the same. */
  readonly alone?: string;
  /** What an invariant is, by its name, where the name alone does not say it. */
  readonly keeps?: Readonly<Record<string, string>>;
  /** The sliders of the dock, by the name of their number: "k", "x(0)"; of a component "r'(0).y". */
  readonly dials?: Readonly<Record<string, string>>;
  /** The switch that goes to another example. */
  readonly switch?: string;
}
