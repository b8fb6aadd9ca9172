import { defineConfig } from 'vite';
import { serviceWorker } from './www/offline/build.ts';

export default defineConfig({
  // Every address is relative, so that the built page works from any folder of a static host.
  base: './',
  publicDir: 'www/public',
  worker: { format: 'es' },
  plugins: [serviceWorker()],
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
  },
  server: { watch: { ignored: ['**/target/**', '**/test-results/**'] } },
});
