import { describe, expect, it } from 'vitest';
import type { ClothAnswer } from '../../src/fabrics/bindings/deform-module';
import { columnsFor } from '../../src/fabrics/panels/pane-badges';
import { titleOf } from '../../src/fabrics/state/fabric-choice';
import {
  decodeFabricsLink,
  encodeFabricsLink,
  linkedHolds,
} from '../../src/fabrics/state/fabrics-link';
import { heldBy, initialFabricsState } from '../../src/fabrics/state/fabrics-state';
import { holdAt, holdsOf, joined, middleOf } from '../../src/fabrics/state/holds';
import { fabrics } from '../../src/shared/fabric/fabric-data';
import { slug } from '../../src/shared/state/link-reader';

/** A strip of five squares in the plane: vertices 0 to 5 below, 6 to 11 above. */
const rest = [0, 1].flatMap((y) => [0, 1, 2, 3, 4, 5].flatMap((x) => [x, y, 0]));
const triangles = Uint32Array.from(
  [0, 1, 2, 3, 4].flatMap((x) => [x, x + 1, x + 7, x, x + 7, x + 6]),
);
const cloth: ClothAnswer = {
  name: 'strip',
  caption: '',
  n_vertices: 12,
  n_triangles: 10,
  rest_m: rest,
  grasp_m: 1,
  groups: [{ name: 'left_edge', vertices: [0, 6] }],
  pins: [0, 4, 5, 6],
  handles: [{ name: 'middle', vertices: [2, 8], places_m: [2, 0, 1, 2, 1, 1] }],
  fabric: 'linen',
};

describe('holds', () => {
  it('tells pins apart that do not hang together, by name where they are a group', () => {
    const holds = holdsOf(cloth, triangles);
    expect(holds.map(({ name, kind }) => `${kind} ${name}`)).toEqual([
      'pin left edge',
      'pin pin 2',
      'handle middle',
    ]);
    expect(holds[1]?.vertices).toEqual([4, 5]);
  });

  it('joins them in ascending order, each vertex where its hold was moved to', () => {
    const holds = holdsOf(cloth, triangles).map((hold) =>
      hold.kind === 'handle' ? { ...hold, offset: [0, 0, 0.5] as [number, number, number] } : hold,
    );
    const { vertices, places } = joined(holds);
    expect([...vertices]).toEqual([0, 2, 4, 5, 6, 8]);
    expect([...places.slice(3, 6)]).toEqual([2, 0, 1.5]);
    expect(middleOf(holds[2] ?? fail())).toEqual([2, 0.5, 1.5]);
  });

  it('takes what rests within a grasp and nobody holds', () => {
    const others = holdsOf(cloth, triangles);
    expect(holdAt(cloth, 3, 'handle', others)?.vertices).toEqual([3, 9]);
    expect(holdAt(cloth, 2, 'handle', others)).toBeNull();
    expect(holdAt(cloth, 1, 'pin', [])?.vertices).toEqual([0, 1, 2, 7]);
  });
});

function fail(): never {
  throw new Error('not there');
}

/** A state at a link with this strip as its cloth. */
function stateAt(hash: string) {
  const { link, problems } = decodeFabricsLink(hash);
  const own = holdsOf(cloth, triangles);
  const { holds, problems: unfitting } = linkedHolds(own, cloth, link);
  const state = {
    ...initialFabricsState(link, problems),
    cloth,
    ownHolds: own,
    ...heldBy(holds),
  };
  return { state, problems, unfitting };
}

describe('fabrics-link', () => {
  it('reads its own text back', () => {
    const hash =
      '#view=fabrics&scene=ball&fabrics=silk+own:0.98,1.1,0.97&gallery=off&order=weight&form=published&terms=recovery+bending&weights=published&chosen=1&edges=on&held=middle:0.1,0,-0.02;h3:0,1,0;p10:0,0,0.25&free=left-edge';
    const { state, problems } = stateAt(hash);
    expect(problems).toEqual([]);
    expect(state.pins.map(({ name }) => name)).toEqual(['pin 2', 'point 10']);
    expect(state.holds.filter(({ kind }) => kind === 'handle').map(({ offset }) => offset)).toEqual(
      [
        [0.1, 0, -0.02],
        [0, 1, 0],
      ],
    );
    expect(`#${encodeFabricsLink(state)}`).toBe(hash);
  });

  it('gives defaults and one sentence each for what cannot be read', () => {
    const { state, problems } = stateAt(
      '#view=fabrics&scene=moon&fabrics=tin&terms=&chosen=9&held=h3:1,2&free=x&tail=1',
    );
    expect(problems.length).toBe(6);
    expect(state.compared.map(titleOf)).toEqual(['silk', 'linen']);
    expect(state.terms).toEqual({ recovery: true, stretch: true, bending: true });
  });

  it.each([
    ['held=h99:0,0,1', /no vertex 99/],
    ['held=p2:0,0,1', /vertex 2 is held already/],
    ['held=nobody:0,0,1', /nothing is called "nobody"/],
    ['held=middle:0,1e200,0', /middle is too far away/],
    ['free=nobody', /nothing is called "nobody"/],
  ])('leaves out of %s what does not fit this cloth, and says so', (part, sentence) => {
    const { state, problems, unfitting } = stateAt(`#view=fabrics&${part}`);
    expect(problems).toEqual([]);
    expect(unfitting).toHaveLength(1);
    expect(unfitting[0]).toMatch(sentence);
    expect(state.holds.at(-1)).toMatchObject({ name: 'middle', offset: [0, 0, 0] });
    expect(state.pins.length).toBe(2);
  });

  it('lists the fabrics that there are when one is unknown', () => {
    const { state, problems } = stateAt('#view=fabrics&scene=ball&fabrics=silk+tin');
    expect(state.compared).toEqual([{ kind: 'named', name: 'linen' }]);
    for (const { name_en } of fabrics) expect(problems.join()).toContain(slug(name_en));
  });

  it.each(['silk+silk', 'own:1,1,1+own:0.9,1,1', 'own:-1,1,1', 'own:0.9,1.1,11'])(
    'takes no fabrics %s',
    (text) => {
      expect(stateAt(`#view=fabrics&fabrics=${text}`).problems).toHaveLength(1);
    },
  );

  it('puts opposites side by side for a first visit, and one fabric in other experiments', () => {
    expect(stateAt('#view=fabrics').state.panes.length).toBe(2);
    expect(stateAt('#view=fabrics&scene=ball').state.panes.length).toBe(1);
  });

  it('shows all fifteen in a gallery, and what was compared after it', () => {
    const { state } = stateAt('#view=fabrics&fabrics=silk+wool&gallery=on&chosen=14');
    expect(state.panes.length).toBe(15);
    expect(state.compared.length).toBe(2);
  });
});

describe('panes', () => {
  it.each([
    [1, 900, 600, 1],
    [2, 900, 600, 2],
    [3, 300, 600, 1],
    [4, 300, 600, 2],
    [15, 900, 600, 5],
    [15, 300, 600, 3],
  ])('%i on %i x %i stand in %i columns', (nPanes, width, height, nColumns) => {
    expect(columnsFor(nPanes, width, height)).toBe(nColumns);
  });
});
