/* The only script that the single file holds as it is: it unpacks the page's own and puts it into a script element, whose hash the policy names. */
import { failed } from './failed';
import { unpackElement } from './unpack';

async function boot(): Promise<void> {
  const textContent = await unpackElement('main').text();
  document.body.append(Object.assign(document.createElement('script'), { textContent }));
}
boot().catch(failed);
