/* English. Each part of the page has its file. */
import { frame } from './frame';
import { opened } from './opened';

export const words = {
  frame,
  opened,
} as const;
