import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { linkSentence } from '../../src/motion/panels/link-tool';
import { errorWords } from '../../src/motion/panels/numbers/error-words';
import { MotionRun } from '../../src/motion/run/motion-run';
import type { StartObj } from '../../src/motion/run/obj-client';
import { backWords } from '../../src/motion/run/run-words';
import { decodeMotionLink, encodeMotionLink, linkTo } from '../../src/motion/state/motion-link';
import { initialMotionState, shownHeat } from '../../src/motion/state/motion-state';
import { presetSetting, withModel, withStepper } from '../../src/motion/state/setting';
import { stepCostAt } from '../../src/motion/state/step-cost';
import { readObj } from '../../src/motion/worker/obj-core';
import type { FromObj, ToObj } from '../../src/motion/worker/obj-protocol';
import { frameViews } from '../../src/shared/bindings/frame';
import type { PleatModule } from '../../src/shared/bindings/pleat-module';
import { createStore } from '../../src/shared/state/store';
import { createAsked } from '../../src/shared/workers/asked';
import type { StartMotion } from '../../src/shared/workers/motion-client';
import { MotionCore } from '../../src/shared/workers/motion-core';
import type { FromMotion, ToMotion } from '../../src/shared/workers/motion-protocol';
import { loadFirst } from '../support/built-module';
import diverging from '../support/diverging.json';
import { createFakeModule, FRAGILE_STEPS } from '../support/fake-module';
import { stubLocks } from '../support/locks';
import { workerPort } from '../support/worker-port';

// The worker is a core in this thread, whose answers come later, as a worker's do.
let module: PleatModule;
let changeScene = (scene: Record<string, unknown>) => scene;
/** Messages that the worker never comes to an end with. */
let hangsAt: (message: ToMotion) => boolean = () => false;
const start: StartMotion = (listener) =>
  createAsked(
    workerPort<ToMotion, FromMotion>((post) => {
      const core = new MotionCore(module, post);
      return {
        receive(message) {
          if (hangsAt(message)) return new Promise(() => undefined);
          if (message.type !== 'load') return core.receive(message);
          const scene = changeScene(JSON.parse(message.sceneText));
          core.receive({ ...message, sceneText: JSON.stringify(scene) });
        },
        close: () => core.close(),
      };
    }),
    listener,
  );

let isReadingStuck = false; // a file that takes for ever
const startObj: StartObj = (listener) =>
  createAsked(
    workerPort<ToObj, FromObj>((post) => ({
      receive: (message) =>
        isReadingStuck ? new Promise(() => undefined) : post(readObj(module, message), []),
    })),
    listener,
  );

/** A run at a link, with the frame that is shown. */
function open(hash: string) {
  const { link, problems } = decodeMotionLink(hash);
  const store = createStore(initialMotionState(link, problems));
  let shown = { positions: new Float32Array(0), values: new Float32Array(0), scalar: '' };
  const meshes: object[] = [];
  const run = new MotionRun(
    store,
    {
      showMesh: (_, nVertices, change) => meshes.push({ nVertices, change }),
      showFrame(buffer, scalar) {
        const views = frameViews(buffer);
        shown = { positions: views.positions.slice(), values: views.scalar.slice(), scalar };
      },
    },
    start,
    startObj,
  );
  return { store, run, shown: () => shown, meshes: () => meshes };
}

const phaseOf = ({ store }: ReturnType<typeof open>) => store.get().phase;

beforeEach(() => {
  vi.stubGlobal('requestAnimationFrame', (work: () => void) => setTimeout(work, 1));
  vi.stubGlobal('cancelAnimationFrame', clearTimeout);
  hangsAt = () => false;
});

