/* The language of the page. Invariant: every sentence that a reader sees or hears comes from here, but for what the C core says, its names and its messages,
 * and for the models' own comments, which are English. Another language is a folder beside en/ with the same shape, which the compiler checks, and the word
 * en below replaced by its name. page, computed, faults, html and notes stand alone, so that what needs one of them holds no more: the script that unpacks the others,
 * the workers, the reader of lessons, the build.
 */
export { words } from './en';
export { computed } from './en/computed';
export { faults } from './en/faults';
export { html } from './en/html';
export { movedNotes, notes } from './en/notes';
export { page } from './en/page';
