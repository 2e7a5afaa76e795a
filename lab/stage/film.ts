/* One run of the motion as a WebM film, recorded in the page. Invariant: frames follow the clock, not their number; what was cancelled leaves nothing. */
import { words } from '../words';

/** Frames a second, bits a second; milliseconds after which what is recorded is handed over; the least bytes of a frame; the part of a run that a film has to have. */
const RATE = 30, BITS = 6e6, SLICE = 200, FRAME = 200, WHOLE = 0.7;
/** Milliseconds in which a picture that has been shown reaches the encoder, and after which it is given once more to one that has not begun. */
const FIRST = 100, AGAIN = 15000;

/** The first of its kinds that this browser records; '': none. */
function kind(): string {
  if (typeof MediaRecorder === 'undefined' || !('captureStream' in HTMLCanvasElement.prototype)) return '';
  return ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'].find((type) => MediaRecorder.isTypeSupported(type)) ?? '';
}
export const films = (): boolean => kind() !== '';

/** draw: the frame at this part of the run, 0 … 1. null: cancelled. A film whose frames stopped coming before its end is refused. */
export function film(canvas: HTMLCanvasElement, seconds: number, draw: (part: number) => void, signal: AbortSignal): Promise<Blob | null> {
  return new Promise((done, fail) => {
    draw(0);
    const recorder = new MediaRecorder(canvas.captureStream(RATE), { mimeType: kind(), videoBitsPerSecond: BITS }), chunks: Blob[] = [];
    // began: when the recorder runs; before that it takes no frame. part: of the run, now; filled: when the last frames came.
    let timer = 0, waits = 0, began = 0, part = 0, filled = 0;
    /** The encoder takes seconds to begin on a slow machine. They would be a still picture at the beginning of the film, so they are a pause of it. */
    function wait(): void {
      if (began || recorder.state !== 'recording') return;
      recorder.pause();
      waits = window.setTimeout(() => { if (recorder.state === 'paused') { recorder.resume(); draw(0); } }, AGAIN);
    }
    function finish(): void {
      clearInterval(timer);
      clearTimeout(waits);
      // The last picture is to be in it.
      setTimeout(() => { if (recorder.state !== 'inactive') recorder.stop(); }, signal.aborted ? 0 : 100);
    }
    signal.addEventListener('abort', finish);
    recorder.onstart = () => {
      clearTimeout(waits);
      if (recorder.state === 'paused') recorder.resume();
      began = performance.now();
      timer = window.setInterval(() => {
        part = Math.min(1, (performance.now() - began) / 1000 / seconds);
        draw(part);
        if (part === 1) finish();
      }, 1000 / RATE);
      if (signal.aborted) finish();
    };
    recorder.ondataavailable = ({ data }) => {
      // A header alone, or the end of one, is no frame.
      if (data.size > FRAME) filled = part;
      chunks.push(data);
    };
    recorder.onstop = () => {
      recorder.stream.getTracks().forEach((track) => track.stop());
      if (signal.aborted) done(null);
      else if (filled < WHOLE) fail(new Error(words.stage.noFilm));
      else done(new Blob(chunks, { type: 'video/webm' }));
    };
    recorder.onerror = () => { clearInterval(timer); clearTimeout(waits); fail(new Error(words.stage.noFilm)); };
    recorder.start(SLICE);
    requestAnimationFrame(() => { waits = window.setTimeout(wait, FIRST); });
  });
}