describe('motion run of a run that diverges', () => {
  it('says in which step and where, keeps the last finite frame, and resets', async () => {
    module = createFakeModule().module;
    changeScene = (scene) => ({ ...scene, name: 'fragile' });
    const page = open('#scene=swinging-sheet&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    const start = page.shown().positions;
    page.run.play();
    await vi.waitUntil(() => phaseOf(page) === 'stopped');
    const { problem, playing, numbers } = page.store.get();
    expect(playing).toBe(false);
    expect(numbers?.step).toBe(FRAGILE_STEPS);
    expect(problem?.source).toBe('run');
    expect(problem?.sentence).toContain(`in step ${FRAGILE_STEPS + 1}`);
    expect(problem?.sentence).toContain('vertex 3');
    const place = Array.from(page.shown().positions.subarray(9, 12), (metres) => metres.toFixed(2));
    expect(problem?.sentence).toContain(`(${place.join(', ')}) m`);
    expect(page.shown().positions).not.toEqual(start);

    page.run.reset();
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get()).toMatchObject({ problem: null, numbers: { step: 0 } });
    expect(page.shown().positions).toEqual(start);
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
  });

  it('does so with the WebAssembly module', async () => {
    module = await loadFirst();
    changeScene = (scene) => ({ ...scene, ...diverging });
    const page = open('#scene=swinging-sheet&level=0&stepper=explicit');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    const start = page.shown().positions;
    page.run.play();
    await vi.waitUntil(() => phaseOf(page) === 'stopped', 20000);
    const { problem, numbers } = page.store.get();
    expect(numbers?.time_s).toBeCloseTo(0.2, 9);
    expect(problem?.sentence).toMatch(/in step 13, .*vertex \d+ .*0\.2.* It was last at \(/);
    expect(page.shown().positions.every((metres) => Math.abs(metres) < 3)).toBe(true);
    page.run.reset();
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get().problem).toBeNull();
    expect(page.shown().positions).toEqual(start);
  });
});

