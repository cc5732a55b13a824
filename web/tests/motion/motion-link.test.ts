import { describe, expect, it } from 'vitest';
import {
  decodeMotionLink,
  encodeMotionLink,
  type MotionLink,
} from '../../src/motion/state/motion-link';
import {
  MODELS,
  modelsOf,
  PRESET_IDS,
  presetSetting,
  withModel,
  withStepper,
} from '../../src/motion/state/setting';
import { fabrics } from '../../src/shared/fabric/fabric-data';
import { slug } from '../../src/shared/state/link-reader';
import { canRun, STEPPER_NAMES } from '../../src/shared/steppers/steppers';

const link: MotionLink = {
  setting: {
    preset: 'tablecloth',
    fabric: 'coarse cotton (denim)',
    model: 'springs',
    level: 3,
    stepper: 'xpbd',
    stepS: 1 / 120,
    substeps: 45,
    iterations: 2,
    explicitShare: 0.25,
    hold: 'highest',
  },
  heat: 'signed',
  heatRange: 2,
  edges: true,
  springs: true,
  coarse: 2,
  coarseAs: 'hpbd',
  energy: true,
  compare: true,
  startSteps: 180,
  camera: { azimuth: 0.125, polar: 1.5, zoom: 0.75, shift: [0.1, -0.25, 0] },
};

describe('url-codec', () => {
  it('gives back every part of the state it wrote', () => {
    const { link: read, problems } = decodeMotionLink(`#${encodeMotionLink(link)}`);
    expect(problems).toEqual([]);
    expect(read).toEqual(link);
  });

  it('keeps every preset, stepper and fabric', () => {
    for (const preset of PRESET_IDS) {
      const { model } = presetSetting(preset);
      for (const stepper of STEPPER_NAMES.filter((one) => canRun(one, model))) {
        for (const fabric of fabrics) {
          const setting = {
            ...withStepper(presetSetting(preset), stepper),
            fabric: fabric.name_en,
          };
          const { link: read, problems } = decodeMotionLink(
            `#${encodeMotionLink({ ...link, setting })}`,
          );
          expect(problems).toEqual([]);
          expect(read.setting).toEqual(setting);
        }
      }
    }
  });

  it('keeps every model that a preset can have', () => {
    for (const preset of PRESET_IDS) {
      for (const model of modelsOf(preset)) {
        const setting = withModel(presetSetting(preset), model);
        expect(decodeMotionLink(`#${encodeMotionLink({ ...link, setting })}`).link.setting).toEqual(
          setting,
        );
      }
    }
  });

  it('refuses a stepper that cannot run the model, and a model that the scene cannot have', () => {
    const membrane = decodeMotionLink('#scene=curtain&model=membrane&stepper=xpbd');
    expect(membrane.link.setting).toMatchObject({ model: 'membrane', stepper: 'implicit' });
    expect(membrane.problems.join()).toContain('stepper: expected implicit, explicit, rk4, newton');
    const mesh = decodeMotionLink('#scene=obj&model=springs');
    expect(mesh.link.setting).toMatchObject({ preset: 'obj', model: 'membrane' });
    expect(mesh.problems.join()).toContain(`model: expected membrane, found "${MODELS[0]}"`);
  });

  it('carries what holds a mesh, whatever its groups are called', () => {
    const own = presetSetting('obj');
    for (const hold of ['nothing', 'group:waist & hem, 50 % ü'] as const) {
      const { link: read, problems } = decodeMotionLink(
        `#${encodeMotionLink({ ...link, setting: { ...own, hold } })}`,
      );
      expect(problems).toEqual([]);
      expect(read.setting.hold).toBe(hold);
    }
    expect(decodeMotionLink('#scene=obj&hold=string').problems).toHaveLength(1);
  });

  it('gives the first preset and no problem for an empty link', () => {
    const { link: read, problems } = decodeMotionLink('');
    expect(problems).toEqual([]);
    expect(read.setting).toEqual(presetSetting('curtain'));
    expect(read.heat).toBe('off');
    expect(read.startSteps).toBe(90);
    expect(decodeMotionLink('#scene=curtain').link.startSteps).toBe(0);
  });

  it('takes what a preset is made for when a part is missing', () => {
    const { link: read } = decodeMotionLink('#scene=swinging-sheet');
    expect(read.setting).toEqual(presetSetting('swinging-sheet'));
  });

  it('names each broken part, what was expected and what was found, and keeps the others', () => {
    const { link: read, problems } = decodeMotionLink(
      '#scene=curtain&level=9&fabric=lead&stepper=implicit&substeps=-3&step=1/7&heat=signed&start=99&foo=1',
    );
    const own = presetSetting('curtain');
    expect(read.heat).toBe('signed');
    expect(read.setting.level).toBe(own.level);
    expect(read.setting.fabric).toBe(own.fabric);
    expect(problems).toHaveLength(6);
    expect(problems.join('\n')).toContain('level: expected 0 to 4, found "9"');
    expect(problems.join('\n')).toContain('substeps: expected 1 to');
    expect(problems.join('\n')).toContain('foo: not a known part');
  });

  it.each(['#%', '#level=%zz&scene', '#====', `#fabric=${'x'.repeat(5000)}`, '#level=1&level=7'])(
    'reads %s without an exception and with short sentences',
    (hash) => {
      const { problems } = decodeMotionLink(hash);
      for (const problem of problems) expect(problem.length).toBeLessThan(200);
    },
  );

  it('allows 0 substeps only where 0 has a meaning', () => {
    expect(decodeMotionLink('#stepper=explicit&substeps=0').problems).toEqual([]);
    expect(decodeMotionLink('#stepper=xpbd&substeps=0').problems).toHaveLength(1);
  });

  it('writes each fabric as another word', () => {
    expect(new Set(fabrics.map((fabric) => slug(fabric.name_en))).size).toBe(fabrics.length);
  });
});
