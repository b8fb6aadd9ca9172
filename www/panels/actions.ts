/** The actions that the page's parts can ask for, and the properties that each part gets. */
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

/** A command to the camera of a view. */
export type CameraCommand =
  /** Shows the whole mesh. */
  | { readonly kind: 'fit' }
  /** Goes back to the first view. */
  | { readonly kind: 'reset' }
  /** Shows the whole mesh from a side. */
  | { readonly kind: 'look'; readonly from: LookFrom }
  /** Shows the whole mesh as the other one is seen. */
  | { readonly kind: 'as-other' }
  /** Turns the picture counter-clockwise. */
  | { readonly kind: 'roll'; readonly degrees: number };

/** The actions of the page beyond changes of its state. */
export interface Actions {
  /** Events that are dispatched together are one step. */
  readonly dispatch: (...events: readonly Event[]) => void;
  readonly openFiles: (files: readonly File[], side: Side | null) => void;
  /** Loads the files of the opened link, which waits for this click. */
  readonly acceptLink: () => void;
  /** Gives the opened link up. */
  readonly cancelLink: () => void;
  /** Makes the link to what is on the page; `null` where there can be none. */
  readonly sharedLink: () => Promise<{ readonly url: string; readonly prospect: Parameters<typeof prospectSentence>[0] } | null>;
  readonly saveProject: () => void;
  /** Lays a picture on the flat metric. */
  readonly openTexturePicture: (file: File) => void;
  /** Saves the pairs that have both points: as the program's own file, or in another format by its id in the core. */
  readonly saveLandmarks: (format?: string) => void;
  /** Makes a file of the map and saves it: `made` is the core's name for it, `name` that of the saved file. */
  readonly saveMadeFile: (file: { readonly made: string; readonly name: string; readonly type: string }) => void;
  /** Saves the source's own file with its vertices laid onto the target. */
  readonly saveWrapped: () => void;
  /** What is needed to bring files across the map on the page: the core, and the map that is shown. */
  readonly bring: { readonly core: () => Core | null; readonly shown: () => Result | null };
  /** Has the map proved by a second program. */
  readonly proveMap: () => void;
  /** Saves what the views show as a picture of twice the screen's size. */
  readonly savePicture: () => void;
  /** Reloads the page into its newer build. */
  readonly reload: () => void;
  readonly openDemo: (id: string) => void;
  readonly run: () => void;
  /** Looks for landmark pairs of both meshes. */
  readonly findLandmarks: () => void;
  /** Chooses another plane that mirrors a mesh. */
  readonly choosePlane: (side: Side, choice: PlaneChoice) => void;
  /** Looks for places of one mesh that are worth a landmark. */
  readonly suggest: (side: Side) => void;
  /** Asks the run to finish with the map as it is. */
  readonly finish: () => void;
  readonly cancel: () => void;
  /** Gives up the task that the page is busy with; nothing of it comes onto the page. */
  readonly leaveTask: () => void;
  readonly repair: (finding: Doubt) => void;
  /** Replaces the target by its mirror image, with its points. */
  readonly mirrorTarget: () => void;
  /** Repairs a mesh that was refused. */
  readonly repairMesh: (mesh: RefusedMesh) => void;
  /** Shows or hides what was wrong with a mesh before it was repaired. */
  readonly showRepairs: (side: Side, shown: 'shown' | 'hidden') => void;
  /** Turns a view to a defect that is shown, by the index of its kind and its index in that kind. */
  readonly lookAtDefect: (side: Side, examined: Examined, group: number, index: number) => void;
  /** Gives a command to the camera of a view. */
  readonly camera: (side: Side, command: CameraCommand) => void;
  /** Shows the source on its way to the target's shape until the style changes: 0 is the source's shape, 1 the target's. */
  readonly morph: (share: number) => void;
  /** The cameras of the views, for pictures that turn with them. */
  readonly turnedViews: TurnedViews;
  /** What the picture of the base domain needs of the views. */
  readonly baseView: BaseHands;
  /** What the player of the flows needs of the page. */
  readonly flow: FlowHands;
  /** What the player of the simplification needs of the page. */
  readonly simplification: SimplificationHands;
  /** Computes the layouts in the plane; the returned function ends that. */
  readonly plane: { readonly start: (listener: Listener<Planes>) => () => void };
  /** Compares the map on the page with another one; `null` ends the comparison. */
  readonly compare: (other: OtherMap | null) => void;
  /** The axis of a mesh that seems to point up by its shape; `null` where the shape does not show it. */
  readonly proposedUp: (side: Side) => Axis | null;
  /** Turns both views to a pair's points. */
  readonly lookAtPair: (id: number) => void;
  /** Turns both views to these places. */
  readonly lookAtPlaces: (places: readonly [SurfacePoint, SurfacePoint]) => void;
  /** Brings the work of an earlier visit onto the page. */
  readonly continueWork: () => void;
  /** Declines that work, and begins anew. */
  readonly startAnew: () => void;
}

/** The properties that every part of the page gets. */
export interface PartProps {
  readonly state: State;
  readonly actions: Actions;
  readonly shell: Shell;
}
