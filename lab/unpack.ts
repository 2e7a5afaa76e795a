/* Texts and bytes that the build has packed (build.mjs, packed): zipped, and then 13 bits as two letters of 91.
 *
 * Invariant: letters are the 91 from ! to ~ without ", < and \, so that neither an element of the page nor a quoted string has to escape them; the first
 * one counts the bytes by which the last pair goes beyond the end.
 */
const digit = (text: string, i: number): number => { const c = text.charCodeAt(i); return c - 33 - Number(c > 34) - Number(c > 60) - Number(c > 92); };

export function unpack(text: string): Response {
  const bytes = new Uint8Array(Math.floor(13 * (text.length - 1) / 16));
  for (let i = 1, at = 0, held = 0, bits = 0; i < text.length; i += 2) {
    held |= (digit(text, i) + 91 * digit(text, i + 1)) << bits;
    for (bits += 13; bits >= 8; bits -= 8, held >>= 8) bytes[at++] = held & 255;
  }
  return new Response(new Blob([bytes.subarray(0, bytes.length - digit(text, 0))]).stream().pipeThrough(new DecompressionStream('deflate')));
}

/** What stands in an element of the page that no browser runs. */
export const unpackElement = (id: string): Response => unpack(document.getElementById(`packed-${id}`)?.textContent ?? '');
