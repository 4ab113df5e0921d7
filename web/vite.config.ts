import { defineConfig } from 'vitest/config';
import { singlePage } from './single_page';

export default defineConfig({
  plugins: [singlePage()],
  build: {
    target: 'es2022',
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 0,
    emptyOutDir: false,
    rollupOptions: { input: 'viewer.html' },
  },
  test: { testTimeout: 300_000, hookTimeout: 300_000, fileParallelism: false },
});
