import { describe, expect, it } from 'vitest';
import { changed, isTold } from '../../../native-tests/bench/parts/truth-warnings.mjs';

describe('bench truth', () => {
  it('changes values of a scene at their pointers, and not the scene', () => {
    const scene = { method: { stepper: 'implicit' }, pins: [{ vertices: [0] }] };
    const result = changed(scene, {
      '/method/stepper': 'xpbd',
      '/world/air/density_kg_per_m3': 1,
      '/pins/0/vertices': [1],
    });
    expect(result).toEqual({
      method: { stepper: 'xpbd' },
      world: { air: { density_kg_per_m3: 1 } },
      pins: [{ vertices: [1] }],
    });
    expect(scene.method.stepper).toBe('implicit');
    expect(scene.pins[0].vertices).toEqual([0]);
  });

  it('counts an explosion as told by a warning and the exit status, and only if it was silent', () => {
    const told = { status: 'ok', warnings: [{ kind: 'stretch' }], exit: 1 };
    expect(isTold(told)).toBe(true);
    expect(isTold({ ...told, status: 'not_converged' })).toBe(true);
    expect(isTold({ ...told, warnings: [] })).toBe(false);
    expect(isTold({ ...told, exit: 0 })).toBe(false);
    expect(isTold({ ...told, status: 'not_finite' })).toBe(false);
  });
});
