/* What was clicked, or had the focus, before the page had started. The build's buttons are replaced by those that answer, with the same name and words;
 * where the page starts with another scene there is none, and nothing is done.
 */
declare global { interface Window { early?: Element | null } }

/** Finds what has taken the place of an element, as that was named when this was called. */
function successor(of: Element | null | undefined): () => HTMLElement | undefined {
  const selector = of instanceof HTMLButtonElement ? (of.id ? `#${of.id}` : `button.${of.className}`) : '', text = of?.textContent;
  return () => (selector ? [...document.querySelectorAll<HTMLElement>(selector)].find((now) => now.textContent === text) : undefined);
}

/** To be called before the page is put together; what it answers, afterwards: true if there was something to do. */
export function early(): () => boolean {
  const clicked = successor(window.early), focused = successor(document.activeElement);
  delete window.early;
  return () => {
    const now = clicked();
    focused()?.focus({ preventScroll: true });
    now?.click();
    return now !== undefined;
  };
}
