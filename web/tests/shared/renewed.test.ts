// A worker that ends by itself has a successor, but never an endless row of them.
import { describe, expect, it, vi } from 'vitest';
import type { Done, Listener } from '../../src/shared/workers/asked';
import { Renewed } from '../../src/shared/workers/renewed';
import { endedSentence } from '../../src/shared/workers/restarts';

interface Question {
  type: 'work';
}

/** A worker that answers every question, and what became of its successors. */
function launch() {
  const listeners: Listener<never>[] = [];
  const events = { renewed: vi.fn(), lost: vi.fn() };
  const worker = new Renewed<Question, { work: Done }>((listener) => {
    listeners.push(listener);
    return {
      ask: async () => ({ type: 'done' }) as never,
      tell: () => undefined,
      terminate: () => undefined,
    };
  }, events);
  const work = () => worker.ask({ type: 'work' });
  const end = () => listeners.at(-1)?.broken?.('killed');
  return { worker, events, work, end, nStarted: () => listeners.length };
}

describe('a renewed worker', () => {
  it('is lost when it never answered', () => {
    const { events, end, nStarted } = launch();
    end();
    expect(events.lost).toHaveBeenCalledWith('killed', false);
    expect(nStarted()).toBe(1);
  });

  it('has a successor once it has answered', async () => {
    const { events, work, end, nStarted } = launch();
    await work();
    end();
    expect(events.renewed).toHaveBeenCalledWith('killed');
    expect(events.lost).not.toHaveBeenCalled();
    expect(nStarted()).toBe(2);
  });

  it('is lost when its successor ends before the work is done', async () => {
    const { events, work, end, nStarted } = launch();
    await work();
    end();
    await work();
    end();
    expect(events.lost).toHaveBeenCalledWith('killed', true);
    expect(nStarted()).toBe(2);
  });

  it('has a successor each time that the work was done in between', async () => {
    const { worker, events, work, end, nStarted } = launch();
    for (let round = 0; round < 3; ++round) {
      await work();
      worker.prove();
      end();
    }
    expect(events.renewed).toHaveBeenCalledTimes(3);
    expect(nStarted()).toBe(4);
  });

  it('counts no answer of a worker that was replaced', async () => {
    const { worker, events, work, end } = launch();
    const late = work();
    worker.replace();
    await late;
    end();
    expect(events.lost).toHaveBeenCalledWith('killed', false);
  });
});

describe('the sentence for an end', () => {
  it('quotes the reason once, with one full stop', () => {
    expect(endedSentence('out of memory.')).toBe(
      'The computation ended by itself (out of memory).',
    );
  });
});
