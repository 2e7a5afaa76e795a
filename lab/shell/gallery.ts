/* The gallery: every scene as a small picture with its title and its question, by theme. A place of its own, which fills the page.
 *
 * Invariant: each card is a link to the address of its scene; a picture is still until the pointer or the focus comes to its card, and then its bodies run
 * along their paths once, at the pace of the motion. Nothing runs for those who asked for less motion.
 */
import unpacked from 'virtual:thumbs';
import { data } from '../data';
import { el, say, svg } from '../dom';
import { saidOf, scenes, themes, type SceneEntry } from '../scenes';
import { encode, presetState } from '../share';
import type { LiveStore } from '../state';
import type { Runner, Thumb } from '../thumbs';
import { words } from '../words';
import { described, presets, titleOf } from './presets';

export interface GalleryOptions {
  /** A scene was chosen, by the name of its model. */
  open(name: string): void;
  /** Escape. */
  close(): void;
}

let once: ReturnType<typeof unpacked> | null = null;
const thumbs = (): ReturnType<typeof unpacked> => (once ??= unpacked());

/** A run takes so many milliseconds, whatever the motion. */
const RUN = 2200;
const shown = scenes.filter(scene => scene.theme !== '');

/** The markup was made by the build, from the page's own pen. */
function picture(thumb: Thumb): SVGSVGElement {
  const image = svg('svg', { viewBox: '0 0 1880 1040', 'aria-hidden': 'true', focusable: 'false' });
  const made = new DOMParser().parseFromString(`<svg xmlns="http://www.w3.org/2000/svg">${thumb.svg}</svg>`, 'image/svg+xml').documentElement;
  image.append(...[...made.childNodes].map(node => document.importNode(node, true)));
  return image;
}

/** Where a body is after the part `p` of its run, from 0 to 1: a part of its path's length. */
function placeAt(pace: readonly number[], p: number): number {
  const at = p * (pace.length - 1), k = Math.min(pace.length - 2, Math.floor(at));
  const before = pace[k] ?? 0, after = pace[k + 1] ?? 1000;
  return (before + (at - k) * (after - before)) / 1000;
}

/** The bodies of a picture; the answer makes them run once. */
function bodies(card: HTMLElement, image: SVGSVGElement, runners: readonly Runner[]): () => void {
  const paths = image.querySelectorAll('path');
  const moving = runners.map(({ path, pace, rest }) => {
    const ball = svg('circle', { class: 'ball', r: runners.length > 3 ? 26 : 42 });
    const put = (x: number, y: number): void => { ball.setAttribute('cx', x.toFixed(1)); ball.setAttribute('cy', y.toFixed(1)); };
    image.append(ball);
    return { ball, pace, line: paths[path], put, settle: (): void => { ball.style.display = rest ? '' : 'none'; if (rest) put(...rest); } };
  });
  for (const one of moving) one.settle();
  let began = 0, running = false;
  const frame = (now: number): void => {
    const p = Math.min(1, (now - began) / RUN);
    for (const { line, pace, put } of moving) {
      const point = line?.getPointAtLength(line.getTotalLength() * placeAt(pace, p));
      if (point) put(point.x, point.y);
    }
    if (p < 1 && card.isConnected) { requestAnimationFrame(frame); return; }
    running = false;
    card.classList.remove('running');
    for (const one of moving) one.settle();
  };
  return () => {
    if (running || !moving.length || matchMedia('(prefers-reduced-motion: reduce)').matches) return;
    running = true;
    card.classList.add('running');
    for (const { ball } of moving) ball.style.display = '';
    began = performance.now();
    requestAnimationFrame(frame);
  };
}

function card(scene: SceneEntry, current: boolean, open: (name: string) => void): HTMLLIElement {
  const link = el('a', { class: 'motion', href: `#${encode(presetState(presets, scene.model), presets)}`, 'aria-current': current && 'true' });
  const frame = el('span', { class: 'thumb' });
  // The frame has its size before the picture is unpacked.
  void thumbs().then((all) => {
    const thumb = all[scene.model];
    if (!thumb) return;
    const image = picture(thumb), run = bodies(link, image, thumb.runners);
    frame.append(image);
    link.addEventListener('pointerenter', run);
    link.addEventListener('focus', run);
  });
  link.append(frame, el('span', { class: 'motion-title' }, titleOf(scene.model)), el('span', { class: 'question' }, saidOf(scene.model)?.question ?? ''));
  link.addEventListener('click', event => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;      // a new tab or window, which reads the address
    event.preventDefault();
    open(scene.model);
  });
  return el('li', {}, link);
}

/** What a search finds a scene by. */
function wordsOf(scene: SceneEntry): string {
  const text = data.presets.find(model => model.name === scene.model)?.text ?? '';
  return [titleOf(scene.model), saidOf(scene.model)?.question, scene.theme && words.gallery.themes[scene.theme], scene.model, described(text), ...scene.methods].join(' ').toLowerCase();
}

export function gallery(store: LiveStore, { open, close }: GalleryOptions): HTMLElement {
  const heading = el('h1', { id: 'gallery-title', tabindex: -1 }, words.gallery.title);
  const search = el('input', {
    type: 'search', class: 'gallery-search', placeholder: words.gallery.search(String(shown.length)), 'aria-label': words.gallery.search(String(shown.length)), autocomplete: 'off', spellcheck: 'false', enterkeyhint: 'search',
  });
  const found = el('p', { class: 'gallery-found', role: 'status' });
  const cards = shown.map(scene => ({ scene, known: wordsOf(scene), item: card(scene, store.state.preset === scene.model, open) }));
  const rows = themes.map((theme, k) => {
    const mine = cards.filter(({ scene }) => scene.theme === theme), id = `gallery-theme-${k}`;
    return { mine, section: el('section', { class: 'gallery-row', 'aria-labelledby': id }, el('h2', { id }, words.gallery.themes[theme]), el('ul', {}, ...mine.map(({ item }) => item))) };
  });

  const find = (): void => {
    const wanted = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const { mine, section } of rows) {
      for (const { known, item } of mine) item.hidden = !wanted.every(word => known.includes(word));
      const left = mine.filter(({ item }) => !item.hidden).length;
      section.hidden = left === 0;
      count += left;
    }
    say(found, wanted.length === 0 ? '' : count === 0 ? words.gallery.none(search.value.trim()) : words.gallery.found(count));
  };
  search.addEventListener('input', find);
  search.addEventListener('keydown', event => {
    const left = cards.filter(({ item }) => !item.hidden);
    if (event.key === 'Enter' && search.value.trim() !== '' && left[0]) { event.preventDefault(); open(left[0].scene.model); }
    if (event.key === 'Escape' && search.value !== '') { event.preventDefault(); event.stopPropagation(); search.value = ''; find(); }
  });

  const element = el('div', { class: 'gallery', role: 'region', 'aria-labelledby': 'gallery-title' },
    el('div', { class: 'gallery-head' }, heading, search), found, ...rows.map(({ section }) => section));
  element.addEventListener('keydown', event => {
    if (event.key === 'Escape' && !event.defaultPrevented) { event.preventDefault(); close(); }
  });
  return element;
}
