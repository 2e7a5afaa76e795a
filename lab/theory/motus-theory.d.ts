/* What typeset.mjs makes when the page is built: the cards of the best-known methods, by name. body is XHTML with MathML, well formed. */
declare module 'motus:theory' {
  export const cards: Readonly<Record<string, { readonly title: string; readonly body: string }>>;
}
