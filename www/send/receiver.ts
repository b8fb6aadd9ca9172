/**
 * Receives a link: asks before anything is fetched from another host, fetches the files, waits for those that must be given by hand, and
 * hands everything over at once. Until then nothing on the page changes.
 */
import { SIDES } from '../landmarks.ts';
import type { HostFiles, Missing, Receiving } from '../store/receiving.ts';
import type { Address } from './address.ts';
import type { FetchFault } from './fetching.ts';
import { fetchBytes, FetchRefused } from './fetching.ts';
import { hashOf } from './hash.ts';
import type { Link, LinkedFile } from './link.ts';

/** The bytes of a file with its name. */
interface NamedBytes {
  readonly name: string;
  readonly bytes: Uint8Array;
}

/** A mesh of a link that has come, with the address from which it was loaded; `null` where it was given by hand. */
export interface Arrived extends NamedBytes {
  readonly address: Address | null;
}

/** A link with all files that it needs; the meshes of demos are not among them. */
export interface Delivery {
  readonly link: Link;
  readonly meshes: readonly [Arrived | null, Arrived | null];
  readonly landmarks: NamedBytes | null;
}

/** The listener of a receiver. */
export interface ReceiverListener {
  changed(receiving: Receiving): void;
  /** Called when everything has come. */
  delivered(delivery: Delivery): void;
  failed(fault: FetchFault, address: Address): void;
}

/** The addresses in a link, each listed once. */
function addressesOf(link: Link): Address[] {
  const files = link.files.flatMap((file) => (file?.kind === 'address' ? [file.address] : []));
  const all = link.landmarks === null ? files : [...files, link.landmarks];
  return all.filter((address, index) => all.findIndex(({ url }) => url === address.url) === index);
}

/** The files that a link loads from hosts other than the page's own. */
export function foreignFiles(link: Link): HostFiles[] {
  const hosts = new Map<string, string[]>();
  for (const { host, name } of addressesOf(link)) {
    if (host !== null) {
      hosts.set(host, [...(hosts.get(host) ?? []), name]);
    }
  }
  return [...hosts].map(([host, names]) => ({ host, names }));
}

/** A link whose files are still coming. */
interface Arrival {
  readonly link: Link;
  readonly abort: AbortController;
  readonly fetched: Map<string, Uint8Array>;
  /** The files that were given by hand, by their hashes. */
  readonly given: Map<string, NamedBytes>;
}

export class Receiver {
  readonly #listener: ReceiverListener;
  #arrival: Arrival | null = null;
  #receiving: Receiving = { kind: 'nothing' };

  constructor(listener: ReceiverListener) {
    this.#listener = listener;
  }

  get receiving(): Receiving {
    return this.#receiving;
  }

  /** Begins with a link, and gives up an earlier one that is not finished. */
  receive(link: Link): void {
    this.cancel();
    const arrival: Arrival = { link, abort: new AbortController(), fetched: new Map(), given: new Map() };
    this.#arrival = arrival;
    const hosts = foreignFiles(link);
    if (hosts.length > 0) {
      this.#wait({ kind: 'click', hosts });
    } else {
      void this.#fetchAll(arrival);
    }
  }

  /** Fetches the files, after the click that the link waits for. */
  accept(): void {
    if (this.#arrival !== null && this.#receiving.kind === 'click') {
      void this.#fetchAll(this.#arrival);
    }
  }

  /** Gives the link up. */
  cancel(): void {
    this.#arrival?.abort.abort();
    this.#arrival = null;
    if (this.#receiving.kind !== 'nothing') {
      this.#wait({ kind: 'nothing' });
    }
  }

  /** Takes the files that the link waits for, and returns the others. */
  async take(files: readonly NamedBytes[]): Promise<readonly NamedBytes[]> {
    const arrival = this.#arrival;
    if (arrival === null || this.#receiving.kind !== 'files') {
      return files;
    }
    const wanted = new Set(arrival.link.files.flatMap((file) => (file?.kind === 'local' ? [file.hash] : [])));
    const others: NamedBytes[] = [];
    for (const file of files) {
      const hash = await hashOf(file.bytes);
      if (hash !== null && wanted.has(hash)) {
        arrival.given.set(hash, file);
      } else {
        others.push(file);
      }
    }
    if (arrival === this.#arrival) {
      this.#goOn(arrival);
    }
    return others;
  }

  #wait(receiving: Receiving): void {
    this.#receiving = receiving;
    this.#listener.changed(receiving);
  }

  async #fetchAll(arrival: Arrival): Promise<void> {
    const { link, abort, fetched } = arrival;
    try {
      for (const address of addressesOf(link)) {
        const { name } = address;
        this.#wait({ kind: 'fetch', name, loaded: 0, expected: null });
        const bytes = await fetchBytes(address, {
          signal: abort.signal,
          progress: (loaded, expected) => {
            if (arrival === this.#arrival) {
              this.#wait({ kind: 'fetch', name, loaded, expected });
            }
          },
        });
        if (arrival !== this.#arrival) {
          return;
        }
        fetched.set(address.url, bytes);
      }
      this.#goOn(arrival);
    } catch (thrown) {
      // A link that was given up reports nothing.
      if (arrival === this.#arrival) {
        this.cancel();
        if (!(thrown instanceof FetchRefused)) {
          throw thrown;
        }
        this.#listener.failed(thrown.fault, thrown.address);
      }
    }
  }

  /** Waits for the files that are missing, or hands everything over. */
  #goOn(arrival: Arrival): void {
    const missing = SIDES.flatMap((side): Missing[] => {
      const file = arrival.link.files[side];
      return file?.kind === 'local' && !arrival.given.has(file.hash) ? [{ side, name: file.name }] : [];
    });
    if (missing.length > 0) {
      this.#wait({ kind: 'files', missing });
      return;
    }
    this.#arrival = null;
    this.#wait({ kind: 'nothing' });
    this.#listener.delivered(delivery(arrival));
  }
}

function delivery({ link, fetched, given }: Arrival): Delivery {
  const arrived = (file: LinkedFile | null): Arrived | null => {
    switch (file?.kind) {
      case undefined:
      case 'demo':
        return null;
      case 'address': {
        const bytes = fetched.get(file.address.url);
        return bytes === undefined ? null : { name: file.address.name, bytes, address: file.address };
      }
      case 'local': {
        const bytes = given.get(file.hash)?.bytes;
        return bytes === undefined ? null : { name: file.name, bytes, address: null };
      }
    }
  };
  const landmarks = link.landmarks === null ? undefined : fetched.get(link.landmarks.url);
  return {
    link,
    meshes: [arrived(link.files[0]), arrived(link.files[1])],
    landmarks: landmarks === undefined || link.landmarks === null ? null : { name: link.landmarks.name, bytes: landmarks },
  };
}
