/* The tolerance of the methods that choose their own steps: a dial on a scale of powers with a stop at each power of ten (scale.ts). Invariant: it is there where such
 * a method is drawn, and stands in the step's place where no other is.
 */
import { grouped, tenTo } from '../figure/number';
import { TOLERANCE } from '../protocol';
import { adapts, type LiveStore } from '../state';
import { words } from '../words';
import { short } from './number';
import { scaleDial } from './scale';

const FIRST = 3, LAST = 14, NUMBERED = 3, FINE = 10 ** 0.1;

export function toleranceSlider(store: LiveStore): HTMLElement {
  const say = words.dock.tolerance, track = () => store.scene?.solution.tracks.find((t) => t.tolerance !== null), stops = Array.from({ length: LAST - FIRST + 1 }, (_, k) => Number(`1e-${FIRST + k}`));
  const { element } = scaleDial(store, {
    id: 'tolerance', symbol: '', words: words.dock.tolerance, fine: [1 / FINE, FINE],
    own: () => store.description?.settings.tolerance ?? TOLERANCE, typed: () => store.state.tolerance, change: (tolerance) => store.change({ tolerance }),
    now: () => store.numbers.tolerance ?? store.description?.settings.tolerance ?? TOLERANCE,
    wrong: () => store.trouble.tolerance, remark: () => '',
    stops: () => stops, of: () => 'all',
    stop: (value) => { const power = Math.round(Math.log10(value)); return power % NUMBERED === 0 ? tenTo(power) : ''; },
    written: (value, onStop) => short(Number(value.toPrecision(onStop ? 6 : 2))),
    hint: () => '', unit: () => '',
    beside: () => { const found = track(); return found ? `\u2009·\u2009${say.steps(found.total, grouped(found.total), grouped(found.refused))}` : ''; },
    spoken: (value) => { const found = track(); return say.value(short(value, 4), found ? say.steps(found.total, String(found.total), String(found.refused)) : ''); },
  });
  element.hidden = true;
  store.subscribe((what) => { if (what === 'description' || what === 'scene' || what === 'state') element.hidden = adapts(store).adaptive === 0; });
  return element;
}
