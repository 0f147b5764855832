// Tells when somebody who has something to do is silent for too long.

const LOOK_MS = 5000;

/// Calls `tell` once after so many looks without a word, 5 s from one to the next: looks, not time, for a machine that slept has looked
/// once. `{ begin, heard, end }`.
export function silence(most, tell) {
  let looks = 0;
  let timer = null;

  function end() {
    clearInterval(timer);
    timer = null;
  }

  function look() {
    looks += 1;
    if (looks < most) return;
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
