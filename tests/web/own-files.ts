/** The files of a demo as a user's own files. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { buildDemo, initSync } from '../../www/wasm/page.js';

/** A file in the form in which a file chooser takes it. */
export interface Upload {
  readonly name: string;
  readonly mimeType: string;
  readonly buffer: Buffer;
}

export interface OwnFiles {
  readonly horse: Upload;
  readonly cat: Upload;
  /** The mirror image of the cat. */
  readonly turned: Upload;
  readonly landmarks: Upload;
  /** The number of landmark pairs. */
  readonly pairs: number;
}

/** A file of this content. */
export function upload(name: string, data: string | Uint8Array): Upload {
  return { name, mimeType: 'application/octet-stream', buffer: Buffer.from(data) };
}

/** The mirror image of an OBJ file: x is negated, and every triangle is turned. */
function mirrored(obj: string): string {
  return obj
    .replace(/^v (\S+)/gm, (_, x: string) => `v ${-Number(x)}`)
    .replace(/^f (\S+) (\S+) (\S+)/gm, 'f $1 $3 $2');
}

/** The files of a demo, as a user's own. */
export function ownFiles(): OwnFiles {
  initSync({ module: readFileSync(fileURLToPath(new URL('../../www/wasm/page_bg.wasm', import.meta.url))) });
  const demo = buildDemo('horse-cat');
  if (demo === undefined) {
    throw new Error('there is no demo horse-cat');
  }
  const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);
  const landmarks = JSON.parse(text(demo.landmarks())) as { pairs: unknown[] };
  return {
    horse: upload('horse.obj', demo.source()),
    cat: upload('cat.obj', demo.target()),
    turned: upload('cat.obj', mirrored(text(demo.target()))),
    landmarks: upload('horse-cat.json', JSON.stringify({ ...landmarks, source: 'horse.obj', target: 'cat.obj' })),
    pairs: landmarks.pairs.length,
  };
}
