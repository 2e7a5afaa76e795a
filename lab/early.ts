/* The first script of the page, right behind the first picture: fits it to the screen, and keeps the last click on what cannot answer yet.
 * Invariant: it ends with window.early, which main.ts takes away (shell/early.ts).
 */
import { fitFirst } from './stage/fit';

window.early = null;
addEventListener('click', ({ target }) => {
  if (window.early !== undefined && target instanceof Element) window.early = target.closest('button');
}, true);
fitFirst();
// It has done its work: no script stays in the part of the page that shows.
document.currentScript?.remove();
