// The experiments that are shipped, and the meshes that they name.
import type { Collider, Triple } from '../../shared/bindings/geometry';
import type { Term } from './deform-state';

const TEXTS = import.meta.glob<string>('../../../../assets/deform/*.json', {
  query: '?raw',
  import: 'default',
  eager: true,
});
const MESHES = import.meta.glob<string>('../../../../assets/meshes/*.obj', {
  query: '?url',
  import: 'default',
  eager: true,
});

const MOTIONS = import.meta.glob<string>('../../../../assets/motions/{arms_out,walk_normal}.json', {
  query: '?raw',
  import: 'default',
  eager: true,
});

/** The experiment of the visitor's own mesh. */
export const OWN = 'own';

/** A posture of a body; the motion that it is of is named by its file. */
interface Moment {
  motion: unknown;
}

interface DeformFile {
  caption: string;
  cloth: { sheet?: object; mesh?: { obj: string } };
  fabric: string;
  figure?: { at_rest: Moment; posed: Moment };
  handles?: { onto_sphere?: { centre_m: Triple; radius_m: number } }[];
  terms?: Term[];
  [part: string]: unknown;
}

export interface Experiment {
  id: string;
  title: string;
  caption: string;
  fabric: string;
  text: string;
  /** Address of the mesh that it names. */
  meshUrl: string | null;
  /** The bodies that the cloth is drawn onto. */
  bodies: Collider[];
}

/** Experiments in the order in which they are offered; the first one is shown to begin with. */
const TITLES: readonly [string, string][] = [
  ['pull', 'Pulled up at two places'],
  ['ball', 'A ball under the cloth'],
  ['diagonal_stretch', 'Drawn along the diagonal'],
  ['wrinkles', 'Pushed into wrinkles'],
  ['terms', 'Term by term'],
  ['half_skirt', 'Half skirt'],
  ['t_shirt', 'T-shirt'],
];

/** The file with its body's motions written out, as the module reads no other file but a mesh. */
function textWithMotions(text: string, { figure, ...rest }: DeformFile): string {
  if (!figure) return text;
  const writtenOut = (moment: Moment): Moment => {
    const motion =
      MOTIONS[`../../../../assets/motions/${String(moment.motion).replace(/^.*\//, '')}`];
    return motion ? { ...moment, motion: JSON.parse(motion) } : moment;
  };
  const { at_rest, posed } = figure;
  const moments = { at_rest: writtenOut(at_rest), posed: writtenOut(posed) };
  return JSON.stringify({ ...rest, figure: { ...figure, ...moments } });
}

function experimentFrom(id: string, title: string): Experiment | null {
  const text = TEXTS[`../../../../assets/deform/${id}.json`];
  if (!text) return null;
  const file = JSON.parse(text) as DeformFile;
  const mesh = file.cloth.mesh?.obj.replace(/^.*\//, '');
  const bodies = (file.handles ?? []).flatMap(({ onto_sphere: ball }): Collider[] =>
    ball ? [{ shape: 'sphere', centre_m: ball.centre_m, radius_m: ball.radius_m }] : [],
  );
  const meshUrl = mesh ? (MESHES[`../../../../assets/meshes/${mesh}`] ?? null) : null;
  return {
    id,
    title,
    caption: file.caption,
    fabric: file.fabric,
    text: textWithMotions(text, file),
    meshUrl,
    bodies,
  };
}

export const EXPERIMENTS: readonly Experiment[] = TITLES.flatMap(
  ([id, title]) => experimentFrom(id, title) ?? [],
);

/** The visitor's mesh, held by nothing yet. */
export function ownExperiment(fileName: string): Experiment {
  return {
    id: OWN,
    title: 'Your OBJ',
    caption: `${fileName}: pull it anywhere, or pin it first.`,
    fabric: 'linen',
    text: JSON.stringify({ name: fileName, cloth: { mesh: { obj: fileName } }, fabric: 'linen' }),
    meshUrl: null,
    bodies: [],
  };
}
