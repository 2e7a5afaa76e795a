/* The language of the page. Invariant: every sentence that a reader sees or hears comes from here; another language is a folder beside en/, with the
 * same shape, which the compiler checks.
 */
export { words } from './en';
