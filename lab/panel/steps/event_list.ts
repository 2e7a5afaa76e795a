/* The events of a step as a list: each with its formula and its numbers, the present one marked; a click goes to it. */
import type { Told } from './told';

export interface EventList { readonly element: HTMLElement; show(events: readonly Told[], present: number, closing: string): void }

export function eventList(choose: (event: number) => void): EventList {
  const element = document.createElement('div');
  element.className = 'steps-events';
  const list = document.createElement('ol');
  const closing = document.createElement('p');
  closing.className = 'steps-closing';
  list.tabIndex = 0;
  list.setAttribute('role', 'list');
  list.setAttribute('aria-label', 'Parts of this step');
  element.append(list, closing);
  const line = (name: string, text: string): HTMLSpanElement => {
    const s = document.createElement('span');
    s.className = name;
    s.textContent = text;
    return s;
  };

  function item(told: Told, k: number): HTMLLIElement {
    const li = document.createElement('li'), button = document.createElement('button');
    button.type = 'button';
    button.append(line('steps-title', told.title));
    if (told.note) button.append(line('steps-note', told.note));
    for (const f of told.formulas) {
      if (f.symbols !== '') button.append(line('steps-symbols', f.symbols));
      const numbers = line('steps-numbers', f.numbers);
      numbers.title = f.full;
      button.append(numbers);
    }
    button.addEventListener('click', () => choose(k));
    li.append(button);
    return li;
  }

  /* Within the list only: the page stays where its reader has put it. */
  function reveal(li: HTMLElement): void {
    const top = li.offsetTop, bottom = top + li.offsetHeight;
    if (top < list.scrollTop) list.scrollTop = top;
    else if (bottom > list.scrollTop + list.clientHeight) list.scrollTop = Math.min(top, bottom - list.clientHeight);
  }

  return {
    element,
    show(events, present, last) {
      /* The focus stays on the same event when the numbers change under it. */
      const focused = Array.from(list.children).findIndex(li => li.contains(document.activeElement));
      list.replaceChildren(...events.map(item));
      closing.textContent = last;
      Array.from(list.children).forEach((li, k) => {
        const button = li.firstElementChild;
        if (k === present) button?.setAttribute('aria-current', 'step');
        if (k === present && li instanceof HTMLElement) reveal(li);
        if (k > present) li.classList.add('steps-later');
        if (k === focused && button instanceof HTMLElement) button.focus({ preventScroll: true });
      });
    },
  };
}
