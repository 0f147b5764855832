// Messages between this page in a frame and its host, the page around it. docs/EMBED.md says what they hold; this file says from
// whom they are taken and to whom they go.

// No scenario is larger.
const MAX_LENGTH = 2 ** 20;
// Asked before the program is there.
const MOST_WAITING = 100;

/// The host, when there is one: `{ start(core), post(message), fail(title, detail) }`. Listened to are pages of these origins,
/// or when none is given of this page's own.
export function messages(origins) {
  if (window.parent === window) return null;
  // A sandboxed frame has no origin of its own, and then nobody shares it.
  const allowed = (origins.length > 0 ? origins : [location.origin]).filter((origin) => origin !== "null");
  let core = null;
  let over = null;
  let waiting = [];
  // Where the host is at home, once that is known.
  let home = location.ancestorOrigins?.[0] ?? null;

  function post(message) {
    for (const origin of home === null ? allowed : allowed.filter((one) => one === home)) {
      window.parent.postMessage(message, origin);
    }
  }

  function refuse({ id, do: what }, message) {
    post({ centrode: 1, event: "error", id, do: what, message, refused: [] });
  }

  function take(request) {
    if (over) return refuse(request, over);
    let json = "";
    try {
      json = JSON.stringify(request);
    } catch (error) {
      return refuse({}, `The request is not made of plain values: ${error?.message ?? error}`);
    }
    if (json.length > MAX_LENGTH) return refuse(request, `The request is longer than ${MAX_LENGTH} characters`);
    core.request(json);
  }

  addEventListener("message", ({ origin, source, data }) => {
    if (source !== window.parent || !allowed.includes(origin)) return;
    // Something else that goes on between the two pages.
    if (typeof data !== "object" || data === null || !("centrode" in data)) return;
    home = origin;
    if (core || over) take(data);
    else if (waiting.length < MOST_WAITING) waiting.push(data);
    else refuse(data, `The page is still loading, and ${MOST_WAITING} requests wait already`);
  });

  return {
    /// From now on the program answers.
    start(program) {
      core = program;
      core.host_ready();
      waiting.forEach(take);
      waiting = [];
    },
    post,
    /// The page has stopped, and answers no more.
    fail(title, detail) {
      over = `${title}: ${String(detail).split("\n", 1)[0]}`;
      refuse({}, over);
      waiting.forEach(take);
      waiting = [];
    },
  };
}
