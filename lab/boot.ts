/* The only script that the single file holds as it is: it unpacks the page's own, and the sheets of what opens later, and puts them into elements whose
 * hashes the policy names. */
import { failed } from './failed';
import { unpackElement } from './unpack';

async function boot(): Promise<void> {
  const [script, style] = await Promise.all(['main', 'style'].map((id) => unpackElement(id).text()));
  document.head.append(Object.assign(document.createElement('style'), { textContent: style }));
  document.body.append(Object.assign(document.createElement('script'), { textContent: script }));
}
boot().catch(failed);
