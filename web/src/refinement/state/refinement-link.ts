// The view of refinement to a link and back.

import { fabrics } from '../../shared/fabric/fabric-data';
import { createLinkReader, oneOf, slug } from '../../shared/state/link-reader';
import { SPEEDS } from '../../shared/state/speeds';
import { USUAL_DEMANDS_MM } from './garment-frames';
import {
  GARMENTS,
  type MethodId,
  MOTIONS,
  type MotionId,
  methodsOf,
  usualFabric,
} from './garments';
import {
  COLOURS,
  DEFAULT_LINK,
  DEMANDS,
  MOST_SUBSTEPS,
  type RefinementLink,
  RIVALS,
} from './refinement-state';

const LARGEST_BUDGET = 100000;
const LATEST_START_S = 60;

function demandIn(text: string): number | undefined {
  const value = /^\d(\.\d)?$/.test(text) ? Number(text) : Number.NaN;
  return value >= DEMANDS.least && value <= DEMANDS.most ? value : undefined;
}

function budgetIn(text: string): number | undefined {
  const value = /^\d{1,6}$/.test(text) ? Number(text) : 0;
  return value > 0 && value <= LARGEST_BUDGET ? value : undefined;
}

function substepsIn(text: string): number | undefined {
  const value = /^\d{1,2}$/.test(text) ? Number(text) : 0;
  return value > 0 && value <= MOST_SUBSTEPS ? value : undefined;
}

function startIn(text: string): number | undefined {
  const value = /^\d{1,2}(\.\d{1,3})?$/.test(text) ? Number(text) : Number.NaN;
  return value <= LATEST_START_S ? value : undefined;
}

function motionsIn(text: string): MotionId[] | undefined {
  const names = text.split(',');
  const found = names.flatMap((name) => MOTIONS.find(({ value }) => value === name)?.value ?? []);
  return new Set(found).size === names.length ? found : undefined;
}

/** The part of a link after `#`. */
export function encodeRefinementLink(link: RefinementLink): string {
  const flag = (isOn: boolean) => (isOn ? 'on' : 'off');
  const parts: [string, string][] = [
    ['view', 'refinement'],
    ['garment', link.garment],
    ['motion', link.motion],
    ['fabric', slug(link.fabric)],
    link.rule === 'budget' && link.budget !== null
      ? ['vertices', String(link.budget)]
      : ['lost-mm', String(link.demand)],
    ['beside', link.rival],
    ['records', flag(link.useRecords)],
    ['fine', flag(link.computeFine)],
    ['fine-cloth', flag(link.fineCloth)],
    ['colour', link.colour],
    ['edges', flag(link.edges)],
    ['hanging', flag(link.hanging)],
    ['speed', String(link.speed)],
    ['start', String(Number(link.startS.toFixed(3)))],
  ];
  if (link.method !== 'implicit') parts.push(['method', link.method]);
  if (link.substeps !== null) parts.push(['substeps', String(link.substeps)]);
  if (link.further.length > 0) parts.push(['examples', link.further.join(',')]);
  return parts.map(([key, value]) => `${key}=${value}`).join('&');
}

/** The state a link stands for; `problems` says in words what could not be read. */
export function decodeRefinementLink(hash: string): { link: RefinementLink; problems: string[] } {
  const { take, takeSwitch, finish } = createLinkReader(hash, 'refinement');
  const valuesOf = <Value>(options: readonly { value: Value }[]) =>
    options.map(({ value }) => value);
  const usual = DEFAULT_LINK;
  const garments = valuesOf(GARMENTS);
  const garment = take('garment', usual.garment, garments.join(', '), oneOf(garments));
  const motions = valuesOf(MOTIONS);
  const motion = take('motion', usual.motion, motions.join(', '), oneOf(motions));
  const fabric = take('fabric', usualFabric(garment), 'the name of a fabric', (text) => {
    return fabrics.find(({ name_en: name }) => slug(name) === text)?.name_en;
  });
  const further = take('examples', usual.further, `some of ${motions.join(', ')}`, motionsIn);
  const demand = take(
    'lost-mm',
    USUAL_DEMANDS_MM[garment],
    `${DEMANDS.least} to ${DEMANDS.most} in tenths`,
    demandIn,
  );
  const budget = take<number | null>('vertices', null, 'a number of vertices', budgetIn);
  const methods = methodsOf(garment);
  const link: RefinementLink = {
    garment,
    motion,
    fabric,
    further,
    rule: budget === null ? 'demand' : 'budget',
    demand,
    budget,
    rival: take('beside', usual.rival, RIVALS.join(', '), oneOf(RIVALS)),
    method: take<MethodId>('method', usual.method, methods.join(', '), oneOf(methods)),
    substeps: take<number | null>('substeps', null, `1 to ${MOST_SUBSTEPS}`, substepsIn),
    useRecords: takeSwitch('records', usual.useRecords),
    computeFine: takeSwitch('fine', usual.computeFine),
    fineCloth: takeSwitch('fine-cloth', usual.fineCloth),
    colour: take('colour', usual.colour, COLOURS.join(', '), oneOf(COLOURS)),
    edges: takeSwitch('edges', usual.edges),
    hanging: takeSwitch('hanging', usual.hanging),
    speed: take<number>('speed', usual.speed, SPEEDS.join(', '), oneOf(SPEEDS)),
    startS: take('start', usual.startS, 'a time in seconds', startIn),
  };
  return { link, problems: finish() };
}
