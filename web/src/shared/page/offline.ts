// The copy of the page that works without a network, kept by the service worker of the build.

/** Tells the worker what a first visit fetched before it was there, and what is still on its way. */
async function tellFirstVisit(container: ServiceWorkerContainer): Promise<void> {
  const { active } = await container.ready;
  const tell = (list: PerformanceObserverEntryList) =>
    active?.postMessage(list.getEntries().map(({ name }) => name));
  new PerformanceObserver(tell).observe({ type: 'resource', buffered: true });
}

export function keepOfflineCopy(): void {
  if (!import.meta.env.PROD || !('serviceWorker' in navigator)) return;
  const { serviceWorker } = navigator;
  // A page opened from an insecure address has none: it works, but only while it is served.
  serviceWorker.register('./offline.js').catch(() => undefined);
  if (!serviceWorker.controller) void tellFirstVisit(serviceWorker);
}
