/* Sharing: the address holds the state and brings it back, the page remembers, “copy as command” computes the same bits, and so does the page with what
 * `motus run --share` prints. Addresses that are broken or hostile get a message, and the page lives.
 */
import { spawnSync } from 'node:child_process';
import { attempt, clean, editorOf, example, fields, figureOf, finish, judge, motus, open, program, readCsv, root, same, settled, singleFile, shareOf, summaryOf, numbersOf, tableOf, valuesOf, visitAgainWith } from './help.mjs';

const numbers = async (page) => numbersOf(page);
const hash = (page) => new URL(page.url()).hash;

// --- an address brings everything back ------------------------------------------------------------------------------------------------
await attempt('share and reload', async () => {
  const page = await open(singleFile + '#v=1&p=spring');
  await page.locator('.chip[data-method="rk4"]').click();
  await page.locator('#step').fill('0,1');
  const values = await valuesOf(page);
  await page.locator('#until').fill('3 pi');
  await values.getByLabel('k, as a number', { exact: true }).fill('2.25');
  await values.getByLabel("x'(0), as a number", { exact: true }).fill('-0.5');
  await page.keyboard.press('Escape');
  await page.locator('.transport select').selectOption('2');
  await settled(page);
  const state = await fields(page), before = await numbers(page);
  same('the address holds what differs, and nothing else', state,
    { v: '1', p: 'spring', s: ['k=2.25', "x'(0)=-0.5"], a: 'explicit-euler,symplectic-euler,verlet,rk4', h: '0.1', T: '3 pi', z: '2' });
  const address = page.url();
  await page.reload();
  await settled(page);
  same('reload: the same address', page.url(), address);
  same('reload: the same numbers', await numbers(page), before);
  same('reload: the fields', [await page.locator('#step').inputValue(), await page.locator('#until').inputValue(), await page.locator('#all-values').getByLabel('k, as a number', { exact: true }).inputValue(), await page.locator('.transport select').inputValue()], ['0.1', '3 pi', '2.25', '2']);
  const other = await open(address);
  same('somebody else: the same numbers', await numbers(other), before);
  await clean('somebody else', other);

  // The text survives, with or without an address.
  const text = "# grün θ </script><!-- 'q' \"d\" & % # +\nx'' = -x\nx(0) = 1\nx'(0) = 0\nmethod rk4\nstep 0.1\nuntil 2\n";
  await page.locator('#all-values').evaluate((sheet) => { for (const button of sheet.querySelectorAll('.reset.shown')) button.click(); });
  await settled(page);
  await (await editorOf(page)).fill(text);
  await settled(page);
  await fields(page);
  await page.reload();
  await settled(page);
  same('the text survives a reload', await page.locator('#model-text').inputValue(), text);
  await visitAgainWith(page, singleFile, text);
  same('… and a new visit without an address', await page.locator('#model-text').inputValue(), text);
  await page.evaluate(() => { location.hash = '#v=1&p=kepler'; });
  await settled(page);
  same('a new address in the same page', await page.locator('#scene-title').textContent(), 'Planet');
  // A link is followed while a change is still to be written to the address: the link wins. (That the page is left is what makes it write at once.)
  await page.evaluate(async () => {
    const step = document.querySelector('#step');
    step.value = '0.07';
    for (const event of ['input', 'change']) step.dispatchEvent(new Event(event, { bubbles: true }));
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    location.hash = '#v=1&p=spring';
    dispatchEvent(new PageTransitionEvent('pagehide'));
  });
  await settled(page);
  same('a link followed just after a change', [(await fields(page)).p, await page.locator('#step').inputValue() === '0.07'], ['spring', false]);
  await page.evaluate(() => { location.hash = '#v=1&p=kepler'; });
  await settled(page);
  await page.evaluate(() => { location.hash = '#theory'; });
  await page.waitForTimeout(700);
  same('a place in the page is no address', await page.locator('#scene-title').textContent(), 'Planet');
  await clean('share', page);
});

