/* The foot of an opened step: Play, a line with a tick a step, and the methods, of which those with a column are pressed. */
import { button, el, icon, say } from '../dom';
import type { Look } from '../scene';
import { words } from '../words';
import { sample } from './sample';

const told = words.opened;
/** Ticks that can be told apart. */
const TICKS = 40;

export interface FootOptions { play(): void; go(index: number): void; press(method: string): void }
export interface Foot {
  readonly element: HTMLElement;
  playing(on: boolean): void;
  /** spoken: what the step is called, with its times. */
  at(index: number, total: number, spoken: string): void;
  walks(lines: number): void;
  methods(looks: readonly Look[], shown: readonly string[]): void;
}

export function foot(options: FootOptions): Foot {
  const face = (on: boolean): SVGSVGElement => icon(on ? 'M8.5 6v12M15.5 6v12' : 'M8 5.5l10 6.5-10 6.5z');
  const play = button('', () => options.play(), { class: 'opened-play' }), scrub = el('input', { type: 'range', min: 1, max: 1, step: 1, value: 1, class: 'transport-scrub', 'aria-label': told.line });
  const ticks = el('div', { class: 'transport-ticks', 'aria-hidden': 'true' }), sentence = el('p', { class: 'opened-walks' }), chips = el('div', { class: 'chips', role: 'group', 'aria-label': told.methods });
  scrub.addEventListener('input', () => options.go(Number(scrub.value) - 1));
  let listed = '';
  const self: Foot = {
    element: el('div', { class: 'opened-foot' }, play, el('div', { class: 'transport-line' }, scrub, ticks), sentence, chips),
    playing(on) {
      const name = on ? told.pause : told.play;
      play.classList.toggle('on', on);
      play.replaceChildren(face(on));
      play.setAttribute('aria-label', name);
      play.title = name;
    },
    at(index, total, spoken) {
      scrub.max = String(total);
      scrub.value = String(index + 1);
      scrub.disabled = total < 2;
      scrub.style.setProperty('--part', `${total > 1 ? 100 * index / (total - 1) : 0}%`);
      scrub.setAttribute('aria-valuetext', spoken);
      const count = total > 1 && total <= TICKS ? total : 0;
      if (ticks.childElementCount === count) return;
      ticks.replaceChildren(...Array.from({ length: count }, (_, k) => {
        const tick = el('i');
        tick.style.left = `${100 * k / (count - 1)}%`;
        return tick;
      }));
    },
    walks(lines) { say(sentence, told.walks(lines)); },
    methods(looks, shown) {
      const key = looks.map((look) => look.method).join('\n');
      if (key !== listed) chips.replaceChildren(...looks.map(({ method, label }) => button('', () => options.press(method), { class: 'chip', 'data-opened': method }, el('span', { class: 'picture' }), el('span', { class: 'words' }, label))));
      listed = key;
      looks.forEach((look, k) => {
        const chip = chips.children[k] as HTMLElement;
        chip.style.setProperty('--c', look.colour);
        chip.firstElementChild?.replaceChildren(sample(look));
        chip.setAttribute('aria-pressed', String(shown.includes(look.method)));
      });
    },
  };
  self.playing(false);
  return self;
}
