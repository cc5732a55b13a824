// The build puts COPY before this: { version, files, onDemand } of what the page consists of.
const NAME = `pleat-${COPY.version}`;
const ON_DEMAND_NAME = 'pleat-on-demand';
const onDemand = new Set(COPY.onDemand.map((file) => new URL(file, self.registration.scope).href));

self.addEventListener('install', (event) => {
  const fill = async () => (await caches.open(NAME)).addAll(COPY.files);
  event.waitUntil(fill().then(() => self.skipWaiting()));
});

self.addEventListener('activate', (event) => {
  const tidy = async () => {
    for (const name of await caches.keys()) {
      const isOurs = name.startsWith('pleat-');
      if (isOurs && name !== NAME && name !== ON_DEMAND_NAME) await caches.delete(name);
    }
    const kept = await caches.open(ON_DEMAND_NAME);
    for (const request of await kept.keys()) {
      if (!onDemand.has(request.url)) await kept.delete(request);
    }
    await self.clients.claim();
  };
  event.waitUntil(tidy());
});

/** The network first, so that a new version is seen at once; the copy when there is none. */
async function answer(request) {
  try {
    return await fetch(request);
  } catch (error) {
    const copy = await caches.match(request, { ignoreSearch: true, ignoreVary: true });
    if (copy) return copy;
    throw error;
  }
}

/** The copy first: the name carries a hash of the content, so a copy stays true. */
async function answerOnDemand(event) {
  const kept = await caches.open(ON_DEMAND_NAME);
  const copy = await kept.match(event.request, { ignoreVary: true });
  if (copy) return copy;
  const fresh = await fetch(event.request);
  if (fresh.ok) event.waitUntil(kept.put(event.request, fresh.clone()));
  return fresh;
}

self.addEventListener('fetch', (event) => {
  const { method, url } = event.request;
  if (method !== 'GET' || !url.startsWith(self.registration.scope)) return;
  event.respondWith(onDemand.has(url) ? answerOnDemand(event) : answer(event.request));
});

// Addresses that the page fetched before this worker stood between it and the network.
self.addEventListener('message', (event) => {
  const keep = async () => {
    const kept = await caches.open(ON_DEMAND_NAME);
    for (const url of event.data) {
      if (!onDemand.has(url) || (await kept.match(url))) continue;
      await kept.add(url).catch(() => undefined); // a fetch that failed for the page fails here too
    }
  };
  event.waitUntil(keep());
});
