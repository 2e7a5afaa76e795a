/* The page's module against the program, byte for byte: the restart state (every number in hexadecimal) after some steps of every model by every
 * method that it admits. Ends with `N passed, N failed`.
 *
 *   node bits.mjs core.mjs motus.wasm motus FOLDER_OF_MODELS ...
 */
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join, resolve } from 'node:path';

const [bundle, wasm, program, ...folders] = process.argv.slice(2).map((name) => resolve(name));
const { Core } = await import(bundle);
const module = new WebAssembly.Module(readFileSync(wasm));
const folder = mkdtempSync(join(tmpdir(), 'motus-bits-'));
let passed = 0, failed = 0;
const judge = (name, good, why = '') => {
  if (good) passed++;
  else {
    failed++;
    console.log(`not ok - ${name}${why && `: ${why}`}`);
  }
};

judge('the module imports nothing', WebAssembly.Module.imports(module).length === 0);
{
  const core = new Core(module), ours = core.catalogue(core.create()).map((m) => m.name), known = JSON.parse(spawnSync(program, ['methods', '--json'], { encoding: 'utf8' }).stdout).methods.map((m) => m.name);
  judge('the module has every row of the catalogue', ours.join() === known.join(), known.filter((name) => !ours.includes(name)).join());
}
for (const file of folders.flatMap((models) => readdirSync(models).filter((name) => name.endsWith('.motus')).sort().map((name) => join(models, name)))) {
  const text = readFileSync(file, 'utf8');
  const core = new Core(module), lab = core.create();
  core.open(lab, { text, set: [] });
  const { methods, settings } = core.describe(lab), adaptive = new Set(core.catalogue(lab).filter((m) => m.adaptive).map((m) => m.name));
  // Some hundred steps, the last of them shortened, but where a method takes whole steps only.
  const end = (method) => settings.start + settings.step * (method === 'verlet-literal' ? 150 : 149.5);
  /* Steps of reversible rows follow the time scale of the force, and free motion between events has none: they shrink without end. */
  const free = /^\s*when /m.test(text);
  for (const { name: method } of methods.filter(({ name, admitted }) => admitted && !(free && name.endsWith('-reversible')))) {
    const until = end(method), state = join(folder, 'state'), tolerance = adaptive.has(method) ? 1e-8 : null;
    const run = spawnSync(program, ['run', file, '--method', method, '--until', String(until), '--save-state', state, '--error', 'none', '--quiet', '-o', join(folder, 'out.csv'), '--force',
      ...(tolerance ? ['--tolerance', String(tolerance)] : [])], { encoding: 'utf8' });
    core.start(lab, method, null, until, tolerance);
    let said = '';
    try {
      core.advance(lab, 1e6);
    } catch (e) {
      said = e.problem.message;
    }
    if (said === '' && run.status !== 0) said = core.singular(lab, method, null, until, tolerance)?.message ?? '';
    const both = `${basename(file)} by ${method}`;
    if (run.status !== 0) judge(both, said !== '' && run.stderr.includes(said), `the program says ${run.stderr}, the module ${said || 'nothing'}`);
    else judge(both, said === '' && core.save(lab) === readFileSync(state, 'utf8'), said);
    rmSync(state, { force: true });
  }
  /* The bars of the answer: the numbers and the errors that the program prints. */
  const names = core.describe(lab).columns, columns = names.flatMap(({ kind }, k) => (kind === 'position' || kind === 'velocity' ? [k] : []));
  for (const { name: method } of methods.filter(({ name, admitted }) => admitted && ['verlet', 'rk4', 'dopri5', 'dep8'].includes(name))) {
    const tolerance = adaptive.has(method) ? 1e-8 : null, until = end(method), both = `${basename(file)} by ${method}: its bars`;
    const run = spawnSync(program, ['run', file, '--method', method, '--until', String(until), '--json', ...(tolerance ? ['--tolerance', String(tolerance)] : [])], { encoding: 'utf8' });
    if (run.status !== 0) continue;
    core.start(lab, method, null, until, tolerance, true);
    core.advance(lab, 1e6);
    const { values, errors } = core.errors(lab, columns), told = JSON.parse(run.stdout), flat = (of) => Object.fromEntries(Object.entries(of).map(([name, value]) => [name, [value].flat(Infinity)]));
    // By variable, in the order of the columns; null: no digit is known, or there is no bar.
    const ours = (list) => columns.reduce((all, k, i) => { const name = names[k].name.replace(/\[\d+\]/, '').replace(/\.\w+$/, ''); (all[name] ??= []).push(Number.isFinite(list[i]) ? list[i] : null); return all; }, {});
    const wanted = (of) => Object.fromEntries(Object.entries(flat(of)).filter(([name]) => name in ours(values)));
    judge(both, JSON.stringify([ours(values), ours(errors)].map(Object.entries).map((x) => x.sort())) === JSON.stringify([wanted(told.state), wanted(told.error ?? {})].map(Object.entries).map((x) => x.sort())), `${JSON.stringify(ours(errors))} is not ${JSON.stringify(told.error)}`.slice(0, 300));
  }
  core.destroy(lab);
}
rmSync(folder, { recursive: true });
console.log(`${passed} passed, ${failed} failed`);
process.exitCode = failed ? 1 : 0;
