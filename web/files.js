// Files: saved, chosen, dropped.

// No scenario is larger; the program says so.
const MAX_BYTES = 2 ** 20;

/// Saves a text as a file.
export function save(name, text) {
  const url = URL.createObjectURL(new Blob([text], { type: "application/toml" }));
  const link = Object.assign(document.createElement("a"), { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  // Some browsers read it only after the click is over.
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/// Hands a file to the program; `logs` takes those that are logs.
async function open(core, logs, file) {
  try {
    if (await logs.take(file)) return;
    // One byte more than is allowed says that it is too large.
    const bytes = await file.slice(0, MAX_BYTES + 1).arrayBuffer();
    core.file_opened(file.name, new Uint8Array(bytes));
  } catch (error) {
    core.file_failed(file.name, `It could not be read: ${error?.message ?? error}`);
  }
}

/// Lets the person choose a scenario.
export function choose(core, logs) {
  pick(".toml", (file) => open(core, logs, file));
}

/// Lets the person choose a log. Some systems do not know the extensions of logs, so all files can be chosen.
export function chooseLog(core, logs) {
  pick("", (file) => open(core, logs, file));
}

function pick(accept, take) {
  const input = Object.assign(document.createElement("input"), { type: "file", accept });
  // Some browsers forget an input that is nowhere.
  input.hidden = true;
  const done = () => input.remove();
  input.addEventListener("change", () => {
    if (input.files[0]) take(input.files[0]);
    done();
  });
  input.addEventListener("cancel", done);
  document.body.append(input);
  input.click();
}

/// Takes a file that is dropped anywhere on the page, which the browser would otherwise go to.
export function acceptDrops(core, logs) {
  const files = (event) => event.dataTransfer?.types.includes("Files");
  // Before the canvas, which keeps such events to itself.
  addEventListener("dragover", (event) => files(event) && event.preventDefault(), true);
  addEventListener(
    "drop",
    (event) => {
      if (!files(event)) return;
      event.preventDefault();
      const file = event.dataTransfer.files[0];
      if (file) open(core, logs, file);
    },
    true,
  );
}
