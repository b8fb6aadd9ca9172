/** Opens maps from files for the meshes on the page, without computing, or keeps a map until its meshes have come. */
import type { SavedMapHandle } from '../compute/saved-client.ts';
import type { Core } from '../compute/core.ts';
import { openSavedMap, SavedMapError } from '../compute/saved-client.ts';
import type { OpenedMap as Opened } from '../compute/saved-messages.ts';
import type { NamedBytes } from '../files.ts';
import { areMarksGood, checkFit, FileRefused, landmarkFile } from '../files.ts';
import { checkMeshes, headOf, missingOf } from '../map-files.ts';
import { fileSentence, SENTENCES } from '../messages.ts';
import type { Finding, Report, RunOptions } from '../report.ts';
import { reportIn } from '../send/report.ts';
import { optionsIn } from '../send/schema.ts';
import type { AwaitedMap } from '../store/awaited.ts';
import type { Event } from '../store/events.ts';
import type { OpenedMap } from '../store/opened.ts';
import { hasPairs } from '../store/opened.ts';
import type { State } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { perform } from './task.ts';

/** What happens to landmarks and options on the page that are not those of the map. */
export type Landmarks =
  /** The map's replace them. */
  | 'brought'
  /** They stay, and the map is outdated. */
  | 'kept';

/** Whether the page has the vertices that a finding of a file names: a file may name any. */
function isSound({ side, vertices }: Finding, { meshes }: Pick<State, 'meshes'>): boolean {
  const pairs = vertices.map((point, id) => ({ id, number: id, points: [point, point] as const, label: '', locked: false }));
  return side === null || areMarksGood({ meshes: side === 0 ? [meshes[0], null] : [null, meshes[1]], pairs });
}

function reportOf(text: string, meshes: State['meshes']): Report {
  const report = reportIn(text);
  if (report === null) {
    throw new FileRefused(SENTENCES.noReport);
  }
  return { ...report, findings: report.findings.filter((finding) => isSound(finding, { meshes })) };
}

function optionsOf(text: string | null): RunOptions | null {
  return text === null ? null : optionsIn(text);
}

/** The map that the worker has read, as the page's state holds it. */
function taken(map: NamedBytes, { buffers, landmarks, options, isMirrored }: Opened, meshes: State['meshes']): OpenedMap {
  const report = reportOf(buffers.report, meshes);
  return {
    name: map.name,
    isMirrored,
    output: { ...buffers, report: JSON.stringify(report, null, 2), map: map.bytes.slice(), made: null },
    report,
    landmarks: landmarkFile({ name: map.name, bytes: landmarks }),
    options: optionsOf(options),
  };
}

export class Maps {
  readonly #store: Store;
  readonly #core: () => Core | null;

  constructor(store: Store, core: () => Core | null) {
    this.#store = store;
    this.#core = core;
    store.subscribe((state, previous) => {
      this.#follow(state, previous);
    });
  }

  /** Opens a map for the meshes on the page, or keeps it until the meshes come that it was made with. */
  async open(map: AwaitedMap, landmarks: Landmarks): Promise<void> {
    const { state, dispatch } = this.#store;
    if (missingOf(map, state.meshes).length > 0) {
      dispatch({ kind: 'map-awaited', map });
      return;
    }
    dispatch({ kind: 'map-awaited', map: null });
    await this.#read(map, landmarks);
  }

  /** Opens the map of a project, whose meshes have just come. */
  async openOfProject(file: NamedBytes): Promise<void> {
    const { state, dispatch } = this.#store;
    try {
      const map = headOf(file);
      checkMeshes(map, state.meshes, state);
      await this.open(map, 'kept');
    } catch (thrown) {
      if (!(thrown instanceof FileRefused)) {
        throw thrown;
      }
      dispatch({ kind: 'error', sentence: thrown.message });
    }
  }

  async #read(map: AwaitedMap, landmarks: Landmarks): Promise<void> {
    const { meshes } = this.#store.state;
    await perform(
      this.#store,
      `Opening ${map.name}…`,
      () => this.#opened(map, meshes),
      (opened) => {
        const { state, dispatch } = this.#store;
        if (state.meshes !== meshes) {
          throw new FileRefused(`${map.name}: ${SENTENCES.mapGone}`);
        }
        const brought: Event[] = [];
        if (landmarks === 'brought' && !hasPairs(state, opened.landmarks)) {
          brought.push({ kind: 'landmarks', file: opened.landmarks });
        }
        if (landmarks === 'brought' && opened.options !== null) {
          brought.push({ kind: 'options', options: opened.options });
        }
        checkFit(map, brought, state);
        dispatch(...brought, { kind: 'map-opened', map: opened });
      },
    );
  }

  async #opened(map: AwaitedMap, meshes: State['meshes']): Promise<OpenedMap> {
    const [source, target] = meshes;
    const core = this.#core();
    if (core === null || source === null || target === null) {
      throw new FileRefused(`${map.name}: ${SENTENCES.mapGone}`);
    }
    let saved: SavedMapHandle | null = null;
    try {
      saved = openSavedMap(core, { map: map.bytes, source: source.bytes, target: target.bytes, demo: this.#store.state.demo?.id ?? null }, 'views');
      const opened = await saved.opened;
      if (opened === null) {
        throw new Error('the worker gave no map');
      }
      return taken(map, opened, meshes);
    } catch (thrown) {
      if (thrown instanceof SavedMapError) {
        throw new FileRefused(fileSentence(map.name, thrown.failure), { failure: thrown.failure });
      }
      throw thrown;
    } finally {
      saved?.close();
    }
  }

  /** Opens the map that waits when its meshes have come. */
  #follow({ awaited, meshes, job }: State, previous: State): void {
    const isChance = meshes !== previous.meshes || job.kind !== previous.job.kind;
    if (awaited !== null && isChance && job.kind !== 'running' && missingOf(awaited, meshes).length === 0) {
      // The map is opened by a change of its own, after the present one.
      queueMicrotask(() => {
        if (this.#store.state.awaited === awaited) {
          void this.open(awaited, 'brought');
        }
      });
    }
  }
}
