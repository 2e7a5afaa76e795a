/* The page as it starts: by double click and from a server, to the same numbers; what it asks for; its policy; the founding page's table of values,
 * to the bit of the program's; and the page that `motus lab` writes.
 */
import { spawnSync } from 'node:child_process';
import { readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';
import { attempt, built, clean, finish, held, judge, launch, motus, open, place, program, readCsv, root, same, serve, settled, singleFile, summaryOf, numbersOf, tableOf, visitAgainWith } from './help.mjs';

const founding = '#v=1&p=projectile&a=explicit-euler,symplectic-euler,midpoint,verlet,velocity-verlet';
const { address, asked } = await serve();

/** Every number of the page's file about these methods is the program's, row by row. */
function sameBits(name, table, model, methods, columns, words = []) {
  const at = (label) => table.head.indexOf(label);
  for (const method of methods) {
    const [head, ...rows] = readCsv(motus('run', model, '--method', method, '-o', '-', '--quiet', ...words).replace(/^#.*\n/gm, ''));
    const wrong = [];
    if (rows.length !== table.rows.length) wrong.push(`${table.rows.length} rows, not ${rows.length}`);
    for (const column of columns) {
      const theirs = head.indexOf(column), ours = at(`${column} (${method})`);
      if (theirs < 0 || ours < 0) wrong.push(`no column ${column}`);
      else rows.forEach((row, i) => { if (!Object.is(Number(row[theirs]), Number(table.rows[i]?.[ours]))) wrong.push(`${column} at t = ${row[0]}: ${table.rows[i]?.[ours]}, not ${row[theirs]}`); });
    }
    judge(`${name}: ${method}, the same bits in the page and in the program`, wrong.length === 0, wrong.slice(0, 3).join('; '));
  }
}

const tables = {};
for (const [name, url] of [['from disk', singleFile], ['from a server', address]]) {
  await attempt(name, async () => {
    const page = await open(url + founding);
    // A spare worker is made where there is time for it, and asks once more.
    same(`${name}: what is asked for`, [...new Set(page.asked.filter((a) => !a.startsWith('data:') && !a.startsWith('blob:')).map((a) => a.replace(/#.*/, '').replace(/^.*\//, '')))].sort(),
      name === 'from disk' ? ['motus-lab.html'] : ['', 'main.js', 'motus.wasm', 'worker.js']);
    judge(`${name}: nobody else is asked`, page.asked.every((a) => a.startsWith(url) || a.startsWith('data:') || a.startsWith('blob:') || a.startsWith(address)), page.asked.join(' '));
    const policy = await page.locator('meta[http-equiv="Content-Security-Policy"]').getAttribute('content');
    judge(`${name}: a strict policy`, /default-src 'none'/.test(policy) && !/unsafe-(?:inline|eval|hashes)|\*|https?:/.test(policy.replaceAll("'wasm-unsafe-eval'", '')), policy);
    judge(`${name}: no script runs that is not the page's own`, await page.evaluate(() => {
      window.hit = 0;
      const script = document.createElement('script');
      script.textContent = 'window.hit = 1';
      document.body.append(script);
      const image = new Image();
      image.setAttribute('onerror', 'window.hit = 2');
      image.src = 'data:,';
      document.body.append(image);
      return new Promise((done) => setTimeout(() => { window.lab.violations.length = 0; script.remove(); image.remove(); done(window.hit === 0); }, 200));
    }));
    page.wrong = page.wrong.filter((line) => !/Content Security Policy/.test(line));

    const table = tables[name] = await numbersOf(page);
    const last = table.rows.at(-1), value = (label) => Number(last[table.head.indexOf(label)]);
    same(`${name}: it ends at 3`, last[0], '3');
    judge(`${name}: exact y(3) = -30.645`, Math.abs(value('exact r.y') + 30.645) < 1e-13, value('exact r.y'));
    for (const [method, above] of [['explicit-euler', 0.73575], ['symplectic-euler', -0.73575], ['midpoint', 0], ['verlet', 0], ['velocity-verlet', 0]]) {
      judge(`${name}: ${method} ends ${above} above`, Math.abs(value(`r.y (${method})`) + 30.645 - above) < 1e-12, value(`r.y (${method})`));
    }
    if (name === 'from disk') sameBits('the founding table', table, 'models/projectile.motus', ['explicit-euler', 'symplectic-euler', 'midpoint', 'verlet', 'velocity-verlet'], ['r.x', 'r.y']);
    await clean(name, page, /Content Security Policy|ERR_INVALID_URL/);
  });
}
same('from disk and from a server: the same numbers', tables['from disk'], tables['from a server']);
judge('the server was asked for nothing that it does not have', asked.every((path) => ['/', '/main.js', '/motus.wasm', '/worker.js'].includes(path)), asked.join(' '));

await attempt('motus compare', async () => {
  const { rows } = JSON.parse(motus('compare', 'models/projectile.motus', '--methods', 'explicit-euler,symplectic-euler,midpoint,verlet', '--json'));
  const page = await open(singleFile + '#v=1&p=projectile&a=explicit-euler,symplectic-euler,midpoint,verlet');
  const { head, rows: ours } = await tableOf(page, 'Error');
  for (const row of rows) {
    const column = head.findIndex((h) => h.includes(`(${row.method})`));
    // The page's is the distance, the program's the larger coordinate; sideways all methods are exact, to rounding.
    const told = Number(ours.at(-1)[column]);
    judge(`motus compare: ${row.method}'s error at the end is the page's`, told >= row.error_final && told <= row.error_final * (1 + 1e-12) + 1e-14, `${head[column]} ${ours.at(-1)[column]}, not ${row.error_final}`);
  }
  await clean('errors', page);
});

/* Without what it is made of, the page says so, and the first picture stays. */
for (const [name, missing] of [['packed', 'DecompressionStream'], ['compiled', 'WebAssembly']]) {
  await attempt(`what cannot be ${name}`, async () => {
    const page = await (await launch()).newPage();
    await page.addInitScript((what) => { delete globalThis[what]; }, missing);
    await page.goto(singleFile);
    const said = await page.locator('[role=alert]').textContent();
    judge(`without ${missing} the page says that it cannot start, and what it needs`, said.includes('could not start') && said.includes(missing), said);
    judge(`without ${missing} the first picture is there`, await page.locator('#stage-picture svg').first().isVisible());
    await page.close();
  });
}

// --- before it has started ------------------------------------------------------------------------------------------------------------
for (const [name, url] of [['from disk', singleFile], ['from a server', address]]) {
  for (const [what, selector, done] of [['the question', '.ask-button', '.lesson'], ['the equation', '.pill', '#model-text']]) {
    await attempt(`a click on ${what} before the start, ${name}`, async () => {
      const { page, start } = await held(url);
      await page.locator(`#words ${selector}`).click();
      const before = await page.locator(done).count();
      await start();
      judge(`a click on ${what} before the start is done afterwards, ${name}`, before === 0 && await page.locator(done).first().isVisible(), before);
      await clean(`a click on ${what}, ${name}`, page);
    });
  }
  await attempt(`nothing clicked, ${name}`, async () => {
    const { page, start } = await held(`${url}#v=1&p=spring`);
    await page.locator('#words .ask-button').click();
    await page.locator('#words .pill').focus();
    await start();
    judge(`what had the focus has it still, ${name}`, await page.locator('#words .pill').evaluate((pill) => pill === document.activeElement));
    same(`a question that the page no longer asks is not answered, ${name}`, [await page.locator('#scene-title').textContent(), await page.locator('.lesson').first().isVisible()], ['Mass on a spring', false]);
    await clean(`another scene, ${name}`, page);
  });
}

// --- motus lab ----------------------------------------------------------------------------------------------------------------------
await attempt('motus lab', async () => {
  const out = join(place, 'mine.html');
  const run = spawnSync(program, ['lab', 'models/pendulum.motus', '--no-open', '-o', out], { encoding: 'utf8', cwd: root, env: { ...process.env, MOTUS_LAB_PAGE: join(built, 'motus-lab.html') } });
  same('motus lab --no-open', [run.status, run.stderr], [0, '']);
  const page = await open(pathToFileURL(out).href);
  same('motus lab: the model is in the page', await page.locator('#model-text').inputValue(), readFileSync(join(root, 'models/pendulum.motus'), 'utf8'));
  judge('motus lab: its motion is shown', /^Path|against time/.test(await summaryOf(page, 'Motion')));
  await visitAgainWith(page, pathToFileURL(out).href, `${await page.locator('#model-text').inputValue()}# mine\n`);
  judge('motus lab: what was typed there survives', (await page.locator('#model-text').inputValue()).endsWith('# mine\n'));
  await page.goto(singleFile);
  await settled(page);
  same('motus lab: and stays there', await page.locator('#scene-title').textContent(), 'A thrown ball');
  await clean('motus lab', page);
});

// --- sizes --------------------------------------------------------------------------------------------------------------------------
const bytes = (file) => statSync(join(built, file)).size;
judge('the single file is under 900 KB', bytes('motus-lab.html') < 900_000, bytes('motus-lab.html'));
const packed = gzipSync(readFileSync(join(built, 'motus.wasm')), { level: 9 }).length;
console.log(`# the module: ${bytes('motus.wasm')} bytes, ${packed} as servers send it`);
// Taylor series take 24 KB of it, what decimals say of constants 20, tables and switches of known times some 18, hints for what other languages write 5,
// Gauss-Radau 7.
judge('the module is under 850 KB', bytes('motus.wasm') < 850_000, bytes('motus.wasm'));
judge('the module is under 395 KB as servers send it', packed < 395_000, packed);
same('the module imports nothing', WebAssembly.Module.imports(new WebAssembly.Module(readFileSync(join(built, 'motus.wasm')))), []);
await finish();
