/** A map file that waits for its meshes. */

/** A mesh that a map was made with. */
export interface WantedMesh {
  /** What the map's landmarks call it; `null` where they do not. */
  readonly name: string | null;
  /** The core's hash of the mesh as it was checked. */
  readonly checked: string;
}

/** A map file with the source and the target that it was made with. */
export interface AwaitedMap {
  readonly name: string;
  readonly bytes: Uint8Array;
  readonly meshes: readonly [WantedMesh, WantedMesh];
}
