// Makes studies beside the page: the same program in a thread of its own, which the page cannot notice working.
import init, { StudyWorker } from "./centrode.js";

const SLICE_MS = 30;
const ANSWER_MS = 120;
let study = null;
let number = 0;
let looping = false;
let ready = null;

addEventListener("message", ({ data }) => {
  if ("module" in data) ready = init({ module_or_path: data.module });
  else ready.then(() => begin(data)).catch(fail);
});

function fail(error) {
  study = null;
  postMessage({ failed: String(error?.stack ?? error) });
}

/// Drops what is being made and begins what is asked, if anything is.
function begin({ request, number: its }) {
  study?.free();
  number = its;
  study = request === null ? null : new StudyWorker(request);
  if (study && !looping) loop().catch(fail);
}

async function loop() {
  looping = true;
  let answered = performance.now();
  try {
    while (study) {
      const made = study;
      const until = performance.now() + SLICE_MS;
      let left = true;
      while (left && performance.now() < until) left = made.step();
      if (!left || performance.now() - answered > ANSWER_MS) {
        const answer = made.answer();
        postMessage({ answer, number, done: !left }, [answer.buffer]);
        answered = performance.now();
      }
      if (!left) {
        made.free();
        study = null;
      }
      // Whatever has been asked meanwhile is heard now.
      await new Promise((heard) => setTimeout(heard));
    }
  } finally {
    looping = false;
  }
}
