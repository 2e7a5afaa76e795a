/* English. Each part of the page has its file; page, computed, faults and html stand alone (../index.ts). */
import { address } from './address';
import { cards } from './cards';
import { dock } from './dock';
import { editor } from './editor';
import { events } from './events';
import { figure } from './figure';
import { frame } from './frame';
import { gallery } from './gallery';
import { headline } from './headline';
import { lecture } from './lecture';
import { lesson } from './lesson';
import { methods } from './methods';
import { opened } from './opened';
import { panel } from './panel';
import { scenes } from './scenes';
import { section } from './section';
import { share } from './share';
import { stage } from './stage';
import { study } from './study';
import { top } from './top';
import { trouble } from './trouble';

export const words = {
  address,
  cards,
  dock,
  editor,
  events,
  figure,
  frame,
  gallery,
  headline,
  lecture,
  lesson,
  methods,
  opened,
  panel,
  scenes,
  section,
  share,
  stage,
  study,
  top,
  trouble,
} as const;
