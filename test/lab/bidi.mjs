/* Firefox, driven by WebDriver BiDi: a WebSocket, and the few commands that a test needs.
 *
 * Invariant: a page that was opened here is watched as those of help.mjs are: what the console complains of is in `wrong`, violations of the policy too.
 */
import { spawn, spawnSync } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import { mkdirSync, writeFileSync } from 'node:fs';
import { request } from 'node:http';
import { join } from 'node:path';
import { place } from './help.mjs';

/** A WebSocket's client (RFC 6455): texts in both directions; node has none before version 22. */
function socket(address) {
  const { hostname, port, pathname } = new URL(address);
  return new Promise((done, fail) => {
    const asked = request({ hostname, port, path: pathname, headers: { connection: 'Upgrade', upgrade: 'websocket', 'sec-websocket-version': 13, 'sec-websocket-key': randomBytes(16).toString('base64') } });
    asked.on('error', fail).on('response', (answer) => fail(new Error(`no WebSocket: ${answer.statusCode}`))).on('upgrade', (_, stream, head) => {
      const open = { told: () => {}, send, end: () => stream.destroy() };
      let bytes = head, pieces = [];
      function send(text, kind = 1) {
        const body = Buffer.from(text), mask = randomBytes(4), { length } = body, large = length > 65535, size = Buffer.alloc(length < 126 ? 2 : large ? 10 : 4);
        size[0] = 0x80 | kind;
        size[1] = 0x80 | (length < 126 ? length : large ? 127 : 126);
        if (large) size.writeBigUInt64BE(BigInt(length), 2); else if (length > 125) size.writeUInt16BE(length, 2);
        for (let i = 0; i < length; i++) body[i] ^= mask[i & 3];
        stream.write(Buffer.concat([size, mask, body]));
      }
      function read() {
        for (;;) {
          if (bytes.length < 2) return;
          const short = bytes[1] & 127, from = short < 126 ? 2 : short === 126 ? 4 : 10;
          if (bytes.length < from) return;
          const length = short < 126 ? short : short === 126 ? bytes.readUInt16BE(2) : Number(bytes.readBigUInt64BE(2));
          if (bytes.length < from + length) return;
          const body = bytes.subarray(from, from + length), last = bytes[0] & 0x80, kind = bytes[0] & 15;
          bytes = bytes.subarray(from + length);
          if (kind === 9) send(body, 10);
          if (kind > 2) continue;
          pieces.push(body);
          if (last) { open.told(Buffer.concat(pieces).toString()); pieces = []; }
        }
      }
      stream.on('data', (more) => { bytes = Buffer.concat([bytes, more]); read(); }).on('error', () => {});
      done(open);
      read();
    });
    asked.end();
  });
}

/** Where Firefox is; '': it is not installed. */
export const firefoxPath = () => [process.env.FIREFOX, 'firefox-esr', 'firefox'].filter(Boolean)
  .map((name) => spawnSync('sh', ['-c', `command -v ${name}`], { encoding: 'utf8' }).stdout.trim()).find(Boolean) ?? '';

const keys = { Tab: '\uE004', Enter: '\uE006', Escape: '\uE00C', Home: '\uE011', End: '\uE010', ArrowLeft: '\uE012', ArrowUp: '\uE013', ArrowRight: '\uE014', ArrowDown: '\uE015', Delete: '\uE017', Control: '\uE009' };

/* Runs in the page before all else. */
const watch = `() => {
  window.violations = [];
  try { localStorage.setItem('motus-lab-1:seen', '1'); } catch { /* about:blank */ }
  document.addEventListener('securitypolicyviolation', (event) => window.violations.push(event.violatedDirective + ' ' + event.blockedURI));
}`;

