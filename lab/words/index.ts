/* The language of the page. Invariant: every sentence that a reader sees or hears comes from here; another language is a folder beside en/, with the
 * same shape, which the compiler checks. page stands alone, so that the script that unpacks the others holds no more of them than it needs.
 */
export { words } from './en';
export { page } from './en/page';