describe('motion run', () => {
  beforeEach(() => {
    module = createFakeModule().module;
    changeScene = (scene) => scene;
  });

  it('keeps the motion over a change of level, and not over one of the scene', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
    const { setting } = page.store.get();
    page.store.set({ setting: { ...setting, level: 1 } });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get().numbers?.step).toBe(1);
    page.store.set({ setting: { ...setting, preset: 'tablecloth' } });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get().numbers?.step).toBe(0);
  });

  it('starts anew when the model changes', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
    page.store.set({ setting: withModel(page.store.get().setting, 'membrane') });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get().numbers?.step).toBe(0);
  });

  it('answers a refused setting with the sentence, and the next good one clears it', async () => {
    const page = open('#scene=curtain&level=0&stepper=explicit');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    const { setting } = page.store.get();
    page.store.set({ setting: { ...setting, substeps: 1 } });
    await vi.waitUntil(() => phaseOf(page) === 'refused');
    expect(page.store.get().problem?.sentence).toContain('a step of it takes 300');
    page.store.set({ setting });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get().problem).toBeNull();
  });

  it('shows the cloth of a setting that is refused at once, and offers what helps', async () => {
    const page = open('#scene=curtain&level=1&stepper=explicit&substeps=1');
    await vi.waitUntil(() => phaseOf(page) === 'refused' && page.shown().positions.length > 0);
    expect(page.shown().positions).toHaveLength(3 * 25);
    const remedy = page.store.get().problem?.remedy;
    expect(remedy?.setting.substeps).toBe(0);
    if (remedy) page.store.set({ setting: remedy.setting });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get().problem).toBeNull();
  });

  it('runs to the very step of a link, however long it takes, and tells what the frame shows', async () => {
    const page = open('#scene=curtain&level=0&steps=400');
    await vi.waitUntil(() => page.store.get().ahead !== null);
    await vi.waitUntil(() => page.store.get().ahead === null && phaseOf(page) === 'ready');
    expect(page.store.get().numbers?.step).toBe(400);
    page.run.play();
    await vi.waitUntil(() => (page.store.get().numbers?.step ?? 0) > 400);
    await page.run.rest();
    const { numbers } = page.store.get();
    const again = open(`#${encodeMotionLink(linkTo(page.store.get()))}`);
    await vi.waitUntil(() => again.store.get().numbers?.step === numbers?.step);
    await vi.waitUntil(() => again.store.get().ahead === null);
    expect(again.shown().positions).toEqual(page.shown().positions);
  });

  it('says where the way to the start was stopped', async () => {
    const page = open('#scene=curtain&level=0&steps=3600');
    await vi.waitUntil(() => (page.store.get().numbers?.step ?? 0) > 0);
    page.run.stopWork();
    const { problem, numbers, ahead } = page.store.get();
    expect(ahead).toBeNull();
    expect(problem?.sentence).toBe(
      `Stopped at ${numbers?.time_s.toFixed(2)} s, on the way to 60.00 s.`,
    );
  });

  it('starts anew for another link, whatever moved before', async () => {
    const page = open('#scene=curtain&level=0&steps=9');
    await vi.waitUntil(() => page.store.get().numbers?.step === 9);
    const { link } = decodeMotionLink('#scene=curtain&level=1&steps=4');
    page.run.showAnew(link);
    await vi.waitUntil(() => page.store.get().numbers?.step === 4);
    expect(page.store.get().setting.level).toBe(1);
  });

  it('keeps an account of energy while it is open, anew from each start', async () => {
    const page = open('#scene=curtain&level=0');
    const times = () => page.store.get().energies.map(({ time_s }) => Math.round(60 * time_s));
    const stepTo = async (step: number) => {
      page.run.step();
      await vi.waitUntil(() => page.store.get().numbers?.step === step);
    };
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await stepTo(1);
    expect(times()).toEqual([]);
    page.store.set({ energy: true });
    await vi.waitUntil(() => times().length === 1);
    await stepTo(2);
    await stepTo(3);
    expect(times()).toEqual([1, 2, 3]);
    page.run.reset();
    await vi.waitUntil(() => phaseOf(page) === 'ready' && times().length === 1);
    expect(times()).toEqual([0]);
    page.store.set({ energy: false });
    await stepTo(1);
    expect(times()).toEqual([]);
  });

  it('begins the account at the start of a run that plays or runs ahead', async () => {
    const ahead = open('#scene=curtain&level=0&energy=on&steps=20');
    await vi.waitUntil(() => ahead.store.get().numbers?.step === 20);
    const aheadTimes = ahead.store.get().energies.map(({ time_s }) => Math.round(60 * time_s));
    expect(aheadTimes).toEqual(Array.from({ length: 21 }, (_, step) => step));
    const played = open('#scene=curtain&level=0&energy=on');
    played.run.play();
    await vi.waitUntil(() => played.store.get().energies.length > 1);
    expect(played.store.get().energies.at(0)?.time_s).toBe(0);
    played.run.pause();
  });

  it('knows which springs are implicit, anew for each step and hand', async () => {
    const page = open('#scene=curtain&level=0&stepper=imex&springs=on');
    const split = () => Array.from(page.store.get().springSplit?.isImplicit ?? []).join('');
    await vi.waitUntil(() => split() === '10');
    page.run.grab(3);
    await vi.waitUntil(() => split() === '01');
    page.run.releaseGrab();
    await vi.waitUntil(() => split() === '10');
    page.store.set({ springSplit: null });
    const { setting } = page.store.get();
    page.store.set({ setting: { ...setting, substeps: setting.substeps + 1 } });
    await vi.waitUntil(() => split() === '10');
    page.store.set({ setting: withStepper(setting, 'xpbd') });
    await vi.waitUntil(() => split() === '');
    expect(page.store.get().springSplit?.ends).toHaveLength(4);
  });

  it('shows the mesh of torn cloth before its frame, and asks for its springs', async () => {
    const page = open('#scene=tearing-curtain&level=0&stepper=imex&springs=on');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    const whole = page.shown().values.length;
    expect(page.meshes()).toEqual([{ nVertices: whole, change: 'scene' }]);
    const isSplit = () => Array.from(page.store.get().springSplit?.isImplicit ?? []).join('');
    page.run.grab(whole - 1);
    await vi.waitUntil(() => isSplit() === '01');
    page.store.set({ springSplit: null });
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
    await vi.waitUntil(() => isSplit() === '01');
    expect(page.shown().values.length).toBe(whole + 1);
    expect(page.meshes().at(-1)).toEqual({ nVertices: whole + 1, change: 'tear' });
    expect(page.store.get()).toMatchObject({ held: true, summary: { n_vertices: whole + 1 } });
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 2);
    expect(page.meshes()).toHaveLength(2);
    page.run.reset();
    await vi.waitUntil(() => page.meshes().length === 3);
    expect(page.meshes().at(-1)).toEqual({ nVertices: whole, change: 'mesh' });
    expect(page.store.get().summary?.n_vertices).toBe(whole);
  });

  it('does not ask for springs that nobody looks at', async () => {
    const page = open('#scene=curtain&level=0&stepper=imex');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
    expect(page.store.get().springSplit).toBeNull();
    page.store.set({ springs: true });
    await vi.waitUntil(() => page.store.get().springSplit !== null);
  });

  it('knows what a link to the shown cloth leaves out', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    page.run.grab(3);
    page.run.releaseGrab();
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
    expect(linkSentence(page.store.get())).toMatch(/runs to 0\.02 s.*The pull is not kept/);
    page.run.reset();
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
    expect(linkSentence(page.store.get())).toBe('Link copied. It runs to 0.02 s and rests there.');
    page.store.set({ setting: { ...page.store.get().setting, level: 1 } });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(linkSentence(page.store.get())).toContain('The change on the way is not kept');
  });
});

