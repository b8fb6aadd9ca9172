/** Reads meshes beside the page, and answers what is asked about them. */
import init from '../wasm/core.js';
import { answerQuestions } from './answering.ts';
import { meshAnswer } from './mesh-answers.ts';

answerQuestions(init, meshAnswer);
