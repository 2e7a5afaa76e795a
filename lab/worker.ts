/* A worker: gets the compiled module once, then answers questions one after the other. */
import { Answers, reply } from './answers';
import { Core } from './core';
import type { Question } from './protocol';

declare const self: DedicatedWorkerGlobalScope;
let module: WebAssembly.Module | null = null, answers: Answers | null = null;

/** The arrays of an answer go over without being copied. */
function buffers(value: unknown, found: Set<ArrayBuffer>): Set<ArrayBuffer> {
  if (value instanceof Float64Array) found.add(value.buffer as ArrayBuffer);
  else if (Array.isArray(value)) for (const item of value) { if (typeof item === 'object') buffers(item, found); }
  else if (typeof value === 'object' && value !== null) for (const item of Object.values(value)) buffers(item, found);
  return found;
}

self.onmessage = ({ data }: MessageEvent<WebAssembly.Module | Question>): void => {
  if (data instanceof WebAssembly.Module) {
    module = data;
    answers = new Answers(new Core(module));
    return;
  }
  if (!module) return;
  answers ??= new Answers(new Core(module));
  const message = reply(answers, data.id, data.kind, data.ask);
  // A core that trapped, or that filled its memory, is not asked again.
  if ('problem' in message && message.problem.kind === 'memory') answers = null;
  self.postMessage(message, [...buffers(message, new Set())]);
};
