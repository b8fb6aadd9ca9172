/** The built wasm modules, for tests that use them. */
import { readFileSync } from 'node:fs';
import { initSync as initCore } from '../../www/wasm/core.js';
import { initSync as initPage } from '../../www/wasm/page.js';

function module(name: string): Buffer {
  return readFileSync(new URL(`../../www/wasm/${name}_bg.wasm`, import.meta.url));
}

/** Starts the module of the page, which draws meshes. */
export function startPageModule(): void {
  initPage({ module: module('page') });
}

/** Starts the core, which reads meshes and makes maps. */
export function startCoreModule(): void {
  initCore({ module: module('core') });
}

/** Starts both modules. */
export function startModules(): void {
  startPageModule();
  startCoreModule();
}
