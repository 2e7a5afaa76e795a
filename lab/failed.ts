/* What is said where the page cannot start. */
import { place } from './dom';
import { page } from './words';

export function failed(error: unknown): void {
  console.error(error);
  const message = document.createElement('p');
  message.className = 'message';
  message.setAttribute('role', 'alert');
  message.textContent = page.failed(error instanceof Error ? error.message : String(error));
  place('status').append(message);
}
