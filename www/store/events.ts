/** All events that can change the state. */
import type { AnswerPicture, FoundPairs } from '../compute/match-messages.ts';
import type { Failure, Progress, RunOutput } from '../compute/messages.ts';
import type { RunOptions } from '../report.ts';
import type { LandmarkFile, Side, Suggestion, SurfacePoint } from '../landmarks.ts';
import type { Finding, MatchReport, OtherMap, ProofReport, Report } from '../report.ts';
import type { AwaitedMap } from './awaited.ts';
import type { Examined } from './defects.ts';
import type { History } from './history.ts';
import type { Task } from './job.ts';
import type { Across, MeshPlane } from './left-right.ts';
import type { OpenedMap } from './opened.ts';
import type { Receiving } from './receiving.ts';
import type { Refused } from './refused.ts';
import type { SidePoint } from './side-marks.ts';
import type { Axis, Camera, Comparison, Demo, Flattening, MeshFile, Offer, Proposal, Result, Style, TexturePicture, Ui, Work } from './state.ts';

export type Event =
  /** The page can be used; `demos` are those that it offers. */
  | { readonly kind: 'ready'; readonly demos: readonly Demo[] }
  /** A task other than a run begins. */
  | { readonly kind: 'task-begun'; readonly task: Task }
  /** The task is over. */
  | { readonly kind: 'task-ended'; readonly task: Task }

  // These events make steps, which can be undone. Events that are dispatched together are one step.

  /** A mesh replaces the one of a side. */
  | { readonly kind: 'mesh'; readonly side: Side; readonly file: MeshFile }
  /** The target's mirror image replaces it; `points` are the pairs' points on it, in their order. */
  | { readonly kind: 'mirrored'; readonly file: MeshFile; readonly points: readonly (SurfacePoint | null)[] }
  /** Source and target are exchanged, with their points. */
  | { readonly kind: 'swap-meshes' }
  /** The pairs of a file replace the present ones. */
  | { readonly kind: 'landmarks'; readonly file: LandmarkFile }
  /** The points of a file for one mesh alone replace those on the mesh; `name` is the file's. */
  | { readonly kind: 'side-marks'; readonly side: Side; readonly points: readonly SidePoint[]; readonly name: string }
  /** The meshes and landmarks that came before it belong to this demo. */
  | { readonly kind: 'demo'; readonly demo: Demo }
  /** A point is placed: it completes the pair that waits for it, or begins one. `across` is its mirror image, which is placed as well. */
  | { readonly kind: 'point-picked'; readonly side: Side; readonly point: SurfacePoint; readonly across?: Across | null }
  /**
   * A pair's point is moved; all moves with the same `gesture` number are one step. `across` is its mirror image, to which its partner
   * moves.
   */
  | {
      readonly kind: 'point-moved';
      readonly id: number;
      readonly side: Side;
      readonly point: SurfacePoint;
      readonly gesture: number;
      readonly across?: Across | null;
    }
  /** The half pair whose turn it is is given up; where there is none, the selection ends. */
  | { readonly kind: 'pick-dropped' }
  /** The place that the map proposes completes the half pair whose turn it is. */
  | { readonly kind: 'proposal-accepted'; readonly across?: Across | null }
  /** All suggestions of a side are taken as half pairs. */
  | { readonly kind: 'suggestions-taken'; readonly side: Side }
  | { readonly kind: 'pair-deleted'; readonly id: number }
  | { readonly kind: 'pair-labelled'; readonly id: number; readonly label: string }
  | { readonly kind: 'pair-locked'; readonly id: number; readonly locked: boolean }
  /** A pair is made soft, with this radius in units of the root of the target's area, or is held (`null`). */
  | { readonly kind: 'pair-softened'; readonly id: number; readonly radius: number | null }
  /** A pair is moved to another index of the list, from 0. */
  | { readonly kind: 'pair-moved'; readonly id: number; readonly to: number }
  /** All pairs but the locked ones are deleted. */
  | { readonly kind: 'pairs-cleared' }
  /** A search for landmarks is over: the best pairs that it found are added to those that were held. */
  | { readonly kind: 'search-done'; readonly report: MatchReport; readonly pictures: readonly AnswerPicture[] }
  /** The pairs of another candidate of the search replace the present ones. */
  | { readonly kind: 'candidate-taken'; readonly candidate: number }
  /** Two pairs exchange their targets. */
  | { readonly kind: 'targets-exchanged'; readonly ids: readonly number[] }
  | { readonly kind: 'options'; readonly options: Partial<RunOptions> }
  /** Kept work is brought back, without its map: with its own steps where nothing was done on the page, else as one step. */
  | { readonly kind: 'restored'; readonly work: Work; readonly history: History; readonly ui: Partial<Ui>; readonly hadMap: boolean }
  /** Work that was sent comes onto the page, as one step. */
  | { readonly kind: 'received'; readonly work: Work; readonly ui: Partial<Ui> }
  /** The last step is undone. */
  | { readonly kind: 'undo' }
  /** The step that was undone last is made again. */
  | { readonly kind: 'redo' }
  /** The present state becomes the first one, before which nothing can be undone. */
  | { readonly kind: 'history-begun' }

  // These events change how the page is viewed.

  /** A pair is selected; `null` selects none. */
  | { readonly kind: 'pair-selected'; readonly id: number | null }
  /** The mouse is over a pair; `null` when it leaves. */
  | { readonly kind: 'pair-hovered'; readonly id: number | null }
  /** A step, the panel, the theme or the link of the cameras is changed. */
  | { readonly kind: 'ui'; readonly ui: Partial<Pick<Ui, 'step' | 'theme' | 'panel' | 'link'>> }
  | { readonly kind: 'style'; readonly style: Partial<Style> }
  /** Another axis of a mesh points up. */
  | { readonly kind: 'up'; readonly side: Side; readonly axis: Axis }
  /** A camera has come to rest; `null` for its first position. */
  | { readonly kind: 'camera-moved'; readonly side: Side; readonly camera: Camera | null }
  /** Places of one mesh that are worth a landmark replace the earlier suggestions. */
  | { readonly kind: 'suggested'; readonly side: Side; readonly suggestions: readonly Suggestion[] }

  /** The map proposes a place for the missing point of a half pair. */
  | { readonly kind: 'proposed'; readonly proposal: Proposal }
  /** The proposed place is rejected; the half pair waits for a click. */
  | { readonly kind: 'proposal-dropped' }
  /** Left and right are switched to go together, or not. */
  | { readonly kind: 'left-right'; readonly isOn: boolean }
  /** A plane that mirrors a mesh is asked for, or was found. */
  | { readonly kind: 'plane'; readonly side: Side; readonly plane: MeshPlane }
  /** Pairs on the page, by their ids, are each other's mirror image. */
  | { readonly kind: 'twins'; readonly twins: readonly (readonly [number, number])[] }
  /** A search for landmarks begins. */
  | { readonly kind: 'search-begun' }
  | { readonly kind: 'search-progress'; readonly share: number }
  /** The coarse map of the best pairs so far: for each vertex of the source its place on the target; and those pairs that were found. */
  | { readonly kind: 'search-preview'; readonly places: Float32Array; readonly pairs: FoundPairs }
  /** The search is given up, or its answer is no longer shown. */
  | { readonly kind: 'search-closed' }

  /** The comparison of the map on the page with another one begins. */
  | { readonly kind: 'comparison-begun'; readonly which: OtherMap }
  /** Progress, completion or failure of the other map. */
  | { readonly kind: 'comparison'; readonly which: OtherMap; readonly progress: Comparison['progress'] }
  | { readonly kind: 'comparison-closed' }
  /** Beginning, progress, completion or failure of the flows of a map. */
  | { readonly kind: 'flattening'; readonly flattening: Flattening }
  /** A picture of the user is laid on the flat metric. */
  | { readonly kind: 'texture-picture'; readonly picture: TexturePicture }

  // These events are about the run.

  | { readonly kind: 'run-started' }
  | { readonly kind: 'run-progress'; readonly progress: Progress }
  /** A relaxation begins: its energies cannot be compared with those before. */
  | { readonly kind: 'run-relaxes' }
  /** A preview of the map that is being made: for each vertex of the source its place on the target. */
  | { readonly kind: 'run-preview'; readonly places: Float32Array }
  /** From now on the run can be asked to finish. */
  | { readonly kind: 'run-finishable' }
  /** The run is asked to finish. */
  | { readonly kind: 'run-finish' }
  /** Findings about the landmarks of the run. */
  | { readonly kind: 'run-found'; readonly findings: readonly Finding[] }
  | { readonly kind: 'run-done'; readonly output: RunOutput; readonly report: Report }
  /** A map file was opened for the meshes on the page, as if a run had just made it from its own landmarks and options. */
  | { readonly kind: 'map-opened'; readonly map: OpenedMap }
  /** A map file waits for its meshes; `null` when none does any more. */
  | { readonly kind: 'map-awaited'; readonly map: AwaitedMap | null }
  /** The run failed, with the failure itself where a computation reported one. */
  | { readonly kind: 'run-failed'; readonly sentence: string; readonly failure?: Failure }
  | { readonly kind: 'run-cancelled' }

  /** A second program begins to prove a map. */
  | { readonly kind: 'proof-begun'; readonly of: Result }
  /** The second program has answered; `null` where it could not. */
  | { readonly kind: 'proof-done'; readonly of: Result; readonly answer: ProofReport | null }

  // These events are about what the page says.

  /** A sentence is shown that disappears by itself, with a button that undoes the last step where `undo` is true. */
  | { readonly kind: 'toast'; readonly sentence: string; readonly undo: boolean }
  | { readonly kind: 'toast-closed' }
  /** The link that was opened waits for something, or no longer for anything. */
  | { readonly kind: 'receiving'; readonly receiving: Receiving }
  /** What was wrong with a side's mesh before it was repaired is shown; `null` hides it. */
  | { readonly kind: 'examined'; readonly side: Side; readonly examined: Examined | null }
  /** Meshes were refused; they replace earlier ones. */
  | { readonly kind: 'refused'; readonly refused: Refused | null }
  /** The refused mesh of a side is left out. */
  | { readonly kind: 'refused-closed'; readonly side: Side }
  /** There is a newer build of the page. */
  | { readonly kind: 'outdated' }
  /** The views cannot be drawn, for the reason in the sentence; `null` when they can again. */
  | { readonly kind: 'undrawn'; readonly sentence: string | null }
  /** Work of an earlier visit can be continued. */
  | { readonly kind: 'offered'; readonly offer: Offer }
  /** The offer was answered. */
  | { readonly kind: 'offer-closed' }
  | { readonly kind: 'error'; readonly sentence: string; readonly failure?: Failure }
  | { readonly kind: 'error-closed' };
