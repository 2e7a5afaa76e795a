/* What a note of a scene is made of, in any language. */

/** A button within a sentence: it goes to another example, takes a step, or sets the end. */
export type NoteLink = { readonly label: string } & ({ readonly to: string } | { readonly step: string } | { readonly until: string });
/** Parts of a sentence. */
export type Linked = readonly (string | NoteLink)[];
/** Paragraphs. */
export type Note = readonly (string | Linked)[];
