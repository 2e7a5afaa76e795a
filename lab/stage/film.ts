/* One run of the motion as a WebM film, recorded in the page. Invariant: frames follow the clock, not their number; what was cancelled leaves nothing. */
import { words } from '../words';

const RATE = 30, BITS = 6e6;

/** The first of its kinds that this browser records; '': none. */
function kind(): string {
  if (typeof MediaRecorder === 'undefined' || !('captureStream' in HTMLCanvasElement.prototype)) return '';
  return ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'].find((type) => MediaRecorder.isTypeSupported(type)) ?? '';
}
export const films = (): boolean => kind() !== '';

/** draw: the frame at this part of the run, 0 … 1. null: cancelled. */
export function film(canvas: HTMLCanvasElement, seconds: number, draw: (part: number) => void, signal: AbortSignal): Promise<Blob | null> {
  return new Promise((done, fail) => {
    draw(0);
    const recorder = new MediaRecorder(canvas.captureStream(RATE), { mimeType: kind(), videoBitsPerSecond: BITS }), chunks: Blob[] = [], began = performance.now();
    const timer = setInterval(() => {
      const part = Math.min(1, (performance.now() - began) / 1000 / seconds);
      draw(part);
      if (part === 1) finish();
    }, 1000 / RATE);
    function finish(): void {
      clearInterval(timer);
      // The last picture is to be in it.
      setTimeout(() => { if (recorder.state !== 'inactive') recorder.stop(); }, signal.aborted ? 0 : 100);
    }
    signal.addEventListener('abort', finish);
    recorder.ondataavailable = ({ data }) => { chunks.push(data); };
    recorder.onstop = () => { recorder.stream.getTracks().forEach((track) => track.stop()); done(signal.aborted ? null : new Blob(chunks, { type: 'video/webm' })); };
    recorder.onerror = () => { clearInterval(timer); fail(new Error(words.stage.noFilm)); };
    recorder.start();
  });
}
