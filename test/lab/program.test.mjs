/* The C program of a motion. Law: what goes into a string of C comes out of the compiler unchanged, and nothing of it leaves its string. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import test from 'node:test';

const lab = new URL('../../lab/', import.meta.url);
const { buildSync } = createRequire(new URL('package.json', lab))('esbuild');
const built = buildSync({ entryPoints: [fileURLToPath(new URL('program.ts', lab))], bundle: true, format: 'esm', write: false, target: 'es2022' });
const { cProgram, literal } = await import('data:text/javascript;base64,' + Buffer.from(built.outputFiles[0].contents).toString('base64'));

const nasty = ["it's", '"', '\\', '\\n', '\\"', '"; system("id"); "', '??/', '??/"', '?\?=', '%s%n%d', '*/ /*', '//', 'a\tb', 'a\nb', '\n', '\n\n', '', ' ', 'θ₁″ = −sin θ', '𝑥1', 'é7', '\u2028', '\u202e', '\ufeff', '#include "x"', '\\\n', 'a\\', 'R"(', '0123é456'];

test('every text comes out of the compiler as it went in', () => {
  const folder = mkdtempSync(join(tmpdir(), 'motus-program-'));
  try {
    writeFileSync(join(folder, 'a.c'), `#include <stdio.h>\nint main(void) {\n${nasty.map((text) => `{ static const char s[] = ${literal(text)}; fwrite(s, 1, sizeof s, stdout); }`).join('\n')}\nreturn 0; }\n`);
    // Trigraphs are on: as strict as a compiler can be.
    execFileSync('cc', ['-std=c17', '-trigraphs', '-Wall', '-Wextra', '-Wpedantic', '-Werror', join(folder, 'a.c'), '-o', join(folder, 'a')], { stdio: ['ignore', 'pipe', 'pipe'] });
    assert.deepEqual(execFileSync(join(folder, 'a'), { encoding: 'utf8' }).split('\0').slice(0, -1), nasty);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

const motion = { text: "x'' = -x\n", set: {}, method: 'verlet', step: null, until: null };
test('the source is plain ASCII, whatever it holds', () => {
  for (const text of nasty) assert.match(cProgram({ ...motion, text, set: { x: text } }).text, /^[\n\x20-\x7e]*$/);
});

test('numbers are written with every digit; what the text has is left to it', () => {
  assert.match(cProgram({ ...motion, step: 0.1 + 0.2, until: 1e21 }).text, /how\.step = 0\.30000000000000004;\n {4}how\.until = 1e\+21;/);
  assert.doesNotMatch(cProgram(motion).text, /how\.(step|until)|set_count/);
});

test('control characters and numbers that are none are refused', () => {
  for (const c of ['\0', '\x1b', '\x7f', '\x9b', '\r']) for (const part of [{ text: c }, { method: c }, { set: { x: c } }, { set: { [c]: '1' } }]) {
    assert.equal(cProgram({ ...motion, ...part }).text, '');
    assert.match(cProgram({ ...motion, ...part }).problem, /control/);
  }
  for (const step of [NaN, Infinity]) assert.match(cProgram({ ...motion, step }).problem, /no number/);
});
