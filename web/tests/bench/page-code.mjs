// The page's own code under Node, as Vite makes it of the sources.
import { fileURLToPath } from 'node:url';
import { createServer } from 'vite';
import { stepperRows } from '../../build-steps/stepper-rows.ts';

/** `load` imports a module by its path in web; `close` ends what makes them. */
export async function openPageCode() {
  const server = await createServer({
    root: fileURLToPath(new URL('../..', import.meta.url)),
    configFile: false,
    appType: 'custom',
    logLevel: 'error',
    plugins: [stepperRows()],
    optimizeDeps: { noDiscovery: true },
    server: { middlewareMode: true, watch: null, hmr: false, fs: { strict: false } },
  });
  return { load: (path) => server.ssrLoadModule(path), close: () => server.close() };
}
