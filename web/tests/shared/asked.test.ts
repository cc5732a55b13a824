// A question to a worker has one answer, whatever else the worker says meanwhile.
import { afterEach, describe, expect, it, vi } from 'vitest';
import { Refused } from '../../src/shared/bindings/answers';
import { answerOf, BrokenWorker, createAsked } from '../../src/shared/workers/asked';
import type { Core, Post } from '../../src/shared/workers/serve';
import { stubLocks } from '../support/locks';
import { workerPort } from '../support/worker-port';

type Question =
  | { type: 'slow'; value: number }
  | { type: 'quick'; value: number }
  | { type: 'silent' }
  | { type: 'bad' }
  | { type: 'fatal' };
type Value = { type: 'value'; value: number };
interface Answers {
  slow: Value;
  quick: Value;
  silent: { type: 'done' };
  bad: Value;
  fatal: Value;
}
type Posted = Value | { type: 'refused'; failure: typeof FAILURE };

const FAILURE = { ok: false, kind: 'input', where: '/bad', what: 'expected better' } as const;

/** A core that takes its time for some questions and posts twice for each value. */
function core(post: Post<Posted>): Core<Question> {
  return {
    async receive(question) {
      if (question.type === 'slow') await new Promise((resume) => setTimeout(resume, 10));
      if (question.type === 'fatal') throw new Error('out of memory');
      if (question.type === 'bad') post({ type: 'refused', failure: FAILURE }, []);
      if (!('value' in question)) return;
      post({ type: 'value', value: question.value }, []);
      post({ type: 'value', value: -question.value }, []);
    },
  };
}

function open() {
  const news: Posted[] = [];
  const broken: string[] = [];
  const client = createAsked<Question, Answers, Posted>(workerPort(core), {
    news: (message) => news.push(message),
    broken: (reason) => broken.push(reason),
  });
  return { client, news, broken };
}

describe('a worker that is asked', () => {
  it('answers each question by itself, one after the other, and the rest is news', async () => {
    const { client, news } = open();
    const answers = await Promise.all([
      client.ask({ type: 'slow', value: 1 }),
      client.ask({ type: 'quick', value: 2 }),
      client.ask({ type: 'silent' }),
    ]);
    expect(answers).toEqual([
      { type: 'value', value: 1 },
      { type: 'value', value: 2 },
      { type: 'done' },
    ]);
    expect(news).toEqual([
      { type: 'value', value: -1 },
      { type: 'value', value: -2 },
    ]);
  });

  it('gives no answer to what is told', async () => {
    const { client, news } = open();
    client.tell({ type: 'quick', value: 3 });
    client.tell({ type: 'bad' });
    await client.ask({ type: 'silent' });
    expect(news.map(({ type }) => type)).toEqual(['value', 'value', 'refused']);
  });

  it('rejects what is refused, with the failure', async () => {
    const { client } = open();
    await expect(client.ask({ type: 'bad' })).rejects.toEqual(new Refused(FAILURE));
    const heard: string[] = [];
    const answer = await answerOf(client.ask({ type: 'bad' }), ({ what }) => heard.push(what));
    expect([answer, heard]).toEqual([null, ['expected better']]);
  });

  it('rejects all that is open once it breaks, and all that comes', async () => {
    const { client, broken } = open();
    const open1 = client.ask({ type: 'fatal' });
    const open2 = client.ask({ type: 'quick', value: 1 });
    await expect(open1).rejects.toThrow(BrokenWorker);
    await expect(open2).rejects.toThrow('out of memory');
    await expect(client.ask({ type: 'silent' })).rejects.toThrow(BrokenWorker);
    expect(broken).toEqual(['out of memory']);
  });
});

describe('a worker that ends without a word', () => {
  afterEach(() => vi.unstubAllGlobals());

  it('is noticed, and its open questions are rejected', async () => {
    const locks = stubLocks();
    const { client, broken } = open();
    await client.ask({ type: 'silent' });
    const open1 = client.ask({ type: 'slow', value: 1 });
    locks.endAll();
    await expect(open1).rejects.toThrow('without a word');
    expect(broken).toHaveLength(1);
  });

  it('is no news when the page itself ended it', async () => {
    const locks = stubLocks();
    const { client, broken } = open();
    await client.ask({ type: 'silent' });
    client.terminate();
    locks.endAll();
    await expect(client.ask({ type: 'silent' })).rejects.toThrow('it was ended');
    expect(broken).toEqual([]);
  });
});
