import { svelte } from '@sveltejs/vite-plugin-svelte';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

// No inline scripts or styles and no data addresses for assets: the server's content security policy allows neither.
export default defineConfig({
  base: './',
  plugins: [svelte()],
  build: {
    outDir: process.env.LUKOU_PAGE_OUT ?? 'dist',
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    // A twentieth smaller than what esbuild makes.
    minify: 'terser',
    terserOptions: { module: true, compress: { passes: 2 } },
  },
  // The tests mirror the tree: tests/unit/services/console/web/lib/x.test.ts. They reach the page as `@page/lib/x`.
  resolve: { alias: { '@page': here('./src') } },
  server: { fs: { allow: [here('../../..')] } },
  test: {
    dir: here('../../../tests/unit/services/console/web'),
    globals: true,
  },
});
