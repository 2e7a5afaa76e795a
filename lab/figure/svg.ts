/* The pen that writes SVG.
 *
 * Invariant: whatever is passed in, the SVG is well formed and stands by itself: texts and colours are escaped, numbers that are not finite are
 * never written, nothing is fetched.
 */
import { FAMILY, HALO, OUTLINES, RIM, SIZE, STROKE, finite, head, runs, shift } from './shapes';
import type { Pen, Stroke } from './types';

/** Text that is safe in XML: markup escaped, what XML forbids (most control characters, halves of pairs) replaced. */
export function escape(text: string): string {
  // eslint-disable-next-line no-control-regex
  return text.replace(/[\u0000-\u0008\u000B\u000C\u000E-\u001F\uFFFE\uFFFF\p{Cs}]/gu, '\uFFFD').replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
}

/** A number to so many decimals. */
function rounded(value: number, decimals: number): string {
  const unit = 10 ** decimals, r = Math.round(unit * value) / unit;
  return Number.isFinite(r) ? String(r === 0 ? 0 : r) : '0';
}

function opacity(alpha: number | undefined): string {
  return alpha === undefined || alpha === 1 ? '' : ` opacity="${rounded(alpha, 2)}"`;
}

export interface SvgPen extends Pen {
  /** The whole file; title and description are for those who do not see it. */
  svg(title?: string, description?: string, background?: string): string;
}

