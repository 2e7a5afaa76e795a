/* The first script of the page, right behind the first words and picture: fits them to the screen, and keeps the last click on what cannot answer yet.
 * Invariant: it ends with window.early, which main.ts takes away (shell/early.ts).
 */
import { fitPill } from './shell/pill';
import { fitFirst } from './stage/fit';

window.early = null;
addEventListener('click', ({ target }) => {
  if (window.early !== undefined && target instanceof Element) window.early = target.closest('button');
}, true);
const pill = document.querySelector('#words .pill');
if (pill) fitPill(pill);
fitFirst();
