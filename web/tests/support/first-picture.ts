// The picture that the view of refinement opens on, computed from the records alone.
import { readFileSync } from 'node:fs';
import { builtCore } from '../../build-steps/built-core.ts';
import type { RefinementModule } from '../../src/refinement/bindings/refinement-module.ts';
import { FINE_LEVEL, FIRST_PICTURE, FRAME_S } from '../../src/refinement/state/garment-frames.ts';
import { readRecording } from '../../src/refinement/worker/recording.ts';

const assets = new URL('../../../assets/', import.meta.url);
const bytesOf = (path: string) => readFileSync(new URL(path, assets));
const textOf = (path: string) => bytesOf(path).toString('utf8');
const jsonOf = (path: string) => JSON.parse(textOf(path));

const { garment, motion, startS } = FIRST_PICTURE;

/** The first picture's scene on a mesh, with the files that it names written out. */
function sceneOf(refinement: object): string {
  const scene = jsonOf(`scenes/garments/${garment}_${motion}.json`);
  const named = (file: string) => JSON.parse(textOf(`scenes/garments/${file}`));
  const figure = { ...scene.figure, motion: named(scene.figure.motion) };
  return JSON.stringify({ ...scene, figure, start: named(scene.start), refinement });
}

function answered<Answer>(text: string): Answer {
  const answer = JSON.parse(text);
  if (!answer.ok) throw new Error(`${answer.where}: ${answer.what}`);
  return answer;
}

/** A pane of the picture. */
export interface ShownMesh {
  mesh: string;
  n_vertices: number;
  /** Distance from the fine cloth, by the same measure for all, root mean square [m]. */
  off_m: number;
  /** Shape that its faces cannot show, with its vertices on the fine cloth [m]. */
  lost_m: number;
  /** Edges that go through the cloth itself. */
  n_crossings: number;
}

/** The three panes of the first picture, the fine one last. */
export async function firstPicture(): Promise<ShownMesh[]> {
  const module = await builtCore<RefinementModule>();
  const plan = jsonOf(`recordings/${garment}_walk/plan.json`);
  const meshes = { coarse: { level: 0 }, planned: { plan }, fine: { level: FINE_LEVEL } };
  const panes = await Promise.all(
    Object.entries(meshes).map(async ([mesh, refinement]) => {
      const run = new module.GarmentRun(textOf('fabrics/fabrics.json'));
      answered(run.load(sceneOf(refinement), {}));
      answered(run.holdAgainst(sceneOf(meshes.fine), {}));
      const bytes = bytesOf(`recordings/${garment}_${motion}/${mesh}.recording`);
      const record = await readRecording(new Uint8Array(bytes), run.parents().slice());
      const places = record?.frames[Math.round(startS / FRAME_S)];
      if (!places) throw new Error(`no frame of ${mesh} at ${startS} s`);
      answered(run.put(places, startS));
      return { mesh, run, places };
    }),
  );
  const fine = panes.at(-1)?.places ?? new Float32Array(0);
  return panes.map(({ mesh, run, places }) => {
    const told = answered<{ rms_m: number; lost_m: number }>(run.compare(fine));
    const { rms_m: off_m, lost_m } = told;
    const { n_crossings } = answered<{ n_crossings: number }>(run.faults());
    run.delete();
    return { mesh, n_vertices: places.length / 3, off_m, lost_m, n_crossings };
  });
}
