// The page's end of the worker: started when the first study is asked for, replaced by another when it fails, and by nothing when that
// one does.
import { worker as workerOf } from "./parts.js";
import { silence } from "./silence.js";

// On a phone a contact on a dozen segments is placed in a minute, in one piece.
const MOST_LOOKS = 24;

/// `{ ask, replace }`: `ask` takes a request (JSON, or nothing for none), `replace` says whether another worker takes the place of this
/// one. `core` is the program, to which answers go; `module` is what it was made from, compiled once for both.
export function studies(core, module) {
  let worker = null;
  let replaced = false;
  let failed = false;
  // What it is to make, until that is made, and its number.
  let asked = null;
  let number = 0;
  const silent = silence(MOST_LOOKS, () => fail("it does not answer"));

  function end() {
    silent.end();
    worker?.terminate();
    worker = null;
  }

  function replace() {
    if (replaced || failed) return false;
    replaced = true;
    end();
    return true;
  }

  function fail(cause) {
    if (failed) return;
    // Its first line: what follows is where in the program.
    const reason = String(cause?.message ?? cause).split("\n", 1)[0];
    if (replace()) {
      console.warn(`Another worker takes the place of the one that failed: ${cause}`);
      if (asked !== null) ask(asked);
      return;
    }
    failed = true;
    end();
    console.warn(`Studies are made on the page, for the worker failed: ${cause}`);
    core.study_failed(reason);
  }

  function start() {
    const made = workerOf("worker.js");
    worker = made;
    // What one says that was replaced is of no concern.
    const its = (act) => (event) => made === worker && act(event);
    made.onerror = its((event) => fail(event.message ?? "it could not be loaded"));
    made.onmessageerror = its(() => fail("its answer could not be read"));
    made.onmessage = its(({ data }) => {
      silent.heard();
      if (!(data?.answer instanceof Uint8Array)) return fail(data?.failed ?? "it sent something that is not an answer");
      // The end of what was asked before is none of this.
      if (data.done && data.number === number) {
        asked = null;
        silent.end();
      }
      core.study_answered(data.answer);
    });
    made.postMessage({ module });
  }

  function ask(request) {
    if (failed) return;
    asked = request ?? null;
    try {
      if (!worker) start();
      worker.postMessage({ request: asked, number: ++number });
      if (asked === null) silent.end();
      else silent.begin();
    } catch (error) {
      // Inside a call from the program: it is told once it is done.
      setTimeout(() => fail(error));
    }
  }

  return { ask, replace };
}
