// The state in words, for screen readers and tests: what a canvas cannot tell.

const element = document.getElementById("mirror");
const said = document.getElementById("said");
const SPEAK_EVERY_MS = 1000;
let spoken = "";
let pending = null;
let wanted = "";

function speak() {
  pending = null;
  if (wanted === spoken) return;
  spoken = wanted;
  element.textContent = wanted;
  pending = setTimeout(speak, SPEAK_EVERY_MS);
}

function set(key, value) {
  if (value === null || value === undefined) delete element.dataset[key];
  else if (element.dataset[key] !== String(value)) element.dataset[key] = value;
}

export const mirror = {
  /// `{ state, time, detection_time, location, summary, said, tuning, log }` as `App::report` gives it.
  report({ state, time, detection_time: detectionTime, location, summary, said: sentence, tuning, log }) {
    // A state is said as it begins, and none as the page opens.
    if (element.dataset.state && element.dataset.state !== state) said.textContent = sentence;
    set("state", state);
    set("time", time);
    set("detectionTime", detectionTime);
    set("location", location);
    set("log", log);
    set("tuning", tuning && JSON.stringify(tuning));
    wanted = summary ?? "";
    // A live region that changes with every frame would never let a reader finish a sentence.
    if (pending === null) speak();
  },
  set renderer(name) {
    set("renderer", name);
  },
  get ready() {
    return element.dataset.ready === "true";
  },
  set ready(value) {
    set("ready", value);
  },
};
