// The fragment of the address, which says what the page shows.

// The history of a frame is that of the page around it, where no step may be added.
const FRAMED = window.parent !== window;
// Browsers refuse more than about a hundred changes in half a minute.
const APART_MS = 400;
// One that refuses is asked again so much later, and so often.
const AGAIN_MS = 3000;
const MOST_REFUSED = 20;
let refused = 0;
let known = fragment();
let last = -APART_MS;
let waiting = null;
let pending = null;

/// The fragment of the address, without `#`. As it stands there: `location.hash` is not the same in all browsers.
export function fragment() {
  return location.href.split("#").slice(1).join("#");
}

/// The address of the whole page, without its fragment and what is said for a frame alone.
export function address() {
  const [page, query] = location.href.split("#", 1)[0].split(/\?(.*)/s);
  const kept = (query ?? "").split("&").filter((part) => part && !/^(embed|origins)(=|$)/.test(part));
  return kept.length > 0 ? `${page}?${kept.join("&")}` : page;
}

function write(text, step) {
  try {
    history[step ? "pushState" : "replaceState"](null, "", `#${text}`);
    known = fragment();
    last = performance.now();
    refused = 0;
  } catch {
    // Too many of them: the newest is written once the browser takes one again.
    refused += 1;
    if (refused < MOST_REFUSED) later(text, AGAIN_MS);
  }
}

function later(text, wait) {
  pending = text;
  waiting ??= setTimeout(flush, wait);
}

function flush() {
  clearTimeout(waiting);
  waiting = null;
  const text = pending;
  pending = null;
  if (text !== null) write(text, false);
}

/// The address has this fragment from now on; with `step`, one can go back to what it was before.
export function tell(text, step) {
  if (step && !FRAMED) {
    flush();
    write(text, true);
  } else if (waiting === null && performance.now() - last >= APART_MS) {
    write(text, false);
  } else {
    later(text, APART_MS);
  }
}

/// Calls `go` with the fragment whenever the person went back, forward, or edited the address.
export function listen(go) {
  const moved = () => {
    if (fragment() === known) return;
    known = fragment();
    // What was to be written belonged to the place that was left.
    pending = null;
    go(known);
  };
  addEventListener("popstate", moved);
  addEventListener("hashchange", moved);
  // What waits is not lost by a reload.
  addEventListener("pagehide", flush);
}
