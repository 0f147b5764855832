// Tells when somebody who has something to do is silent for too long.

const LOOK_MS = 5000;
// Looks, not time: a machine that slept has looked once.
const MOST_LOOKS = 6;

/// Calls `tell` once after so many looks without a word; `{ begin, heard, end }`.
export function silence(tell) {
  let looks = 0;
  let timer = null;

  function end() {
    clearInterval(timer);
    timer = null;
  }

  function look() {
    looks += 1;
    if (looks < MOST_LOOKS) return;
    end();
    tell();
  }

  return {
    begin() {
      looks = 0;
      timer ??= setInterval(look, LOOK_MS);
    },
    heard: () => (looks = 0),
    end,
  };
}
