import { defineConfig } from 'vitest/config';
import { singlePage } from './single_page';

// `--mode viewer` builds viewer.html, `--mode app` builds app.html.
export default defineConfig(({ mode }) => ({
  plugins: [singlePage(`${mode}.html`)],
  build: {
    target: 'es2022',
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 0,
    emptyOutDir: false,
    rollupOptions: { input: `${mode}.html` },
  },
  test: {
    testTimeout: 300_000,
    hookTimeout: 300_000,
    fileParallelism: false,
    expect: { poll: { timeout: 60_000 } },
  },
}));
