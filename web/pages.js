// The faces of the page: loading, running, no GPU, failed; and the dialog for notices.

const byId = (id) => document.getElementById(id);

function show(page) {
  document.documentElement.dataset.page = page;
}

export function showProgress(received, total) {
  const known = total > 0 && received <= total;
  const done = known && received === total;
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
    "The browser or its graphics driver dropped the page's drawing context, for example after sleep or a driver update. Reloading brings it back.";
  showFailure(detail);
}

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
