/** What the page's parts ask for, and what each of them is given. */
import type { Core } from '../compute/core.ts';
import type { Side, SurfacePoint } from '../landmarks.ts';
import type { BaseHands, FlowHands, Listener, SimplificationHands, TurnedViews } from '../method/hands.ts';
import type { Planes } from '../method/plane-client.ts';
import type { prospectSentence } from '../messages.ts';
import type { OtherMap } from '../report.ts';
import type { Event } from '../store/events.ts';
import type { Examined } from '../store/defects.ts';
import type { PlaneChoice } from '../store/left-right.ts';
import type { RefusedMesh } from '../store/refused.ts';
import type { Axis, Doubt, Result, State } from '../store/state.ts';
import type { LookFrom } from '../wasm/page.js';
import type { Shell } from './shell.ts';

/** What a view's camera can be asked to do. */
export type CameraCommand =
  /** To bring the whole mesh into sight. */
  | { readonly kind: 'fit' }
  /** To go back to the first look. */
  | { readonly kind: 'reset' }
  /** To look at the whole mesh from a side. */
  | { readonly kind: 'look'; readonly from: LookFrom }
  /** To turn the picture counter-clockwise. */
  | { readonly kind: 'roll'; readonly degrees: number };

/** What panels ask for beyond a change of state. */
export interface Actions {
  /** Events that are dispatched together are one step. */
  readonly dispatch: (...events: readonly Event[]) => void;
  readonly openFiles: (files: readonly File[], side: Side | null) => void;
  /** The click that the link which was opened waits for. */
  readonly acceptLink: () => void;
  /** Gives that link up. */
  readonly cancelLink: () => void;
  /** The link to what is on the page; `null` where there can be none. */
  readonly sharedLink: () => Promise<{ readonly url: string; readonly prospect: Parameters<typeof prospectSentence>[0] } | null>;
  readonly saveProject: () => void;
  /** Lays a picture on the flat metric. */
  readonly openTexturePicture: (file: File) => void;
  /** Saves the whole pairs: as the program's own file, or in another format that the core knows by this word. */
  readonly saveLandmarks: (format?: string) => void;
  /** Makes a file of the map, by the name `made` that the core has for it, and saves it under another. */
  readonly saveMadeFile: (file: { readonly made: string; readonly name: string; readonly type: string }) => void;
  /** Saves the source's own file with its vertices laid onto the target. */
  readonly saveWrapped: () => void;
  /** What is needed to bring files across the map on the page. */
  readonly bring: { readonly core: () => Core | null; readonly shown: () => Result | null };
  /** Has the map proved by a second program. */
  readonly proveMap: () => void;
  /** Saves what the views show as a picture of twice the screen's size. */
  readonly savePicture: () => void;
  /** Begins anew with the newer build of the page. */
  readonly reload: () => void;
  readonly openDemo: (id: string) => void;
  readonly run: () => void;
  /** Looks for landmark pairs of both meshes. */
  readonly findLandmarks: () => void;
  /** Takes another plane that mirrors a mesh. */
  readonly choosePlane: (side: Side, choice: PlaneChoice) => void;
  /** Looks for places of one mesh that are worth a landmark. */
  readonly suggest: (side: Side) => void;
  /** Asks the run for its result. */
  readonly finish: () => void;
  readonly cancel: () => void;
  /** Leaves what the page is busy with: nothing of it comes onto the page. */
  readonly leaveTask: () => void;
  readonly repair: (finding: Doubt) => void;
  /** Repairs a mesh that was refused. */
  readonly repairMesh: (mesh: RefusedMesh) => void;
  /** Shows what was wrong with a mesh before it was repaired, or no more. */
  readonly showRepairs: (side: Side, shown: 'shown' | 'hidden') => void;
  /** Turns a view to a defect that is shown, by the places of its kind and its own. */
  readonly lookAtDefect: (side: Side, examined: Examined, group: number, index: number) => void;
  /** Moves the camera of a view. */
  readonly camera: (side: Side, command: CameraCommand) => void;
  /** Shows the source on its way to the target's shape until the style changes: 0 is the source's shape, 1 the target's. */
  readonly morph: (share: number) => void;
  /** For pictures that turn with the views. */
  readonly turnedViews: TurnedViews;
  /** What the picture of the base domain needs of the views. */
  readonly baseView: BaseHands;
  /** What the flows that are watched need of the page. */
  readonly flow: FlowHands;
  /** Likewise the simplification. */
  readonly simplification: SimplificationHands;
  /** Likewise the layouts in the plane. */
  readonly plane: { readonly start: (listener: Listener<Planes>) => () => void };
  /** Compares the map on the page with another one; `null` for none. */
  readonly compare: (other: OtherMap | null) => void;
  /** The axis of a mesh that seems to point up by its shape; `null` where the shape does not tell. */
  readonly proposedUp: (side: Side) => Axis | null;
  /** Turns both views to a pair's points. */
  readonly lookAtPair: (id: number) => void;
  /** Turns both views to these places. */
  readonly lookAtPlaces: (places: readonly [SurfacePoint, SurfacePoint]) => void;
  /** Takes up the work of an earlier visit. */
  readonly continueWork: () => void;
  /** Leaves it, and begins anew. */
  readonly startAnew: () => void;
}

/** Every part of the page is given this. */
export interface PartProps {
  readonly state: State;
  readonly actions: Actions;
  readonly shell: Shell;
}
