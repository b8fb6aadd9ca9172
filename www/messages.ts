/** The sentences of the page: the only place that turns codes into sentences. */
import type { Failure } from './compute/messages.ts';
import type { Pair, Suggestion, Taking } from './landmarks.ts';
import type { Finding, RepairOffer } from './report.ts';

/** A name for each stage of the report's seconds. */
export function stageName(stage: string): string {
  const words = stage.replaceAll('_', ' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
}

const KEPT = 'Your meshes and landmarks are kept.';

const ABOUT: Readonly<Record<string, string>> = {
  'base-domain': `No base domain was found for these landmarks. Spread them over the whole surface, or move pairs that lie close together. ${KEPT}`,
  layout: `The base domain could not be drawn on both meshes. Look for a pair whose two points are not the same place, or left and right swapped. ${KEPT}`,
  'cone-metric': `The cone metric did not converge. Very thin triangles are a common cause. ${KEPT}`,
  map: `No map was found between the two flat surfaces. Look for a pair whose two points are not the same place. ${KEPT}`,
  composition: `A point was lost between the two flat surfaces, so there is no map to trust. ${KEPT}`,
  'not-certified': `The map that was found is not bijective, so it is not shown. More landmarks where the shapes differ most usually help. ${KEPT}`,
};

const INSTEAD: Readonly<Record<string, string>> = {
  cancelled: `The computation stopped before it had a map. ${KEPT}`,
  trap: `The computation stopped unexpectedly, perhaps for want of memory. ${KEPT}`,
  'no-core': `The part of the program that reads meshes and makes maps could not be fetched. ${KEPT} Look at your connection and try again.`,
  worker: `The computation could not be started or broke off. ${KEPT} Try again, or reload the page.`,
};

function asSentence(text: string): string {
  // An option of the command line does not help in the page.
  const trimmed = text.trim().replace(/ \(--[a-z-]+\)/g, '');
  // glTF is a name and stays.
  const start = trimmed.startsWith('glTF') ? trimmed : trimmed.charAt(0).toUpperCase() + trimmed.slice(1);
  return /[.!?]$/.test(start) ? start : `${start}.`;
}

/** A sentence about a failure; the core's own words where the code has none here. */
export function failureSentence(failure: Failure): string {
  const instead = INSTEAD[failure.code];
  if (instead !== undefined) {
    return instead;
  }
  const about = ABOUT[failure.code];
  const message = asSentence(failure.message);
  return about === undefined ? message : `${about} (${message.slice(0, -1)})`;
}

/** A failure of one file. */
export function fileSentence(file: string, failure: Failure): string {
  return `${file}: ${failureSentence(failure)}`;
}

/** The label of the button for a repair that is offered. */
export function repairCommand(offer: RepairOffer): string {
  if (offer.kind === 'keep-largest') {
    return `Keep the largest part (${Math.round(100 * offer.share)} % of the area)`;
  }
  return `Cut ${count(offer.handles, 'handle')} and cap ${offer.handles === 1 ? 'it' : 'them'}`;
}

/** A sentence about what was done to a mesh that had been refused; `repairs` is the core's account of it. */
export function repairedSentence(file: string, repairs: string): string {
  return `${file}: ${asSentence(repairs)}`;
}

/** A number of things, such as "1 pair" or "12 pairs". */
export function count(number: number, thing: string): string {
  return `${number} ${thing}${number === 1 ? '' : 's'}`;
}

/** A pair by its number, and its label where it has one. */
export function pairName({ number, label }: Pick<Pair, 'number' | 'label'>): string {
  return label === '' ? String(number) : `${number} (${label})`;
}

/** A sentence about a finding; `name` gives a pair's name from its place in the run's order. */
export function findingSentence(finding: Finding, name: (order: number) => string): string {
  const [first, second] = finding.pairs;
  if (finding.kind === 'swapped' && first !== undefined && second !== undefined) {
    return `The targets of the pairs ${name(first)} and ${name(second)} look swapped: exchanged with each other they would fit the source. Exchange them.`;
  }
  if (finding.kind === 'misplaced' && first !== undefined && finding.near !== null) {
    return `Pair ${name(first)} does not fit the others: its target is expected elsewhere, near that of pair ${name(finding.near)}.`;
  }
  return finding.sentence;
}

/** A deleted pair. */
export function pairGone(number: number): string {
  return `Landmark pair ${number} deleted.`;
}

/** A sentence about a mesh that came without files that it names. */
export function missingParts(name: string, parts: readonly string[]): string {
  return `${name}: its data is in ${parts.join(', ')}. Drop all of these files at once.`;
}

/** The first remark about landmarks that were read, and how many more there are. */
export function remarksSentence(remarks: readonly string[]): string {
  const [first = '', ...more] = remarks;
  return `${asSentence(first)}${more.length === 0 ? '' : ` ${count(more.length, 'more remark')}.`}`;
}

/** A sentence about pictures of a mesh that the browser cannot decode. */
export function unreadPictures(name: string, number: number): string {
  return `${name}: this browser cannot decode ${count(number, 'picture')} of it; the mesh is shown without.`;
}

/** A sentence about pairs that were replaced, or removed with their meshes. */
export function pairsGone(number: number): string {
  return `${count(number, 'landmark pair')} removed.`;
}

/** A sentence about the pairs that a search has found, and about others that were removed for them. */
export function foundSentence(came: number, went: number): string {
  const others = went === 0 ? '' : ` ${count(went, 'other pair')} removed.`;
  return `${count(came, 'landmark pair')} found.${others}`;
}

/** A sentence about pairs that another answer of a search has added or changed, and about others that were removed for them. */
export function takenSentence(came: number, went: number): string {
  const others = went === 0 ? '' : ` ${count(went, 'other pair')} removed.`;
  return `${count(came, 'landmark pair')} placed as in the chosen answer.${others}`;
}

/** A sentence about soft pairs that a run has moved; `farthest` is the longest way, in units of the root of the target's area. */
export function settledSentence(settled: number, farthest: number): string {
  const pairs = settled === 1 ? 'The soft pair' : count(settled, 'soft pair');
  return `${pairs} settled, ${settled === 1 ? '' : 'at most '}${(100 * farthest).toFixed(1)} % of the target’s size away, and ${settled === 1 ? 'is' : 'are'} held there.`;
}

/** A sentence about the user's own work, which a demo has replaced. */
export function workGone(name: string, pairs: number): string {
  return `The demo took the place of ${name}${pairs === 0 ? '' : ` with ${count(pairs, 'landmark pair')}`}.`;
}

/** A sentence about pairs whose points on one mesh were removed with it. */
export function pointsGone(number: number): string {
  return `${count(number, 'landmark pair')} lost a point with its mesh; the partners wait for new ones.`;
}

/** A sentence about pairs whose points on one mesh were replaced by those of a file. */
export function pointsReplaced(number: number): string {
  return `${count(number, 'landmark pair')} lost a point.`;
}

/** A sentence about the deletion of all pairs but the locked ones. */
export function clearedSentence(deleted: number, locked: number): string {
  const stayed = locked === 0 ? '' : ` ${count(locked, 'locked pair')} stayed.`;
  return `${count(deleted, 'landmark pair')} deleted.${stayed}`;
}

export const SENTENCES = {
  noWebGl:
    'This browser offers no WebGL 2, so the meshes cannot be drawn; files can still be read, and maps made. Turn on hardware acceleration or use a current browser.',
  noCore: 'The program could not be loaded. Reload the page; if that does not help, use a current browser.',
  contextLost: 'The browser has lost its connection to the graphics card, so the meshes are not drawn. They come back by themselves when it is there again.',
  contextGone: 'The views could not be rebuilt after the graphics card was lost. Reload the page.',
  tooManyMeshes: 'Drop at most two meshes at once: a source and a target.',
  twoLandmarkFiles: 'Drop one landmark file at a time, or one for each mesh.',
  landmarksLeftOut: 'The landmarks were left out: drop them again when both meshes are there.',
  meshesFirst: 'these landmarks are points in space: load their mesh first, or together with them.',
  whichMesh:
    'these landmarks are for one mesh: drop the file on the view of that mesh, or open it by the menu above the list of landmarks.',
  partsAlone: 'this is a part of a mesh: drop it together with the OBJ or glTF that names it.',
  brokenZip: 'this zip cannot be unpacked: it may be damaged or cut off.',
  largeZip: 'this zip unpacks to more than the page can take.',
  manyInZip: 'this zip holds more than 1000 files: put only the meshes and their parts into it.',
  mapNotKept: 'The map of this work was not kept: make it again, or open its file if you have saved it.',
  mapOfOthers: 'The last map is of other meshes, and comes back with them.',
  noDemo: 'There is no demo of that name. All demos are in the step Meshes.',
  whileRunning: 'A map is being computed. Cancel it first, then change the meshes.',
  folder: 'is a folder: drop the files that are in it.',
  unreadable: 'could not be read from the disk.',
  unexpected: 'Something unexpected went wrong in the page. Your files are untouched; reload if the page no longer answers.',
  otherMeshes: 'Load the meshes of these landmarks first, or together with them.',
  keptMisfit: 'The landmarks are kept: load the mesh that they were made for, or clear them.',
  empty: 'is empty.',
  tooLarge: 'is larger than 1 GiB, more than the page can take.',
  nothingToSuggest: 'No further place to suggest: the landmarks cover this mesh.',
  bringingBack: 'Bringing back your work…',
  keepsNothing: 'In this browser the page can keep nothing: save your landmarks as a file before you leave.',
  keepsNoMore: 'Your work is not kept in this browser any more: save your landmarks as a file before you leave.',
  noRoom: 'This browser has no room left to keep your work: save your landmarks as a file before you leave.',
  keptUnreadable: 'Work of an earlier visit could not be read and was left out.',
  keptByOther: 'Work that another version of this page kept was left as it is.',
  mirrored: 'The target is its mirror image now, with the landmarks on it.',
  notItsShape: 'The source shows another shape than its own. Move its slider back to the left to place landmarks on it.',
  allLocked: 'All landmark pairs are locked. Unlock those that may go.',
  upToDate: 'This map was made from these meshes, landmarks and options already.',
  nothingToShare: 'There is nothing to share yet: open a mesh or a demo first.',
  noLink: 'No link can be made: it would be too long, or the page was not opened by https, which links to your own files need. Save the project file instead: it holds everything.',
  aboutProject: 'One file with both meshes, the landmarks, the options, the views and the map; drop it on the page to go on',
  newVersion: 'A new version of this page is ready.',
  exchangedMeshes: 'its source is the page’s target, and its target is the page’s source: swap source and target first.',
  oneMap: 'Drop one map at a time.',
  mapGone: 'The meshes of this map have gone from the page, so it was not opened.',
  noReport: 'the map file, section "report": it is not the report of a run.',
  mirroredMap: 'This map goes to the mirror image of the target; a map made here goes to the target as it is.',
  badPoint: 'Some landmarks do not belong to these meshes. Load the meshes that the landmark file was made for.',
} as const;

/** A sentence about a point that was picked a second time. */
export function pointTaken(side: 0 | 1, pair: number): string {
  return `This point of the ${side === 0 ? 'source' : 'target'} belongs to pair ${pair} already. Pick another one.`;
}

/** A sentence about a locked pair that was to be moved or deleted. */
export function pairLocked(pair: number): string {
  return `Pair ${pair} is locked. Unlock it first.`;
}

/** A length in units of a mesh's size, as a percentage of that size. */
function ofItsSize(length: number): string {
  const percent = 100 * length;
  return `${percent.toFixed(percent < 0.995 ? 2 : 1)} % of its size`;
}

/** A sentence about a partner that does not lie exactly at its mirror image. */
export function farPartner(side: 0 | 1, distance: number): string {
  return `The partner on the ${side === 0 ? 'source' : 'target'} lies ${ofItsSize(distance)} off its mirror image. Look whether it fits, or drag it.`;
}

/** A sentence about a plane that mirrors a mesh: the best one, which may not fit, or one that the user has chosen. */
export function planeSentence(name: string, { misfit, fits }: { readonly misfit: number; readonly fits: boolean }, isChosen: boolean): string {
  const off = ofItsSize(misfit);
  if (isChosen) {
    return `Mirrored at this plane, the ${name} is ${off} off on average.`;
  }
  return fits
    ? `The ${name} is symmetric: its mirror image is ${off} off on average.`
    : `The ${name} has no plane of symmetry: its mirror image at the best plane is ${off} off on average. Choose a plane, or place the landmarks of both sides yourself.`;
}

/** A sentence about what has changed since the map of the same meshes was made. */
export function staleSentence(changes: {
  readonly placed: readonly number[];
  readonly moved: readonly number[];
  readonly softened: readonly number[];
  readonly removed: readonly number[];
  readonly options: readonly string[];
}): string {
  const { placed, moved, softened, removed, options } = changes;
  const pairs = (numbers: readonly number[], done: string): string[] =>
    numbers.length === 0 ? [] : [numbers.length === 1 ? `pair ${numbers[0] ?? ''} was ${done}` : `${count(numbers.length, 'pair')} were ${done}`];
  const words = [
    ...pairs(placed, 'added'),
    ...pairs(moved, 'moved'),
    ...pairs(softened, 'made soft or held again'),
    ...pairs(removed, 'removed'),
    ...(options.length === 0 ? [] : ['the options changed']),
  ];
  const last = words.pop() ?? 'something changed';
  return `This map was made before ${words.length === 0 ? last : `${words.join(', ')} and ${last}`}.`;
}

/** The offer to continue work of an earlier visit. */
export function offerSentence(name: string, pairs: number): string {
  return `Continue with ${name}, ${count(pairs, 'pair')}?`;
}

/** The name of a suggestion in a sentence. */
export function suggestionName({ letter, reason, partner }: Suggestion, all: readonly Suggestion[], taking: Taking): string {
  const what = reason === 'tip' ? 'the end of a limb' : 'a place far from all landmarks';
  const isThere = all.some((other) => other.letter === partner);
  return `${letter}, ${what}${partner !== null && isThere ? `, looks like ${partner}: ${taking === 'together' ? 'both are taken together' : 'mind left and right'}` : ''}`;
}

/** A hint at what to do next. */
export function hint(options: {
  /** How many meshes there are, of two. */
  readonly meshes: number;
  /** The pair that waits for its other point, the name of the mesh on which it is asked for, and whether the map proposes one. */
  readonly asked: { readonly pair: number; readonly mesh: string; readonly isProposed: boolean } | null;
  /** Pairs with both points. */
  readonly pairs: number;
  /** The number of half pairs that wait behind the one whose turn it is. */
  readonly waiting: number;
}): string {
  if (options.meshes < 2) {
    return options.meshes === 0 ? 'Drop two closed meshes, or look at a demo.' : 'Drop the other mesh.';
  }
  if (options.asked !== null) {
    const waiting = options.waiting > 0 ? ` ${options.waiting} more wait; Escape skips this one.` : '';
    const { pair, mesh, isProposed } = options.asked;
    return isProposed
      ? `Pair ${pair}: click the see-through pin that the map proposes on the ${mesh} to take it (Enter), or click another place.`
      : `Pair ${pair}: now click the same place on the ${mesh}.${waiting}`;
  }
  if (options.pairs < 4) {
    const missing = 4 - options.pairs;
    return `Click a place on either mesh to begin a pair. ${missing} more ${missing === 1 ? 'is' : 'are'} needed.`;
  }
  return 'Click a place on either mesh to add a pair, or make the map.';
}

/** Why a link is not opened. */
export const LINK_REFUSED = {
  'too-long': 'This link is longer than any that this page makes, so it is not opened.',
  newer:
    'This link was made by a newer version of this page. Reload the page to get that version; if nothing changes, ask for the project file instead.',
  damaged: 'This link is damaged: perhaps it was cut off on its way. Ask for it again.',
  'no-mesh': 'This link names no mesh: it needs source= or target= with the address of one.',
  'no-address': 'This link holds something that is no address of a file. Ask for it again.',
  'not-https': 'This link names a file whose address does not begin with https://, so nothing is loaded.',
  'has-password': 'This link names a file whose address holds a user name or a password, so nothing is loaded.',
} as const;
export type LinkFault = keyof typeof LINK_REFUSED;

/** A sentence about a mesh that is not the map's. `wanted` is the name of the right one in the map. */
export function otherMesh(side: 0 | 1, found: string, wanted: string | null): string {
  const right = wanted === null || wanted === found ? '' : ` (${wanted})`;
  return `the ${side === 0 ? 'source' : 'target'}, ${found}, is not the mesh that this map was made with${right}. Drop the map together with the right one.`;
}

/** A mesh that is not on the page; its name is `null` where it is not known. */
interface MissingMesh {
  readonly side: 0 | 1;
  readonly name: string | null;
}

function waitingFor(whose: 'its' | 'their', missing: readonly MissingMesh[]): string {
  const meshes = missing.map(({ side, name }) => `${whose} ${side === 0 ? 'source' : 'target'}${name === null ? '' : ` (${name})`}`);
  return `for ${listed(meshes)}: drop ${missing.length === 1 ? 'it' : 'them'} here.`;
}

/** A sentence about the meshes that a map waits for. */
export function mapWaits(name: string, missing: readonly MissingMesh[]): string {
  return `${name} waits ${waitingFor('its', missing)}`;
}

/** A sentence about the meshes that landmark pairs wait for. */
export function landmarksWait(pairs: number, missing: readonly MissingMesh[]): string {
  return `${count(pairs, 'landmark pair')} ${pairs === 1 ? 'waits' : 'wait'} ${waitingFor(pairs === 1 ? 'its' : 'their', missing)}`;
}

/** A remark about landmarks of a file that names other meshes, without a full stop. */
export function madeForOthers(names: readonly string[]): string {
  return `these landmarks were made for ${listed(names)}, and may lie elsewhere on these meshes: look whether they fit, or drop the ${names.length === 1 ? 'mesh' : 'meshes'} here`;
}

/** A sentence about a map that was opened from a file. */
export function reopenedSentence(name: string): string {
  return `Opened from ${name}: nothing was computed. The program checked that its pieces are a map of these meshes, and measured its distortion anew.`;
}

/** Several names joined for a sentence. */
export function listed(names: readonly string[]): string {
  return names.length < 2 ? names.join('') : `${names.slice(0, -1).join(', ')} and ${names.at(-1) ?? ''}`;
}

/** Why a file of a link could not be fetched. */
export function fetchSentence(
  fault: { readonly kind: 'unreachable' | 'moved' | 'too-large' | 'cancelled' } | { readonly kind: 'status'; readonly status: number },
  name: string,
  host: string | null,
): string {
  const where = host ?? 'this page’s server';
  switch (fault.kind) {
    case 'unreachable':
      return `${where} does not answer, or does not let other pages read ${name}. Download the file there and drop it here.`;
    case 'moved':
      return `${where} redirects ${name} to another address, to which you have not agreed. Ask for a link with that address, or download the file and drop it here.`;
    case 'status':
      return fault.status === 404
        ? `${where} has no ${name} at this address. Ask for the link again.`
        : `${where} did not give ${name} (its answer was ${fault.status}). Try again later, or download the file there and drop it here.`;
    case 'too-large':
      return `${name} is larger than 256 MB, the most that is loaded by a link. Download the file and drop it here.`;
    case 'cancelled':
      return 'Nothing was loaded.';
  }
}

/** The question before files of a link are loaded from other hosts: "Load cat.obj and lion.obj (2 files) from example.org?" */
export function loadQuestion(hosts: readonly { readonly host: string; readonly names: readonly string[] }[]): string {
  const parts = hosts.map(({ host, names }) => `${listed(names)}${names.length > 1 ? ` (${names.length} files)` : ''} from ${host}`);
  return `Load ${listed(parts)}?`;
}

/** A number of bytes in megabytes, such as "12.3 MB". */
function megabytes(bytes: number): string {
  return `${(bytes / 1e6).toFixed(1)} MB`;
}

/** A sentence about the file that is being loaded, and how much of it has come. */
export function loadingSentence(file: { readonly name: string; readonly loaded: number; readonly expected: number | null }): string {
  const of = file.expected === null ? '' : ` of ${megabytes(file.expected)}`;
  return `Loading ${file.name}: ${megabytes(file.loaded)}${of}`;
}

/** A sentence about the files that a link waits for. */
export function filesNeeded(names: readonly string[]): string {
  return `This link needs ${listed(names)}: drop ${names.length === 1 ? 'it' : 'them'} here.`;
}

/** A sentence about files that were dropped for a link and are not those that it means. */
export function otherFiles(given: readonly string[], needed: readonly string[]): string {
  const isSameName = given.some((name) => needed.includes(name));
  const what = given.length === 1 ? 'is not a file' : 'are not files';
  const hint = isSameName ? ' The name fits, but the content differs.' : '';
  return `${listed(given)} ${what} of this link.${hint} It still needs ${listed(needed)}.`;
}

/** A sentence about what whoever opens the link will see. */
export function prospectSentence(prospect: {
  readonly needed: readonly string[];
  readonly loaded: readonly { readonly host: string }[];
  readonly isLong: boolean;
}): string {
  const { needed, loaded, isLong } = prospect;
  const hosts = listed(loaded.map(({ host }) => host));
  const sees =
    needed.length > 0
      ? `Whoever opens it needs ${listed(needed)} as well: send ${needed.length === 1 ? 'the file' : 'the files'} along, or send the project file, which holds everything.`
      : loaded.length > 0
        ? `Whoever opens it sees everything, after one click that loads the meshes from ${hosts}.`
        : 'Whoever opens it sees everything: meshes, landmarks, options and both views.';
  return isLong ? `${sees} It is longer than 2,000 characters, and some mail programs cut such links.` : sees;
}

/** Why a project file is not opened. */
export const PROJECT_REFUSED = {
  'no-archive': 'this is no project file, or it is damaged.',
  'no-project': 'this archive is no project: it has no file conemap.json.',
  newer: 'this project was saved by a newer version of this page. Reload the page to get that version.',
  damaged: 'this project is damaged: its conemap.json does not say what it should.',
  'mesh-missing': 'this project is damaged: it lacks a mesh that it names.',
  'mesh-changed': 'a mesh in this project is not the one that its landmarks were made on.',
  'too-many': 'this archive holds more than 1,000 files, so it is not opened.',
  'too-large': 'this archive becomes larger than 1 GiB, so it is not opened.',
} as const;
export type ProjectFault = keyof typeof PROJECT_REFUSED;
