// Plans for a garment: the usual one comes with the page, others are made of the recorded example and of
// motions that are run here.
import { fabricsText } from '../../shared/fabric/fabric-data';
import { fetchedBytes } from '../../shared/page/fetched';
import {
  FINE_LEVEL,
  FRAME_S,
  KEPT_OF,
  PATTERNS,
  SEEN_S,
  SETTLED_S,
  USUAL_DEMANDS_MM,
} from '../state/garment-frames';
import {
  exampleName,
  type GarmentId,
  MOTIONS,
  type MotionId,
  sceneText,
  usualFabric,
} from '../state/garments';
import type { PlanFile } from '../state/plan-file';
import type { RefinementState } from '../state/refinement-state';
import type { ExampleScene, PlanWish } from '../worker/garment-protocol';
import { type ExampleClient, startExampleWorker } from './garment-client';
import { exampleUrls } from './records';
import { type FetchBytes, sceneFiles } from './scene-files';

export type Wish = Pick<
  RefinementState,
  'garment' | 'fabric' | 'further' | 'rule' | 'demand' | 'budget'
>;

export function isUsual({ garment, further, rule, demand, budget }: Wish): boolean {
  if (further.length > 0) return false;
  return rule === 'budget' ? budget === null : demand === USUAL_DEMANDS_MM[garment];
}

/** Hears how much of an example has run. */
export type Progress = (motion: MotionId, share: number) => void;

export type Planner = Pick<ExamplePlanner, 'plan' | 'cancel'>;

/** The examples that the worker has, or is getting. */
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

/** The frames of an example that count, when it is run here [s]. */
interface Seen {
  fromS: number;
  toS: number;
}

async function exampleScene(
  garment: GarmentId,
  motion: MotionId,
  fabric: string,
  fetchBytes: FetchBytes,
): Promise<ExampleScene> {
  return {
    fabricsText,
    sceneText: sceneText(garment, motion, fabric, { level: FINE_LEVEL }),
    files: await sceneFiles(garment, fetchBytes),
    name: exampleName(garment, motion, fabric),
    nPatterns: PATTERNS,
  };
}

async function openExample(to: ExampleClient, garment: GarmentId, fetchBytes: FetchBytes) {
  const urls = exampleUrls(garment);
  if (!urls) throw new Error('no example of this garment comes with the page');
  const [features, frames, scene] = await Promise.all([
    fetchBytes(urls.features),
    fetchBytes(urls.frames),
    exampleScene(garment, MOTIONS[0].value, usualFabric(garment), fetchBytes),
  ]);
  await to.ask({ type: 'open', ...scene, features, frames }, [features, frames]);
}

export class ExamplePlanner {
  private client: ExampleClient | null = null;
  private opened: Opened | null = null;
  private progress: Progress = () => undefined;

  constructor(
    private readonly start: () => ExampleClient = startExampleWorker,
    private readonly fetchBytes: FetchBytes = fetchedBytes,
    private readonly seen: Seen = { fromS: SETTLED_S, toS: SETTLED_S + SEEN_S },
  ) {}

  /** Rejects when an example cannot be had. */
  async plan(wish: Wish, progress: Progress = () => undefined): Promise<PlanFile> {
    const { garment, rule, demand, budget } = wish;
    this.progress = progress;
    if (this.opened && !isPartOf(this.opened, wish)) this.cancel();
    if (isUsual(wish)) {
      const plan = await this.usualPlan(garment);
      if (plan) return plan;
    }
    const client = await this.withExamples(wish);
    const asked: PlanWish =
      rule === 'budget' && budget !== null
        ? { max_vertices: budget }
        : { largest_loss_m: demand / 1000 };
    return (await client.ask({ type: 'plan', wish: asked })).plan;
  }

  /** Gives up what is being planned; the next plan starts anew. */
  cancel(): void {
    this.client?.terminate();
    this.client = null;
    this.opened = null;
  }

  private async usualPlan(garment: GarmentId): Promise<PlanFile | null> {
    const urls = exampleUrls(garment);
    if (!urls) return null;
    return JSON.parse(new TextDecoder().decode(await this.fetchBytes(urls.plan))) as PlanFile;
  }

  /** The worker, once it has all examples. */
  private async withExamples(wish: Wish): Promise<ExampleClient> {
    const { garment, fabric, further } = wish;
    this.client ??= this.start();
    const { client } = this;
    const ready = () => openExample(client, garment, this.fetchBytes);
    this.opened ??= { garment, fabric, further: [], ready: ready() };
    const { opened } = this;
    opened.fabric = fabric;
    for (const motion of further.slice(opened.further.length)) {
      opened.ready = opened.ready.then(() => this.run(client, wish, motion));
      opened.further.push(motion);
    }
    try {
      await opened.ready;
    } catch (error) {
      if (this.client === client) this.cancel();
      throw error;
    }
    return client;
  }

  /** Runs one further example to its end. */
  private async run(
    client: ExampleClient,
    { garment, fabric }: Wish,
    motion: MotionId,
  ): Promise<void> {
    this.progress(motion, 0);
    let { share } = await client.ask({
      type: 'begin',
      ...(await exampleScene(garment, motion, fabric, this.fetchBytes)),
      frameS: FRAME_S,
      ...this.seen,
      keptOf: KEPT_OF,
    });
    while (share < 1) {
      this.progress(motion, share);
      share = (await client.ask({ type: 'goOn' })).share;
    }
  }
}
