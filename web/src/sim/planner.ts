// Plans for a garment: the usual one comes with the page, others are made of the recorded example.
import { fabricsText } from '../state/fabric-data';
import { FINE_LEVEL, PATTERNS } from '../state/garment-frames';
import { type GarmentId, SCENE_FILES, sceneText, usualFabric } from '../state/garments';
import type { PlanFile } from '../state/plan-file';
import { DEMANDS, type RefinementState } from '../state/refinement-state';
import { type ExampleClient, startExampleWorker } from './garment-client';
import type { PlanWish } from './garment-protocol';
import { exampleUrls } from './records';

export type Fetched = (url: string) => Promise<ArrayBuffer>;

export async function fetched(url: string): Promise<ArrayBuffer> {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}`.trim());
  return answer.arrayBuffer();
}

export type Wish = Pick<RefinementState, 'garment' | 'rule' | 'demand' | 'budget'>;

export function isUsual({ rule, demand, budget }: Wish): boolean {
  return rule === 'budget' ? budget === null : demand === DEMANDS.usual;
}

export interface Planner {
  /** Rejects when the example cannot be had. */
  plan(wish: Wish): Promise<PlanFile>;
  /** Gives up what is being planned; the next plan starts anew. */
  cancel(): void;
}

export function createPlanner(start = startExampleWorker, fetchBytes: Fetched = fetched): Planner {
  let client: ExampleClient | null = null;
  let opened: { garment: GarmentId; ready: Promise<unknown> } | null = null;
  let request = 0;

  async function open(to: ExampleClient, garment: GarmentId): Promise<void> {
    const urls = exampleUrls(garment);
    if (!urls) throw new Error('no example of this garment comes with the page');
    const [features, frames] = await Promise.all([
      fetchBytes(urls.features),
      fetchBytes(urls.frames),
    ]);
    const scene = sceneText(garment, 'walk', usualFabric(garment), { level: FINE_LEVEL });
    await to.ask(
      {
        type: 'open',
        fabricsText,
        sceneText: scene,
        files: SCENE_FILES,
        name: `${garment}_walk`,
        nPatterns: PATTERNS,
        features,
        frames,
      },
      [features, frames],
    );
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
    async plan(wish) {
      const { garment, rule, demand, budget } = wish;
      if (isUsual(wish)) {
        const plan = await usualPlan(garment);
        if (plan) return plan;
      }
      client ??= start();
      const own = client;
      if (opened?.garment !== garment) opened = { garment, ready: open(own, garment) };
      try {
        await opened.ready;
      } catch (error) {
        if (client === own) forget();
        throw error;
      }
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
