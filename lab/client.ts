/* Questions to the core, from the page: two workers, one for what must be quick and one for studies, so that a long study never holds up a drag.
 *
 * Invariant: each question is settled once: by an answer, by a problem, or by an AbortError. A worker that is busy with what nobody wants any more is
 * ended and replaced: the module imports nothing, so there is no other way to stop it.
 */
import { problem, type Ask, type Question, type Reply, type Requests } from './protocol';
import { Refused, type Client } from './scene';
import { computed } from './words';
import { coreModule, createWorker } from 'virtual:host';

/** Nobody waits for this answer any more. */
const cancelled = (): DOMException => new DOMException('cancelled', 'AbortError');

type Lane = 'quick' | 'study';
interface Task { readonly question: Question; readonly key: string; resolve(answer: unknown): void; reject(why: Error): void }

/** A quick answer that is late by so much is given up when a newer question of its kind waits. */
const LATE = 250;
/** Longer than this no quick answer may take: a model of somebody else's must not hang the page. */
const QUICK_LIMIT = 20_000;

const tooLong = problem('limit', computed.slow(String(QUICK_LIMIT / 1000)), computed.nearer);

class Line {
  private worker: Worker | null = null;
  private waiting: Task[] = [];
  private running: Task | null = null;
  private since = 0;
  private timer = 0;

  constructor(private readonly module: WebAssembly.Module, private readonly limit: number) {}

  add(task: Task): void {
    // A newer question of the same key makes older ones pointless.
    if (task.key !== '') {
      this.waiting = this.waiting.filter((old) => {
        if (old.key !== task.key) return true;
        old.reject(cancelled());
        return false;
      });
      const old = this.running;
      if (old?.key === task.key) {
        const age = performance.now() - this.since;
        if (this.limit === Infinity || age > LATE) this.stop(cancelled());
        else window.setTimeout(() => { if (this.running === old && this.waiting.includes(task)) this.stop(cancelled()); }, LATE - age);
      }
    }
    this.waiting.push(task);
    this.next();
  }

  drop(task: Task): void {
    if (this.running === task) this.stop(cancelled());
    else if (this.waiting.includes(task)) {
      this.waiting = this.waiting.filter((other) => other !== task);
      task.reject(cancelled());
    }
  }

  private stop(why: Error): void {
    const task = this.running;
    window.clearTimeout(this.timer);
    this.running = null;
    this.worker?.terminate();
    this.worker = null;
    task?.reject(why);
    this.next();
  }

  private next(): void {
    if (this.running) return;
    const task = this.waiting.shift();
    if (!task) return;
    this.running = task;
    this.since = performance.now();
    if (this.limit !== Infinity) this.timer = window.setTimeout(() => this.stop(new Refused(tooLong)), this.limit);
    this.worker ??= this.open();
    this.worker.postMessage(task.question);
  }

  private settle(message: Reply): void {
    const task = this.running;
    if (!task || task.question.id !== message.id) return;
    window.clearTimeout(this.timer);
    this.running = null;
    if ('problem' in message) task.reject(new Refused(message.problem));
    else task.resolve(message.answer);
    this.next();
  }

  private open(): Worker {
    const worker = createWorker();
    worker.onmessage = ({ data }: MessageEvent<Reply>) => this.settle(data);
    // A worker that cannot be started, or that broke down, leaves its question unanswered.
    worker.onerror = ({ message }) => this.stop(new Refused(problem('memory', computed.worker(message), computed.model)));
    worker.postMessage(this.module);
    return worker;
  }
}

export async function createClient(): Promise<Client> {
  const module = await coreModule();
  const lanes: Record<Lane, Line> = { quick: new Line(module, QUICK_LIMIT), study: new Line(module, Infinity) };
  let count = 0;
  return {
    ask<K extends Ask>(kind: K, ask: Requests[K]['ask'], options: { readonly lane?: Lane; readonly key?: string; readonly signal?: AbortSignal } = {}) {
      return new Promise<Requests[K]['answer']>((resolve, reject) => {
        const { lane = 'quick', key = '', signal } = options;
        if (signal?.aborted) {
          reject(cancelled());
          return;
        }
        const task: Task = { question: { id: ++count, kind, ask }, key, resolve: (answer) => resolve(answer as Requests[K]['answer']), reject };
        signal?.addEventListener('abort', () => lanes[lane].drop(task), { once: true });
        lanes[lane].add(task);
      });
    },
  };
}
