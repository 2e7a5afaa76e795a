/* English. Each part of the page has its file. */
import { frame } from './frame';
import { page } from './page';
import { panel } from './panel';
import { study } from './study';

export const words = {
  frame,
  page,
  panel,
  study,
} as const;
