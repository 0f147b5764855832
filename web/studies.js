// The page's end of the worker: started when the first study is asked for, replaced by nothing when it fails.

/// A function that takes a request (JSON, or nothing for none). `core` is the program, to which answers go; `module` is
/// what it was made from, compiled once for both.
export function studies(core, module) {
  let worker = null;
  let failed = false;

  function fail(reason) {
    if (failed) return;
    failed = true;
    console.warn(`Studies are made on the page, for the worker failed: ${reason}`);
    worker?.terminate();
    core.study_failed();
  }

  function start() {
    worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    worker.onerror = (event) => fail(event.message ?? "it could not be loaded");
    worker.onmessageerror = () => fail("its answer could not be read");
    worker.onmessage = ({ data }) => (data.failed ? fail(data.failed) : core.study_answered(data.answer));
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
