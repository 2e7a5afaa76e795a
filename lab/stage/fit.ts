/* Fits the picture that the build has drawn to the stage as it is, before it is seen first, so that the module's picture does not move it.
 *
 * A picture of one kind of screen has its motion in a frame that keeps its foot and its left side: each length in it grows evenly with the pixels of a metre,
 * by a slope that first.ts has written beside it. Invariant: without this script the picture is there too, scaled as a whole.
 */
/** Where an element says how long and where it is, and each of the numbers there. */
export const LENGTHS = / (?:d|c?[xy]|r|stroke-width)="[^"]*"/g, LENGTH = /-?\d+(?:\.\d+)?/g;

function fit(svg: SVGSVGElement, stage: Element, words: Element): void {
  const [left = 0, right = 0, top = 0, bottom = 0, across = 1, up = 1, unit = 0, height = 0, column = 0] = (svg.dataset.fit ?? '').split(' ').map(Number);
  const { clientWidth: w, clientHeight: h } = stage, box = stage.getBoundingClientRect();
  const shift = column && Math.round((words.getBoundingClientRect().right - box.left) * w / box.width) - column;
  const more = Math.min((w - left - shift - right) / across, (h - top - bottom) / up) - unit, slopes = (svg.dataset.slopes ?? '').split(' ');
  let k = 0;
  svg.innerHTML = svg.innerHTML.replace(LENGTHS, (lengths) => lengths.replace(LENGTH, (length) => {
    const slope = slopes[k++] ?? '', crisp = slope.startsWith('|'), now = Number(length) + Number(crisp ? slope.slice(1) : slope) * more;
    return slope ? (crisp ? Math.round(now - 0.5) + 0.5 : now).toFixed(1) : length;
  }));
  svg.setAttribute('viewBox', `${-shift} ${height - h} ${w} ${h}`);
}

export function fitFirst(): void {
  const stage = document.getElementById('stage-picture'), words = document.getElementById('words');
  const seen = [...document.querySelectorAll<SVGSVGElement>('.first')].find((svg) => svg.getClientRects().length > 0);
  if (seen && stage && words && stage.clientHeight > 0) fit(seen, stage, words);
}
