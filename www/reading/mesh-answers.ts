/** Answers about meshes by the core. It runs in a worker of the page. */
import { failureOf } from '../compute/messages.ts';
import { fileSentence } from '../messages.ts';
import type { NamedBytes } from '../named-file.ts';
import type { Allowed } from '../store/refused.ts';
import {
  meshDefects,
  mirrorPlane,
  mirrorTarget,
  repairedDefects,
  repairMesh,
  suggestLandmarks,
  unpackMesh,
} from '../wasm/core.js';
import type { Answers, MeshQuestion, MeshReading, MirroredMesh, OwnBytes, ReadFile } from './messages.ts';

/** The defects of a refused mesh, as the core packs them; `null` where no mesh can be shown. */
function defectsOf(bytes: Uint8Array, allowed: string): OwnBytes | null {
  try {
    return meshDefects(bytes, allowed) as OwnBytes;
  } catch (thrown) {
    if (typeof thrown === 'string' && failureOf(thrown).code === 'mesh') {
      return null;
    }
    throw thrown;
  }
}

/** Reads a mesh. It makes all repairs that do not change its shape, and others that are allowed. Throws where the core breaks off. */
export function meshReading(file: NamedBytes, allowed: Allowed): MeshReading {
  const choices = JSON.stringify(allowed);
  try {
    const report = repairMesh(file.bytes, choices, file.picture);
    const [repairs, remarks] = [report.sentence(), report.remarks()];
    const mesh = report.takeMesh();
    report.free();
    const packed = mesh.packed() as OwnBytes;
    mesh.free();
    return { kind: 'good', packed, repairs, remarks };
  } catch (thrown) {
    // An error that the core reports is a string; anything else broke the core.
    if (typeof thrown !== 'string') {
      throw thrown;
    }
    const failure = failureOf(thrown);
    const what = failure.code === 'mesh' ? 'mesh' : 'file';
    const defects = what === 'mesh' ? defectsOf(file.bytes, choices) : null;
    return { kind: 'bad', sentence: fileSentence(file.name, failure), offer: failure.offer ?? null, what, defects };
  }
}

function readFile(name: string, bytes: Uint8Array): ReadFile {
  const file = { name, bytes };
  return { file, reading: meshReading(file, {}) };
}

function repairs(bytes: Uint8Array, packed: Uint8Array): OwnBytes {
  const mesh = unpackMesh(packed);
  const answer = repairedDefects(bytes, mesh) as OwnBytes;
  mesh.free();
  return answer;
}

function mirrored(packed: Uint8Array, landmarks: Uint8Array, name: string): MirroredMesh {
  const target = unpackMesh(packed);
  const image = mirrorTarget(target, landmarks);
  target.free();
  const answer = { mesh: readFile(name, image.mesh()), landmarks: image.landmarks() as OwnBytes };
  image.free();
  return answer;
}

function suggestions(packed: Uint8Array, marked: string): string {
  const mesh = unpackMesh(packed);
  const answer = suggestLandmarks(mesh, marked);
  mesh.free();
  return answer;
}

function plane(packed: Uint8Array, wish: string): string {
  const mesh = unpackMesh(packed);
  const answer = mirrorPlane(mesh, wish);
  mesh.free();
  return answer;
}

/** The answer to a question. Throws `FileRefused`, or the core's own error where it breaks off. */
export function meshAnswer(question: MeshQuestion): Answers[MeshQuestion['kind']] {
  switch (question.kind) {
    case 'mesh':
      return meshReading(question.file, question.allowed);
    case 'repairs':
      return repairs(question.bytes, question.mesh);
    case 'mirror':
      return mirrored(question.mesh, question.landmarks, question.name);
    case 'suggest':
      return suggestions(question.mesh, question.marked);
    case 'plane':
      return plane(question.mesh, question.wish);
  }
}
