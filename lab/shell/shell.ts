/* The controls of the page, put where index.html keeps room for them. Invariant: controls talk to the store, and to nothing else. */
import type { LiveStore } from '../state';
import { followAddress } from './address';
import { place } from '../dom';
import { editor } from './editor';
import { methods } from './methods';
import { panelPicker, type PanelName } from './panels';
import { presetPicker, presets } from './presets';
import { settings } from './settings';
import { shareMenu } from './share-menu';
import { sliders } from './sliders';
import { status } from './status';
import { themeButton } from './theme';
import { createToasts, type Toasts } from './toasts';
import { typesetView } from './typeset';

/** panels: those that can be opened, in their order. themeChanged: colours differ now; the scene's looks are new already. */
export function mountShell(store: LiveStore, panels: readonly PanelName[], themeChanged: () => void): Toasts {
  const toasts = createToasts(place('toasts'));
  const { picker, card, note } = presetPicker(store, toasts);
  const chosen = methods(store);
  place('presets').append(picker);
  place('share').append(shareMenu(store, presets, toasts));
  place('theme').append(themeButton(() => { store.recolour(); chosen.repaint(); themeChanged(); }));
  place('scene-card').append(card);
  place('scene-note').append(note);
  place('model').append(editor(store), typesetView(store));
  place('methods').append(chosen.element);
  place('main-choice').append(chosen.main);
  place('settings').append(settings(store));
  place('parameters').append(sliders(store));
  place('status').append(status(store));
  place('panel-picker').append(panelPicker(store, panels));
  followAddress(store, presets, toasts);
  return toasts;
}