// --- a pinned run ---------------------------------------------------------------------------------------------------------------------
await attempt('a pinned run', async () => {
  const page = await open(singleFile + '#v=1&p=spring'), pin = page.locator('#dock-links [aria-pressed]'), said = () => pin.textContent();
  const shown = () => page.locator('#stage-figure canvas.stage-still').evaluate((canvas) => canvas.toDataURL());
  await (await valuesOf(page)).getByLabel('k, as a number', { exact: true }).fill('2.25');
  await page.keyboard.press('Escape');
  await page.locator('#step').fill('0.2');
  await settled(page);
  await pin.click();
  await page.locator('#step').fill('0.1');
  await valuesOf(page);
  await page.locator('#until').fill('20');
  await page.keyboard.press('Escape');
  await settled(page, 1500);
  same('a pinned run: the address holds it', await fields(page), { v: '1', p: 'spring', s: 'k=2.25', h: '0.1', T: '20', A: '1', As: 'k=2.25', Ah: '0.2' });
  same('… and it is told', await said(), 'A: h 0.2 ×');
  const address = page.url(), picture = await shown();
  await page.reload();
  await settled(page, 600);
  await page.waitForFunction(() => /^A: /.test(document.querySelector('#dock-links [aria-pressed]').textContent));
  same('reload: it is pinned again', [page.url(), await said(), await pin.getAttribute('aria-pressed')], [address, 'A: h 0.2 ×', 'true']);
  await page.waitForTimeout(200);
  judge('… and drawn as before', await shown() === picture);
  await example(page, 'pendulum');
  same('another example lets it go', [await said(), (await fields(page)).A], ['Pin', undefined]);
  await page.goBack();
  await settled(page, 600);
  await page.waitForFunction(() => /^A: /.test(document.querySelector('#dock-links [aria-pressed]').textContent));
  same('back: it is there', [page.url(), await said()], [address, 'A: h 0.2 ×']);
  await page.goForward();
  await settled(page, 600);
  same('forward: it is not', [await said(), (await fields(page)).p], ['Pin', 'pendulum']);
  await page.goBack();
  await settled(page, 600);
  await pin.click();
  same('let go: the address does not hold it', Object.keys(await fields(page)).filter((key) => key.startsWith('A')), []);
  await page.evaluate(() => document.activeElement?.blur());
  await page.keyboard.press('Control+z');
  await settled(page, 600);
  same('undo: it is there', await said(), 'A: h 0.2 ×');
  // One's own text: sliders write into it, so A has another.
  await (await editorOf(page)).fill("k = 1\nx'' = -k x\nx(0) = 1\nstep 0.1\nuntil 20\n");
  await settled(page, 600);
  same('another model lets it go', await said(), 'Pin');
  await pin.click();
  await page.locator('#model-text').fill("k = 2\nx'' = -k x\nx(0) = 1\nstep 0.1\nuntil 20\n");
  await settled(page, 600);
  same('a change of the text: A is the one before', [await said(), (await fields(page)).Am], ['A: k 1 ×', "k = 1\nx'' = -k x\nx(0) = 1\nstep 0.1\nuntil 20\n"]);
  await page.reload();
  await settled(page, 600);
  await page.waitForFunction(() => /^A: /.test(document.querySelector('#dock-links [aria-pressed]').textContent));
  same('… also after a reload', await said(), 'A: k 1 ×');
  for (const [part, why] of [['A=1&As=nothing', /name=value/], ['A=1&As=nothing%3D2', /could not be computed.*nothing/], ['A=1&Ah=abc', /“abc” is no number/], ['A=1&Aa=none', /no method “none”/], ['A=1&Am=x', /could not be computed/]]) {
    await page.evaluate((hash) => { document.querySelector('#toasts').replaceChildren(); location.hash = hash; }, `#v=1&p=spring&h=0.3&${part}`);
    await settled(page, 600);
    await page.locator('.toast').first().waitFor();
    judge(`a faulty pin, ${part}: it is told`, why.test(await page.locator('#toasts').textContent()) && /pinned run A/.test(await page.locator('#toasts').textContent()), await page.locator('#toasts').textContent());
    same(`… and all else is there (${part})`, [await page.locator('#step').inputValue(), await said(), await page.locator('#scene-title').textContent()], ['0.3', 'Pin', 'Mass on a spring']);
  }
  await clean('a pinned run', page);
});

