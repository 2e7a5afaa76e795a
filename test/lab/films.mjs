/* A film of the motion: its progress, its length, that it moves; called off; without a recorder. It is recorded while it runs, so page.sh runs nothing beside it. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { attempt, clean, finish, judge, open, place, same, shareOf, singleFile } from './help.mjs';

/** Duration, size, and pictures at the start and the end, as another page's player has them. */
async function played(bytes) {
  const player = await open('about:blank', { settle: false });
  const found = await player.evaluate(async (data) => {
    const video = document.createElement('video'), once = (name) => new Promise((done, fail) => { video.addEventListener(name, done, { once: true }); setTimeout(() => fail(new Error(`no ${name}`)), 8000); });
    video.muted = true;
    video.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))], { type: 'video/webm' }));
    await once('loadeddata');
    const canvas = document.createElement('canvas'), context = canvas.getContext('2d', { willReadFrequently: true });
    canvas.width = video.videoWidth;
    canvas.height = video.videoHeight;
    const pixels = () => { context.drawImage(video, 0, 0); return context.getImageData(0, 0, canvas.width, canvas.height).data; };
    const first = pixels().slice();
    // Played through, since what was recorded as it went can hardly be wound: the largest difference to its beginning, and how long it is.
    let differ = 0, over = false;
    video.addEventListener('ended', () => { over = true; });
    setTimeout(() => { over = true; }, 12000);
    await video.play();
    while (!over) {
      await Promise.race([new Promise((done) => video.requestVideoFrameCallback(done)), new Promise((done) => setTimeout(done, 300))]);
      const now = pixels();
      let count = 0;
      for (let i = 0; i < now.length; i += 4) if (Math.abs(now[i] - first[i]) + Math.abs(now[i + 1] - first[i + 1]) + Math.abs(now[i + 2] - first[i + 2]) > 90) count++;
      differ = Math.max(differ, count);
    }
    return { duration: video.currentTime, width: video.videoWidth, height: video.videoHeight, differ, ground: [...first.slice(0, 3)] };
  }, bytes.toString('base64'));
  await player.context().close();
  return found;
}
await attempt('a film', async () => {
  const page = await open(singleFile + '#v=1&p=thrown-ball'), popup = await shareOf(page), button = popup.getByRole('button', { name: 'Save “Motion” as WebM' }), said = popup.locator('p[role=status]');
  const [download] = await Promise.all([page.waitForEvent('download'), (async () => {
    await button.click();
    const telling = await said.textContent();
    // As it goes on, by the clock: an encoder on a busy machine takes its time to begin, and the film is two seconds after that.
    const seen = await popup.locator('progress').evaluate(async (p) => {
      const found = [];
      for (let since = performance.now(); !p.hidden && performance.now() - since < 20000;) {
        if (p.value > 0 && p.value < 1 && p.value !== found.at(-1)?.[1]) found.push([performance.now() / 1000, p.value]);
        await new Promise((done) => setTimeout(done, 20));
      }
      return found;
    }), [t, part] = seen[0] ?? [], [end, last] = seen.at(-1) ?? [];
    judge('its progress is told', /Recording 2 s/.test(telling) && seen.length > 4 && seen.some(([, p]) => p > 0.2 && p < 0.9) && seen.every(([, p], k) => k === 0 || p > seen[k - 1][1]) && Math.abs((last - part) * 2 - (end - t)) < 0.3, `${telling} ${JSON.stringify(seen)}`);
  })()]);
  same('the film has the model’s name', download.suggestedFilename(), 'thrown-ball-motion.webm');
  await download.saveAs(join(place, 'film.webm'));
  const bytes = readFileSync(join(place, 'film.webm')), box = await page.locator('#stage-picture').boundingBox(), found = await played(bytes);
  same('it begins as EBML does', bytes.subarray(0, 4).toString('hex'), '1a45dfa3');
  const s = Math.min(2, 1920 / box.width);
  judge('it decodes: two seconds, the picture with its caption', Math.abs(found.duration - 2) < 0.6 && Math.abs(found.width - s * box.width) <= 2 && Math.abs(found.height - s * (box.height + 86)) <= 2, JSON.stringify(found));
  judge('and it moves', found.differ > 1000, found.differ);
  await page.waitForTimeout(200);
  same('the end is told', await said.textContent(), 'The film is saved.');
  let got = false;
  page.on('download', () => { got = true; });
  await button.click();
  await page.waitForTimeout(400);
  await popup.getByRole('button', { name: 'Cancel the film' }).click();
  await page.waitForTimeout(2200);
  same('cancelled: nothing is saved', [got, await said.textContent(), await button.textContent()], [false, 'No film was made.', 'WebM']);
  await clean('a film', page);
  const without = await open(singleFile, { before: () => { delete window.MediaRecorder; } }), share = await shareOf(without);
  await share.getByRole('button', { name: 'Save “Motion” as WebM' }).click();
  judge('a browser without a recorder is told', /records no WebM/.test(await share.locator('p[role=status]').textContent()));
  await clean('without a recorder', without);
  const dark = await open(singleFile + '#v=1&p=kepler', { theme: 'dark' }), menu = await shareOf(dark);
  const [other] = await Promise.all([dark.waitForEvent('download'), menu.getByRole('button', { name: 'Save “Motion” as WebM' }).click()]);
  await other.saveAs(join(place, 'dark.webm'));
  const night = await played(readFileSync(join(place, 'dark.webm')));
  judge('no longer than twelve seconds, and of the theme', night.duration > 6 && night.duration < 12.6 && night.ground.every((c) => c < 60), JSON.stringify(night));
  await clean('a dark film', dark);
});
await finish();
