/** What the page's parts ask for, and what each of them is given. */
import type { Side, SurfacePoint } from '../landmarks.ts';
import type { prospectSentence } from '../messages.ts';
import type { Event } from '../store/events.ts';
import type { Doubt, State } from '../store/state.ts';
import type { Shell } from './shell.ts';

/** What panels ask for beyond a change of state. */
export interface Actions {
  readonly dispatch: (event: Event) => void;
  readonly openFiles: (files: readonly File[], side: Side | null) => void;
  /** Brings back the offered work of an earlier visit. */
  readonly continueWork: () => void;
  /** That work is not asked about again. */
  readonly startAnew: () => void;
  /** The click that the link which was opened waits for. */
  readonly acceptLink: () => void;
  /** Gives that link up. */
  readonly cancelLink: () => void;
  /** The link to what is on the page; `null` where there can be none. */
  readonly sharedLink: () => Promise<{ readonly url: string; readonly prospect: Parameters<typeof prospectSentence>[0] } | null>;
  readonly saveProject: () => void;
  /** Saves what the views show as a picture of twice the screen's size. */
  readonly savePicture: () => void;
  /** Begins anew with the newer build of the page. */
  readonly reload: () => void;
  readonly openDemo: (id: string) => void;
  readonly run: () => void;
  /** Looks for places of one mesh that are worth a landmark. */
  readonly suggest: (side: Side) => void;
  /** Asks the run for its result. */
  readonly finish: () => void;
  readonly cancel: () => void;
  readonly repair: (finding: Doubt) => void;
  /** Brings the whole mesh of a view into sight. */
  readonly fit: (side: Side) => void;
  /** Turns both views to a pair's points. */
  readonly lookAtPair: (id: number) => void;
  /** Turns both views to these places. */
  readonly lookAtPlaces: (places: readonly [SurfacePoint, SurfacePoint]) => void;
}

/** Every part of the page is given this. */
export interface PartProps {
  readonly state: State;
  readonly actions: Actions;
  readonly shell: Shell;
}
