// The page's end of the worker: started when the first study is asked for, replaced by nothing when it fails.
import { worker as workerOf } from "./parts.js";

/// A function that takes a request (JSON, or nothing for none). `core` is the program, to which answers go; `module` is
/// what it was made from, compiled once for both.
export function studies(core, module) {
  let worker = null;
  let failed = false;

  function fail(cause) {
    if (failed) return;
    failed = true;
    // Its first line: what follows is where in the program.
    const reason = String(cause?.message ?? cause).split("\n", 1)[0];
    console.warn(`Studies are made on the page, for the worker failed: ${cause}`);
    worker?.terminate();
    core.study_failed(reason);
  }

  function start() {
    worker = workerOf("worker.js");
    worker.onerror = (event) => fail(event.message ?? "it could not be loaded");
    worker.onmessageerror = () => fail("its answer could not be read");
    worker.onmessage = ({ data }) => {
      if (data?.answer instanceof Uint8Array) core.study_answered(data.answer);
      else fail(data?.failed ?? "it sent something that is not an answer");
    };
    worker.postMessage({ module });
  }

  return (request) => {
    if (failed) return;
    try {
      if (!worker) start();
      worker.postMessage({ request: request ?? null });
    } catch (error) {
      // Inside a call from the program: it is told once it is done.
      setTimeout(() => fail(error));
    }
  };
}