describe('motion run whose worker does not go on', () => {
  beforeEach(() => {
    module = createFakeModule().module;
    changeScene = (scene) => scene;
  });
  afterEach(() => vi.unstubAllGlobals());

  const stepTo = async (page: ReturnType<typeof open>, step: number) => {
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === step);
  };

  it('notices that it ended, says so in true words, and starts it again', async () => {
    const locks = stubLocks();
    const page = open('#scene=curtain&level=1');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await stepTo(page, 1);
    const { setting } = page.store.get();
    locks.endAll();
    expect(page.store.get().problem?.sentence).toMatch(
      /ended by itself after step 1 .*started again/,
    );
    expect(page.store.get().problem?.sentence).not.toContain('browser, with SIMD');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get()).toMatchObject({ setting, numbers: { step: 0 } });
    expect(page.store.get().problem?.source).toBe('worker');
    await stepTo(page, 1);
  });

  it('does not start it again for ever', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    hangsAt = ({ type }) => {
      if (type === 'load') throw new Error('out of memory');
      return false;
    };
    page.store.set({ setting: { ...page.store.get().setting, level: 3 } });
    await vi.waitUntil(() => phaseOf(page) === 'stopped');
    expect(page.store.get().problem?.sentence).toMatch(/out of memory.* twice/);
    hangsAt = () => false;
    page.run.reset();
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await stepTo(page, 1);
  });

  /** Asks for a step that never ends, and stops it once the page shows that it takes long. */
  const stopLongStep = async (page: ReturnType<typeof open>) => {
    hangsAt = ({ type }) => type === 'step';
    page.run.step();
    await vi.waitUntil(() => page.store.get().busy?.type === 'step', 3000);
    hangsAt = () => false;
    page.run.stopWork();
    await vi.waitUntil(() => phaseOf(page) === 'ready');
  };

  it('shows a step that takes long, and Stop goes back to what ran before', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await stepTo(page, 1);
    page.store.set({ setting: { ...page.store.get().setting, level: 2 } });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await stopLongStep(page);
    const { setting, problem, costs, busy } = page.store.get();
    expect(setting.level).toBe(0);
    expect(busy).toBeNull();
    expect(problem?.sentence).toMatch(
      /^One step at level 2 was stopped after \d s\. The level is 0 again, as before, and the cloth is back at its start\.$/,
    );
    expect(stepCostAt(costs, setting, 2)).toMatchObject({ isLeast: true });
    await stepTo(page, 1);
  });

  it('says which method it goes back to', async () => {
    const page = open('#scene=curtain&level=0&stepper=xpbd');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await stepTo(page, 1);
    page.store.set({ setting: withStepper(page.store.get().setting, 'explicit') });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await stopLongStep(page);
    const { setting, problem } = page.store.get();
    expect(setting.stepper).toBe('xpbd');
    expect(problem?.sentence).toContain('The method is XPBD again, as before, and');
  });

  it('does not let another setting wait for ever, nor at all once Stop is pressed', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await stepTo(page, 1);
    hangsAt = ({ type }) => type === 'step';
    page.run.step();
    page.store.set({ setting: { ...page.store.get().setting, level: 1 } });
    await vi.waitUntil(() => page.store.get().busy?.type === 'step', 3000);
    page.run.stopWork();
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get()).toMatchObject({ setting: { level: 1 }, numbers: { step: 0 } });
  });

  it('is reset without waiting for a step that does not end', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await stepTo(page, 1);
    hangsAt = ({ type }) => type === 'step';
    page.run.step();
    page.run.reset();
    await vi.waitUntil(() => phaseOf(page) === 'ready', 5000);
    expect(page.store.get()).toMatchObject({ numbers: { step: 0 }, setting: { level: 0 } });
  });
});

