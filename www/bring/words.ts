/** Words about files that are brought across. */
import { count, fileSentence } from '../messages.ts';
import type { MeshSide } from '../report.ts';
import type { Result } from '../store/state.ts';
import type { BringFailure, Kind } from './messages.ts';

/** The mesh from which files are brought. */
export type Giver = MeshSide;

/** The mesh onto which files are brought. */
export function receiverOf(giver: Giver): Giver {
  return giver === 'source' ? 'target' : 'source';
}

/** What a file may be taken for, in a list of choices. */
export const KIND_NAMES: Readonly<Record<Kind, string>> = {
  values: 'Values',
  curves: 'Curves',
  texture: 'Texture',
  frames: 'Poses',
};

/** The most names of columns that a sentence lists. */
const MOST_NAMES = 6;

function listed(names: readonly string[]): string {
  const told = names.slice(0, MOST_NAMES).join(', ');
  return names.length > MOST_NAMES ? `${told} and ${names.length - MOST_NAMES} more` : told;
}

/** A sentence about what the files are taken for. */
export function kindSentence(names: readonly string[], kind: Kind, columns: readonly string[], giver: Giver): string {
  const what = names.length === 1 ? (names[0] ?? '') : count(names.length, 'file');
  switch (kind) {
    case 'values':
      return `${what}: values of the ${giver}’s vertices, ${count(columns.length, 'column')} (${listed(columns)}).`;
    case 'curves':
      return `${what}: curves on the ${giver}.`;
    case 'texture':
      return `${what}: the ${giver}’s texture. It is baked over the ${receiverOf(giver)}’s own texture coordinates; both mesh files must have some.`;
    case 'frames':
      return `${what}: the ${giver} in ${names.length === 1 ? 'another pose' : 'other poses'}. The ${receiverOf(giver)} moves in the same way.`;
  }
}

export const WORDS = {
  noMap: 'Once there is a map, what belongs to one mesh can be brought onto the other: values, curves, a texture, poses.',
  otherMeshes: 'The last map is of other meshes than those on the page. Make a map of these first.',
  noMapFile: 'Nothing can be brought across this map, since it has no map file: maps of the relaxed method have one, where neither mesh was repaired.',
  noCore: 'The part of the program that does this is still being loaded. Try again in a moment.',
  mapChanged: 'The map on the page is another one now, so what was begun is left out. Bring it across again.',
  tooLarge: 'is larger than 1 GiB, more than the page can take.',
  tooMuch: 'These files are larger than 1 GiB together, more than the page can take. Bring fewer poses at once.',
} as const;

/** Why nothing can be brought across; `null` where something can. `shown` is the map of the meshes on the page. */
export function hindrance(last: Result | null, shown: Result | null): string | null {
  if (last === null) {
    return WORDS.noMap;
  }
  if (shown === null) {
    return WORDS.otherMeshes;
  }
  return shown.output.map === null ? WORDS.noMapFile : null;
}

/** Why files that came together cannot be taken together; `name` is the first one that is no mesh. */
export function notTogether(name: string): string {
  return `${name}: several files at once must be one mesh in several poses, and this is none. Bring it alone.`;
}

/** A failure with the name of the file at fault. */
export function bringSentence(failure: BringFailure, given: readonly string[], meshes: Readonly<Record<Giver, string>>): string {
  const { file } = failure;
  const name = typeof file === 'number' ? given[file] : file === null ? undefined : meshes[file];
  // Where no file is at fault the sentence stands without a name.
  const told = fileSentence(name ?? '', failure);
  return name === undefined ? told.slice(': '.length) : told;
}

/** A sentence about what was saved. */
export function savedSentence(name: string, number: number): string {
  return number === 1 ? `Saved as ${name}.` : `${count(number, 'file')} saved as ${name}.`;
}
