// Coarser levels: as the method has them, the same as natively, in a link and in words.
import { describe, expect, it } from 'vitest';
import { levelCounts, levelWords } from '../../src/motion/panels/levels/level-words';
import { followLevels } from '../../src/motion/run/level-source';
import { leftOut } from '../../src/motion/stage/level-overlay';
import { LEVEL_MAKERS, levelWish, makerOf } from '../../src/motion/state/coarse-levels';
import { decodeMotionLink, encodeMotionLink } from '../../src/motion/state/motion-link';
import { initialMotionState } from '../../src/motion/state/motion-state';
import {
  PRESET_IDS,
  presetSetting,
  sceneOf,
  withDetail,
  withStepper,
} from '../../src/motion/state/setting';
import type { SceneSummary } from '../../src/shared/bindings/pleat-module';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { createStore } from '../../src/shared/state/store';
import type { LevelsMessage } from '../../src/shared/workers/motion-protocol';
import { loadFirst } from '../support/built-module';
import { nativeLevels } from '../support/native-command';

const curtain = presetSetting('curtain');

/** So many levels, each of every other vertex of the one before. */
function halved(nMesh: number, nLevels: number): LevelsMessage {
  const levels = Array.from({ length: nLevels }, (_, k) => {
    const all = Uint32Array.from({ length: nMesh }, (_none, v) => v);
    const vertices = all.filter((v) => v % 2 ** (k + 1) === 0);
    return { vertices, edges: vertices.slice(0, 2) };
  });
  return { type: 'levels', levels, shortage: '' };
}

describe('coarser levels', () => {
  it('are those of the method where it has any, else of the one that was chosen', () => {
    expect(LEVEL_MAKERS).toEqual(['hpbd', 'multigrid']);
    expect(makerOf(curtain, 'hpbd')).toBe('hpbd');
    expect(levelWish(curtain, 'hpbd')).toMatchObject({ selection: 'thinned', nCoarser: 3 });
    const usual = { selection: 'quadrics', nCoarser: 3, ratio: 0.25 };
    expect(levelWish(curtain, 'multigrid')).toEqual(usual);
    const multigrid = withStepper(curtain, 'multigrid');
    expect(levelWish(multigrid, 'hpbd')).toEqual(usual);
    const halves = withDetail(withDetail(multigrid, 'levels', 5), 'ratio', 0.5);
    expect(levelWish(halves, 'hpbd')).toEqual({ ...usual, nCoarser: 5, ratio: 0.5 });
  });

  it('of a sheet, drawn curtains and a knit are the same natively', async () => {
    const module = await loadFirst();
    for (const preset of ['curtain', 'wool'] as const) {
      const scene = sceneOf(presetSetting(preset));
      const simulation = new module.Simulation(fabricsText);
      try {
        expect(JSON.parse(simulation.load(JSON.stringify(scene))).ok).toBe(true);
        const { n_coarser } = JSON.parse(simulation.makeLevels('quadrics', 4, 0.25));
        const counts = Array.from({ length: n_coarser + 1 }, (_, level) => ({
          n_vertices: simulation.levelVertices(level).length,
          n_edges: simulation.levelEdges(level).length / 2,
        }));
        const places = Array.from(simulation.exactPositions());
        const own = Array.from(simulation.levelVertices(n_coarser), (v) =>
          places.slice(3 * v, 3 * v + 3),
        );
        const { levels, coarsest } = nativeLevels(scene, ['--levels', '4', '--ratio', '0.25']);
        expect(counts).toEqual(levels);
        simulation.grab(Math.floor(places.length / 6));
        expect(JSON.parse(simulation.makeLevels('quadrics', 4, 0.25)).n_coarser).toBe(n_coarser);
        expect(simulation.levelVertices(1).length).toBe(levels[1]?.n_vertices);
        expect(own.flat().map((metres) => metres.toFixed(6))).toEqual(
          coarsest.flat().map((metres) => metres.toFixed(6)),
        );
      } finally {
        simulation.delete();
      }
    }
  });

  it('are asked for once, and anew for each mesh and for other levels', async () => {
    const { link } = decodeMotionLink('#scene=curtain&coarse=1');
    const store = createStore(initialMotionState(link, []));
    const asked: number[] = [];
    const answers: ((message: LevelsMessage | null) => void)[] = [];
    followLevels(store, ({ nCoarser }) => {
      asked.push(nCoarser);
      return new Promise((resume) => answers.push(resume));
    });
    expect(asked).toEqual([]);
    const summary = { n_vertices: 9 } as SceneSummary;
    store.set({ phase: 'ready', summary });
    expect(asked).toEqual([3]);
    store.set({ coarse: 2 });
    expect(asked).toEqual([3]);
    store.set({ summary: { ...summary } });
    expect(asked).toEqual([3, 3]);
    answers[0]?.(halved(9, 1)); // the mesh before
    await Promise.resolve();
    expect(store.get().coarseLevels).toBeNull();
    answers[1]?.(halved(9, 3));
    await Promise.resolve();
    expect(store.get().coarseLevels?.levels).toHaveLength(3);
    store.set({ setting: withDetail(withStepper(curtain, 'multigrid'), 'levels', 2) });
    expect(asked).toEqual([3, 3, 2]);
    expect(store.get().coarseLevels).toBeNull();
  });

  it('are told in words, with what each leaves out of the one before', () => {
    const found = halved(33, 3);
    expect(levelWords(found, 1, 33)).toBe(
      'Level 1 keeps 17 vertices: of the mesh’s 33 every other one.',
    );
    expect(levelWords(found, 2, 33)).toBe(
      'Level 2 keeps 9 vertices: of the 17 of level 1 every other one, and of the mesh’s 33 one in 3.7.',
    );
    expect(levelCounts(found, 9, 33)).toMatchObject({ level: 3, n: 5, nBefore: 9, nOut: 4 });
    expect(levelWords({ levels: [], shortage: 'no triangles' }, 1, 2)).toContain('no triangles');
    const [first, second] = found.levels;
    if (!first || !second) throw new Error('two levels');
    expect([...leftOut(first, undefined, 6)]).toEqual([1, 3, 5]);
    expect([...leftOut(second, first, 33)]).toEqual([2, 6, 10, 14, 18, 22, 26, 30]);
  });

  it('stand in the link, and are off without it', () => {
    const hash = '#scene=curtain&coarse=2&coarse_as=hpbd';
    const { link, problems } = decodeMotionLink(hash);
    expect(problems).toEqual([]);
    expect(link).toMatchObject({ coarse: 2, coarseAs: 'hpbd' });
    expect(encodeMotionLink(link)).toContain('coarse=2&coarse_as=hpbd');
    expect(decodeMotionLink('#scene=curtain').link).toMatchObject({ coarse: 0 });
    expect(decodeMotionLink('#coarse=x&coarse_as=xpbd').problems).toHaveLength(2);
  });
});

