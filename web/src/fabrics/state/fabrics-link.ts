// The view of fabrics to a link and back: experiment, fabrics, terms, and what was moved by hand.
import type { Triple } from '../../shared/bindings/geometry';
import { fabrics } from '../../shared/fabric/fabric-data';
import { createLinkReader, oneOf, slug } from '../../shared/state/link-reader';
import { type DeformState, type FabricChoice, TERMS, type Term } from './deform-state';
import { EXPERIMENTS, OWN } from './experiments';
import { LARGEST_RATIO, MOST_COMPARED, titleOf } from './fabric-choice';
import { perTerm } from './fabric-geometry';
import { type FabricOrder, ORDERS } from './fabric-order';
import type { FabricsLink, FabricsState, LinkedHold } from './fabrics-state';
import { type HeldCloth, type Hold, holdAt } from './holds';
import { takeWay } from './ways';

/** More would make a link of thousands of letters. */
const MOST_HOLDS = 40;

/** Significant digits of a move in a link. */
const DIGITS = 5;

/** A thousand times the size of the cloth: no hand goes there, and its squares are still numbers. */
const FARTHEST_GRASPS = 20000;

/** Opposites, side by side for whoever comes without a wish. */
const FIRST_FABRICS: readonly FabricChoice[] = ['silk', 'linen'].map((name) => ({
  kind: 'named',
  name,
}));

/** Letter before the number of a vertex. */
const LETTERS = { pin: 'p', handle: 'h' } as const;

function measuresText({ recovery, stretch, bending }: Record<Term, number>): string {
  return `own:${[recovery, stretch, bending].join()}`;
}

function choiceText(choice: FabricChoice): string {
  return choice.kind === 'own' ? measuresText(choice.measures) : slug(choice.name);
}

function numbersIn(text: string | undefined): number[] {
  return (text ?? '').split(',').map((part) => (part.trim() === '' ? Number.NaN : Number(part)));
}

function vectorIn(text: string | undefined): Triple | undefined {
  const [x, y, z, ...rest] = numbersIn(text);
  if (x === undefined || y === undefined || z === undefined || rest.length > 0) return undefined;
  return [x, y, z].every(Number.isFinite) ? [x, y, z] : undefined;
}

const FABRICS_EXPECTED = `one to ${MOST_COMPARED} different ones of ${fabrics
  .map((fabric) => slug(fabric.name_en))
  .join(', ')}, or own: with three ratios above 0 and at most ${LARGEST_RATIO}`;

function choiceIn(text: string): FabricChoice | undefined {
  if (text.startsWith('own:')) {
    const measures = vectorIn(text.slice('own:'.length));
    if (!measures?.every((ratio) => ratio > 0 && ratio <= LARGEST_RATIO)) return undefined;
    const [recovery, stretch, bending] = measures;
    return { kind: 'own', measures: { recovery, stretch, bending } };
  }
  const found = fabrics.find((fabric) => slug(fabric.name_en) === text);
  return found && { kind: 'named', name: found.name_en };
}

/** All of them, or undefined when one cannot be read. */
function allOf<Value>(
  text: string,
  separator: string,
  read: (part: string) => Value | undefined,
): Value[] | undefined {
  if (text === '') return [];
  const values = text.split(separator).map(read);
  const known = values.filter((value): value is Value & {} => value !== undefined);
  return known.length === values.length ? known : undefined;
}

function holdIn(text: string): LinkedHold | undefined {
  const [name = '', move] = text.split(':');
  const offset = vectorIn(move);
  if (!offset) return undefined;
  const [, letter, vertex] = /^([ph])(\d{1,7})$/.exec(name) ?? [];
  if (vertex === undefined) return { by: name, offset };
  return { by: { kind: letter === 'p' ? 'pin' : 'handle', vertex: Number(vertex) }, offset };
}

function holdText({ name, kind, vertex, offset }: Hold): string {
  const move = offset.map((metres) => Number(metres.toPrecision(DIGITS))).join();
  return `${vertex === null ? slug(name) : LETTERS[kind] + vertex}:${move}`;
}

function isMoved({ vertex, offset }: Hold): boolean {
  return vertex !== null || offset.some((metres) => metres !== 0);
}

/** The part of a link after `#`. */
export function encodeFabricsLink(state: FabricsState): string {
  const present = state.holds;
  const names = new Set(present.map((hold) => hold.name));
  const released = state.ownHolds.filter((hold) => !names.has(hold.name));
  const terms = TERMS.filter((term) => state.terms[term]);
  const parts: [string, string][] = [
    ['view', 'fabrics'],
    ['scene', state.experiment],
    ['fabrics', state.compared.map(choiceText).join('+')],
    ['gallery', state.gallery ? 'on' : 'off'],
    ['order', state.order],
    ['form', state.form],
    ['terms', terms.join('+')],
    ['weights', state.weightsFrom],
    ['chosen', String(state.chosen)],
    ['edges', state.edges ? 'on' : 'off'],
  ];
  const texts = present.filter(isMoved).map(holdText);
  if (texts.length > 0) parts.push(['held', texts.join(';')]);
  if (released.length > 0) parts.push(['free', released.map((hold) => slug(hold.name)).join(';')]);
  return parts.map(([key, value]) => `${key}=${value}`).join('&');
}

