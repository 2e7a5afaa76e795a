/* What build.mjs makes. */
declare module 'virtual:data' {
  const data: () => Promise<import('./data').Data>;
  export default data;
}
declare module 'virtual:thumbs' {
  /** Unpacked when they are first asked for. */
  const thumbs: () => Promise<Readonly<Record<string, import('./thumbs').Thumb>>>;
  export default thumbs;
}
/* Where the page lives: on a server, or in one file. */
declare module 'virtual:host' {
  export function coreModule(): Promise<WebAssembly.Module>;
  export function createWorker(): Worker;
}