// --- the menu ---------------------------------------------------------------------------------------------------------------------------
const shell = (script, folder) => spawnSync('sh', ['-c', `motus() { "$PROGRAM" "$@" $EXTRA; }\n${script}`], {
  encoding: 'utf8', cwd: folder, env: { ...process.env, PROGRAM: program, EXTRA: /^motus compare/.test(script) ? '--json' : '-o - --quiet' }, maxBuffer: 1 << 28,
});
/** The page's columns of a method at the page's times are the program's. */
function agree(name, table, method, csv) {
  const [head, ...rows] = readCsv(csv.replace(/^#.*\n/gm, '')), at = new Map(rows.map((row) => [Number(row[0]), row]));
  let compared = 0;
  const wrong = [];
  for (const row of table.rows) {
    const theirs = at.get(Number(row[0]));
    if (!theirs) { wrong.push(`no row at t = ${row[0]}`); continue; }
    table.head.forEach((label, i) => {
      if (!label.endsWith(` (${method})`)) return;
      const k = head.indexOf(label.slice(0, -method.length - 3));
      compared++;
      if (k < 0 || !Object.is(Number(row[i]), Number(theirs[k]))) wrong.push(`${label} at ${row[0]}: ${row[i]}, not ${theirs[k]}`);
    });
  }
  judge(name, compared > 0 && wrong.length === 0, `${compared} compared; ${wrong.slice(0, 3).join('; ')}`);
}

await attempt('copy as command', async () => {
  const page = await open(singleFile);
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await shareOf(page);
  same('the menu opens, and has the focus', [await page.locator('.share .popup').isVisible(), await page.evaluate(() => document.activeElement.textContent)], [true, 'Copy link']);
  const link = await page.getByLabel('The address holds the model, its numbers and the view').inputValue();
  judge('the link is this state', link.endsWith('#v=1&p=thrown-ball'), link);
  await page.getByRole('button', { name: 'Copy link' }).click();
  await page.waitForTimeout(100);
  const copied = await page.evaluate(() => navigator.clipboard.readText()).catch(() => '');
  judge('“Copy link” copies it, or selects it', copied === link || await page.evaluate(() => String(getSelection())) === link || await page.evaluate(() => document.activeElement.selectionEnd > 0), copied);
  await page.keyboard.press('Escape');
  same('Escape closes it, and the focus is back', [await page.locator('.share .popup').isVisible(), await page.evaluate(() => document.activeElement.textContent)], [false, 'Share']);

  const nasty = "# it's \"$HOME\" `id` $(id) \\ %41 </script> MOTUS_END\nk = 2\nx'' = -k sin(x) - 0.1 x'\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 3\nMOTUS = 1\n";
  const cases = [
    ['#v=1&p=projectile&a=midpoint', 'midpoint'], ['#v=1&p=pendulum&a=rk4&h=1%2F64&T=2%20pi&s=theta(0)%3D3', 'rk4'], ['#v=1&p=driven-oscillator&s=F%3D0.105', 'verlet'],
    ['#v=1&p=kepler&a=kahan-li8', 'kahan-li8'], ['#v=1&p=kepler&a=yoshida4', 'forest-ruth'], ['#v=1&p=damped-spring&a=newmark(1%2F4,%201%2F2)', 'newmark(1/4, 1/2)'], ['#v=1&p=charged-particle&a=boris&h=0.013', 'boris'], [`#v=1&m=${encodeURIComponent(nasty)}&a=verlet`, 'verlet'],
    // The page supposes what the program wants said.
    [`#v=1&m=${encodeURIComponent("k = 1\ntheta'' = -k sin(theta)\ntheta(0) = 2")}&a=rk4&s=k%3D4`, 'rk4'], [`#v=1&m=${encodeURIComponent("r'' = -r\nr(0) = (1, 2)")}&a=verlet&h=0.01&s=r'(0)%3D(0,1)`, 'verlet'],
  ];
  for (const [fragment, method] of cases) {
    await page.goto('about:blank');
    await page.goto(singleFile + fragment);
    // What is set goes into one's own text half a second after the hand rests, and the step is chosen anew.
    await settled(page, fragment.includes('&m=') && fragment.includes('&s=') ? 1200 : 300);
    await shareOf(page);
    const line = await page.getByLabel(/^The same (bits|runs)/).inputValue();
    await page.keyboard.press('Escape');
    const run = shell(line, root);
    judge(`the command runs: ${line.split('\n')[0]}`, run.status === 0, run.stderr);
    if (run.status === 0) agree(`… to the same bits: ${line.split('\n')[0]}`, await numbers(page), method, run.stdout);
  }
  await page.goto('about:blank');
  await page.goto(singleFile + '#v=1&p=projectile&h=0.01');
  await settled(page);
  await shareOf(page);
  const line = await page.getByLabel(/^The same (bits|runs)/).inputValue();
  const compared = shell(line, root);
  const { rows } = JSON.parse(compared.stdout || '{"rows":[]}');
  const error = await tableOf(page, 'Error');
  // The page's is the distance, the program's the larger coordinate; sideways all methods are exact, to rounding.
  judge('the command that compares: the same errors', rows.length === 3 && rows.every((row) => {
    const told = Number(error.rows.at(-1)[error.head.findIndex((h) => h.includes(`(${row.method})`))]);
    return row.error_final > 0 && told >= row.error_final && told <= row.error_final * (1 + 1e-12) + 1e-14;
  }), line);
  await clean('copy as command', page);
});

// --- from the program ---------------------------------------------------------------------------------------------------------------------
await attempt('motus run --share', async () => {
  for (const [words, method] of [[['models/damped-cubic.motus', '--set', "x(0)=4", '--step', '1/256'], 'verlet'], [['models/spring.motus', '--method', 'newmark(1/4, 1/2)', '--until', '2 pi', '--set', 'k=3'], 'newmark(1/4, 1/2)'],
    [['models/three-body-figure-eight.motus', '--method', 'rk4', '--step', '0.01'], 'rk4']]) {
    const fragment = motus('run', ...words, '--share').trim();
    judge(`--share: ${words[0]}: one fragment`, /^#?v=1&[^\s]+$/.test(fragment), fragment.slice(0, 80));
    const page = await open(singleFile + '#' + fragment.replace(/^#/, ''));
    agree(`--share: ${words[0]}: the same bits`, await numbers(page), method, motus('run', ...words, '-o', '-', '--quiet'));
    await clean('--share', page);
  }
});

// --- links that are broken, or that mean harm -------------------------------------------------------------------------------------------------
await attempt('hostile links', async () => {
  const model = (text) => '#v=1&m=' + encodeURIComponent(text);
  const toast = /could not be used/;
  const links = [
    ['another version', '#v=2&p=spring', toast], ['no version', '#p=spring', toast], ['an unknown key', '#v=1&p=spring&zz=1', toast], ['a bad percent code', '#v=1&m=%GG', toast], ['half of a letter', '#v=1&m=%C3', toast],
    ['an unknown example', '#v=1&p=__proto__', toast], ['200 KB', '#v=1&m=' + 'x'.repeat(200_000), toast], ['200 KB in codes', '#v=1&m=' + '%20'.repeat(66_000), toast], ['NUL', '#v=1&m=%00', toast], ['a terminal’s escape', '#v=1&m=%1B%5B2J', toast],
    ['a script', model("</script><script>window.hit=1</script>\nx'' = -x"), /Line 1/], ['an image', model("x'' = <img src=x onerror=window.hit=1>"), /Line 1/], ['quotes', model(`"'\`\${window.hit=1}\nx'' = 1`), /Line 1/],
    ['a comment full of HTML', model("# --></style></script><svg onload=window.hit=1>\nx'' = -x\nx(0)=1\nx'(0)=0\nstep 0.1\nuntil 1\n"), null],
    ['1e9 steps', model("x'' = -x\nx(0)=1\nx'(0)=0\nstep 1e-9\nuntil 1\n"), /10 million/], ['1e300 as the end', '#v=1&p=spring&T=1e300', /10 million/],
    ['a billion bodies', model("N = 1000000000\nx[i]'' = -x[i] for i = 1..N\nx[i](0) = 1 for i = 1..N\nx[i]'(0) = 0 for i = 1..N\nstep 0.1\nuntil 1\n"), /.{15}/],
    ['two million bodies', model("N = 2000000\nx[i]'' = -x[i] for i = 1..N\nx[i](0) = 1 for i = 1..N\nx[i]'(0) = 0 for i = 1..N\nstep 0.0001\nuntil 100\n"), /.{15}/],
    ['a sum without end', model("N = 10000000\nx'' = -sum(i = 1..N: x/i)\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 1\n"), /.{15}/],
    ['deep nesting', model("x'' = " + '('.repeat(20_000) + 'x' + ')'.repeat(20_000) + "\n"), /.{15}/], ['deep powers', model("x'' = -x" + '^2'.repeat(3000) + "\nx(0)=1\nx'(0)=0\nstep 0.1\nuntil 1\n"), /.{15}/],
    ['a name of 50 000 letters', model('a'.repeat(50_000) + " = 1\nx'' = -x\nx(0)=1\nx'(0)=0\nstep 0.1\nuntil 1\n"), null],
    ['names of the prototype', model("constructor = 1\n__proto__ = 2\ntoString = 3\nx'' = -constructor x\nx(0)=1\nx'(0)=0\nstep 0.1\nuntil 1\n"), null],
    ['a value that is a script', '#v=1&p=spring&s=k%3D%3C%2Fscript%3E', /.{15}/], ['a method that is a script', '#v=1&p=spring&a=%3Cimg%20src=x%20onerror=alert(1)%3E', /img|Not for/], ['a step that is a script', '#v=1&p=spring&h=%3Cscript%3E', /no number/],
    ['a speed of zero', '#v=1&p=spring&z=0', toast], ['panels of an older address', '#v=1&p=spring&o=time,error', null], ['a quantity that is none', '#v=1&p=spring&q=%22%3E%3Cimg%3E', null],
  ];
  // Every other one comes to a page that is open already.
  let page = null;
  for (const [k, [what, fragment, words]] of links.entries()) {
    if (k % 2) await page.evaluate((hash) => { location.hash = hash; }, fragment);
    else {
      if (page) await clean(`the links before “${what}”`, page);
      page = await open(singleFile + fragment, { settle: false });
    }
    await attempt(`a link with ${what}`, async () => {
      if (what === 'a sum without end') {
        await page.locator('#status button', { hasText: 'Cancel' }).click();
      }
      await settled(page);
      const said = await page.evaluate(() => ['#toasts', '#status', '#model-problem', '#step-message', '#until-message', '#all-values .sliders > .message', '.methods > .message'].map((s) => document.querySelector(s)?.textContent ?? '').join(' '));
      if (words) judge(`a link with ${what}: a message`, words.test(said.trim()), said.slice(0, 200));
      judge(`a link with ${what}: nothing of it runs`, await page.evaluate(() => window.hit === undefined && document.querySelectorAll('main img, main script').length === 0));
      if (k % 3 && k < links.length - 2) return;
      await example(page, 'pendulum');
      same(`a link with ${what}: the page lives`, await page.locator('#scene-title').textContent(), 'Pendulum');
      judge(`a link with ${what}: and computes`, (await summaryOf(page, 'Motion')).includes('from t = 0 to'), await summaryOf(page, 'Motion'));
    });
  }
  await clean('the last links', page);
});

// --- a motion that diverges -----------------------------------------------------------------------------------------------------------------
await attempt('a motion that diverges', async () => {
  const page = await open(singleFile + '#v=1&m=' + encodeURIComponent("x'' = x^3\nx(0) = 1\nx'(0) = 1\nmethod rk4\nstep 0.01\nuntil 100\n"));
  const said = await page.locator('#status').textContent();
  judge('it stops with the time and the name', /t = \d/.test(said) && /\bx\b/.test(said), said);
  judge('what was computed until then is shown', (await summaryOf(page, 'Motion')).length > 20);
  await example(page, 'spring');
  same('the message goes with the model', (await page.locator('#status .message').textContent()), '');
  await clean('a motion that diverges', page);
});
await finish();
