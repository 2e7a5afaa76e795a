/* Names at the ends of curves: which stand together, and how high each stands so that none covers another.
 *
 * Invariant: labels keep their order and their distance, and are moved by the least total of squares (pool adjacent violators; Ayer et al., Annals of
 * Mathematical Statistics 26, 1955); where they fit between low and high, they stay there.
 */

/** wanted: heights, ascending; gap[i]: between label i and label i + 1. */
export function spread(wanted: readonly number[], gap: readonly number[], low: number, high: number): number[] {
  // Without the gaps the question is a regression: the nearest list that does not descend.
  const offset = [0];
  for (let i = 0; i + 1 < wanted.length; i++) offset.push(offset[i]! + (gap[i] ?? 0));
  const blocks: { sum: number; count: number }[] = [];
  wanted.forEach((w, i) => {
    let block = { sum: w - offset[i]!, count: 1 };
    for (let last = blocks[blocks.length - 1]; last && last.sum / last.count > block.sum / block.count; last = blocks[blocks.length - 1]) {
      block = { sum: last.sum + block.sum, count: last.count + block.count };
      blocks.pop();
    }
    blocks.push(block);
  });
  const total = offset[offset.length - 1] ?? 0, top = Math.max(low, high - total);
  return blocks.flatMap(({ sum, count }) => Array.from({ length: count }, () => Math.min(top, Math.max(low, sum / count)))).map((base, i) => base + offset[i]!);
}
