/** Answers about files before their meshes are read, and builds demos. It runs in a worker of the page, with the page's module. */
import { contentOf } from '../landmark-files.ts';
import { isMapFile } from '../map-files.ts';
import { gathered } from '../mesh-sets.ts';
import type { NamedBytes } from '../named-file.ts';
import type { DemoFiles as BuiltDemo } from '../wasm/page.js';
import { buildDemo } from '../wasm/page.js';
import type { Answers, DemoFiles, FileQuestion, GoodMesh, OwnBytes, SortedFile } from './messages.ts';

/** The files with what each holds. Throws `FileRefused` for files that belong to nothing, and for bad landmark files. */
function sorted(files: readonly NamedBytes[]): SortedFile[] {
  return gathered(files).map(({ name, bytes, picture }) => {
    const content = isMapFile({ bytes }) ? 'map' : (contentOf({ name, bytes }) ?? 'mesh');
    return { name, bytes, ...(picture === undefined ? {} : { picture }), content };
  });
}

/** The result that reading a demo's file would give; demos have good meshes. */
function demoReading(built: BuiltDemo, side: number): GoodMesh {
  const mesh = built.mesh(side);
  const packed = mesh.packed() as OwnBytes;
  mesh.free();
  return { kind: 'good', packed, repairs: '', remarks: [] };
}

function demo(id: string): DemoFiles | null {
  const built = buildDemo(id);
  if (built === undefined) {
    return null;
  }
  const [source, target, landmarks] = [built.source(), built.target(), built.landmarks()];
  const readings = [demoReading(built, 0), demoReading(built, 1)] as const;
  built.free();
  return {
    meshes: [
      { file: { name: `${id}-source.obj`, bytes: source, ofDemo: { id, side: 0 } }, reading: readings[0] },
      { file: { name: `${id}-target.obj`, bytes: target, ofDemo: { id, side: 1 } }, reading: readings[1] },
    ],
    landmarks: { name: `${id}.json`, bytes: landmarks },
  };
}

/** The answer to a question. Throws `FileRefused`, or the module's own error where it breaks off. */
export function fileAnswer(question: FileQuestion): Answers[FileQuestion['kind']] {
  switch (question.kind) {
    case 'sort':
      return sorted(question.files);
    case 'demo':
      return demo(question.id);
  }
}