describe('details of a method', () => {
  const changes = { levels: 5, ratio: 0.4, smoother: 'sor', omega: 1.3, attachments: 'none' };
  const changed = Object.entries(changes).reduce(
    (setting, [key, value]) => withDetail(setting, key, value),
    withStepper(curtain, 'multigrid'),
  );

  it('go into the scene and the link where they are not what the stepper starts from', () => {
    expect(changed.details).toEqual(changes);
    expect(sceneOf(changed).method).toMatchObject(changes);
    const { link } = decodeMotionLink('#scene=curtain');
    const text = encodeMotionLink({ ...link, setting: changed });
    expect(text).toContain('levels=5&ratio=0.4&smoother=sor&omega=1.3&attachments=none');
    expect(decodeMotionLink(`#${text}`)).toMatchObject({
      link: { setting: changed },
      problems: [],
    });
    expect(withDetail(changed, 'levels', 3).details).not.toHaveProperty('levels');
    expect(withStepper(changed, 'multigrid').details).toBeUndefined();
  });

  it('are refused in words where a stepper does not read them, or of other values', () => {
    const { problems } = decodeMotionLink('#scene=curtain&stepper=pbd&levels=2&omega=2&smoother=x');
    expect(problems.join()).toContain('levels: not a known part');
    expect(problems.join()).toContain('omega: expected 0.05 to 1.95');
    expect(problems.join()).toContain('smoother: expected none, jacobi, gauss_seidel, lines, sor');
  });

  it('have an omega only beside a smoother that relaxes', () => {
    const plain = withDetail(changed, 'smoother', 'gauss_seidel');
    expect(sceneOf(plain).method).not.toHaveProperty('omega');
  });

  it('of every stepper and value can be loaded', async () => {
    const module = await loadFirst();
    const scene = new module.Scene(fabricsText);
    try {
      const load = (setting: typeof curtain) =>
        JSON.parse(scene.parse(JSON.stringify(sceneOf(setting))));
      for (const preset of PRESET_IDS.filter((id) => id !== 'obj'))
        expect(load(presetSetting(preset)), preset).toMatchObject({ ok: true });
      const answer = load(changed);
      expect(answer.scene.method).toMatchObject(changes);
      const { details } = JSON.parse(scene.steppers());
      expect(details.length).toBeGreaterThan(6);
      for (const { key, title, meaning, words } of details) {
        expect(`${title}${meaning}`, key).toMatch(/[.]$/);
        for (const word of words ?? []) expect(word.title, word.value).toMatch(/^[A-Z]/);
        const reader = withStepper(curtain, key in answer.scene.method ? 'multigrid' : 'pbd');
        for (const { value } of words ?? [])
          expect(load(withDetail(reader, key, value)), value).toMatchObject({ ok: true });
      }
    } finally {
      scene.delete();
    }
  });
});
