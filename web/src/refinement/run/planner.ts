// Plans for a garment: the usual one comes with the page, others are made of the recorded example and of
// motions that are run here.
import { fabricsText } from '../../shared/fabric/fabric-data';
import { FINE_LEVEL, FRAME_S, KEPT_OF, PATTERNS, SEEN_S, SETTLED_S } from '../state/garment-frames';
import {
  exampleName,
  type GarmentId,
  MOTIONS,
  type MotionId,
  SCENE_FILES,
  sceneText,
  usualFabric,
} from '../state/garments';
import type { PlanFile } from '../state/plan-file';
import { DEMANDS, type RefinementState } from '../state/refinement-state';
import type { PlanWish } from '../worker/garment-protocol';
import { type ExampleClient, startExampleWorker } from './garment-client';
import { exampleUrls } from './records';

export type Fetched = (url: string) => Promise<ArrayBuffer>;

export async function fetched(url: string): Promise<ArrayBuffer> {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}`.trim());
  return answer.arrayBuffer();
}

export type Wish = Pick<
  RefinementState,
  'garment' | 'fabric' | 'further' | 'rule' | 'demand' | 'budget'
>;

export function isUsual({ further, rule, demand, budget }: Wish): boolean {
  if (further.length > 0) return false;
  return rule === 'budget' ? budget === null : demand === DEMANDS.usual;
}

/** Hears how much of an example has run. */
export type Progress = (motion: MotionId, share: number) => void;

export interface Planner {
  /** Rejects when an example cannot be had. */
  plan(wish: Wish, progress?: Progress): Promise<PlanFile>;
  /** Gives up what is being planned; the next plan starts anew. */
  cancel(): void;
}

/** What the worker has, or is getting. */
interface Opened extends Pick<Wish, 'garment' | 'fabric'> {
  further: MotionId[];
  ready: Promise<unknown>;
}

/** Only what is missing in `opened` has to be run for `wish`. */
function isPartOf(opened: Opened, { garment, fabric, further }: Wish): boolean {
  return (
    opened.garment === garment &&
    (opened.further.length === 0 || opened.fabric === fabric) &&
    opened.further.every((motion, index) => motion === further[index])
  );
}

/** `seen` are the frames of an example that count, when it is run here. */
export function createPlanner(
  start = startExampleWorker,
  fetchBytes: Fetched = fetched,
  seen = { fromS: SETTLED_S, toS: SETTLED_S + SEEN_S },
): Planner {
  let client: ExampleClient | null = null;
  let opened: Opened | null = null;
  let tell: Progress = () => undefined;
  let request = 0;

  async function open(to: ExampleClient, garment: GarmentId): Promise<void> {
    const urls = exampleUrls(garment);
    if (!urls) throw new Error('no example of this garment comes with the page');
    const [features, frames] = await Promise.all([
      fetchBytes(urls.features),
      fetchBytes(urls.frames),
    ]);
    const { value: motion } = MOTIONS[0];
    const fabric = usualFabric(garment);
    await to.ask(
      {
        type: 'open',
        fabricsText,
        sceneText: sceneText(garment, motion, fabric, { level: FINE_LEVEL }),
        files: SCENE_FILES,
        name: exampleName(garment, motion, fabric),
        nPatterns: PATTERNS,
        features,
        frames,
      },
      [features, frames],
    );
  }

  async function run(to: ExampleClient, wish: Wish, motion: MotionId): Promise<void> {
    const { garment, fabric } = wish;
    tell(motion, 0);
    request += 1;
    let answer = await to.ask({
      type: 'begin',
      request,
      fabricsText,
      sceneText: sceneText(garment, motion, fabric, { level: FINE_LEVEL }),
      files: SCENE_FILES,
      name: exampleName(garment, motion, fabric),
      nPatterns: PATTERNS,
      frameS: FRAME_S,
      fromS: seen.fromS,
      toS: seen.toS,
      keptOf: KEPT_OF,
    });
    while (answer.type === 'wentOn' && answer.share < 1) {
      tell(motion, answer.share);
      request += 1;
      answer = await to.ask({ type: 'goOn', request });
    }
  }

  /** The worker, once it has all examples. */
  async function withExamples(wish: Wish): Promise<ExampleClient> {
    const { garment, fabric, further } = wish;
    client ??= start();
    const own = client;
    opened ??= { garment, fabric, further: [], ready: open(own, garment) };
    opened.fabric = fabric;
    for (const motion of further.slice(opened.further.length)) {
      opened.ready = opened.ready.then(() => run(own, wish, motion));
      opened.further.push(motion);
    }
    try {
      await opened.ready;
    } catch (error) {
      if (client === own) forget();
      throw error;
    }
    return own;
  }

  function forget(): void {
    client?.terminate();
    client = null;
    opened = null;
  }

  async function usualPlan(garment: GarmentId): Promise<PlanFile | null> {
    const urls = exampleUrls(garment);
    if (!urls) return null;
    return JSON.parse(new TextDecoder().decode(await fetchBytes(urls.plan))) as PlanFile;
  }

  return {
    async plan(wish, progress = () => undefined) {
      const { garment, rule, demand, budget } = wish;
      tell = progress;
      if (opened && !isPartOf(opened, wish)) forget();
      if (isUsual(wish)) {
        const plan = await usualPlan(garment);
        if (plan) return plan;
      }
      const own = await withExamples(wish);
      const asked: PlanWish =
        rule === 'budget' && budget !== null ? { max_vertices: budget } : { demand };
      request += 1;
      const answer = await own.ask({ type: 'plan', request, wish: asked });
      if (answer.type !== 'planned') throw new Error('no plan came of it');
      return answer.plan;
    },
    cancel: forget,
  };
}
