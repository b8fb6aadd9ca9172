/** GLB files that the page saves and opens. */
import { readFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
import { test } from './test.ts';
import { validateBytes } from 'gltf-validator';

interface Accessor {
  readonly bufferView: number;
  readonly componentType: number;
  readonly count: number;
  readonly type: string;
}

/** The parts of a glTF document that the tests use. */
export interface Gltf {
  readonly asset: { readonly version: string };
  readonly meshes: readonly { readonly primitives: readonly { readonly indices: number; readonly attributes: Readonly<Record<string, number>> }[] }[];
  readonly accessors: readonly Accessor[];
  readonly bufferViews: readonly { readonly byteOffset?: number; readonly byteLength: number }[];
  readonly images?: readonly { readonly bufferView: number }[];
}

/** Presses a button, and returns the file that it saves. */
export async function downloaded(page: Page, button: string): Promise<Buffer> {
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: button, exact: true }).click();
  const file = await download;
  const path = test.info().outputPath(file.suggestedFilename());
  await file.saveAs(path);
  return readFileSync(path);
}

/** A GLB that was read. */
export interface Glb {
  readonly bytes: Buffer;
  readonly document: Gltf;
  readonly binary: Buffer;
  /** The bytes of a buffer view. */
  readonly view: (number: number) => Buffer;
}

/** The parts of a GLB. */
export function readGlb(bytes: Buffer): Glb {
  const length = bytes.readUInt32LE(12);
  const document = JSON.parse(bytes.subarray(20, 20 + length).toString()) as Gltf;
  const binary = bytes.subarray(28 + length);
  const view = (number: number): Buffer => {
    const { byteOffset = 0, byteLength = 0 } = document.bufferViews[number] ?? {};
    return binary.subarray(byteOffset, byteOffset + byteLength);
  };
  return { bytes, document, binary, view };
}

/** The GLB file that a button saves. */
export async function savedFile(page: Page, button: string): Promise<Glb> {
  return readGlb(await downloaded(page, button));
}

/** A GLB of a document and its buffer, whose length is a multiple of 4. */
export function glbOf(document: object, binary: Buffer): Buffer {
  const text = JSON.stringify(document);
  const json = Buffer.from(text.padEnd(Math.ceil(text.length / 4) * 4));
  const words = (...numbers: number[]): Buffer => Buffer.from(Uint32Array.from(numbers).buffer);
  const head = Buffer.concat([Buffer.from('glTF'), words(2, 28 + json.length + binary.length)]);
  return Buffer.concat([head, words(json.length), Buffer.from('JSON'), json, words(binary.length), Buffer.from('BIN\0'), binary]);
}

/** The errors and warnings of the Khronos validator about a GLB file. */
export async function glbFaults(glb: Buffer): Promise<string[]> {
  const report = await validateBytes(new Uint8Array(glb), { maxIssues: 20 });
  return report.issues.messages.filter(({ severity }) => severity <= 1).map(({ code, message, pointer }) => `${code}: ${message} ${pointer ?? ''}`);
}
