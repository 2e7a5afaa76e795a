/* Elements, made in one expression. Invariant: data becomes text nodes and attributes, never markup. */
export type Child = Node | string | null;
export type Attributes = Readonly<Record<string, string | number | boolean | undefined>>;

function fill(element: Element, attributes: Attributes, children: readonly Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined && value !== false) element.setAttribute(name, value === true ? '' : String(value));
  }
  for (const child of children) if (child !== null) element.append(child);
}

export function el<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  fill(element, attributes, children);
  return element;
}

/** A button that submits nothing. */
export function button(label: string, press: () => void, attributes: Attributes = {}, ...children: Child[]): HTMLButtonElement {
  const element = el('button', { type: 'button', ...attributes }, ...(children.length ? children : [label]));
  element.addEventListener('click', press);
  return element;
}

/** The element of the page with this id, which index.html promises. */
export function place(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (!element) throw new Error(`index.html lacks #${id}`);
  return element;
}

/** Text that changes often: written only where it differs, so that a live region does not speak twice. */
export function say(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

const passed = new Set<string>();
/** A mark in the browser's own timeline, where bench/page.mjs reads it; the first of a name counts. */
export function milestone(name: string): void {
  if (passed.has(name)) return;
  passed.add(name);
  performance.mark(`motus-${name}`);
}

let last = 0;
export const fresh = (stem: string): string => `${stem}-${++last}`;

/** 24-pixel line drawings. */
export function icon(...paths: string[]): SVGSVGElement {
  return svg('svg', { viewBox: '0 0 24 24', width: 20, height: 20, 'aria-hidden': 'true', focusable: 'false', class: 'icon' }, ...paths.map(d => svg('path', { d })));
}
