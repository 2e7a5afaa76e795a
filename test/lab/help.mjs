/* What the tests of the page share: a browser, a server of static files, cases, and ways to ask the page what it shows.
 *
 * Invariant: a page that was opened here is watched: an error on the console, a violation of its policy, a request to anybody else is a failed case,
 * unless the test says that it expects one. Each test prints `not ok - …` for what failed, and ends with `N passed, N failed`.
 */
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { extname, join, normalize, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const root = fileURLToPath(new URL('../../', import.meta.url));
export const built = join(root, 'build/lab');
export const program = resolve(process.env.MOTUS ?? join(root, 'build/motus'));
const need = createRequire(join(root, 'lab/package.json'));
export const { chromium } = need('playwright-core');

export const singleFile = pathToFileURL(join(built, 'motus-lab.html')).href;
export const place = mkdtempSync(join(tmpdir(), 'motus-page-'));

let passed = 0, failed = 0;
export function judge(name, good, why = '') {
  if (good) passed++;
  else {
    failed++;
    console.log(`not ok - ${name}${why === '' ? '' : `: ${String(why).slice(0, 500)}`}`);
  }
  return Boolean(good);
}
export const same = (name, got, wanted) => judge(name, JSON.stringify(got) === JSON.stringify(wanted), `${JSON.stringify(got)} is not ${JSON.stringify(wanted)}`);
/** A case that may break off: what it throws is its failure. */
export async function attempt(name, work) {
  try {
    await work();
  } catch (error) {
    judge(name, false, String(error?.message ?? error).split('\n').slice(0, 6).join(' | '));
  }
}

export function browserPath() {
  const names = [process.env.CHROMIUM, 'chromium', 'chromium-browser', 'google-chrome'].filter(Boolean);
  for (const name of names) {
    const found = name.includes('/') ? (existsSync(name) ? name : '') : spawnSync('sh', ['-c', `command -v ${name}`], { encoding: 'utf8' }).stdout.trim();
    if (found) return found;
  }
  throw new Error(`no browser: none of ${names.join(', ')}`);
}
let browser = null;
/** What a test opens last it also leaves open for `finish`. */
export const launch = async () => (browser ??= await chromium.launch({ executablePath: browserPath(), args: ['--no-sandbox', '--disable-dev-shm-usage'] }));

/** Static files, as any server has them. Answers the address; what it was asked for is in `asked`. */
export async function serve(folder = built) {
  const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.wasm': 'application/wasm' }, asked = [];
  const server = createServer((request, answer) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
    asked.push(path);
    const file = join(folder, path.endsWith('/') ? path + 'index.html' : path);
    if (!file.startsWith(folder) || !existsSync(file)) { answer.writeHead(404).end(); return; }
    answer.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' }).end(readFileSync(file));
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  servers.push(server);
  return { address: `http://127.0.0.1:${server.address().port}/`, asked };
}
const servers = [];

/* Runs in the page before all else: counts what the workers owe, and keeps violations of the policy and what the browser remembers of earlier visits. */
function watch() {
  let kept = '';
  try { kept = Object.entries(localStorage).join(' '); } catch { /* about:blank has no memory. */ }
  window.lab = { owed: 0, asked: 0, quiet: performance.now(), violations: [], kept };
  const post = Worker.prototype.postMessage, stop = Worker.prototype.terminate;
  const owes = new WeakMap();
  const count = (worker, by) => {
    owes.set(worker, (owes.get(worker) ?? 0) + by);
    window.lab.owed += by;
    window.lab.quiet = performance.now();
  };
  Worker.prototype.postMessage = function (message, ...rest) {
    if (!owes.has(this)) {
      owes.set(this, 0);
      this.addEventListener('message', () => count(this, -1));
    }
    if (!(message instanceof WebAssembly.Module)) { count(this, 1); window.lab.asked++; }
    return post.call(this, message, ...rest);
  };
  Worker.prototype.terminate = function () {
    count(this, -(owes.get(this) ?? 0));
    return stop.call(this);
  };
  document.addEventListener('securitypolicyviolation', (event) => window.lab.violations.push(`${event.violatedDirective} ${event.blockedURI}`));
}

/* Pages that were closed without a complaint, by what they were opened with: a new one costs twice what it takes to load it. Their memory is empty. */
const spare = new Map(), SPARE = 3;
/** Makes a page as it was when it was new, for the next that is opened in the same way; or closes it. */
async function putAway(page, good) {
  if (!page.kind || !good || !page.url().startsWith(singleFile) || page.context().pages().length > 1) return page.context().close();
  page.removeAllListeners('download');
  // What the page keeps when it is left is not kept.
  await page.evaluate(() => { Storage.prototype.setItem = () => {}; localStorage.clear(); sessionStorage.clear(); });
  await Promise.all([page.unrouteAll(), page.context().clearPermissions(), page.mouse.move(0, 0)]);
  await page.goto('about:blank');
  // A browser under load may lose what a page clears just before it is left, so the browser itself is asked, too.
  const session = await page.context().newCDPSession(page);
  await session.send('Storage.clearDataForOrigin', { origin: 'file://', storageTypes: 'local_storage' });
  await session.detach();
  const other = spare.get(page.kind) ?? (spare.size < SPARE ? null : spare.values().next().value);
  if (other) spare.delete(other.kind);
  spare.set(page.kind, page);
  return other?.context().close();
}

/** A page, watched. address: with its fragment. slower: than this machine, so many times. `wrong` collects what should not be; call `clean` at the end. */
export async function open(address = singleFile, options = {}) {
  const { width = 1280, height = 900, theme = 'light', calm = false, touch = false, kept = undefined, settle = true, before = undefined, first = false, forced = false, slower = 1 } = options;
  const media = { colorScheme: theme, reducedMotion: calm ? 'reduce' : 'no-preference', forcedColors: forced ? 'active' : 'none' };
  const kind = kept || slower > 1 ? '' : JSON.stringify([touch, first, String(before)]), page = spare.get(kind) ?? await made({ width, height, touch, media, kept, before, first, slower });
  if (spare.delete(kind)) await Promise.all([page.setViewportSize({ width, height }), page.emulateMedia({ media: null, ...media })]);
  Object.assign(page, { kind, wrong: [], asked: [] });
  await page.goto(address);
  if (settle) await settled(page);
  return page;
}
/** Such a page, of a browser that knows of no other. */
async function made({ width, height, touch, media, kept, before, first, slower }) {
  const context = await (await launch()).newContext({ viewport: { width, height }, ...media, acceptDownloads: true, hasTouch: touch, isMobile: touch, locale: 'en-GB', ...(kept ? { storageState: kept } : {}) });
  const page = await context.newPage();
  page.setDefaultTimeout(120000);
  Object.assign(page, { wrong: [], asked: [] });
  await page.addInitScript(watch);
  // A first visit begins by itself with a run of the motion, which most tests do not want.
  if (!first) await page.addInitScript(() => { try { localStorage.setItem('motus-lab-1:seen', '1'); } catch { /* about:blank */ } });
  if (before) await page.addInitScript(before);
  page.on('console', (message) => { if (message.type() === 'error' || message.type() === 'warning') page.wrong.push(`${message.type()}: ${message.text()}`); });
  page.on('pageerror', (error) => page.wrong.push(`thrown: ${error.message}`));
  page.on('request', (request) => page.asked.push(request.url()));
  page.on('crash', () => page.wrong.push('the page crashed'));
  if (slower > 1) await (await context.newCDPSession(page)).send('Emulation.setCPUThrottlingRate', { rate: slower });
  return page;
}

/** A page as it is before its script has come; that comes with `start`. */
export async function held(address, options = {}) {
  let release;
  const gate = new Promise((done) => { release = done; });
  const page = await open('about:blank', { ...options, settle: false, before: () => {
    const text = Response.prototype.text;
    Response.prototype.text = async function () { await window.held; return text.call(this); };
    window.held = new Promise((done) => { window.letGo = done; });
  } });
  await page.route('**/main.js', async (route) => { await gate; await route.continue(); });
  await page.goto(address, { waitUntil: 'commit' });
  await page.locator('#words .pill').waitFor();
  return { page, start: async () => { release(); await page.evaluate(() => window.letGo()); await settled(page); } };
}

/** Waits until the workers have owed nothing for a while, and what they answered is drawn. */
export async function settled(page, calm = 300, limit = 90000) {
  // What was just done is asked in the next frame.
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await page.waitForFunction((ms) => window.lab.owed === 0 && window.lab.asked > 0 && performance.now() - window.lab.quiet > ms, calm, { timeout: limit, polling: 50 });
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** The same, and an error in the text of the model has been told. */
export async function told(page) {
  await settled(page);
  await page.waitForTimeout(700);
}

/** What is wrong with a page at its end; it is closed. */
export async function clean(name, page, allowed = null) {
  const violations = await page.evaluate(() => window.lab.violations).catch(() => ['the page is gone']);
  const wrong = page.wrong.filter((line) => !allowed?.test(line));
  judge(`${name}: no error, no warning`, wrong.length === 0, wrong.join(' | '));
  judge(`${name}: its policy is kept`, violations.length === 0, violations.join(' | '));
  await putAway(page, page.wrong.length + violations.length === 0);
}

/** The fragment of the address once it holds the state, decoded field by field. The page writes it by a timer, so a later timer of the page waits for it however
 *  busy the machine is. */
export async function fields(page) {
  await page.evaluate(() => new Promise((done) => setTimeout(done, 500)));
  const hash = new URL(page.url()).hash.slice(1), found = {};
  for (const part of hash.split('&').filter(Boolean)) {
    const at = part.indexOf('='), key = part.slice(0, at), value = decodeURIComponent(part.slice(at + 1));
    found[key] = key in found ? [].concat(found[key], value) : value;
  }
  return found;
}
/** Does what is to be remembered (kept: a part of that), leaves the page and visits it anew, without a state in the address. A browser under load now and then
 *  hands the page of a file no memory at all, whatever was stored there: then the visit is repeated. */
export async function visitAgain(page, address, leave, kept) {
  for (let visit = 0; visit < 8; visit++) {
    await leave();
    await page.goto('about:blank');
    await page.goto(address);
    await settled(page);
    if (await page.evaluate((part) => window.lab.kept.includes(part), kept)) return;
  }
}
/** Fills in a text, and visits the page anew. */
export const visitAgainWith = (page, address, text) => visitAgain(page, address, async () => {
  await (await editorOf(page)).fill(text);
  await settled(page);
  await fields(page);
}, 'v=1&');
/** A figure by its short name; its heading is a question. */
export const figureOf = (page, title) => page.locator(`#panels figure[data-title="${title}"]`);
/** Scrolls to a figure without waiting for its picture: one that has nothing to show is hidden as soon as the core has answered, and its sentence stays. */
export const intoView = (locator) => locator.evaluate((figure) => {
  const picture = figure.querySelector('.figure-picture');
  (picture.checkVisibility() ? picture : figure).scrollIntoView({ block: 'nearest', behavior: 'instant' });
});
/** What looks closer is made when somebody comes to it, and shown what is near: this goes there, and to a figure of it. */
export async function closer(page, title = '') {
  await page.locator('#looking > h2').evaluate((heading) => heading.scrollIntoView());
  await page.waitForFunction(() => document.querySelector('#panels figure'));
  if (title) {
    await figureOf(page, title).waitFor();
    await intoView(figureOf(page, title));
  }
  // What comes into sight may ask the core.
  await settled(page, 150);
  // It is observed in one frame and drawn in the next.
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));
}
/** Another example, as its address opens it; the gallery is tested by itself. */
export async function example(page, name) {
  await page.evaluate((hash) => { if (location.hash === hash) history.replaceState(null, '', '#'); location.hash = hash; }, `#v=1&p=${name}`);
  await settled(page);
}
/** The text of the model, in the open editor. */
export async function editorOf(page) {
  const area = page.locator('#model-text');
  if (!await area.isVisible()) {
    // What is open above it: a sheet, and on phones the menu it came from.
    for (let i = 0; i < 2; i++) await page.keyboard.press('Escape');
    await page.locator('.pill').click();
  }
  return area;
}
/** The sheet with all numbers of the model. */
export async function valuesOf(page) {
  const sheet = page.locator('#all-values');
  // A change of the model may rebuild the dock; the sheet is opened by its button, as readers do.
  if (!await sheet.isVisible()) { await page.evaluate(() => scrollTo(0, 0)); await page.getByRole('button', { name: 'All values' }).click(); }
  return sheet;
}
export async function shareOf(page) {
  const popup = page.locator('.share .popup');
  if (await popup.isVisible()) return popup;
  if (await page.locator('#menu-button').isVisible() && !await page.locator('.share').isVisible()) await page.locator('#menu-button').click();
  await page.getByRole('button', { name: 'Share', exact: true }).click();
  return popup;
}
/** What a figure says of itself; one that is out of sight is not kept up to date. */
export async function summaryOf(page, title) {
  if (title === 'Motion') {
    // The stage is described when it is seen and drawn.
    await page.evaluate(() => scrollTo(0, 0));
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    await page.waitForFunction(() => document.querySelector('.stage-figure')?.getAttribute('aria-busy') === 'false');
    return page.locator('#stage-figure figcaption').textContent();
  }
  await closer(page, title);
  return figureOf(page, title).locator('.figure-summary').textContent();
}

/** CSV by RFC 4180, as rows of texts. */
export function readCsv(text) {
  const rows = [];
  let row = [], cell = '', quoted = false;
  for (let i = 0; i < text.length; i++) {
    const c = text[i];
    if (quoted) {
      if (c === '"' && text[i + 1] === '"') { cell += '"'; i++; }
      else if (c === '"') quoted = false;
      else cell += c;
    } else if (c === '"') quoted = true;
    else if (c === ',') { row.push(cell); cell = ''; }
    else if (c === '\n') { row.push(cell); rows.push(row); row = []; cell = ''; }
    else if (c !== '\r') cell += c;
  }
  if (quoted || cell !== '' || row.length) throw new Error('the CSV does not end with its last line');
  return rows;
}

/** A file that a button of a figure saves. */
export async function saved(page, title, kind) {
  if (title === 'Motion') await shareOf(page); else await closer(page, title);
  const button = (title === 'Motion' ? page : figureOf(page, title)).getByRole('button', { name: `Save “${title}” as ${kind}` });
  const once = () => Promise.all([page.waitForEvent('download', { timeout: 10000 }), button.click()]);
  // A page that is being laid out anew may move from under a pointer.
  const [download] = await once().catch(once);
  const path = join(place, `${Math.random().toString(36).slice(2)}.${kind.toLowerCase()}`);
  await download.saveAs(path);
  return { name: download.suggestedFilename(), bytes: readFileSync(path) };
}
/** The numbers behind a figure: head and rows of its CSV file. */
export async function tableOf(page, title) {
  const [head, ...rows] = readCsv((await saved(page, title, 'CSV')).bytes.toString('utf8'));
  if (title === 'Motion') await page.keyboard.press('Escape');
  return { head, rows };
}
/** The motion on the stage as its file has it, a column for each method as in the tables below the stage: "r.x (rk4)", "exact r.x". */
export async function numbersOf(page) {
  // While something moves a run has fewer rows than when it rests.
  await settled(page, 500);
  const { head: [, , ...columns], rows } = await tableOf(page, 'Motion'), titles = new Map(JSON.parse(motus('methods', '--json')).methods.map((m) => [m.title, m.name]));
  const motions = [...new Set(rows.map(([motion]) => motion))], known = (motion) => motion === 'exact' || motion === 'reference';
  const nameOf = (motion) => motion.replace(/^([^(]*[^( ])(\([^)]*\))$|^(.*)$/, (_, stem, rest, whole) => (whole === undefined ? `${titles.get(stem) ?? stem}${rest}` : titles.get(whole) ?? whole));
  const own = motions.filter((m) => !known(m)), times = [...new Set(rows.filter(([m]) => !known(m)).map(([, t]) => t))];
  const at = new Map(rows.map(([motion, t, ...values]) => [`${motion}\n${t}`, values]));
  const way = Number(times.at(-1)) < Number(times[0]) ? -1 : 1, sorted = times.sort((a, b) => way * (a - b)), wanted = columns.flatMap((column, k) => [...(motions.includes('exact') ? [['exact', k, `exact ${column}`]] : []), ...own.map((m) => [m, k, `${column} (${nameOf(m)})`])]);
  return { head: ['t', ...wanted.map(([, , name]) => name)], rows: sorted.map((t) => [t, ...wanted.map(([motion, k]) => at.get(`${motion}\n${t}`)?.[k] ?? '')]) };
}
export const motus = (...words) => execFileSync(program, words, { encoding: 'utf8', cwd: root, stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 1 << 28 });

/** What axe-core finds on a page. */
export async function audit(name, page) {
  await page.evaluate(readFileSync(need.resolve('axe-core/axe.min.js'), 'utf8'));
  const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) => violations.map((v) => `${v.id}: ${v.nodes.slice(0, 3).map((n) => `${n.target.join(' ')} (${n.any[0]?.message ?? n.all[0]?.message ?? ''})`).join('; ')}`)));
  judge(`axe: ${name}`, found.length === 0, found.join(' | '));
}
/** What is touched is 44 px high, or its label is. */
export async function fingers(name, page) {
  const small = await page.evaluate(() => [...document.querySelectorAll('button, select, input:not([type=range]), summary, textarea, a[href]:not(.skip)')].filter((e) => {
    const { width: w, height: h } = (e.closest('label') ?? e).getBoundingClientRect();
    return w > 0 && h > 0 && h < 43.5 && e.checkVisibility();
  }).map((e) => `${e.tagName} “${(e.getAttribute('aria-label') || e.textContent || e.id).slice(0, 30)}” ${Math.round(e.getBoundingClientRect().height)}`));
  judge(`${name}: what is touched is 44 px high`, small.length === 0, `${small.length}: ${small.slice(0, 8).join(', ')}`);
}
/** How many pixels wider than its window a page is. */
export const sideways = (page) => page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);

export async function finish() {
  await browser?.close();
  for (const server of servers) { server.closeAllConnections(); server.close(); }
  rmSync(place, { recursive: true, force: true });
  console.log(`${passed} passed, ${failed} failed`);
  process.exitCode = failed ? 1 : 0;
}
