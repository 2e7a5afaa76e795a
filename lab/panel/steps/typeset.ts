/* A calculation as MathML, in pieces that a narrow line may part: before an equals sign, and before what is added. */
import { el } from '../../dom';
import { nameSpans } from '../../figure/name';
import type { Sum, Token } from './recipe';

const SPACE = 'http://www.w3.org/1998/Math/MathML';
function m(tag: string, ...children: (Node | string)[]): Element {
  const element = document.createElementNS(SPACE, tag);
  element.append(...children);
  return element;
}
/** One sign; what stands first in a piece is between two things all the same. */
function sign(text: string): Element {
  const mo = m('mo', text);
  if (text === '(' || text === ')') mo.setAttribute('stretchy', 'false'); else mo.setAttribute('form', 'infix');
  if (text === '/') for (const side of ['lspace', 'rspace']) mo.setAttribute(side, '0');
  return mo;
}
/** r'.x as r with primes and the index x. */
function name(of: string, index?: number): Element {
  const spans = nameSpans(of, 1), letter = spans[0]?.text ?? of, low = spans.filter((s) => s.sunk).map((s) => s.text).join(''), marks = spans.slice(1).filter((s) => !s.sunk).map((s) => s.text).join('');
  const base = marks ? m('mrow', m('mi', letter), m('mo', marks)) : m('mi', letter), under = [low, index === undefined ? '' : String(index)].filter(Boolean).join(', ');
  return under ? m('msub', base, /^\d+$/.test(under) ? m('mn', under) : m('mi', under)) : base;
}
function written(token: Token): Element[] {
  if (token.kind === 'sign') return [sign(token.sign)];
  if (token.kind === 'name') {
    if (token.name === ',') return [m('mo', ',')];
    const base = name(token.name, token.index);
    return [token.power ? m('msup', base, m('mn', String(token.power))) : base];
  }
  const figures = token.figures.flatMap((figure, k) => [...(k ? [m('mo', ',')] : []), m('mn', figure.text)]), bracket = token.bracket || token.figures.length > 1;
  if (token.result) for (const figure of figures) if (figure.localName === 'mn') figure.setAttribute('class', 'result');
  return bracket ? [sign('('), ...figures, sign(')')] : figures;
}

export function typeset(sum: Sum): HTMLElement {
  const pieces: Element[][] = [[]];
  for (const token of sum) {
    if (token.kind === 'sign' && token.outer) pieces.push([]);
    pieces[pieces.length - 1]!.push(...written(token));
  }
  return el('span', { class: 'sum' }, ...pieces.flatMap((piece, k) => [...(k ? [el('wbr')] : []), m('math', m('mrow', ...piece))]));
}
