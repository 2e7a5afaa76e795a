/* The memory of the module, lab/core/heap.c: blocks do not overlap, what is given back is used again, too much is refused. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';

test('blocks keep what is in them, and leave no memory behind', () => {
  const file = new URL('../../build/lab/motus.wasm', import.meta.url);
  const { malloc, free, memory } = new WebAssembly.Instance(new WebAssembly.Module(readFileSync(file))).exports;
  let seed = 12345;
  const random = (below) => {
    seed = (seed * 1103515245 + 12345) >>> 0;
    return Math.floor((seed / 2 ** 32) * below);
  };
  const round = () => {
    const live = [];
    for (let k = 0; k < 60000; k++) {
      if (live.length > 0 && random(100) < 49) {
        const { at, size, mark } = live.splice(random(live.length), 1)[0];
        const bytes = new Uint8Array(memory.buffer, at, size);
        assert.ok([0, size >> 1, size - 1].every((place) => bytes[place] === mark));
        free(at);
      } else {
        const size = 1 + random(random(50) === 0 ? 100000 : 300), at = malloc(size), mark = random(256);
        assert.ok(at > 0 && at % 16 === 0);
        new Uint8Array(memory.buffer, at, size).fill(mark);
        live.push({ at, size, mark });
      }
    }
    for (const { at } of live) free(at);
  };
  const before = memory.buffer.byteLength;
  round();
  // All is free again, and one piece: a block of nearly that size fits without growth.
  const bytes = memory.buffer.byteLength, whole = malloc(bytes - before);
  assert.ok(whole > 0);
  free(whole);
  assert.equal(memory.buffer.byteLength, bytes);
  assert.equal(malloc(0x7fffffff), 0);
  assert.equal(malloc(0x30000000), 0);
  assert.ok(malloc(1000) > 0);
});
