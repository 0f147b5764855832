// Logs: kept by number, read in a worker of their own, which ends with its file so that its memory is free again.
import { worker as workerOf } from "./parts.js";
import { silence } from "./silence.js";

// So much of a file says what it is.
const HEAD_BYTES = 65536;
const MOST_LOOKS = 6;

/// `core` is the program, to which files and answers go; `module` is what it was made from.
export function logs(core, module) {
  const kept = new Map();
  let worker = null;
  let silent = null;

  function end() {
    silent?.end();
    worker?.terminate();
    worker = null;
  }

  /// Reads a file in a worker; `request` is JSON, or nothing to stop.
  function read(request, again = false) {
    end();
    if (!request) return;
    const { file: number } = JSON.parse(request);
    let started = false;
    // Another tries once. Without a worker the program reads the file itself; one that fails with the file in its hands, says why.
    const fail = (cause) => {
      const reason = String(cause?.message ?? cause).split("\n", 1)[0];
      end();
      if (!again) read(request, true);
      else if (started) core.log_unreadable(number, `It could not be read: ${reason}`);
      else core.log_worker_failed(reason);
    };
    try {
      const made = workerOf("log-worker.js");
      worker = made;
      made.onerror = (event) => made === worker && fail(event.message ?? "the worker could not be loaded");
      made.onmessageerror = () => made === worker && fail("the worker's answer could not be read");
      silent = silence(MOST_LOOKS, () => fail("the worker does not answer"));
      silent.begin();
      made.onmessage = ({ data }) => {
        if (made !== worker) return;
        silent.heard();
        if (data.started) started = true;
        if (data.failed) fail(data.failed);
        if (data.answer) core.log_answered(data.answer);
        if (data.done) end();
      };
      made.postMessage({ module, request, file: kept.get(number) });
    } catch (error) {
      // Inside a call from the program: it is told once it is done.
      setTimeout(() => fail(error));
    }
  }

  /// Hands the program the bytes of a file.
  async function fetchBytes(number) {
    try {
      core.log_fetched(number, new Uint8Array(await kept.get(number).arrayBuffer()));
    } catch (error) {
      core.log_unreadable(number, `It could not be read: ${error?.message ?? error}`);
    }
  }

  /// Takes a file if it is a log; says whether it was.
  async function take(file) {
    const head = new Uint8Array(await file.slice(0, HEAD_BYTES).arrayBuffer());
    if (!core.looks_like_log(file.name, head)) return false;
    const number = kept.size + 1;
    kept.set(number, file);
    core.log_chosen(file.name, file.size, head, number);
    return true;
  }

  return { read, fetchBytes, take };
}
