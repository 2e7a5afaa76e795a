/* Texts and bytes that the build has packed (build.mjs, packed): zipped, and then four bytes as five letters of 85.
 *
 * Invariant: letters are the 85 from # to { without < and \, so that neither an element of the page nor a quoted string has to escape them; the first
 * one counts the bytes by which the last group was filled up.
 */
const digit = (text: string, i: number): number => { const c = text.charCodeAt(i); return c - 35 - Number(c > 60) - Number(c > 92); };

export function unpack(text: string): Response {
  const bytes = new DataView(new ArrayBuffer((text.length - 1) / 5 * 4));
  for (let i = 1, at = 0; i < text.length; at += 4) {
    let n = 0;
    for (const end = i + 5; i < end; i++) n = 85 * n + digit(text, i);
    bytes.setUint32(at, n);
  }
  return new Response(new Blob([new Uint8Array(bytes.buffer, 0, bytes.byteLength - digit(text, 0))]).stream().pipeThrough(new DecompressionStream('gzip')));
}

/** What stands in an element of the page that no browser runs. */
export const unpackElement = (id: string): Response => unpack(document.getElementById(`packed-${id}`)?.textContent ?? '');
