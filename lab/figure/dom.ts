/* Elements in one line. Invariant: data becomes text or an attribute, never markup. */

type Attributes = Readonly<Record<string, string | boolean>>;

export function element<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: readonly (Node | string)[]): HTMLElementTagNameMap[K] {
  const e = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) e.setAttribute(name, '');
    else if (value !== false) e.setAttribute(name, value);
  }
  e.append(...children);
  return e;
}

export function button(label: string, act: () => void, attributes: Attributes = {}): HTMLButtonElement {
  const b = element('button', { type: 'button', ...attributes }, label);
  b.addEventListener('click', act);
  return b;
}
