/** Follows the link in the page's address: asks the user where it must, and puts what the link brings onto the page. */
import type { NamedBytes } from '../files.ts';
import { eventsOfSides } from '../opening.ts';
import { fetchSentence, LINK_REFUSED, otherFiles, SENTENCES } from '../messages.ts';
import type { Link, LinkedFile } from '../send/link.ts';
import { readLink } from '../send/link.ts';
import type { Delivery } from '../send/receiver.ts';
import { Receiver } from '../send/receiver.ts';
import type { DemoFiles, ReadFile } from '../reading/messages.ts';
import type { FileReader } from '../reading/reader.ts';
import type { Event } from '../store/events.ts';
import type { Allowed } from '../store/refused.ts';
import { ALL_ALLOWED } from '../store/refused.ts';
import type { Demo, MeshFile, Work } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { isSameWork } from '../store/work.ts';
import { buildDemo, demoEvents, openDemo, showOwnLink } from './open.ts';
import type { ArrivingMesh } from './sent-work.ts';
import { place, readArriving, withMeshes } from './sent-work.ts';
import type { Outcome } from './task.ts';
import { perform } from './task.ts';

const ORIGIN = 'The link';

/** Takes the link out of the page's address, so that a reload does not put it over later work. */
function forget(): void {
  history.replaceState(null, '', location.pathname + location.search);
}

/**
 * Follows links. A link stays in the address where a reload may mend what has failed, since its files or the program could not be loaded,
 * until other work is on the page. Another link that has come into the address meanwhile is left alone.
 */
export class Links {
  readonly #store: Store;
  readonly #reader: FileReader;
  readonly #receiver: Receiver;
  /** The hash of the link that was begun last. */
  #begun = '';
  /** The hash of a link that has failed and that a reload would follow again; `null` for none. */
  #failed: string | null = null;

