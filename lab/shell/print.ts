/* On paper: the numbers behind the picture, as a small table after it. Invariant: it is for print alone (later.css); what it says is the scene's. */
import { el, place, say } from '../dom';
import { brief } from '../figure/number';
import type { Scene } from '../scene';
import { exampleOf, stagingOf } from '../data';
import { errorsOf } from '../stage/motion';
import { words } from '../words';

export function printed(): { show(scene: Scene): void } {
  const head = el('tr'), body = el('tbody'), caption = el('caption');
  const element = el('table', { class: 'printed' }, caption, el('thead', {}, head), body);
  place('page').append(element);
  return {
    show({ solution: { tracks, errors }, looks, description, state }) {
      const { units } = stagingOf(exampleOf(state)), last = errors.map((e) => errorsOf(e).at(-1) ?? NaN), end = tracks[0]?.times.at(-1) ?? 0;
      const time = `${brief(end)}${units ? `\u2009${units.t}` : ''}`;
      element.hidden = !last.some(Number.isFinite);
      say(caption, description.has_exact ? words.top.print.exact(time) : words.top.print.reference(time));
      head.replaceChildren(...[words.top.print.method, words.top.print.step(units?.t ?? ''), words.top.print.steps, words.top.print.distance(units?.x ?? '')].map((text) => el('th', { scope: 'col' }, text)));
      body.replaceChildren(...tracks.map(({ method, step, tolerance, total, problem }, k) => el('tr', {}, el('th', { scope: 'row' }, looks[k]?.label ?? method),
        ...[tolerance === null ? brief(Math.abs(step)) : words.top.print.tolerance(brief(tolerance)), total.toLocaleString('en').replace(/,/g, '\u2009'), problem ? words.top.print.before : brief(last[errors.findIndex((e) => e.method === method)] ?? NaN, 6)].map((text) => el('td', {}, text)))));
    },
  };
}
