import { svelte } from '@sveltejs/vite-plugin-svelte';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';

// The charts of `lukou report`: one script and one style, which go into each report as they are.
export default defineConfig({
  plugins: [svelte()],
  publicDir: false,
  build: {
    outDir: process.env.LUKOU_REPORT_OUT ?? 'dist-report',
    emptyOutDir: true,
    target: 'es2022',
    modulePreload: false,
    cssCodeSplit: false,
    rollupOptions: {
      input: fileURLToPath(new URL('./src/report/main.ts', import.meta.url)),
      output: { format: 'iife', entryFileNames: 'report.js', assetFileNames: 'report[extname]' },
    },
  },
});
