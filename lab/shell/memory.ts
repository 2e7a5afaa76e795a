/* What the browser keeps for us. Invariant: where it keeps nothing (private windows, forbidden storage), nothing fails. */
const prefix = 'motus-lab-1:';

export function remember(key: string, value: string): void {
  try { localStorage.setItem(prefix + key, value); } catch { /* The page works without a memory. */ }
}
export function recall(key: string): string | null {
  try { return localStorage.getItem(prefix + key); } catch { return null; }
}
export function forget(key: string): void {
  try { localStorage.removeItem(prefix + key); } catch { /* As above. */ }
}
