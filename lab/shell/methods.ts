/* Which methods are compared. The common ones and those in use are toggles with the line they are drawn with; all others wait in a list that can be
 * searched.
 *
 * Invariant: a toggle shows what is chosen, and one that the model does not admit cannot be chosen and says why.
 */
import { looksOf } from '../figure/ink';
import { AUTO, type Method } from '../protocol';
import { admittedMethods, family, kinds, ownName, type LiveStore } from '../state';
import { button, el, say } from '../dom';
import { words } from '../words';
import { sample } from './sample';
import { choiceText } from './tolerance';

const common = ['explicit-euler', 'symplectic-euler', 'midpoint', 'verlet', 'rk4'];
const most = 12;

interface Toggle { readonly element: HTMLElement; readonly name: string; refresh(chosen: readonly string[]): void; repaint(): void }

export function methods(store: LiveStore): { readonly element: HTMLElement; repaint(): void } {
  const list = el('div', { class: 'chips' }), more = el('div', { class: 'toggles' });
  const search = el('input', { type: 'search', id: 'method-search', placeholder: words.methods.search, autocomplete: 'off', spellcheck: 'false' });
  const found = el('p', { class: 'quiet', role: 'status' });
  const message = el('p', { class: 'message mild', role: 'status' });
  const sheet = el('div', { id: 'all-methods', class: 'sheet', popover: 'auto', role: 'group', 'aria-label': words.methods.all }, el('label', { for: 'method-search' }, words.methods.all), search, found, more);
  const opener = button(words.methods.more('28'), () => {}, { class: 'chip-more', popovertarget: 'all-methods' });
  const element = el('div', { class: 'methods', role: 'group', 'aria-label': words.methods.group }, el('div', { class: 'chips-row' }, list, opener), sheet, message);

  let toggles: Toggle[] = [], shown = '', opened = '', front: readonly string[] = [], limitReached = false, last: readonly unknown[] = [];
  /** What is drawn: the state's, or the model's own where the state names none. */
  const chosen = (): readonly string[] => {
    if (store.state.methods.length) return store.state.methods.map(name => ownName(name, store.catalogue));
    return store.description ? admittedMethods(store.state, store.description, store.catalogue).methods : [];
  };
  /** What "auto" has chosen; it is not told by the state. */
  const picked = (): string => store.scene?.solution.tracks.find((t) => t.goal?.choice)?.method ?? AUTO;
  function press(name: string): void {
    const now = chosen();
    limitReached = false;
    if (now.includes(name)) {
      if (now.length > 1) store.change({ methods: now.filter(m => m !== name) });
    } else if (now.length >= most) {
      limitReached = true;
      refresh();
    } else store.change({ methods: [...now, name] });
  }
  const told = ({ order, symplectic, reversible, family, evaluations }: Method): string => words.methods.told(order, symplectic, reversible, family, evaluations);

  function toggle(name: string): Toggle {
    const reason = el('span', { class: 'reason' });
    const label = el('span', { class: 'label' });
    const picture = el('span', { class: 'picture' });
    const method = store.catalogue.find(m => m.name === name);
    const control = button('', () => { if (control.getAttribute('aria-disabled') !== 'true') press(name); }, { class: 'chip', 'aria-pressed': 'false' }, picture, el('span', { class: 'words' }, label, reason));
    const usual = method ? told(method) : '';
    const repaint = (): void => {
      const of = name === AUTO ? picked() : name, look = looksOf([of], store.catalogue)[0];
      if (!look) return;
      picture.replaceChildren(...(of === AUTO ? [] : [sample(look)]));
      control.style.setProperty('--c', of === AUTO ? 'var(--quiet)' : look.colour);
      say(label, name === AUTO ? words.methods.auto(of === AUTO ? '' : look.label) : look.label);
    };
    repaint();
    return {
      element: control, name, repaint,
      refresh(now) {
        const entry = store.description?.methods.find(m => m.name === name);
        const refused = entry !== undefined && !entry.admitted;
        control.setAttribute('aria-pressed', String(now.includes(name) && !refused));
        control.setAttribute('aria-disabled', String(refused));
        say(reason, refused ? entry.reason : '');
        if (name === AUTO) repaint();
        control.title = refused ? words.methods.refused(entry.reason, entry.hint) : name === AUTO ? words.methods.autoTitle(choiceText(store, store.scene?.solution.tracks.find((t) => t.goal?.choice)?.goal?.choice ?? '')) : usual;
      },
    };
  }
  function build(): void {
    const now = chosen().filter(name => name !== AUTO && store.catalogue.some(m => m.name === family(name))), auto = kinds(store).aimed > 0 || chosen().includes(AUTO) ? [AUTO] : [];
    // Those that a scene opens with come first, and stay there.
    if (store.state.preset !== opened || !front.length) { opened = store.state.preset; front = now; }
    const first = [...front, ...common.filter(name => !front.includes(name))].slice(0, Math.max(5, front.length)), names = [...auto, ...first, ...now.filter(name => !first.includes(name))];
    const admitted = (name: string): boolean => store.description?.methods.find(m => m.name === name)?.admitted ?? true;
    const unused = store.catalogue.filter(m => m.order > 0 && !names.includes(m.name)).map(m => m.name);
    const others = [...unused.filter(admitted), ...unused.filter(name => !admitted(name))];
    const key = names.join() + '|' + others.join();
    if (key === shown || !store.catalogue.length) return;
    shown = key;
    const held = document.activeElement instanceof HTMLElement ? document.activeElement.dataset.method : undefined;
    toggles = [...names, ...others].map(toggle);
    for (const t of toggles) t.element.dataset.method = t.name;
    list.replaceChildren(...toggles.slice(0, names.length).map(t => t.element));
    say(opener, words.methods.more(String(others.length)));
    more.replaceChildren(...toggles.slice(names.length).map(t => t.element));
    cut();
    if (held !== undefined) toggles.find(t => t.name === held)?.element.focus({ preventScroll: true });
    filter();
  }
  /** Many are refused for one reason, which is written at the first of them; each has it as its description. */
  function reasons(): void {
    let last = '';
    for (const { element: control } of toggles) {
      const reason = control.querySelector<HTMLElement>('.reason'), text = reason?.textContent ?? '';
      if (!reason || control.hidden) continue;
      reason.hidden = text === last || text === '';
      control.classList.toggle('explained', !reason.hidden);
      last = text;
    }
  }
  function filter(): void {
    // "order 4" is one thing; every other word stands for itself, and for the beginnings of words.
    const wanted = search.value.toLowerCase().match(new RegExp(`${words.methods.order}\\s+\\d+|\\S+`, 'g'))?.map(word => ' ' + word.replace(/\s+/, ' ')) ?? [];
    let count = 0;
    for (const { element: control, name } of toggles) {
      if (control.parentElement !== more) continue;
      const method = store.catalogue.find(m => m.name === name);
      const text = [' ', name, name.replace(/-/g, ' '), control.textContent, method && told(method), method?.aliases.join(' '), method?.cite].join(' ').toLowerCase();
      control.hidden = !wanted.every(word => text.includes(word));
      if (!control.hidden) count++;
    }
    say(found, wanted.length ? words.methods.found(count) : '');
    reasons();
  }
  /** While a slider is dragged nothing here changes, and dozens of toggles need not be asked. */
  function changed(now: readonly string[]): boolean {
    const seen = [store.description, store.catalogue, store.trouble.methods, limitReached, now.join(), kinds(store).aimed > 0, now.includes(AUTO) && picked()];
    const same = seen.every((value, k) => value === last[k]);
    last = seen;
    return !same;
  }
  function refresh(): void {
    const now = chosen();
    if (!changed(now)) return;
    build();
    for (const t of toggles) t.refresh(now);
    reasons();
    say(message, limitReached ? words.methods.most(String(most)) : store.trouble.methods);
  }
  // A row that goes on is seen to.
  const cut = (): void => { list.classList.toggle('cut', list.scrollWidth - list.clientWidth - list.scrollLeft > 8); };
  list.addEventListener('scroll', cut, { passive: true });
  new ResizeObserver(cut).observe(list);
  // The key Tab may come to one that is half out of sight.
  list.addEventListener('focusin', ({ target }) => { if (target instanceof HTMLElement) target.scrollIntoView({ block: 'nearest', inline: 'nearest' }); });
  search.addEventListener('input', filter);
  search.addEventListener('keydown', event => { if (event.key === 'Escape' && search.value) { search.value = ''; filter(); event.stopPropagation(); } });
  store.subscribe(what => { if (what !== 'view' && what !== 'busy') refresh(); });
  return { element, repaint: () => { for (const t of toggles) t.repaint(); } };
}
