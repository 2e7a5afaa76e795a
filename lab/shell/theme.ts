/* Light, dark, or as the system has it. Invariant: data-theme of the root says which was chosen; without it the system's choice holds. */
import type { Theme } from '../scene';
import { button, el, icon, svg } from '../dom';
import { words } from '../words';
import { forget, recall, remember } from './memory';

const next: Readonly<Record<Theme, Theme>> = { auto: 'light', light: 'dark', dark: 'auto' };

function picture(theme: Theme): SVGSVGElement {
  if (theme === 'dark') return icon('M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5z');
  const image = icon(theme === 'light' ? 'M12 2.5v2M12 19.5v2M2.5 12h2M19.5 12h2M5.3 5.3l1.4 1.4M17.3 17.3l1.4 1.4M5.3 18.7l1.4-1.4M17.3 6.7l1.4-1.4' : 'M12 3.5a8.5 8.5 0 0 1 0 17z');
  image.append(svg('circle', { cx: 12, cy: 12, r: theme === 'light' ? 4 : 8.5 }));
  if (theme === 'auto') image.classList.add('filled-half');
  return image;
}

/** changed: colours are different now. */
export function themeButton(changed: () => void): HTMLButtonElement {
  const kept = recall('theme');
  let theme: Theme = kept === 'light' || kept === 'dark' ? kept : 'auto';
  const toggle = button('', () => { theme = next[theme]; apply(); changed(); }, { class: 'icon-button' });
  function apply(): void {
    if (theme === 'auto') { delete document.documentElement.dataset.theme; forget('theme'); } else { document.documentElement.dataset.theme = theme; remember('theme', theme); }
    toggle.replaceChildren(picture(theme), el('span', { class: 'menu-word' }, words.top.theme[theme].now));
    toggle.setAttribute('aria-label', words.top.theme[theme].change);
    toggle.title = words.top.theme[theme].now;
  }
  apply();
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { if (theme === 'auto') changed(); });
  return toggle;
}
