/* English. Each part of the page has its file. */
import { frame } from './frame';
import { page } from './page';
import { panel } from './panel';

export const words = {
  frame,
  page,
  panel,
} as const;
