// A file of the page itself, or why it cannot be had.

/** Rejects with the reason in words: "offline", "404 Not Found" or "no answer". */
export async function fetched(url: string): Promise<Response> {
  const answer = await fetch(url).catch(() => {
    throw new Error(navigator.onLine === false ? 'offline' : 'no answer');
  });
  if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}`.trim());
  return answer;
}

export async function fetchedBytes(url: string): Promise<ArrayBuffer> {
  return (await fetched(url)).arrayBuffer();
}
