/* English. Each part of the page has its file. */
import { frame } from './frame';
import { panel } from './panel';

export const words = {
  frame,
  panel,
} as const;
