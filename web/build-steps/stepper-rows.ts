// The core's table of steppers, which the page knows as a module of its own: asked of the module that
// was built for the page, so that what is said of a stepper stands in the core alone. What is told of
// the details of methods is another module: it is fetched when they are first shown.
import type { Plugin } from 'vite';
import type { PleatModule } from '../src/shared/bindings/pleat-module.ts';
import { builtCore } from './built-core.ts';

const ROWS = 'virtual:pleat-steppers';
const DETAILS = 'virtual:pleat-details';

interface Detail {
  key: string;
  words?: { value: string }[];
  [more: string]: unknown;
}

async function tables(): Promise<{ steppers: unknown; details: Detail[] }> {
  const { Scene } = await builtCore<PleatModule>();
  const scene = new Scene('');
  const answer = JSON.parse(scene.steppers());
  scene.delete();
  return answer;
}

/** A detail as links are read by, without its words for people. */
function readable({ key, words, least, most, beside }: Detail): object {
  return { key, words: words?.map(({ value }) => value), least, most, beside };
}

export function stepperRows(): Plugin {
  return {
    name: 'pleat-steppers',
    resolveId: (id) => (id === ROWS || id === DETAILS ? `\0${id}` : null),
    async load(id) {
      if (id !== `\0${ROWS}` && id !== `\0${DETAILS}`) return null;
      const { steppers, details } = await tables();
      if (id === `\0${DETAILS}`) return `export default ${JSON.stringify(details)}`;
      const keys = JSON.stringify(details.map(readable));
      return `export default ${JSON.stringify(steppers)};\nexport const details = ${keys}`;
    },
  };
}
