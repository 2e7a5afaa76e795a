/* Turning a picture of space: by dragging, and by the arrow keys when it has the focus.
 *
 * Invariant: the wheel is never taken, and a finger that moves up or down scrolls the page (touch-action: pan-y); sideways it turns the picture.
 * While not enabled, the canvas behaves as any picture.
 */
import { words } from '../words';

export interface Turnable { enable(on: boolean): void }

const PER_PIXEL = 0.008, PER_KEY = Math.PI / 24;

/** turn and rise in radians; null: back to where it began. */
export function turnable(canvas: HTMLCanvasElement, move: (turn: number | null, rise: number) => void): Turnable {
  let on = false, pointer = -1, x = 0, y = 0;
  canvas.addEventListener('pointerdown', event => {
    if (!on || !event.isPrimary || event.button !== 0) return;
    pointer = event.pointerId; x = event.clientX; y = event.clientY;
    canvas.setPointerCapture(pointer);
  });
  canvas.addEventListener('pointermove', event => {
    if (event.pointerId !== pointer) return;
    move((event.clientX - x) * PER_PIXEL, (event.clientY - y) * PER_PIXEL);
    x = event.clientX; y = event.clientY;
  });
  const release = (event: PointerEvent): void => { if (event.pointerId === pointer) pointer = -1; };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('dblclick', () => { if (on) move(null, 0); });
  canvas.addEventListener('keydown', event => {
    if (!on || event.altKey || event.ctrlKey || event.metaKey) return;
    const step = event.shiftKey ? PER_KEY * 3 : PER_KEY;
    switch (event.key) {
      case 'ArrowLeft': move(-step, 0); break;
      case 'ArrowRight': move(step, 0); break;
      case 'ArrowUp': move(0, step); break;
      case 'ArrowDown': move(0, -step); break;
      case 'Home': move(null, 0); break;
      default: return;
    }
    event.preventDefault();
  });
  return {
    enable(wanted) {
      if (wanted === on) return;
      on = wanted;
      pointer = -1;
      canvas.style.touchAction = on ? 'pan-y' : '';
      canvas.style.cursor = on ? 'grab' : '';
      if (on) {
        canvas.tabIndex = 0;
        canvas.setAttribute('aria-roledescription', words.stage.turn);
      } else {
        canvas.removeAttribute('tabindex');
        canvas.removeAttribute('aria-roledescription');
      }
    },
  };
}
