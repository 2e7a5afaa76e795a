/* The first script of the page, before any other has come: what the build has drawn can be clicked already, and the last click is kept.
 * Invariant: it ends with window.early, which main.ts takes away (shell/early.ts).
 */
window.early = null;
addEventListener('click', ({ target }) => {
  if (window.early !== undefined && target instanceof Element) window.early = target.closest('button');
}, true);
