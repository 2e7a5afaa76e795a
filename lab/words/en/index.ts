/* English. Each part of the page has its file. */
import { frame } from './frame';
import { page } from './page';

export const words = {
  frame,
  page,
} as const;
