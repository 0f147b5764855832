// Reads a log beside the page: the same program in a thread of its own.
import init, { LogWorker } from "./centrode.js";

const ANSWER_MS = 100;

addEventListener("message", ({ data }) => read(data).catch((error) => postMessage({ failed: String(error?.stack ?? error) })));

async function read({ module, request, file }) {
  await init({ module_or_path: module });
  postMessage({ started: true });
  const log = new LogWorker(request, new Uint8Array(await file.arrayBuffer()));
  let answered = performance.now();
  while (log.step()) {
    if (performance.now() - answered < ANSWER_MS) continue;
    postMessage({ answer: log.answer() });
    answered = performance.now();
  }
  const answer = log.answer();
  postMessage({ answer, done: true }, [answer.buffer]);
}
