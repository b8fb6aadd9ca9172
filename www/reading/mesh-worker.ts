/** The worker that reads meshes and answers questions about them. */
import init from '../wasm/core.js';
import { answerQuestions } from './answering.ts';
import { meshAnswer } from './mesh-answers.ts';

answerQuestions(init, meshAnswer);
