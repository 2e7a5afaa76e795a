/* The controls of the page, put where index.html keeps room for them. Invariant: controls talk to the store, and to nothing else. */
import type { LiveStore } from '../state';
import { sceneOf } from '../scenes';
import { presetState, viewFor } from '../share';
import type { Stage } from '../stage/stage';
import { words } from '../words';
import { followAddress } from './address';
import { place } from '../dom';
import { dials } from './dials';
import { dockLinks } from './dock';
import { embedded } from './embed';
import { gallery as makeGallery } from './gallery';
import { history } from './history';
import { lecture } from './lecture';
import { lessonPlace } from './lesson';
import { methods } from './methods';
import { nav } from './nav';
import { note } from './note';
import { pin } from './pin';
import { presets } from './presets';
import { shareMenu } from './share-menu';
import { accuracySlider, accuracySwitch, goalNote, toleranceSlider } from './tolerance';
import { status } from './status';
import { stepSlider } from './step';
import { themeButton } from './theme';
import { createToasts, type Toasts } from './toasts';
import { headline } from './headline';

/** themeChanged: colours differ now; the scene's looks are new already. */
export function mountShell(store: LiveStore, stage: Stage, clock: { replay(): void }, themeChanged: () => void): Toasts {
  const toasts = createToasts(place('toasts')), chosen = methods(store);
  const said = headline(store, toasts, () => stage.sees(), () => stage.relayout());
  const lesson = lessonPlace(store, stage, clock);
  const galleryPlace = place('gallery');
  let gallery: HTMLElement | null = null;
  /** In a place that covers the stage. */
  const there = (): boolean => store.state.place === 'gallery' || store.state.place === 'step';
  const go = (where: string): void => { if (store.state.place !== where) store.go(where); };
  const places = nav([{ label: words.top.places.gallery, id: 'gallery', open: () => go(store.state.place === 'gallery' ? '' : 'gallery') }, { label: words.top.places.lessons, id: 'lessons', open: () => lesson.list.togglePopover() }, { label: words.top.places.equation, id: 'equation', open: () => { const away = there(); if (away) go(''); said.openEditor(away || !said.editing()); } }]);
  function arrive(): void {
    const inGallery = store.state.place === 'gallery';
    places.current(inGallery ? 'gallery' : lesson.here() ? 'lessons' : '');
    if (document.body.classList.contains('in-gallery') === inGallery) return;
    document.body.classList.toggle('in-gallery', inGallery);
    galleryPlace.hidden = !inGallery;
    if (inGallery) {
      gallery = makeGallery(store, { open: (name) => { store.load({ ...presetState(presets, name), set: sceneOf(name)?.set ?? {}, view: viewFor(presets, name, store.state.view) }); }, close: () => go('') });
      galleryPlace.replaceChildren(gallery);
      scrollTo(0, 0);
      gallery.querySelector<HTMLElement>('input')?.focus({ preventScroll: true });
    } else {
      galleryPlace.replaceChildren();
      stage.relayout();
      // What had the focus is gone.
      if (document.activeElement === document.body) place('transport').querySelector('button')?.focus({ preventScroll: true });
    }
  }
  store.subscribe((what) => { if (what === 'state' || what === 'view') arrive(); });
  place('undo').append(history(store));
  place('share').append(shareMenu(store, presets, stage, toasts));
  place('theme').append(themeButton(() => { store.recolour(); chosen.repaint(); themeChanged(); }));
  place('words').replaceChildren(said.element, lesson.element, lesson.list);
  place('words').addEventListener('lesson', (event) => lesson.open((event as CustomEvent<string>).detail));
  place('methods').append(chosen.element);
  place('scene-note').append(note(store), goalNote(store));
  place('dials').append(stepSlider(store), toleranceSlider(store), accuracySlider(store), accuracySwitch(store), dials(store));
  place('dock-links').append(dockLinks(store, toasts, pin(store, stage, toasts), stage.choice));
  place('status').append(status(store));
  if (!store.state.embed) {
    const { opener, bar } = lecture(store);
    place('share').after(opener);
    document.body.append(bar);
  } else place('dock').append(embedded(store, presets));
  followAddress(store, presets, toasts);
  arrive();
  return toasts;
}
