/* The motion as a C program over include/motus.h.
 *
 * Invariant: whatever the texts hold, they stay inside their strings: what is neither a plain character nor a tab or newline is written as its byte in
 * octal, and question marks are escaped, so that there are no trigraphs. Other control characters are refused, as in a command.
 */
import type { Aim } from './protocol';
import { controls, type Command } from './share';
import { words } from './words';

/** A string of C, a line of the text a line; indent: of the lines after the first. */
export function literal(text: string, indent = ''): string {
  let out = '';
  for (const byte of new TextEncoder().encode(text)) {
    const c = String.fromCharCode(byte);
    out += c === '\n' ? '\\n\n' : c === '\t' ? '\\t' : /["\\?]/.test(c) ? `\\${c}` : byte >= 32 && byte < 127 ? c : `\\${byte.toString(8).padStart(3, '0')}`;
  }
  return out.replace(/\n$/, '').split('\n').map((line) => `"${line}"`).join(`\n${indent}`);
}

/** What is computed; step, until: null where the text has them. */
export interface Motion { readonly text: string; readonly set: Readonly<Record<string, string>>; readonly method: string; readonly step: number | null; readonly tolerance?: number | null; readonly aim?: Aim | null; readonly until: number | null }

export function cProgram({ text, set, method, step, tolerance = null, aim = null, until }: Motion): Command {
  const sets = Object.entries(set).map(([name, value]) => `${name}=${value}`), numbers = [step, tolerance, aim && aim.accuracy, until];
  if ([text, method, ...sets].some((t) => controls.test(t))) return { text: '', problem: words.address.program.control };
  if (numbers.some((n) => n !== null && !Number.isFinite(n))) return { text: '', problem: words.address.program.number };
  const given = ['step', 'tolerance', 'accuracy', 'until'].map((name, k) => (numbers[k] === null ? '' : `    how.${name} = ${numbers[k]};\n`)).join('') + (aim?.absolute ? '    how.absolute = 1;\n' : '');
  return {
    problem: '', text: `/* cc -std=c17 motion.c -lmotus -lm -o motion */
#include <motus.h>
#include <stdio.h>

static const char model[] =
    ${literal(text, '    ')};
${sets.length ? `static const char *const set[] = {\n${sets.map((s) => `    ${literal(s, '    ')},\n`).join('')}};\n` : ''}
int main(void)
{
    motus_error error = motus_default_error();
    motus_text_def definition = motus_default_text();
    definition.text = model;
${sets.length ? '    definition.set = set, definition.set_count = sizeof set / sizeof *set;\n' : ''}    motus_run_def how = motus_default_run();
    how.method = ${literal(method)};
${given}
    motus_system *system = NULL;
    motus_run *run = NULL;
    int failed = motus_system_from_text(&definition, &system, &error) ||
                 motus_run_create(system, &how, &run, &error) || motus_run_finish(run, &error);
    for (size_t k = 0; !failed && k < motus_column_count(system); k++) {
        motus_column column = motus_default_column();
        double value = 0;
        failed = motus_column_at(system, k, &column) || motus_run_values(run, &k, 1, &value, &error);
        if (!failed) printf("%s = %.17g\\n", column.name, value);
    }
    if (failed) fprintf(stderr, "%s\\n", error.message);
    motus_run_destroy(run);
    motus_system_destroy(system);
    return failed;
}
` };
}
