/* make bench: how fast the page is, by the browser's own PerformanceObserver and the marks that the page sets (milestone in lab/dom.ts).
 *
 *     node bench/page.mjs [--save DIRECTORY] [start] [green] [sliders] [playing] [slow]
 *
 * It opens build/lab/motus-lab.html from disk in Chromium at 1280 by 800. It never fails because of a figure; "short" says that a limit was missed. --save
 * writes the lines to DIRECTORY/page-<processor>.txt as well. What cannot be measured here says so, and the exit status is 0.
 *
 * Invariant: columns are two or more blanks apart, and no field holds two blanks in a row, as in bench/report.c. A time of the page's thread is its processor
 * time where that is said, else what a clock shows, which other programs lengthen.
 */
import { examples } from '../lab/models.mjs';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { cpus, loadavg, tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../', import.meta.url));
const words = process.argv.slice(2), saveAt = words.indexOf('--save'), directory = saveAt < 0 ? '' : words.splice(saveAt, 2)[1];
const wanted = (part) => words.length === 0 || words.includes(part);

let help = null;
try {
  if (!existsSync(join(root, 'build/lab/motus-lab.html'))) throw new Error('build/lab/motus-lab.html is missing: make lab builds it');
  help = await import('../test/lab/help.mjs');
  help.browserPath();
} catch (error) {
  console.log(`The page is not measured: ${error.message.split('\n')[0]}.`);
  process.exit(0);
}
const { browserPath, chromium, open, place, settled, singleFile } = help;

// --- lines ---------------------------------------------------------------------------------------------------------------------------
const lines = [];
const counts = { ok: 0, short: 0, 'not measured': 0 };
const text = (line) => { lines.push(line); console.log(line); };
const section = (title, what) => text(`\n${title}\n${what.padEnd(58)}  ${'median'.padStart(9)}  ${'best'.padStart(9)}  ${'limit'.padStart(8)}`);
const middle = (list) => [...list].sort((a, b) => a - b)[(list.length - 1) >> 1] ?? NaN;
const figure = (value, unit) => (Number.isFinite(value) ? `${value.toFixed(unit === '' && Number.isInteger(value) ? 0 : value < 1 ? 3 : value < 100 ? 1 : 0)}${unit && ` ${unit}`}` : '-');
/** samples: of which the middle one is judged; most: at most so much; least: at least; neither: no limit. */
function line(name, samples, unit, { most, least } = {}) {
  const value = middle(samples), best = least === undefined ? Math.min(...samples) : Math.max(...samples);
  const limit = most !== undefined ? `<= ${most}` : least !== undefined ? `>= ${least}` : '';
  const verdict = !limit ? '' : !Number.isFinite(value) ? 'not measured' : (most !== undefined ? value <= most : value >= least) ? 'ok' : 'short';
  if (verdict) counts[verdict]++;
  text(`  ${name.padEnd(56)}  ${figure(value, unit).padStart(9)}  ${(samples.length > 1 ? figure(best, unit) : '').padStart(9)}  ${limit.padStart(8)}${verdict && `  ${verdict}`}`);
}
const note = (words_) => text(`      ${words_}`);

// --- in the page ---------------------------------------------------------------------------------------------------------------------
/** Before all else: what the browser itself measures. */
function observe() {
  const seen = window.seen = { longtask: [], shift: 0, paint: {}, largest: 0, event: [] };
  const on = (type, act, more = {}) => { try { new PerformanceObserver((list) => list.getEntries().forEach(act)).observe({ type, buffered: true, ...more }); } catch { /* Not every browser has all. */ } };
  on('longtask', (e) => seen.longtask.push(e.duration));
  on('layout-shift', (e) => { if (!e.hadRecentInput) seen.shift += e.value; });
  on('paint', (e) => { seen.paint[e.name] = e.startTime; });
  on('largest-contentful-paint', (e) => { seen.largest = e.startTime; });
  on('event', (e) => { if (e.interactionId) seen.event.push(e.duration); }, { durationThreshold: 16 });
}
const mark = (page, name) => page.evaluate((n) => performance.getEntriesByName(`motus-${n}`)[0]?.startTime ?? NaN, name);
const marked = (page, name, limit = 30000) => page.waitForFunction((n) => performance.getEntriesByName(`motus-${n}`).length > 0, name, { polling: 20, timeout: limit }).then(() => mark(page, name), () => NaN);

/** What each picture shows: the event whose question was answered last before it was drawn. */
function follow() {
  const drag = window.drag = { event: 0, asked: new Map(), answered: 0 };
  const post = Worker.prototype.postMessage, seen = new WeakSet();
  Worker.prototype.postMessage = function (message, ...rest) {
    if (!seen.has(this)) {
      seen.add(this);
      this.addEventListener('message', ({ data }) => { drag.answered = drag.asked.get(data.id) ?? drag.answered; });
    }
    if (message.kind === 'solve' && drag.event) drag.asked.set(message.id, drag.event);
    return post.call(this, message, ...rest);
  };
}
/** Moves a slider once a frame, as a hand does. drawn: milliseconds from an event to the end of the frame that first shows it; frames: from the frame of the
 * event to that one, in units of a frame at 60 Hz. */
function dragged({ slider: n, frames }) {
  const slider = document.querySelectorAll('#dials input[type=range], #all-values input[type=range]')[n], [low, high, value] = [slider.min, slider.max, slider.value].map(Number);
  const canvas = document.querySelector('#stage-figure canvas.stage-still'), context = canvas.getContext('2d'), clear = context.clearRect, began = performance.now();
  return new Promise((done) => {
    const drawn = [], late = [], frameOf = new Map();
    let moved = 0, shown = 0, took = 0;
    context.clearRect = function (...box) {
      clear.apply(context, box);
      const event = window.drag.answered;
      if (event === shown || !frameOf.has(event)) return;
      shown = event;
      late.push(Math.round((document.timeline.currentTime - frameOf.get(event)) / (1000 / 60)));
      // The frame is drawn when its callbacks are over.
      const channel = new MessageChannel();
      channel.port1.onmessage = () => drawn.push(performance.now() - event);
      channel.port2.postMessage(0);
    };
    const move = () => {
      window.drag.event = performance.now();
      frameOf.set(window.drag.event, document.timeline.currentTime);
      slider.value = String(Math.min(high, Math.max(low, value + ((moved % 20) + 1) * (high - low) / 200)));
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      if (++moved < frames) { requestAnimationFrame(move); return; }
      took = performance.now() - began;
      const pictures = drawn.length;
      setTimeout(() => { delete context.clearRect; window.drag.event = 0; done({ drawn, late, rate: 1000 * pictures / took }); }, 300);
    };
    requestAnimationFrame(move);
  });
}
/** Times of frames for a while. */
const frames = (page, milliseconds) => page.evaluate((ms) => new Promise((done) => {
  const all = [], began = performance.now();
  const tick = (t) => { all.push(t); if (performance.now() - began < ms) requestAnimationFrame(tick); else done(all); };
  requestAnimationFrame(tick);
}), milliseconds);

// --- what is measured ----------------------------------------------------------------------------------------------------------------
const SIZE = { width: 1280, height: 800 };
/** Beyond these a picture takes longer than two frames: 100 000 kicks of high order, or implicit steps. */
const LARGEST = ['outer-solar-system', 'arenstorf', 'double-pendulum'];
const presets = examples.map(({ name }) => name);

/** The tasks of the page's thread, milliseconds of processor time each, from the browser's trace. */
async function traced(cdp, act) {
  const events = [], keep = ({ value }) => events.push(...value);
  cdp.on('Tracing.dataCollected', keep);
  await cdp.send('Tracing.start', { transferMode: 'ReportEvents', traceConfig: { includedCategories: ['toplevel', 'devtools.timeline'] } });
  await act();
  const over = new Promise((done) => cdp.once('Tracing.tracingComplete', done));
  await cdp.send('Tracing.end');
  await over;
  cdp.off('Tracing.dataCollected', keep);
  const mains = new Set(events.filter((e) => e.name === 'thread_name' && e.args.name === 'CrRendererMain').map((e) => `${e.pid} ${e.tid}`));
  return events.filter((e) => e.ph === 'X' && e.name.endsWith('RunTask') && mains.has(`${e.pid} ${e.tid}`) && e.tdur !== undefined).map((e) => e.tdur / 1000);
}

async function start() {
  const found = { first: [], largest: [], running: [], drawn: [], shift: [], long: [], longest: [], thread: [] }, starts = 9;
  for (let i = 0; i < starts; i++) {
    const profile = mkdtempSync(join(tmpdir(), 'motus-bench-'));
    const context = await chromium.launchPersistentContext(profile, { executablePath: browserPath(), args: ['--no-sandbox', '--disable-dev-shm-usage'], viewport: SIZE });
    const page = context.pages()[0] ?? await context.newPage();
    await page.addInitScript(observe);
    const run = async () => {
      await page.goto(singleFile);
      found.drawn.push(await marked(page, 'first-motion'));
      // It plays once by itself.
      await page.waitForTimeout(3000);
    };
    // A trace costs time of its own: these starts count for the tasks alone.
    if (i % 3 === 2) {
      found.thread.push(Math.max(...await traced(await context.newCDPSession(page), run)));
      found.drawn.pop();
    } else {
      await run();
      const seen = await page.evaluate(() => window.seen);
      found.first.push(seen.paint['first-contentful-paint'] ?? NaN);
      found.largest.push(seen.largest);
      found.running.push(await mark(page, 'module-running'));
      found.shift.push(seen.shift);
      found.long.push(seen.longtask.length);
      found.longest.push(Math.max(0, ...seen.longtask));
    }
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  }
  section('The start, from disk, with a new profile', 'milliseconds after the address was opened');
  line('first contentful paint', found.first, 'ms', { most: 300 });
  line('largest contentful paint', found.largest, 'ms');
  line('module running: its first answer has come', found.running, 'ms', { most: 1000 });
  line('the motion drawn by the module', found.drawn, 'ms');
  line('layout shift', found.shift, '', { most: 0.02 });
  section('The page’s tasks while it starts, and plays once by itself', 'the longest of each start');
  line('processor time of the longest task', found.thread, 'ms', { most: 50 });
  line('long tasks, of more than 50 ms by the clock', found.long, '');
  line('the longest of them by the clock', found.longest, 'ms');
}

async function green() {
  section('Each example, until its exact motion is drawn', 'milliseconds after the address was opened');
  for (const preset of presets) {
    const times = [];
    for (let i = 0; i < 3; i++) {
      const page = await open(`${singleFile}#v=1&p=${preset}`, { ...SIZE, settle: false });
      times.push(await marked(page, 'exact-motion'));
      await page.context().close();
    }
    line(preset, times, 'ms', { most: 1000 });
  }
}

async function sliderPage(preset, slower) {
  const page = await open(`${singleFile}#v=1&p=${preset}`, { ...SIZE, before: follow });
  await settled(page, 400, 60000);
  if (slower > 1) await (await page.context().newCDPSession(page)).send('Emulation.setCPUThrottlingRate', { rate: slower });
  const names = await page.evaluate(() => [...document.querySelectorAll('#dials input[type=range], #all-values input[type=range]')].map((s) => [s.checkVisibility(), s.getAttribute('aria-label') || s.labels?.[0]?.textContent || s.id]));
  return { page, sliders: names.flatMap(([visible, name], n) => (visible ? [{ n, name: name.trim() }] : [])) };
}

async function sliders() {
  section('A slider dragged, one event a frame', 'frames from the event’s to the one that shows it');
  const drawn = new Map();
  for (const preset of presets) {
    const { page, sliders: list } = await sliderPage(preset, 1);
    const large = LARGEST.includes(preset), own = [];
    for (const { n, name } of list) {
      const { drawn: times, late } = await page.evaluate(dragged, { slider: n, frames: 45 });
      own.push(...times);
      line(`${preset}: ${name}`, late, '', large ? {} : { most: 2 });
      await settled(page, 300, 60000);
    }
    drawn.set(preset, own);
    await page.context().close();
  }
  section('The same, to the end of the frame that shows it', 'milliseconds after the event, all sliders');
  for (const [preset, times] of drawn) line(preset, times, 'ms');
}

async function slow() {
  section('The step dragged, with a processor four times slower', 'pictures a second');
  for (const preset of presets) {
    const { page, sliders: [first] } = await sliderPage(preset, 4), rates = [];
    for (let i = 0; i < 3; i++) {
      rates.push((await page.evaluate(dragged, { slider: first.n, frames: 30 })).rate);
      await settled(page, 300, 60000);
    }
    line(preset, rates, '', LARGEST.includes(preset) ? {} : { least: 20 });
    await page.context().close();
  }
  // The events of a real pointer, as the browser itself times them.
  const page = await open(singleFile, { ...SIZE, before: observe });
  await (await page.context().newCDPSession(page)).send('Emulation.setCPUThrottlingRate', { rate: 4 });
  const box = await page.locator('#dials input[type=range]').first().boundingBox();
  await page.mouse.move(box.x + 0.3 * box.width, box.y + box.height / 2);
  for (let i = 0; i < 12; i++) {
    await page.mouse.down();
    await page.mouse.move(box.x + (0.3 + 0.04 * i) * box.width, box.y + box.height / 2, { steps: 3 });
    await page.mouse.up();
  }
  await page.waitForTimeout(500);
  line('a press of the pointer on the step, to the next paint', await page.evaluate(() => window.seen.event), 'ms');
  await page.context().close();
}

async function playing() {
  const ten = 'explicit-euler,symplectic-euler,midpoint,verlet,rk4,velocity-verlet,pefrl,yoshida4,kahan-li6,gauss4';
  section('A planet by ten methods, playing', 'at 60 Hz');
  const page = await open(`${singleFile}#v=1&p=kepler&a=${ten}`, { ...SIZE, before: observe });
  const shown = await page.locator('#methods .chips .chip[aria-pressed="true"]').count(), rates = [], gaps = [];
  if (shown !== 10) note(`${shown} methods are shown, not 10`);
  const play = async () => {
    await page.keyboard.press('Home');
    await page.keyboard.press('Space');
    const stamps = await frames(page, 3000);
    await page.keyboard.press('Space');
    return stamps;
  };
  await page.evaluate(() => { window.seen.longtask.length = 0; });
  for (let i = 0; i < 3; i++) {
    const stamps = await play();
    rates.push(1000 * (stamps.length - 1) / (stamps[stamps.length - 1] - stamps[0]));
    gaps.push(Math.max(...stamps.slice(1).map((t, k) => t - stamps[k])));
  }
  line('frames a second', rates, '', { least: 59 });
  line('the longest time between two', gaps, 'ms');
  line('long tasks, of more than 50 ms by the clock', [await page.evaluate(() => window.seen.longtask.length)], '', { most: 0 });
  const tasks = await traced(await page.context().newCDPSession(page), play);
  line('processor time of the longest task', [Math.max(...tasks)], 'ms', { most: 50 });
  line('processor time of the page’s thread a frame', [tasks.reduce((a, b) => a + b, 0) / 180], 'ms', { most: 16.7 });
  await page.context().close();
}

// --- all of it -----------------------------------------------------------------------------------------------------------------------
const info = existsSync('/proc/cpuinfo') ? readFileSync('/proc/cpuinfo', 'utf8') : '', of = (key) => new RegExp(`^${key}\\s*:\\s*(.*)$`, 'm').exec(info)?.[1];
const processor = `${cpus()[0]?.model ?? 'unknown processor'}${of('cpu family') ? ` (family ${of('cpu family')}, model ${of('model')})` : ''}`;
const browser = await help.launch();
text(`The page on ${processor}, ${cpus().length} cores, Chromium ${browser.version()}, software rendering, load ${loadavg()[0].toFixed(1)} before the start`);
for (const [name, part] of Object.entries({ start, green, sliders, playing, slow })) if (wanted(name)) await part();
text(`\n${counts.ok} ok, ${counts.short} short, ${counts['not measured']} not measured; load ${loadavg()[0].toFixed(1)} at the end`);
await browser.close();
rmSync(place, { recursive: true, force: true });
if (directory) {
  const file = join(directory, `page-${processor.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/-$/, '')}.txt`);
  writeFileSync(file, `${lines.join('\n')}\n`);
  console.log(file);
}