export async function firefox() {
  const profile = join(place, 'firefox');
  mkdirSync(profile);
  const settings = { 'app.update.enabled': false, 'datareporting.policy.dataSubmissionEnabled': false, 'browser.shell.checkDefaultBrowser': false, 'network.captive-portal-service.enabled': false,
    'network.connectivity-service.enabled': false, 'services.settings.server': 'data:,', 'browser.region.network.url': '', 'extensions.getAddons.cache.enabled': false, 'remote.prefs.recommended': true,
    'ui.systemUsesDarkTheme': 0, 'layout.css.prefers-color-scheme.content-override': 1, 'intl.locale.requested': 'en-GB' };
  writeFileSync(join(profile, 'user.js'), Object.entries(settings).map(([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});\n`).join(''));
  const browser = spawn(firefoxPath(), ['--headless', '--no-remote', '--remote-debugging-port=0', '--profile', profile], { stdio: ['ignore', 'ignore', 'pipe'] });
  const over = new Promise((done) => browser.on('exit', done));
  const listening = await new Promise((done, fail) => {
    let said = '';
    const late = setTimeout(() => fail(new Error(`Firefox does not answer: ${said.slice(-300)}`)), 120000);
    browser.stderr.on('data', (more) => {
      said += more;
      const found = /WebDriver BiDi listening on (ws:\S+)/.exec(said);
      if (found) { clearTimeout(late); done(found[1]); }
    });
    over.then(() => fail(new Error(`Firefox has ended: ${said.slice(-300)}`)));
  });
  const connection = await socket(`${listening}/session`), waiting = new Map();
  let count = 0, heard = () => {};
  connection.told = (text) => {
    const { id, type, result, error, message, method, params } = JSON.parse(text), wait = waiting.get(id);
    if (type === 'event') heard(method, params);
    waiting.delete(id);
    if (type === 'error') wait?.fail(new Error(`${error}: ${message}`)); else wait?.done(result);
  };
  const ask = (method, params = {}) => new Promise((done, fail) => {
    waiting.set(++count, { done, fail });
    connection.send(JSON.stringify({ id: count, method, params }));
  });
  const { capabilities } = await ask('session.new', { capabilities: {} });
  await ask('session.subscribe', { events: ['log.entryAdded'] });
  await ask('script.addPreloadScript', { functionDeclaration: watch });

  /** A page of this size. */
  async function open(address, { width = 1280, height = 800 } = {}) {
    const { context } = await ask('browsingContext.create', { type: 'tab' }), wrong = [], at = { context };
    heard = (method, { level, text, source }) => { if (source.context === context && (level === 'error' || level === 'warn')) wrong.push(`${level}: ${text}`); };
    await ask('browsingContext.setViewport', { ...at, viewport: { width, height } });
    const evaluate = async (work, ...words) => {
      const { type, result, exceptionDetails } = await ask('script.evaluate', { expression: `Promise.resolve((${work})(...${JSON.stringify(words)})).then((value) => JSON.stringify(value ?? null))`, target: at, awaitPromise: true, userActivation: true });
      if (type === 'exception') throw new Error(exceptionDetails.text);
      return JSON.parse(result.value);
    };
    const until = async (work, ...words) => {
      for (const began = Date.now(); ;) {
        const found = await evaluate(work, ...words);
        if (found) return found;
        if (Date.now() - began > 15000) throw new Error(`it never came: ${String(work).slice(0, 200)} ${words.join(', ')}`);
        await new Promise((done) => setTimeout(done, 40));
      }
    };
    const act = (type, actions, more = {}) => ask('input.performActions', { ...at, actions: [{ type, id: type, ...more, actions }] });
    const stroke = (names) => [...names.map((value) => ({ type: 'keyDown', value })), ...[...names].reverse().map((value) => ({ type: 'keyUp', value }))];
    const page = {
      wrong, evaluate, until,
      goto: (to) => ask('browsingContext.navigate', { ...at, url: to, wait: 'complete' }),
      reload: () => ask('browsingContext.reload', { ...at, wait: 'complete' }),
      /** "ArrowRight", "Control+a" */
      press: (names) => act('key', stroke(names.split('+').map((name) => keys[name] ?? name))),
      type: (text) => act('key', [...text].flatMap((letter) => stroke([letter === '\n' ? keys.Enter : letter]))),
      /** With the pointer, in the middle of what is seen first of these, once it rests there; text: which of them. */
      async click(selector, text = '') {
        const [x, y] = await until(async (s, t) => {
          const found = [...document.querySelectorAll(s)].find((e) => e.checkVisibility() && e.textContent.includes(t));
          if (!found) return null;
          found.scrollIntoView({ block: 'nearest' });
          const middle = () => {
            const { left, top, width: w, height: h } = found.getBoundingClientRect();
            return [Math.round(left + w / 2), Math.round(top + h / 2)];
          };
          const before = middle();
          await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
          const now = middle(), there = document.elementFromPoint(...now);
          return String(now) === String(before) && there && (found.contains(there) || there.contains(found)) ? now : null;
        }, selector, text);
        await act('pointer', [{ type: 'pointerMove', x, y }, { type: 'pointerDown', button: 0 }, { type: 'pointerUp', button: 0 }], { parameters: { pointerType: 'mouse' } });
      },
      async screenshot(path) { writeFileSync(path, Buffer.from((await ask('browsingContext.captureScreenshot', at)).data, 'base64')); },
      close: () => ask('browsingContext.close', at),
    };
    await page.goto(address);
    return page;
  }
  return {
    name: `${capabilities.browserName} ${capabilities.browserVersion}`, open,
    async close() {
      ask('browser.close').catch(() => {});
      await Promise.race([over, new Promise((done) => setTimeout(done, 5000).unref())]);
      browser.kill('SIGKILL');
      await over;
      connection.end();
    },
  };
}
