/* What build.mjs makes. */
declare module 'virtual:presets' {
  const presets: readonly { readonly name: string; readonly text: string }[];
  export default presets;
}
declare module 'virtual:thumbs' {
  const thumbs: Readonly<Record<string, import('./thumbs').Thumb>>;
  export default thumbs;
}
declare module 'virtual:lessons' {
  const lessons: readonly Omit<import('./lessons/read').Lesson, 'numbers'>[];
  export default lessons;
}
/* Where the page lives: on a server, or in one file. */
declare module 'virtual:host' {
  export function coreModule(): Promise<WebAssembly.Module>;
  export function createWorker(): Worker;
}
