/** A map file that waits for its meshes. */

/** A mesh that a map was made with. */
export interface WantedMesh {
  /** The mesh's name in the map's landmark file; `null` where it has none. */
  readonly name: string | null;
  /** The core's hash of the checked mesh. */
  readonly checked: string;
}

/** A map file with the source and the target that it was made with. */
export interface AwaitedMap {
  readonly name: string;
  readonly bytes: Uint8Array;
  readonly meshes: readonly [WantedMesh, WantedMesh];
}