  constructor(store: Store, reader: FileReader) {
    this.#store = store;
    this.#reader = reader;
    this.#receiver = new Receiver({
      changed: (receiving) => {
        store.dispatch({ kind: 'receiving', receiving });
      },
      delivered: (delivery) => {
        void this.#open(delivery);
      },
      failed: (fault, { name, host }) => {
        this.#failed = this.#begun;
        store.dispatch({ kind: 'error', sentence: fetchSentence(fault, name, host) });
      },
    });
    store.subscribe((state, previous) => {
      if (this.#failed !== null && !isSameWork(state, previous)) {
        this.#end(this.#failed, 'left-out');
      }
    });
  }

  /** What the page's address names: the id of a demo, or the whole hash of another link; `null` for nothing. */
  get named(): string | null {
    const reading = readLink(location.hash, new URL(document.baseURI));
    const isDemo = reading.kind === 'link' && reading.link.work === null && reading.link.demo !== null;
    return reading.kind === 'none' ? null : isDemo ? reading.link.demo : location.hash;
  }

  /** Follows the link in the page's address. A link that asks or waits continues by itself later, and a refused one shows why. */
  async follow(): Promise<'none' | 'opened' | 'followed'> {
    const { state, dispatch } = this.#store;
    const reading = readLink(location.hash, new URL(document.baseURI));
    switch (reading.kind) {
      case 'none':
        return 'none';
      case 'refused':
        forget();
        dispatch({ kind: 'error', sentence: LINK_REFUSED[reading.fault] });
        return 'followed';
      case 'link':
        if (state.job.kind === 'running') {
          dispatch({ kind: 'error', sentence: SENTENCES.whileRunning });
          return 'followed';
        }
        return (await this.#begin(reading.link)) ? 'opened' : 'followed';
    }
  }

  /** Loads the files of the link, after the click that it waits for. */
  readonly accept = (): void => {
    if (this.#store.state.job.kind === 'running') {
      this.#store.dispatch({ kind: 'error', sentence: SENTENCES.whileRunning });
    } else {
      this.#receiver.accept();
    }
  };

  /** Gives the link up, and puts the link of what is on the page into the address in its place. */
  readonly cancel = (): void => {
    this.#receiver.cancel();
    this.#end(this.#begun, 'left-out');
  };

  /** Whether the link waits for files. */
  get waits(): boolean {
    return this.#receiver.receiving.kind === 'files';
  }

  /** Takes the files that the link waits for, and shows which of the given files it does not want. */
  async take(files: readonly NamedBytes[]): Promise<void> {
    const others = await this.#receiver.take(files);
    const { receiving } = this.#receiver;
    if (others.length > 0 && receiving.kind === 'files') {
      const sentence = otherFiles(
        others.map(({ name }) => name),
        receiving.missing.map(({ name }) => name),
      );
      this.#store.dispatch({ kind: 'error', sentence });
    } else {
      this.#store.dispatch({ kind: 'error-closed' });
    }
  }

  /** Begins with a link; returns whether the demo that it names has come. */
  async #begin(link: Link): Promise<boolean> {
    const hash = location.hash;
    this.#begun = hash;
    this.#failed = null;
    const { demo: id, work } = link;
    if (id === null) {
      this.#receiver.receive(link);
      return false;
    }
    this.#receiver.cancel();
    const demo = this.#store.state.demos.find((candidate) => candidate.id === id);
    if (demo === undefined) {
      forget();
      this.#store.dispatch({ kind: 'error', sentence: SENTENCES.noDemo });
      return false;
    }
    if (work !== null) {
      await this.#openDemoWork(hash, demo, work);
      return false;
    }
    return id !== this.#store.state.demo?.id && openDemo(this.#store, this.#reader, id);
  }

  async #openDemoWork(hash: string, demo: Demo, work: NonNullable<Link['work']>): Promise<void> {
    const outcome = await perform(
      this.#store,
      'Opening the link…',
      (signal) => buildDemo(this.#reader, demo, signal),
      (built) => {
        const meshes = demoMeshes(demoEvents(demo, built));
        try {
          place(this.#store, ORIGIN, work, meshes, demo);
        } catch (thrown) {
          meshes.forEach((file) => file?.mesh.free());
          throw thrown;
        }
      },
    );
    this.#end(hash, outcome);
  }

  /** Puts the link of what is on the page into the address in place of the followed one, unless a reload is to follow that again. */
  #end(hash: string, outcome: Outcome): void {
    if (location.hash !== hash) {
      return;
    }
    this.#failed = outcome === 'not-loaded' ? hash : null;
    if (outcome !== 'not-loaded') {
      showOwnLink(this.#store.state);
    }
  }

  async #open(delivery: Delivery): Promise<void> {
    const hash = this.#begun;
    if (this.#store.state.job.kind === 'running') {
      // A run has begun while the files came, so the link stays in the address, and a reload opens it.
      this.#store.dispatch({ kind: 'error', sentence: SENTENCES.whileRunning });
      return;
    }
    const { link: { work }, landmarks } = delivery;
    const outcome = await perform(
      this.#store,
      'Opening the link…',
      // A link without work is treated like dropped files: the user has not agreed to any repair.
      (signal) => this.#read(delivery, work === null ? {} : ALL_ALLOWED, signal),
      (read) => {
        if (work === null) {
          this.#store.dispatch(...eventsOfSides(read, landmarks, this.#store.state));
          return;
        }
        withMeshes(read, (loaded) => {
          place(this.#store, ORIGIN, work, loaded, null);
        });
      },
    );
    this.#end(hash, outcome);
  }

  /** Reads the meshes that have come, and builds those of demos. */
  async #read({ link, meshes }: Delivery, allowed: Allowed, signal: AbortSignal): Promise<readonly [ReadFile | null, ReadFile | null]> {
    const arriving = (mesh: Delivery['meshes'][0]): ArrivingMesh | null => mesh && { ...mesh, address: mesh.address?.url ?? null };
    const built = new Map<string, Promise<DemoFiles>>();
    const demoMesh = async (file: LinkedFile | null): Promise<ReadFile | null> => {
      if (file?.kind !== 'demo') {
        return null;
      }
      const demo = built.get(file.id) ?? buildDemo(this.#reader, file, signal);
      built.set(file.id, demo);
      return (await demo).meshes[file.side];
    };
    const [[source, target], demoSource, demoTarget] = await Promise.all([
      readArriving(this.#reader, [arriving(meshes[0]), arriving(meshes[1])], allowed, signal),
      demoMesh(link.files[0]),
      demoMesh(link.files[1]),
    ]);
    return [source ?? demoSource, target ?? demoTarget];
  }
}

/** The meshes of a demo's events. */
function demoMeshes(events: readonly Event[]): Work['meshes'] {
  const meshes: [MeshFile | null, MeshFile | null] = [null, null];
  for (const event of events) {
    if (event.kind === 'mesh') {
      meshes[event.side] = event.file;
    }
  }
  return meshes;
}
