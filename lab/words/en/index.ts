/* English. Each part of the page has its file. */
import { frame } from './frame';

export const words = {
  frame,
} as const;