/** decimals: of a pixel, to which lengths are written. */
export function svgPen(width: number, height: number, decimals = 2): SvgPen {
  const n = (value: number): string => rounded(value, decimals);
  const out: string[] = [];
  let clips = 0;

  function path(xy: ArrayLike<number>, count: number): string {
    let d = '', down = false;
    for (let i = 0; i + 1 < count; i += 2) {
      const x = xy[i]!, y = xy[i + 1]!;
      if (!finite(x, y)) { down = false; continue; }
      d += `${down ? 'L' : 'M'}${n(x)} ${n(y)}`;
      down = true;
    }
    return d;
  }
  function stroked(d: string, stroke: Stroke): void {
    if (!d) return;
    const dash = stroke.dash && stroke.dash.length ? ` stroke-dasharray="${stroke.dash.map(n).join(' ')}"` : '';
    out.push(`<path d="${d}" stroke="${escape(stroke.colour)}" stroke-width="${n(stroke.width)}"${dash}${opacity(stroke.alpha)}/>`);
  }
  function filled(d: string, fill: string, alpha?: number, crisp = false): void {
    if (d) out.push(`<path d="${d}" fill="${escape(fill)}"${crisp ? ' shape-rendering="crispEdges"' : ''}${opacity(alpha)}/>`);
  }

  const pen: SvgPen = {
    width, height,
    line(xy, stroke, count = xy.length) {
      stroked(path(xy, count), stroke);
    },
    area(xy, fill, alpha, count = xy.length) {
      const d = path(xy, count);
      filled(d && `${d}Z`, fill, alpha);
    },
    mark(shape, x, y, radius, colour, { alpha, rim } = {}) {
      if (!finite(x, y, radius)) return;
      const outline = OUTLINES[shape], width = Math.max(1.25, STROKE * radius), solid = outline === 'disc' || (outline !== 'ring' && outline.closed);
      // Of a filled shape the rim is the edge, of strokes a wider stroke below.
      const paint = solid ? ` fill="${escape(colour)}"${rim ? ` stroke="${escape(rim)}" stroke-width="${2 * RIM}" paint-order="stroke"` : ''}` : ` stroke="${escape(colour)}" stroke-width="${n(width)}"`;
      const below = !solid && rim ? ` stroke="${escape(rim)}" stroke-width="${n(width + 2 * RIM)}"` : '', shown = opacity(alpha);
      const shape_ = outline === 'disc' || outline === 'ring' ? `<circle cx="${n(x)}" cy="${n(y)}" r="${n(radius)}"`
        : `<path d="${outline.parts.map((part) => path(part.map((u, i) => (i % 2 ? y : x) + radius * u), part.length) + (outline.closed ? 'Z' : '')).join('')}"`;
      if (below) out.push(`${shape_}${below}${shown}/>`);
      out.push(`${shape_}${paint}${shown}/>`);
    },
    arrow(x0, y0, x1, y1, stroke) {
      const h = finite(x0, y0, x1, y1) ? head(x0, y0, x1, y1, stroke.width) : null;
      if (!h) return;
      pen.line([x0, y0, h.shaft[0], h.shaft[1]], stroke);
      pen.area(h.tip, stroke.colour, stroke.alpha);
    },
    text(x, y, text, lettering) {
      if (!finite(x, y)) return;
      const manner = (bold?: boolean, italic?: boolean, of?: number): string => `${bold ? ' font-weight="600"' : ''}${italic ? ' font-style="italic"' : ''}${of !== undefined && of !== SIZE ? ` font-size="${n(of)}"` : ''}`;
      const anchor = lettering.anchor && lettering.anchor !== 'start' ? ` text-anchor="${lettering.anchor}"` : '';
      const halo = lettering.halo ? ` paint-order="stroke" stroke="${escape(lettering.halo)}" stroke-width="${HALO}"` : '';
      const dy = shift(lettering);
      // The shift is along the turned letters, as on the canvas.
      const place = lettering.turn ? `transform="translate(${n(x)} ${n(y)}) rotate(${n(lettering.turn)})" y="${n(dy)}"` : `x="${n(x)}" y="${n(y + dy)}"`;
      let sunk = 0;
      const inside = typeof text === 'string' ? escape(text) : text.map((span) => {
        const down = (span.sunk ?? 0) - sunk;
        sunk = span.sunk ?? 0;
        const own = `${span.colour ? ` fill="${escape(span.colour)}"` : ''}${manner(span.bold, span.italic, span.size)}${down ? ` dy="${n(down)}"` : ''}`;
        return own ? `<tspan${own}>${escape(span.text)}</tspan>` : escape(span.text);
      }).join('');
      out.push(`<text ${place} fill="${escape(lettering.colour)}"${anchor}${manner(lettering.bold, lettering.italic, lettering.size)}${halo}${typeof text === 'string' ? '' : ' xml:space="preserve"'}>${inside}</text>`);
    },
    box(x, y, w, h, fill, alpha) {
      if (finite(x, y, w, h) && w > 0 && h > 0) out.push(`<rect x="${n(x)}" y="${n(y)}" width="${n(w)}" height="${n(h)}" fill="${escape(fill)}"${opacity(alpha)}/>`);
    },
    cells(x, y, w, h, columns, rows, cells, colours) {
      if (!finite(x, y, w, h) || columns < 1 || rows < 1) return;
      const dx = w / columns, dy = h / rows;
      const paths = new Map<string, string[]>();
      runs(columns, rows, cells, (i, j, many, value) => {
        const colour = colours[value];
        if (!colour) return;
        let list = paths.get(colour);
        if (!list) paths.set(colour, list = []);
        list.push(`M${n(x + i * dx)} ${n(y + j * dy)}H${n(x + (i + many) * dx)}V${n(y + (j + 1) * dy)}H${n(x + i * dx)}Z`);
      });
      for (const [colour, list] of paths) filled(list.join(''), colour, undefined, true);
    },
    clip(x, y, w, h, inside) {
      const id = `c${++clips}`;
      out.push(`<clipPath id="${id}"><rect x="${n(x)}" y="${n(y)}" width="${n(Math.max(0, w))}" height="${n(Math.max(0, h))}"/></clipPath><g clip-path="url(#${id})">`);
      try { inside(); } finally { out.push('</g>'); }
    },
    svg(title, description, background) {
      const named = (title ? `<title>${escape(title)}</title>` : '') + (description ? `<desc>${escape(description)}</desc>` : '');
      const ground = background ? `<rect width="${n(width)}" height="${n(height)}" fill="${escape(background)}"/>` : '';
      return `<svg xmlns="http://www.w3.org/2000/svg" width="${n(width)}" height="${n(height)}" viewBox="0 0 ${n(width)} ${n(height)}" `
        + `role="img" fill="none" stroke-linejoin="round" font-family="${escape(FAMILY)}" font-size="${SIZE}">${named}${ground}${out.join('\n')}</svg>\n`;
    },
  };
  return pen;
}
