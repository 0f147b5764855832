// The faces of the page: loading, running, no GPU, failed; and the dialog for notices.

const byId = (id) => document.getElementById(id);

function show(page) {
  clearTimeout(late);
  document.documentElement.dataset.page = page;
}

// A start takes a second; with graphics in software, several. Graphics that never answer would keep the page starting for ever.
const LATE_MS = 20_000;
let late;

function sayThatItIsLate() {
  const to = new URL(location.href);
  to.searchParams.set("renderer", "webgl");
  const way = document.createElement("a");
  [way.href, way.textContent] = [to, "draw with WebGL"];
  byId("loading-late").replaceChildren("This takes longer than usual. If nothing comes, reload the page, or ", way, ".");
}

export function showProgress(received, total) {
  const known = total > 0 && received <= total;
  const done = known && received === total;
  if (done) late ??= setTimeout(sayThatItIsLate, LATE_MS);
  const megabytes = (bytes) => (bytes / 1e6).toFixed(1);
  byId("loading-text").textContent = done
    ? "Starting"
    : known
      ? `Loading ${megabytes(received)} of ${megabytes(total)} MB`
      : `Loading ${megabytes(received)} MB`;
  if (known) byId("loading-bar").value = received / total;
  else byId("loading-bar").removeAttribute("value");
}

export function showRunning() {
  show("running");
}

export function showNoGpu(detail) {
  byId("no-gpu-detail").textContent = detail;
  close("no-gpu");
}

export function showFailure(detail) {
  byId("failed-detail").textContent = detail;
  close("failed");
}

export function showLost(detail) {
  byId("failed-title").textContent = "The page lost its graphics";
  byId("failed-text").textContent =
    "The browser or its graphics driver dropped the page's drawing context three times within a minute. Close other tabs and programs that draw, update the graphics driver, then reload. If it happens again, add ?renderer=webgl or ?renderer=webgpu to the address.";
  showFailure(detail);
}

let version = "of unknown version";

/// The version of the program, for reports.
export function knowVersion(text) {
  version = text;
}

/// What somebody who mends the page wants to know, and nothing else.
function report() {
  const build = document.querySelector("script[data-wasm-bytes]").getAttribute("src")?.split("/", 1)[0] ?? "single file";
  return [
    `Centrode ${version}, ${build}`,
    `Message: ${byId("failed-title").textContent}. ${byId("failed-detail").textContent}`,
    `Browser: ${navigator.userAgent}`,
    `Renderer: ${byId("mirror").dataset.renderer ?? "none yet"}`,
    `Link: ${location.href}`,
  ].join("\n");
}

byId("copy-report").onclick = async ({ target }) => {
  const text = report();
  try {
    await navigator.clipboard.writeText(text);
    target.textContent = "Copied";
  } catch {
    // Where the page may not write there, the person does.
    byId("failed-detail").textContent = text;
    getSelection().selectAllChildren(byId("failed-detail"));
    target.textContent = "Selected: copy it by Ctrl+C";
  }
};

function close(page) {
  byId("notice").close();
  show(page);
  document.querySelector(`#${page} button`).focus();
}

/// Shows `notices` (lines of text), if there are any, over the page, which goes on meanwhile.
export function showNotices(notices, onClose) {
  if (notices.length === 0) return;
  const items = notices.map((text) => Object.assign(document.createElement("li"), { textContent: text }));
  byId("notice-list").replaceChildren(...items);
  byId("notice").addEventListener("close", onClose, { once: true });
  byId("notice").showModal();
}
