/** Sentences about a run that goes on. */
import { figure } from '../numbers.ts';
import type { Running } from '../store/job.ts';

/** A sentence about what the run does now. */
export function runningSentence({ progress, finish, energies, preview }: Running): string {
  const stage = progress === null ? 'Starting' : progress.sentence;
  if (finish !== 'asked') {
    return `${stage}…`;
  }
  const isThere = preview !== null || energies.flat().length > 0;
  return `${isThere ? 'Finishing with the best map so far' : 'Finishing as soon as there is a map'}: ${stage.toLowerCase()}…`;
}

/** The number that the present stage of a run lowers. */
export function progressNumber({ progress, energies }: Running): string {
  if (progress === null) {
    return '';
  }
  const { energy, residual, stage } = progress;
  if (energy !== null) {
    const isFinal = stage === 'relaxation';
    const which = isFinal ? 'Energy' : 'Energy of the map being tried';
    return `${which} ${energy.toFixed(3)} (4 is the least)${isFinal ? `, level ${energies.length}` : ''}`;
  }
  return residual === null ? '' : `Residual ${figure(residual)}`;
}
