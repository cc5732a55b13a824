// Two fabrics in motion: the scenes that tell fabrics apart, and the state of their play.
import flagText from '../../../../assets/scenes/flag.json?raw';
import swagsText from '../../../../assets/scenes/swags.json?raw';
import { fabrics } from '../../shared/fabric/fabric-data';
import { createLinkReader, oneOf, slug } from '../../shared/state/link-reader';
import type { InStepState } from '../../shared/workers/in-step';
import { OVERHANG_M, STRIP } from './strips';
import { takeWay } from './ways';

/** Two fabrics, in the order of their panes. */
export type Pair = readonly [string, string];

export const PAIR_STEP_S = 1 / 60;

/** A step of 1/60 s of both takes a few milliseconds by it, on a mesh that folds. */
const METHOD = { stepper: 'multigrid', step_s: PAIR_STEP_S };

interface PairScene {
  title: string;
  /** Sentence on what to notice. */
  caption: string;
  scene: Record<string, unknown>;
  /** How far below its start the cloth goes that begins level [m]. */
  fallsBy: number;
}

export const PAIR_SCENES = {
  swags: {
    title: 'Curtain on three hooks',
    caption:
      'Three hooks draw both curtains together alike. What hangs between the hooks is the fabric’s own.',
    scene: JSON.parse(swagsText) as Record<string, unknown>,
    fallsBy: 0,
  },
  strip: {
    title: 'Strip over an edge',
    caption:
      'Both strips are let go at once: the limper a fabric, the farther its strip swings down.',
    scene: STRIP,
    fallsBy: OVERHANG_M,
  },
  flag: {
    title: 'Flag in the wind',
    caption: 'One wind, with the same gusts, blows on both.',
    scene: JSON.parse(flagText) as Record<string, unknown>,
    fallsBy: 0,
  },
} satisfies Record<string, PairScene>;

export type PairSceneId = keyof typeof PAIR_SCENES;

export const PAIR_SCENE_IDS = Object.keys(PAIR_SCENES) as PairSceneId[];

export interface PairLink {
  scene: PairSceneId;
  pair: Pair;
}

export interface PairState extends InStepState, PairLink {
  /** Largest distance between a place on one cloth and the same place on the other [m]. */
  apartM: number;
  invited: boolean;
}

export function initialPairState(link: PairLink, problem: PairState['problem']): PairState {
  return {
    ...link,
    phase: 'loading',
    playing: false,
    speed: 1,
    timeS: 0,
    apartM: 0,
    invited: true,
    problem,
  };
}

/** Fabrics that differ at a glance in each scene. */
const FIRST: PairLink = { scene: 'swags', pair: ['silk', 'canvas'] };

export function sceneTextOf(id: PairSceneId, fabric: string): string {
  const scene: Record<string, unknown> = PAIR_SCENES[id].scene;
  return JSON.stringify({ ...scene, fabric: { name: fabric }, method: METHOD });
}

function fabricIn(text: string): string | undefined {
  return fabrics.find(({ name_en }) => slug(name_en) === text)?.name_en;
}

export function encodePairLink({ scene, pair }: PairLink): string {
  return `view=fabrics&show=pair&scene=${scene}&fabrics=${pair.map(slug).join('+')}`;
}

export function decodePairLink(hash: string): { link: PairLink; problems: string[] } {
  const reader = createLinkReader(hash.replaceAll('+', '%2B'), 'fabrics');
  takeWay(reader);
  const scene = reader.take('scene', FIRST.scene, PAIR_SCENE_IDS.join(', '), oneOf(PAIR_SCENE_IDS));
  const pair = reader.take<Pair>('fabrics', FIRST.pair, 'two fabrics', (text) => {
    const [a, b, ...more] = text.split('+').map(fabricIn);
    return a && b && more.length === 0 ? [a, b] : undefined;
  });
  return { link: { scene, pair }, problems: reader.finish() };
}
