import { describe, expect, it } from 'vitest';
import { endedSentence, Restarts } from '../../src/shared/workers/restarts';

describe('restarts', () => {
  it('count ends in a row, anew after work, and none of what never started', () => {
    const restarts = new Restarts();
    expect(restarts.noteEnd()).toBe(0);
    restarts.noteStart();
    expect([restarts.noteEnd(), restarts.noteEnd()]).toEqual([1, 2]);
    restarts.noteStart();
    expect(restarts.noteEnd()).toBe(3);
    restarts.noteWork();
    expect(restarts.noteEnd()).toBe(1);
  });

  it('say why in one sentence', () => {
    expect(endedSentence('out of memory.')).toBe(
      'The computation ended by itself (out of memory).',
    );
  });
});
