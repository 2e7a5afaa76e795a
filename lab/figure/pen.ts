/* The pen that draws on a canvas; svgPen is the other one.
 *
 * Invariant: whatever is passed in, nothing is thrown: what is not finite is not drawn.
 */
import { FAMILY, HALO, RIM, OUTLINES, SIZE, STROKE, finite, head, runs, shift, spansOf } from './shapes';
import type { Pen, Span, Stroke } from './types';

export { svgPen } from './svg';

/** Corners of a piece. */
const PIECE = 32;

/** Of a line in pixels; where the pen is lifted or what is not finite counts nothing. */
function lengthOf(xy: ArrayLike<number>, count: number): number {
  let length = 0;
  for (let i = 2; i + 1 < count; i += 2) {
    const step = Math.abs(xy[i]! - xy[i - 2]!) + Math.abs(xy[i + 1]! - xy[i - 1]!);
    if (step - step === 0) length += step;
  }
  return length;
}

/** widest: of a line, in pixels of the layout. */
export function canvasPen(context: CanvasRenderingContext2D, width: number, height: number, widest = Infinity): Pen {
  const c = context;

  function trace(xy: ArrayLike<number>, count: number): void {
    let down = false;
    c.beginPath();
    for (let i = 0; i + 1 < count; i += 2) {
      const x = xy[i]!, y = xy[i + 1]!;
      // Not finite: the pen is lifted. x - x is 0 for finite numbers only.
      if (x - x + (y - y) !== 0) { down = false; continue; }
      if (down) c.lineTo(x, y); else c.moveTo(x, y);
      down = true;
    }
  }
  /** Strokes piece by piece: a browser without a graphics card takes for a long line that crosses itself twice the time of its pieces. A piece begins a pixel
   * before the end of the last one, and its dashes go on where those ended. */
  function draw(xy: ArrayLike<number>, count: number, dash: readonly number[]): void {
    let corners = 0, length = 0, lastX = 0, lastY = 0;
    const end = (): void => { if (corners > 1) c.stroke(); corners = 0; };
    const begin = (x: number, y: number, at: number): void => {
      if (dash.length) c.lineDashOffset = at;
      c.beginPath();
      c.moveTo(x, y);
      corners = 1;
    };
    for (let i = 0; i + 1 < count; i += 2) {
      const x = xy[i]!, y = xy[i + 1]!;
      if (x - x + (y - y) !== 0) { end(); continue; }
      if (corners) {
        const step = Math.hypot(x - lastX, y - lastY), back = step > 1 ? 1 / step : 1;
        c.lineTo(x, y);
        length += step;
        if (++corners > PIECE) { end(); begin(x - back * (x - lastX), y - back * (y - lastY), length - back * step); c.lineTo(x, y); corners++; }
      } else begin(x, y, length = 0);
      lastX = x, lastY = y;
    }
    end();
    c.lineDashOffset = 0;
  }
  function line(xy: ArrayLike<number>, stroke: Stroke, count: number): void {
    // A line that fills the picture many times over is a band: its dashes are not seen as dashes, and cost most of the time of drawing.
    const dash = stroke.dash && lengthOf(xy, count) < 5 * (width + height) ? stroke.dash as number[] : [];
    c.strokeStyle = stroke.colour;
    c.lineWidth = Math.min(widest, stroke.width);
    c.setLineDash(dash);
    c.lineJoin = stroke.width > 2.5 ? 'round' : 'bevel';
    c.globalAlpha = stroke.alpha ?? 1;
    // Where pieces overlap one would see through the line twice.
    if (c.globalAlpha < 1) { trace(xy, count); c.stroke(); } else draw(xy, count, dash);
  }
  const plain = (): void => { c.globalAlpha = 1; };

  const pen: Pen = {
    width, height,
    line(xy, stroke, count = xy.length) {
      line(xy, stroke, count);
      plain();
    },
    area(xy, fill, alpha = 1, count = xy.length) {
      trace(xy, count);
      c.fillStyle = fill;
      c.globalAlpha = alpha;
      c.fill();
      plain();
    },
    mark(shape, x, y, radius, colour, how = {}) {
      if (!finite(x, y)) return;
      const outline = OUTLINES[shape];
      c.globalAlpha = how.alpha ?? 1;
      c.beginPath();
      if (outline === 'disc' || outline === 'ring') {
        c.arc(x, y, radius, 0, 2 * Math.PI);
      } else {
        for (const part of outline.parts) {
          for (let i = 0; i + 1 < part.length; i += 2) {
            const px = x + radius * part[i]!, py = y + radius * part[i + 1]!;
            if (i) c.lineTo(px, py); else c.moveTo(px, py);
          }
          if (outline.closed) c.closePath();
        }
      }
      c.setLineDash([]);
      const stroked = outline === 'ring' || (outline !== 'disc' && !outline.closed);
      if (how.rim) {
        c.strokeStyle = how.rim;
        c.lineWidth = 2 * RIM + (stroked ? Math.max(1.25, STROKE * radius) : 0);
        c.lineJoin = 'round';
        c.stroke();
      }
      if (stroked) {
        c.strokeStyle = colour;
        c.lineWidth = Math.max(1.25, STROKE * radius);
        c.stroke();
      } else {
        c.fillStyle = colour;
        c.fill();
      }
      plain();
    },
    arrow(x0, y0, x1, y1, stroke) {
      const h = finite(x0, y0, x1, y1) ? head(x0, y0, x1, y1, stroke.width) : null;
      if (!h) return;
      pen.line([x0, y0, h.shaft[0], h.shaft[1]], stroke);
      pen.area(h.tip, stroke.colour, stroke.alpha ?? 1);
    },
    text(x, y, text, lettering) {
      if (!finite(x, y)) return;
      const spans = spansOf(text), fontOf = (span: Span): string => {
        const { bold = lettering.bold, italic = lettering.italic, size = lettering.size ?? SIZE } = span;
        return `${italic ? 'italic ' : ''}${bold ? '600 ' : ''}${size}px ${FAMILY}`;
      };
      const widths = spans.length === 1 && (lettering.anchor ?? 'start') === 'start' ? [0] : spans.map((span) => { c.font = fontOf(span); return c.measureText(span.text).width; });
      const whole = widths.reduce((a, b) => a + b, 0);
      c.save();
      c.translate(x, y);
      if (lettering.turn) c.rotate(lettering.turn * Math.PI / 180);
      c.textAlign = 'left';
      // Not canvas's own "top" and "bottom", which differ between browsers: shifts from the baseline, as the SVG has them.
      c.textBaseline = 'alphabetic';
      const write = (put: (span: Span, at: number, down: number) => void): void => {
        let at = lettering.anchor === 'middle' ? -whole / 2 : lettering.anchor === 'end' ? -whole : 0;
        spans.forEach((span, k) => { c.font = fontOf(span); put(span, at, shift(lettering) + (span.sunk ?? 0)); at += widths[k]!; });
      };
      if (lettering.halo) {
        c.strokeStyle = lettering.halo;
        c.lineWidth = HALO;
        c.lineJoin = 'round';
        c.setLineDash([]);
        write((span, at, down) => c.strokeText(span.text, at, down));
      }
      write((span, at, down) => { c.fillStyle = span.colour ?? lettering.colour; c.fillText(span.text, at, down); });
      c.restore();
    },
    box(x, y, w, h, fill, alpha = 1) {
      if (!finite(x, y, w, h)) return;
      c.globalAlpha = alpha;
      c.fillStyle = fill;
      c.fillRect(x, y, w, h);
      plain();
    },
    cells(x, y, w, h, columns, rows, cells, colours) {
      if (!finite(x, y, w, h) || columns < 1 || rows < 1) return;
      const small = document.createElement('canvas');
      small.width = columns;
      small.height = rows;
      const s = small.getContext('2d');
      if (!s) return;
      runs(columns, rows, cells, (i, j, n, value) => {
        const colour = colours[value];
        if (!colour) return;
        s.fillStyle = colour;
        s.fillRect(i, j, n, 1);
      });
      c.imageSmoothingEnabled = false;
      c.drawImage(small, x, y, w, h);
    },
    clip(x, y, w, h, inside) {
      c.save();
      c.beginPath();
      c.rect(x, y, w, h);
      c.clip();
      try { inside(); } finally { c.restore(); }
    },
  };
  return pen;
}
