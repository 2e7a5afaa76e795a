/* The examples of the page: the models of models/. Its build and its tests take them from here. */
import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { join } from 'node:path';

const folder = fileURLToPath(new URL('../models', import.meta.url));

/** { name, text } of each, in the order of their names. */
export const examples = readdirSync(folder).filter((name) => name.endsWith('.motus')).sort()
  .map((name) => ({ name: name.slice(0, -'.motus'.length), text: readFileSync(join(folder, name), 'utf8') }));