describe('words on cloth that starts again', () => {
  const setting = withStepper(presetSetting('curtain'), 'xpbd');
  const back = (patch: Partial<typeof setting>, hasRun = true) =>
    backWords({ ...setting, ...patch }, setting, hasRun);

  it('name what is other than it was to be, and nothing else', () => {
    expect(back({})).toBe('The cloth is back at its start.');
    expect(back({ fabric: 'silk', level: 4 })).toMatch(
      /^The level is \d and the fabric is .+ again, as before, and/,
    );
    expect(back({ stepS: 1 / 30, substeps: 7 })).toMatch(
      /^The step is 1\/60 s and the number of substeps is \d+ again/,
    );
  });

  it('leave the counts to the method, and say where it is the scene’s own', () => {
    const words = backWords(withStepper(setting, 'explicit'), setting, false);
    expect(words).toBe(
      'The method is XPBD again, as this scene has it, and the cloth is back at its start.',
    );
  });
});

describe('motion run of a mesh', () => {
  const triangle = (top: number) => `v 0 ${top} 0\nv 1 0 0\nv 0 0 1\ng waist\nf 1 2 3\n`;
  const file = (name: string, text: string) => new File([text], name);
  const fetched = vi.fn();
  const aMesh = expect.stringContaining('.obj');

  beforeEach(() => {
    module = createFakeModule().module;
    changeScene = (scene) => scene;
    fetched.mockReset();
    fetched.mockImplementation(async () => new Response(triangle(1)));
    vi.stubGlobal('fetch', fetched);
  });

  it('fetches the example only when it is wanted', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(fetched).not.toHaveBeenCalledWith(aMesh);
    page.store.set({ setting: presetSetting('obj') });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get().mesh).toMatchObject({ name: 'skirt.obj', isOwn: false });
  });

  it('puts the visitor’s file in its place, from any scene, and keeps it', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await page.run.obj.open(file('hat.OBJ', triangle(2)));
    await vi.waitUntil(() => page.store.get().mesh !== null && phaseOf(page) === 'ready');
    expect(page.store.get()).toMatchObject({
      mesh: { name: 'hat.OBJ', isOwn: true, high: [1, 2, 1] },
      setting: { preset: 'obj', hold: 'highest' },
    });
    const { setting } = page.store.get();
    page.store.set({ setting: presetSetting('curtain') });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    page.store.set({ setting });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get().mesh?.name).toBe('hat.OBJ');
    expect(fetched).not.toHaveBeenCalledWith(aMesh);
  });

  it('says what is wrong with a file and goes on with the cloth', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    const sentence = () => page.store.get().problem?.sentence ?? '';
    const { setting } = page.store.get();
    await page.run.obj.open(file('hat.obj', 'v 0 0 0\nwobble\n'));
    await vi.waitUntil(() => sentence() !== '');
    expect(sentence()).toContain('hat.obj: line 2: expected');
    await page.run.obj.open(file('hat.stl', 'solid'));
    expect(sentence()).toContain('hat.stl is no OBJ file');
    expect(page.store.get()).toMatchObject({ setting, mesh: null, phase: 'ready' });
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
  });

  it('shows that a file is being read, and gives it up when told to', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    isReadingStuck = true;
    const opened = page.run.obj.open(file('hat.obj', triangle(1)));
    await vi.waitUntil(() => page.store.get().reading === 'hat.obj');
    page.run.step(); // meanwhile the cloth goes on
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
    page.run.obj.cancel();
    await opened;
    isReadingStuck = false;
    expect(page.store.get()).toMatchObject({ reading: null, mesh: null, problem: null });
    await page.run.obj.open(file('hat.obj', triangle(1)));
    expect(page.store.get()).toMatchObject({ reading: null, mesh: { name: 'hat.obj' } });
  });

  it('takes a file in another unit, and says which one is likely', async () => {
    const page = open('#scene=curtain&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    await page.run.obj.open(file('hat.obj', triangle(950)));
    expect(page.store.get().mesh).toMatchObject({ high: [1, 950, 1], unit: 'm' });
    expect(page.store.get().mesh?.odd).toContain('probably the millimetre');
    await page.run.obj.setUnit('mm');
    expect(page.store.get().mesh).toMatchObject({
      high: [0.001, 0.95, 0.001],
      unit: 'mm',
      odd: null,
    });
  });

  it('says that the example cannot be had, and takes a file all the same', async () => {
    fetched.mockRejectedValue(new TypeError('offline'));
    const page = open('#scene=obj');
    await vi.waitUntil(() => phaseOf(page) === 'refused');
    expect(page.store.get().problem?.sentence).toContain('could not be fetched');
    await page.run.obj.open(file('hat.obj', triangle(1)));
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get().problem).toBeNull();
  });

  it('keeps a file that came before the example did', async () => {
    let bring: (answer: Response) => void = () => undefined;
    const late = new Promise<Response>((resolve) => {
      bring = resolve;
    });
    fetched.mockReturnValue(late);
    const page = open('#scene=obj');
    await vi.waitUntil(() => fetched.mock.calls.length > 0);
    await page.run.obj.open(file('hat.obj', triangle(1)));
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    bring(new Response(triangle(2)));
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
    await new Promise((resume) => setTimeout(resume, 20));
    expect(page.store.get().mesh?.name).toBe('hat.obj');
  });

  it('starts anew when the fabric changes, as there are no mesh lines', async () => {
    const page = open('#scene=obj');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
    page.store.set({ setting: { ...page.store.get().setting, fabric: 'silk' } });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(page.store.get().numbers?.step).toBe(0);
  });
});

