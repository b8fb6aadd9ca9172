/** Lays a picture of the user on the flat metric. */
import type { Failure } from '../compute/messages.ts';
import { failureOf } from '../compute/messages.ts';
import { fileSentence } from '../messages.ts';
import type { Store } from '../store/store.ts';
import type { Pixels } from '../viewer/decoded.ts';
import { decoded } from '../viewer/decoded.ts';
import { checkPicture } from '../wasm/page.js';

/** The largest picture file, in bytes; no camera makes larger ones. */
const LARGEST = 64 * 2 ** 20;

/** How many pictures were asked for, so that a slow one does not replace one that was chosen after it. */
let asked = 0;

/**
 * The pixels of a picture; `null` where it cannot be decoded, and the reason where its header alone shows it: a small file can hold a
 * picture of any size.
 */
async function read(file: File): Promise<Pixels | Failure | null> {
  const bytes = await file.arrayBuffer().catch(() => null);
  if (bytes === null) {
    return null;
  }
  const picture = new Uint8Array(bytes);
  try {
    checkPicture(picture);
  } catch (thrown) {
    return failureOf(thrown);
  }
  return decoded(picture);
}

/** Reads a picture and shows it; where it cannot be read the page says so, and the last picture stays. */
export async function openTexturePicture(store: Store, file: File): Promise<void> {
  const number = ++asked;
  const tell = (sentence: string): void => {
    store.dispatch({ kind: 'error', sentence });
  };
  if (file.size > LARGEST) {
    tell(`${file.name} has ${Math.ceil(file.size / 2 ** 20)} MiB; a picture may have 64. Make it smaller.`);
    return;
  }
  const picture = await read(file);
  if (number !== asked) {
    return;
  }
  if (picture === null) {
    tell(`${file.name} is no picture that this browser can read: choose a PNG, JPEG or WebP file.`);
    return;
  }
  if ('code' in picture) {
    tell(fileSentence(file.name, picture));
    return;
  }
  store.dispatch({ kind: 'texture-picture', picture: { name: file.name, ...picture } });
}
