/* The exact motion in the page: drawn soon, as a draft; then the reference with the errors of all methods; and no answer with another state than its own.
 */
import { attempt, clean, figureOf, finish, judge, open, same, settled, singleFile, summaryOf, valuesOf } from './help.mjs';

/* Keeps, of every answer with a motion, what it held and when it came; and of every picture of the store's, what it was of. */
function keep() {
  const list = window.answers = [];
  const post = Worker.prototype.postMessage, seen = new WeakSet(), asked = new Map();
  Worker.prototype.postMessage = function (message, ...rest) {
    if (!seen.has(this)) {
      seen.add(this);
      this.addEventListener('message', ({ data }) => {
        const { answer } = data, ask = asked.get(data.id);
        // Steps ask for single columns.
        if (ask?.kind !== 'solve' || !answer?.tracks || ask.ask.columns.length) return;
        list.push({ at: performance.now(), truth: answer.truth ? (answer.truth.coarse ? 'coarse' : 'reference') : 'none', name: answer.truth?.name ?? '', points: answer.truth?.times.length ?? 0,
          methods: answer.tracks.length, errors: answer.errors.length, set: ask.ask.model.set.join(), until: ask.ask.until });
      });
    }
    if (message.kind) asked.set(message.id, message);
    return post.call(this, message, ...rest);
  };
}
const answers = (page) => page.evaluate(() => window.answers);
const order = (list) => list.map(({ truth, errors }) => `${truth}${errors ? ' with errors' : ''}`);
/** How many pixels of the motion's picture are of the exact line's colour. */
const green = (page) => page.locator('#stage-figure canvas.stage-moving').evaluate((canvas) => {
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let some = 0;
  for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 200 && data[i + 1] > data[i] + 40 && data[i + 1] > data[i + 2] + 40) some++;
  return some;
});

await attempt('order', async () => {
  const page = await open(`${singleFile}#v=1&p=duffing`, { before: keep });
  await settled(page, 500);
  same('the picture, a draft, the reference', order(await answers(page)), ['none', 'coarse', 'reference with errors']);
  judge('the exact line is drawn', await green(page) > 200, await green(page));
  judge('errors are told by the reference', /Measured against a reference, .*whose own error is about/.test(await summaryOf(page, 'Error')), await summaryOf(page, 'Error'));
  await clean('order', page, /readback/);
});

await attempt('a draft is drawn, and tells no error', async () => {
  // The reference of this one takes seconds.
  const page = await open(`${singleFile}#v=1&p=double-pendulum`, { before: keep, settle: false });
  await page.waitForFunction(() => window.answers.some((a) => a.truth === 'coarse'), null, { polling: 20 });
  let some = 0;
  for (let i = 0; i < 20 && some < 100 && (await answers(page)).length === 2; i++) {
    await page.waitForTimeout(50);
    some = await green(page);
  }
  if ((await answers(page)).length === 2) {
    judge('the draft is drawn', some > 100, some);
    await page.locator('#looking > h2').evaluate((heading) => heading.scrollIntoView());
    await page.waitForFunction(() => document.querySelector('figure[data-title="Error"] .figure-message')?.textContent);
    const said = await figureOf(page, 'Error').locator('.figure-message').textContent();
    judge('errors wait for the reference', /A reference is computed to compare with/.test(said), said);
  }
  // The state changes while the reference is computed: what follows is of the new one.
  await valuesOf(page);
  await page.locator('#until').fill('3');
  await settled(page, 600);
  const list = await answers(page), last = list[list.length - 1];
  same('the last answer is the reference of the new state', [last.truth, last.errors, last.until], ["reference", 2, 3]);
  const summary = await page.locator('#stage-figure figcaption').textContent();
  judge('the picture is of the new state', /to 3\b/.test(summary), summary);
  await clean('draft', page, /readback/);
});
await attempt('where no green line is, it says why', async () => {
  const dry = encodeURIComponent("x'' = -x - 0.1 sign(x')\nx(0) = 1\nx'(0) = 0\nstep 0.05\nuntil 20"), page = await open(`${singleFile}#v=1&m=${dry}&a=rk4`, { width: 390, height: 844, touch: true });
  await settled(page, 500);
  const said = () => page.locator('#status .message').textContent();
  // A busy machine may take longer than the page allows.
  if (/longer than 20 seconds/.test(await said())) { await page.reload(); await settled(page, 500); }
  judge('the core’s own reason', /^There is no green curve: from t = 15\.708 on the motion slides along x' = 0: .* dry friction that sticks\.$/.test(await said()), await said());
  same('no green is drawn', await green(page), 0);
  const [told, drawn] = await Promise.all(['#status', '#stage-picture'].map((s) => page.locator(s).boundingBox()));
  judge('on a phone it stands above the picture, not on it', told.y + told.height <= drawn.y + 1 && drawn.height > 200, JSON.stringify([told, drawn]));
  await valuesOf(page);
  await page.locator('#until').fill('10');
  await settled(page, 600);
  judge('before it sticks there is one', await said() === '' && await green(page) > 200, await said());
  await page.evaluate(() => { location.hash = `#v=1&m=${encodeURIComponent("x'' = 1/x\nx(0) = 0\nx'(0) = 1\nstep 0.5\nuntil 2")}&a=rk4,explicit-euler`; });
  await settled(page, 500);
  same('what is undefined at its start says that, once', await said(), 'RK4 and explicit Euler: the motion is undefined at t = 0: x\' has no finite rate of change there; 1/x is a division by 0 there, since x is 0.');
  judge('… and stops there', /RK4 stops at t = 0:/.test(await page.locator('#stage-figure figcaption').textContent()), await page.locator('#stage-figure figcaption').textContent());
  await clean('no green line', page, /readback/);
});
await finish();
