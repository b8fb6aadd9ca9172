/** Everything that can happen to the state. */
import type { AnswerPicture } from '../compute/match-messages.ts';
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
  /** The core is there. */
  | { readonly kind: 'ready'; readonly demos: readonly Demo[] }
  /** Work other than a run begins. */
  | { readonly kind: 'task-begun'; readonly task: Task }
  /** It is over. */
  | { readonly kind: 'task-ended'; readonly task: Task }

  // Steps: undo takes them back. Events that are dispatched together are one step.

  /** A mesh comes in the place of a side's. */
  | { readonly kind: 'mesh'; readonly side: Side; readonly file: MeshFile }
  /** The target's mirror image comes in its place; `points` are the pairs' points on it, in their order. */
  | { readonly kind: 'mirrored'; readonly file: MeshFile; readonly points: readonly (SurfacePoint | null)[] }
  /** The source becomes the target and the other way round, with their points. */
  | { readonly kind: 'swap-meshes' }
  /** The pairs of a file come in the place of the present ones. */
  | { readonly kind: 'landmarks'; readonly file: LandmarkFile }
  /** The points of a file for one mesh alone come in the place of those on it; `name` is the file's. */
  | { readonly kind: 'side-marks'; readonly side: Side; readonly points: readonly SidePoint[]; readonly name: string }
  /** The meshes and landmarks that came before it are this demo's. */
  | { readonly kind: 'demo'; readonly demo: Demo }
  /** A point is placed: it completes the pair that waits for it, or begins one. With what lies `across`, that is placed likewise. */
  | { readonly kind: 'point-picked'; readonly side: Side; readonly point: SurfacePoint; readonly across?: Across | null }
  /** A pair's point is elsewhere; all moves with one `gesture` number are one step. With what lies `across`, its partner goes there. */
  | {
      readonly kind: 'point-moved';
      readonly id: number;
      readonly side: Side;
      readonly point: SurfacePoint;
      readonly gesture: number;
      readonly across?: Across | null;
    }
  /** The half pair whose turn it is goes; without one, nothing is selected any more. */
  | { readonly kind: 'pick-dropped' }
  /** The place that the map proposes becomes the partner of the half pair whose turn it is. */
  | { readonly kind: 'proposal-accepted'; readonly across?: Across | null }
  /** All suggestions of a side become half pairs. */
  | { readonly kind: 'suggestions-taken'; readonly side: Side }
  | { readonly kind: 'pair-deleted'; readonly id: number }
  | { readonly kind: 'pair-labelled'; readonly id: number; readonly label: string }
  | { readonly kind: 'pair-locked'; readonly id: number; readonly locked: boolean }
  /** A pair is soft, with this radius in units of the root of the target's area, or held (`null`). */
  | { readonly kind: 'pair-softened'; readonly id: number; readonly radius: number | null }
  /** A pair comes to another place of the list, from 0. */
  | { readonly kind: 'pair-moved'; readonly id: number; readonly to: number }
  /** All pairs go but the locked ones. */
  | { readonly kind: 'pairs-cleared' }
  /** A search for landmarks is over: the best pairs that it found come beside those that were held. */
  | { readonly kind: 'search-done'; readonly report: MatchReport; readonly pictures: readonly AnswerPicture[] }
  /** The pairs of another candidate of the search come in the place of the present ones. */
  | { readonly kind: 'candidate-taken'; readonly candidate: number }
  /** Two pairs get each other's target. */
  | { readonly kind: 'targets-exchanged'; readonly ids: readonly number[] }
  | { readonly kind: 'options'; readonly options: Partial<RunOptions> }
  /** Kept work comes: with its own steps where nothing was done on the page, else as a step. */
  | { readonly kind: 'restored'; readonly work: Work; readonly history: History; readonly ui: Partial<Ui> }
  /** The last step is taken back. */
  | { readonly kind: 'undo' }
  /** The step that was taken back last is made again. */
  | { readonly kind: 'redo' }
  /** What is on the page is the first state: there is nothing to go back to. */
  | { readonly kind: 'history-begun' }

  // How the page is looked at.

  /** `null` selects none. */
  | { readonly kind: 'pair-selected'; readonly id: number | null }
  /** `null` when the mouse leaves. */
  | { readonly kind: 'pair-hovered'; readonly id: number | null }
  /** A step is chosen, the panel folded, another theme or link of the cameras chosen. */
  | { readonly kind: 'ui'; readonly ui: Partial<Pick<Ui, 'step' | 'theme' | 'panel' | 'link'>> }
  | { readonly kind: 'style'; readonly style: Partial<Style> }
  /** A mesh is turned upright. */
  | { readonly kind: 'up'; readonly side: Side; readonly axis: Axis }
  /** A camera has come to rest; `null` as at the start. */
  | { readonly kind: 'camera-moved'; readonly side: Side; readonly camera: Camera | null }
  /** Places of one mesh that are worth a landmark, in the place of the earlier ones. */
  | { readonly kind: 'suggested'; readonly side: Side; readonly suggestions: readonly Suggestion[] }

  /** The map was asked for the partner of a half pair, and proposes a place. */
  | { readonly kind: 'proposed'; readonly proposal: Proposal }
  /** The place is not the partner; the half pair waits for a click. */
  | { readonly kind: 'proposal-dropped' }
  /** From now on points come in pairs of left and right, or no more. */
  | { readonly kind: 'left-right'; readonly isOn: boolean }
  /** A plane that mirrors a mesh is asked for, or known. */
  | { readonly kind: 'plane'; readonly side: Side; readonly plane: MeshPlane }
  /** Pairs that are there, by their ids, stand across from each other. */
  | { readonly kind: 'twins'; readonly twins: readonly (readonly [number, number])[] }
  /** A search for landmarks begins. */
  | { readonly kind: 'search-begun' }
  | { readonly kind: 'search-progress'; readonly share: number }
  /** It is given up, or what it found is seen no more. */
  | { readonly kind: 'search-closed' }

  /** The map on the page is to be compared with another one. */
  | { readonly kind: 'comparison-begun'; readonly which: OtherMap }
  /** The other one goes on, is there, or failed. */
  | { readonly kind: 'comparison'; readonly which: OtherMap; readonly progress: Comparison['progress'] }
  | { readonly kind: 'comparison-closed' }
  /** The flows of a map begin, go on, are there, or failed. */
  | { readonly kind: 'flattening'; readonly flattening: Flattening }
  /** A picture lies on the flat metric. */
  | { readonly kind: 'texture-picture'; readonly picture: TexturePicture }

  // The run.

  | { readonly kind: 'run-started' }
  | { readonly kind: 'run-progress'; readonly progress: Progress }
  /** A relaxation begins: energies do not compare with those before. */
  | { readonly kind: 'run-relaxes' }
  /** The map as it is being made: by vertex of the source its place on the target. */
  | { readonly kind: 'run-preview'; readonly places: Float32Array }
  /** From now on the run can be asked to finish. */
  | { readonly kind: 'run-finishable' }
  /** It is asked. */
  | { readonly kind: 'run-finish' }
  /** Doubts about the landmarks of the run. */
  | { readonly kind: 'run-found'; readonly findings: readonly Finding[] }
  | { readonly kind: 'run-done'; readonly output: RunOutput; readonly report: Report }
  /** A map file was opened for the meshes on the page, as if a run had made it just now of its own landmarks and options. */
  | { readonly kind: 'map-opened'; readonly map: OpenedMap }
  /** A map file waits for its meshes, or none does any more. */
  | { readonly kind: 'map-awaited'; readonly map: AwaitedMap | null }
  /** With the failure itself where a computation told it. */
  | { readonly kind: 'run-failed'; readonly sentence: string; readonly failure?: Failure }
  | { readonly kind: 'run-cancelled' }

  /** A second program begins to prove a map. */
  | { readonly kind: 'proof-begun'; readonly of: Result }
  /** It has answered; `null` where it could not. */
  | { readonly kind: 'proof-done'; readonly of: Result; readonly answer: ProofReport | null }

  // What the page says.

  /** A sentence that goes by itself, with a button that takes the last step back where `undo` is true. */
  | { readonly kind: 'toast'; readonly sentence: string; readonly undo: boolean }
  | { readonly kind: 'toast-closed' }
  /** The link that was opened waits for something, or for nothing any more. */
  | { readonly kind: 'receiving'; readonly receiving: Receiving }
  /** What was wrong with a side's mesh before it was repaired is shown, or no more. */
  | { readonly kind: 'examined'; readonly side: Side; readonly examined: Examined | null }
  /** Meshes were refused, in the place of earlier ones. */
  | { readonly kind: 'refused'; readonly refused: Refused | null }
  /** The refused mesh of a side is left out. */
  | { readonly kind: 'refused-closed'; readonly side: Side }
  /** There is a newer build of the page. */
  | { readonly kind: 'outdated' }
  /** The views cannot be drawn, for this reason, or can again. */
  | { readonly kind: 'undrawn'; readonly sentence: string | null }
  /** Work of an earlier visit can be continued. */
  | { readonly kind: 'offered'; readonly offer: Offer }
  /** The offer was answered. */
  | { readonly kind: 'offer-closed' }
  | { readonly kind: 'error'; readonly sentence: string; readonly failure?: Failure }
  | { readonly kind: 'error-closed' };
