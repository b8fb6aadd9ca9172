/** Reads files with the tests' own modules; the page does this in workers. */
import { examinedOf, meshFile as takenMesh, mirroredEvent, mirrorQuestion } from '../../www/files.ts';
import type { Pair, Side } from '../../www/landmarks.ts';
import type { NamedBytes } from '../../www/named-file.ts';
import type { Opening } from '../../www/opening.ts';
import * as opening from '../../www/opening.ts';
import { fileAnswer } from '../../www/reading/file-answers.ts';
import { meshAnswer, meshReading } from '../../www/reading/mesh-answers.ts';
import type { Answers, Question, ReadFile } from '../../www/reading/messages.ts';
import { isOfFiles } from '../../www/reading/messages.ts';
import type { FileReader } from '../../www/reading/reader.ts';
import type { Examined } from '../../www/store/defects.ts';
import type { Event } from '../../www/store/events.ts';
import type { Allowed, RefusedMesh } from '../../www/store/refused.ts';
import { allowedBy } from '../../www/store/refused.ts';
import type { MeshFile, State } from '../../www/store/state.ts';

function answer<Kind extends Question['kind']>(question: Extract<Question, { readonly kind: Kind }>): Answers[Kind] {
  const asked: Question = question;
  const given = isOfFiles(asked) ? fileAnswer(asked) : meshAnswer(asked);
  return given as Answers[Kind];
}

/** A reader that answers in the next turn. */
export const READER: FileReader = {
  ask: async (question) => {
    await Promise.resolve();
    return answer(question);
  },
};

/** A file with the result of reading it as a mesh. */
export function readFile(file: NamedBytes, allowed: Allowed = {}): ReadFile {
  return { file, reading: meshReading(file, allowed) };
}

/** A mesh of the page. Throws `FileRefused`. */
export function meshFile(file: NamedBytes, allowed: Allowed = {}): MeshFile {
  return takenMesh(readFile(file, allowed));
}

/** What opening files does to the page. Throws `FileRefused`. */
export function openingOf(files: readonly NamedBytes[], over: Side | null, state: State): Opening {
  const sorted = answer({ kind: 'sort', files });
  const readings = opening.meshesAmong(sorted).map((file) => meshReading(file, {}));
  return opening.openingOf(opening.arrivalsOf(sorted, readings), over, state);
}

/** The events of meshes whose sides are known. Throws `FileRefused`. */
export function eventsOfSides([source, target]: readonly [NamedBytes | null, NamedBytes | null], pairs: NamedBytes | null, state: State): Event[] {
  return opening.eventsOfSides([source && readFile(source), target && readFile(target)], pairs, state);
}

/** The events of the repair that was offered for a refused mesh. */
export function repairedEvents(mesh: RefusedMesh, state: State): Event[] {
  return opening.repairedEvents(mesh, meshReading(mesh.file, allowedBy(mesh)), state);
}

/** The defects that a mesh had before it was repaired. */
export function examinedRepair({ bytes, mesh }: MeshFile): Examined {
  return examinedOf(answer({ kind: 'repairs', bytes, mesh: mesh.packed() }));
}

/** The event that replaces a target by its mirror image. */
export function mirroredTarget(target: MeshFile, pairs: readonly Pair[]): Event {
  return mirroredEvent(answer(mirrorQuestion(target, pairs)), pairs);
}
