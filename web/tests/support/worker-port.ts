// A worker in this thread: its core serves a port, as it would serve a page, and answers come later.
import type { Message, Port, Reply } from '../../src/shared/workers/asked';
import { type Core, type Post, type Scope, serve } from '../../src/shared/workers/serve';

export function workerPort<Question, Answer extends Message>(
  start: (post: Post<Answer>) => Core<Question> & { close?(): void },
): Port {
  const scope: Scope = {
    onmessage: null,
    postMessage: (reply: Reply) =>
      setTimeout(() => port.onmessage?.({ data: reply } as MessageEvent), 0),
  };
  let core: ReturnType<typeof start> | null = null;
  const port: Port = {
    onmessage: null,
    onerror: null,
    postMessage: (message) =>
      setTimeout(() => scope.onmessage?.({ data: message } as MessageEvent), 0),
    terminate: () => core?.close?.(),
  };
  serve<Question, Answer>(scope, async (post) => {
    core = start(post);
    return core;
  });
  return port;
}