describe('motion run with a reference', () => {
  const reference = { name: 'swinging sheet', end_s: 0.1, uncertainty_m: 0.001 };
  const fetched = vi.fn();
  const answer = (content: object) => async () => new Response(JSON.stringify(content));

  beforeEach(() => {
    module = createFakeModule().module;
    changeScene = (scene) => scene;
    fetched.mockReset();
    fetched.mockImplementation(answer(reference));
    vi.stubGlobal('fetch', fetched);
  });

  const referenceOf = ({ store }: ReturnType<typeof open>) => store.get().numbers?.reference;

  it('fetches nothing until a comparison is asked for', async () => {
    const page = open('#scene=swinging-sheet&level=0');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    page.run.step();
    await vi.waitUntil(() => page.store.get().numbers?.step === 1);
    expect(fetched).not.toHaveBeenCalled();
    page.store.set({ compare: true });
    await vi.waitUntil(() => referenceOf(page));
    expect(page.store.get().reference).toBe('here');
  });

  it('fetches it after the cloth is there, and compares', async () => {
    fetched.mockImplementation(() => {
      expect(page.store.get().phase).toBe('ready');
      return answer(reference)();
    });
    const page = open('#scene=swinging-sheet&level=0&compare=on');
    await vi.waitUntil(() => referenceOf(page));
    expect(referenceOf(page)).toMatchObject({ distance_m: 0.012, end_s: 0.1 });
    expect(fetched).toHaveBeenCalledOnce();
  });

  it('fetches none for another fabric or model than it is of', async () => {
    const page = open('#scene=swinging-sheet&level=0&fabric=silk&compare=on');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    page.store.set({ setting: withModel(presetSetting('swinging-sheet'), 'membrane') });
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(fetched).not.toHaveBeenCalled();
  });

  it('goes without when it cannot be fetched, and tries again at the next load', async () => {
    fetched.mockRejectedValueOnce(new TypeError('offline'));
    const page = open('#scene=swinging-sheet&level=0&compare=on');
    await vi.waitUntil(() => page.store.get().reference === 'failed');
    expect(page.store.get().problem).toBeNull();
    expect(errorWords(page.store.get())).toMatchObject({ action: 'Try again' });
    page.store.set({ setting: { ...page.store.get().setting, level: 1 } });
    await vi.waitUntil(() => referenceOf(page));
  });

  it('fills the frame that stands with distances once they are to be shown', async () => {
    const page = open('#scene=swinging-sheet&level=0&heat=distance');
    await vi.waitUntil(() => page.shown().scalar === 'distance');
    expect(page.shown().values.every((metres) => Math.abs(metres - 0.012) < 1e-6)).toBe(true);
    expect(page.store.get().numbers?.step).toBe(0);
    page.store.set({ heat: 'magnitude' });
    await vi.waitUntil(() => page.shown().scalar === 'stretch');
  });

  it('shows the fabric for a heat map that has no reference', async () => {
    fetched.mockRejectedValue(new TypeError('offline'));
    const page = open('#scene=swinging-sheet&level=0&heat=distance');
    await vi.waitUntil(() => phaseOf(page) === 'ready');
    expect(shownHeat(page.store.get())).toBe('off');
    expect(page.shown().scalar).toBe('stretch');
  });
});
