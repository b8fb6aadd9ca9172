/** Sorts files and builds demos beside the page. */
import init from '../wasm/page.js';
import { answerQuestions } from './answering.ts';
import { fileAnswer } from './file-answers.ts';

answerQuestions(init, fileAnswer);
