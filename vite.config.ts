import { defineConfig } from 'vite';
import { serviceWorker } from './www/offline/build.ts';

export default defineConfig({
  // Every address is relative, so that the built page works from any folder of a static host.
  base: './',
  publicDir: 'www/public',
  worker: { format: 'es' },
  plugins: [serviceWorker()],
  oxc: { jsx: { runtime: 'automatic', importSource: 'preact' } },
  build: {
    target: 'es2022',
    // The first that know light-dark(), with which every colour is written once.
    cssTarget: ['chrome123', 'firefox120', 'safari17.5'],
    assetsInlineLimit: 0,
    // One sheet of styles: a part that is fetched late has its own at once, also when it came by a second try.
    cssCodeSplit: false,
    modulePreload: { polyfill: false },
  },
  server: { watch: { ignored: ['**/target/**', '**/test-results/**'] } },
});
