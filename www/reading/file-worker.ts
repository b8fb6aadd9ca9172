/** The worker that sorts files and builds demos. */
import init from '../wasm/page.js';
import { answerQuestions } from './answering.ts';
import { fileAnswer } from './file-answers.ts';

answerQuestions(init, fileAnswer);
