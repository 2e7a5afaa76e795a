/* The button that opens the editor: the equation where there is room for it, and words. A long equation is read in the editor. */
export function fitPill(pill: Element): void {
  const math = pill.querySelector('.pill-math');
  if (math && (math.scrollWidth > math.clientWidth + 1 || pill.scrollWidth > pill.clientWidth + 1)) math.replaceChildren();
}
