/** Makes the link to what is on the page. */
import type { Link, LinkedFile } from '../send/link.ts';
import { addressOf } from '../send/address.ts';
import { hashOf } from '../send/hash.ts';
import { readLink } from '../send/link.ts';
import type { Prospect } from '../send/share.ts';
import { linkAddress, prospectOf } from '../send/share.ts';
import type { MeshFile, State } from '../store/state.ts';
import { sentWorkOf } from './sent-work.ts';

/** A link, and what whoever opens it will be asked for. */
export interface SharedLink {
  readonly url: string;
  readonly prospect: Prospect;
}

const HASHES = new WeakMap<MeshFile, Promise<string | null>>();

/** The hash of a mesh's file, computed once; `null` where the browser does not allow it. */
function hashOfMesh(file: MeshFile): Promise<string | null> {
  const known = HASHES.get(file) ?? hashOf(file.bytes);
  HASHES.set(file, known);
  return known;
}

/** How a link names a mesh; `null` where it cannot. */
async function linkedFile(file: MeshFile, base: URL): Promise<LinkedFile | null> {
  if (file.ofDemo !== undefined) {
    return { kind: 'demo', ...file.ofDemo };
  }
  const address = file.address === undefined ? 'no-address' : addressOf(file.address, base);
  if (typeof address !== 'string') {
    return { kind: 'address', address };
  }
  const hash = await hashOfMesh(file);
  return hash === null ? null : { kind: 'local', name: file.name, hash };
}

/** The link to the work; `null` where the page has no meshes or cannot compute their hashes, and where the link would be too long. */
export async function sharedLink(state: State, base: URL): Promise<SharedLink | null> {
  const work = sentWorkOf(state);
  if (state.demo !== null) {
    return shared({ demo: state.demo.id, files: [null, null], landmarks: null, work }, base);
  }
  const [first, second] = state.meshes;
  const source = first && (await linkedFile(first, base));
  const target = second && (await linkedFile(second, base));
  const isEmpty = first === null && second === null;
  const isTold = (first === null) === (source === null) && (second === null) === (target === null);
  return isEmpty || !isTold ? null : shared({ demo: null, files: [source, target], landmarks: null, work }, base);
}

/** A link with its prospect; `null` for a link that no page would open, such as one with thousands of pairs. */
function shared(link: Link, base: URL): SharedLink | null {
  const url = linkAddress(link, base);
  const isReadable = readLink(new URL(url).hash, base).kind === 'link';
  return isReadable ? { url, prospect: prospectOf(link, url) } : null;
}