/** The state a link stands for; `problems` says in words what could not be read. */
export function decodeFabricsLink(hash: string): { link: FabricsLink; problems: string[] } {
  // A plus is a plus here, not a space.
  const reader = createLinkReader(hash.replaceAll('+', '%2B'), 'fabrics');
  const { take, takeSwitch, finish } = reader;
  takeWay(reader);
  const ids = EXPERIMENTS.map(({ id }) => id);
  const first = ids[0] ?? OWN;
  const experiment = take('scene', first, `${ids.join(', ')} (a link carries no OBJ)`, oneOf(ids));
  const usual: FabricChoice = {
    kind: 'named',
    name: EXPERIMENTS.find(({ id }) => id === experiment)?.fabric ?? 'linen',
  };
  const compared = take<FabricChoice[]>(
    'fabrics',
    experiment === first ? [...FIRST_FABRICS] : [usual],
    FABRICS_EXPECTED,
    (list) => {
      const choices = allOf(list, '+', choiceIn);
      const n = new Set(choices?.map(titleOf)).size;
      return n > 0 && n <= MOST_COMPARED && n === choices?.length ? choices : undefined;
    },
  );
  const gallery = takeSwitch('gallery');
  const order = take<FabricOrder>('order', 'source', ORDERS.join(', '), oneOf(ORDERS));
  const form = take<DeformState['form']>(
    'form',
    'consistent',
    'consistent or published',
    oneOf(['consistent', 'published']),
  );
  const terms = take<readonly Term[]>('terms', TERMS, 'one term or more', (list) => {
    const known = allOf(list, '+', oneOf(TERMS));
    return known && known.length > 0 ? known : undefined;
  });
  const weightsFrom = take<DeformState['weightsFrom']>(
    'weights',
    'recomputed',
    'recomputed or published',
    oneOf(['recomputed', 'published']),
  );
  const nPanes = gallery ? fabrics.length : compared.length;
  const panes = Array.from({ length: nPanes }, (_, pane) => pane);
  const chosen = take('chosen', 0, `0 to ${nPanes - 1}`, oneOf(panes));
  const edges = takeSwitch('edges');
  const moved = take<LinkedHold[]>('held', [], 'names or vertices with moves', (list) => {
    const known = allOf(list, ';', holdIn);
    return known && known.length <= MOST_HOLDS ? known : undefined;
  });
  const released = take<string[]>('free', [], 'names', (list) => list.split(';'));
  const link: FabricsLink = {
    experiment,
    compared,
    gallery,
    order,
    form,
    terms: perTerm((term) => terms.includes(term)),
    weightsFrom,
    chosen,
    edges,
    moved,
    released,
  };
  return { link, problems: finish() };
}

function isWithinReach({ grasp_m }: HeldCloth, offset: Triple): boolean {
  return Math.hypot(...offset) <= FARTHEST_GRASPS * grasp_m;
}

/** The hold that a link puts there; one phrase if it does not fit. */
function addedHold(
  cloth: HeldCloth,
  { by, offset }: LinkedHold,
  present: readonly Hold[],
): Hold | string {
  if (typeof by === 'string') return `held: nothing is called "${by}"`;
  const { vertex, kind } = by;
  if (vertex >= cloth.rest_m.length / 3) return `held: the cloth has no vertex ${vertex}`;
  const hold = holdAt(cloth, vertex, kind, present);
  return hold ? { ...hold, offset } : `held: vertex ${vertex} is held already`;
}

/** An experiment's holds as a link has them; `problems` says what does not fit this cloth. */
export function linkedHolds(
  own: readonly Hold[],
  cloth: HeldCloth,
  { moved, released }: Pick<FabricsLink, 'moved' | 'released'>,
): { holds: Hold[]; problems: string[] } {
  const names = own.map(({ name }) => slug(name));
  const problems = released
    .filter((name) => !names.includes(name))
    .map((name) => `free: nothing is called "${name}"`);
  const holds = own.filter(({ name }) => !released.includes(slug(name)));
  for (const move of moved) {
    const index = holds.findIndex(({ name }) => slug(name) === move.by);
    const known = holds[index];
    const hold = known ? { ...known, offset: move.offset } : addedHold(cloth, move, holds);
    if (typeof hold === 'string') problems.push(hold);
    else if (!isWithinReach(cloth, move.offset))
      problems.push(`held: ${hold.name} is too far away`);
    else holds.splice(known ? index : holds.length, 1, hold);
  }
  return { holds, problems };
}
