/* What the browser keeps for us. Invariant: where it keeps nothing (private windows, forbidden storage), nothing fails. */
const prefix = 'motus-lab-1:';
let kept = true;

/** From now on nothing is written: the page stands in another page. */
export function forgetful(): void {
  kept = false;
}
export function remember(key: string, value: string): void {
  if (!kept) return;
  try { localStorage.setItem(prefix + key, value); } catch { /* The page works without a memory. */ }
}
export function recall(key: string): string | null {
  try { return localStorage.getItem(prefix + key); } catch { return null; }
}
export function forget(key: string): void {
  if (!kept) return;
  try { localStorage.removeItem(prefix + key); } catch { /* As above. */ }
}
/** Whether the reader loaded the page again: a browser under load may have lost what was stored just before, but it knows this. */
export function loadedAgain(): boolean {
  return performance.getEntriesByType('navigation').some(entry => (entry as PerformanceNavigationTiming).type === 'reload');
}
